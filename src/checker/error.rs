//! Errors of checkers.

use crate::sim::ModelError;

/// Reason why a [`Checker`](super::Checker) cannot be made or cannot go on.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum CheckerError {
    /// The model refuses something.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A signal to leave out is not a port.
    #[error("{name} is not a port of {circuit}; allowed: {ports}")]
    NoPort {
        /// Name of the circuit.
        circuit: &'static str,
        /// Given name.
        name: String,
        /// Names of the ports.
        ports: String,
    },
    /// A tick has another number of words.
    #[error("{given} words for a tick; allowed: {words}")]
    Words {
        /// Number of given words.
        given: usize,
        /// Number of words of a tick.
        words: usize,
    },
    /// A tick has another number of values of `std_logic`.
    #[error("{given} values of std_logic for a tick; allowed: {values}")]
    Values {
        /// Number of given values.
        given: usize,
        /// Number of values of a tick.
        values: usize,
    },
}

crate::netlist::debug_as_display!(CheckerError);
