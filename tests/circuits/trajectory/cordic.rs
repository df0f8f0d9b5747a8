//! CORDIC against sine and cosine, and vectors that it turns.

use motion_rtl::circuits::blocks::Cordic;
use motion_rtl::circuits::blocks::cordic::In;
use motion_rtl::circuits::blocks::cordic_state::GAIN;
use motion_rtl::sim::Simulator;
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// CORDIC of radii and angles of so many bits.
fn cordic(radius: usize, angle: usize) -> Simulator<Cordic> {
    LastTicks::simulator(&Cordic { radius, angle }).unwrap()
}

/// A vector turned by an angle; nothing before its tick.
fn turned(cordic: &Simulator<Cordic>, [radius, offset]: [i64; 2], angle: u64) -> [i64; 2] {
    let latency = cordic.circuit().angle as u64 + 1;
    let mut simulator = cordic.clone();
    for ticks in 1..=latency {
        let i = In {
            start: ticks == 1 || ticks == 3,
            halt: false,
            radius: if ticks == 1 { radius } else { 1 },
            offset: if ticks == 1 { offset } else { 2 },
            angle: if ticks == 1 { angle } else { 0 },
        };
        simulator.step_with(&i, |_| ()).unwrap();
        let done = simulator.see(|s| s.p.turning.q.done);
        assert_eq!(done, ticks == latency, "after {ticks} ticks");
    }
    let along = simulator.see(|s| s.p.turning.q.along);
    [along, simulator.see(|s| s.p.turning.q.across)]
}

/// Distance of the point at an angle from sine and cosine.
fn error(cordic: &Simulator<Cordic>, radius: i64, angle: u64) -> f64 {
    let [along, across] = turned(cordic, [radius, 0], angle);
    let turn = angle as f64 / (cordic.circuit().angle as f64).exp2() * TAU;
    let exact = radius as f64 * GAIN;
    (along as f64 - exact * turn.cos()).hypot(across as f64 - exact * turn.sin())
}

/// Each of H iterations rounds both coordinates down, and each rounded angle of the table may be off
/// by half a unit; what is left of the angle is two units at most.
fn bound(iterations: usize, angle_bits: usize, radius: i64) -> f64 {
    let unit = TAU / (angle_bits as f64).exp2() * radius as f64 * GAIN;
    iterations as f64 * 2f64.sqrt() * GAIN + unit * (iterations as f64 / 2.0 + 2.0)
}

#[test]
fn every_angle_of_a_small_circle() {
    let cordic = cordic(14, 10);
    for radius in [0, 1, 100, 1000, 4000] {
        for angle in 0..1 << 10 {
            let seen = error(&cordic, radius, angle);
            let bound = bound(10, 10, radius);
            assert!(
                seen <= bound,
                "{seen} at {angle}, radius {radius}, not {bound}"
            );
        }
    }
}

/// Vectors in all quarters, by all angles.
#[test]
fn every_angle_of_vectors_all_around() {
    let cordic = cordic(14, 10);
    for vector in [
        [3000, 900],
        [-20, 3100],
        [-2500, -1500],
        [1, -3000],
        [2100, -2100],
    ] {
        let [x, y] = vector.map(|part| part as f64 * GAIN);
        let bound = bound(10, 10, x.hypot(y).ceil() as i64);
        for angle in 0..1 << 10 {
            let (sine, cosine) = (angle as f64 / 1024.0 * TAU).sin_cos();
            let [along, across] = turned(&cordic, vector, angle);
            let off =
                (along as f64 - x * cosine + y * sine).hypot(across as f64 - x * sine - y * cosine);
            assert!(off <= bound, "{vector:?} at {angle}: {off}");
        }
    }
}

proptest! {
    #[test]
    fn angles_and_radii_of_full_width(radius in 0..1i64 << 45, angle in 0..1u64 << 44) {
        let seen = error(&cordic(48, 44), radius, angle);
        // Doubles hold the exact point to 2^-53 of the radius.
        let bound = bound(44, 44, radius);
        prop_assert!(seen <= bound, "{} instead of {}", seen, bound);
    }
}
