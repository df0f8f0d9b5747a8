//! Target data 20 (¶0004): the next positioning cycles, first in, first out.
//!
//! ```text
//!                          ┌─────────────┐
//!  push, x … times ───────▶│             ├──▶ ready, available
//!  pop ───────────────────▶│ target data ├──▶ target_x, target_y, target_speed,
//!  flush ─────────────────▶│             │    target_acceleration, target_deceleration
//!                          └─────────────┘
//! ```
//!
//! Departure: the text has the target positions ready in a table. Here they come from a control
//! computer through a buffer, so a job can have any length, and each target brings its own speed
//! and times.

use super::Widths;
use crate::prelude::*;

/// Names of the settings of a target: one for both axes, or X's and Y's.
const SPEED: &[&str] = &["speed", "speed_y"];
const ACCELERATION_TIME: &[&str] = &["acceleration_time", "acceleration_time_y"];
const DECELERATION_TIME: &[&str] = &["deceleration_time", "deceleration_time_y"];
const TARGET_SPEED: &[&str] = &["target_speed", "target_speed_y"];
const TARGET_ACCELERATION: &[&str] = &["target_acceleration", "target_acceleration_y"];
const TARGET_DECELERATION: &[&str] = &["target_deceleration", "target_deceleration_y"];
const SPEEDS: &[&str] = &["speeds", "speeds_y"];
const ACCELERATIONS: &[&str] = &["accelerations", "accel_y"];
const DECELERATIONS: &[&str] = &["decelerations", "decel_y"];

/// Target data 20: a buffer of targets, each with settings of speed and times for both axes or for
/// each.
///
/// A target is available in the tick after its push, and is at the outputs from the tick after its
/// pop until the next.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TargetData {
    /// Word widths, by name.
    pub widths: Widths,
    /// Number of settings of a target: 1 for both axes, or 2, X's and Y's.
    pub settings: usize,
}

signals! { for TargetData as c;
    /// Settings of a target: one of each for both axes, or X's and Y's.
    pub struct Settings {
        /// Steady speed of the move, in counts per scan with `T` fraction bits; one for the master
        /// axis, or one for each axis.
        pub speed: [U(c.widths.position); c.settings] as Elements(SPEED),
        /// Acceleration time in scans.
        pub acceleration_time: [U(c.widths.time); c.settings] as Elements(ACCELERATION_TIME),
        /// Deceleration time in scans.
        pub deceleration_time: [U(c.widths.time); c.settings] as Elements(DECELERATION_TIME),
    }
    /// Input ports.
    pub struct In {
        /// Gives a target; ignored unless `ready` or `flush`.
        pub push: Bit,
        /// X of the target, in counts.
        pub x: I(c.widths.position),
        /// Y of the target, in counts.
        pub y: I(c.widths.position),
        /// Speed and times of the move to the target.
        pub settings: Settings(c) as Flat,
        /// Moves the next target to the outputs, if there is one.
        pub pop: Bit,
        /// Discards the targets pushed before this tick.
        pub flush: Bit,
    }
    /// Flip-flops and memories.
    pub struct Reg {
        /// Write address of the next target.
        write_address: U(c.widths.address) as Hex = 0,
        /// Read address of the next target.
        read_address: U(c.widths.address) as Hex = 0,
        /// X of the target popped last.
        pub target_x: I(c.widths.position) = 0,
        /// Y of the target popped last.
        pub target_y: I(c.widths.position) = 0,
        /// Speed of the move to the target popped last.
        pub target_speed: [U(c.widths.position); c.settings] as Elements(TARGET_SPEED),
        /// Acceleration time of that move, in scans.
        pub target_acceleration: [U(c.widths.time); c.settings] as Elements(TARGET_ACCELERATION),
        /// Deceleration time of that move, in scans.
        pub target_deceleration: [U(c.widths.time); c.settings] as Elements(TARGET_DECELERATION),
        /// Buffer of X.
        xs: Ram(c.widths.address, c.widths.position),
        /// Buffer of Y.
        ys: Ram(c.widths.address, c.widths.position),
        /// Buffer of speeds.
        speeds: [Ram(c.widths.address, c.widths.position); c.settings] as Elements(SPEEDS),
        /// Buffer of acceleration times.
        accelerations: [Ram(c.widths.address, c.widths.time); c.settings]
            as Elements(ACCELERATIONS),
        /// Buffer of deceleration times.
        decelerations: [Ram(c.widths.address, c.widths.time); c.settings]
            as Elements(DECELERATIONS),
    }
    /// Nets.
    pub struct Net {
        /// Ready: a target is accepted.
        pub ready: Bit,
        /// A target is waiting.
        pub available: Bit,
        /// A target is accepted in this tick.
        take: Bit,
        /// A target moves to the outputs at the end of this tick.
        bring: Bit,
    }
}

