//! Arc generator: position commands of x, y, z on lines, blends and arcs in space.
//!
//! ```text
//!                          ┌───────────────┐
//!  write, write_word, … ──▶│               ├──▶ x, y, z, sampled
//!  push ──────────────────▶│               ├──▶ ready, busy, kind
//!  start, halt ───────────▶│ arc_generator ├──▶ late, starved
//!  sample_period ─────────▶│               │
//!                          └───────────────┘
//! ```

use super::{
    Conventional, PositionCommand, Rotation, Rounding, Widths, position_command, rotation,
};
use crate::circuits::blocks::{
    DifferenceEngine, EnableCounter, RecordMemory, RecordSequencer, difference_engine,
    enable_counter, record_memory, record_sequencer,
};
use crate::hdl::prelude::*;

/// Arc generator.
///
/// The first point of a path is the command one tick after the first sampling time for which it is
/// ready, [`first`](ArcGenerator::first) ticks after `start`.
#[derive(Debug, Clone)]
pub struct ArcGenerator {
    /// Its widths, by name.
    pub widths: Widths,
    /// Width of the number of a record: so many bits number those that wait.
    pub records: usize,
    /// How the rotation rounds.
    pub rounding: Rounding,
}

impl ArcGenerator {
    /// A generator of the full widths whose rotation rounds by `rounding`.
    pub const fn new(rounding: Rounding) -> Self {
        ArcGenerator {
            widths: Widths::FULL,
            records: 4,
            rounding,
        }
    }

    /// Ticks from `start` to the tick from which on a sampling time takes the first point.
    pub const fn first(&self) -> u64 {
        self.memory().latency() + 2
    }

    /// The shortest sampling time, in ticks, in which the first point of an arc is made behind the
    /// last of the segment before.
    pub const fn least_period(&self) -> u64 {
        self.first() + 1 + self.rotation().latency() + 1
    }

    const fn memory(&self) -> RecordMemory {
        RecordMemory {
            record: self.records,
            data: self.widths.data,
        }
    }

    const fn rotation(&self) -> Rotation {
        Rotation {
            widths: self.widths,
            rounding: self.rounding,
        }
    }

    fn command(&self, coordinate: u64) -> PositionCommand {
        let widths = self.widths;
        PositionCommand { widths, coordinate }
    }
}

impl Default for ArcGenerator {
    fn default() -> Self {
        Self::new(Rounding::default())
    }
}

signals! { for Widths as c;
    /// Segments, as they are written, and the start of their path.
    pub struct Segments {
        /// Writes a word of the free record; not taken unless `ready`.
        pub write: Bit,
        /// Number of the word.
        pub write_word: U(5),
        /// Its data.
        pub write_data: U(c.data) as Hex,
        /// The free record is complete; not taken unless `ready`.
        pub push: Bit,
        /// Begins a path, unless one is under way or no segment waits.
        pub start: Bit,
    }
}

signals! { for (ArcGenerator, Conventional) as c;
    /// Ports in.
    pub struct In {
        /// The path.
        pub segments: Segments(&c.widths) as Flat,
        /// Ends it where it is: the commands stay, the segments that wait are forgotten.
        pub halt: Bit,
        /// Ts: ticks from one point to the next.
        pub sample_period: U(c.widths.period),
    }
    /// Ports out.
    pub struct Net {
        /// Position command of x in counts.
        pub x: I(c.widths.position) as Analog,
        /// Position command of y.
        pub y: I(c.widths.position) as Analog,
        /// Position command of z.
        pub z: I(c.widths.position) as Analog,
        /// New commands stand in this tick.
        pub sampled: Bit,
        /// There is a free record.
        pub ready: Bit,
        /// A path is under way.
        pub busy: Bit,
        /// The segment that makes the points.
        pub kind: U(2) as States(record_memory::KINDS),
        /// A sampling time began before its point was ready; until the next path begins.
        pub late: Bit,
        /// The path ended in motion, since no segment waited; until the next path begins.
        pub starved: Bit,
    }
}

signals! { for ArcGenerator as c;
    /// The blocks.
    pub struct Parts {
        /// Sampling time.
        pub sample_counter: Part<EnableCounter>(EnableCounter { width: c.widths.period }),
        /// Coefficients of the segments to come.
        pub memory: Part<RecordMemory>(c.memory()),
        /// Segment after segment.
        pub sequencer: Part<RecordSequencer>(c.widths.sequencer()),
        /// Blends and lines, x.
        pub engine_x: Part<DifferenceEngine>(c.widths.engine(0)),
        /// Blends and lines, y.
        pub engine_y: Part<DifferenceEngine>(c.widths.engine(1)),
        /// Blends and lines, z.
        pub engine_z: Part<DifferenceEngine>(c.widths.engine(2)),
        /// Arcs.
        pub rotation: Part<Rotation>(c.rotation()),
        /// Command of x.
        pub command_x: Part<PositionCommand>(c.command(0)),
        /// Command of y.
        pub command_y: Part<PositionCommand>(c.command(1)),
        /// Command of z.
        pub command_z: Part<PositionCommand>(c.command(2)),
    }
}

impl Circuit for ArcGenerator {
    const NAME: &'static str = "arc_generator";
    const ABOUT: &'static str =
        "segments in, position commands on lines, blends and arcs in space out";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let segments = i.segments;
        let sample = p.sample_counter.settle(enable_counter::In {
            period: i.sample_period,
        });
        let memory = p.memory.settle(record_memory::In {
            write: segments.write,
            write_word: segments.write_word,
            write_data: segments.write_data,
            push: segments.push,
            take: p.sequencer.q.take,
            kind: p.sequencer.q.kind,
            flush: i.halt,
        });
        let (word, data) = (memory.q.word, memory.q.data);
        let rotation = p.rotation.settle(rotation::In {
            load: memory.w.load_rotation,
            word,
            data,
            step: p.sequencer.q.rotate,
            halt: i.halt,
        });
        let sequencer = p.sequencer.settle(record_sequencer::In {
            start: segments.start,
            halt: i.halt,
            sample: sample.w.enable,
            available: memory.w.available,
            load: memory.q.load,
            word,
            data,
            loaded: memory.q.loaded,
            rotated: rotation.w.done,
        });
        let command = |engine: Part<DifferenceEngine>, command: Part<PositionCommand>, offset| {
            let engine = engine.settle(difference_engine::In {
                load: memory.w.load_engines,
                word,
                data,
                modulus: sequencer.q.modulus,
                step: sequencer.w.advance,
            });
            let command = command.settle(position_command::In {
                load: memory.q.load,
                word,
                data,
                rotating: sequencer.w.rotating,
                polynomial: engine.w.nearest,
                offset,
                present: sequencer.w.present,
            });
            command.q.command
        };
        let net = Net {
            x: command(p.engine_x, p.command_x, rotation.w.x),
            y: command(p.engine_y, p.command_y, rotation.w.y),
            z: command(p.engine_z, p.command_z, rotation.w.z),
            sampled: sequencer.q.sampled,
            ready: memory.w.ready,
            busy: sequencer.w.busy,
            kind: sequencer.q.kind,
            late: sequencer.q.late,
            starved: sequencer.q.starved,
        };
        (net, Nothing)
    }
}
