//! Records of profiles, played by integers, against the profiles themselves.

use super::{config, spans};
use motion_rtl::circuits::trajectory_controller::Widths;
use motion_rtl::jobs::trajectory_controller::planner::plan;
use motion_rtl::jobs::trajectory_controller::profile::Profile;
use motion_rtl::jobs::trajectory_controller::profile_record::{lengths, records};
use motion_rtl::jobs::trajectory_controller::ramp::Slope;
use motion_rtl::jobs::trajectory_controller::speed_limits::Span;
use motion_rtl::path::record::Record;
use proptest::prelude::*;

/// Number of `bits` in two's complement.
fn signed(word: u64, bits: u32) -> i128 {
    let number = i128::from(word & ((1 << bits) - 1));
    number - ((number >> (bits - 1)) << bits)
}

/// The samples by additions, each word as wide as the circuit's.
fn added(records: &[Record]) -> Vec<i128> {
    let mut samples = vec![signed(records[0].words[2], 47)];
    for record in records {
        let words = &record.words;
        let modulus = words[1];
        assert!(words.iter().all(|word| word >> 55 == 0));
        assert!((1..=1 << 40).contains(&modulus));
        let mut columns = [(words[2], 0); 5];
        for (k, column) in columns.iter_mut().enumerate().skip(1) {
            *column = (words[6 + 2 * k], words[7 + 2 * k]);
            assert!(column.1 < modulus);
        }
        for _ in 0..words[0] >> 3 & 0xf_ffff {
            for k in 0..4 {
                let below = columns[k + 1];
                let part = columns[k].1 + below.1;
                let carry = u64::from(part >= modulus);
                columns[k] = (
                    columns[k].0.wrapping_add(below.0 + carry),
                    part - carry * modulus,
                );
            }
            let (whole, part) = columns[0];
            samples.push(signed(whole + u64::from(2 * part >= modulus), 47));
        }
    }
    samples
}

fn check(profile: &Profile, period: f64) -> Result<(), TestCaseError> {
    let records = records(profile, period, &Widths::FULL);
    let samples = added(&records);
    let last = (profile.duration / period).ceil() as usize;
    prop_assert_eq!(samples.len(), last + 1);
    prop_assert_eq!(samples[last] as f64, profile.length);
    let (mut most, mut back) = (0.0f64, 0);
    for (n, &sample) in samples.iter().enumerate().take(last) {
        let exact = profile.at(n as f64 * period)[0];
        most = most.max((sample as f64 - exact).abs());
        // A rounded length may step back by one where it hardly moves.
        back = back.max(sample - samples[n + 1]);
    }
    // A guard unit, and the last digit of a length near 2^46.
    prop_assert!(most <= 1.0 + profile.length / 2f64.powi(50), "{} off", most);
    prop_assert!(back <= 1, "{} back", back);
    let played: Vec<i128> = lengths(&records, &Widths::FULL)
        .into_iter()
        .map(i128::from)
        .collect();
    prop_assert_eq!(played, samples);
    for (index, record) in records.iter().enumerate() {
        let header = record.words[0];
        prop_assert_eq!(header >> 2 & 1, u64::from(index + 1 == records.len()));
        prop_assert!(header & 3 < 2 && header >> 3 > 0);
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn every_sample_is_that_of_the_profile(
        spans in spans(1..20),
        samples in 1.0..4.0f64,
        acceleration in 3.0..6.0f64,
        jerk_time in prop_oneof![Just(0.0), 1e-3..1.0f64],
    ) {
        let slope = Slope { acceleration: 10f64.powf(acceleration), time_constant: 0.0, jerk_time };
        let profile = plan(&spans, slope);
        check(&profile, profile.duration / 10f64.powf(samples))?;
    }
}

#[test]
fn the_longest_path_and_the_slowest_ramp() {
    // 2^30 counts at 1 mm/s and at 100 m/s of 1000 counts/mm; ramps of 20 s.
    for (speed, acceleration, period) in [(6.5536e7, 3.3e6, 0.1), (6.5536e12, 3e11, 1e-3)] {
        let length = (1 << 46) - (1 << 15) - 1;
        let length = length.min((speed * 1e5) as u64);
        let entry = 0.0;
        let spans = [Span {
            length,
            speed,
            entry,
        }];
        for jerk_time in [0.0, 5.0] {
            let slope = Slope {
                acceleration,
                time_constant: 0.0,
                jerk_time,
            };
            check(&plan(&spans, slope), period).unwrap();
        }
    }
}

#[test]
fn where_the_piece_changes_there_is_a_line() {
    // Up for 4 periods, 4 at 40 units a period, down for 4; begun on no sample but the first.
    let spans = [Span {
        length: 320,
        speed: 40.0,
        entry: 0.0,
    }];
    let slope = Slope {
        acceleration: 10.0,
        time_constant: 0.0,
        jerk_time: 0.0,
    };
    let profile = plan(&spans, slope);
    assert_eq!(profile.duration, 12.0);
    let kinds = |period: f64| -> Vec<(u64, u64)> {
        let records = records(&profile, period, &Widths::FULL);
        let header = |record: &Record| (record.words[0] & 3, record.words[0] >> 3);
        records.iter().map(header).collect()
    };
    assert_eq!(kinds(1.0), [(0, 3), (1, 1), (0, 3), (1, 1), (0, 3), (1, 1)]);
    assert_eq!(kinds(0.8), [(0, 4), (1, 1), (0, 4), (1, 1), (0, 4), (1, 1)]);
    assert_eq!(kinds(5.0), [(1, 1), (1, 1), (1, 1)]);
    assert_eq!(kinds(100.0), [(1, 1)]);
    let lengths = lengths(&records(&profile, 1.0, &Widths::FULL), &Widths::FULL);
    assert_eq!(
        lengths,
        [0, 5, 20, 45, 80, 120, 160, 200, 240, 275, 300, 315, 320]
    );
}
