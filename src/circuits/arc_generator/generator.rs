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
    Blend, BlendPoint, Conventional, PositionCommand, Rotation, Rounding, Widths, blend_point,
    position_command, rotation,
};
use crate::circuits::blocks::record_memory::ARC;
use crate::circuits::blocks::record_sequencer::{given_of_records, sends_in_fetch};
use crate::circuits::blocks::{
    DifferenceEngine, EnableCounter, RecordMemory, RecordSequencer, RecordWrite, difference_engine,
    enable_counter, record_memory, record_sequencer,
};
use crate::prelude::*;

/// Names of the difference engines.
const ENGINES: &[&str] = &["engine_x", "engine_y", "engine_z"];
/// Instance names of the position commands.
pub(super) const COMMANDS: &[&str] = &["command_x", "command_y", "command_z"];

/// Arc generator.
/// The first point of a path becomes the command one tick after the first sampling time at which it
/// is ready, at least [`first`](ArcGenerator::first) ticks after `start`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArcGenerator {
    /// Word widths, by name.
    pub widths: Widths,
    /// Width of a record number, in bits: the buffer holds 2^`records` records.
    pub records: usize,
    /// Rounding of the rotation.
    pub rounding: Rounding,
    /// Method for blends and lines.
    pub blend: Blend,
}

impl ArcGenerator {
    /// Creates a generator of the full widths whose rotation rounds by `rounding`.
    pub const fn new(rounding: Rounding, blend: Blend) -> Self {
        ArcGenerator {
            widths: blend.widths(Widths::FULL),
            records: 4,
            rounding,
            blend,
        }
    }

    /// Ticks from `start` to the tick from which on a sampling time takes the first point.
    pub const fn first(&self) -> u64 {
        self.memory().latency() + 2
    }

