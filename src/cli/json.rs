//! Results as JSON.

use super::{Failure, to_standard_output};
use serde::Serialize;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Version of the keys of everything that is printed as JSON; it grows when a key goes or changes
/// its meaning.
pub const VERSION: u32 = 1;

/// True once a result was printed: it has what is wrong in it.
static PRINTED: AtomicBool = AtomicBool::new(false);

/// True if standard output has its JSON.
pub fn is_printed() -> bool {
    PRINTED.load(Relaxed)
}

/// A value with the version of its keys.
#[derive(Debug, Serialize)]
struct Versioned<'a, T> {
    version: u32,
    #[serde(flatten)]
    value: &'a T,
}

/// Prints the keys of a value and their version.
pub fn print(value: &impl Serialize) -> Result<(), Failure> {
    let text = text(value)?;
    PRINTED.store(true, Relaxed);
    to_standard_output(&text)
}

/// Returns the text that [`print`] prints.
pub fn text(value: &impl Serialize) -> Result<String, Failure> {
    let version = VERSION;
    alone(&Versioned { version, value })
}

/// Prints a value that has a version of its own or needs none.
pub fn print_alone(value: &impl Serialize) -> Result<(), Failure> {
    let text = alone(value)?;
    PRINTED.store(true, Relaxed);
    to_standard_output(&text)
}

fn alone(value: &impl Serialize) -> Result<String, Failure> {
    Ok(serde_json::to_string_pretty(value).map_err(io::Error::from)? + "\n")
}
