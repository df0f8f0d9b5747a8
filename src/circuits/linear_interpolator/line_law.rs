//! Law of the straight line as a circuit that can be proved: an integrator under arbitrary
//! increments that stay on the segment, and ghost registers, which exist for the proof only.
//!
//! ```text
//!                     ┌──────────┐
//!  clear ────────────▶│          │
//!  master, slave ────▶│ line law ├──▶ integral, remainder
//!  start, increment ─▶│          │
//!                     └──────────┘
//! ```

use super::{Integrator, Rule, integrator};
use crate::prelude::*;

/// Integrator and the sum of its increments.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LineLaw {
    /// Integrator 24.
    pub integrator: Integrator,
}

signals! { for LineLaw as c;
    /// Input ports.
    pub struct In {
        /// Begins a positioning cycle with new distances.
        pub clear: Bit,
        /// Distance of the master axis; sampled with `clear`.
        pub master: I(c.integrator.position),
        /// Distance of the slave axis; sampled with `clear`.
        pub slave: I(c.integrator.position),
        /// Gives an increment.
        pub start: Bit,
        /// Increment of the master axis.
        pub increment: I(c.integrator.position),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Distance of the master axis.
        held_master: I(c.integrator.position) = 0,
        /// Distance of the slave axis.
        held_slave: I(c.integrator.position) = 0,
        /// Ghost: sum of the increments of this cycle.
        sum: I(c.integrator.position) as Analog = 0,
        /// Ghost: sum of the increments before the one being divided.
        sum_before: I(c.integrator.position) = 0,
        /// Ghost: I before the increment being divided.
        integral_before: I(c.integrator.position) = 0,
    }
    /// The circuit inside.
    pub struct Parts {
        /// Integrator 24.
        pub integrator: Part<Integrator>(c.integrator.clone()),
    }
    /// Nets.
    pub struct Net {
        /// Distance of the master axis in this tick.
        master_now: I(c.integrator.position),
        /// Distance of the slave axis in this tick.
        slave_now: I(c.integrator.position),
        /// An increment is accepted.
        take: Bit,
        /// I of the integrator.
        pub integral: I(c.integrator.position) as Analog,
        /// B of the integrator.
        pub remainder: I(c.integrator.position) as Analog,
    }
}

impl Circuit for LineLaw {
    const NAME: &'static str = "line_law";
    const ABOUT: &'static str =
        "an integrator under arbitrary increments, and ghosts that add them up";
    records!(In, Reg, Net, Parts);

    fn tick(&self, i: In, q: Reg, p: Parts) -> (Net, Reg<Edge>) {
        let master_now = i.clear.mux(i.master, q.held_master);
        let slave_now = i.clear.mux(i.slave, q.held_slave);
        let integrator = p.integrator.settle(integrator::In {
            clear: i.clear,
            master: master_now,
            slave: slave_now,
            start: i.start,
            increment: i.increment,
        });
        let integral = integrator.w.integral;
        let take = i.start & !i.clear & !integrator.w.busy & !q.held_master.is_zero();
        let cleared = |word: I| i.clear.mux(0, word);
        let next = Reg {
            held_master: master_now,
            held_slave: slave_now,
            sum: cleared(take.mux(q.sum + i.increment, q.sum)),
            sum_before: cleared(take.mux(q.sum, q.sum_before)),
            integral_before: cleared(take.mux(integral, q.integral_before)),
        };
        let net = Net {
            master_now,
            slave_now,
            take,
            integral,
            remainder: integrator.w.remainder,
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (q, w) = (&now.q, &now.w);
        let (master, slave) = (q.held_master, q.held_slave);
        let left = w.remainder;
        let less = left.is_zero() | left.magnitude().below(master.magnitude());
        let opposite = left.is_negative() ^ master.is_negative();
        let signed = match self.integrator.rule {
            Rule::Floor | Rule::Centred => left.is_zero() | master.is_zero() | !opposite,
            // The sign is that of the dividend, which is not kept.
            Rule::Truncating => Bit::high(),
        };
        let way = |from: I, to: I| to.minus(from).magnitude();
        let (way_slave, way_master) =
            (way(q.integral_before, w.integral), way(q.sum_before, q.sum));
        let shorter = !master.magnitude().below(slave.magnitude());
        let [law, end, near] = self.law(now);
        let mut all = self.given(now).to_vec();
        all.extend([
            law,
            Property::always(
                "B is less than Δx in magnitude, and has the sign that the rounding rule requires",
                &["remainder"],
                settled(now).implies(less & signed),
            ),
            end,
            Property::always(
                "a slave with no more distance than its master never moves farther in a scan",
                &["integral", "integral_before"],
                (settled(now) & shorter).implies(!way_master.below(way_slave)),
            ),
            near,
        ]);
        all.extend(self.division(now).into_iter().flatten());
        all.push(Property::helper(
            "B is less than Δx in every tick",
            &["remainder"],
            less & signed,
        ));
        all
    }
}

/// Returns B0, the remainder at the beginning of a cycle.
pub(super) fn first_remainder(rule: Rule, master: I) -> I {
    match rule {
        Rule::Centred => {
            let half = master.magnitude().shift_right(1).signed();
            half.negated_by(master.is_negative())
        }
        Rule::Floor | Rule::Truncating => I::new(0, master.width()),
    }
}

/// High if `value` lies between 0 and `end`, both included.
pub(super) fn on_the_way(value: I, end: I) -> Bit {
    let same_way = value.is_negative().equals(end.is_negative());
    let beyond = end.magnitude().below_any(value.magnitude());
    value.is_zero() | (same_way & !beyond)
}

/// High if no division is running.
fn settled(now: &Moment<LineLaw>) -> Bit {
    !now.p.integrator.p.accumulator.q.busy
}

impl LineLaw {
    /// Returns the product of two words, in a word that is wide enough for two such and a further
    /// word.
    fn product(&self, a: I, b: I) -> I {
        a.times(b, 2 * self.integrator.position)
    }