    /// Shortest sampling time, in ticks, in which the first point after the end of any segment is
    /// ready.
    pub const fn least_period(&self) -> u64 {
        let latency = match self.blend {
            Blend::Differences => self.rotation().latency(),
            Blend::Products => self.blend_point().latency(),
        };
        self.first() + 1 + latency + 1
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

    const fn blend_point(&self) -> BlendPoint {
        let widths = self.widths;
        BlendPoint { widths }
    }

    const fn sequencer(&self) -> RecordSequencer {
        RecordSequencer {
            waits: matches!(self.blend, Blend::Products),
            ..self.widths.sequencer()
        }
    }

    /// Number of coordinates with a difference engine.
    const fn engines(&self) -> usize {
        match self.blend {
            Blend::Differences => 3,
            Blend::Products => 0,
        }
    }
}

impl Default for ArcGenerator {
    fn default() -> Self {
        Self::new(Rounding::default(), Blend::default())
    }
}

signals! { for Widths as c;
    /// Segments, as they are written, and the start of their path.
    pub struct Segments {
        /// Port through which records of segments are written.
        pub record: RecordWrite(&c.data) as Flat,
        /// Starts a path; ignored while a path runs, or if no segment waits.
        pub start: Bit,
    }
}

signals! { for (ArcGenerator, Conventional) as c;
    /// Input ports.
    pub struct In {
        /// Segments of the path.
        pub segments: Segments(&c.widths) as Flat,
        /// Ends the path. The commands keep their values; waiting segments are discarded.
        pub halt: Bit,
        /// Ts: sampling time in ticks; 0 counts as 1.
        pub sample_period: U(c.widths.period),
    }
    /// Output ports.
    pub struct Net {
        /// Position command of X, in counts.
        pub x: I(c.widths.position) as Analog,
        /// Position command of Y, in counts.
        pub y: I(c.widths.position) as Analog,
        /// Position command of Z, in counts.
        pub z: I(c.widths.position) as Analog,
        /// New commands are valid in this tick.
        pub sampled: Bit,
        /// A record is free to be written.
        pub ready: Bit,
        /// A path is running.
        pub busy: Bit,
        /// Kind of the current segment.
        pub kind: U(2) as States(record_memory::KINDS),
        /// A sampling time has begun before the point was ready; cleared when the next path begins.
        pub late: Bit,
        /// The path has ended in motion because no segment was waiting; cleared when the next path
        /// begins.
        pub starved: Bit,
    }
}

signals! { for ArcGenerator as c;
    /// The blocks.
    pub struct Parts {
        /// Counter of the sampling time.
        pub sample_counter: Part<EnableCounter>(EnableCounter { width: c.widths.period }),
        /// Records of the next segments.
        pub memory: Part<RecordMemory>(c.memory()),
        /// Sequencer of the segments.
        pub sequencer: Part<RecordSequencer>(c.sequencer()),
        /// Difference engine of a coordinate, for blends and lines.
        pub engines: [Part<DifferenceEngine>(c.widths.engine(k as u64)); k in c.engines()]
            as Elements(ENGINES),
        /// Blends and lines by products, in place of the difference engines.
        pub blend_point: Part<BlendPoint>(c.blend_point()) if (c.engines() == 0),
        /// Rotation for arcs.
        pub rotation: Part<Rotation>(c.rotation()),
        /// Position commands of X, Y and Z.
        pub commands: [Part<PositionCommand>(c.widths.command(k as u64)); k in 3]
            as Elements(COMMANDS),
    }
}

impl Segments {
    /// Inputs of the record memory: these ports, and the signals of the sequencer.
    pub(super) fn to_memory(
        &self,
        sequencer: &record_sequencer::Reg<Seen>,
        flush: Bit,
    ) -> record_memory::In {
        record_memory::In {
            record: self.record.clone(),
            take: sequencer.take,
            kind: sequencer.kind,
            flush,
        }
    }
}

/// Output ports of a generator with these circuits inside.
pub(super) fn ports_out(
    commands: &[Settled<PositionCommand>],
    memory: &Settled<RecordMemory>,
    sequencer: &Settled<RecordSequencer>,
) -> Net {
    Net {
        x: commands[0].q.command,
        y: commands[1].q.command,
        z: commands[2].q.command,
        sampled: sequencer.q.sampled,
        ready: memory.w.ready,
        busy: sequencer.w.busy,
        kind: sequencer.q.kind,
        late: sequencer.q.late,
        starved: sequencer.q.starved,
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
        let memory = segments.to_memory(&p.sequencer.q, i.halt);
        let memory = p.memory.settle(memory);
        let (rotate, arc) = (p.sequencer.q.rotate, p.sequencer.q.kind.equals(ARC));
        let rotation = p.rotation.settle(rotation::In {
            record: memory.q.record(memory.w.load_rotation),
            step: match self.blend {
                Blend::Differences => rotate,
                Blend::Products => rotate & arc,
            },
            halt: i.halt,
        });
        let point = p.blend_point.map(|part| {
            let ports = blend_point::In {
                record: memory.q.record(memory.w.load_engines),
                modulus: p.sequencer.q.modulus,
                step: rotate & !arc,
                halt: i.halt,
            };
            part.settle(ports).w
        });
        let rotated = rotation.w.done;
        let sequencer = p.sequencer.settle(record_sequencer::In {
            start: segments.start,
            halt: i.halt,
            sample: sample.w.enable,
            available: memory.w.available,
            record: memory.q.record(memory.q.load),
            loaded: memory.q.loaded,
            rotated: point.as_ref().map_or(rotated, |point| rotated | point.done),
        });
        let engines = settle_each(p.engines, |_| difference_engine::In {
            record: memory.q.record(memory.w.load_engines),
            modulus: sequencer.q.modulus,
            step: sequencer.w.advance,
        });
        let polynomials = match point {
            Some(point) => vec![point.x, point.y, point.z],
            None => engines.iter().map(|engine| engine.w.nearest).collect(),
        };
        let offsets = [rotation.w.x, rotation.w.y, rotation.w.z];
        let commands = settle_each(p.commands, |k| position_command::In {
            record: memory.q.record(memory.q.load),
            rotating: sequencer.w.rotating,
            polynomial: polynomials[k],
            offset: offsets[k],
            present: sequencer.w.present,
        });
        (ports_out(&commands, &memory, &sequencer), Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let p = &now.p;
        let mut all = given_of_records(of_records(p)).to_vec();
        all.push(sends_in_fetch(&p.sequencer, &p.memory));
        all
    }
}

/// Assumptions of the blocks that get the words of records.
pub(crate) fn of_records(p: &Parts<Open>) -> Vec<[Bit; 2]> {
    let points = p.blend_point.iter().map(blend_point::of_record);
    let engines = p.engines.iter().map(difference_engine::of_record);
    points.chain(engines).collect()
}
