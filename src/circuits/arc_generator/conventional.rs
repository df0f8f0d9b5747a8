//! Conventional method of the prior art (Figs 5 and 6), for comparison: the angle accelerates, so
//! every sample needs its own sine, cosine and matrix.
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
//! The ports are those of the arc generator. One after the other, each sample computes Δθi = θi −
//! θi−1, sine and cosine by CORDIC, the matrix \[2\] from them, GPi = R·GPi−1, and \[4\].

use super::generator::{COMMANDS, ports_out};
pub use super::generator::{In, Net};
use super::matrix_element::Sign;
use super::rotation_row::ROWS;
use super::sine_words::FINE;
use super::*;
use crate::circuits::blocks::cordic_state::GAIN;
use crate::circuits::blocks::record_sequencer::{given_of_records, sends_in_fetch};
use crate::circuits::blocks::{
    CoefficientControl, Cordic, DifferenceEngine, EnableCounter, RecordMemory, RecordSequencer,
    coefficient_control, cordic, difference_engine, enable_counter, record_sequencer,
};
use crate::prelude::*;

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

/// Conventional generator of arcs, with the widths of the arc generator.
///
/// An angle is as wide as a coefficient, and in units of 2^−C turn.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Conventional {
    /// Word widths, by name.
    pub widths: Widths,
    /// Width of a record number, in bits: the buffer holds 2^`records` records.
    pub records: usize,
    /// Rounding of the rotation.
    pub rounding: Rounding,
}

impl Conventional {
    /// Creates a generator of the full widths whose rotation rounds by `rounding`.
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

    /// Shortest sampling time, in ticks, in which the first point after the end of a segment is
    /// ready.
    pub const fn least_period(&self) -> u64 {
        self.memory().latency() + 3 + self.latency() + 1
    }

    const fn memory(&self) -> RecordMemory {
        RecordMemory {
            record: self.records,
            data: self.widths.data,
        }
    }

    /// The angle, as wide as a coefficient.
    const fn engine(&self) -> DifferenceEngine {
        let point = self.widths.coefficient;
        let widths = self.widths;
        Widths { point, ..widths }.engine(0)
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
        /// Counter of the sampling time.
        pub sample_counter: Part<EnableCounter>(EnableCounter { width: c.widths.period }),
        /// Records of the next segments.
        pub memory: Part<RecordMemory>(c.memory()),
        /// Sequencer of the segments.
        pub sequencer: Part<RecordSequencer>(c.widths.sequencer()),
        /// θ: ramp, constant speed, ramp.
        pub engine: Part<DifferenceEngine>(c.engine()),
        /// Δθ.
        pub angle_step: Part<AngleStep>(AngleStep { width: c.widths.coefficient }),
        /// Sine and cosine of Δθ.
        pub cordic: Part<Cordic>(c.cordic()),
        /// Sine, cosine and versine as coefficients.
        pub words: Part<SineWords>(c.words()),
        /// Bit counter for the products of the matrix.
        pub matrix_control: Part<CoefficientControl>(c.control()),
        /// Terms of the axis.
        pub axis: Part<AxisTerms>(c.axis()),
        /// Elements of the matrix \[2\].
        pub elements: [Part<MatrixElement>(c.element(k)); k in 9] as Elements(ELEMENTS),
        /// Bit counter for the products of the rotation.
        pub rotation_control: Part<CoefficientControl>(c.control()),
        /// Coordinates X, Y and Z.
        pub rows: [Part<VectorRow>(c.row(k as u64)); k in 3] as Elements(ROWS),
        /// Position commands of X, Y and Z.
        pub commands: [Part<PositionCommand>(c.widths.command(k as u64)); k in 3]
            as Elements(COMMANDS),
    }
}

impl Circuit for Conventional {
    const NAME: &'static str = "conventional_generator";
    const ABOUT: &'static str =
        "conventional method: an angle, a sine, a cosine and a matrix per sample";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let segments = i.segments;
        let sample = p.sample_counter.settle(enable_counter::In {
            period: i.sample_period,
        });
        let memory = segments.to_memory(&p.sequencer.q, i.halt);
        let memory = p.memory.settle(memory);
        let record = || memory.q.record(memory.q.load);
        let rotate = p.sequencer.q.rotate;
        let engine = p.engine.settle(difference_engine::In {
            record: record(),
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
        let k = p.axis.settle(axis_terms::In { record: record() }).q;
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
        let offsets = [0, 1, 2].map(|k: usize| p.rows[k].q.offset);
        let [x, y, z] = offsets;
        settle_each(p.rows, |k| vector_row::In {
            record: record(),
            copy: control.w.copy,
            fraction: control.w.fraction,
            top: control.w.top,
            commit: control.w.commit,
            by_x: elements[3 * k].w.entry,
            by_y: elements[3 * k + 1].w.entry,
            by_z: elements[3 * k + 2].w.entry,
            x,
            y,
            z,
        });
        let sequencer = p.sequencer.settle(record_sequencer::In {
            start: segments.start,
            halt: i.halt,
            sample: sample.w.enable,
            available: memory.w.available,
            record: record(),
            loaded: memory.q.loaded,
            rotated: control.q.done,
        });
        let commands = settle_each(p.commands, |k| position_command::In {
            record: record(),
            rotating: Bit::high(),
            polynomial: I::new(0, self.widths.point),
            offset: offsets[k],
            present: sequencer.w.present,
        });
        (ports_out(&commands, &memory, &sequencer), Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let p = &now.p;
        let mut all = given_of_records([difference_engine::of_record(&p.engine)]).to_vec();
        all.push(sends_in_fetch(&p.sequencer, &p.memory));
        all
    }
}
