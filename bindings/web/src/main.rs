//! The program `motion-rtl` for browsers, from its own sources.

// Commands that a browser does without are left out.
#[cfg_attr(target_family = "wasm", allow(dead_code, unused_imports))]
#[path = "../../../src/cli/mod.rs"]
mod cli;
#[cfg(feature = "wasi-libc-2022")]
mod missing;

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(cli::program::main(std::env::args_os().collect()))
}
