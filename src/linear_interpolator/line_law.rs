//! The law of the straight line as a circuit that can be proved: an integrator under any increments
//! that stay on the segment, with ghost registers that no hardware has.
//!
//! ```text
//!                     ┌──────────┐
//!  clear ────────────▶│          │
//!  master, slave ────▶│ line law ├──▶ integral, remainder
//!  start, increment ─▶│          │
//!                     └──────────┘
//! ```

use super::{Integrator, Rule, integrator};
use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Instance};
use crate::logic::{Bit, Logic, Signed, Sim};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize> {
        /// A positioning cycle begins, with new distances.
        pub clear: L::Bit,
        /// Distance of the master axis; sampled with `clear`.
        pub master: L::I<P>,
        /// Distance of the slave axis; sampled with `clear`.
        pub slave: L::I<P>,
        /// An increment is given.
        pub start: L::Bit,
        /// It.
        pub increment: L::I<P>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize, const R: usize> {
        /// Integrator 24.
        pub integrator: integrator::Reg<L, P, R>,
        /// Distance of the master axis.
        held_master: L::I<P> = 0,
        /// Distance of the slave axis.
        held_slave: L::I<P> = 0,
        /// Ghost: the increments of this cycle, added up.
        sum: L::I<P> as Analog = 0,
        /// Ghost: the increments before the one that is being divided, added up.
        sum_before: L::I<P> = 0,
        /// Ghost: I before the one that is being divided.
        integral_before: L::I<P> = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize, const R: usize> {
        /// Integrator 24.
        pub integrator: Instance<Integrator<P, R>, L>,
        /// Distance of the master axis in this tick.
        master_now: L::I<P>,
        /// Distance of the slave axis in this tick.
        slave_now: L::I<P>,
        /// An increment is taken.
        take: L::Bit,
        /// I.
        pub integral: L::I<P> as Analog,
        /// B.
        pub remainder: L::I<P> as Analog,
    }
}

/// An integrator of positions of `P` bits with its increments added up.
#[derive(Debug, Clone, Default)]
pub struct LineLaw<const P: usize, const R: usize> {
    /// Integrator 24.
    pub integrator: Integrator<P, R>,
}

impl<const P: usize, const R: usize> LineLaw<P, R> {
    /// The law of an integrator that rounds by `rule`.
    pub fn new(rule: Rule) -> Self {
        LineLaw {
            integrator: Integrator::new(rule),
        }
    }
}

impl<const P: usize, const R: usize> Circuit for LineLaw<P, R> {
    const NAME: &'static str = "line_law";
    const ABOUT: &'static str = "increments of free choice, with ghosts that add them up";
    type In<L: Logic> = In<L, P>;
    type Reg<L: Logic> = Reg<L, P, R>;
    type Net<L: Logic> = Net<L, P, R>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, R>, i: &In<L, P>) -> Net<L, P, R> {
        let master_now = i.clear.mux(i.master, q.held_master);
        let slave_now = i.clear.mux(i.slave, q.held_slave);
        let integrator = Instance::settle(
            &self.integrator,
            &q.integrator,
            integrator::In {
                clear: i.clear,
                master: master_now,
                slave: slave_now,
                start: i.start,
                increment: i.increment,
            },
        );
        Net {
            master_now,
            slave_now,
            take: i.start & !i.clear & !integrator.w.busy & !q.held_master.is_zero(),
            integral: integrator.w.integral,
            remainder: integrator.w.remainder,
            integrator,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, P, R>, w: &Net<L, P, R>, i: &In<L, P>) -> Reg<L, P, R> {
        let sum = w.take.mux(q.sum + i.increment, q.sum);
        let cleared = |word: L::I<P>| i.clear.mux(0.into(), word);
        Reg {
            integrator: w.integrator.next(&self.integrator, q.integrator),
            held_master: w.master_now,
            held_slave: w.slave_now,
            sum: cleared(sum),
            sum_before: cleared(w.take.mux(q.sum, q.sum_before)),
            integral_before: cleared(w.take.mux(w.integral, q.integral_before)),
        }
    }
}

/// Whether `value` lies between 0 and `end`, both included.
fn on_the_way(value: i64, end: i64) -> bool {
    (0.min(end)..=0.max(end)).contains(&value)
}

impl<const P: usize, const R: usize> Specified for LineLaw<P, R> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let rule = self.integrator.accumulator.rule;
        let settled = |q: &Reg<Sim, P, R>| !q.integrator.accumulator.busy.get();
        let words = |q: &Reg<Sim, P, R>| {
            let (master, slave, sum) = (q.held_master.get(), q.held_slave.get(), q.sum.get());
            let integral = q.integrator.accumulator.integral.get();
            (
                master,
                slave,
                sum,
                integral,
                q.integrator.accumulator.remainder.get(),
            )
        };
        Invariants::<Self>::new()
            .always("Δx·I + B = Δy·Σδx + B0 on every scan", move |now| {
                let (master, slave, sum, integral, remainder) = words(now.q);
                let first = if rule == Rule::Centred { master / 2 } else { 0 };
                let right = master * integral + remainder == slave * sum + first;
                let signals = ["integral", "remainder", "sum"];
                require(!settled(now.q) || right, signals, || {
                    format!("{master}·{integral} + {remainder} is not {slave}·{sum} + {first}")
                })
            })
            .always(
                "B is smaller than Δx, and has the sign that the rule says",
                move |now| {
                    let (master, slave, sum, _, remainder) = words(now.q);
                    let sign = match rule {
                        Rule::Floor | Rule::Centred => master.signum(),
                        // Of the dividend of this division, which a remainder other than 0 shares.
                        Rule::Truncating => remainder.signum(),
                    };
                    let right = remainder.abs() < master.abs().max(1) && remainder * sign >= 0;
                    require(!settled(now.q) || right, ["remainder"], || {
                        format!("{remainder} with Δ {master}, {slave} after {sum}")
                    })
                },
            )
            .always(
                "at the end I is Δy, and B what it was at the beginning",
                move |now| {
                    let (master, slave, sum, integral, remainder) = words(now.q);
                    let first = if rule == Rule::Centred { master / 2 } else { 0 };
                    let arrived = settled(now.q) && sum == master && master != 0;
                    let right = (integral, remainder) == (slave, first);
                    require(!arrived || right, ["integral", "remainder"], || {
                        format!("ends at {integral}, {remainder}, not at {slave}, {first}")
                    })
                },
            )
            .always(
                "a slave with the smaller distance moves no farther than its master",
                move |now| {
                    let (master, slave, sum, integral, _) = words(now.q);
                    let by = |to: i64, from: i64| (to - from).abs();
                    let slave_moved = by(integral, now.q.integral_before.get());
                    let right = slave_moved <= by(sum, now.q.sum_before.get());
                    let meant = settled(now.q) && slave.abs() <= master.abs();
                    require(!meant || right, ["integral", "integral_before"], || {
                        format!("moved by {slave_moved}")
                    })
                },
            )
            .always("the slave stays within one step of the line", move |now| {
                let (master, slave, sum, integral, _) = words(now.q);
                let off = (master * integral - slave * sum).abs();
                let right = match rule {
                    Rule::Centred => 2 * off <= master.abs(),
                    Rule::Floor | Rule::Truncating => off < master.abs().max(1),
                };
                require(!settled(now.q) || right, ["integral"], || {
                    format!("{off} of {master}")
                })
            })
    }

    /// Words are looked at with their strobes only.
    fn applies(&self, i: &In<Sim, P>) -> bool {
        let quiet = |strobe: bool, word: i64| strobe || word == 0;
        quiet(i.clear.get(), i.master.get())
            && quiet(i.clear.get(), i.slave.get())
            && quiet(i.start.get(), i.increment.get())
            && !(i.clear.get() && i.start.get())
    }

    /// Increments, forth or back, stay on the segment; a cycle begins when nothing is divided.
    fn assumes(&self, q: &Reg<Sim, P, R>, i: &In<Sim, P>) -> bool {
        let busy = q.integrator.accumulator.busy.get();
        let sum = q.sum.get() + i.increment.get();
        (!busy || !i.clear.get() && !i.start.get())
            && (!i.start.get() || on_the_way(sum, q.held_master.get()))
    }
}
