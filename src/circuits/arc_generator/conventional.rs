//! The conventional method of the prior art (Figs 5 and 6), for comparison: the angle accelerates,
//! so every sample has a sine, a cosine and a matrix of its own.
//!
//! ```text
//!                          ┌───────────────┐
//!  write, write_word, … ──▶│               ├──▶ x, y, z, sampled
//!  push ──────────────────▶│ conventional  ├──▶ ready, busy, kind
//!  start, halt ───────────▶│ generator     ├──▶ late, starved
//!  sample_period ─────────▶│               │
//!                          └───────────────┘
//! ```
//!
//! Ports as those of the arc generator. Δθi = θi − θi−1, sine and cosine by CORDIC, \[2\] from them,
//! GPi = R·GPi−1 and \[4\], one after the other.

pub use super::generator::{In, Net};
use super::matrix_element::Sign;
use super::sine_words::FINE;
use super::*;
use crate::circuits::blocks::cordic_state::GAIN;
use crate::circuits::blocks::{
    CoefficientControl, Cordic, DifferenceEngine, EnableCounter, RecordMemory, RecordSequencer,
    coefficient_control, cordic, difference_column, difference_engine, enable_counter,
    record_memory, record_sequencer,
};
use crate::hdl::prelude::*;

/// Elements of the matrix, row by row.
const ELEMENTS: &[&str] = &[
    "matrix_xx",
    "matrix_xy",
    "matrix_xz",
    "matrix_yx",
    "matrix_yy",
    "matrix_yz",
    "matrix_zx",
    "matrix_zy",
    "matrix_zz",
];

/// Conventional generator of arcs, with widths as those of the arc generator.
///
/// An angle has as many bits as a coefficient, and is in units of that part of a turn.
#[derive(Debug, Clone)]
pub struct Conventional {
    /// Its widths, by name.
    pub widths: Widths,
    /// Width of the number of a record: so many bits number those that wait.
    pub records: usize,
    /// How the rotation rounds.
    pub rounding: Rounding,
}

impl Conventional {
    /// A generator of the full widths whose rotation rounds by `rounding`.
    pub const fn new(rounding: Rounding) -> Self {
        Conventional {
            widths: Widths::FULL,
            records: 4,
            rounding,
        }
    }

    /// Ticks from the sequencer's `rotate` to the new vector.
    pub const fn latency(&self) -> u64 {
        let control = self.control().latency();
        1 + self.cordic().latency() + (control - 1) + control
    }

    /// The shortest sampling time, in ticks, in which the first point behind the last of the segment
    /// before is made.
    pub const fn least_period(&self) -> u64 {
        self.memory().latency() + 3 + self.latency() + 1
    }

    const fn memory(&self) -> RecordMemory {
        RecordMemory {
            record: self.records,
            data: self.widths.data,
        }
    }

    const fn engine(&self) -> DifferenceEngine {
        let widths = difference_column::Widths {
            whole: self.widths.coefficient,
            part: self.widths.fraction,
            data: self.widths.data,
        };
        DifferenceEngine {
            widths,
            coordinate: 0,
        }
    }

    const fn cordic(&self) -> Cordic {
        Cordic {
            radius: self.words().radius(),
            angle: self.widths.coefficient,
        }
    }

    const fn words(&self) -> SineWords {
        let coefficient = self.widths.coefficient;
        SineWords { coefficient }
    }

    const fn control(&self) -> CoefficientControl {
        let coefficient = self.widths.coefficient;
        CoefficientControl { coefficient }
    }

    const fn axis(&self) -> AxisTerms {
        AxisTerms {
            coefficient: self.widths.coefficient,
            data: self.widths.data,
        }
    }

    /// Element of a row and a column, counted through.
    fn element(&self, place: usize) -> MatrixElement {
        let (row, column) = (place / 3, place % 3);
        MatrixElement {
            coefficient: self.widths.coefficient,
            sign: match column == (row + 1) % 3 {
                true => Sign::Minus,
                false => Sign::Plus,
            },
        }
    }

    const fn row(&self, coordinate: u64) -> VectorRow {
        VectorRow {
            widths: self.widths,
            coordinate,
            rounding: self.rounding,
        }
    }

    const fn command(&self, coordinate: u64) -> PositionCommand {
        PositionCommand {
            widths: self.widths,
            coordinate,
        }
    }

    /// The vector of length 1 before it is lengthened, as CORDIC takes it.
    fn radius(&self) -> i64 {
        let one = ((self.widths.coefficient_fraction() + FINE) as f64).exp2();
        (one / GAIN).round() as i64
    }
}

impl Default for Conventional {
    fn default() -> Self {
        Self::new(Rounding::default())
    }
}

