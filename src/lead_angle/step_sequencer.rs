//! Step sequencer: runs the positioning steps over and over. The text's external sequencer that
//! gives the step number.
//!
//! ```text
//!                            ┌────────────────┐
//!  run, halt, last_step ────▶│                ├──▶ load, arm, step
//!  position, target ────────▶│ step sequencer ├──▶ drive, reverse
//!  control, complete ───────▶│                ├──▶ halting, braking
//!  corrected, ck, rest ─────▶│                ├──▶ missed, busy
//!                            └────────────────┘
//! ```
//!
//! A step: *load* its target and its time, *arm* the comparator until a sample says which way it is,
//! *move* until the control signal, *brake* until the positioning is complete, *correct* the time,
//! *rest*. Then the next step, from step 0 again after the last, as long as `run` is high.
//!
//! `halt` during *move* gives the control signal by hand; what comes of it is not learned from.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Sim, Unsigned};
use crate::signals;

/// Names of the states.
const STATES: &[&str] = &["idle", "load", "arm", "move", "brake", "correct", "rest"];
const IDLE: u64 = 0;
const LOAD: u64 = 1;
const ARM: u64 = 2;
const MOVE: u64 = 3;
const BRAKE: u64 = 4;
const CORRECT: u64 = 5;
const REST: u64 = 6;

