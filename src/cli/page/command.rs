//! `page`: the page as files, for a server of static files or to be opened as a file.

use super::notes;
use super::{Program, with};
use crate::cli::files::{Files, refused};
use crate::cli::{Failure, print};
use clap::Args;
use std::fs;
use std::path::PathBuf;

/// Name of the program beside the page.
const WASM: &str = "motion-rtl.wasm";

/// First bytes of WebAssembly.
const MAGIC: &[u8] = b"\0asm";

/// Arguments of `page`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The program as WebAssembly, which `bindings/web/build` makes.
    #[arg(value_name = "WASM")]
    wasm: PathBuf,
    /// Directory for the files.
    #[arg(long, value_name = "DIR", default_value = "build/page")]
    out: PathBuf,
}

pub fn page(arguments: &Arguments) -> Result<(), Failure> {
    let allowed = "the program that bindings/web/build makes";
    let refuse = |problem: String| Failure::Argument {
        field: "WASM",
        problem,
        allowed: allowed.into(),
    };
    let path = arguments.wasm.display();
    let wasm = fs::read(&arguments.wasm).map_err(|error| refuse(format!("{path}: {error}")))?;
    if !wasm.starts_with(MAGIC) {
        return Err(refuse(format!("{path} is no WebAssembly")));
    }
    let mut files = Files::begin(&arguments.out, "motion-rtl")?;
    files.write("html", &with(Some(Program::within(&wasm)), None))?;
    files.write_as("index.html", &with(Some(Program::Beside(WASM)), None))?;
    files.write_as(notes::FILE, &notes::json())?;
    let mut program = files.create("wasm")?;
    std::io::Write::write_all(&mut program, &wasm)
        .map_err(|error| refused("--out", &error, "a directory that can be written"))?;
    files.push(program);
    let mut text = String::new();
    for file in files.commit()? {
        text += &format!("{file}\n");
    }
    print(&text)
}
