use super::blamed;
use crate::engine::{Engine, EngineError};
use crate::hdl::{Circuit, Registers};
use crate::netlist::Claim;
use crate::sim::{Elaborated, Observer, RunError, Sample};
use std::fmt;
use std::ops::ControlFlow;

/// Violation found by an invariant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// Signals at fault.
    pub signals: Vec<String>,
    /// Description of the violation.
    pub message: String,
}

/// Result of an invariant.
pub type Verdict = Result<(), Fault>;

/// Returns `Ok` if `holds` is true, else a fault with these signals and `message`, which may be
/// empty.
///
/// # Errors
/// Returns a [`Fault`] if `holds` is false.
pub fn require<const N: usize>(
    holds: bool,
    signals: [&str; N],
    message: impl FnOnce() -> String,
) -> Verdict {
    blamed::note(&signals);
    if holds {
        return Ok(());
    }
    Err(Fault {
        signals: signals.map(str::to_owned).into(),
        message: message(),
    })
}

type Always<'f, C> = dyn Fn(&Sample<'_, C>) -> Verdict + 'f;
type Step<'f, C> = dyn Fn(&Sample<'_, C>, &Registers<C>) -> Verdict + 'f;

enum Holds<'f, C: Circuit> {
    Always(Box<Always<'f, C>>),
    Step(Box<Step<'f, C>>),
}

/// Names of the invariants, and the circuit's own statements. Does not depend on the circuit's
/// type.
#[derive(Debug, Default)]
struct Names {
    /// Names in the order of the checks.
    all: Vec<String>,
    /// For each invariant that is not the circuit's own: true if it is not checked.
    left_out: Vec<bool>,
    /// The circuit's own properties; these come first, in their order. A step property is about the
    /// coming edge.
    own: Vec<Own>,
    /// Statements that restrict the inputs.
    given: Vec<Given>,
    /// True if another property reads the registers after the edge.
    look_ahead: bool,
}

/// Statement that restricts the inputs.
#[derive(Debug)]
struct Given {
    /// Index among the statements of the circuit.
    index: usize,
    name: &'static str,
    claim: Claim,
}

/// Property of the circuit's own.
#[derive(Debug)]
struct Own {
    /// Index among the statements of the circuit.
    index: usize,
    signals: &'static [&'static str],
}

impl Names {
    fn of(model: Result<Elaborated, EngineError>) -> Self {
        let mut names = Names::default();
        let Ok(model) = model else {
            return names;
        };
        let module = model.design().modules.last();
        let known = module.map_or(&[][..], |module| &module.assertions);
        for (index, known) in known.iter().enumerate() {
            if known.claim.is_proved() {
                names.all.push(known.name.to_owned());
                names.own.push(Own {
                    index,
                    signals: known.signals,
                });
            } else {
                names.given.push(Given {
                    index,
                    name: known.name,
                    claim: known.claim,
                });
            }
        }
        names
    }

    /// Returns the names of the invariants that are checked, in order.
    fn checked(&self) -> impl Iterator<Item = &str> {
        let own = self.own.len();
        let is_checked = move |at: usize| at < own || self.is_checked(at - own);
        let all = self.all.iter().enumerate();
        all.filter(move |(at, _)| is_checked(*at))
            .map(|(_, name)| name.as_str())
    }

    /// Leaves out all invariants but those of these names.
    fn keep_only(&mut self, names: &[String]) {
        let own = self.own.len();
        let others = &self.all[own..];
        self.left_out = others.iter().map(|name| !names.contains(name)).collect();
        let mut kept = self.all[..own].iter().map(|name| names.contains(name));
        self.own.retain(|_| kept.next().unwrap_or_default());
        let all = self.all.drain(..own);
        let own: Vec<_> = all.filter(|name| names.contains(name)).collect();
        self.all.splice(..0, own);
    }

    /// True if an invariant that is not the circuit's own is checked.
    #[inline]
    fn is_checked(&self, other: usize) -> bool {
        !self.left_out.get(other).copied().unwrap_or_default()
    }

    /// Returns the first violated property of the circuit's own. Inputs that break an assumption
    /// are a violation too: no property is promised for them.
    fn violated(&self, engine: &Engine) -> Option<(&str, Fault)> {
        let mut given = self.given.iter();
        let broken = |given: &&Given| given.claim == Claim::Given && !engine.property(given.index);
        if let Some(given) = given.find(broken) {
            let fault = Fault {
                signals: Vec::new(),
                message: "assumed of the inputs, which break it".to_owned(),
            };
            return Some((given.name, fault));
        }
        let mut own = self.own.iter().zip(&self.all);
        let (own, name) = own.find(|(own, _)| !engine.property(own.index))?;
        let fault = Fault {
            signals: own.signals.iter().map(|&name| name.into()).collect(),
            message: "does not hold".to_owned(),
        };
        Some((name, fault))
    }
}

/// Named properties that must hold in every tick: proved by [`reach`](super::reach()), checked in
/// a run by a [`Monitor`].
///
/// Properties are checked in the order in which they were added. A property must not depend on
/// [`Sample::tick`]: `reach` checks every transition once, on a shortest path.
pub struct Invariants<'f, C: Circuit> {
    names: Names,
    /// Invariants that are not the circuit's own.
    others: Vec<Holds<'f, C>>,
}

