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

use super::{PositionCommand, Rotation, Rounding, position_command, rotation};
use crate::blocks::{
    DifferenceEngine, EnableCounter, RecordMemory, RecordSequencer, difference_engine,
    enable_counter, record_memory, record_sequencer,
};
use crate::kernel::{Circuit, Instance};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const D: usize, const T: usize> {
        /// Writes a word of the free record; not taken unless `ready`.
        pub write: L::Bit,
        /// Number of the word.
        pub write_word: L::U<5>,
        /// Its data.
        pub write_data: L::U<D> as Hex,
        /// The free record is complete; not taken unless `ready`.
        pub push: L::Bit,
        /// Begins a path, unless one is under way or no segment waits.
        pub start: L::Bit,
        /// Ends it where it is: the commands stay, the segments that wait are forgotten.
        pub halt: L::Bit,
        /// Ts: ticks from one point to the next.
        pub sample_period: L::U<T>,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<
        L,
        const W: usize,
        const P: usize,
        const C: usize,
        const S: usize,
        const F: usize,
        const D: usize,
        const N: usize,
        const A: usize,
        const K: usize,
        const T: usize,
    > {
        /// Sampling time.
        pub sample_counter: enable_counter::Reg<L, T>,
        /// Coefficients of the segments to come.
        pub memory: record_memory::Reg<L, A, K, D>,
        /// Segment after segment.
        pub sequencer: record_sequencer::Reg<L, F, N>,
        /// Blends and lines, x.
        pub engine_x: difference_engine::Reg<L, P, F>,
        /// Blends and lines, y.
        pub engine_y: difference_engine::Reg<L, P, F>,
        /// Blends and lines, z.
        pub engine_z: difference_engine::Reg<L, P, F>,
        /// Arcs.
        pub rotation: rotation::Reg<L, P, C, S>,
        /// Command of x.
        pub command_x: position_command::Reg<L, W, P>,
        /// Command of y.
        pub command_y: position_command::Reg<L, W, P>,
        /// Command of z.
        pub command_z: position_command::Reg<L, W, P>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<
        L,
        const W: usize,
        const P: usize,
        const C: usize,
        const S: usize,
        const F: usize,
        const D: usize,
        const N: usize,
        const A: usize,
        const K: usize,
        const T: usize,
    > {
        /// Sampling time.
        pub sample_counter: Instance<EnableCounter<T>, L>,
        /// Coefficients of the segments to come.
        pub memory: Instance<RecordMemory<A, K, D>, L>,
        /// Segment after segment.
        pub sequencer: Instance<RecordSequencer<F, N, D>, L>,
        /// Blends and lines, x.
        pub engine_x: Instance<DifferenceEngine<P, F, D>, L>,
        /// Blends and lines, y.
        pub engine_y: Instance<DifferenceEngine<P, F, D>, L>,
        /// Blends and lines, z.
        pub engine_z: Instance<DifferenceEngine<P, F, D>, L>,
        /// Arcs.
        pub rotation: Instance<Rotation<P, C, S, D>, L>,
        /// Command of x.
        pub command_x: Instance<PositionCommand<W, P, D>, L>,
        /// Command of y.
        pub command_y: Instance<PositionCommand<W, P, D>, L>,
        /// Command of z.
        pub command_z: Instance<PositionCommand<W, P, D>, L>,
        /// Position command of x in counts.
        pub x: L::I<W> as Analog,
        /// Position command of y.
        pub y: L::I<W> as Analog,
        /// Position command of z.
        pub z: L::I<W> as Analog,
        /// New commands stand in this tick.
        pub sampled: L::Bit,
        /// There is a free record.
        pub ready: L::Bit,
        /// A path is under way.
        pub busy: L::Bit,
        /// The segment that makes the points.
        pub kind: L::U<2> as States(record_memory::KINDS),
        /// A sampling time began before its point was ready; until the next path begins.
        pub late: L::Bit,
        /// The path ended in motion, since no segment waited; until the next path begins.
        pub starved: L::Bit,
    }
}

/// Arc generator with commands of `W` bits; see the note for the other widths.
///
/// The first point of a path is the command one tick after the first sampling time for which it is
/// ready, [`FIRST`](ArcGenerator::FIRST) ticks after `start`.
#[derive(Debug, Clone)]
pub struct ArcGenerator<
    const W: usize = 24,
    const P: usize = 40,
    const C: usize = 42,
    const S: usize = 43,
    const F: usize = 41,
    const D: usize = 42,
    const N: usize = 20,
    const A: usize = 4,
    const K: usize = 9,
    const T: usize = 24,
> {
    /// Sampling time.
    pub sample_counter: EnableCounter<T>,
    /// Coefficients of the segments to come.
    pub memory: RecordMemory<A, K, D>,
    /// Segment after segment.
    pub sequencer: RecordSequencer<F, N, D>,
    /// Blends and lines, for x, y and z.
    pub engines: [DifferenceEngine<P, F, D>; 3],
    /// Arcs.
    pub rotation: Rotation<P, C, S, D>,
    /// Commands of x, y and z.
    pub commands: [PositionCommand<W, P, D>; 3],
}

impl<
    const W: usize,
    const P: usize,
    const C: usize,
    const S: usize,
    const F: usize,
    const D: usize,
    const N: usize,
    const A: usize,
    const K: usize,
    const T: usize,
> ArcGenerator<W, P, C, S, F, D, N, A, K, T>
{
    /// Ticks from `start` to the tick from which on a sampling time takes the first point.
    pub const FIRST: u64 = RecordMemory::<A, K, D>::LATENCY + 2;
    /// The shortest sampling time, in ticks, in which the first point of an arc is made behind the
    /// last of the segment before.
    pub const LEAST_PERIOD: u64 = Self::FIRST + 1 + Rotation::<P, C, S, D>::LATENCY + 1;

    /// A generator whose rotation rounds by `rounding`.
    pub fn new(rounding: Rounding) -> Self {
        ArcGenerator {
            sample_counter: EnableCounter,
            memory: RecordMemory,
            sequencer: RecordSequencer,
            engines: [0, 1, 2].map(DifferenceEngine::new),
            rotation: Rotation::new(rounding),
            commands: [0, 1, 2].map(|coordinate| PositionCommand { coordinate }),
        }
    }
}

impl<
    const W: usize,
    const P: usize,
    const C: usize,
    const S: usize,
    const F: usize,
    const D: usize,
    const N: usize,
    const A: usize,
    const K: usize,
    const T: usize,
> Default for ArcGenerator<W, P, C, S, F, D, N, A, K, T>
{
    fn default() -> Self {
        Self::new(Rounding::default())
    }
}

impl<
    const W: usize,
    const P: usize,
    const C: usize,
    const S: usize,
    const F: usize,
    const D: usize,
    const N: usize,
    const A: usize,
    const K: usize,
    const T: usize,
> Circuit for ArcGenerator<W, P, C, S, F, D, N, A, K, T>
{
    const NAME: &'static str = "arc_generator";
    const ABOUT: &'static str =
        "segments in, position commands on lines, blends and arcs in space out";
    type In<L: Logic> = In<L, D, T>;
    type Reg<L: Logic> = Reg<L, W, P, C, S, F, D, N, A, K, T>;
    type Net<L: Logic> = Net<L, W, P, C, S, F, D, N, A, K, T>;

    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L> {
        let sample_counter = Instance::settle(
            &self.sample_counter,
            &q.sample_counter,
            enable_counter::In {
                period: i.sample_period,
            },
        );
        let memory = Instance::settle(
            &self.memory,
            &q.memory,
            record_memory::In {
                write: i.write,
                write_word: i.write_word,
                write_data: i.write_data,
                push: i.push,
                take: q.sequencer.take,
                kind: q.sequencer.kind,
                flush: i.halt,
            },
        );
        let (word, data) = (q.memory.word, q.memory.data);
        let rotation = Instance::settle(
            &self.rotation,
            &q.rotation,
            rotation::In {
                load: memory.w.load_rotation,
                word,
                data,
                step: q.sequencer.rotate,
                halt: i.halt,
            },
        );
        let sequencer = Instance::settle(
            &self.sequencer,
            &q.sequencer,
            record_sequencer::In {
                start: i.start,
                halt: i.halt,
                sample: sample_counter.w.enable,
                available: memory.w.available,
                load: q.memory.load,
                word,
                data,
                loaded: q.memory.loaded,
                rotated: rotation.w.done,
            },
        );
        let [engine_x, engine_y, engine_z] = &self.engines;
        let engine = || difference_engine::In {
            load: memory.w.load_engines,
            word,
            data,
            modulus: q.sequencer.modulus,
            step: sequencer.w.advance,
        };
        let engine_x = Instance::settle(engine_x, &q.engine_x, engine());
        let engine_y = Instance::settle(engine_y, &q.engine_y, engine());
        let engine_z = Instance::settle(engine_z, &q.engine_z, engine());
        let [command_x, command_y, command_z] = &self.commands;
        let command = |polynomial, offset| position_command::In {
            load: q.memory.load,
            word,
            data,
            rotating: sequencer.w.rotating,
            polynomial,
            offset,
            present: sequencer.w.present,
        };
        let (x, y, z) = (rotation.w.x, rotation.w.y, rotation.w.z);
        Net {
            command_x: Instance::settle(command_x, &q.command_x, command(engine_x.w.nearest, x)),
            command_y: Instance::settle(command_y, &q.command_y, command(engine_y.w.nearest, y)),
            command_z: Instance::settle(command_z, &q.command_z, command(engine_z.w.nearest, z)),
            x: q.command_x.command,
            y: q.command_y.command,
            z: q.command_z.command,
            sampled: q.sequencer.sampled,
            ready: memory.w.ready,
            busy: sequencer.w.busy,
            kind: q.sequencer.kind,
            late: q.sequencer.late,
            starved: q.sequencer.starved,
            sample_counter,
            memory,
            sequencer,
            engine_x,
            engine_y,
            engine_z,
            rotation,
        }
    }

    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, _: &Self::In<L>) -> Self::Reg<L> {
        let [engine_x, engine_y, engine_z] = &self.engines;
        let [command_x, command_y, command_z] = &self.commands;
        Reg {
            sample_counter: w
                .sample_counter
                .next(&self.sample_counter, q.sample_counter),
            memory: w.memory.next(&self.memory, q.memory),
            sequencer: w.sequencer.next(&self.sequencer, q.sequencer),
            engine_x: w.engine_x.next(engine_x, q.engine_x),
            engine_y: w.engine_y.next(engine_y, q.engine_y),
            engine_z: w.engine_z.next(engine_z, q.engine_z),
            rotation: w.rotation.next(&self.rotation, q.rotation),
            command_x: w.command_x.next(command_x, q.command_x),
            command_y: w.command_y.next(command_y, q.command_y),
            command_z: w.command_z.next(command_z, q.command_z),
        }
    }
}
