//! Case by case, as a simulation runs.

use super::Law;
use super::{from_word, to_word};
use crate::engine::{Engine, Watch};
use crate::kernel::{Field, Model, Moment, Probe, Role, Shape, Signals, part, record, zero};
use crate::logic::Sim;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// A circuit that starts from power-on for each case.
pub struct Simulated {
    /// At power-on: what each thread begins with.
    engine: Mutex<Engine>,
}

impl Simulated {
    /// That of a circuit.
    pub fn new(model: &Model) -> Self {
        Simulated {
            engine: Mutex::new(Engine::straight(model.program(Watch::All))),
        }
    }

    fn engine(&self) -> Engine {
        let engine = self.engine.lock();
        engine.unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// How many cases are meant, and the first that is wrong.
    pub fn check<W: Law>(&self, law: &W, chunk: Range<u64>) -> (u64, Option<u64>) {
        let mut engine = self.engine();
        let power_on = engine.slab().to_vec();
        let mut meant = 0;
        for index in chunk {
            let case = from_word(index);
            let Some(expected) = law.expected(&case) else {
                continue;
            };
            meant += 1;
            engine.restore(&power_on);
            if to_word(&expected) != to_word(&seen(&mut engine, law, &case)) {
                return (meant, Some(index));
            }
        }
        (meant, None)
    }

    /// What is seen of a case in the end.
    pub fn seen<W: Law>(&self, law: &W, case: &W::Case<Sim>) -> W::Seen<Sim> {
        seen(&mut self.engine(), law, case)
    }
}

fn seen<W: Law>(engine: &mut Engine, law: &W, case: &W::Case<Sim>) -> W::Seen<Sim> {
    let mut seen = zero();
    for tick in 0..law.ticks() {
        let i = law.input(case, tick);
        i.visit(part(Role::Input), &mut Apply { engine, port: 0 });
        engine.settle();
        let now = Moment {
            i: &i,
            q: &record(Role::Register, engine),
            w: &record(Role::Net, engine),
        };
        seen = law.see(seen, tick, &now);
        engine.edge();
    }
    seen
}

/// Applies ports in, one after the other.
struct Apply<'a> {
    engine: &'a mut Engine,
    port: usize,
}

impl Probe for Apply<'_> {
    #[inline]
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.engine.input(self.port, bits);
        self.port += 1;
    }
}
