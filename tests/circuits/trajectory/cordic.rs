//! CORDIC against sine and cosine.

use motion_rtl::kernel::Simulator;
use motion_rtl::trajectory_controller::Cordic;
use motion_rtl::trajectory_controller::cordic::In;
use motion_rtl::trajectory_controller::cordic_state::GAIN;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// The point at an angle; nothing before its tick.
fn point<const R: usize, const H: usize>(radius: i64, angle: u64) -> [i64; 2] {
    let circuit = Cordic::<R, H>::default();
    let mut simulator = Simulator::new(&circuit).unwrap();
    for ticks in 1..=H as u64 + 1 {
        let i = In {
            start: (ticks == 1 || ticks == 3).into(),
            radius: if ticks == 1 { radius } else { 1 }.into(),
            angle: if ticks == 1 { angle } else { 0 }.into(),
        };
        simulator = simulator.step(i, |_| ()).0;
        let done = simulator.registers().turning.done.get();
        assert_eq!(done, ticks == H as u64 + 1, "after {ticks} ticks");
    }
    let q = &simulator.registers().turning;
    [q.along.get(), q.across.get()]
}

/// How far the point is from that of sine and cosine.
fn error<const R: usize, const H: usize>(radius: i64, angle: u64) -> f64 {
    let [along, across] = point::<R, H>(radius, angle);
    let turn = angle as f64 / (H as f64).exp2() * TAU;
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
    for radius in [0, 1, 100, 1000, 4000] {
        for angle in 0..1 << 10 {
            let seen = error::<14, 10>(radius, angle);
            let bound = bound(10, 10, radius);
            assert!(
                seen <= bound,
                "{seen} at {angle}, radius {radius}, not {bound}"
            );
        }
    }
}

proptest! {
    #[test]
    fn angles_and_radii_of_full_width(radius in 0..1i64 << 45, angle in 0..1u64 << 44) {
        let seen = error::<48, 44>(radius, angle);
        // Doubles hold the exact point to 2^-53 of the radius.
        let bound = bound(44, 44, radius);
        prop_assert!(seen <= bound, "{} instead of {}", seen, bound);
    }
}
