//! The integrator's arithmetic as a law that can be swept: two increments from the beginning of a
//! cycle.
//!
//! Under the rules floor and centred what stands after the first is a function of the point reached
//! alone, and so is what stands after the second. A longer sequence of increments is made of such
//! steps, so the law holds for it too. Under these rules the segment may be left: I is then right modulo
//! 2^P. Truncation is checked on the segment.

use super::{Integrator, Rule, integrator};
use crate::check::Law;
use crate::kernel::Moment;
use crate::logic::{Logic, Sim};
use crate::signals;

signals! {
    /// A case: a line, a point on it, and a step from there.
    pub struct Case<L, const P: usize> {
        /// δx(n): the second increment.
        pub increment: L::I<P>,
        /// The first increment.
        pub sum: L::I<P>,
        /// Δy.
        pub slave: L::I<P>,
        /// Δx.
        pub master: L::I<P>,
    }
}

signals! {
    /// What is seen of it.
    pub struct Seen<L, const P: usize> {
        /// I after the second increment.
        pub integral: L::I<P>,
        /// B after it.
        pub remainder: L::I<P>,
        /// `valid` in its tick, both times.
        pub valid: L::Bit,
        /// `valid` in any other tick.
        pub early: L::Bit,
    }
}

/// The law of I and B of an integrator of positions of `P` bits after two increments, for every distance of the
/// axes but a master's of 0, and every two increments.
#[derive(Debug, Clone)]
pub struct LineSweep<const P: usize, const R: usize> {
    circuit: Integrator<P, R>,
}

impl<const P: usize, const R: usize> LineSweep<P, R> {
    /// Ticks from one start to the next.
    const SCAN: u64 = Integrator::<P, R>::LATENCY + 1;

    /// That of an integrator.
    pub fn new(circuit: Integrator<P, R>) -> Self {
        LineSweep { circuit }
    }
}

/// `a / b` rounded by `rule`, whose first remainder is in `a`.
fn divided(rule: Rule, a: i64, b: i64) -> i64 {
    match rule {
        Rule::Truncating => a / b,
        Rule::Floor | Rule::Centred => (a * b.signum()).div_euclid(b.abs()),
    }
}

impl<const P: usize, const R: usize> Law for LineSweep<P, R> {
    type Circuit = Integrator<P, R>;
    type Case<L: Logic> = Case<L, P>;
    type Seen<L: Logic> = Seen<L, P>;

    fn name(&self) -> &str {
        "I and B are quotient and rest of the line after any two increments"
    }

    fn circuit(&self) -> &Integrator<P, R> {
        &self.circuit
    }

    fn ticks(&self) -> u64 {
        1 + 2 * Self::SCAN
    }

    fn input<L: Logic>(&self, case: &Case<L, P>, tick: u64) -> integrator::In<L, P> {
        let second = tick > Self::SCAN;
        integrator::In {
            clear: (tick == 0).into(),
            master: case.master,
            slave: case.slave,
            start: (tick == 1 || tick == 1 + Self::SCAN).into(),
            increment: if second { case.increment } else { case.sum },
        }
    }

    fn see<L: Logic>(
        &self,
        seen: Seen<L, P>,
        tick: u64,
        now: &Moment<'_, Integrator<P, R>, L>,
    ) -> Seen<L, P> {
        let valid = now.w.valid;
        match tick {
            tick if tick == Self::SCAN => Seen { valid, ..seen },
            tick if tick == 2 * Self::SCAN => Seen {
                integral: now.w.integral,
                remainder: now.w.remainder,
                valid: seen.valid & valid,
                early: seen.early,
            },
            _ => Seen {
                early: seen.early | valid,
                ..seen
            },
        }
    }

    fn expected(&self, case: &Case<Sim, P>) -> Option<Seen<Sim, P>> {
        let (master, slave) = (case.master.get(), case.slave.get());
        let (sum, to) = (case.sum.get(), case.sum.get() + case.increment.get());
        if master == 0 {
            return None;
        }
        let on_the_segment = |to: i64| to * master >= 0 && to.abs() <= master.abs();
        let rule = self.circuit.accumulator.rule;
        let (integral, remainder) = match rule {
            Rule::Floor | Rule::Centred => {
                let first = if rule == Rule::Centred { master / 2 } else { 0 };
                let along = slave * to + first;
                let integral = divided(rule, along, master);
                (integral, along - integral * master)
            }
            Rule::Truncating if !on_the_segment(sum) || !on_the_segment(to) => return None,
            Rule::Truncating => {
                let before = divided(rule, slave * sum, master);
                let along = slave * to - before * master;
                let step = divided(rule, along, master);
                (before + step, along - step * master)
            }
        };
        Some(Seen {
            integral: integral.into(),
            remainder: remainder.into(),
            valid: true.into(),
            early: false.into(),
        })
    }
}