signals! { for Conventional as c;
    /// The blocks.
    pub struct Parts {
        /// Sampling time.
        pub sample_counter: Part<EnableCounter>(EnableCounter { width: c.widths.period }),
        /// Coefficients of the segments to come.
        pub memory: Part<RecordMemory>(c.memory()),
        /// Segment after segment.
        pub sequencer: Part<RecordSequencer>(c.widths.sequencer()),
        /// θ: ramp, constant speed, ramp.
        pub engine: Part<DifferenceEngine>(c.engine()),
        /// Δθ.
        pub angle_step: Part<AngleStep>(AngleStep { width: c.widths.coefficient }),
        /// Its sine and cosine.
        pub cordic: Part<Cordic>(c.cordic()),
        /// The same as coefficients.
        pub words: Part<SineWords>(c.words()),
        /// Which bit of them the matrix is at.
        pub matrix_control: Part<CoefficientControl>(c.control()),
        /// The axis.
        pub axis: Part<AxisTerms>(c.axis()),
        /// The matrix \[2\].
        pub elements: [Part<MatrixElement>(c.element(k)); k in 9] as Elements(ELEMENTS),
        /// Which bit of it the rotation is at.
        pub rotation_control: Part<CoefficientControl>(c.control()),
        /// X.
        pub row_x: Part<VectorRow>(c.row(0)),
        /// Y.
        pub row_y: Part<VectorRow>(c.row(1)),
        /// Z.
        pub row_z: Part<VectorRow>(c.row(2)),
        /// Command of x.
        pub command_x: Part<PositionCommand>(c.command(0)),
        /// Command of y.
        pub command_y: Part<PositionCommand>(c.command(1)),
        /// Command of z.
        pub command_z: Part<PositionCommand>(c.command(2)),
    }
}

impl Circuit for Conventional {
    const NAME: &'static str = "conventional_generator";
    const ABOUT: &'static str =
        "the method before: an angle in, a sine, a cosine and a matrix in every sample";
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
        let (load, word, data) = (memory.q.load, memory.q.word, memory.q.data);
        let rotate = p.sequencer.q.rotate;
        let engine = p.engine.settle(difference_engine::In {
            load,
            word,
            data,
            modulus: p.sequencer.q.modulus,
            step: rotate,
        });
        let step = p.angle_step.settle(angle_step::In {
            step: rotate,
            halt: i.halt,
            angle: engine.w.nearest,
        });
        let cordic = p.cordic.settle(cordic::In {
            start: step.q.turn,
            halt: i.halt,
            radius: I::new(self.radius(), self.words().radius()),
            offset: I::new(0, self.words().radius()),
            angle: step.w.difference,
        });
        let bits = p.matrix_control.settle(coefficient_control::In {
            step: cordic.w.done,
            halt: i.halt,
        });
        let words = p.words.settle(sine_words::In {
            copy: bits.w.copy,
            along: cordic.w.along,
            across: cordic.w.across,
        });
        let k = p.axis.settle(axis_terms::In { load, word, data }).q;
        let products = [k.xx, k.xy, k.xz, k.xy, k.yy, k.yz, k.xz, k.yz, k.zz];
        let one = I::new(
            1 << self.widths.coefficient_fraction(),
            self.widths.coefficient,
        );
        let turns = [one, k.z, k.y, k.z, one, k.x, k.y, k.x, one];
        let elements = settle_each(p.elements, |place| matrix_element::In {
            copy: bits.w.copy,
            fraction: bits.w.fraction,
            top: bits.w.top,
            versine_bit: words.w.versine_bit,
            turn_bit: match place % 4 {
                0 => words.w.cosine_bit,
                _ => words.w.sine_bit,
            },
            product: products[place],
            turn: turns[place],
        });
        let control = p.rotation_control.settle(coefficient_control::In {
            step: bits.w.commit,
            halt: i.halt,
        });
        let [x, y, z] = [p.row_x.q.offset, p.row_y.q.offset, p.row_z.q.offset];
        for (row, by) in [p.row_x, p.row_y, p.row_z]
            .into_iter()
            .zip(elements.chunks(3))
        {
            row.settle(vector_row::In {
                load,
                word,
                data,
                copy: control.w.copy,
                fraction: control.w.fraction,
                top: control.w.top,
                commit: control.w.commit,
                by_x: by[0].w.entry,
                by_y: by[1].w.entry,
                by_z: by[2].w.entry,
                x,
                y,
                z,
            });
        }
        let sequencer = p.sequencer.settle(record_sequencer::In {
            start: segments.start,
            halt: i.halt,
            sample: sample.w.enable,
            available: memory.w.available,
            load,
            word,
            data,
            loaded: memory.q.loaded,
            rotated: control.q.done,
        });
        let command = |command: Part<PositionCommand>, offset| {
            let command = command.settle(position_command::In {
                load,
                word,
                data,
                rotating: Bit::high(),
                polynomial: I::new(0, self.widths.point),
                offset,
                present: sequencer.w.present,
            });
            command.q.command
        };
        let net = Net {
            x: command(p.command_x, x),
            y: command(p.command_y, y),
            z: command(p.command_z, z),
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
