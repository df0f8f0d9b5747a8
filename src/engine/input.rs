//! Changes of input ports, and errors of words that do not fit them.

/// Change of an input port.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InputChange {
    /// First tick with the value.
    pub tick: u64,
    /// Number of the port, from 0 in declaration order.
    pub port: usize,
    /// Value as a word.
    pub word: u64,
}

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
    /// A table of changes is not in the order of its ticks.
    #[error("a change stands behind one of tick {before}; changes must be sorted by tick")]
    Order {
        /// Tick of the change before.
        before: u64,
    },
    /// A table of changes has two for one port in one tick.
    #[error("port in {port} changes twice; one change of a port is allowed in a tick")]
    Twice {
        /// Name of the port below the circuit.
        port: String,
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
