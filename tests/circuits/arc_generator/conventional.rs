//! The conventional circuit against programs with wide numbers: its blocks, and whole arcs.

use super::program::{rotated, wrap};
use motion_rtl::circuits::arc_generator::axis_terms::AXIS_WORD;
use motion_rtl::circuits::arc_generator::generator::In;
use motion_rtl::circuits::arc_generator::matrix_element::{self, Sign};
use motion_rtl::circuits::arc_generator::sine_words::{self, FINE};
use motion_rtl::circuits::arc_generator::vector_row::{self, VECTOR_WORD};
use motion_rtl::circuits::arc_generator::{
    Conventional, MatrixElement, Rounding, SineWords, VectorRow, Widths,
};
use motion_rtl::circuits::blocks::RecordWrite;
use motion_rtl::circuits::blocks::cordic_state::GAIN;
use motion_rtl::hdl::zero;
use motion_rtl::jobs::arc_generator::beside::{play, records};
use motion_rtl::jobs::arc_generator::conventional::Conventional as Method;
use motion_rtl::jobs::arc_generator::job::Needed;
use motion_rtl::jobs::arc_generator::prepare::Timing;
use motion_rtl::jobs::arc_generator::settings::ShortPieces;
use motion_rtl::path::circle::Circle;
use motion_rtl::path::record::Record;
use motion_rtl::sim::Simulator;
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;
use std::f64::consts::TAU;

const FULL: Widths = Widths::FULL;
/// B, C and P at full width.
const FRACTION: usize = 40;
const COEFFICIENT: usize = 42;
const POINT: usize = 40;

