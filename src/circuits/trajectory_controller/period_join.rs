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
//! The commands are corrected in the same tick of every period, whatever time the points took. The
//! servo controls then sample their motors at equal intervals, and the distance between two samples
//! is the speed of a motor.
//! With the first point of a path, the servo responses are set to this point, at rest. So a path
//! begins where the machine is, and rounding errors of the previous path are not corrected in the
//! new one.

use crate::prelude::*;

/// Join of the reference point and the servo responses.
/// `correct` is high `wait` + 2 ticks after `begins`, or later if points take longer. After `held`
/// it comes at the same tick; if `wait` is 0, it comes one tick after `held`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PeriodJoin {
    /// Waiting time of every period in ticks, below 1023: the longest time of any period.
    pub wait: u64,
}

signals! { for PeriodJoin as c;
    /// Input ports.
    pub struct In {
        /// A period begins with a length on the path.
        pub begins: Bit,
        /// A period begins without a path: the corrected commands keep their values, and the servo
        /// controls continue.
        pub held: Bit,
        /// The position command is valid.
        pub placed: Bit,
        /// The reference point is valid.
        pub referred: Bit,
        /// The servo responses are valid.
        pub answered: Bit,
        /// The torques are valid.
        pub driven: Bit,
        /// Selects another path: its first point is awaited. Clears `late`.
        pub clear: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// The first point of a path is awaited.
        first: Bit = 1,
        /// Sets the servo responses to the position command.
        pub preset: Bit = 0,
        /// Advances the servo responses towards the position command.
        pub step: Bit = 0,
        /// The reference point is awaited.
        refers: Bit = 0,
        /// The servo responses are awaited.
        answers: Bit = 0,
        /// The correction is awaited.
        pending: Bit = 0,
        /// Ticks since the period began, up to `wait`.
        count: U(10) = 0,
        /// A period is running.
        pub busy: Bit = 0,
        /// Corrects the commands: reference point and servo responses are valid.
        pub correct: Bit = 0,
        /// A period has begun before the previous one was complete; cleared by `clear`.
        pub late: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// The waiting time of the correction is over.
        due: Bit,
        /// The reference point and the servo responses are valid, and the correction is due.
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

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let begins = i.begins | i.held;
        let (at_once, later): (Bit, Bit) = ((self.wait == 0).into(), (self.wait > 0).into());
        let left = (q.refers & !i.referred) | (q.answers & !i.answered);
        let over = !q.count.below(self.wait);
        let correct = begins.mux(i.held & at_once, q.pending & !left & over);
        let waits = i.begins | (i.held & later) | (q.pending & (left | !over));
        let count = begins.mux(0, over.mux(U::new(self.wait, 10), q.count + 1));
        vec![
            Property::step(
                "correct comes once a period, after reference, responses and the wait",
                &["correct", "pending"],
                next.correct.equals(correct) & next.pending.equals(waits),
            ),
            Property::step(
                "the count is the number of ticks since the period began, up to the wait",
                &["count"],
                next.count.equals(count),
            ),
            Property::step(
                "from the beginning of a period, reference and responses are awaited",
                &["refers", "answers", "busy"],
                i.begins.implies(next.refers & next.answers & next.busy),
            ),
            Property::step(
                "the first point of a path presets the responses, and every point advances them",
                &["preset", "step"],
                next.preset.equals(i.placed & q.first) & next.step.equals(i.placed),
            ),
            Property::step(
                "after power-on and after clear, the first point is awaited",
                &["first"],
                next.first.equals(i.clear | (!i.placed & q.first)),
            ),
            Property::step(
                "a period is busy from its beginning until its torques are valid",
                &["busy"],
                next.busy.equals(begins | (q.busy & !i.driven)),
            ),
            Property::step(
                "late is set if a period begins before the previous one is complete",
                &["late"],
                next.late.equals((begins & q.busy) | (q.late & !i.clear)),
            ),
        ]
    }
}

impl Specified for PeriodJoin {}
