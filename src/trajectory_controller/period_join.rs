//! Period join: waits for all points of an interpolation period.
//!
//! ```text
//!                      ┌─────────────┐
//!  begins, held ──────▶│             ├──▶ preset, step
//!  placed, referred ──▶│ period_join ├──▶ correct
//!  answered, driven ──▶│             ├──▶ busy, late
//!  clear ─────────────▶│             │
//!                      └─────────────┘
//! ```
//!
//! The commands are corrected at the same tick of every period, whatever its points took: the servo
//! controls look at their motors then, and what a motor moves between two looks is its speed.
//!
//! With the first point of a path the servo responses are put there, at rest: the path begins where
//! the machine stands, and what rounding left of the path before is not corrected in this one.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L> {
        /// A period begins with a length.
        pub begins: L::Bit,
        /// A period begins without a path: the corrected commands stay, the servo controls go on.
        pub held: L::Bit,
        /// The position command stands.
        pub placed: L::Bit,
        /// The reference point stands.
        pub referred: L::Bit,
        /// The servo responses stand.
        pub answered: L::Bit,
        /// The torques stand.
        pub driven: L::Bit,
        /// Another path: its first point is awaited, and `late` goes.
        pub clear: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L> {
        /// The first point of a path is awaited.
        first: L::Bit = 1,
        /// The servo responses go to the position command.
        pub preset: L::Bit = 0,
        /// They take a step towards it.
        pub step: L::Bit = 0,
        /// The reference point is awaited.
        refers: L::Bit = 0,
        /// The servo responses are awaited.
        answers: L::Bit = 0,
        /// The correction is awaited.
        pending: L::Bit = 0,
        /// Ticks of the period, up to those that are waited for.
        count: L::U<10> = 0,
        /// A period is under way.
        pub busy: L::Bit = 0,
        /// Both stand: the commands are corrected.
        pub correct: L::Bit = 0,
        /// A period began before the one before was over; until the next path.
        pub late: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L> {
        /// The period is as old as a correction must be.
        due: L::Bit,
        /// Both stand, and it is due.
        complete: L::Bit,
        /// A period begins.
        period: L::Bit,
    }
}

/// Join of the reference point and the servo responses.
///
/// `correct` is high `wait` + 2 ticks after `begins`, or later where points take longer; after
/// `held` too, but at once where nothing is waited for.
#[derive(Debug, Clone, Default)]
pub struct PeriodJoin {
    /// Ticks that every period waits, below 1023: those of the longest.
    pub wait: u64,
}

impl Circuit for PeriodJoin {
    const NAME: &'static str = "period_join";
    const ABOUT: &'static str = "waits for all points of an interpolation period";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L>, i: &In<L>) -> Net<L> {
        let due = q.count.equals(self.wait.into());
        let refers = q.refers & !i.referred;
        let answers = q.answers & !i.answered;
        Net {
            due,
            complete: q.pending & due & !refers & !answers,
            period: i.begins | i.held,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L>, w: &Net<L>, i: &In<L>) -> Reg<L> {
        let at_once: L::Bit = (self.wait == 0).into();
        let begins = i.begins | (i.held & !at_once);
        Reg {
            first: i.clear | (q.first & !i.placed),
            preset: i.placed & q.first,
            step: i.placed,
            refers: i.begins | (q.refers & !i.referred),
            answers: i.begins | (q.answers & !i.answered),
            busy: w.period | (q.busy & !i.driven),
            pending: begins | (q.pending & !w.complete),
            count: w.period.mux(0.into(), w.due.mux(q.count, q.count + 1)),
            correct: (w.complete & !w.period) | (i.held & at_once),
            late: (q.late & !i.clear) | (w.period & q.busy),
        }
    }
}

impl Specified for PeriodJoin {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "correct once both stand and the wait is over, once a period",
                |now, next| {
                    let (q, i) = (now.q, now.i);
                    let [begins, held] = [i.begins.get(), i.held.get()];
                    let left = (q.refers.get() && !i.referred.get())
                        || (q.answers.get() && !i.answered.get());
                    let over = q.count.get() >= self.wait;
                    let due = match (begins || held, self.wait) {
                        (true, 0) => held,
                        (true, _) => false,
                        (false, _) => q.pending.get() && !left && over,
                    };
                    let waits = match (begins, held && self.wait > 0) {
                        (false, false) => q.pending.get() && (left || !over),
                        _ => true,
                    };
                    let right = next.correct.get() == due && next.pending.get() == waits;
                    require(right, ["correct", "pending"], || {
                        format!("not {due}, {waits}")
                    })
                },
            )
            .step(
                "ticks are counted from a period's beginning to the wait",
                |now, next| {
                    let begins = now.i.begins.get() || now.i.held.get();
                    let due = match begins {
                        true => 0,
                        false => (now.q.count.get() + 1).min(self.wait),
                    };
                    require(next.count.get() == due, ["count"], || format!("not {due}"))
                },
            )
            .step("both are awaited from a period's beginning", |now, next| {
                let right = next.refers.get() && next.answers.get() && next.busy.get();
                require(
                    right || !now.i.begins.get(),
                    ["refers", "answers", "busy"],
                    || "not awaited".into(),
                )
            })
            .step(
                "the first point of a path presets, every point is stepped to",
                |now, next| {
                    let (q, i) = (now.q, now.i);
                    let due = [i.placed.get() && q.first.get(), i.placed.get()];
                    let seen = [next.preset.get(), next.step.get()];
                    require(due == seen, ["preset", "step"], || format!("not {due:?}"))
                },
            )
            .step(
                "the first point is awaited from power-on and clear to it",
                |now, next| {
                    let (q, i) = (now.q, now.i);
                    let due = match (i.clear.get(), i.placed.get()) {
                        (true, _) => true,
                        (false, placed) => !placed && q.first.get(),
                    };
                    require(next.first.get() == due, ["first"], || format!("not {due}"))
                },
            )
            .step("a period is under way to its torques", |now, next| {
                let (q, i) = (now.q, now.i);
                let begins = i.begins.get() || i.held.get();
                let due = begins || (q.busy.get() && !i.driven.get());
                require(next.busy.get() == due, ["busy"], || format!("not {due}"))
            })
            .step("late: a period begins in another", |now, next| {
                let clashes = (now.i.begins.get() || now.i.held.get()) && now.q.busy.get();
                let due = clashes || (now.q.late.get() && !now.i.clear.get());
                require(next.late.get() == due, ["late"], || format!("not {due}"))
            })
    }
}
