//! Target setter 18: holds a target position and a speed for each step.
//!
//! ```text
//!                                     ┌───────────────┐
//!  write, write_step ────────────────▶│               ├──▶ target
//!  write_target, write_speed ────────▶│ target setter │
//!  load, step ───────────────────────▶│               ├──▶ speed
//!                                     └───────────────┘
//! ```
//!
//! Departure: the speed is stored with the target, because the drive needs one for each step too.

use super::position_history::stored;
use crate::prelude::*;

/// Target setter 18; target and speed of a step are at the outputs in the tick after `load`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TargetSetter {
    /// Width of a step number.
    pub step: usize,
    /// Width of a position.
    pub position: usize,
    /// Width of a speed.
    pub speed: usize,
}

signals! { for TargetSetter as c;
    /// Input ports.
    pub struct In {
        /// Writes target and speed of a step.
        pub write: Bit,
        /// Number of the step to write.
        pub write_step: U(c.step),
        /// Target to write.
        pub write_target: I(c.position),
        /// Speed to write.
        pub write_speed: U(c.speed),
        /// Reads target and speed of the step that begins.
        pub load: Bit,
        /// Number of the step that begins.
        pub step: U(c.step),
    }
    /// Output registers and memories.
    pub struct Reg {
        /// Sx: target of this step.
        pub target: I(c.position) as Analog,
        /// Speed of the move to the target, for the drive.
        pub speed: U(c.speed),
        /// Targets, by step.
        targets: Ram(c.step, c.position),
        /// Speeds, by step.
        speeds: Ram(c.step, c.speed),
    }
}

impl Circuit for TargetSetter {
    const NAME: &'static str = "target_setter";
    const ABOUT: &'static str = "target position and speed of each step";
    records!(In, Reg, Nothing);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
        let held = q.target.unsigned();
        let target = i.write_target.unsigned();
        let edge = Reg {
            target: q.targets.read_when(i.load, i.step, held).signed(),
            speed: q.speeds.read_when(i.load, i.step, q.speed),
            targets: q.targets.write(i.write, i.write_step, target),
            speeds: q.speeds.write(i.write, i.write_step, i.write_speed),
        };
        (Nothing, edge)
    }
}

impl Specified for TargetSetter {
    fn invariants(&self) -> Invariants<'_, Self> {
        let bits = |target: i64| stored(target, self.position);
        let word = |q: &Reg<Value>, step: u64| (q.targets[step as usize], q.speeds[step as usize]);
        let shown = move |q: &Reg<Value>| (bits(q.target), q.speed);
        Invariants::<Self>::new()
            .step(
                "target and speed are those of the step that was loaded last",
                move |now, next| {
                    let expected = match now.i.load {
                        true => word(now.q, now.i.step),
                        false => shown(now.q),
                    };
                    require(shown(&next.q) == expected, ["target", "speed"], || {
                        format!("{expected:?} expected")
                    })
                },
            )
            .step(
                "a write changes the words of write_step and no others",
                move |now, next| {
                    let i = now.i;
                    let right = (0..1 << self.step).all(|step: u64| {
                        let expected = match i.write && i.write_step == step {
                            true => (bits(i.write_target), i.write_speed),
                            false => word(now.q, step),
                        };
                        word(&next.q, step) == expected
                    });
                    require(right, ["targets", "speeds"], || "another".into())
                },
            )
    }

    /// Both words of a step alike: none looks at the other.
    fn applies(&self, i: &In<Value>) -> bool {
        stored(i.write_target, self.speed.min(self.position)) == i.write_speed
    }
}
