//! The difference engine against the polynomial of the text.

use super::program::differences;
use motion_rtl::circuits::blocks::difference_column::Widths;
use motion_rtl::circuits::blocks::difference_engine::In;
use motion_rtl::circuits::blocks::{DifferenceEngine, RecordWord};
use motion_rtl::hdl::{Cut, zero};
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;

const SMALL: Widths = Widths {
    whole: 5,
    part: 18,
    data: 18,
};
const FULL: Widths = Widths {
    whole: 40,
    part: 41,
    data: 42,
};

/// x·M⁴ after `sample` of M samples, as [5] and [10] have it: h = sample / M.
pub fn quartic([before, at, behind]: [i128; 3], samples: i128, sample: i128) -> i128 {
    let (m, i) = (samples, sample);
    let (m3, i3) = (m * m * m, i * i * i);
    before * m3 * m + 2 * (at - before) * i * m3 + (before - 2 * at + behind) * (2 * m - i) * i3
}

/// Outputs of the engine after its loads and after each of `steps` steps: value as whole and part,
/// and the nearest.
fn run(
    widths: Widths,
    coordinate: u64,
    modulus: i128,
    words: [i128; 5],
    steps: i128,
) -> Vec<(i128, i128, i128)> {
    let circuit = DifferenceEngine { widths, coordinate };
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    let mut loads = vec![(2 + coordinate, words[0])];
    for (order, difference) in words[1..].iter().enumerate() {
        let first = 8 + 8 * coordinate + 2 * order as u64;
        loads.push((first, difference.div_euclid(modulus)));
        loads.push((first + 1, difference.rem_euclid(modulus)));
    }
    let width = simulator.signals().i.record.data.width();
    let idle = In {
        modulus: modulus as u64,
        ..zero(&circuit)
    };
    for (word, data) in loads {
        let i = In {
            record: RecordWord {
                load: true,
                word,
                data: (data as u64).cut(width),
            },
            ..idle.clone()
        };
        simulator.step_with(&i, |_| ()).unwrap();
    }
    let mut seen = Vec::new();
    for sample in 0..=steps {
        // Without a step it stays.
        simulator.step_with(&idle, |_| ()).unwrap();
        let i = In {
            step: sample < steps,
            ..idle.clone()
        };
        seen.push(
            simulator
                .step_with(&i, |now| {
                    let [whole, nearest] =
                        [now.see(|s| s.p.value.q.whole), now.see(|s| s.w.nearest)];
                    (
                        whole.into(),
                        now.see(|s| s.p.value.q.part).into(),
                        nearest.into(),
                    )
                })
                .unwrap(),
        );
    }
    seen
}

/// Runs a blend and compares every sample.
fn blends(widths: Widths, coordinate: u64, points: [i128; 3], samples: i128) {
    let modulus = samples.pow(4);
    let [start, ..] = points;
    let differences = differences(|sample| quartic(points, samples, sample));
    let [_, d1, d2, d3, d4] = differences;
    let seen = run(
        widths,
        coordinate,
        modulus,
        [start, d1, d2, d3, d4],
        samples,
    );
    for (sample, &(whole, part, nearest)) in seen.iter().enumerate() {
        let exact = quartic(points, samples, sample as i128);
        assert_eq!(
            whole * modulus + part,
            exact,
            "{points:?}, {sample} of {samples}"
        );
        assert_eq!(nearest, (2 * exact + modulus).div_euclid(2 * modulus));
    }
    let &(end, rest, _) = seen.last().expect("samples");
    assert_eq!((end, rest), (points[2], 0), "{points:?} in {samples}");
    let mut ordered = points;
    ordered.sort_unstable();
    if points == ordered {
        assert!(
            seen.is_sorted_by_key(|sample| sample.2),
            "{points:?}, {seen:?}"
        );
    }
    ordered.reverse();
    if points == ordered {
        let falls = seen.windows(2).all(|pair| pair[0].2 >= pair[1].2);
        assert!(falls, "{points:?}, {seen:?}");
    }
}

/// Everything from −4 to 4.
fn points() -> impl Iterator<Item = [i128; 3]> {
    let all = || -4..=4i128;
    all().flat_map(move |a| all().flat_map(move |b| all().map(move |c| [a, b, c])))
}

#[test]
#[ignore = "takes long"]
fn every_small_blend_is_the_polynomial() {
    for (index, points) in points().enumerate() {
        for samples in [2, 4, 8, 16] {
            blends(SMALL, index as u64 % 3, points, samples);
        }
        // Samples that are no power of two divide as well.
        for samples in [6, 10] {
            blends(SMALL, index as u64 % 3, points, samples);
        }
    }
}

#[test]
fn every_small_line_ends_on_its_end() {
    for start in -4..=4i128 {
        for end in -4..=4i128 {
            for samples in 1..=17 {
                let words = [start, end - start, 0, 0, 0];
                let seen = run(SMALL, 1, samples, words, samples);
                for (sample, &(whole, part, _)) in seen.iter().enumerate() {
                    let exact = start * samples + (end - start) * sample as i128;
                    assert_eq!(whole * samples + part, exact, "{start} to {end}");
                }
                assert_eq!(seen[samples as usize].0, end);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_blend_of_any_size_is_the_polynomial(
        points in prop::array::uniform3(-(1i128 << 38)..1i128 << 38),
        half in 1..=512i128,
        coordinate in 0..3u64,
    ) {
        // A blend may overshoot its points; what fits into the word is exact.
        blends(FULL, coordinate, points.map(|point| point / 4), 2 * half);
    }
}
