//! Single faults, put into a circuit while it is elaborated.
//!
//! A fault is known by where its node was written, so that it is the same one at any width. It is in
//! every instance of the circuit, as a slip in its source would be; properties see what it does, and
//! are not changed by it.

mod change;
mod find;
#[cfg(test)]
mod tests;

use super::build::Elaboration;
use super::elaborate::Nets;
use super::record::Site;
use std::cell::RefCell;
use std::fmt;

/// A single fault of a circuit; it prints as where it is and what it changes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Mutation {
    /// The circuit's name.
    pub circuit: String,
    place: Place,
    change: Change,
}

/// Where a fault is.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Place {
    /// What is computed there; of several that the same place makes, the one of this number.
    Node {
        /// The operator.
        site: Site,
        /// What it is: two of one place need not be the same.
        kind: &'static str,
        /// Its number among those of its kind from 0.
        nth: usize,
    },
    /// A register or net, by its name.
    Signal(String),
    /// A memory, by its name.
    Memory(String),
    /// A port in of a part: the part, and the port.
    Port(String, String),
}

/// What a fault changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Change {
    /// Another operator: a difference for a sum, or for and, at least for equal, and so on.
    Operator,
    /// The operands are exchanged.
    Exchanged,
    /// The first operand alone.
    First,
    /// The second operand alone.
    Second,
    /// Not inverted, not negated, not extended by its sign.
    Plain,
    /// A choice that always takes the first.
    Then,
    /// A choice that always takes the second.
    Otherwise,
    /// The choice in its second comes first.
    Priority,
    /// A constant operand, by its number, is one more; a bit is the other one.
    More(usize),
    /// One less.
    Less(usize),
    /// A slice from one bit higher, a shift by one bit more.
    Up,
    /// The other way round.
    Down,
    /// It holds another value at power-on.
    PowerOn,
    /// A signal is low, a memory never written.
    Low,
    /// A memory is written in every tick.
    High,
    /// A port takes what the next one takes, and the other way round.
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
    /// What was there before comes back, also where `work` panics.
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

/// The faults that there are of a circuit inside what `work` elaborates.
pub(crate) fn mutations<T>(circuit: &str, work: impl FnOnce() -> T) -> (T, Vec<Mutation>) {
    let circuit = circuit.to_owned();
    let found = Vec::new();
    match with(Task::Find { circuit, found }, work) {
        (worked, Some(Task::Find { found, .. })) => (worked, found),
        (worked, _) => (worked, Vec::new()),
    }
}

/// What `work` elaborates, with a fault in it; nothing where the fault has no place in it.
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

/// A module has everything but its properties: its faults are noted, or one is put into it.
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
            *done |= change::put(mutation, builder, nets, modules);
            // A property is not to share what is wrong now.
            builder.known.clear();
        }
        _ => {}
    });
}
