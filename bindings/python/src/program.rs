//! The program `motion-rtl`.

use pyo3::prelude::*;
use std::ffi::OsString;
use std::io::{self, Write as _};

/// Runs the program with the words of its command line, of which the first is its name; returns
/// the exit code. Its state is that of a process: it runs once in a process.
#[pyfunction]
#[pyo3(name = "_main")]
pub fn main(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| {
        let code = motion_rtl_program::main(words);
        // What is lost is told by the program.
        let _ = io::stdout().flush();
        code
    })
}
