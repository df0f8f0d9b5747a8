//! Second check of each proof, by a solver of its own that knows nothing of how it was found.

use super::clauses::{Answer, Clauses};
use super::frames::{Cone, Frames, Start};
use super::prover::{Basis, Grounds, Task, each};
use super::search::Never;
use super::thread_time::ThreadTime;
use super::unrolled::{At, Unrolled};
use crate::engine::sliced::NotSliced;
use crate::engine::sliced::gates::{Gates, LOW, Wire};
use crate::engine::sliced::state::State;
use batsat::Lit;

/// Factor of the time for a property that its check may take.
const TIMES: u32 = 4;

/// Checks the proof of a property. The answer is `Possible` if the proof does not hold: a state is
/// possible that it excludes, or it relies on a property that is not proved before it.
///
/// # Errors
/// Returns an error if a tick has too many gates.
pub(super) fn check(
    task: &Task<'_>,
    all: &[Option<Grounds>],
    property: usize,
) -> Result<Answer, NotSliced> {
    let Some(grounds) = all.get(property).and_then(Option::as_ref) else {
        return Ok(Answer::Possible);
    };
    let (mut before, mut beside) = (Vec::new(), vec![property]);
    for &lemma in &grounds.with {
        match all.get(lemma).and_then(Option::as_ref) {
            Some(other) if other.step < grounds.step => before.push(lemma),
            Some(other) if is_beside(grounds, other) => beside.push(lemma),
            _ => return Ok(Answer::Possible),
        }
    }
    let asked = before.iter().chain(&beside).chain(&task.givens);
    let asked: Vec<_> = asked.map(|&index| task.flat.properties[index]).collect();
    let until = ThreadTime::now() + task.limit * TIMES;
    before.extend(&task.givens);
    let answer = |memory_bits: usize| {
        let check = Check {
            task,
            cone: &Cone::of(task.flat, &asked, memory_bits),
            property,
            before: &before,
            until,
        };
        match &grounds.basis {
            Basis::EveryState => check.every_state(),
            Basis::Induction(ticks) => check.induction(*ticks, &beside),
            Basis::Search(never) => check.invariant(never),
        }
    };
    // Most proofs hold whatever words the reads of memories give.
    match grounds.basis {
        Basis::EveryState | Basis::Induction(_) if answer(0)? == Answer::Impossible => {
            Ok(Answer::Impossible)
        }
        _ => answer(task.memory_bits),
    }
}

/// True if two properties are proved by one induction.
fn is_beside(grounds: &Grounds, other: &Grounds) -> bool {
    let ticks = |grounds: &Grounds| match grounds.basis {
        Basis::Induction(ticks) => Some(ticks),
        _ => None,
    };
    grounds.step == other.step && ticks(grounds).is_some() && ticks(grounds) == ticks(other)
}

struct Check<'t, 'f> {
    task: &'t Task<'f>,
    cone: &'t Cone,
    property: usize,
    /// Properties that hold in every tick.
    before: &'t [usize],
    until: ThreadTime,
}

impl Check<'_, '_> {
    fn violate(&self, start: Start, tick: usize, held: &[At]) -> Result<Answer, NotSliced> {
        let mut unrolled = Unrolled::new(self.task.flat, self.cone, start);
        let at = At {
            property: self.property,
            tick,
        };
        unrolled.violate(at, held, self.until)
    }

    fn every_state(&self) -> Result<Answer, NotSliced> {
        self.violate(Start::Any, 0, &each(&self.task.givens, 0..=0))
    }

    fn induction(&self, ticks: usize, beside: &[usize]) -> Result<Answer, NotSliced> {
        for tick in 0..ticks {
            let held = each(&self.task.givens, 0..=tick);
            let answer = self.violate(Start::PowerOn, tick, &held)?;
            if answer != Answer::Impossible {
                return Ok(answer);
            }
        }
        let mut held = each(self.before, 0..=ticks);
        held.extend(each(beside, 0..=ticks - 1));
        self.violate(Start::Any, ticks, &held)
    }

    /// Checks that no set has the state at power-on, that no edge enters one from outside of all,
    /// and that the property holds outside of all.
    fn invariant(&self, never: &[Never]) -> Result<Answer, NotSliced> {
        let mut clauses = Clauses::new();
        let mut powered = Frames::new(self.task.flat, self.cone, Start::PowerOn);
        let state = powered.state(0)?.clone();
        for cube in never {
            let inside = literals(&mut clauses, &powered.gates, &state, cube);
            let answer = clauses.solve(&inside, self.until);
            if answer != Answer::Impossible {
                return Ok(answer);
            }
        }
        let mut unrolled = Unrolled::new(self.task.flat, self.cone, Start::Any);
        let (now, next) = (
            unrolled.frames.state(0)?.clone(),
            unrolled.frames.state(1)?.clone(),
        );
        let Unrolled {
            frames, clauses, ..
        } = &mut unrolled;
        for cube in never {
            let inside = literals(clauses, &frames.gates, &now, cube);
            let outside: Vec<Lit> = inside.into_iter().map(|lit| !lit).collect();
            clauses.assert(&outside);
        }
        let held = each(self.before, 0..=0);
        let at = At {
            property: self.property,
            tick: 0,
        };
        let answer = unrolled.violate(at, &held, self.until)?;
        if answer != Answer::Impossible {
            return Ok(answer);
        }
        let mut known = Vec::new();
        for at in held {
            known.push(unrolled.holds(at)?);
        }
        let Unrolled {
            frames, clauses, ..
        } = &mut unrolled;
        for cube in never {
            let mut entered = literals(clauses, &frames.gates, &next, cube);
            entered.extend(&known);
            let answer = clauses.solve(&entered, self.until);
            if answer != Answer::Impossible {
                return Ok(answer);
            }
        }
        Ok(Answer::Impossible)
    }
}

/// Returns literals that are high if a state is in a set.
fn literals(clauses: &mut Clauses, gates: &Gates, state: &State, never: &Never) -> Vec<Lit> {
    let bits = Frames::bits(state);
    let wire = |place, bit| {
        let mut bits = bits.iter();
        let found = bits.find(|known| (known.0, known.1) == (place, bit));
        // A bit that the check does not know is never at a level.
        found.map_or(LOW, |known| known.2)
    };
    let lits = never.iter().map(|at| {
        let wire: Wire = wire(at.place, at.bit);
        let lit = clauses.lit(gates, wire);
        if at.high { lit } else { !lit }
    });
    lits.collect()
}
