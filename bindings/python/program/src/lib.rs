//! The program `motion-rtl` as a library, from its own sources.
#![forbid(unsafe_code)]

#[path = "../../../../src/cli/mod.rs"]
mod cli;

pub use cli::program::main;
