//! Proofs of the properties of a circuit at any width, by a SAT solver.
//!
//! [`induct`] proves the [properties](crate::hdl::Circuit::properties) of a circuit for every run
//! from power-on, under every input, at the widths of the circuit. It does not visit states as
//! [`reach`](super::reach()) does:
//!
//! 1. A property that no state violates, reachable or not, is proved at once.
//! 2. Induction: if all properties hold in k ticks, they hold in the next one; and they hold in the
//!    first k ticks from power-on. Tried for k from 1 to 4. A property that fails is left out.
//! 3. A search for each property that is left (IC3, also called property-directed reachability): it
//!    collects clauses that hold in every reachable state, until the property follows from them.
//!
//! Statements that are [given](crate::hdl::Property::given) are assumed in every tick; those that
//! only [narrow](crate::hdl::Property::narrowing) an exhaustive search are not.
//!
//! An assumption of a part is not assumed here: it is an obligation, and proved as a property of the
//! whole circuit. The properties of such a part are proved there too, in the same induction, so that
//! they can help. That is not circular: an induction assumes statements only in the ticks before the
//! one that it asks about, and in this tick only statements that are already proved. A part without
//! assumptions may keep those of the parts inside it with free inputs; it is then proved
//! [alone](alone).
//!
//! Nothing is taken on trust: a solver of its own checks each proof again, and an engine replays
//! each counterexample.

mod alone;
mod certify;
mod clauses;
mod conclusion;
mod conjuncts;
mod frames;
mod not_inductive;
mod prover;
mod search;
#[cfg(test)]
mod tests;
mod thread_time;
mod unrolled;

pub use conclusion::{By, Concluded, Conclusion, InductError};
pub use not_inductive::{Clause, NotInductive};
pub(crate) use thread_time::ThreadTime;

use super::blamed;
use super::counterexample::Violation;
use super::{Counterexample, Fault};
use crate::engine::{Statement, Watch};
use crate::hdl::{self, Circuit};
use crate::netlist::Claim;
use crate::sim::Elaborated;
use alone::Alone;
use prover::{Basis, Found, Results, Task};
use std::fmt;
use std::time::Duration;

/// Processor time for a property by default.
const LIMIT: Duration = Duration::from_secs(10);
/// Greatest time for a property: ten years.
const LONGEST: Duration = Duration::from_secs(10 * 365 * 86_400);

/// Greatest size of all memories in bits whose words are state.
const MEMORY_BITS: usize = 1 << 17;

/// Prepared proof; see [`induct`].
#[must_use = "nothing is proved before it runs"]
pub struct Induct<'a, C: Circuit> {
    circuit: &'a C,
    limit: Duration,
    model: Option<Elaborated>,
}

/// Prepares proofs of the properties of a circuit at its own widths.
///
/// ```
/// use motion_rtl::check::{By, Conclusion, induct};
/// use motion_rtl::prelude::*;
///
/// /// Counts to 999,999 and starts again.
/// #[derive(Debug, Clone)]
/// struct Wrap;
///
/// signals! { for Wrap as _c;
///     pub struct In { pub go: Bit }
///     pub struct Reg { pub count: U(20) = 0 }
/// }
///
/// impl Circuit for Wrap {
///     const NAME: &'static str = "wrap";
///     const ABOUT: &'static str = "counts to 999,999";
///     records!(In, Reg, Nothing);
///
///     fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
///         let next = q.count.equals(999_999).mux(0, q.count + 1);
///         (Nothing, Reg { count: i.go.mux(next, q.count) })
///     }
///
///     fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
///         vec![Property::always("it stays below a million", &["count"], now.q.count.below(1_000_000))]
///     }
/// }
///
/// let results = induct(&Wrap).run()?;
/// let proof = &results[0].conclusion;
/// assert!(matches!(proof, Conclusion::Proof { by: By::Induction(1), .. }), "{proof:?}");
/// # Ok::<(), motion_rtl::check::InductError>(())
/// ```
#[must_use = "nothing is proved before it runs"]
pub fn induct<C: Circuit>(circuit: &C) -> Induct<'_, C> {
    Induct {
        circuit,
        limit: LIMIT,
        model: None,
    }
}

impl<C: Circuit> Induct<'_, C> {
    /// Limits the processor time for each property; 10 seconds by default. A check of its proof
    /// may take four times as long. The time to unroll the circuit is not limited.
    pub fn limit(mut self, limit: Duration) -> Self {
        self.limit = limit.min(LONGEST);
        self
    }

    /// Proves the properties of this netlist of the circuit: one that was elaborated before, or that
    /// has a fault.
    pub fn model(mut self, model: Elaborated) -> Self {
        self.model = Some(model);
        self
    }

    /// Proves the properties, and what the parts of the circuit assume. Returns the results of the
    /// properties in their order, those of the parts' assumptions, and the circuit's own assumptions.
    ///
    /// # Errors
    /// Returns an error if the circuit cannot be elaborated, there is nothing to prove, a property
    /// names a signal that does not exist, no input keeps the assumptions in one of the first 12 ticks,
    /// or a second check does not confirm a result.
    pub fn run(self) -> Result<Vec<Concluded<Counterexample<C>>>, InductError> {
        let model = match self.model {
            Some(model) => model,
            None => Elaborated::new(self.circuit)?,
        };
        let mut all = Vec::new();
        for concluded in conclude(&model, self.limit)? {
            let conclusion = concluded.conclusion.map(|violation| {
                let mut inputs = Vec::new();
                for ports in violation.inputs() {
                    let mut words = ports.iter().copied();
                    let word = |_| words.next().unwrap_or(0);
                    inputs.push(hdl::inputs(self.circuit, word));
                }
                Counterexample::of(violation, inputs)
            });
            all.push(Concluded {
                property: concluded.property,
                part: concluded.part,
                is_helper: concluded.is_helper,
                conclusion,
                time: concluded.time,
            });
        }
        Ok(all)
    }
}

