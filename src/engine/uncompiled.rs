//! Builds without a compiler: a type for compiled code that has no values. Circuits are interpreted.

use super::plan::Plan;

/// Code that does not exist.
#[derive(Debug)]
pub enum Code {}

/// There is no compiler.
#[derive(Debug, thiserror::Error)]
#[error("this program has no compiler of circuits")]
pub struct CompileError;

impl Code {
    /// Returns the error.
    ///
    /// # Errors
    /// Always.
    pub fn compile(_: &Plan, _: &[bool]) -> Result<Code, CompileError> {
        Err(CompileError)
    }

    pub fn settle(&self, _: &mut [u64]) {
        match *self {}
    }

    pub fn edge(&self, _: &mut [u64]) {
        match *self {}
    }

    pub fn advance(&self, _: &mut [u64], _: u64) -> u64 {
        match *self {}
    }
}
