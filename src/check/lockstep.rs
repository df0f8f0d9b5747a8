use super::{Fault, Pair, SamePorts, Verdict};
use crate::kernel::{
    Circuit, Field, Observer, Path, Probe, Role, RunError, Sample, Shape, Signals, Words,
};
use crate::logic::Sim;
use crate::trace::value::number;
use std::fmt;
use std::ops::ControlFlow;

/// Why two circuits cannot be compared.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LockstepError {
    /// Ports out that only one of the circuits has.
    #[error("ports out without partner: {}", .0.join(", "))]
    Unpaired(Vec<String>),
    /// A signal that was asked for is not there, or is there twice.
    #[error("{circuit} has not exactly one signal {signal}")]
    NoSuchSignal {
        /// The circuit.
        circuit: &'static str,
        /// The signal.
        signal: String,
    },
    /// There is nothing to compare.
    #[error("there is no signal to compare")]
    Nothing,
}

/// The comparison of two circuits on every tick.
///
/// Values are compared as numbers, so a signal may be wider in one of them. Use
/// [`compare`](Self::compare) as an invariant with `reach` to prove that two circuits agree under
/// every input sequence, or the whole as an observer of a run.
///
/// ```no_run
/// # use motion_rtl::{check::*, kernel::*};
/// # fn agree<A: Circuit, B: SamePorts<A>>(left: A, right: B)
/// # -> Result<(), Box<dyn std::error::Error>> {
/// let pair = Pair { left, right };
/// let lockstep = Lockstep::by_name(&pair)?;
/// let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
/// let outcome = reach(&pair, &agree).run()?;
/// # Ok(()) }
/// ```
#[derive(Debug, Clone)]
pub struct Lockstep {
    compared: Vec<Compared>,
    unpaired: Vec<String>,
}

/// Two signals that shall be equal: their places in the walk of each circuit, and their paths.
#[derive(Debug, Clone)]
struct Compared {
    left: usize,
    right: usize,
    paths: [String; 2],
}

impl Lockstep {
    /// Compares the ports out (public registers and nets) of the same name.
    ///
    /// # Errors
    /// There are ports out without partner, or no ports out at all.
    pub fn by_name<A: Circuit, B: Circuit>(pair: &Pair<A, B>) -> Result<Self, LockstepError> {
        let names: Vec<_> = ports_out(&pair.left);
        let names: Vec<_> = names
            .iter()
            .map(|name| (name.as_str(), name.as_str()))
            .collect();
        let right = ports_out(&pair.right);
        let shared = |(name, _): &(&str, &str)| right.iter().any(|other| other == name);
        let shared: Vec<_> = names.into_iter().filter(shared).collect();
        let lockstep = Lockstep::pairing(pair, &shared)?;
        match (lockstep.unpaired.is_empty(), lockstep.compared.is_empty()) {
            (true, false) => Ok(lockstep),
            (true, true) => Err(LockstepError::Nothing),
            (false, _) => Err(LockstepError::Unpaired(lockstep.unpaired)),
        }
    }

    /// Compares the signals named in pairs, left and right: registers and nets, public or not.
    ///
    /// # Errors
    /// One of them does not exist, or the list is empty.
    pub fn of<A: Circuit, B: Circuit>(
        pair: &Pair<A, B>,
        signals: &[(&str, &str)],
    ) -> Result<Self, LockstepError> {
        if signals.is_empty() {
            return Err(LockstepError::Nothing);
        }
        Lockstep::pairing(pair, signals)
    }

    fn pairing<A: Circuit, B: Circuit>(
        pair: &Pair<A, B>,
        signals: &[(&str, &str)],
    ) -> Result<Self, LockstepError> {
        let (left, right) = (Leaves::of(&pair.left), Leaves::of(&pair.right));
        let compared: Vec<_> = signals
            .iter()
            .map(|&(a, b)| {
                Ok(Compared {
                    left: left.place::<A>(a)?,
                    right: right.place::<B>(b)?,
                    paths: [
                        format!("{}.{a}", Pair::<A, B>::LEFT),
                        format!("{}.{b}", Pair::<A, B>::RIGHT),
                    ],
                })
            })
            .collect::<Result<_, _>>()?;
        let of_left = left
            .public()
            .filter(|name| !signals.iter().any(|(a, _)| a == name));
        let of_right = right
            .public()
            .filter(|name| !signals.iter().any(|(_, b)| b == name));
        let unpaired = of_left
            .map(|name| format!("{}.{name}", Pair::<A, B>::LEFT))
            .chain(of_right.map(|name| format!("{}.{name}", Pair::<A, B>::RIGHT)))
            .collect();
        Ok(Lockstep { compared, unpaired })
    }

    /// The ports out that are not compared.
    pub fn unpaired(&self) -> &[String] {
        &self.unpaired
    }

