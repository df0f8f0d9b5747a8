//! Errors of models.

use crate::engine::{EngineError, InputError};
use crate::nearest::meant;
use std::io;

/// Reason why a [`Model`](super::Model) cannot do something.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The catalogue has no such circuit.
    #[error("no circuit is called {name}{}", meant(near.as_deref()))]
    UnknownCircuit {
        /// Requested name.
        name: String,
        /// Most similar name, if one is near enough.
        near: Option<&'static str>,
    },
    /// The circuit does not take the settings.
    #[error("{circuit}: {problem}")]
    Settings {
        /// Name of the circuit.
        circuit: &'static str,
        /// Each refused key with the allowed ones, one line each.
        problem: String,
    },
    /// The circuit cannot be run.
    #[error(transparent)]
    Circuit(#[from] EngineError),
    /// The circuit has no such signal.
    #[error("{circuit} has no signal {name}{}", near_it(near))]
    UnknownSignal {
        /// Name of the circuit.
        circuit: &'static str,
        /// Requested name.
        name: String,
        /// Most similar names, the nearest first.
        near: Vec<String>,
    },
    /// The signal cannot be set, since it is not an input port.
    #[error("{signal} is {kind}; only input ports can be set{}", near_it(near))]
    NoInput {
        /// Path of the signal below the circuit.
        signal: String,
        /// Kind of the signal, in words.
        kind: &'static str,
        /// Input ports with the most similar names, the nearest first.
        near: Vec<String>,
    },
    /// A value does not fit its port.
    #[error("tick {tick}: {error}")]
    Input {
        /// Tick of the value.
        tick: u64,
        /// Port and value that do not fit.
        #[source]
        error: InputError,
    },
    /// An array of inputs has another length than the run.
    #[error("{values} values of {port} for {ticks} ticks")]
    Length {
        /// Path of the port below the circuit.
        port: String,
        /// Number of values.
        values: usize,
        /// Number of ticks.
        ticks: usize,
    },
    /// A handle or a snapshot is of another circuit, or of one with other settings.
    #[error("the {what} is of another circuit than this {circuit}, or of other settings")]
    OtherCircuit {
        /// `handle` or `snapshot`.
        what: &'static str,
        /// Name of the model's circuit.
        circuit: &'static str,
    },
    /// The waves could not be written.
    #[error("the waves could not be written: {0}")]
    Waves(#[from] io::Error),
    /// Waves are being written.
    #[error("{refused} while waves are written; finish_waves() ends them")]
    WavesOn {
        /// Refused operation.
        refused: &'static str,
    },
}

crate::netlist::debug_as_display!(ModelError);

impl ModelError {
    /// Returns a conversion of an input error at this tick.
    pub(super) fn at(tick: u64) -> impl FnOnce(InputError) -> ModelError {
        move |error| ModelError::Input { tick, error }
    }
}

fn near_it(near: &[String]) -> String {
    match near {
        [] => String::new(),
        near => format!("; near it: {}", near.join(", ")),
    }
}
