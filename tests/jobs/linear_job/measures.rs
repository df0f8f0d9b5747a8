//! The measures that runs are judged by, of records that are known.

use super::*;

fn record(tick: u64, command: [i64; 2], motor: [f64; 2]) -> ScanRecord {
    ScanRecord {
        tick,
        command,
        motor,
    }
}

/// A stroke from (10, 20) by (40, 30) and then one straight down, with known errors.
fn two_strokes() -> Played {
    Played {
        ticks: 700,
        records: vec![
            // Before the first cycle: belongs to none.
            record(100, [10, 20], [99.0, -99.0]),
            // 1 to the left along Y: |40·(21 − 20) − 30·0| = 40 of 40.
            record(200, [10, 21], [10.0, 20.0]),
            // (30, 35) is on the line; the motor is 5 to the right: (+3, −4).
            record(300, [30, 35], [33.0, 31.0]),
            record(400, [50, 50], [46.0, 47.0]),
            // The wait belongs to the first stroke: 10 to the left, (−6, +8).
            record(500, [50, 50], [44.0, 58.0]),
            record(600, [50, 10], [52.5, 40.0]),
            record(700, [51, 0], [49.0, 0.0]),
        ],
        cycles: vec![
            Cycle {
                from: [10, 20],
                to: [50, 50],
                master: 0,
                scans: 1..4,
                end: [50, 50],
            },
            Cycle {
                from: [50, 50],
                to: [50, 0],
                master: 1,
                scans: 5..7,
                end: [51, 0],
            },
        ],
        ..Played::default()
    }
}

#[test]
fn the_measures_of_known_records() {
    let mut segments = two_strokes().segments([100.0, 100.0]);
    for segment in &mut segments {
        // Lengths are roots: no digits beyond these.
        let round = |value: f64| (value * 1e9).round() / 1e9;
        segment.contour_counts = round(segment.contour_counts);
        segment.contour_um = round(segment.contour_um);
    }
    let first = Segment {
        delta: [40, 30],
        master: 0,
        scans: 3,
        end_error: [0, 0],
        // Speeds of 0, 20, 20, 0 and 1, 14, 15, 0.
        master_acceleration: 20,
        slave_acceleration: 15,
        deviation: Deviation {
            numerator: 40,
            denominator: 40,
        },
        perpendicular_counts: 0.8,
        contour_counts: 10.0,
        contour_um: 100.0,
    };
    let second = Segment {
        delta: [0, -50],
        master: 1,
        scans: 2,
        end_error: [1, 0],
        // Y leads: −40, −10, 0; X 0, 1, 0.
        master_acceleration: 40,
        slave_acceleration: 1,
        deviation: Deviation {
            numerator: 50,
            denominator: 50,
        },
        perpendicular_counts: 1.0,
        contour_counts: 2.5,
        contour_um: 25.0,
    };
    assert_eq!(segments, [first, second]);
    assert_eq!(first.deviation.lsb(), 1.0);
}

#[test]
fn the_contour_error_is_measured_in_true_lengths() {
    // A count is 0.1 mm in X and 0.2 mm in Y: (40, 15) counts are (4, 3) mm.
    let cycle = Cycle {
        from: [0, 0],
        to: [40, 15],
        master: 0,
        scans: 0..1,
        end: [40, 15],
    };
    let scale = [10.0, 5.0];
    // 1 mm to the left of the middle: (2, 1.5) + (−0.6, 0.8) mm.
    let left = [14.0, 11.5];
    assert!((cycle.contour_error(left, scale) - 1.0).abs() < 1e-12);
    let (foot, error) = cycle.foot([26.0, 3.5], scale);
    assert!((error + 1.0).abs() < 1e-12, "to the right is negative");
    assert!((foot[0] - 2.0).abs() < 1e-12 && (foot[1] - 1.5).abs() < 1e-12);
    let played = Played {
        records: vec![record(1, [40, 15], left)],
        cycles: vec![cycle],
        ..Played::default()
    };
    assert!((played.segments(scale)[0].contour_um - 1000.0).abs() < 1e-9);
}

#[test]
fn deviations_are_held_against_their_rule_exactly() {
    let within = |numerator, rule| {
        Deviation {
            numerator,
            denominator: 7,
        }
        .is_within(rule)
    };
    for rule in [Rule::Floor, Rule::Truncating] {
        assert!(within(0, rule) && within(6, rule) && !within(7, rule) && !within(8, rule));
    }
    assert!(within(3, Rule::Centred) && !within(4, Rule::Centred));
    let half = Deviation {
        numerator: 4,
        denominator: 8,
    };
    assert!(half.is_within(Rule::Centred));
    // Where floating point sees no difference any more.
    let denominator = 1u128 << 60;
    let below = Deviation {
        numerator: denominator - 1,
        denominator,
    };
    assert!(below.is_within(Rule::Floor) && below.lsb() == 1.0);
}

#[test]
fn broken_records_are_measured_without_panic() {
    let mut played = two_strokes();
    played.cycles[1].scans = 9..12;
    played.cycles.push(Cycle {
        from: [3, 3],
        to: [3, 3],
        master: 0,
        scans: 40..50,
        end: [3, 3],
    });
    let segments = played.segments([1.0; 2]);
    assert_eq!(segments[1].scans, 0);
    assert_eq!(segments[2].deviation.lsb(), 0.0);
    assert!(played.records_of(17).is_empty());
}
