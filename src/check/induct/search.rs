//! Search for an invariant of which a property follows, clause by clause (IC3, also called
//! property-directed reachability).
//!
//! Level 0 is the state at power-on. Level n contains every state that is reached in at most n
//! edges; its cubes are sets of states that are not. A level that equals the next one contains
//! all reachable states.

use super::clauses::{Answer, Clauses};
use super::frames::{Cone, Frames, Start};
use super::unrolled::number;
use crate::engine::sliced::NotSliced;
use crate::engine::sliced::gates::{HIGH, Wire};
use crate::engine::{Flat, Place};
use batsat::Lit;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::time::Instant;

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

struct Level {
    /// Literal that makes the clauses of the level count.
    active: Lit,
    cubes: Vec<Cube>,
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
    until: Instant,
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
    until: Instant,
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
        until: Instant,
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

    fn deepen(&mut self) {
        let active = self.clauses.free();
        let cubes = Vec::new();
        self.levels.push(Level { active, cubes });
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

    /// Returns the literals that restrict the state to a level.
    fn inside(&mut self, level: usize) -> Vec<Lit> {
        if level > 0 {
            let levels = self.levels[level..].iter();
            return levels.map(|level| level.active).collect();
        }
        let bits = (0..self.bits.len()).map(|bit| (bit, self.power_on[bit]));
        let bits: Cube = bits.collect();
        self.lits(&bits, |search| &search.bits)
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

    fn is_blocked(&self, cube: &Cube, level: usize) -> bool {
        let mut known = self.levels[level..].iter().flat_map(|level| &level.cubes);
        known.any(|known| is_subset(known, cube))
    }

    /// Returns a larger set that no edge enters from a state of a level outside of it, if an edge
    /// does not enter this one.
    fn apart(&mut self, cube: &Cube, level: usize) -> Result<Option<Cube>, End> {
        let outside = self.clauses.free();
        let mut clause = vec![!outside];
        let here = self.lits(cube, |search| &search.bits);
        clause.extend(here.into_iter().map(|lit| !lit));
        self.clauses.assert(&clause);
        let after = self.lits(cube, |search| &search.next);
        let mut assumed = self.inside(level);
        assumed.push(outside);
        assumed.push(self.lit(self.property));
        assumed.extend(&after);
        let entered = self.solve(&assumed);
        let bits = cube.iter().copied().zip(after);
        let needed = |lit: Lit| self.clauses.is_needed(lit);
        let needed = bits.filter(|&(_, lit)| needed(lit)).map(|(bit, _)| bit);
        let mut smaller: Cube = needed.collect();
        self.clauses.assert(&[!outside]);
        if entered? {
            return Ok(None);
        }
        if self.has_power_on(&smaller) {
            let mut bits = cube.iter();
            let other = bits.find(|&&(index, high)| self.power_on[index] != high);
            smaller.extend(other);
            smaller.sort_unstable();
        }
        Ok(Some(smaller))
    }

    /// Makes a set that no edge enters from the level below as large as possible, and excludes it
    /// from the highest level for which that holds. Returns the level above that one.
    fn exclude(&mut self, mut cube: Cube, mut level: usize) -> Result<usize, End> {
        for bit in cube.clone() {
            let mut larger = cube.clone();
            larger.retain(|other| *other != bit);
            if larger.len() == cube.len() || self.has_power_on(&larger) {
                continue;
            }
            if let Some(larger) = self.apart(&larger, level - 1)? {
                cube = larger;
            }
        }
        while level + 1 < self.levels.len() && self.apart(&cube, level)?.is_some() {
            level += 1;
        }
        self.add(cube, level);
        Ok(level + 1)
    }

    fn add(&mut self, cube: Cube, level: usize) {
        for known in &mut self.levels[..=level] {
            known.cubes.retain(|known| !is_subset(&cube, known));
        }
        let here = self.lits(&cube, |search| &search.bits);
        let mut clause = vec![!self.levels[level].active];
        clause.extend(here.into_iter().map(|lit| !lit));
        self.clauses.assert(&clause);
        self.levels[level].cubes.push(cube);
    }

    /// Excludes the sets of a level from the next one if no edge enters them.
    fn propagate(&mut self, level: usize) -> Result<(), End> {
        for cube in self.levels[level].cubes.clone() {
            if self.apart(&cube, level)?.is_some() {
                self.add(cube, level + 1);
            }
        }
        Ok(())
    }
}

/// True if every bit of the first set is one of the second: the second contains fewer states.
fn is_subset(few: &Cube, many: &Cube) -> bool {
    few.iter().all(|bit| many.binary_search(bit).is_ok())
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
