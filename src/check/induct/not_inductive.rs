//! Counterexamples to induction: a state that may never come, from which a property is violated.

use super::clauses::Answer;
use super::frames::Frames;
use super::search::Never;
use super::thread_time::ThreadTime;
use super::unrolled::{At, Unrolled, number};
use crate::check::blamed::below;
use crate::check::counterexample::save;
use crate::engine::sliced::NotSliced;
use crate::engine::{Flat, Place, Watch};
use crate::sim::{Described, Elaborated, RunError};
use crate::trace::value::show;
use crate::trace::{self, Clock};
use batsat::Lit;
use std::fmt;
use std::path::{Path, PathBuf};

/// Greatest number of clauses that are shown.
const SHOWN: usize = 5;
/// Greatest number of words of the state that are printed.
const WORDS: usize = 16;

/// State and input ports, by their places in the netlist.
#[derive(Debug)]
pub(super) struct Found {
    /// Words of the registers and memories.
    state: Vec<(Place, u64)>,
    /// Those from which the violation follows.
    needed: Vec<Place>,
    /// Words of the input ports, tick by tick.
    inputs: Vec<Vec<u64>>,
}

/// Returns a state in which a property holds with `held`, and is violated in the next tick; `None`
/// if there is none, or not enough time to find it.
pub(super) fn find(
    unrolled: &mut Unrolled<'_>,
    violated: At,
    held: &[At],
    until: ThreadTime,
) -> Result<Option<Found>, NotSliced> {
    if unrolled.violate(violated, held, until)? != Answer::Possible {
        return Ok(None);
    }
    let inputs = unrolled.inputs(violated.tick + 1)?;
    let mut goal = Vec::new();
    for at in held {
        goal.push(unrolled.frames.tick(at.tick)?.0.properties[at.property]);
    }
    let (frame, _) = unrolled.frames.tick(violated.tick)?;
    goal.push(!frame.properties[violated.property]);
    let Unrolled {
        frames, clauses, ..
    } = unrolled;
    let state = frames.state(0)?.clone();
    let bits = Frames::bits(&state);
    let free = frames.free(bits.len());
    let mut all = crate::engine::sliced::gates::HIGH;
    for wire in goal {
        all = frames.gates.and(all, wire);
    }
    let mut words: Vec<(Place, u64)> = Vec::new();
    for &(place, bit, wire) in &bits {
        if bit == 0 {
            words.push((place, 0));
        }
        if let Some((_, word)) = words.last_mut() {
            *word |= number(clauses, &[wire]) << bit;
        }
    }
    let now = |wire| {
        let lit = clauses.known(wire)?;
        Some(if clauses.is_high(wire) { lit } else { !lit })
    };
    let known: Vec<(Place, Lit)> = (bits.iter())
        .filter_map(|&(place, _, wire)| Some((place, now(wire)?)))
        .collect();
    let mut assumed: Vec<Lit> = free.into_iter().filter_map(now).collect();
    assumed.extend(known.iter().map(|(_, lit)| *lit));
    assumed.push(!clauses.lit(&frames.gates, all));
    let mut needed: Vec<Place> = match clauses.solve(&assumed, until) {
        Answer::Impossible => {
            let needed = known.iter().filter(|(_, lit)| clauses.is_needed(*lit));
            needed.map(|(place, _)| *place).collect()
        }
        Answer::Possible | Answer::Unknown => known.iter().map(|(place, _)| *place).collect(),
    };
    needed.dedup();
    Ok(Some(Found {
        state: words,
        needed,
        inputs,
    }))
}

impl Found {
    /// True if the state is in the set.
    pub fn is_in(&self, never: &Never) -> bool {
        never.iter().all(|at| {
            let mut state = self.state.iter();
            let word = state.find(|(place, _)| *place == at.place);
            word.is_some_and(|(_, word)| (word >> at.bit & 1 == 1) == at.high)
        })
    }
}

/// State that may never come from power-on, in which a property holds, and from which it is
/// violated a tick later.
///
/// Prints the words of the signals that matter, and the clauses that exclude the state.
#[derive(Debug, Clone)]
pub struct NotInductive {
    /// Name of the property.
    pub property: String,
    /// Registers from which the violation follows, with their values.
    pub signals: Vec<(String, String)>,
    /// Clauses that exclude the state, the shortest first, five at most. They hold for some ticks
    /// from power-on, perhaps always.
    pub clauses: Vec<Clause>,
    /// Number of other clauses that exclude the state.
    pub more: usize,
    /// Words of the registers and memories, by leaf.
    state: Vec<(usize, u64)>,
    inputs: Vec<Vec<u64>>,
}

impl NotInductive {
    /// Returns the state with names of signals; `None` if the engine does not confirm the
    /// violation, since reads of memories may give any word.
    pub(super) fn new(
        model: &Elaborated,
        property: (usize, &str),
        found: &Found,
        never: &[Never],
    ) -> Option<Self> {
        let flat = model.flat();
        let leaf = |place: &Place| flat.leaves.iter().position(|leaf| leaf == place);
        let state = found.state.iter();
        let state: Vec<_> = state
            .filter_map(|(place, word)| Some((leaf(place)?, *word)))
            .collect();
        let signals = found.state.iter().filter_map(|(place, word)| {
            let leaf = found.needed.contains(place).then(|| leaf(place))??;
            let declared = &model.outline().leaves[leaf];
            let name = below(model.name(), &declared.path()).to_owned();
            Some((name, show(declared.shape, declared.field.format, *word)))
        });
        let excluding = never.iter().filter(|never| found.is_in(never)).collect();
        let (clauses, more) = shortest(excluding);
        let clauses = clauses.into_iter().map(|never| Clause::new(model, never));
        let made = NotInductive {
            property: property.1.to_owned(),
            signals: signals.collect(),
            clauses: clauses.collect(),
            more,
            state,
            inputs: found.inputs.clone(),
        };
        made.is_confirmed(model, property.0).then_some(made)
    }

