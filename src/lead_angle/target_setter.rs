//! Target setter 18: a target position and a speed for each step.
//!
//! ```text
//!                                     ┌───────────────┐
//!  write, write_step ────────────────▶│               ├──▶ target
//!  write_target, write_speed ────────▶│ target setter │
//!  load, step ───────────────────────▶│               ├──▶ speed
//!                                     └───────────────┘
//! ```
//!
//! Departure: the speed stands with the target, since the drive needs one for each step too.

use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Nothing};
use crate::logic::{Logic, Ram, Signed, Sim, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const A: usize, const W: usize, const D: usize> {
        /// The control computer writes a step.
        pub write: L::Bit,
        /// The step that is written.
        pub write_step: L::U<A>,
        /// Its target.
        pub write_target: L::I<W>,
        /// Its speed.
        pub write_speed: L::U<D>,
        /// The step that begins comes to the outputs.
        pub load: L::Bit,
        /// The step that begins.
        pub step: L::U<A>,
    }
}

signals! {
    /// Output registers and memories.
    pub struct Reg<L, const A: usize, const W: usize, const D: usize> {
        /// Sx: where this step ends.
        pub target: L::I<W> as Analog,
        /// The speed on the way there, for the drive.
        pub speed: L::U<D>,
        /// Targets by step.
        targets: L::Ram<A, W>,
        /// Speeds by step.
        speeds: L::Ram<A, D>,
    }
}

/// Target setter 18 of 2^`A` steps with positions of `W` bits and speeds of `D`; a step stands at
/// the outputs in the tick after `load`.
#[derive(Debug, Clone, Default)]
pub struct TargetSetter<const A: usize, const W: usize, const D: usize>;

impl<const A: usize, const W: usize, const D: usize> Circuit for TargetSetter<A, W, D> {
    const NAME: &'static str = "target_setter";
    const ABOUT: &'static str = "target position and speed of each step";
    type In<L: Logic> = In<L, A, W, D>;
    type Reg<L: Logic> = Reg<L, A, W, D>;
    type Net<L: Logic> = Nothing<L>;

    fn comb<L: Logic>(&self, _: &Reg<L, A, W, D>, _: &In<L, A, W, D>) -> Self::Net<L> {
        Nothing::new()
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, A, W, D>,
        _: &Self::Net<L>,
        i: &In<L, A, W, D>,
    ) -> Reg<L, A, W, D> {
        let held = q.target.unsigned();
        Reg {
            target: q.targets.read_when(i.load, i.step, held).signed(),
            speed: q.speeds.read_when(i.load, i.step, q.speed),
            targets: q
                .targets
                .write(i.write, i.write_step, i.write_target.unsigned()),
            speeds: q.speeds.write(i.write, i.write_step, i.write_speed),
        }
    }
}

impl<const A: usize, const W: usize, const D: usize> Specified for TargetSetter<A, W, D> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let word = |q: &Reg<Sim, A, W, D>, step: u64| {
            let (target, speed) = (q.targets.read(step.into()), q.speeds.read(step.into()));
            (target.get(), speed.get())
        };
        let shown = |q: &Reg<Sim, A, W, D>| (q.target.unsigned().get(), q.speed.get());
        Invariants::<Self>::new()
            .step(
                "the outputs show the step that was loaded last",
                move |now, next| {
                    let expected = match now.i.load.get() {
                        true => word(now.q, now.i.step.get()),
                        false => shown(now.q),
                    };
                    require(shown(next) == expected, ["target", "speed"], || {
                        format!("{expected:?} expected")
                    })
                },
            )
            .step("a write changes its step and no other", move |now, next| {
                let i = now.i;
                let right = (0..1 << A).all(|step: u64| {
                    let written = i.write.get() && i.write_step.get() == step;
                    let expected = match written {
                        true => (i.write_target.unsigned().get(), i.write_speed.get()),
                        false => word(now.q, step),
                    };
                    word(next, step) == expected
                });
                require(right, ["targets", "speeds"], || "another".into())
            })
    }

    /// Both words of a step alike: none looks at the other.
    fn applies(&self, i: &In<Sim, A, W, D>) -> bool {
        i.write_target.unsigned().get() & ((1 << D.min(W)) - 1) == i.write_speed.get()
    }
}
