//! Blends by products against integers: the weight of every h, every small blend, random large ones,
//! and whole paths on the generator.

use super::program::wrap;
use motion_rtl::check::Random;
use motion_rtl::circuits::arc_generator::blend_point::{self, SHARE_WORD};
use motion_rtl::circuits::arc_generator::{
    ArcGenerator, Blend, BlendPoint, BlendWeight, Rounding, Widths, blend_weight,
};
use motion_rtl::hdl::{Value, zero};
use motion_rtl::jobs::arc_generator::job::{Needed, play};
use motion_rtl::jobs::arc_generator::prepare::{Timing, prepare};
use motion_rtl::jobs::arc_generator::prepared::Prepared;
use motion_rtl::jobs::arc_generator::products::{commands, records};
use motion_rtl::jobs::arc_generator::settings::ShortPieces;
use motion_rtl::path::circle::Circle;
use motion_rtl::path::pieces::{Course, Piece};
use motion_rtl::sim::Simulator;
use motion_rtl::trace::LastTicks;

const FULL: Widths = Blend::Products.widths(Widths::FULL);

fn nearest(product: i128, fraction: usize) -> i128 {
    (product + (1 << (fraction - 1))) >> fraction
}

/// (2 − h)h³ as the circuit has it.
fn weight(h: i128, fraction: usize) -> i128 {
    let square = nearest(h * h, fraction);
    nearest(square * (2 * h - square), fraction)
}

#[test]
fn every_share_has_its_weight_bit_by_bit() {
    let (coefficient, fraction) = (9, 7);
    let circuit = BlendWeight { coefficient };
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    for share in 0..=1i64 << fraction {
        let mut i = blend_weight::In {
            step: true,
            share,
            ..zero(&circuit)
        };
        simulator.step_with(&i, |_| ()).unwrap();
        let mut words = [0i128; 2];
        for pass in 0..3 {
            i.step = false;
            assert!(simulator.see(|s| s.q.begins) && !simulator.see(|s| s.q.done));
            i.copy = true;
            simulator.step_with(&i, |_| ()).unwrap();
            i.copy = false;
            for bit in 0..=coefficient {
                i.fraction = bit < fraction;
                i.commit = bit == coefficient;
                simulator
                    .step_with(&i, |now| {
                        let bits = [now.w.share_bit, now.w.weight_bit];
                        assert!(pass == 2 || bits == [false; 2]);
                        assert_eq!(now.w.point_commit, i.commit && pass == 2);
                        for (word, high) in words.iter_mut().zip(bits) {
                            *word |= i128::from(high) << bit;
                        }
                    })
                    .unwrap();
            }
            i.commit = false;
        }
        assert!(simulator.see(|s| s.q.done) && !simulator.see(|s| s.q.begins));
        let h = i128::from(share);
        assert_eq!(words, [h, weight(h, fraction)]);
        // Within the bound of the exact weight: half a unit each of both products.
        let one = 1i128 << fraction;
        let exact = (2 * one - h) * h * h * h;
        let off = (words[1] * one.pow(3) - exact).abs();
        assert!(4 * off <= 3 * one.pow(3), "{h}: {off}");
    }
}

/// A blend of three coordinates, and the record that says so.
fn record(points: [[i128; 3]; 3], samples: u64, widths: &Widths) -> Vec<(u64, u64)> {
    let [before, corner, behind] = points;
    let one = 1u64 << widths.coefficient_fraction();
    let cut = |word: i128| word as u64 & ((1 << (widths.point + 2)) - 1);
    let mut words: Vec<_> = (2..5).map(|word| (word, 0)).collect();
    for k in 0..3 {
        let first = 8 + 8 * k as u64;
        words.push((first, cut(2 * (corner[k] - before[k]))));
        words.push((first + 1, cut(before[k] - 2 * corner[k] + behind[k])));
    }
    words.extend((SHARE_WORD..).zip([0, one / samples, one % samples]));
    words
}

fn load(
    simulator: &mut Simulator<BlendPoint>,
    i: &mut blend_point::In<Value>,
    words: &[(u64, u64)],
) {
    i.record.load = true;
    for (word, data) in words {
        (i.record.word, i.record.data) = (*word, *data);
        simulator.step_with(i, |_| ()).unwrap();
    }
    i.record.load = false;
}

/// Plays `steps` samples of a blend of `samples`, each in its ticks, and calls with the ways from A⁻.
fn blend(
    simulator: &mut Simulator<BlendPoint>,
    circuit: &BlendPoint,
    points: [[i128; 3]; 3],
    [samples, steps]: [u64; 2],
) {
    let widths = &circuit.widths;
    let fraction = widths.coefficient_fraction();
    let mut i = blend_point::In {
        modulus: samples,
        ..zero(circuit)
    };
    load(simulator, &mut i, &record(points, samples, widths));
    let [before, corner, behind] = points;
    let (m, one) = (i128::from(samples), 1i128 << fraction);
    let mut last = [0i64; 3];
    for n in 1..=i128::from(steps) {
        i.step = true;
        for _ in 0..circuit.latency() {
            simulator
                .step_with(&i, |now| {
                    assert_eq!(([now.w.x, now.w.y, now.w.z], now.w.done), (last, false));
                })
                .unwrap();
            i.step = false;
        }
        simulator
            .step_with(&i, |now| {
                assert!(now.w.done);
                last = [now.w.x, now.w.y, now.w.z];
            })
            .unwrap();
        let h = (2 * n * one + m).div_euclid(2 * m);
        let weight = weight(h, fraction);
        for k in 0..3 {
            let (slope, bend) = (
                2 * (corner[k] - before[k]),
                before[k] - 2 * corner[k] + behind[k],
            );
            let way = wrap(nearest(slope * h + bend * weight, fraction), widths.point);
            assert_eq!(i128::from(last[k]), way, "{points:?}, {n} of {m}");
            if n == m {
                assert_eq!(way, wrap(behind[k] - before[k], widths.point));
            }
        }
    }
}

