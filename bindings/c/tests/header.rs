//! Header of the ABI: the one that is checked in is that of the source. `make header` writes it
//! anew.

use expect_test::expect_file;

#[test]
fn the_header_is_that_of_the_source() {
    let header = include_str!(concat!(env!("OUT_DIR"), "/motion_rtl.h"));
    expect_file!["../include/motion_rtl.h"].assert_eq(header);
}
