//! Search for an invariant of which a property follows, clause by clause (IC3, also called
//! property-directed reachability).
//!
//! Level 0 is the state at power-on. Level n contains every state that is reached in at most n
//! edges; its cubes are sets of states that are not. A level that equals the next one contains
//! all reachable states.

mod levels;

use super::clauses::{Answer, Clauses};
use super::frames::{Cone, Frames, Start};
use super::thread_time::ThreadTime;
use super::unrolled::number;
use crate::engine::sliced::NotSliced;
use crate::engine::sliced::gates::{HIGH, Wire};
use crate::engine::{Flat, Place};
use batsat::Lit;
use levels::Level;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Bit of the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct StateBit {
    pub place: Place,
    pub bit: usize,
    pub high: bool,
}

/// Set of states: those with these bits, by index and level, sorted.
type Cube = Vec<(usize, bool)>;

/// Set of states that is never entered.
pub(super) type Never = Vec<StateBit>;

/// Result of a search.
#[derive(Debug)]
pub(super) enum Searched {
    /// No state of these sets is reached, and in all others the property holds.
    Invariant(Vec<Never>),
    /// Input ports of a run from power-on, tick by tick, that violates the property in the last.
    Trace(Vec<Vec<u64>>),
    /// The time is over. States of these sets are not reached within some edges.
    Open(Vec<Never>),
}

/// Reason why a search ends early.
enum End {
    /// The time is over.
    Time,
    /// A tick has too many gates.
    Gates,
}

impl From<NotSliced> for End {
    fn from(_: NotSliced) -> Self {
        End::Gates
    }
}

/// Set of states from which these input ports lead into the set of the next obligation, or violate
/// the property.
struct Obligation {
    cube: Cube,
    ports: Vec<u64>,
    next: Option<usize>,
}

struct Search<'f> {
    frames: Frames<'f>,
    places: Vec<(Place, usize)>,
    /// Bits of the state before and after the edge, and at power-on.
    bits: Vec<Wire>,
    next: Vec<Wire>,
    power_on: Vec<bool>,
    /// Bits that are no state: input ports and reads of memories that may give any word.
    free: Vec<Wire>,
    /// Holds in every tick.
    known: Vec<Wire>,
    property: Wire,
    clauses: Clauses,
    /// Solver without any clause that is known of reachable states.
    lifting: Clauses,
    levels: Vec<Level>,
    until: ThreadTime,
}

/// Searches for an invariant or a trace of a property; `known` hold in every tick.
///
/// # Errors
/// Returns an error if a tick has too many gates.
pub(super) fn search(
    flat: &Flat,
    cone: &Cone,
    property: usize,
    known: &[usize],
    until: ThreadTime,
) -> Result<Searched, NotSliced> {
    let mut search = Search::new(flat, cone, property, known, until)?;
    match search.run() {
        Ok(searched) => Ok(searched),
        Err(End::Gates) => Err(NotSliced),
        Err(End::Time) => {
            let cubes = search.levels.iter().flat_map(|level| &level.cubes);
            Ok(Searched::Open(
                cubes.map(|cube| search.never(cube)).collect(),
            ))
        }
    }
}

impl<'f> Search<'f> {
    fn new(
        flat: &'f Flat,
        cone: &'f Cone,
        property: usize,
        known: &[usize],
        until: ThreadTime,
    ) -> Result<Self, NotSliced> {
        let mut frames = Frames::new(flat, cone, Start::Any);
        let next = Frames::bits(frames.state(1)?);
        let bits = Frames::bits(frames.state(0)?);
        let free = frames.free(bits.len());
        let (frame, _) = frames.tick(0)?;
        let (property, properties) = (frame.properties[property], frame.properties.clone());
        let mut powered = Frames::new(flat, cone, Start::PowerOn);
        let power_on = Frames::bits(powered.state(0)?);
        let mut search = Search {
            places: bits.iter().map(|&(place, bit, _)| (place, bit)).collect(),
            bits: bits.into_iter().map(|(_, _, wire)| wire).collect(),
            next: next.into_iter().map(|(_, _, wire)| wire).collect(),
            power_on: power_on.into_iter().map(|bit| bit.2 == HIGH).collect(),
            known: known.iter().map(|&index| properties[index]).collect(),
            free,
            frames,
            property,
            clauses: Clauses::new(),
            lifting: Clauses::new(),
            levels: Vec::new(),
            until,
        };
        for wire in search.known.clone() {
            let lit = search.lit(wire);
            search.clauses.assert(&[lit]);
        }
        Ok(search)
    }

    fn run(&mut self) -> Result<Searched, End> {
        self.deepen();
        self.deepen();
        loop {
            let top = self.levels.len() - 1;
            while let Some(bad) = self.bad(top)? {
                if let Some(trace) = self.block(bad, top)? {
                    return Ok(Searched::Trace(trace));
                }
            }
            self.deepen();
            for level in 1..=top {
                self.propagate(level)?;
                if self.levels[level].cubes.is_empty() {
                    let above = self.levels[level + 1..].iter();
                    let cubes = above.flat_map(|level| &level.cubes);
                    let never = cubes.map(|cube| self.never(cube));
                    return Ok(Searched::Invariant(never.collect()));
                }
            }
        }
    }