#[test]
fn every_small_blend_is_its_program() {
    let widths = Widths {
        point: 4,
        coefficient: 9,
        fraction: 5,
        data: 9,
        ..Widths::FULL
    };
    let circuit = BlendPoint { widths };
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    let cases: Vec<[i128; 3]> = (0..1 << 12)
        .map(|case| [0, 4, 8].map(|low| wrap(case >> low, 4)))
        .collect();
    for samples in [1, 2, 3, 6, 16] {
        for three in cases.chunks(3) {
            let of = |point: usize| [0, 1, 2].map(|k| three[k.min(three.len() - 1)][point]);
            let points = [of(0), of(1), of(2)];
            blend(&mut simulator, &circuit, points, [samples, samples]);
        }
    }
}

#[test]
fn blends_of_full_width_are_their_program() {
    let circuit = BlendPoint { widths: FULL };
    assert_eq!(circuit.latency(), 133);
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    let mut random = Random::new(5);
    for case in 0..120 {
        let points = [0; 3].map(|_| [0; 3].map(|_| wrap(random.word().into(), 40)));
        let samples = match case % 3 {
            0 => 1 + random.word() % 12,
            1 => 1 + random.word() % 1024,
            _ => (1 << 20) - 2 - random.word() % 1000,
        };
        blend(&mut simulator, &circuit, points, [samples, samples.min(12)]);
    }
    // Beyond the words of a difference engine, to the end.
    let points = [
        [-(1 << 39); 3],
        [1 << 38, -(1 << 39), 7],
        [(1 << 39) - 1, 5, -(1 << 39)],
    ];
    blend(&mut simulator, &circuit, points, [1500, 1500]);
}

#[test]
fn a_halt_leaves_nothing_behind() {
    let circuit = BlendPoint { widths: FULL };
    let points = [
        [5, -9, 1 << 30],
        [1 << 20, 77, -3],
        [-(1 << 33), 1 << 25, 0],
    ];
    let mut i = blend_point::In {
        modulus: 9,
        ..zero(&circuit)
    };
    for ticks in 0..=circuit.latency() {
        let mut simulator = LastTicks::simulator(&circuit).unwrap();
        load(&mut simulator, &mut i, &record(points, 9, &FULL));
        i.step = true;
        for _ in 0..ticks {
            simulator.step_with(&i, |_| ()).unwrap();
            i.step = false;
        }
        // A step that comes with the halt is not taken.
        (i.step, i.halt) = (true, true);
        simulator.step_with(&i, |_| ()).unwrap();
        (i.step, i.halt) = (false, false);
        for _ in 0..140 {
            simulator
                .step_with(&i, |now| assert!(!now.w.done, "after {ticks}"))
                .unwrap();
        }
        blend(&mut simulator, &circuit, points, [9, 2]);
    }
}

/// A line, an arc and a line, joined.
fn path(blend_samples: u64) -> Prepared {
    let timing = Timing {
        sample_s: 1e-3,
        blend_samples,
        corner: 0.5,
        short_pieces: ShortPieces::Slower,
        most_samples: FULL.most_samples(),
    };
    let piece = |to, course| Piece {
        line: None,
        to,
        course,
        speed: 200.0,
    };
    let circle = Circle::through([40.0, 0.0, 0.0], [60.0, 20.0, 0.0], [40.0, 40.0, 0.0]).unwrap();
    let pieces = [
        piece([40.0, 0.0, 0.0], Course::Line),
        piece([40.0, 40.0, 0.0], Course::Arc(circle)),
        piece([-3.0, 40.0, 0.0], Course::Line),
    ];
    prepare([0.0; 3], &pieces, &timing).unwrap()
}

#[test]
fn whole_paths_are_those_of_the_program_in_their_ticks() {
    for rounding in [Rounding::Nearest, Rounding::Floor] {
        let circuit = ArcGenerator::new(rounding, Blend::Products);
        let least = circuit.least_period();
        assert_eq!(least, 171);
        let all = records(&path(8), 1000.0, &FULL, rounding).unwrap();
        let expected: Vec<_> = commands(&all, &FULL, rounding).collect();
        for period in [least, least - 1] {
            let played = play(&circuit, &all, period as u32, &mut ()).unwrap();
            let counts: Vec<_> = played.commands.iter().map(|c| c.counts).collect();
            assert_eq!(counts, expected, "{rounding:?}");
            let needed = Needed {
                straight: 136,
                arc: 47,
                change: 171,
            };
            assert_eq!(played.needed, needed);
            assert_eq!(played.late, period < least);
            assert!(!played.starved);
        }
    }
}
