//! Mistakes of a circuit.

use std::fmt;

/// All mistakes of a circuit, in the order in which [`elaborate`](fn@crate::hdl::elaborate) found them.
#[derive(Clone, PartialEq, Eq)]
pub struct Wrong(pub Vec<Mistake>);

/// Source location.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Site {
    /// File.
    pub file: &'static str,
    /// Line, from 1.
    pub line: u32,
    /// Column, from 1.
    pub column: u32,
}

/// One mistake.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Mistake {
    /// Source location: the operator, the `settle` of a part, or the declaration.
    pub site: Site,
    /// Instance path of the circuit.
    pub path: String,
    /// Description of the mistake.
    pub what: String,
}

impl fmt::Display for Site {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}", self.site, self.path, self.what)
    }
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, mistake) in self.0.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{mistake}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Wrong {}

/// Makes `Debug` of an error equal to `Display`. `unwrap`, and a `main` that returns an error,
/// print `Debug`; the reader needs all mistakes there, one per line.
macro_rules! debug_as_display {
    ($($error:ty),+) => {
        $(
            impl ::std::fmt::Debug for $error {
                fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                    ::std::fmt::Display::fmt(self, f)
                }
            }
        )+
    };
}
pub(crate) use debug_as_display;

debug_as_display!(Wrong);
