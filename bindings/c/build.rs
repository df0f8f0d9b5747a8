//! Header of the ABI, and the name under which a program asks for the shared library: it ends in
//! the version of the ABI, so that a program made for another version does not start.

#[path = "src/abi.rs"]
mod abi;

use std::env;
use std::path::PathBuf;

/// Modules with functions and constants of the header, in its order.
const MODULES: [&str; 8] = [
    "abi", "codes", "bench", "lifetime", "check", "signals", "run", "waves",
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo:rerun-if-changed=src");
    println!("cargo:rerun-if-changed=cbindgen.toml");
    let mut header =
        cbindgen::Builder::new().with_config(cbindgen::Config::from_file("cbindgen.toml")?);
    for module in MODULES {
        header = header.with_src(format!("src/{module}.rs"));
    }
    let out = PathBuf::from(env::var("OUT_DIR")?).join("motion_rtl.h");
    header.generate()?.write_to_file(out);
    if env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        let version = abi::MRTL_ABI;
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libmotion_rtl.so.{version}");
    }
    Ok(())
}
