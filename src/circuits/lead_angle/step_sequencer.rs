//! Step sequencer: runs the positioning steps again and again. The text's external sequencer, which
//! gives the step number.
//!
//! ```text
//!                            ┌────────────────┐
//!  run, halt, last_step ────▶│                ├──▶ load, arm, step
//!  position, target ────────▶│ step sequencer ├──▶ drive, reverse
//!  control, complete ───────▶│                ├──▶ halting, braking
//!  corrected, ck, rest ─────▶│                ├──▶ missed, busy
//!  passing ─────────────────▶│                │
//!                            └────────────────┘
//! ```
//!
//! A step: *load* its target and its time, *arm* the comparator until a sample gives the direction,
//! *move* until the control signal, *brake* until the positioning is complete, *correct* the time,
//! *rest*. The next step follows, step 0 after the last, as long as `run` is high.
//!
//! With `passing` the control signal does not stop the body. The motor is on from the first *move*
//! until the last step is over, and *brake* waits for the operation that the signal starts. If
//! `passing` falls meanwhile, the signal stops the body.
//!
//! `halt` during *move* requests the control signal. In either case nothing is learned.

use crate::prelude::*;

/// Step sequencer. `load` is high in the tick after `run`. `drive` rises in the tick after the
/// first sample that comes two ticks after `run` or later, and falls in the tick after `control`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepSequencer {
    /// Width of a step number.
    pub step: usize,
    /// Width of a position.
    pub position: usize,
    /// Width of a rest in CKs.
    pub rest: usize,
}

/// Names of the states.
const STATES: &[&str] = &["idle", "load", "arm", "move", "brake", "correct", "rest"];
const IDLE: u64 = 0;
const LOAD: u64 = 1;
const ARM: u64 = 2;
const MOVE: u64 = 3;
pub(super) const BRAKE: u64 = 4;
pub(super) const CORRECT: u64 = 5;
const REST: u64 = 6;

signals! { for StepSequencer as c;
    /// Input ports.
    pub struct In {
        /// Runs the steps one after the other; when it falls, the running step is the last.
        pub run: Bit,
        /// Ends the move of this step immediately.
        pub halt: Bit,
        /// Number of the last step; step 0 follows it.
        pub last_step: U(c.step),
        /// Dx.
        pub position: I(c.position),
        /// Sx; valid from the tick after `load`.
        pub target: I(c.position),
        /// Control signal.
        pub control: Bit,
        /// The positioning is complete.
        pub complete: Bit,
        /// The position is new in this tick.
        pub evaluate: Bit,
        /// The correction is over.
        pub corrected: Bit,
        /// CK.
        pub ck: Bit,
        /// High: the body does not stop, and the motor stays on from step to step.
        pub passing: Bit,
        /// Pause between two steps, in CKs.
        pub rest: U(c.rest),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        pub(super) state: U(3) as States(STATES) = 0,
        /// CKs since the rest began.
        count: U(c.rest) = 0,
        /// Number of the running step, or of the next one.
        pub step: U(c.step) = 0,
        /// High for one tick: target and time of the step are read.
        pub load: Bit = 0,
        /// Resets the comparator, until a sample is ready.
        pub arm: Bit = 0,
        /// The motor is on.
        pub drive: Bit = 0,
        /// Direction of the motor; high counts down.
        pub reverse: Bit = 0,
        /// High for one tick: requests the control signal.
        pub halting: Bit = 0,
        /// The body is being stopped, or the effect of the control signal is awaited.
        pub braking: Bit = 0,
        /// The control signal of this step was requested by `halt`, or stops the body instead of
        /// starting an operation.
        pub missed: Bit = 0,
        /// A step is running.
        pub busy: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// Distance to the target, the shorter way round the ring.
        way: I(c.position),
        /// The state ends with this tick, and the next state follows.
        goes_on: Bit,
        /// A halt is accepted.
        halts: Bit,
        /// `passing` falls while an operation is awaited: the body is stopped instead.
        stopped: Bit,
        /// The rest ends with this tick.
        rested: Bit,
        /// State of the next tick.
        after: U(3) as States(STATES),
        /// The state of the next tick is not idle.
        works: Bit,
        /// `step` of the next tick.
        next_step: U(c.step),
    }
}

