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
use crate::hdl::Registers;
use crate::prelude::*;
use crate::sim::Sample;

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
}

/// Returns true if `value` lies between 0 and `end`, both included.
fn on_the_way(value: i64, end: i64) -> bool {
    (0.min(end)..=0.max(end)).contains(&value)
}

/// Returns true if no division is running.
fn settled(now: &Sample<'_, LineLaw>) -> bool {
    !now.p.integrator.p.accumulator.q.busy
}

/// Δx, Δy, Σδx, I and B.
fn words(now: &Sample<'_, LineLaw>) -> [i64; 5] {
    let (q, w) = (now.q, now.w);
    [q.held_master, q.held_slave, q.sum, w.integral, w.remainder]
}

impl Specified for LineLaw {
    fn invariants(&self) -> Invariants<'_, Self> {
        let rule = self.integrator.rule;
        let first = move |master: i64| if rule == Rule::Centred { master / 2 } else { 0 };
        Invariants::<Self>::new()
            .always(
                "after every scan, Δx·I + B equals Δy·Σδx + B0",
                move |now| {
                    let [master, slave, sum, integral, remainder] = words(now);
                    let first = first(master);
                    let right = master * integral + remainder == slave * sum + first;
                    let signals = ["integral", "remainder", "sum"];
                    require(!settled(now) || right, signals, || {
                        format!("{master}·{integral} + {remainder} is not {slave}·{sum} + {first}")
                    })
                },
            )
            .always(
                "B is less than Δx in magnitude, and has the sign that the rounding rule requires",
                move |now| {
                    let [master, slave, sum, _, remainder] = words(now);
                    let sign = match rule {
                        Rule::Floor | Rule::Centred => master.signum(),
                        // Sign of this division's dividend, which a remainder other than 0 shares.
                        Rule::Truncating => remainder.signum(),
                    };
                    let right = remainder.abs() < master.abs().max(1) && remainder * sign >= 0;
                    require(!settled(now) || right, ["remainder"], || {
                        format!("{remainder} with Δ {master}, {slave} after {sum}")
                    })
                },
            )
            .always(
                "at the end of the line, I equals Δy and B equals B0",
                move |now| {
                    let [master, slave, sum, integral, remainder] = words(now);
                    let first = first(master);
                    let arrived = settled(now) && sum == master && master != 0;
                    let right = (integral, remainder) == (slave, first);
                    require(!arrived || right, ["integral", "remainder"], || {
                        format!("ends at {integral}, {remainder}, not at {slave}, {first}")
                    })
                },
            )
            .always(
                "a slave with no more distance than its master never moves farther in a scan",
                |now| {
                    let [master, slave, sum, integral, _] = words(now);
                    let slave_moved = (integral - now.q.integral_before).abs();
                    let right = slave_moved <= (sum - now.q.sum_before).abs();
                    let meant = settled(now) && slave.abs() <= master.abs();
                    require(!meant || right, ["integral", "integral_before"], || {
                        format!("moved by {slave_moved}")
                    })
                },
            )
            .always("the slave stays within one step of the line", move |now| {
                let [master, slave, sum, integral, _] = words(now);
                let off = (master * integral - slave * sum).abs();
                let right = match rule {
                    Rule::Centred => 2 * off <= master.abs(),
                    Rule::Floor | Rule::Truncating => off < master.abs().max(1),
                };
                require(!settled(now) || right, ["integral"], || {
                    format!("{off} of {master}")
                })
            })
    }

    /// Words are looked at with their strobes only.
    fn applies(&self, i: &In<Value>) -> bool {
        let quiet = |strobe: bool, word: i64| strobe || word == 0;
        quiet(i.clear, i.master)
            && quiet(i.clear, i.slave)
            && quiet(i.start, i.increment)
            && !(i.clear && i.start)
    }

    /// Increments, forth or back, stay on the segment; a cycle begins when nothing is divided.
    fn assumes(&self, now: &Registers<Self>, i: &In<Value>) -> bool {
        let busy = now.p.integrator.p.accumulator.q.busy;
        let sum = now.q.sum + i.increment;
        (!busy || !i.clear && !i.start) && (!i.start || on_the_way(sum, now.q.held_master))
    }
}