#[test]
fn every_element_of_four_bits_is_the_sum_of_its_products() {
    for (sign, factor) in [(Sign::Plus, 1), (Sign::Minus, -1)] {
        let circuit = MatrixElement {
            coefficient: 4,
            sign,
        };
        let mut simulator = LastTicks::simulator(&circuit).unwrap();
        for case in 0..1i128 << 16 {
            let [product, turn, versine, other] = [0, 4, 8, 12].map(|low| wrap(case >> low, 4));
            let mut i = matrix_element::In {
                copy: true,
                product: product as i64,
                turn: turn as i64,
                ..zero(&circuit)
            };
            simulator.step_with(&i, |_| ()).unwrap();
            i.copy = false;
            for bit in 0..4 {
                i.fraction = bit < 2;
                i.top = bit == 3;
                i.versine_bit = versine >> bit & 1 == 1;
                i.turn_bit = other >> bit & 1 == 1;
                simulator.step_with(&i, |_| ()).unwrap();
            }
            let exact = product * versine + factor * turn * other;
            let entry = wrap(simulator.see(|s| s.w.entry).into(), 4);
            assert_eq!(
                entry,
                wrap((exact + 2) >> 2, 4),
                "{product} {versine} {turn} {other}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn a_row_of_full_width_is_right(
        by in prop::array::uniform3(-(1i128 << FRACTION)..=1 << FRACTION),
        from in prop::array::uniform3(-(1i128 << 37)..1i128 << 37),
        coordinate in 0..3usize,
        nearest in any::<bool>(),
    ) {
        let rounding = if nearest { Rounding::Nearest } else { Rounding::Floor };
        let circuit = VectorRow { widths: FULL, coordinate: coordinate as u64, rounding };
        let mut simulator = LastTicks::simulator(&circuit).unwrap();
        let mask = (1 << COEFFICIENT) - 1;
        let mut i = vector_row::In {
            copy: true,
            by_x: by[0] as u64 & mask,
            by_y: by[1] as u64 & mask,
            by_z: by[2] as u64 & mask,
            x: from[0] as i64,
            y: from[1] as i64,
            z: from[2] as i64,
            ..zero(&circuit)
        };
        simulator.step_with(&i, |_| ()).unwrap();
        i.copy = false;
        for bit in 0..=COEFFICIENT {
            i.fraction = bit < FRACTION;
            i.top = bit == COEFFICIENT - 1;
            i.commit = bit == COEFFICIENT;
            assert_eq!(simulator.see(|s| s.q.offset), 0);
            simulator.step_with(&i, |_| ()).unwrap();
        }
        let [expected, _, _] = rotated(&[by, [0; 3], [0; 3]], from, FRACTION, nearest);
        assert_eq!(i128::from(simulator.see(|s| s.q.offset)), wrap(expected, POINT));
    }

    #[test]
    fn sine_and_cosine_are_rounded_and_come_bit_by_bit(
        along in -(1i64 << (FRACTION + FINE))..=1 << (FRACTION + FINE),
        across in -(1i64 << (FRACTION + FINE))..=1 << (FRACTION + FINE),
    ) {
        let circuit = SineWords { coefficient: COEFFICIENT };
        let mut simulator = LastTicks::simulator(&circuit).unwrap();
        simulator.step_with(&sine_words::In { copy: true, along, across }, |_| ()).unwrap();
        let i = zero(&circuit);
        let mut words = [0i128; 3];
        for bit in 0..COEFFICIENT {
            simulator.step_with(&i, |now| {
                let bits = [now.w.cosine_bit, now.w.sine_bit, now.w.versine_bit];
                for (word, high) in words.iter_mut().zip(bits) {
                    *word |= i128::from(high) << bit;
                }
            }).unwrap();
        }
        let nearest = |word: i64| (i128::from(word) + (1 << (FINE - 1))) >> FINE;
        let (cosine, sine) = (nearest(along), nearest(across));
        let expected = [cosine, sine, (1 << FRACTION) - cosine];
        assert_eq!(words.map(|word| wrap(word, COEFFICIENT)), expected);
    }
}

/// CORDIC as a program: a unit vector turned by an angle of 42 bits.
fn turned(angle: i128) -> [i128; 2] {
    let unit = (2f64).powi(COEFFICIENT as i32) / TAU;
    let quarter = (angle + (1 << (COEFFICIENT - 3))).rem_euclid(1 << COEFFICIENT) >> FRACTION;
    let radius = ((2f64).powi((FRACTION + FINE) as i32) / GAIN).round() as i128;
    let mut left = wrap(angle - (quarter << FRACTION), COEFFICIENT);
    let [mut x, mut y] = match quarter {
        0 => [radius, 0],
        1 => [0, radius],
        2 => [-radius, 0],
        _ => [0, -radius],
    };
    for n in 0..COEFFICIENT {
        let turn = ((2f64).powi(-(n as i32)).atan() * unit).round() as i128;
        let sign = if left < 0 { -1 } else { 1 };
        [x, y] = [x - sign * (y >> n), y + sign * (x >> n)];
        left -= sign * turn;
    }
    [x, y]
}

/// \[2\] of sine and cosine with FINE bits more, and of k and its products as the record has them.
fn matrix([along, across]: [i128; 2], terms: &[i128]) -> [[i128; 3]; 3] {
    let nearest = |word: i128| (word + (1 << (FINE - 1))) >> FINE;
    let (cosine, sine) = (nearest(along), nearest(across));
    let versine = (1 << FRACTION) - cosine;
    let &[x, y, z, xx, yy, zz, xy, xz, yz] = terms else {
        panic!("nine terms");
    };
    let entry = |product: i128, word: i128, by: i128| {
        (product * versine + word * by + (1 << (FRACTION - 1))) >> FRACTION
    };
    let one = 1 << FRACTION;
    [
        [
            entry(xx, one, cosine),
            entry(xy, -z, sine),
            entry(xz, y, sine),
        ],
        [
            entry(xy, z, sine),
            entry(yy, one, cosine),
            entry(yz, -x, sine),
        ],
        [
            entry(xz, -y, sine),
            entry(yz, x, sine),
            entry(zz, one, cosine),
        ],
    ]
}

/// The commands of an arc's records.
fn program(records: &[Record], rounding: Rounding) -> Vec<[i64; 3]> {
    let mut commands = Vec::new();
    for record in records {
        let word = |word: usize, bits| wrap(record.words[word].into(), bits);
        let samples = record.words[0] >> 3;
        let modulus = i128::from(record.words[1]);
        let angle = |n: u64| {
            let mut sum = word(2, COEFFICIENT) * modulus;
            let mut ways = 1;
            for k in 0..4usize {
                ways = ways * (i128::from(n) - k as i128) / (k as i128 + 1);
                let part = i128::from(record.words[9 + 2 * k]);
                sum += ways * (word(8 + 2 * k, COEFFICIENT) * modulus + part);
            }
            (2 * sum + modulus).div_euclid(2 * modulus)
        };
        let three = |first: usize, bits| [0, 1, 2].map(|k| word(first + k, bits));
        let (centre, mut vector) = (three(5, POINT), three(VECTOR_WORD as usize, POINT));
        let first = AXIS_WORD as usize;
        let terms: Vec<_> = (first..first + 9).map(|k| word(k, COEFFICIENT)).collect();
        let command = |vector: [i128; 3]| {
            [0, 1, 2].map(|k| wrap((centre[k] + vector[k] + (1 << 15)) >> 16, 24) as i64)
        };
        if samples == 0 {
            commands.push(command(vector));
        }
        for n in 1..=samples {
            let step = (angle(n) - angle(n - 1)).rem_euclid(1 << COEFFICIENT);
            let matrix = matrix(turned(step), &terms);
            vector = rotated(&matrix, vector, FRACTION, rounding == Rounding::Nearest);
            commands.push(command(vector));
        }
    }
    commands
}

/// An arc of a circle, with four samples in a ramp.
fn method(axis: [f64; 3], radius: f64, angle: f64, speed: f64) -> Method {
    let length = axis.iter().map(|k| k * k).sum::<f64>().sqrt();
    let axis = axis.map(|k| k / length);
    // At right angles to the axis.
    let [x, y, z] = axis;
    let across = if z.abs() < 0.9 {
        [y, -x, 0.0]
    } else {
        [0.0, z, -y]
    };
    let size = across.iter().map(|k| k * k).sum::<f64>().sqrt();
    let centre = [1.25, -7.0, 3.5];
    let circle = Circle {
        centre,
        axis,
        start: [0, 1, 2].map(|k| centre[k] + radius * across[k] / size),
        radius,
        angle,
    };
    let timing = Timing {
        sample_s: 1e-3,
        blend_samples: 4,
        corner: 0.0,
        short_pieces: ShortPieces::Refuse,
        most_samples: FULL.most_samples(),
    };
    Method::new(&circle, speed, &timing)
}

/// The least period, in ticks, and the ticks from a sampling time to the next point of the segment.
const LEAST: u32 = 169;
const NEXT: u64 = 134;

#[test]
fn whole_arcs_are_those_of_the_program_in_their_ticks() {
    let arcs = [
        method([2.0, -3.0, 6.0], 40.0, 2.0, 3000.0),
        method([-1.0, 0.5, -0.25], 700.0, TAU, 300_000.0),
        method([0.0, 0.0, 1.0], 0.01, 6.0, 2.0),
    ];
    let needed = Needed {
        straight: 0,
        arc: NEXT,
        change: LEAST.into(),
    };
    for rounding in [Rounding::Nearest, Rounding::Floor] {
        let circuit = Conventional::new(rounding);
        assert_eq!(circuit.least_period(), u64::from(LEAST));
        let all: Vec<_> = arcs
            .iter()
            .flat_map(|arc| records(arc, 1e3, &FULL).unwrap())
            .collect();
        let expected = program(&all, rounding);
        let samples: u64 = arcs.iter().map(|arc| 1 + 2 * arc.ramp + arc.samples).sum();
        assert_eq!(expected.len() as u64, samples);
        for period in [LEAST, LEAST - 1] {
            let played = play(&circuit, &all, period, &mut ()).unwrap();
            let commands: Vec<_> = played
                .commands
                .iter()
                .map(|command| command.counts)
                .collect();
            assert_eq!(commands, expected, "{rounding:?}");
            assert_eq!(played.needed, needed);
            assert_eq!(played.late, period < LEAST);
            assert!(!played.starved);
        }
    }
}

#[test]
fn a_halt_leaves_nothing_behind() {
    let circuit = Conventional::new(Rounding::Nearest);
    let arc = records(&method([2.0, -3.0, 6.0], 40.0, 1.0, 8000.0), 1e3, &FULL).unwrap();
    let expected = program(&arc, Rounding::Nearest);
    let commands = |simulator: &mut Simulator<Conventional>, most: usize| {
        let mut i = In {
            sample_period: 180,
            ..zero(&circuit)
        };
        let words = arc.iter().flat_map(|record| record.words.iter().zip(0..));
        for (data, word) in words {
            i.segments.record = RecordWrite {
                write: true,
                write_word: word,
                write_data: *data,
                push: word == 31,
            };
            simulator.step_with(&i, |_| ()).unwrap();
        }
        i.segments = zero(&circuit).segments;
        i.segments.start = true;
        simulator.step_with(&i, |_| ()).unwrap();
        i.segments.start = false;
        let mut commands = Vec::new();
        for _ in 0..most {
            let busy = simulator
                .step_with(&i, |now| {
                    if now.w.sampled {
                        commands.push([now.w.x, now.w.y, now.w.z]);
                    }
                    now.w.busy
                })
                .unwrap();
            if !busy {
                break;
            }
        }
        commands
    };
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    assert_eq!(commands(&mut simulator, 1_000_000), expected);
    // In every phase of a sample; what was under way takes up to 131 ticks more.
    for ticks in 700..700 + 180 {
        let mut simulator = simulator.clone();
        let before = commands(&mut simulator, ticks);
        assert_eq!(before, expected[..before.len()]);
        simulator
            .step_with(
                &In {
                    halt: true,
                    ..zero(&circuit)
                },
                |_| (),
            )
            .unwrap();
        assert!(!simulator.see(|s| s.w.busy));
        assert_eq!(
            commands(&mut simulator, 1_000_000),
            expected,
            "after {ticks}"
        );
    }
}

#[test]
fn what_does_not_fit_has_no_records() {
    let fits = method([0.0, 0.0, 1.0], 8000.0, 3.0, 1e6);
    assert_eq!(records(&fits, 1e3, &FULL).map(|all| all.len()), Some(4));
    // 2^23 counts are 8388.6 mm.
    let wide = method([0.0, 0.0, 1.0], 8400.0, 3.0, 1e6);
    assert_eq!(records(&wide, 1e3, &FULL), None);
    let slow = method([0.0, 0.0, 1.0], 1000.0, 6.0, 5.0);
    assert_eq!(records(&slow, 1e3, &FULL), None);
}
