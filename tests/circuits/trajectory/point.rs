//! Points on paths of lines, arcs, helices and splines in space, against sine, cosine and powers.

use motion_rtl::circuits::blocks::cordic_state::GAIN;
use motion_rtl::circuits::trajectory_controller::path_point::{In, PathWrite};
use motion_rtl::circuits::trajectory_controller::point_sequencer::RADIUS;
use motion_rtl::circuits::trajectory_controller::widths::PointWidths;
use motion_rtl::circuits::trajectory_controller::{PathPoint, Widths};
use motion_rtl::hdl::Value;
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;
use std::f64::consts::TAU;

const A: usize = 4;
const P: usize = 47;
const R: usize = 55;
const C: usize = 42;
const M: usize = 44;
const H: usize = 44;
const D: usize = 55;
pub type Vector = [f64; 3];

/// A segment in guard units.
#[derive(Debug, Clone)]
pub struct Segment {
    pub length: u64,
    pub base: [i64; 3],
    pub along: Vector,
    pub across: Vector,
    /// A helix's rise, or a spline's part of the length's cube.
    pub third: Vector,
    /// Radius of an arc or a helix.
    pub radius: Option<f64>,
    /// Bits of the length of a spline.
    pub powers: Option<u32>,
}

pub fn two_to(exponent: i32) -> f64 {
    f64::from(exponent).exp2()
}

impl Segment {
    pub fn words(&self) -> [u64; 16] {
        let mut words = [0; 16];
        if let Some(radius) = self.radius {
            let turn = TAU * radius;
            // The mantissa has M bits: 2^(M − 1) <= 2^(M + n − 4) / turn.
            let n = (turn.log2().ceil() as i32 + 3).min(H as i32);
            let mantissa = (two_to(M as i32 + n - 4) / turn).round() as u64;
            assert!(mantissa >> M == 0, "{radius}");
            words[0] = 1 + ((H as i32 - n) as u64) * 2;
            words[1] = mantissa;
            words[2] = (radius / GAIN * two_to((R - P) as i32)).round() as u64;
            words[0] += u64::from(self.third != [0.0; 3]) << 7;
        }
        if let Some(bits) = self.powers {
            words[0] = 1 << 7 | u64::from(bits) << 1;
        }
        let unit = two_to(C as i32 - 2);
        let mask = (1u64 << D) - 1;
        for axis in 0..3 {
            words[3 + axis] = self.base[axis] as u64 & mask;
            words[6 + axis] = (self.along[axis] * unit).round() as i64 as u64 & mask;
            words[9 + axis] = (self.across[axis] * unit).round() as i64 as u64 & mask;
            words[13 + axis] = (self.third[axis] * unit).round() as i64 as u64 & mask;
        }
        words
    }

    fn point(&self, offset: u64) -> Vector {
        let offset = offset as f64;
        let (a, b, c) = match (self.radius, self.powers) {
            (None, None) => (offset, 0.0, 0.0),
            (Some(radius), _) => {
                let (sin, cos) = (offset / radius).sin_cos();
                (radius * cos, radius * sin, offset)
            }
            (None, Some(bits)) => {
                let part = offset / f64::from(bits).exp2();
                (offset, offset * part, offset * part * part)
            }
        };
        let way = |k: usize| a * self.along[k] + b * self.across[k] + c * self.third[k];
        [0, 1, 2].map(|k| self.base[k] as f64 + way(k))
    }

    /// Sum of the note's tables of errors, plus the rounding of doubles.
    fn bound(&self) -> f64 {
        let coefficient = self.length as f64 * two_to(1 - C as i32);
        let words = match (self.radius, self.powers) {
            (Some(radius), _) => 0.87 + radius * 9.6e-12 + coefficient,
            (None, Some(_)) => 0.53 + 3.0 * coefficient,
            (None, None) => 0.5 + coefficient,
        };
        words + 0.001
    }

    /// Ticks from `start` to `done`.
    fn latency(&self) -> u64 {
        let line = 2 * A + C + 25;
        let shift = (self.words()[0] >> 1 & 63) as usize;
        let turned = match (self.radius, self.powers) {
            (Some(_), _) => M + H + 4 + shift,
            (None, Some(_)) => 2 * shift + 2,
            (None, None) => 0,
        };
        (line + turned) as u64
    }
}

