//! Words that ports in do not take.

/// Why a port in cannot be set.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
pub enum InputError {
    /// There is no such port.
    #[error("port in {port} does not exist; the circuit has {ports}, counted from 0")]
    Port {
        /// Number that was asked for.
        port: usize,
        /// Number of ports in.
        ports: usize,
    },
    /// The number of words is not that of the ports, for instance because an array of a record has
    /// another length.
    #[error("{words} words for {ports} ports in")]
    Count {
        /// Number of words given.
        words: usize,
        /// Number of ports in.
        ports: usize,
    },
    /// The value does not fit the port.
    #[error("port in {port}: {value} does not fit; allowed are {least} to {greatest}")]
    Range {
        /// Name of the port below the circuit, or its number where an [`Engine`](super::Engine)
        /// is set directly.
        port: String,
        /// The value.
        value: i128,
        /// Least value allowed.
        least: i128,
        /// Greatest value allowed.
        greatest: i128,
    },
}

crate::hdl::debug_as_display!(InputError);

impl InputError {
    /// The bits of a word of `width` bits are refused.
    pub(crate) fn bits(port: String, word: u64, width: usize) -> Self {
        InputError::Range {
            port,
            value: word.into(),
            least: 0,
            greatest: (1 << width) - 1,
        }
    }
}
