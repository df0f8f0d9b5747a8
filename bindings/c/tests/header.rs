//! Header of the ABI: the one that is checked in is that of the source. `make header` writes it
//! anew.

use std::fs;
use std::path::Path;

#[test]
fn the_header_is_that_of_the_source() {
    let header = include_str!(concat!(env!("OUT_DIR"), "/motion_rtl.h"));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/motion_rtl.h");
    if std::env::var_os("UPDATE_HEADER").is_some_and(|value| value == "1") {
        fs::write(&path, header).unwrap();
    }
    let checked_in = fs::read_to_string(&path).unwrap();
    assert!(
        checked_in == header,
        "make -C bindings/c header writes the header anew:\n{header}"
    );
}
