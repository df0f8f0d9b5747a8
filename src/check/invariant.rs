use crate::hdl::RunError;
use crate::hdl::{self, Circuit, Observer, Registers, Sample};
use std::fmt;
use std::ops::ControlFlow;

/// What an invariant found wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The signals at fault.
    pub signals: Vec<String>,
    /// What is wrong with them.
    pub message: String,
}

/// The answer of an invariant.
pub type Verdict = Result<(), Fault>;

/// `Ok` where `holds`; otherwise these signals are at fault, and `message` says why.
///
/// # Errors
/// Where it does not hold.
pub fn require<const N: usize>(
    holds: bool,
    signals: [&str; N],
    message: impl FnOnce() -> String,
) -> Verdict {
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
    /// One of the circuit's own, by its number, and the signals that it is about. A step property is
    /// one of what this edge is about to do.
    Own(usize, &'static [&'static str]),
    Always(Box<Always<'f, C>>),
    Step(Box<Step<'f, C>>),
}

/// Named properties that hold on every tick: proved by [`reach`](super::reach()), watched by a
/// [`Monitor`].
///
/// They are checked in the order in which they were added. A property must not depend on
/// [`Sample::tick`]: `reach` comes to every transition once, on a shortest way.
pub struct Invariants<'f, C: Circuit> {
    named: Vec<(String, Holds<'f, C>)>,
}

impl<'f, C: Circuit> Invariants<'f, C> {
    /// None.
    pub const fn new() -> Self {
        Invariants { named: Vec::new() }
    }

    /// The circuit's [properties](Circuit::properties).
    ///
    /// Of what is no netlist there are none: neither is there a proof of it, nor a run.
    pub fn of(circuit: &C) -> Self {
        let mut invariants = Invariants::new();
        let Ok(model) = hdl::model(circuit) else {
            return invariants;
        };
        let known = model.design().modules.last();
        let known = known.map_or(&[][..], |module| &module.assertions);
        for (index, known) in known.iter().enumerate() {
            let own = Holds::Own(index, known.signals);
            invariants.named.push((known.name.to_owned(), own));
        }
        invariants
    }

    /// Adds a property of the settled signals of a tick.
    #[must_use]
    pub fn always(
        mut self,
        name: impl Into<String>,
        holds: impl Fn(&Sample<'_, C>) -> Verdict + 'f,
    ) -> Self {
        let property = Holds::Always(Box::new(holds));
        self.named.push((name.into(), property));
        self
    }

    /// Adds a property of the settled signals of a tick and the registers after its edge.
    #[must_use]
    pub fn step(
        mut self,
        name: impl Into<String>,
        holds: impl Fn(&Sample<'_, C>, &Registers<C>) -> Verdict + 'f,
    ) -> Self {
        let property = Holds::Step(Box::new(holds));
        self.named.push((name.into(), property));
        self
    }

    /// Their names, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.named.iter().map(|(name, _)| name.as_str())
    }

    /// The numbers of the circuit's own properties, if there are no others.
    pub(super) fn own(&self) -> Option<Vec<usize>> {
        let own = self.named.iter().map(|(_, property)| match property {
            Holds::Own(index, _) => Some(*index),
            _ => None,
        });
        own.collect()
    }

    /// Whether one of them looks at the registers after the edge.
    pub(super) fn look_ahead(&self) -> bool {
        let step = |(_, property): &(_, Holds<'_, C>)| matches!(property, Holds::Step(_));
        self.named.iter().any(step)
    }

    /// The first that is violated, and how. Without `next`, step properties are left out.
    #[inline]
    pub(super) fn check(
        &self,
        now: &Sample<'_, C>,
        next: Option<&Registers<C>>,
    ) -> Result<(), (&str, Fault)> {
        for (name, property) in &self.named {
            match (property, next) {
                (Holds::Own(index, signals), _) => match now.engine().property(*index) {
                    true => Ok(()),
                    false => Err(Fault {
                        signals: signals.iter().map(|&name| name.into()).collect(),
                        message: "does not hold".to_owned(),
                    }),
                },
                (Holds::Always(holds), _) => holds(now),
                (Holds::Step(holds), Some(next)) => holds(now, next),
                (Holds::Step(_), None) => Ok(()),
            }
            .map_err(|fault| (name.as_str(), fault))?;
        }
        Ok(())
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

/// Watches invariants during a simulated run and ends it at the first violation.
#[derive(Debug)]
pub struct Monitor<'a, C: Circuit> {
    invariants: &'a Invariants<'a, C>,
    look_ahead: bool,
}

impl<'a, C: Circuit> Monitor<'a, C> {
    /// A monitor for runs of a circuit.
    ///
    /// A step property costs a copy of all registers per tick, with the memories among them.
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
                message: format!("{name}: {}", fault.message),
            }),
        }
    }
}
