//! The correction against plain arithmetic, and what learning comes to.

use motion_rtl::circuits::lead_angle::codes;
use motion_rtl::circuits::lead_angle::correction::In;
use motion_rtl::circuits::lead_angle::{Correction, Sign};
use motion_rtl::hdl::Simulator;

/// What came of a correction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Seen {
    /// Ticks from `complete` to `corrected`.
    ticks: u64,
    /// Δt2, where one is learned.
    learned: Option<u64>,
}

/// One positioning: control signal at −`overrun`, standstill at 0, target at −`error`.
fn correct(
    ready: &Simulator<Correction>,
    [time, seed]: [u64; 2],
    [overrun, error]: [i64; 2],
) -> Seen {
    let input = |fire: bool, complete: bool, position: i64| In {
        fire,
        complete,
        position,
        target: -error,
        lead_time: time,
        learn: true,
        missed: false,
        seed,
    };
    let mut simulator = ready.clone();
    simulator.step_with(&input(true, false, -overrun), |_| ());
    simulator.step_with(&input(false, true, 0), |_| ());
    for ticks in 1..=2 * ready.circuit().latency() {
        let (corrected, learned, time) = simulator.step_with(&input(false, false, 0), |now| {
            (now.w.corrected, now.w.learned, now.w.learned_time)
        });
        assert!(corrected || !learned);
        if corrected {
            let learned = learned.then_some(time);
            return Seen { ticks, learned };
        }
    }
    panic!("never corrected");
}

/// The code that a time is put on.
fn snapped(stages: u64, time: u64) -> u64 {
    let grid = codes::grid(stages);
    let above = grid.iter().find(|code| code.time >= time);
    let below = grid.iter().rev().find(|code| code.time <= time);
    match (below, above) {
        (Some(below), Some(above)) if below.ratio == above.ratio => {
            match 2 * time < below.time + above.time {
                true => below.time,
                false => above.time,
            }
        }
        (Some(below), _) => below.time,
        (None, above) => above.map_or(0, |code| code.time),
    }
}

/// Δt1 + Δt1·d2/d1 to the nearest, an error by `sign`, within the codes.
fn expected(stages: u64, time: u64, overrun: i64, error: i64, sign: i64) -> u64 {
    let (time, overrun, error) = (
        i128::from(time),
        i128::from(overrun),
        i128::from(error * sign),
    );
    let amount = (2 * time * error.abs() + overrun.abs()) / (2 * overrun.abs());
    let change = amount * error.signum() * overrun.signum();
    let sum = (time + change).clamp(1, 10 * i128::from(stages));
    snapped(stages, sum as u64)
}

/// The correction with so many stages and positions of so many bits, ready to run.
fn ready(stages: usize, position: usize, sign: Sign) -> Simulator<Correction> {
    let circuit = Correction {
        stages,
        position,
        sign,
    };
    Simulator::new(&circuit).unwrap()
}

fn every_correction(stages: u64, position: usize) {
    let half = 1i64 << (position - 1);
    let codes = codes::grid(stages);
    let on_grid = |time: u64| codes.iter().any(|code| code.time == time);
    for sign in [Sign::Converging, Sign::Literal] {
        let ready = ready(stages as usize, position, sign);
        let factor = if sign == Sign::Converging { 1 } else { -1 };
        for time in std::iter::once(0).chain(codes.iter().map(|code| code.time)) {
            for overrun in -half..half {
                for error in -half..half {
                    // The greatest amount has no opposite.
                    if -overrun == half || -error == half {
                        continue;
                    }
                    let seen = correct(&ready, [time, 2], [overrun, error]);
                    let (learned, ticks) = match (time, overrun) {
                        (0, _) => ((error != 0).then_some(2), 1),
                        (_, 0) => (None, 1),
                        _ => {
                            let time = expected(stages, time, overrun, error, factor);
                            (Some(time), ready.circuit().latency())
                        }
                    };
                    let right = Seen { ticks, learned };
                    assert_eq!(seen, right, "{time}, {overrun}, {error}, {sign:?}");
                    assert!(learned.is_none_or(on_grid));
                }
            }
        }
    }
}

#[test]
fn every_correction_of_four_bits_is_right_and_on_the_grid() {
    every_correction(3, 4);
}

#[test]
fn every_correction_of_six_bits_is_right_and_on_the_grid() {
    every_correction(7, 6);
}

/// The correction at full width.
fn full(sign: Sign) -> Simulator<Correction> {
    ready(199, 24, sign)
}

/// The next time of a body that stops `true_time` CKs after the control signal, at `speed` counts
/// per CK, where the control signal is right but for the lead time.
fn next(ready: &Simulator<Correction>, time: u64, true_time: u64, speed: i64) -> u64 {
    let (overrun, lead) = (speed * true_time as i64, speed * time as i64);
    let seen = correct(ready, [time, 1], [overrun, overrun - lead]);
    seen.learned.expect("a time")
}

/// How many CKs apart two codes are at a time.
fn pitch(time: u64) -> f64 {
    codes::grid(199)
        .iter()
        .find(|code| code.time >= time)
        .map_or(10.0, |code| code.ratio as f64)
}

#[test]
fn with_the_right_sign_the_error_is_squared_every_time_and_with_the_literal_one_the_ratio() {
    let (right, literal) = (full(Sign::Converging), full(Sign::Literal));
    for true_time in [30u64, 150, 350, 900] {
        for share in [0.3, 0.6, 0.9, 1.1, 1.5] {
            for speed in [-40, 3, 1000] {
                let time = snapped(199, (true_time as f64 * share) as u64);
                let r = time as f64 / true_time as f64;
                let near = |time: u64, wanted: f64| {
                    let wanted = (wanted * true_time as f64).clamp(1.0, 1990.0);
                    let off = (time as f64 - wanted).abs();
                    assert!(
                        off <= pitch(time),
                        "{time} where {wanted} is wanted, r = {r}"
                    );
                };
                near(
                    next(&right, time, true_time, speed),
                    1.0 - (1.0 - r) * (1.0 - r),
                );
                near(next(&literal, time, true_time, speed), r * r);
            }
        }
    }
}

/// From a third of the true time to nearly twice of it, within six positionings.
#[test]
fn six_positionings_are_enough_and_the_literal_sign_runs_away() {
    let (right, literal) = (full(Sign::Converging), full(Sign::Literal));
    for true_time in [20u64, 57, 150, 333, 700, 1500] {
        for start in [true_time / 3, true_time / 2, true_time * 9 / 5] {
            let (mut time, mut lost) = (snapped(199, start), snapped(199, start));
            for _ in 0..6 {
                time = next(&right, time, true_time, 25);
                lost = next(&literal, lost, true_time, 25);
            }
            let off = time.abs_diff(true_time) as f64;
            assert!(off <= pitch(true_time), "{start}: {time} for {true_time}");
            // Towards nothing, or to the end of the codes.
            let most = 1990.0f64.min(true_time as f64 * 8.0);
            let away = lost <= true_time / 20 + 1 || lost as f64 >= most;
            assert!(away, "{start}: {lost} for {true_time}");
        }
    }
}