fn frame(azimuth: f64, height: f64, turn: f64) -> [Vector; 2] {
    let flat = (1.0 - height * height).sqrt();
    let u = [flat * azimuth.cos(), flat * azimuth.sin(), height];
    let e = [-azimuth.sin(), azimuth.cos(), 0.0];
    let f = [
        u[1] * e[2] - u[2] * e[1],
        u[2] * e[0] - u[0] * e[2],
        u[0] * e[1] - u[1] * e[0],
    ];
    let w = [0, 1, 2].map(|k| turn.cos() * e[k] + turn.sin() * f[k]);
    [u, w]
}

fn segment() -> impl Strategy<Value = Segment> {
    let attitude = (0.0..TAU, -1.0..1.0f64, 0.0..TAU);
    let base = prop::array::uniform3(-(1i64 << 38)..1i64 << 38);
    let third = prop::option::of(prop::array::uniform3(-1.99..1.99f64));
    let kind = (prop::option::of(17.0..38.0f64), third);
    (attitude, base, kind, 0.05..0.99f64, 1.0..38.0f64).prop_map(
        |((azimuth, height, turn), base, (size, third), part, length)| {
            let [along, across] = frame(azimuth, height, turn);
            let radius = size.map(f64::exp2);
            let length = match radius {
                Some(radius) => TAU * radius * part,
                None => length.exp2(),
            };
            let length = length as u64 + 1;
            let bits = length.ilog2() + 1;
            Segment {
                length,
                base,
                along,
                // A spline can have all values that words have.
                across: across.map(|one| one * if radius.is_none() { 1.99 } else { 1.0 }),
                third: third.unwrap_or_default(),
                radius,
                powers: third.and(radius.is_none().then_some(bits)),
            }
        },
    )
}

fn idle(last: u64) -> In<Value> {
    In {
        start: false,
        length: 0,
        last,
        path: PathWrite {
            write_begin: false,
            begin_segment: 0,
            begin_length: 0,
            write_path: false,
            path_address: 0,
            path_data: 0,
        },
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn every_length_has_its_point(
        path in prop::collection::vec(segment(), 1..16),
        shares in prop::collection::vec((0.0..1.0f64, any::<prop::sample::Index>()), 20),
    ) {
        let widths = PointWidths { segment: A, ..Widths::FULL.point() };
        let circuit = PathPoint { widths, axes: 3, radius_word: RADIUS };
        let mut simulator = LastTicks::simulator(&circuit).unwrap();
        let last = path.len() as u64 - 1;
        let mut begins = vec![0];
        for (index, segment) in (0u64..).zip(&path) {
            let begin = begins[index as usize];
            begins.push(begin + segment.length);
            for (word, data) in (0u64..).zip(segment.words()) {
                let path = PathWrite {
                    write_begin: word == 0,
                    begin_segment: index,
                    begin_length: begin,
                    write_path: true,
                    path_address: index << 4 | word,
                    path_data: data,
                };
                let i = In { path, ..idle(last) };
                simulator.step_with(&i, |_| ()).unwrap();
            }
        }
        // The ends of each segment too, the path's own among them.
        let ends = begins.iter().flat_map(|&begin| [begin, begin.saturating_sub(1)]);
        let within = shares.iter().map(|(share, index)| {
            let segment = index.index(path.len());
            begins[segment] + (share * path[segment].length as f64) as u64
        });
        for length in ends.chain(within) {
            let index = begins[..path.len()].iter().rposition(|&begin| begin <= length);
            let index = index.expect("the first begins at 0");
            let segment = &path[index];
            let latency = segment.latency();
            for ticks in 1..=latency {
                let i = In { start: ticks == 1, length, ..idle(last) };
                simulator.step_with(&i, |_| ()).unwrap();
                let done = simulator.see(|s| s.p.sequencer.q.done);
                assert_eq!(done, ticks == latency, "after {ticks} ticks");
            }
            let p = simulator.registers().p;
            assert_eq!(p.search.q.segment, index as u64);
            let exact = segment.point(length - begins[index]);
            for (axis, exact) in exact.into_iter().enumerate() {
                let off = p.axes[axis].q.point as f64 - exact;
                let bound = segment.bound();
                assert!(off.abs() <= bound, "axis {axis}: {off} off, {bound}");
            }
        }
    }
}
