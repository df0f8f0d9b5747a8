//! Questions about the ticks of a netlist.

use super::clauses::{Answer, Clauses};
use super::conjuncts::conjuncts;
use super::frames::{Cone, Frames, Start};
use super::thread_time::ThreadTime;
use crate::engine::Flat;
use crate::engine::sliced::NotSliced;
use crate::engine::sliced::gates::Wire;
use batsat::Lit;

/// Property in a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct At {
    pub property: usize,
    pub tick: usize,
}

/// Ticks from a state on, and a solver of their own.
pub(super) struct Unrolled<'f> {
    pub frames: Frames<'f>,
    pub clauses: Clauses,
    /// Assumed literals that the last proof needed.
    core: Vec<Lit>,
}

impl<'f> Unrolled<'f> {
    pub fn new(flat: &'f Flat, cone: &'f Cone, start: Start) -> Self {
        Unrolled {
            frames: Frames::new(flat, cone, start),
            clauses: Clauses::new(),
            core: Vec::new(),
        }
    }

    /// Returns the literal that is high if a property holds in a tick.
    pub fn holds(&mut self, at: At) -> Result<Lit, NotSliced> {
        let (frame, gates) = self.frames.tick(at.tick)?;
        Ok(self.clauses.lit(gates, frame.properties[at.property]))
    }

    /// Searches for ticks in which `held` hold and `violated` does not: for each part of the property
    /// in turn, with those before it as lemmas.
    pub fn violate(
        &mut self,
        violated: At,
        held: &[At],
        until: ThreadTime,
    ) -> Result<Answer, NotSliced> {
        let mut assumed = Vec::new();
        for &at in held {
            assumed.push(self.holds(at)?);
        }
        let (frame, _) = self.frames.tick(violated.tick)?;
        let whole = frame.properties[violated.property];
        let parts = conjuncts(&mut self.frames.gates, whole);
        // High: the parts that are proved so far hold.
        let before = self.clauses.free();
        self.core.clear();
        let mut answer = Answer::Impossible;
        for part in parts {
            let part = self.clauses.lit(&self.frames.gates, part);
            let question = [&assumed[..], &[before, !part]].concat();
            answer = self.clauses.solve(&question, until);
            if answer != Answer::Impossible {
                break;
            }
            let needed = assumed.iter().filter(|lit| self.clauses.is_needed(**lit));
            self.core.extend(needed);
            self.clauses.assert(&[!before, part]);
        }
        self.clauses.assert(&[!before]);
        Ok(answer)
    }

    /// Returns those of `held` that the last proof needed.
    pub fn needed(&mut self, held: &[At]) -> Result<Vec<At>, NotSliced> {
        let mut needed = Vec::new();
        for &at in held {
            let lit = self.holds(at)?;
            if self.core.contains(&lit) {
                needed.push(at);
            }
        }
        Ok(needed)
    }

    /// Returns the words of the input ports in the first `ticks` ticks of the assignment found last.
    pub fn inputs(&mut self, ticks: usize) -> Result<Vec<Vec<u64>>, NotSliced> {
        let mut inputs = Vec::new();
        for tick in 0..ticks {
            let (frame, _) = self.frames.tick(tick)?;
            let ports = frame.ports.iter();
            inputs.push(ports.map(|word| number(&self.clauses, word)).collect());
        }
        Ok(inputs)
    }
}

/// Returns the number on a word in the assignment found last.
pub(super) fn number(clauses: &Clauses, word: &[Wire]) -> u64 {
    let bits = word.iter().enumerate();
    bits.fold(0, |number, (bit, &wire)| {
        number | u64::from(clauses.is_high(wire)) << bit
    })
}
