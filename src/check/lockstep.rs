use super::Pair;
use super::{Fault, Verdict};
use crate::engine::Engine;
use crate::hdl::{Circuit, Outline, Pass, Path, outline::Shown, pack::input_widths};
use crate::netlist::{Field, Kind, Role, Shape};
use crate::sim::{Observer, RunError, Sample};
use crate::trace::value::number;
use std::fmt;
use std::ops::ControlFlow;

/// Reason why two circuits cannot be compared.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LockstepError {
    /// Output ports that only one of the circuits has.
    #[error("ports out without partner: {}", .0.join(", "))]
    Unpaired(Vec<String>),
    /// A requested signal does not exist, or exists twice.
    #[error("{circuit} has not exactly one signal {signal}")]
    NoSuchSignal {
        /// Circuit.
        circuit: &'static str,
        /// Signal.
        signal: String,
    },
    /// Empty comparison.
    #[error("there is no signal to compare")]
    Nothing,
}

/// Comparison of two circuits in every tick.
///
/// Values are compared as numbers, so a signal may be wider in one circuit. Use
/// [`compare`](Self::compare) as an invariant of `reach` to prove that two circuits agree under
/// every input sequence, or a `Lockstep` as an observer of a run.
///
/// ```no_run
/// # use motion_rtl::{check::{Invariants, Lockstep, Pair, reach}, hdl::Circuit};
/// # fn agree<A: Circuit, B: Circuit>(left: A, right: B) -> Result<(), Box<dyn std::error::Error>> {
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

/// Two signals that must be equal: their leaves in each circuit, and their paths.
#[derive(Debug, Clone)]
struct Compared {
    left: (usize, Shape),
    right: (usize, Shape),
    paths: [String; 2],
}

impl Lockstep {
    /// Compares the output ports (public registers and nets) of equal names.
    ///
    /// # Errors
    /// Returns an error if an output port has no partner, or there are none.
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

    /// Compares pairs of named signals, left and right: registers and nets, public or not.
    ///
    /// # Errors
    /// Returns an error if a signal does not exist, or the list is empty.
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
        let ports = input_widths(&pair.left).len();
        // The registers of both circuits come before the nets of both, each with its input ports;
        // the left circuit comes first.
        let of_left = |place: usize| match place.checked_sub(left.registers) {
            None => place,
            Some(net) => left.registers + right.registers + ports + net,
        };
        let of_right = |place: usize| match place.checked_sub(right.registers) {
            None => left.registers + place,
            Some(net) => left.leaves.len() + right.registers + 2 * ports + net,
        };
        let compared: Vec<_> = signals
            .iter()
            .map(|&(a, b)| {
                let (l, r) = (
                    left.place(pair.left.name(), a)?,
                    right.place(pair.right.name(), b)?,
                );
                Ok(Compared {
                    left: (of_left(l), left.leaves[l].shape),
                    right: (of_right(r), right.leaves[r].shape),
                    paths: [
                        format!("{}.{a}", Pair::<A, B>::SCOPES[0]),
                        format!("{}.{b}", Pair::<A, B>::SCOPES[1]),
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
            .map(|name| format!("{}.{name}", Pair::<A, B>::SCOPES[0]))
            .chain(of_right.map(|name| format!("{}.{name}", Pair::<A, B>::SCOPES[1])))
            .collect();
        Ok(Lockstep { compared, unpaired })
    }

    /// Returns the output ports that are not compared.
    pub fn unpaired(&self) -> &[String] {
        &self.unpaired
    }

    /// Compares all signals in this tick; returns the first difference as a fault.
    ///
    /// # Errors
    /// Returns a [`Fault`] if the circuits differ.
    pub fn compare<A: Circuit, B: Circuit>(&self, now: &Sample<'_, Pair<A, B>>) -> Verdict {
        let engine = now.engine();
        for Compared {
            left: l,
            right: r,
            paths,
        } in &self.compared
        {
            let (a, b) = (value(engine, *l), value(engine, *r));
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

impl<A: Circuit, B: Circuit> Observer<Pair<A, B>> for Lockstep {
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

/// Returns the number in a leaf of the pair, counted after the input ports.
fn value(engine: &Engine, (leaf, shape): (usize, Shape)) -> i128 {
    let first = engine.flat().part(Role::Register).start;
    number(shape, engine.word(first + leaf))
}

fn ports_out<C: Circuit>(circuit: &C) -> Vec<String> {
    Leaves::of(circuit).public().map(str::to_owned).collect()
}

/// Leaves of the registers and nets of one circuit.
#[derive(Default)]
struct Leaves {
    leaves: Vec<Leaf>,
    /// Number of registers; they come first.
    registers: usize,
    path: Path,
    /// For every struct entered: true if it and all structs around it are public.
    public: Vec<bool>,
}

struct Leaf {
    name: String,
    /// True if the leaf is an output port.
    public: bool,
    shape: Shape,
}

impl Leaves {
    fn of<C: Circuit>(circuit: &C) -> Self {
        let mut leaves = Leaves::default();
        let mut shown = Shown {
            outline: &mut leaves,
            pass: Pass::Registers,
        };
        circuit.make_shapes(Role::Register, &mut shown);
        leaves.registers = leaves.leaves.len();
        let mut shown = Shown {
            outline: &mut leaves,
            pass: Pass::Nets,
        };
        circuit.make_shapes(Role::Net, &mut shown);
        leaves
    }

    fn public(&self) -> impl Iterator<Item = &str> {
        let ports = self.leaves.iter().filter(|leaf| leaf.public);
        ports.map(|leaf| leaf.name.as_str())
    }

    fn place(&self, circuit: &'static str, signal: &str) -> Result<usize, LockstepError> {
        let mut places = (0..self.leaves.len()).filter(|&place| self.leaves[place].name == signal);
        match (places.next(), places.next()) {
            (Some(place), None) => Ok(place),
            _ => Err(LockstepError::NoSuchSignal {
                circuit,
                signal: signal.to_owned(),
            }),
        }
    }

    fn is_open(&self) -> bool {
        self.public.last().copied().unwrap_or(true)
    }

    fn push(&mut self, field: &'static Field, shape: Shape, public: bool) {
        let mut name = self.path.scopes().join(".");
        if !name.is_empty() {
            name.push('.');
        }
        name += &self.path.name(field);
        let public = public && self.is_open() && self.path.role() != Role::Input;
        self.leaves.push(Leaf {
            name,
            public,
            shape,
        });
    }
}

impl Outline for Leaves {
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
    fn leaf(&mut self, field: &'static Field, shape: Shape) {
        self.push(field, shape, field.public);
    }
    fn memory(&mut self, field: &'static Field, label: &'static Field, words: usize, width: usize) {
        // Words of a memory are as visible as the memory.
        self.enter(field);
        for index in 0..words {
            self.element(index);
            let kind = Kind::Unsigned;
            self.push(label, Shape { kind, width }, true);
        }
        self.leave();
    }
}
