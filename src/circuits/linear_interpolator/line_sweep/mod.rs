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

use super::line_law::{first_remainder, on_the_way};
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
        /// Ticks since the case began; stays at the number of ticks of a case.
        ticks: U(log2(c.ticks() as usize + 1)),
        /// Ghost: the case one tick ago.
        before: In(c),
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
        let ended = q.ticks.equals(self.ticks());
        let next = Reg {
            ticks: ended.mux(q.ticks, q.ticks + 1),
            before: In {
                increment: i.increment,
                sum: i.sum,
                slave: i.slave,
                master: i.master,
            },
            first: q.first | (first & valid),
            wrong: q.wrong | (valid & !first),
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w) = (&now.i, &now.q, &now.w);
        let last = q.ticks.equals(self.ticks() - 1);
        let constant = i.increment.equals(q.before.increment)
            & i.sum.equals(q.before.sum)
            & i.slave.equals(q.before.slave)
            & i.master.equals(q.before.master);
        let mut all = vec![
            Property::given("a case does not change", q.ticks.is_zero() | constant),
            Property::given("the master has a distance", !i.master.is_zero()),
        ];
        if self.integrator.rule == Rule::Truncating {
            let [from, to] = self.points(i);
            let on = on_the_way(from, i.master) & on_the_way(to, i.master);
            all.push(Property::given("both points are on the segment", on));
        }
        let [integral, remainder] = self.result(i);
        all.extend([
            Property::always(
                "valid comes with the results and in no other tick",
                &["valid", "early"],
                !last | (w.valid & !w.early),
            ),
            Property::always(
                "I is the quotient",
                &["integral"],
                !last | w.integral.equals(integral),
            ),
            Property::always(
                "B is the rest",
                &["remainder"],
                !last | w.remainder.equals(remainder),
            ),
        ]);
        all
    }
}

impl LineSweep {
    /// Returns the points after both increments.
    fn points(&self, i: &In) -> [I; 2] {
        let first = i.sum.resize(self.integrator.position + 1);
        [first, i.sum.plus(i.increment)]
    }

    /// Returns I and B after both increments.
    fn result(&self, i: &In) -> [I; 2] {
        let position = self.integrator.position;
        let along = |to: I| i.slave.times(to, 2 * position + 1);
        let [from, to] = self.points(i);
        match self.integrator.rule {
            rule @ (Rule::Floor | Rule::Centred) => {
                let first = first_remainder(rule, i.master);
                let (quotient, rest) = divided_down(along(to).plus(first), i.master);
                [quotient.resize(position), rest]
            }
            Rule::Truncating => {
                let (before, left) = divided_to_zero(along(from), i.master);
                let step = along(to).minus(along(from));
                let (quotient, rest) = divided_to_zero(step.plus(left), i.master);
                [before.plus(quotient).resize(position), rest]
            }
        }
    }
}

/// Returns the quotient and the rest of unsigned words, by long division: a bit of the quotient for
/// each row, all in one tick.
fn divided_unsigned(dividend: U, divisor: U) -> (U, U) {
    let wide = divisor.width() + 1;
    let mut rest = U::new(0, wide);
    let mut quotient: Option<U> = None;
    for bit in (0..dividend.width()).rev() {
        let grown = rest.slice(0, wide - 1).join(dividend.slice(bit, 1));
        let fits = !grown.below_any(divisor);
        rest = fits.mux(grown - divisor.resize(wide), grown);
        let digit = fits.word();
        quotient = Some(quotient.map_or(digit, |high| high.join(digit)));
    }
    (quotient.unwrap_or(dividend), rest.resize(divisor.width()))
}

/// Returns the quotient rounded down and the rest, which has the sign of the divisor.
fn divided_down(dividend: I, divisor: I) -> (I, I) {
    let along = dividend.negated_by(divisor.is_negative());
    // Of a negative number a, floor(a / b) is the complement of floor(~a / b).
    let below = along.is_negative();
    let complement = |word: U| below.mux(!word, word);
    let (quotient, rest) = divided_unsigned(complement(along.unsigned()), divisor.magnitude());
    let rest = below.mux(divisor.magnitude() - 1 - rest, rest);
    let rest = rest.signed().negated_by(divisor.is_negative());
    (complement(quotient).signed(), rest)
}

/// Returns the quotient rounded towards 0 and the rest, which has the sign of the dividend.
fn divided_to_zero(dividend: I, divisor: I) -> (I, I) {
    let (quotient, rest) = divided_unsigned(dividend.magnitude(), divisor.magnitude());
    let opposite = dividend.is_negative() ^ divisor.is_negative();
    let quotient = quotient.signed().negated_by(opposite);
    (quotient, rest.signed().negated_by(dividend.is_negative()))
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

#[cfg(test)]
mod tests;
