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

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let target = i.load.mux(q.targets.read(i.step), q.target.unsigned());
        let speed = i.load.mux(q.speeds.read(i.step), q.speed);
        let loaded = next.target.unsigned().equals(target) & next.speed.equals(speed);
        let mut written = Bit::high();
        for step in words_to_compare(&q.targets, [i.step, i.write_step]) {
            let here = i.write & i.write_step.equals(step);
            let target = here.mux(i.write_target.unsigned(), q.targets.read(step));
            let speed = here.mux(i.write_speed, q.speeds.read(step));
            let right = next.targets.read(step).equals(target);
            written = written & right & next.speeds.read(step).equals(speed);
        }
        vec![
            Property::step(
                "target and speed are those of the step that was loaded last",
                &["target", "speed"],
                loaded,
            ),
            Property::step(
                "a write changes the words of write_step and no others",
                &["targets", "speeds"],
                written,
            ),
        ]
    }
}

/// Returns the addresses at which a property compares a memory before and after an edge: all of
/// them, or those of two ports that a write does not tie if there are many.
pub(super) fn words_to_compare(words: &Words, ports: [U; 2]) -> Vec<U> {
    match words.len() {
        words @ ..=64 => {
            let words = 0..words as u64;
            words.map(|word| U::new(word, ports[0].width())).collect()
        }
        // Every word is that of a port in some tick.
        _ => ports.into(),
    }
}

impl Specified for TargetSetter {
    /// Both words of a step alike: none looks at the other.
    fn applies(&self, i: &In<Value>) -> bool {
        (i.write_target as u64).cut(self.speed.min(self.position)) == i.write_speed
    }
}