    /// Statements about the running division.
    fn division(&self, now: &Moment<Self>) -> Option<[Property; 2]> {
        let mul_div = &now.p.integrator.p.mul_div;
        let running = mul_div.q.sequence.as_ref()?;
        let (runs, ends, by) = (mul_div.w.busy, mul_div.q.done, running.by);
        let master = now.q.held_master;
        let divisor = by.equals(master.magnitude().resize(by.width()));
        let half = U::new(1, by.width()).shift_left(self.integrator.position - 1);
        let below = by.is_zero() | mul_div.q.remainder.below(by);
        Some([
            Property::helper(
                "the divider runs or ends while a division is running, and is by |Δx| then",
                &["integrator.mul_div.by"],
                settled(now).mux(!runs & !ends, (runs ^ ends) & divisor & !master.is_zero())
                    & !running.state.equals(3),
            ),
            Property::helper(
                "the rest of a division stays below its divisor, which is a distance",
                &["integrator.mul_div.remainder"],
                below & !half.below(by),
            ),
        ])
    }

    /// Statements about the increments.
    fn given(&self, now: &Moment<Self>) -> [Property; 3] {
        let (i, q) = (&now.i, &now.q);
        let starts = i.clear | i.start;
        [
            Property::given(
                "clear and start are never high together",
                !(i.clear & i.start),
            ),
            Property::given(
                "clear and start are low while a division is running",
                settled(now) | !starts,
            ),
            Property::given(
                "the sum of the increments stays on the segment",
                i.start
                    .implies(on_the_way(q.sum.plus(i.increment), q.held_master)),
            ),
        ]
    }

    /// Statements that tie the integral to the line.
    fn law(&self, now: &Moment<Self>) -> [Property; 3] {
        let (q, w) = (&now.q, &now.w);
        let (master, slave) = (q.held_master, q.held_slave);
        let width = 2 * self.integrator.position;
        let first = first_remainder(self.integrator.rule, master);
        let moved = self.product(master, w.integral);
        let ideal = self.product(slave, q.sum);
        let left = (moved + w.remainder.resize(width)).equals(ideal + first.resize(width));
        let arrived = q.sum.equals(master) & !master.is_zero();
        let at_end = w.integral.equals(slave) & w.remainder.equals(first);
        let off = (moved - ideal).magnitude();
        let near = match self.integrator.rule {
            Rule::Centred => !master.magnitude().below_any(off.shift_left(1)),
            Rule::Floor | Rule::Truncating => off.is_zero() | off.below_any(master.magnitude()),
        };
        [
            Property::always(
                "after every scan, Δx·I + B equals Δy·Σδx + B0",
                &["integral", "remainder", "sum"],
                settled(now).implies(left),
            ),
            Property::always(
                "at the end of the line, I equals Δy and B equals B0",
                &["integral", "remainder"],
                (settled(now) & arrived).implies(at_end),
            ),
            Property::always(
                "the slave stays within one step of the line",
                &["integral"],
                settled(now).implies(near),
            ),
        ]
    }
}

impl Specified for LineLaw {
    /// Words are looked at with their strobes only.
    fn applies(&self, i: &In<Value>) -> bool {
        let quiet = |strobe: bool, word: i64| strobe || word == 0;
        quiet(i.clear, i.master) && quiet(i.clear, i.slave) && quiet(i.start, i.increment)
    }
}
