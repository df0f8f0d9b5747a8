use crate::engine::{Engine, EngineError};
use crate::hdl::{self, Circuit, Model, Observer, Registers, RunError, Sample};
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
    Always(Box<Always<'f, C>>),
    Step(Box<Step<'f, C>>),
}

/// The names of invariants, and which of them are the circuit's own. Nothing of it depends on the
/// circuit's type.
#[derive(Debug, Default)]
struct Names {
    /// In the order in which they are checked.
    all: Vec<String>,
    /// The signals that the circuit's own are about; these come first, in their own order. A step
    /// property is one of what this edge is about to do.
    own: Vec<&'static [&'static str]>,
    /// Whether one of the others looks at the registers after the edge.
    look_ahead: bool,
}

impl Names {
    fn of(model: Result<Model, EngineError>) -> Self {
        let mut names = Names::default();
        let Ok(model) = model else {
            return names;
        };
        let module = model.design().modules.last();
        for known in module.map_or(&[][..], |module| &module.assertions) {
            names.all.push(known.name.to_owned());
            names.own.push(known.signals);
        }
        names
    }

    /// The first of the circuit's own that does not hold.
    fn violated(&self, engine: &Engine) -> Option<(&str, Fault)> {
        let index = (0..self.own.len()).find(|index| !engine.property(*index))?;
        let fault = Fault {
            signals: self.own[index].iter().map(|&name| name.into()).collect(),
            message: "does not hold".to_owned(),
        };
        Some((&self.all[index], fault))
    }

    /// The numbers of the circuit's own, if there are no others.
    fn only_own(&self) -> Option<Vec<usize>> {
        (self.own.len() == self.all.len()).then(|| (0..self.own.len()).collect())
    }
}

/// Named properties that hold on every tick: proved by [`reach`](super::reach()), watched by a
/// [`Monitor`].
///
/// They are checked in the order in which they were added. A property must not depend on
/// [`Sample::tick`]: `reach` comes to every transition once, on a shortest way.
pub struct Invariants<'f, C: Circuit> {
    names: Names,
    /// Those that are not the circuit's own.
    others: Vec<Holds<'f, C>>,
}

impl<'f, C: Circuit> Invariants<'f, C> {
    /// None.
    pub fn new() -> Self {
        Invariants {
            names: Names::default(),
            others: Vec::new(),
        }
    }

    /// The circuit's [properties](Circuit::properties).
    ///
    /// Of what is no netlist there are none: neither is there a proof of it, nor a run.
    pub fn of(circuit: &C) -> Self {
        Invariants {
            names: Names::of(hdl::model(circuit)),
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

    /// Their names, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.names.all.iter().map(String::as_str)
    }

    /// The numbers of the circuit's own properties, if there are no others.
    pub(super) fn own(&self) -> Option<Vec<usize>> {
        self.names.only_own()
    }

    /// Whether one of them looks at the registers after the edge.
    pub(super) fn look_ahead(&self) -> bool {
        self.names.look_ahead
    }

    /// The first that is violated, and how. Without `next`, step properties are left out.
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
