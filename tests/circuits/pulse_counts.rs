//! The pulses of the circuit against their definition, for every small unit time and half-period.

use super::common::{player, rises, steps, unit_wave, widths};
use motion_rtl::circuits::pulse_interpolator::Variant::{Literal, Safe};

/// The unit time at power-on is silent; the pattern's first unit time follows.
fn after_start(wave: &[bool], period: u64) -> &[bool] {
    &wave[period as usize..]
}

#[test]
fn every_unit_obeys_the_count_law_and_is_low_at_its_borders() {
    for period in 1..=64u64 {
        for half_period in 0..80u64 {
            let group = player(
                widths(7, 7, 1),
                Safe,
                &[half_period, half_period],
                period,
                false,
            );
            let wave = steps(&group, 4 * period);
            let (silent, rest) = wave.split_at(period as usize);
            assert_eq!(rises(silent), 0, "pulses before the first unit time");
            for unit in rest[..2 * period as usize].chunks(period as usize) {
                assert!(!unit[0], "high across RST: T = {period}, n = {half_period}");
                let law = match half_period {
                    0 => 0,
                    n => ((period - 1) / n).div_ceil(2),
                };
                assert_eq!(rises(unit), law, "T = {period}, n = {half_period}");
                assert_eq!(unit, unit_wave(half_period, period));
            }
            assert_eq!(
                rises(&rest[2 * period as usize..]),
                0,
                "pulses after the end"
            );
        }
    }
}

#[test]
fn a_unit_does_not_depend_on_the_unit_before() {
    for period in 1..=24u64 {
        // Longer ones are alike: there is no pulse.
        for first in 0..period + 2 {
            for second in 0..period + 2 {
                let group = player(widths(5, 5, 1), Safe, &[first, second], period, false);
                let wave = steps(&group, 3 * period);
                let units = after_start(&wave, period);
                assert_eq!(units[..period as usize], unit_wave(first, period));
                assert_eq!(units[period as usize..], unit_wave(second, period));
            }
        }
    }
}

#[test]
fn the_literal_variant_miscounts() {
    let mut units = 0;
    let mut wrong = 0;
    for period in 2..=64u64 {
        for half_period in 1..=period {
            let group = player(widths(7, 7, 1), Literal, &[half_period; 2], period, true);
            let wave = steps(&group, 9 * period);
            for unit in after_start(&wave, period).chunks(period as usize) {
                units += 1;
                wrong += u32::from(rises(unit) != rises(&unit_wave(half_period, period)));
            }
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
    use motion_rtl::hdl::Simulator;
    for half_period in 1..16u64 {
        for rst_every in [1, 2, 3, 7, 100] {
            let generator = PulseGenerator {
                width: 4,
                variant: Literal,
            };
            let mut simulator = Simulator::new(&generator).unwrap();
            for tick in 0..100u64 {
                let i = In {
                    half_period,
                    unit_rst: tick % rst_every == rst_every - 1,
                };
                let pulse = simulator.step_with(&i, |now| now.w.pulse);
                let expected = (tick + 1) / half_period % 2 == 1;
                assert_eq!(pulse, expected, "n = {half_period}, tick {tick}");
            }
        }
    }
}