impl Circuit for TargetData {
    const NAME: &'static str = "target_data";
    const ABOUT: &'static str = "buffer of the next positioning cycles";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let fits = (1..=2).contains(&self.settings);
        (!fits).then(|| "a target has settings for both axes or for each".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let (at, to) = (q.read_address, q.write_address);
        let ready = !(to + 1).equals(at);
        let available = !to.equals(at);
        let take = i.push & (ready | i.flush);
        let bring = i.pop & available & !i.flush;

        let read = |ram: &Ram, held: U| ram.read_when(bring, at, held);
        let reads = |rams: &[Ram], held: Vec<U>| {
            rams.iter()
                .zip(held)
                .map(|(ram, held)| read(ram, held))
                .collect()
        };
        let write = |ram: Ram, word: U| ram.write(take, to, word);
        let writes = |rams: Vec<Ram>, words: Vec<U>| {
            rams.into_iter()
                .zip(words)
                .map(|(ram, word)| write(ram, word))
                .collect()
        };
        let next = Reg {
            write_address: take.mux(to + 1, to),
            read_address: i.flush.mux(to, bring.mux(at + 1, at)),
            target_x: read(&q.xs, q.target_x.unsigned()).signed(),
            target_y: read(&q.ys, q.target_y.unsigned()).signed(),
            target_speed: reads(&q.speeds, q.target_speed),
            target_acceleration: reads(&q.accelerations, q.target_acceleration),
            target_deceleration: reads(&q.decelerations, q.target_deceleration),
            xs: write(q.xs, i.x.unsigned()),
            ys: write(q.ys, i.y.unsigned()),
            speeds: writes(q.speeds, i.settings.speed),
            accelerations: writes(q.accelerations, i.settings.acceleration_time),
            decelerations: writes(q.decelerations, i.settings.deceleration_time),
        };
        let net = Net {
            ready,
            available,
            take,
            bring,
        };
        (net, next)
    }
}

impl TargetData {
    /// A target as numbers, X first: the bits of its position, then its settings.
    fn fields<'a>(
        &self,
        position: [i64; 2],
        settings: impl IntoIterator<Item = &'a u64>,
    ) -> Vec<u64> {
        let bits = u64::MAX >> (64 - self.widths.position);
        let position = position.map(|axis| axis as u64 & bits);
        position
            .into_iter()
            .chain(settings.into_iter().copied())
            .collect()
    }

    /// Words of the target at the input ports.
    fn given(&self, i: &In<Value>) -> Vec<u64> {
        let settings = &i.settings;
        let times = settings
            .acceleration_time
            .iter()
            .chain(&settings.deceleration_time);
        self.fields([i.x, i.y], settings.speed.iter().chain(times))
    }

    /// The target at the outputs.
    fn shown(&self, q: &Reg<Value>) -> Vec<u64> {
        let times = q.target_acceleration.iter().chain(&q.target_deceleration);
        self.fields([q.target_x, q.target_y], q.target_speed.iter().chain(times))
    }

    /// Number of targets that wait in the buffer.
    fn level(&self, q: &Reg<Value>) -> u64 {
        let words = 1 << self.widths.address;
        (q.write_address + words - q.read_address) % words
    }

    /// The targets in the buffer.
    fn waiting(&self, q: &Reg<Value>) -> Vec<Vec<u64>> {
        let settings = q
            .speeds
            .iter()
            .chain(&q.accelerations)
            .chain(&q.decelerations);
        let rams: Vec<_> = [&q.xs, &q.ys].into_iter().chain(settings).collect();
        let place = |k| (q.read_address + k) % (1 << self.widths.address);
        let target = |address| rams.iter().map(|ram| ram[address as usize]).collect();
        (0..self.level(q)).map(|k| target(place(k))).collect()
    }
}

impl Specified for TargetData {
    fn invariants(&self) -> Invariants<'_, Self> {
        let most = (1 << self.widths.address) - 1;
        Invariants::<Self>::new()
            .step(
                "push appends a target, pop removes the oldest, and flush removes all",
                move |now, next| {
                    let i = now.i;
                    let mut expected = self.waiting(now.q);
                    let pushed = i.push && (i.flush || expected.len() < most);
                    if i.flush {
                        expected.clear();
                    } else if i.pop && !expected.is_empty() {
                        expected.remove(0);
                    }
                    expected.extend(pushed.then(|| self.given(i)));
                    let signals = ["write_address", "read_address", "xs", "ys"];
                    require(self.waiting(&next.q) == expected, signals, || {
                        format!("{expected:?} expected")
                    })
                },
            )
            .step(
                "the outputs hold the target that was popped last",
                |now, next| {
                    let popped = now.i.pop && !now.i.flush;
                    let first = self.waiting(now.q).into_iter().next().filter(|_| popped);
                    let expected = first.unwrap_or_else(|| self.shown(now.q));
                    let signals = ["target_x", "target_y"];
                    require(self.shown(&next.q) == expected, signals, || {
                        format!("{expected:?}")
                    })
                },
            )
            .always(
                "ready is high unless the queue is full, and available unless it is empty",
                move |now| {
                    let level = self.level(now.q);
                    let right =
                        now.w.ready == (level < most as u64) && now.w.available == (level > 0);
                    require(right, ["ready", "available"], || format!("{level} wait"))
                },
            )
    }

    /// All fields of a target alike: none looks at another.
    fn applies(&self, i: &In<Value>) -> bool {
        let fields = self.given(i);
        fields.iter().all(|field| *field == fields[0]) && (i.push || fields[0] == 0)
    }
}
