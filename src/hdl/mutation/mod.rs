//! Single faults that are put into a circuit during elaboration.
//!
//! The source location of its node identifies a fault, so a fault is the same at any width. It
//! affects every instance of the circuit, as a slip in the source would, except for instances in
//! which it is impossible: words of different widths cannot be exchanged. Properties see its effect but are not
//! changed themselves.

mod change;
mod find;
#[cfg(test)]
pub(crate) mod tests;

use super::build::Elaboration;
use super::elaborate::Nets;
use crate::netlist::Site;
use std::cell::RefCell;
use std::fmt;

/// Single fault of a circuit; prints its place and its change.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Mutation {
    /// Name of the circuit.
    pub circuit: String,
    place: Place,
    change: Change,
}

/// Place of a fault.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Place {
    /// Node computed at a location; `nth` distinguishes several nodes of one location.
    Node {
        /// Location of the operator.
        site: Site,
        /// Kind of node: one location can make nodes of several kinds.
        kind: &'static str,
        /// Number among the nodes of that kind, from 0.
        nth: usize,
    },
    /// Register or net, by name.
    Signal(String),
    /// Memory, by name.
    Memory(String),
    /// Input port of a part: the part, and the port.
    Port(String, String),
}

/// Change made by a fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Change {
    /// Another operator: a difference for a sum, `or` for `and`, at least for equal, and so on.
    Operator,
    /// Exchanged operands.
    Exchanged,
    /// First operand alone.
    First,
    /// Second operand alone.
    Second,
    /// No inversion, no negation, or no sign extension.
    Plain,
    /// First word of a choice, always.
    Then,
    /// Second word of a choice, always.
    Otherwise,
    /// Order of two nested choices exchanged.
    Priority,
    /// Constant operand, by number, increased by one; a single bit is inverted.
    More(usize),
    /// Constant operand, by number, decreased by one.
    Less(usize),
    /// Slice from one bit higher, or a shift by one bit more.
    Up,
    /// Slice from one bit lower, or a shift by one bit less.
    Down,
    /// Another power-on value.
    PowerOn,
    /// Signal low, or memory never written.
    Low,
    /// Memory written in every tick.
    High,
    /// Port exchanged with the next one.
    Crossed,
}

impl fmt::Display for Mutation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Place::Node { site, kind, nth } => {
                write!(f, "{}:{}:{}: {kind}", site.file, site.line, site.column)?;
                if *nth > 0 {
                    write!(f, " {}", nth + 1)?;
                }
            }
            Place::Signal(name) => write!(f, "{name}")?,
            Place::Memory(name) => write!(f, "memory {name}")?,
            Place::Port(part, port) => write!(f, "{part}.{port}")?,
        }
        f.write_str(": ")?;
        f.write_str(match self.change {
            Change::Operator => "another operator",
            Change::Exchanged => "operands exchanged",
            Change::First => "its first operand alone",
            Change::Second => "its second operand alone",
            Change::Plain => "left out",
            Change::Then => "always the first",
            Change::Otherwise => "always the second",
            Change::Priority => "the next choice comes first",
            Change::PowerOn => "another value at power-on",
            Change::Low => "low",
            Change::High => "high",
            Change::Crossed => "crossed with the next one",
            Change::Up => "one bit more",
            Change::Down => "one bit less",
            Change::More(operand) => return write!(f, "constant {operand} one more"),
            Change::Less(operand) => return write!(f, "constant {operand} one less"),
        })
    }
}

enum Task {
    Find {
        circuit: String,
        found: Vec<Mutation>,
    },
    Put {
        mutation: Mutation,
        done: bool,
    },
}

thread_local! {
    static TASK: RefCell<Option<Task>> = const { RefCell::new(None) };
}

fn with<T>(task: Task, work: impl FnOnce() -> T) -> (T, Option<Task>) {
    /// Restores the previous task, also if `work` panics.
    struct Back(Option<Task>);
    impl Drop for Back {
        fn drop(&mut self) {
            let before = self.0.take();
            TASK.with(|task| *task.borrow_mut() = before);
        }
    }
    let back = Back(TASK.with(|slot| slot.borrow_mut().replace(task)));
    let worked = work();
    let task = TASK.with(|slot| slot.borrow_mut().take());
    drop(back);
    (worked, task)
}

/// Returns the possible faults of a circuit inside the one that `work` elaborates.
pub(crate) fn mutations<T>(circuit: &str, work: impl FnOnce() -> T) -> (T, Vec<Mutation>) {
    let circuit = circuit.to_owned();
    let found = Vec::new();
    match with(Task::Find { circuit, found }, work) {
        (worked, Some(Task::Find { found, .. })) => (worked, found),
        (worked, _) => (worked, Vec::new()),
    }
}

/// Elaborates by `work` with a fault; returns `None` if the fault has no place there.
pub(crate) fn mutated<T>(mutation: &Mutation, work: impl FnOnce() -> T) -> Option<T> {
    let mutation = mutation.clone();
    let put = Task::Put {
        mutation,
        done: false,
    };
    match with(put, work) {
        (worked, Some(Task::Put { done: true, .. })) => Some(worked),
        _ => None,
    }
}

/// Visits a module that is complete except for its properties: records its faults, or puts one
/// into it.
pub(super) fn visit(circuit: &str, elaboration: &mut Elaboration, nets: &mut Nets) {
    let Elaboration { open, modules, .. } = elaboration;
    let Some(builder) = open.last_mut() else {
        return;
    };
    TASK.with(|slot| match &mut *slot.borrow_mut() {
        Some(Task::Find { circuit: of, found }) if *of == circuit => {
            for mutation in find::all(circuit, builder, nets, modules) {
                if !found.contains(&mutation) {
                    found.push(mutation);
                }
            }
        }
        Some(Task::Put { mutation, done }) if mutation.circuit == circuit => {
            // What is a fault at one width may be impossible at another.
            if find::all(circuit, builder, nets, modules).contains(mutation) {
                *done |= change::put(mutation, builder, nets, modules);
            }
            // A property must not share the faulty nodes.
            builder.known.clear();
        }
        _ => {}
    });
}
