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
//! The commands are corrected at the same tick of every period, however long its points took: the
//! servo controls sample their motors then, and the move of a motor between two samples is its
//! speed.
//!
//! With the first point of a path the servo responses are set to it, at rest: the path begins
//! where the machine is, and rounding errors of the path before are not corrected in this one.

use crate::prelude::*;

/// Join of the reference point and the servo responses.
///
/// `correct` is high `wait` + 2 ticks after `begins`, or later where points take longer; after
/// `held` too, but in the next tick if `wait` is 0.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PeriodJoin {
    /// Ticks that every period waits, below 1023: those of the longest.
    pub wait: u64,
}

signals! { for PeriodJoin as c;
    /// Input ports.
    pub struct In {
        /// A period begins with a length.
        pub begins: Bit,
        /// A period begins without a path: the corrected commands stay, the servo controls
        /// continue.
        pub held: Bit,
        /// The position command is valid.
        pub placed: Bit,
        /// The reference point is valid.
        pub referred: Bit,
        /// The servo responses are valid.
        pub answered: Bit,
        /// The torques are valid.
        pub driven: Bit,
        /// Another path: its first point is awaited, and `late` goes.
        pub clear: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// The first point of a path is awaited.
        first: Bit = 1,
        /// The servo responses go to the position command.
        pub preset: Bit = 0,
        /// The servo responses take a step towards the position command.
        pub step: Bit = 0,
        /// The reference point is awaited.
        refers: Bit = 0,
        /// The servo responses are awaited.
        answers: Bit = 0,
        /// The correction is awaited.
        pending: Bit = 0,
        /// Ticks of the period, up to those that are waited for.
        count: U(10) = 0,
        /// A period is running.
        pub busy: Bit = 0,
        /// Reference point and servo responses are valid: the commands are corrected.
        pub correct: Bit = 0,
        /// A period began before the one before was over; until the next path.
        pub late: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// The period is as old as a correction must be.
        due: Bit,
        /// Reference point and servo responses are valid, and the correction is due.
        complete: Bit,
        /// A period begins.
        period: Bit,
    }
}

impl Circuit for PeriodJoin {
    const NAME: &'static str = "period_join";
    const ABOUT: &'static str = "waits for all points of an interpolation period";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        (self.wait >= 1023).then(|| format!("a period waits below 1023 ticks, not {}", self.wait))
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let due = q.count.equals(self.wait);
        let refers = q.refers & !i.referred;
        let answers = q.answers & !i.answered;
        let complete = q.pending & due & !refers & !answers;
        let period = i.begins | i.held;
        let at_once: Bit = (self.wait == 0).into();
        let begins = i.begins | (i.held & !at_once);
        let next = Reg {
            first: i.clear | (q.first & !i.placed),
            preset: i.placed & q.first,
            step: i.placed,
            refers: i.begins | refers,
            answers: i.begins | answers,
            busy: period | (q.busy & !i.driven),
            pending: begins | (q.pending & !complete),
            count: period.mux(0, due.mux(q.count, q.count + 1)),
            correct: (complete & !period) | (i.held & at_once),
            late: (q.late & !i.clear) | (period & q.busy),
        };
        let net = Net {
            due,
            complete,
            period,
        };
        (net, next)
    }
}

impl Specified for PeriodJoin {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "correct once both stand and the wait is over, once a period",
                |now, next| {
                    let (q, i) = (&now.q, &now.i);
                    let left = (q.refers && !i.referred) || (q.answers && !i.answered);
                    let over = q.count >= self.wait;
                    let due = match (i.begins || i.held, self.wait) {
                        (true, 0) => i.held,
                        (true, _) => false,
                        (false, _) => q.pending && !left && over,
                    };
                    let waits = match (i.begins, i.held && self.wait > 0) {
                        (false, false) => q.pending && (left || !over),
                        _ => true,
                    };
                    let right = next.q.correct == due && next.q.pending == waits;
                    require(right, ["correct", "pending"], || {
                        format!("not {due}, {waits}")
                    })
                },
            )
            .step(
                "ticks are counted from a period's beginning to the wait",
                |now, next| {
                    let due = match now.i.begins || now.i.held {
                        true => 0,
                        false => (now.q.count + 1).min(self.wait),
                    };
                    require(next.q.count == due, ["count"], || format!("not {due}"))
                },
            )
            .step("both are awaited from a period's beginning", |now, next| {
                let right = next.q.refers && next.q.answers && next.q.busy;
                require(
                    right || !now.i.begins,
                    ["refers", "answers", "busy"],
                    || "not awaited".into(),
                )
            })
            .step(
                "the first point of a path presets, every point is stepped to",
                |now, next| {
                    let due = [now.i.placed && now.q.first, now.i.placed];
                    let seen = [next.q.preset, next.q.step];
                    require(due == seen, ["preset", "step"], || format!("not {due:?}"))
                },
            )
            .step(
                "the first point is awaited from power-on and clear to it",
                |now, next| {
                    let due = match (now.i.clear, now.i.placed) {
                        (true, _) => true,
                        (false, placed) => !placed && now.q.first,
                    };
                    require(next.q.first == due, ["first"], || format!("not {due}"))
                },
            )
            .step("a period is under way to its torques", |now, next| {
                let begins = now.i.begins || now.i.held;
                let due = begins || (now.q.busy && !now.i.driven);
                require(next.q.busy == due, ["busy"], || format!("not {due}"))
            })
            .step("late: a period begins in another", |now, next| {
                let clashes = (now.i.begins || now.i.held) && now.q.busy;
                let due = clashes || (now.q.late && !now.i.clear);
                require(next.q.late == due, ["late"], || format!("not {due}"))
            })
    }
}
