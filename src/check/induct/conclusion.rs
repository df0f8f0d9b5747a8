//! Results of proofs at full width.

use super::not_inductive::{Clause, NotInductive};
use crate::check::blamed::UnknownSignal;
use crate::check::enumerate::lines;
use crate::engine::EngineError;
use std::fmt;
use std::time::Duration;

/// Result for a property.
#[derive(Debug, Clone)]
pub struct Concluded<R> {
    /// Name of the property.
    pub property: String,
    /// Path of the part of the circuit that relies on it; `None` for a property of the circuit
    /// itself.
    pub part: Option<String>,
    /// True if the property is there only to make the proofs of others possible.
    pub is_helper: bool,
    /// Conclusion.
    pub conclusion: Conclusion<R>,
    /// Processor time for the search, and for the second check of its result.
    pub time: Duration,
}

/// Conclusion on a property; `R` is a counterexample.
#[derive(Debug, Clone)]
#[must_use = "a counterexample is seen by looking at it"]
pub enum Conclusion<R> {
    /// The circuit relies on it; a circuit around this one has to keep it.
    Assumed,
    /// The property holds in every tick of every run from power-on.
    Proof {
        /// Basis of the proof.
        by: By,
        /// Names of the other properties on which the proof relies; all are proved. The name of one
        /// of a part begins with the path of the part.
        with: Vec<String>,
    },
    /// A run from power-on violates the property.
    Refuted(R),
    /// Neither a proof nor a counterexample was found in time; or a read of a memory above the
    /// limit of 131,072 bits, which may give any word, was needed for each violation.
    Open {
        /// State that may never come from which the property is violated, if one is known.
        from: Option<Box<NotInductive>>,
    },
    /// A single question took too long, or the circuit has too many gates.
    TooLarge,
}

/// Basis of a proof.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum By {
    /// The property holds in every state, reachable or not.
    EveryState,
    /// The property holds after this number of ticks in which it holds.
    Induction(usize),
    /// The property follows from clauses that hold in every reachable state.
    Search {
        /// The clauses.
        clauses: Vec<Clause>,
    },
}

impl fmt::Display for By {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            By::EveryState => f.write_str("every state"),
            By::Induction(ticks) => write!(f, "induction {ticks}"),
            By::Search { clauses } if clauses.len() == 1 => f.write_str("search, 1 clause"),
            By::Search { clauses } => write!(f, "search, {} clauses", clauses.len()),
        }
    }
}

impl<R> Conclusion<R> {
    /// True if the property is proved.
    pub fn is_proved(&self) -> bool {
        matches!(self, Conclusion::Proof { .. })
    }

    /// Returns the counterexample, if this is one.
    pub fn counterexample(self) -> Option<R> {
        match self {
            Conclusion::Refuted(found) => Some(found),
            _ => None,
        }
    }

    /// Converts the counterexample.
    pub(crate) fn map<S>(self, refuted: impl FnOnce(R) -> S) -> Conclusion<S> {
        match self {
            Conclusion::Assumed => Conclusion::Assumed,
            Conclusion::Proof { by, with } => Conclusion::Proof { by, with },
            Conclusion::Refuted(found) => Conclusion::Refuted(refuted(found)),
            Conclusion::Open { from } => Conclusion::Open { from },
            Conclusion::TooLarge => Conclusion::TooLarge,
        }
    }
}

/// Reasons why properties cannot be proved at full width.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InductError {
    /// The circuit has mistakes.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// The circuit states no property.
    #[error("{circuit}: no property is stated in words of the circuit; state one in `properties`")]
    NoProperties {
        /// Name of the circuit.
        circuit: String,
    },
    /// Properties name signals that the circuit does not have.
    #[error("{}", lines(.0))]
    Signals(Vec<UnknownSignal>),
    /// No input keeps all assumptions in one of the first ticks.
    #[error(
        "{circuit}: no input keeps all assumptions up to tick {tick}; correct the statements that `given` makes"
    )]
    Contradiction {
        /// Name of the circuit.
        circuit: String,
        /// First tick without an input.
        tick: usize,
    },
    /// A second check does not confirm a result: an error of this crate.
    #[error(
        "{circuit}: a second check does not confirm {result} of `{property}`; please report this"
    )]
    Unconfirmed {
        /// Name of the circuit.
        circuit: String,
        /// Name of the property.
        property: String,
        /// Proof or counterexample.
        result: &'static str,
    },
}

crate::netlist::debug_as_display!(InductError);
