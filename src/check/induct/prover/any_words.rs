//! Proofs that need no more than a tick.

use super::super::clauses::Answer;
use super::super::frames::Start;
use super::{Basis, Prover};
use crate::engine::sliced::NotSliced;

impl Prover<'_, '_> {
    /// Proves the properties that need no more than a tick, whatever words the reads of memories
    /// give: a smaller question than with the words of the memories.
    pub(super) fn any_words(&mut self) -> Result<(), NotSliced> {
        if !self.cone.is_expanded() {
            return Ok(());
        }
        let cone = self.task.cone(0);
        let mut any = Prover::new(self.task, &cone);
        any.every_state()?;
        for property in any.open(self.task.proved()) {
            // A violation may be one that the words of the memories exclude.
            let answer = any.ask(Start::PowerOn, property, 0, &[])?;
            any.safe[property] = usize::from(answer == Answer::Impossible);
        }
        any.induct(1)?;
        (self.found, self.spent, self.steps) = (any.found, any.spent, any.steps);
        Ok(())
    }

    /// Proves the properties that no state violates.
    pub(super) fn every_state(&mut self) -> Result<(), NotSliced> {
        for property in self.open(self.task.proved()) {
            match self.ask(Start::Any, property, 0, &[])? {
                Answer::Impossible => self.prove(property, Basis::EveryState, Vec::new()),
                Answer::Possible => {}
                Answer::Unknown => self.hard[property] = true,
            }
        }
        Ok(())
    }
}