    /// True if the property holds in the first tick and is violated in the last.
    fn is_confirmed(&self, model: &Elaborated, property: usize) -> bool {
        let mut engine = model.engine(Watch::All);
        engine.interpret();
        for &(leaf, word) in &self.state {
            engine.set_leaf(leaf, word);
        }
        engine.wake();
        let mut held = Vec::new();
        for ports in &self.inputs {
            engine.drive_all(ports);
            engine.settle();
            held.push(engine.property(property));
            engine.edge();
        }
        matches!(held[..], [true, .., false])
    }

    /// Runs the circuit from the state and writes the waves and their save file into `dir`, named
    /// after circuit and property. Returns their paths.
    ///
    /// # Errors
    /// Returns an error if the files cannot be written.
    pub fn save(
        &self,
        circuit: &impl Described,
        clock: Clock,
        dir: &Path,
    ) -> Result<Vec<PathBuf>, RunError> {
        let comment = format!(
            "from a state that may never come: {} is violated in the last tick",
            self.property
        );
        let start = trace::Start {
            state: &self.state,
            comment: Some(&comment),
        };
        let of = (&self.inputs[..], start);
        save(circuit, (&self.property, "_induction"), of, clock, dir)
    }
}

impl fmt::Display for NotInductive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is not inductive", self.property)?;
        for (index, (signal, word)) in self.signals.iter().take(WORDS).enumerate() {
            let before = if index == 0 { ": from " } else { ", " };
            write!(f, "{before}{signal} = {word}")?;
        }
        if let Some(more @ 1..) = self.signals.len().checked_sub(WORDS) {
            write!(f, " and {more} more words")?;
        }
        write!(
            f,
            ", a state that may never come, it is violated a tick later"
        )?;
        for (index, clause) in self.clauses.iter().enumerate() {
            let before = match index {
                0 => "; excluded by what holds in the first ticks, perhaps always: ",
                _ => ", ",
            };
            write!(f, "{before}{clause}")?;
        }
        match self.more {
            0 => Ok(()),
            more => write!(f, ", and {more} more"),
        }
    }
}

/// Returns the shortest sets, each once and five at most, and the number of the others.
fn shortest(mut never: Vec<&Never>) -> (Vec<&Never>, usize) {
    never.sort_by_key(|never| never.len());
    let mut all: Vec<&Never> = Vec::new();
    for never in never {
        if !all.contains(&never) {
            all.push(never);
        }
    }
    let more = all.len().saturating_sub(SHOWN);
    all.truncate(SHOWN);
    (all, more)
}

/// Set of states that are never entered: some bits of registers have never these values together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Clause {
    /// Names of the bits, and their values.
    pub bits: Vec<(String, bool)>,
}

impl Clause {
    pub(super) fn new(model: &Elaborated, never: &Never) -> Self {
        let flat: &Flat = model.flat();
        let bits = never.iter().filter_map(|at| {
            let leaf = flat.leaves.iter().position(|leaf| *leaf == at.place)?;
            let declared = &model.outline().leaves[leaf];
            let path = declared.path();
            let path = below(model.name(), &path);
            let name = match declared.shape.width {
                1 => path.to_owned(),
                _ => format!("{path}[{}]", at.bit),
            };
            Some((name, at.high))
        });
        Clause {
            bits: bits.collect(),
        }
    }
}

impl fmt::Display for Clause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("never ")?;
        for (index, (name, high)) in self.bits.iter().enumerate() {
            let and = if index == 0 { "" } else { " & " };
            let not = if *high { "" } else { "!" };
            write!(f, "{and}{not}{name}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::induct::search::StateBit;

    #[test]
    fn the_shortest_clauses_are_shown() {
        let never = |bits: usize, register: u32| -> Never {
            let bits = (0..bits).map(|bit| StateBit {
                place: Place::Register(register),
                bit,
                high: true,
            });
            bits.collect()
        };
        let all: Vec<Never> = (0..8)
            .map(|index| never(9 - index as usize, index))
            .collect();
        let (shown, more) = shortest(all.iter().chain(&all[7..]).collect());
        let bits: Vec<usize> = shown.iter().map(|never| never.len()).collect();
        assert_eq!((bits, more), (vec![2, 3, 4, 5, 6], 3));
        let (shown, more) = shortest(all[..5].iter().collect());
        assert_eq!((shown.len(), more), (5, 0));
        let mut open = NotInductive {
            property: "it ends".to_owned(),
            signals: vec![("count".to_owned(), "7".to_owned())],
            clauses: vec![Clause {
                bits: vec![("state[0]".to_owned(), true), ("busy".to_owned(), false)],
            }],
            more,
            state: Vec::new(),
            inputs: Vec::new(),
        };
        let text = "it ends is not inductive: from count = 7, a state that may never come, it is \
                    violated a tick later; excluded by what holds in the first ticks, perhaps \
                    always: never state[0] & !busy";
        assert_eq!(open.to_string(), text);
        open.more = 3;
        assert_eq!(open.to_string(), format!("{text}, and 3 more"));
        open.signals = vec![open.signals[0].clone(); 20];
        let text = open.to_string();
        assert!(
            text.contains("count = 7 and 4 more words, a state"),
            "{text}"
        );
        assert_eq!(text.matches("count = 7").count(), 16);
    }
}