impl<C: Circuit> fmt::Debug for Induct<'_, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Induct")
            .field("circuit", &C::NAME)
            .field("limit", &self.limit)
            .finish_non_exhaustive()
    }
}

/// Proves the properties of an elaborated circuit, and what its parts assume.
///
/// # Errors
/// Returns the errors of [`Induct::run`].
pub(crate) fn conclude(
    model: &Elaborated,
    limit: Duration,
) -> Result<Vec<Concluded<Violation>>, InductError> {
    let circuit = || model.name().to_owned();
    let (whole, stated) = model.with_parts()?;
    let model = &whole;
    if !stated.iter().any(is_asked) {
        return Err(InductError::NoProperties { circuit: circuit() });
    }
    let own = stated.iter().filter(|it| it.path.is_empty());
    let named = own.flat_map(|it| {
        let signals = it.signals.iter();
        signals.map(|&signal| (it.name.to_owned(), signal.to_owned()))
    });
    let unknown = blamed::unknown(model, named.collect());
    if !unknown.is_empty() {
        return Err(InductError::Signals(unknown));
    }
    let alone = Alone::of(model.design(), model.flat(), &stated, limit)?;
    let task = Task::new(model.flat(), &stated, &alone, is_asked, limit);
    let results = prover::prove(&task);
    let unconfirmed = |property: usize, result| InductError::Unconfirmed {
        circuit: circuit(),
        property: stated[property].title(),
        result,
    };
    let Results {
        found,
        is_abstract,
        refused,
        dead,
    } = results;
    if let Some(tick) = dead {
        let circuit = circuit();
        return Err(InductError::Contradiction { circuit, tick });
    }
    if let Some(&property) = refused.first() {
        return Err(unconfirmed(property, "the proof"));
    }
    let row = |property: usize, conclusion, time| {
        let stated = &stated[property];
        Concluded {
            property: stated.name.to_owned(),
            part: (!stated.path.is_empty()).then(|| stated.path.join(".")),
            is_helper: stated.claim == Claim::Helper,
            conclusion,
            time,
        }
    };
    let by = |basis: &Basis| match basis {
        Basis::EveryState => By::EveryState,
        Basis::Induction(ticks) => By::Induction(*ticks),
        Basis::Search(never) => By::Search {
            clauses: never.iter().map(|it| Clause::new(model, it)).collect(),
        },
    };
    let mut all = Vec::new();
    for (&property, (found, time)) in task.properties.iter().zip(found) {
        let name = stated[property].title();
        let conclusion = match found {
            Found::TooLarge => Conclusion::TooLarge,
            Found::Open(never, from) => {
                let property = (property, &name[..]);
                let from = from.and_then(|from| NotInductive::new(model, property, &from, &never));
                let from = from.map(Box::new);
                Conclusion::Open { from }
            }
            Found::Proved(grounds) => {
                let with = grounds.with.iter();
                Conclusion::Proof {
                    with: with.map(|&lemma| stated[lemma].title()).collect(),
                    by: by(&grounds.basis),
                }
            }
            Found::Violated(mut inputs) => match replay(model, &inputs, property, &task.givens) {
                Some(ticks) => {
                    inputs.truncate(ticks);
                    let signals = stated[property].signals.iter();
                    let fault = Fault {
                        signals: signals.map(|&signal| signal.to_owned()).collect(),
                        message: "does not hold".to_owned(),
                    };
                    Conclusion::Refuted(Violation::new(model, inputs, name, fault))
                }
                None if is_abstract => Conclusion::Open { from: None },
                None => return Err(unconfirmed(property, "the counterexample")),
            },
        };
        all.push((property, row(property, conclusion, time)));
    }
    for (property, kept) in alone.kept.iter().enumerate() {
        if let Some(kept) = kept {
            let conclusion = Conclusion::Proof {
                by: by(&kept.basis),
                with: kept.with.iter().map(Statement::title).collect(),
            };
            all.push((property, row(property, conclusion, kept.time)));
        }
    }
    all.sort_by_key(|(property, _)| *property);
    let givens = task.givens.iter();
    let givens = givens.map(|&given| row(given, Conclusion::Assumed, Duration::ZERO));
    let all = all.into_iter().map(|(_, row)| row);
    Ok(all.chain(givens).collect())
}

/// True if a proof of the statement is asked for.
fn is_asked(stated: &Statement) -> bool {
    is_obligation(stated) || stated.path.is_empty() && stated.claim.is_proved()
}

/// True if the statement is an assumption of a part, which the circuit around it has to keep.
fn is_obligation(stated: &Statement) -> bool {
    stated.claim == Claim::Given && !stated.path.is_empty()
}

/// Runs the circuit from power-on; returns the number of ticks after which the property is violated
/// for the first time, if the inputs keep the givens so far.
fn replay(
    model: &Elaborated,
    inputs: &[Vec<u64>],
    property: usize,
    givens: &[usize],
) -> Option<usize> {
    let mut engine = model.engine(Watch::Stated);
    engine.interpret();
    for (tick, ports) in inputs.iter().enumerate() {
        engine.drive_all(ports);
        engine.settle();
        if givens.iter().any(|&given| !engine.property(given)) {
            return None;
        }
        if !engine.property(property) {
            return Some(tick + 1);
        }
        engine.edge();
    }
    None
}
