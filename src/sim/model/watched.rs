//! Signals that a model watches, and the receiver of all of them.

use super::{Model, ModelError, SignalRef, Tap};
use crate::engine::{Engine, Watch};

/// Costly reads after which a model watches the leaves that were read.
const COSTLY: u32 = 64;

impl Model {
    /// Watches signals, so that reading them costs nothing more; the state is kept.
    ///
    /// # Errors
    /// Returns an error if there is no such signal.
    pub fn watch<S: SignalRef>(
        &mut self,
        signals: impl IntoIterator<Item = S>,
    ) -> Result<(), ModelError> {
        let leaves = signals.into_iter().map(|signal| self.leaf(signal));
        let mut leaves = leaves.collect::<Result<Vec<_>, _>>()?;
        let known = self.engine_after_tap();
        leaves.retain(|&leaf| known.is_unwatched(leaf));
        if !leaves.is_empty() {
            self.watched.extend(leaves);
            self.plan_anew();
        }
        Ok(())
    }

    /// Returns the engine that runs without waves.
    fn engine_after_tap(&self) -> &Engine {
        self.narrow.as_deref().unwrap_or(&self.engine)
    }

    /// Plans the circuit anew for the leaves that are watched, with the state kept.
    fn plan_anew(&mut self) {
        let circuit = self.circuit.clone();
        let leaves = [&circuit.ports_out[..], &self.watched].concat();
        let program = circuit.elaborated.program(Watch::Leaves(&leaves));
        let planned = Engine::new(program);
        self.costly = 0;
        match &mut self.narrow {
            Some(narrow) => **narrow = planned,
            None => drop(self.exchange(planned)),
        }
    }

    /// Continues on another engine of the circuit, with the state kept; returns the one before.
    pub(in crate::sim) fn exchange(&mut self, mut engine: Engine) -> Engine {
        engine.resume(&self.engine.saved());
        self.settled = false;
        std::mem::replace(&mut self.engine, engine)
    }

    /// Watches all leaves and passes every tick from this one on to a tap.
    pub(crate) fn begin(&mut self, tap: Box<dyn Tap>) {
        if !self.engine.program().watches_all() {
            let circuit = self.circuit.clone();
            let all = || circuit.elaborated.program(Watch::All);
            let wide = Engine::new(circuit.all.get_or_init(all).clone());
            self.narrow = Some(Box::new(self.exchange(wide)));
        }
        self.tap = Some(tap);
    }

    /// Returns the tap, which receives no more ticks.
    pub(crate) fn end(&mut self) -> Option<Box<dyn Tap>> {
        if let Some(narrow) = self.narrow.take() {
            self.exchange(*narrow);
        }
        self.tap.take()
    }

    /// True if a tap receives the ticks.
    pub(crate) fn is_tapped(&self) -> bool {
        self.tap.is_some()
    }

    /// Counts a read that computes all nets; after many of them the leaves are watched.
    #[cold]
    pub(super) fn count_costly(&mut self, leaf: usize) {
        self.costly += 1;
        if !self.watched.contains(&leaf) {
            self.watched.push(leaf);
        }
        if self.costly >= COSTLY {
            self.plan_anew();
            self.settle();
        }
    }
}