impl<'f, C: Circuit> Invariants<'f, C> {
    /// Creates an empty set.
    pub fn new() -> Self {
        Invariants {
            names: Names::default(),
            others: Vec::new(),
        }
    }

    /// Creates the set of the circuit's [properties](Circuit::properties).
    ///
    /// A circuit that cannot be elaborated has none; it can be neither proved nor run.
    pub fn of(circuit: &C) -> Self {
        Invariants {
            names: Names::of(Elaborated::new(circuit)),
            others: Vec::new(),
        }
    }

    /// Adds a property of the settled signals of a tick.
    #[must_use]
    pub fn always(
        mut self,
        name: impl Into<String>,
        holds: impl Fn(&Sample<'_, C>) -> Verdict + 'f,
    ) -> Self {
        self.names.all.push(name.into());
        self.others.push(Holds::Always(Box::new(holds)));
        self
    }

    /// Adds a property of the settled signals of a tick and the registers after its edge.
    #[must_use]
    pub fn step(
        mut self,
        name: impl Into<String>,
        holds: impl Fn(&Sample<'_, C>, &Registers<C>) -> Verdict + 'f,
    ) -> Self {
        self.names.all.push(name.into());
        self.names.look_ahead = true;
        self.others.push(Holds::Step(Box::new(holds)));
        self
    }

    /// Leaves out all properties but those of these names.
    #[must_use]
    pub fn only(mut self, names: &[String]) -> Self {
        self.names.keep_only(names);
        self
    }

    /// Returns the names, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.names.checked()
    }

    /// Returns the indices of the circuit's own properties.
    pub(super) fn own(&self) -> Vec<usize> {
        self.names.own.iter().map(|own| own.index).collect()
    }

    /// Returns the indices of the circuit's statements that restrict the inputs.
    pub(super) fn given(&self) -> Vec<usize> {
        self.names.given.iter().map(|given| given.index).collect()
    }

    /// True if not all properties are the circuit's own.
    pub(super) fn has_others(&self) -> bool {
        (0..self.others.len()).any(|other| self.names.is_checked(other))
    }

    /// True if a property reads the registers after the edge.
    pub(super) fn look_ahead(&self) -> bool {
        self.names.look_ahead
    }

    /// Returns the first violation. Without `next`, step properties are skipped.
    #[inline]
    pub(super) fn check(
        &self,
        now: &Sample<'_, C>,
        next: Option<&Registers<C>>,
    ) -> Result<(), (&str, Fault)> {
        if let Some(violated) = self.names.violated(now.engine()) {
            return Err(violated);
        }
        for (at, property) in self.others.iter().enumerate() {
            if !self.names.is_checked(at) {
                continue;
            }
            let verdict = match (property, next) {
                (Holds::Always(holds), _) => holds(now),
                (Holds::Step(holds), Some(next)) => holds(now, next),
                (Holds::Step(_), None) => Ok(()),
            };
            if let Err(fault) = verdict {
                return Err((&self.names.all[self.names.own.len() + at], fault));
            }
        }
        Ok(())
    }
}

impl<C: Circuit> Invariants<'_, C> {
    /// Returns the signals that the invariants name in this tick, each with its invariant.
    pub(super) fn blamed(&self, now: &Sample<'_, C>, next: &Registers<C>) -> Vec<(String, String)> {
        let own = self.names.own.iter().map(|own| {
            let signals = own.signals.iter().map(|&signal| signal.to_owned());
            signals.collect()
        });
        let others = self.others.iter().map(|property| {
            blamed::during(|| {
                // The search judges; here only the names count.
                let _ = match property {
                    Holds::Always(holds) => holds(now),
                    Holds::Step(holds) => holds(now, next),
                };
            })
        });
        let signals = own.chain(others);
        let all = self.names.all.iter().zip(signals);
        all.flat_map(|(name, signals): (_, Vec<String>)| {
            let pairs = signals.into_iter();
            pairs.map(move |signal| (name.clone(), signal))
        })
        .collect()
    }
}

impl<C: Circuit> Default for Invariants<'_, C> {
    fn default() -> Self {
        Invariants::new()
    }
}

impl<C: Circuit> fmt::Debug for Invariants<'_, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.names()).finish()
    }
}

/// Returns the name of an invariant, with a message if there is one.
pub(super) fn stated(name: &str, message: &str) -> String {
    match message.is_empty() {
        true => name.to_owned(),
        false => format!("{name}: {message}"),
    }
}

/// Checks invariants during a simulated run and ends it at the first violation.
#[derive(Debug)]
pub struct Monitor<'a, C: Circuit> {
    invariants: &'a Invariants<'a, C>,
    look_ahead: bool,
}

impl<'a, C: Circuit> Monitor<'a, C> {
    /// Creates a monitor for runs of a circuit.
    ///
    /// A step property costs a copy of all registers per tick, including the memories.
    pub fn new(invariants: &'a Invariants<'a, C>) -> Self {
        Monitor {
            invariants,
            look_ahead: invariants.look_ahead(),
        }
    }
}

impl<C: Circuit> Observer<C> for Monitor<'_, C> {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        let next = self.look_ahead.then(|| now.next());
        match self.invariants.check(now, next.as_ref()) {
            Ok(()) => Ok(ControlFlow::Continue(())),
            Err((name, fault)) => Err(RunError::Violation {
                tick: now.tick,
                signals: fault.signals,
                message: stated(name, &fault.message),
            }),
        }
    }
}
