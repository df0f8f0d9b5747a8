//! The command line of `motion-rtl`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::program::main()
}