impl Circuit for StepSequencer {
    const NAME: &'static str = "step_sequencer";
    const ABOUT: &'static str = "runs the positioning steps again and again";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let is = |state: u64| q.state.equals(state);
        let rested = is(REST) & !q.count.below(i.rest);
        let begin = i.run.mux(U::new(LOAD, 3), IDLE);
        let goes_on = is(LOAD)
            | (is(ARM) & i.evaluate)
            | (is(MOVE) & i.control)
            | (is(BRAKE) & i.complete)
            | (is(CORRECT) & i.corrected);
        let onwards = goes_on.mux(q.state + 1, q.state);
        let last = !q.step.below(i.last_step);
        let following = last.mux(0, q.step + 1);
        let way = i.target - i.position;
        let halts = i.halt & is(MOVE) & !q.missed;
        let stopped = is(BRAKE) & q.drive & !i.passing;
        let after = (is(IDLE) | rested).mux(begin, onwards);
        let next_step = rested.mux(following, q.step);
        let to = |state: u64| after.equals(state);
        let resting = is(REST) & !rested;
        let counted = i.ck.mux(q.count + 1, q.count);
        let works = !to(IDLE);
        let edge = Reg {
            state: after,
            count: resting.mux(counted, 0),
            step: next_step,
            load: to(LOAD),
            arm: to(ARM),
            drive: to(MOVE) | (i.passing & q.drive & works),
            reverse: q.arm.mux(way.is_negative(), q.reverse),
            halting: halts,
            braking: to(BRAKE),
            missed: (q.missed | halts | stopped) & !q.load,
            busy: works,
        };
        let net = Net {
            way,
            goes_on,
            halts,
            stopped,
            rested,
            after,
            works,
            next_step,
        };
        (net, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let is = |state: u64| q.state.equals(state);
        let to = |state: u64| next.state.equals(state);
        let outputs = q.load.equals(is(LOAD)) & q.arm.equals(is(ARM)) & q.braking.equals(is(BRAKE));
        let drive = to(MOVE) | (i.passing & q.drive & !to(IDLE));

        let following = q.step.below(i.last_step).mux(q.step + 1, 0);
        let step = (is(REST) & !to(REST)).mux(following, q.step);
        let down = (i.target - i.position).is_negative();
        let reverse = is(ARM).mux(down, q.reverse);

        let halts = i.halt & is(MOVE) & !q.missed;
        let stopped = is(BRAKE) & q.drive & !i.passing;
        let missed = (q.missed | halts | stopped) & !is(LOAD);
        let more = next.count.equals(q.count + 1) & q.count.below(next.count);
        let counted = i.ck.mux(more, next.count.equals(q.count));
        let counts = (is(REST) & to(REST)).mux(counted, next.count.is_zero());
        vec![
            Property::step(
                "every transition is one of the sequence of a step",
                &["state"],
                next.state.equals(after(i, q)),
            ),
            Property::always(
                "load, arm and braking are high in their own state only, busy in all but idle",
                &["load", "arm", "braking", "busy"],
                outputs & (q.busy ^ is(IDLE)),
            ),
            Property::step(
                "drive is high in move, low in idle, and elsewhere stays high only with passing",
                &["drive"],
                next.drive.equals(drive),
            ),
            Property::step(
                "step advances at the end of rest, from last_step to 0",
                &["step"],
                next.step.equals(step),
            ),
            Property::step(
                "in arm, reverse is set for the shorter way to the target, and otherwise it stays",
                &["reverse"],
                next.reverse.equals(reverse),
            ),
            Property::step(
                "the first halt in move pulses halting; it and a stop in place of an operation set missed",
                &["halting", "missed"],
                next.halting.equals(halts) & next.missed.equals(missed),
            ),
            Property::step(
                "count counts CKs in rest, and is 0 otherwise",
                &["count"],
                counts,
            ),
        ]
    }
}

/// Returns the state after this one.
fn after(i: &In, q: &Reg<Open>) -> U {
    let begin = i.run.mux(U::new(LOAD, 3), IDLE);
    let onwards = [
        (IDLE, Bit::high(), begin),
        (LOAD, Bit::high(), U::new(ARM, 3)),
        (ARM, i.evaluate, U::new(MOVE, 3)),
        (MOVE, i.control, U::new(BRAKE, 3)),
        (BRAKE, i.complete, U::new(CORRECT, 3)),
        (CORRECT, i.corrected, U::new(REST, 3)),
        (REST, !q.count.below(i.rest), begin),
    ];
    let mut after = q.state;
    for (state, ends, then) in onwards {
        after = (q.state.equals(state) & ends).mux(then, after);
    }
    after
}

impl Specified for StepSequencer {
    /// Two last steps and the greatest: any other differs in nothing.
    fn applies(&self, i: &In<Value>) -> bool {
        i.last_step < 2 || i.last_step + 1 == 1 << self.step
    }
}
