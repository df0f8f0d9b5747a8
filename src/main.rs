//! The command line of `motion-rtl`.
#![forbid(unsafe_code)]

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(cli::program::main(std::env::args_os().collect()))
}
