//! The integrator's arithmetic as a law that can be swept: two increments from the beginning of a
//! cycle.
//!
//! ```text
//!                     ┌────────────┐
//!  master, slave ────▶│            ├──▶ integral, remainder
//!  sum, increment ───▶│ line sweep ├──▶ valid, early
//!                     └────────────┘
//! ```
//!
//! Under the rules floor and centred the state after the first increment depends on the point
//! reached alone, and so does the state after the second. A longer sequence of increments consists
//! of such steps, so the law holds for it too. Under these rules the increments may leave the
//! segment: I is then right modulo 2^P. Truncation is checked on the segment.

use super::{Integrator, Rule, integrator};
use crate::check::Law;
use crate::prelude::*;

/// The law of I and B of an integrator after two increments, for every distance of the axes but a
/// master's of 0, and every two increments.
#[derive(Debug, Clone)]
pub struct LineSweep {
    /// Integrator 24.
    pub integrator: Integrator,
}

impl LineSweep {
    /// Creates the law of an integrator.
    #[must_use]
    pub const fn new(integrator: Integrator) -> Self {
        LineSweep { integrator }
    }

    /// Ticks from one start to the next.
    const fn scan(&self) -> u64 {
        self.integrator.latency() + 1
    }
}

signals! { for LineSweep as c;
    /// A case: a line, a point on it, and a step from there.
    pub struct In {
        /// δx(n): the second increment.
        pub increment: I(c.integrator.position),
        /// The first increment.
        pub sum: I(c.integrator.position),
        /// Δy.
        pub slave: I(c.integrator.position),
        /// Δx.
        pub master: I(c.integrator.position),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Ticks since the case began.
        ticks: U(log2(c.ticks() as usize)),
        /// `valid` was high in the expected tick of the first increment.
        first: Bit,
        /// `valid` was high in any other tick.
        wrong: Bit,
    }
    /// The circuit inside.
    pub struct Parts {
        /// Integrator 24.
        pub integrator: Part<Integrator>(c.integrator.clone()),
    }
    /// Observed signals.
    pub struct Net {
        /// I after the second increment.
        pub integral: I(c.integrator.position),
        /// B after the second increment.
        pub remainder: I(c.integrator.position),
        /// `valid` was high in the expected tick of both increments.
        pub valid: Bit,
        /// `valid` was high in another tick.
        pub early: Bit,
    }
}

impl Circuit for LineSweep {
    const NAME: &'static str = "line_sweep";
    const ABOUT: &'static str = "two increments from the start of a cycle";
    records!(In, Reg, Net, Parts);

    fn tick(&self, i: In, q: Reg, p: Parts) -> (Net, Reg<Edge>) {
        let scan = self.scan();
        let [begins, starts, first, starts_again] =
            [0, 1, scan, 1 + scan].map(|tick| q.ticks.equals(tick));
        let integrator = p.integrator.settle(integrator::In {
            clear: begins,
            master: i.master,
            slave: i.slave,
            start: starts | starts_again,
            increment: q.ticks.below(1 + scan).mux(i.sum, i.increment),
        });
        let valid = integrator.w.valid;
        let net = Net {
            integral: integrator.w.integral,
            remainder: integrator.w.remainder,
            valid: q.first & valid,
            early: q.wrong,
        };
        let next = Reg {
            ticks: q.ticks + 1,
            first: q.first | (first & valid),
            wrong: q.wrong | (valid & !first),
        };
        (net, next)
    }
}

/// Returns `a / b` rounded by `rule`; `a` includes the first remainder.
fn divided(rule: Rule, a: i64, b: i64) -> i64 {
    match rule {
        Rule::Truncating => a / b,
        Rule::Floor | Rule::Centred => (a * b.signum()).div_euclid(b.abs()),
    }
}

impl Law for LineSweep {
    fn law(&self) -> &str {
        "I and B are quotient and rest of the line after any two increments"
    }

    fn ticks(&self) -> u64 {
        1 + 2 * self.scan()
    }

    fn expected(&self, case: &In<Value>) -> Option<Net<Value>> {
        let (master, slave) = (case.master, case.slave);
        let (sum, to) = (case.sum, case.sum + case.increment);
        if master == 0 {
            return None;
        }
        let on_the_segment = |to: i64| to * master >= 0 && to.abs() <= master.abs();
        let rule = self.integrator.rule;
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
        Some(Net {
            integral,
            remainder,
            valid: true,
            early: false,
        })
    }
}
