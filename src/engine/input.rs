//! Errors of words that do not fit input ports.

/// Reason why an input port cannot be set.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InputError {
    /// There is no such port.
    #[error("port in {port} does not exist; the circuit has {ports}, counted from 0")]
    Port {
        /// Requested number.
        port: usize,
        /// Number of input ports.
        ports: usize,
    },
    /// The number of words differs from the number of ports, for instance because an array of a
    /// record has another length.
    #[error("{words} words for {ports} ports in")]
    Count {
        /// Number of words given.
        words: usize,
        /// Number of input ports.
        ports: usize,
    },
    /// The value does not fit the port.
    #[error("port in {port}: {value} does not fit; allowed are {least} to {greatest}")]
    Range {
        /// Name of the port below the circuit, or its number if an [`Engine`](super::Engine) is
        /// set directly.
        port: String,
        /// Value given.
        value: i128,
        /// Least allowed value.
        least: i128,
        /// Greatest allowed value.
        greatest: i128,
    },
}

crate::netlist::debug_as_display!(InputError);

impl InputError {
    /// Returns the error for a word that is wider than a port of `width` bits.
    pub(crate) fn bits(port: String, word: u64, width: usize) -> Self {
        InputError::Range {
            port,
            value: word.into(),
            least: 0,
            greatest: (1 << width) - 1,
        }
    }
}
