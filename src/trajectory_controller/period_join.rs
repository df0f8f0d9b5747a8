//! Period join: waits for all points of an interpolation period.
//!
//! ```text
//!                      ┌─────────────┐
//!  begins ────────────▶│             ├──▶ correct
//!  referred, answered ▶│ period_join ├──▶ busy, late
//!  driven ────────────▶│             │
//!                      └─────────────┘
//! ```

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L> {
        /// A period begins.
        pub begins: L::Bit,
        /// The reference point stands.
        pub referred: L::Bit,
        /// The servo responses stand.
        pub answered: L::Bit,
        /// The torques stand.
        pub driven: L::Bit,
        /// A path begins: the flag goes.
        pub clear: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L> {
        /// The reference point is awaited.
        refers: L::Bit = 0,
        /// The servo responses are awaited.
        answers: L::Bit = 0,
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
        /// The last of both comes in this tick.
        complete: L::Bit,
    }
}

/// Join of the reference point and the servo responses.
#[derive(Debug, Clone, Default)]
pub struct PeriodJoin;

impl Circuit for PeriodJoin {
    const NAME: &'static str = "period_join";
    const ABOUT: &'static str = "waits for all points of an interpolation period";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L>;

    #[inline(always)]
    fn comb<L: Logic>(&self, q: &Reg<L>, i: &In<L>) -> Net<L> {
        let awaited = q.refers | q.answers;
        let refers = q.refers & !i.referred;
        let answers = q.answers & !i.answered;
        Net {
            complete: awaited & !refers & !answers,
        }
    }

    #[inline(always)]
    fn next<L: Logic>(&self, q: Reg<L>, w: &Net<L>, i: &In<L>) -> Reg<L> {
        Reg {
            refers: i.begins | (q.refers & !i.referred),
            answers: i.begins | (q.answers & !i.answered),
            busy: i.begins | (q.busy & !i.driven),
            correct: w.complete & !i.begins,
            late: (q.late & !i.clear) | (i.begins & q.busy),
        }
    }
}

impl Specified for PeriodJoin {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("correct once both stand, once a period", |now, next| {
                let (q, i) = (now.q, now.i);
                let waits = q.refers.get() || q.answers.get();
                let left =
                    (q.refers.get() && !i.referred.get()) || (q.answers.get() && !i.answered.get());
                let due = waits && !left && !i.begins.get();
                require(next.correct.get() == due, ["correct"], || {
                    format!("not {due}")
                })
            })
            .step("both are awaited from a period's beginning", |now, next| {
                let right = next.refers.get() && next.answers.get() && next.busy.get();
                require(
                    right || !now.i.begins.get(),
                    ["refers", "answers", "busy"],
                    || "not awaited".into(),
                )
            })
            .step("late: a period begins in another", |now, next| {
                let clashes = now.i.begins.get() && now.q.busy.get();
                let due = clashes || (now.q.late.get() && !now.i.clear.get());
                require(next.late.get() == due, ["late"], || format!("not {due}"))
            })
    }
}
