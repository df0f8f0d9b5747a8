//! What is wrong with a circuit.

use super::record::Site;
use std::fmt;

/// All that is wrong with a circuit: what [`elaborate`](super::elaborate) found, in its order.
#[derive(Clone, PartialEq, Eq)]
pub struct Wrong(pub Vec<Mistake>);

/// One thing that is wrong.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Mistake {
    /// Where: the operator, the settling of a part, or the declaration.
    pub site: Site,
    /// The circuit, by the names of the instances around it.
    pub path: String,
    /// What.
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

/// Prints errors by `Debug` as they are displayed: `unwrap`, and a `main` that returns one, print
/// `Debug`, and all mistakes are to be read there, a line each.
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
