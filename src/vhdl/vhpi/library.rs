//! Path of the shared library in the attributes of foreign subprograms.

use std::fmt;
use std::str::FromStr;

/// Most characters that GHDL takes: with more, GHDL 2.0 ends with an exception.
const LONGEST: usize = 32;

/// Path or name of the shared library of `bindings/c`, as `VHPIDIRECT` takes it.
///
/// ```
/// use motion_rtl::vhdl::LibraryPath;
///
/// assert!("build/c/lib/libmotion_rtl.so".parse::<LibraryPath>().is_ok());
/// assert!("my library.so".parse::<LibraryPath>().is_err());
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LibraryPath(String);

/// Reason why a text is not the path of a library.
#[derive(thiserror::Error)]
#[error(
    "GHDL does not take {path:?} as a library; allowed: up to {LONGEST} ASCII characters, without \
     blanks or quotes; the directory of a name without a slash can stand in LD_LIBRARY_PATH"
)]
pub struct LibraryPathError {
    /// Given text.
    pub path: String,
}

crate::netlist::debug_as_display!(LibraryPathError);

impl FromStr for LibraryPath {
    type Err = LibraryPathError;

    fn from_str(path: &str) -> Result<Self, LibraryPathError> {
        let fits = |letter: u8| letter.is_ascii_graphic() && letter != b'"';
        match (1..=LONGEST).contains(&path.len()) && path.bytes().all(fits) {
            true => Ok(LibraryPath(path.to_owned())),
            false => Err(LibraryPathError {
                path: path.to_owned(),
            }),
        }
    }
}

impl fmt::Display for LibraryPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