    /// The first signal in which the two circuits differ, as an invariant.
    ///
    /// # Errors
    /// They differ.
    pub fn compare<A, B>(&self, now: &Sample<'_, Pair<A, B>>) -> Verdict
    where
        A: Circuit,
        B: SamePorts<A>,
    {
        let left = Numbers::of(&now.q.left, &now.w.left);
        let right = Numbers::of(&now.q.right, &now.w.right);
        for Compared {
            left: l,
            right: r,
            paths,
        } in &self.compared
        {
            let (a, b) = (left.0[*l], right.0[*r]);
            if a != b {
                let [left, right] = paths;
                return Err(Fault {
                    signals: paths.to_vec(),
                    message: format!("{left} is {a}, {right} is {b}"),
                });
            }
        }
        Ok(())
    }
}

impl fmt::Display for Lockstep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, Compared { paths: [a, b], .. }) in self.compared.iter().enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            write!(f, "{comma}{a} = {b}")?;
        }
        if !self.unpaired.is_empty() {
            write!(f, "; not compared: {}", self.unpaired.join(", "))?;
        }
        Ok(())
    }
}

impl<A, B> Observer<Pair<A, B>> for Lockstep
where
    A: Circuit,
    B: SamePorts<A>,
{
    fn sample(&mut self, now: &Sample<'_, Pair<A, B>>) -> Result<ControlFlow<()>, RunError> {
        match self.compare(now) {
            Ok(()) => Ok(ControlFlow::Continue(())),
            Err(Fault { signals, message }) => Err(RunError::Violation {
                tick: now.tick,
                signals,
                message,
            }),
        }
    }
}

fn ports_out<C: Circuit>(circuit: &C) -> Vec<String> {
    Leaves::of(circuit).public().map(str::to_owned).collect()
}

/// The leaves of the registers and nets of one circuit: name, and whether it is a port out.
#[derive(Default)]
struct Leaves {
    leaves: Vec<(String, bool)>,
    path: Path,
    /// For every struct entered, whether it and all around it are public.
    public: Vec<bool>,
}

impl Leaves {
    fn of<C: Circuit>(circuit: &C) -> Self {
        let mut leaves = Leaves::default();
        Sample::at_power_on(circuit, |now| walk(now.q, now.w, &mut leaves));
        leaves
    }

    fn public(&self) -> impl Iterator<Item = &str> {
        let ports = self.leaves.iter().filter(|(_, public)| *public);
        ports.map(|(name, _)| name.as_str())
    }

    fn place<C: Circuit>(&self, signal: &str) -> Result<usize, LockstepError> {
        let mut places = (0..self.leaves.len()).filter(|&place| self.leaves[place].0 == signal);
        match (places.next(), places.next()) {
            (Some(place), None) => Ok(place),
            _ => Err(LockstepError::NoSuchSignal {
                circuit: C::NAME,
                signal: signal.to_owned(),
            }),
        }
    }

    fn is_open(&self) -> bool {
        self.public.last().copied().unwrap_or(true)
    }

    fn push(&mut self, field: &'static Field, public: bool) {
        let mut name = self.path.scopes().join(".");
        if !name.is_empty() {
            name.push('.');
        }
        name += &self.path.name(field);
        let public = public && self.is_open() && self.path.role() != Role::Input;
        self.leaves.push((name, public));
    }
}

impl Probe for Leaves {
    fn enter(&mut self, field: &'static Field) {
        // A part of a circuit has no name and hides nothing.
        let public = self.is_open() && (field.public || field.name.is_empty());
        self.public.push(public);
        self.path.enter(field);
    }
    fn leave(&mut self) {
        self.public.pop();
        self.path.leave();
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn leaf(&mut self, field: &'static Field, _: Shape, _: u64) {
        self.push(field, field.public);
    }
    fn memory(&mut self, field: &'static Field, words: &dyn Words) {
        // The words of a memory are as visible as the memory.
        Probe::enter(self, field);
        for index in 0..words.len() {
            Probe::element(self, index);
            self.push(words.label(), true);
        }
        Probe::leave(self);
    }
}

/// The values of the registers and nets of one circuit, in the order of [`Leaves`].
struct Numbers(Vec<i128>);

impl Numbers {
    #[inline]
    fn of<Q: Signals<Sim>, W: Signals<Sim>>(q: &Q, w: &W) -> Self {
        let mut numbers = Numbers(Vec::new());
        walk(q, w, &mut numbers);
        numbers
    }
}

impl Probe for Numbers {
    #[inline]
    fn leaf(&mut self, _: &'static Field, shape: Shape, bits: u64) {
        self.0.push(number(shape, bits));
    }
}

#[inline]
fn walk<Q: Signals<Sim>, W: Signals<Sim>, P: Probe>(q: &Q, w: &W, probe: &mut P) {
    q.visit(const { &Field::part(Role::Register) }, probe);
    w.visit(const { &Field::part(Role::Net) }, probe);
}
