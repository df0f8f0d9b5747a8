//! Header of the ABI, and the name under which a program asks for the shared library: it ends in
//! the version of the ABI, so that a program made for another version does not start.

#[path = "src/abi.rs"]
mod abi;

use std::env;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo:rerun-if-changed=src");
    println!("cargo:rerun-if-changed=cbindgen.toml");
    let directory = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?);
    let config = cbindgen::Config::from_file(directory.join("cbindgen.toml"))?;
    let header = cbindgen::generate_with_config(&directory, config)?;
    header.write_to_file(Path::new(&env::var("OUT_DIR")?).join("motion_rtl.h"));
    if env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        let version = abi::MRTL_ABI;
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libmotion_rtl.so.{version}");
    }
    Ok(())
}
