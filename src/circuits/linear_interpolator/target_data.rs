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

/// Words of a buffer that a property compares one by one; of a longer buffer it reads only the word
/// that is written.
const MOST_WORDS: usize = 256;

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
        /// Steady speed of the master axis (in the conventional system: of one axis), in counts per
        /// scan with `T` fraction bits.
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

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let (at, to) = (q.read_address, q.write_address);
        let waiting = to - at;
        let most = u64::MAX.cut(self.widths.address);
        let (empty, full) = (waiting.is_zero(), waiting.equals(most));
        let pops = i.pop & !empty & !i.flush;
        let pushes = i.push & (!full | i.flush);
        let reads_on = i.flush.mux(to, pops.mux(at + 1, at));
        let is_at = next.read_address.equals(reads_on);
        let is_to = next.write_address.equals(pushes.mux(to + 1, to));
        let fields = fields(now);
        let stored = fields.iter().map(|field| field.stores(pushes, to));
        let shown = fields.iter().map(|field| field.shows(pops, at));
        vec![
            Property::step(
                "push appends a target, pop removes the oldest, and flush removes all",
                &["write_address", "read_address", "xs", "ys"],
                is_at & is_to & Bit::all(stored),
            ),
            Property::step(
                "the outputs hold the target that was popped last",
                &["target_x", "target_y"],
                Bit::all(shown),
            ),
            Property::always(
                "ready is high unless the queue is full, and available unless it is empty",
                &["ready", "available"],
                (w.ready ^ full) & (w.available ^ empty),
            ),
        ]
    }
}

/// Field of a target: its input port, its buffer and its output, before and after the edge.
struct Field<'a> {
    given: U,
    words: [&'a Words; 2],
    shown: [U; 2],
}

impl Field<'_> {
    /// High if the edge stores the field at `to` if `pushes` is high, and keeps all words but that
    /// one.
    fn stores(&self, pushes: Bit, to: U) -> Bit {
        let [words, after] = self.words;
        let stored = !pushes | after.read(to).equals(self.given);
        let kept = |index: usize| {
            let same = after.word(index).equals(words.word(index));
            to.equals(index as u64) | same
        };
        match words.len() {
            0..=MOST_WORDS => stored & Bit::all((0..words.len()).map(kept)),
            _ => stored,
        }
    }

    /// High if the edge brings the word at `at` to the output if `pops` is high.
    fn shows(&self, pops: Bit, at: U) -> Bit {
        let [shown, after] = self.shown;
        after.equals(pops.mux(self.words[0].read(at), shown))
    }
}

/// Returns the fields of a target.
fn fields(now: &Moment<TargetData>) -> Vec<Field<'_>> {
    let (i, q, next) = (&now.i, &now.q, &now.next.q);
    let axis = |given: I, words, [before, after]: [I; 2]| Field {
        given: given.unsigned(),
        words,
        shown: [before.unsigned(), after.unsigned()],
    };
    let settings = [
        (
            &i.settings.speed,
            [&q.speeds, &next.speeds],
            [&q.target_speed, &next.target_speed],
        ),
        (
            &i.settings.acceleration_time,
            [&q.accelerations, &next.accelerations],
            [&q.target_acceleration, &next.target_acceleration],
        ),
        (
            &i.settings.deceleration_time,
            [&q.decelerations, &next.decelerations],
            [&q.target_deceleration, &next.target_deceleration],
        ),
    ];
    let mut all = vec![
        axis(i.x, [&q.xs, &next.xs], [q.target_x, next.target_x]),
        axis(i.y, [&q.ys, &next.ys], [q.target_y, next.target_y]),
    ];
    for (given, words, shown) in settings {
        all.extend((0..given.len()).map(|at| Field {
            given: given[at],
            words: words.map(|words| &words[at]),
            shown: shown.map(|words| words[at]),
        }));
    }
    all
}

impl Specified for TargetData {
    /// All fields of a target alike: none looks at another.
    fn applies(&self, i: &In<Value>) -> bool {
        let settings = &i.settings;
        let bits = u64::MAX >> (64 - self.widths.position);
        let times = [&settings.acceleration_time, &settings.deceleration_time];
        let words = times.into_iter().chain([&settings.speed]).flatten();
        let first = i.x as u64 & bits;
        let alike = i.y == i.x && words.into_iter().all(|word| *word == first);
        alike && (i.push || first == 0)
    }
}