    fn never(&self, cube: &Cube) -> Never {
        let bits = cube.iter().map(|&(index, high)| {
            let (place, bit) = self.places[index];
            StateBit { place, bit, high }
        });
        bits.collect()
    }

    fn lit(&mut self, wire: Wire) -> Lit {
        self.clauses.lit(&self.frames.gates, wire)
    }

    fn solve(&mut self, assumed: &[Lit]) -> Result<bool, End> {
        match self.clauses.solve(assumed, self.until) {
            Answer::Possible => Ok(true),
            Answer::Impossible => Ok(false),
            Answer::Unknown => Err(End::Time),
        }
    }

    fn lits(&mut self, cube: &Cube, of: fn(&Self) -> &Vec<Wire>) -> Vec<Lit> {
        let mut lits = Vec::new();
        for &(index, high) in cube {
            let wire = of(self)[index];
            let lit = self.lit(wire);
            lits.push(if high { lit } else { !lit });
        }
        lits
    }

    /// Returns states of a level in which the property is violated.
    fn bad(&mut self, level: usize) -> Result<Option<Obligation>, End> {
        let property = self.lit(self.property);
        let mut assumed = self.inside(level);
        assumed.push(!property);
        if !self.solve(&assumed)? {
            return Ok(None);
        }
        let goal = !self.property;
        self.obligation(&[goal], None).map(Some)
    }

    /// Returns the set of states around that of the assignment found last, from which the same
    /// input ports make all of `goal` high.
    fn obligation(&mut self, goal: &[Wire], next: Option<usize>) -> Result<Obligation, End> {
        let (frame, gates) = self.frames.tick(0)?;
        let ports = frame.ports.iter();
        let ports = ports.map(|word| number(&self.clauses, word)).collect();
        let lifting = &mut self.lifting;
        let asked = lifting.free();
        let mut clause = vec![!asked];
        for &wire in goal.iter().chain(&self.known) {
            clause.push(!lifting.lit(gates, wire));
        }
        lifting.assert(&clause);
        let of = |wire: Wire, lifting: &Clauses| {
            let lit = lifting.known(wire)?;
            Some(if self.clauses.is_high(wire) {
                lit
            } else {
                !lit
            })
        };
        let mut assumed = vec![asked];
        assumed.extend(self.free.iter().filter_map(|&wire| of(wire, lifting)));
        let bits = self.bits.iter().enumerate();
        let bits = bits.filter_map(|(index, &wire)| Some((index, wire, of(wire, lifting)?)));
        let bits: Vec<_> = bits.collect();
        assumed.extend(bits.iter().map(|&(_, _, lit)| lit));
        let answer = lifting.solve(&assumed, self.until);
        if answer == Answer::Unknown {
            return Err(End::Time);
        }
        let needed = |lit: Lit| answer == Answer::Possible || lifting.is_needed(lit);
        let bits = bits.into_iter().filter(|&(_, _, lit)| needed(lit));
        let cube = bits.map(|(index, wire, _)| (index, self.clauses.is_high(wire)));
        let cube = cube.collect();
        lifting.assert(&[!asked]);
        Ok(Obligation { cube, ports, next })
    }

    /// True if the state at power-on is in the set.
    fn has_power_on(&self, cube: &Cube) -> bool {
        let mut bits = cube.iter();
        bits.all(|&(index, high)| self.power_on[index] == high)
    }

    /// Shows that the states of `bad` are not in a level, or returns a trace from power-on.
    fn block(&mut self, bad: Obligation, level: usize) -> Result<Option<Vec<Vec<u64>>>, End> {
        let mut all = vec![bad];
        let mut open = BinaryHeap::from([Reverse((level, 0))]);
        while let Some(Reverse((level, index))) = open.pop() {
            let cube = all[index].cube.clone();
            if level == 0 || self.has_power_on(&cube) {
                return Ok(Some(trace(&all, index)));
            }
            if self.is_blocked(&cube, level) {
                continue;
            }
            match self.apart(&cube, level - 1)? {
                Some(smaller) => {
                    let above = self.exclude(smaller, level)?;
                    if above < self.levels.len() {
                        open.push(Reverse((above, index)));
                    }
                }
                None => {
                    let next = cube.iter().map(|&(bit, high)| {
                        let wire = self.next[bit];
                        if high { wire } else { !wire }
                    });
                    let mut goal: Vec<Wire> = next.collect();
                    goal.push(self.property);
                    let before = self.obligation(&goal, Some(index))?;
                    all.push(before);
                    open.push(Reverse((level - 1, all.len() - 1)));
                    open.push(Reverse((level, index)));
                }
            }
        }
        Ok(None)
    }
}

/// Returns the input ports from an obligation on.
fn trace(all: &[Obligation], first: usize) -> Vec<Vec<u64>> {
    let mut trace = Vec::new();
    let mut at = Some(first);
    while let Some(obligation) = at.and_then(|at| all.get(at)) {
        trace.push(obligation.ports.clone());
        at = obligation.next;
    }
    trace
}