signals! {
    /// Ports in.
    pub struct In<L, const A: usize, const W: usize, const N: usize> {
        /// Steps run one after the other; when it goes low the running one is the last.
        pub run: L::Bit,
        /// Ends the move of this step at once.
        pub halt: L::Bit,
        /// The step after which step 0 comes.
        pub last_step: L::U<A>,
        /// Dx.
        pub position: L::I<W>,
        /// Sx, there from the tick after `load`.
        pub target: L::I<W>,
        /// The control signal.
        pub control: L::Bit,
        /// The positioning is complete.
        pub complete: L::Bit,
        /// The position is new in this tick.
        pub evaluate: L::Bit,
        /// The correction is over.
        pub corrected: L::Bit,
        /// CK.
        pub ck: L::Bit,
        /// CKs between two steps.
        pub rest: L::U<N>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const A: usize, const N: usize> {
        /// What it does.
        state: L::U<3> as States(STATES) = 0,
        /// CKs of rest.
        count: L::U<N> = 0,
        /// The step that runs, or is next.
        pub step: L::U<A> = 0,
        /// The step's target and time are read; one tick.
        pub load: L::Bit = 0,
        /// The comparator is set back, until a sample is there.
        pub arm: L::Bit = 0,
        /// The motor is on.
        pub drive: L::Bit = 0,
        /// It turns downwards.
        pub reverse: L::Bit = 0,
        /// The control signal is asked for; one tick.
        pub halting: L::Bit = 0,
        /// The body is being stopped.
        pub braking: L::Bit = 0,
        /// The control signal was asked for in this step.
        pub missed: L::Bit = 0,
        /// A step runs.
        pub busy: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const A: usize, const W: usize> {
        /// The way to the target, the short way round.
        way: L::I<W>,
        /// The state is over with this tick, and the one after it comes.
        goes_on: L::Bit,
        /// A halt is taken.
        halts: L::Bit,
        /// The rest is over with this tick.
        rested: L::Bit,
        /// The state of the next tick.
        after: L::U<3> as States(STATES),
        /// The step of the next tick.
        next_step: L::U<A>,
    }
}

/// Step sequencer of 2^`A` steps, positions of `W` bits, rests of `N` bits. `load` shows in the tick
/// after `run`, `drive` in the tick after the first sample from two ticks after `run` on; it goes in
/// the tick after `control` came.
#[derive(Debug, Clone, Default)]
pub struct StepSequencer<const A: usize, const W: usize, const N: usize>;

impl<const A: usize, const W: usize, const N: usize> Circuit for StepSequencer<A, W, N> {
    const NAME: &'static str = "step_sequencer";
    const ABOUT: &'static str = "runs the positioning steps over and over";
    type In<L: Logic> = In<L, A, W, N>;
    type Reg<L: Logic> = Reg<L, A, N>;
    type Net<L: Logic> = Net<L, A, W>;

    fn comb<L: Logic>(&self, q: &Reg<L, A, N>, i: &In<L, A, W, N>) -> Net<L, A, W> {
        let is = |state: u64| q.state.equals(state.into());
        let rested = is(REST) & !q.count.below(i.rest);
        let begin: L::U<3> = i.run.mux(LOAD.into(), IDLE.into());
        let goes_on = is(LOAD)
            | (is(ARM) & i.evaluate)
            | (is(MOVE) & i.control)
            | (is(BRAKE) & i.complete)
            | (is(CORRECT) & i.corrected);
        let onwards = goes_on.mux(q.state + 1, q.state);
        let last = !q.step.below(i.last_step);
        let following = last.mux(0.into(), q.step + 1);
        Net {
            way: i.target - i.position,
            goes_on,
            halts: i.halt & q.drive & !q.missed,
            rested,
            after: (is(IDLE) | rested).mux(begin, onwards),
            next_step: rested.mux(following, q.step),
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, A, N>,
        w: &Net<L, A, W>,
        i: &In<L, A, W, N>,
    ) -> Reg<L, A, N> {
        let to = |state: u64| w.after.equals(state.into());
        let resting = q.state.equals(REST.into()) & !w.rested;
        let counted = i.ck.mux(q.count + 1, q.count);
        Reg {
            state: w.after,
            count: resting.mux(counted, 0.into()),
            step: w.next_step,
            load: to(LOAD),
            arm: to(ARM),
            drive: to(MOVE),
            reverse: q.arm.mux(w.way.is_negative(), q.reverse),
            halting: w.halts,
            braking: to(BRAKE),
            missed: (q.missed | w.halts) & !q.load,
            busy: !to(IDLE),
        }
    }
}

/// The state after `state`.
fn after<const A: usize, const W: usize, const N: usize>(
    q: &Reg<Sim, A, N>,
    i: &In<Sim, A, W, N>,
) -> u64 {
    let begin = if i.run.get() { LOAD } else { IDLE };
    match q.state.get() {
        IDLE => begin,
        LOAD => ARM,
        ARM if i.evaluate.get() => MOVE,
        MOVE if i.control.get() => BRAKE,
        BRAKE if i.complete.get() => CORRECT,
        CORRECT if i.corrected.get() => REST,
        REST if q.count.get() >= i.rest.get() => begin,
        other => other,
    }
}

impl<const A: usize, const W: usize, const N: usize> Specified for StepSequencer<A, W, N> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("a step goes through its states in order", |now, next| {
                let expected = after(now.q, now.i);
                require(next.state.get() == expected, ["state"], || {
                    format!("{} expected", STATES[expected as usize])
                })
            })
            .always("every output belongs to its state", |now| {
                let q = now.q;
                let state = q.state.get();
                let right = q.load.get() == (state == LOAD)
                    && q.arm.get() == (state == ARM)
                    && q.drive.get() == (state == MOVE)
                    && q.braking.get() == (state == BRAKE)
                    && q.busy.get() == (state != IDLE);
                require(right, ["load", "arm", "drive", "braking", "busy"], || {
                    format!("in {}", STATES[state as usize])
                })
            })
            .step("steps come in turn, each after its rest", |now, next| {
                let ends = now.q.state.get() == REST && next.state.get() != REST;
                let step = now.q.step.get();
                let expected = match ends {
                    true if step >= now.i.last_step.get() => 0,
                    true => step + 1,
                    false => step,
                };
                require(next.step.get() == expected, ["step"], || {
                    format!("{expected} expected")
                })
            })
            .step(
                "the drive turns to the target, the short way round",
                |now, next| {
                    let armed = now.q.state.get() == ARM;
                    let way = now.i.target - now.i.position;
                    let expected = match armed {
                        true => way.get() < 0,
                        false => now.q.reverse.get(),
                    };
                    require(next.reverse.get() == expected, ["reverse"], || {
                        format!("a way of {}", way.get())
                    })
                },
            )
            .step(
                "a halt of the move asks for the control signal once, and is remembered",
                |now, next| {
                    let q = now.q;
                    let halts = now.i.halt.get() && q.state.get() == MOVE && !q.missed.get();
                    let missed = (q.missed.get() || halts) && q.state.get() != LOAD;
                    let right = next.halting.get() == halts && next.missed.get() == missed;
                    require(right, ["halting", "missed"], || {
                        format!("{halts} and {missed} expected")
                    })
                },
            )
            .step("the rest counts CKs", |now, next| {
                let stays = now.q.state.get() == REST && next.state.get() == REST;
                let more = now.q.count.get() + u64::from(now.i.ck.get());
                let expected = if stays { more } else { 0 };
                require(next.count.get() == expected, ["count"], || {
                    format!("{expected} expected")
                })
            })
    }

    /// Two last steps and the greatest: any other differs in nothing.
    fn applies(&self, i: &In<Sim, A, W, N>) -> bool {
        i.last_step.get() < 2 || i.last_step.get() + 1 == 1 << A
    }
}
