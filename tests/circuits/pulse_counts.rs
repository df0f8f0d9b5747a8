//! The pulses of the circuit against their definition, for every small unit time and half-period.

use super::common::{player, rises, steps, unit_wave, widths};
use motion_rtl::circuits::pulse_interpolator::Variant::{Literal, Safe};
use motion_rtl::trace::LastTicks;

/// The unit time at power-on is silent; the pattern's first unit time follows.
fn after_start(wave: &[bool], period: u64) -> &[bool] {
    &wave[period as usize..]
}

#[test]
fn every_unit_obeys_the_count_law_and_is_low_at_its_borders() {
    let half_periods: Vec<u64> = (0..80).flat_map(|n| [n, n]).collect();
    for period in 1..=64u64 {
        let group = player(widths(7, 7, 8), Safe, &half_periods, period, false);
        let units = half_periods.len() as u64;
        let wave = steps(&group, (units + 2) * period);
        let (silent, rest) = wave.split_at(period as usize);
        assert_eq!(rises(silent), 0, "pulses before the first unit time");
        let mut played = rest.chunks(period as usize);
        for n in &half_periods {
            let unit = played.next().expect("a unit time of each");
            assert!(!unit[0], "high across RST: T = {period}, n = {n}");
            let law = match n {
                0 => 0,
                n => ((period - 1) / n).div_ceil(2),
            };
            assert_eq!(rises(unit), law, "T = {period}, n = {n}");
            assert_eq!(unit, unit_wave(*n, period), "T = {period}, n = {n}");
        }
        assert_eq!(rises(played.next().unwrap()), 0, "pulses after the end");
    }
}

#[test]
fn a_unit_does_not_depend_on_the_unit_before() {
    for period in 1..=24u64 {
        // Longer ones are alike: there is no pulse.
        let all = 0..period + 2;
        let pairs = all.clone().flat_map(|first| {
            let pair = move |second| [first, second];
            all.clone().flat_map(pair)
        });
        let half_periods: Vec<u64> = pairs.collect();
        let group = player(widths(5, 5, 11), Safe, &half_periods, period, false);
        let wave = steps(&group, (half_periods.len() as u64 + 1) * period);
        let mut played = after_start(&wave, period).chunks(period as usize);
        for (address, n) in half_periods.iter().enumerate() {
            let unit = played.next().expect("a unit time of each");
            assert_eq!(
                unit,
                unit_wave(*n, period),
                "T = {period}, n = {n} at {address}"
            );
        }
    }
}

#[test]
fn the_literal_variant_miscounts() {
    let mut units = 0;
    let mut wrong = 0;
    for period in 2..=64u64 {
        let half_periods: Vec<u64> = (1..=period).flat_map(|n| [n; 8]).collect();
        let group = player(widths(7, 7, 9), Literal, &half_periods, period, false);
        let wave = steps(&group, (half_periods.len() as u64 + 1) * period);
        let played = after_start(&wave, period).chunks(period as usize);
        for (unit, n) in played.zip(half_periods) {
            units += 1;
            wrong += u32::from(rises(unit) != rises(&unit_wave(n, period)));
        }
    }
    assert!(
        wrong * 10 > units * 2,
        "only {wrong} of {units} units miscount: is this the literal variant?"
    );
}

#[test]
fn known_counts_at_a_unit_time_of_1000_ticks() {
    for (half_period, count) in [
        (0, 0),
        (1, 500),
        (2, 250),
        (20, 25),
        (333, 2),
        (334, 1),
        (999, 1),
        (1000, 0),
        (65_535, 0),
    ] {
        let group = player(widths(16, 24, 1), Safe, &[half_period], 1000, false);
        assert_eq!(rises(&steps(&group, 3000)), count, "n = {half_period}");
    }
}

#[test]
fn the_literal_generator_takes_no_notice_of_rst() {
    use motion_rtl::circuits::pulse_interpolator::{PulseGenerator, pulse_generator::In};
    for half_period in 1..16u64 {
        for rst_every in [1, 2, 3, 7, 100] {
            let generator = PulseGenerator {
                width: 4,
                variant: Literal,
            };
            let mut simulator = LastTicks::simulator(&generator).unwrap();
            for tick in 0..100u64 {
                let i = In {
                    half_period,
                    unit_rst: tick % rst_every == rst_every - 1,
                };
                let pulse = simulator.step_with(&i, |now| now.w.pulse).unwrap();
                let expected = (tick + 1) / half_period % 2 == 1;
                assert_eq!(pulse, expected, "n = {half_period}, tick {tick}");
            }
        }
    }
}
