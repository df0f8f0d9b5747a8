//! Prediction: exact on the ring, and how far off where the speed is a fraction or changes.

use motion_rtl::circuits::lead_angle::codes;
use motion_rtl::circuits::lead_angle::{
    Division, Lead, LeadPlacement, Memory, Placement, TimeLead, lead, placement, time_lead,
};
use motion_rtl::hdl::{Cut, Value};
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;
use std::collections::HashSet;

const PLACEMENTS: [Placement; 3] = [Placement::Position, Placement::Target, Placement::Halves];

/// The number of `bits` bits that a number wraps to.
fn wrap(number: i64, bits: u32) -> i64 {
    let range = 1i64 << bits;
    let rest = number.rem_euclid(range);
    if rest < range / 2 { rest } else { rest - range }
}

/// All positions, ways, ratios and targets of 8 bits: the prediction is that of numbers without
/// bounds, wherever the ring wraps, and all three placements see the same difference.
#[test]
#[ignore = "takes long"]
fn the_prediction_is_exact_on_the_ring_and_the_placements_agree() {
    let circuits = PLACEMENTS.map(|placement| LeadPlacement {
        position: 8,
        placement,
    });
    let mut placed = circuits.map(|circuit| LastTicks::simulator(&circuit).unwrap());
    let w = &placed[0].signals().w;
    let compared = [w.compared_position, w.compared_target];
    let mut lead = LastTicks::simulator(&Lead {
        position: 8,
        one: false,
    })
    .unwrap();
    let mut placed_leads = HashSet::new();
    for position in -128..128 {
        for way in -127..=127 {
            for ratio in [0, 1, 2, 5, 10] {
                let i = lead::In {
                    present: position,
                    old: wrap(position - way, 8),
                    ratio: ratio as u64,
                };
                let lead = lead.step_with(&i, |now| now.w.lead).unwrap();
                let predicted = position + ratio * way;
                assert_eq!(lead, wrap(ratio * way, 8));
                // Several distances give the same lead.
                if !placed_leads.insert((position, lead)) {
                    continue;
                }
                for target in -128..128 {
                    let i = placement::In {
                        position,
                        target,
                        lead,
                    };
                    let away = wrap(predicted - target, 8);
                    for simulator in &mut placed {
                        simulator.apply(&i).unwrap();
                        let [to, from] = compared.map(|at| simulator.get(at));
                        let placement = simulator.circuit().placement;
                        assert_eq!(wrap(to - from, 8), away, "{placement:?}");
                    }
                }
                placed[0].set(|i| i.target, 0).unwrap();
                assert_eq!(placed[0].get(compared[0]), wrap(predicted, 8));
            }
        }
    }
}

/// Prediction of the circuit for `time` CKs ahead from the positions of `count` CKs, the last of
/// them 0, when all are in its history; a CK every tick.
fn predicted(time: u64, count: i64, position: impl Fn(i64) -> i64) -> i64 {
    let circuit = TimeLead::new(199, 24, Memory::ShiftRegister);
    predicted_by(&circuit, time, count, position)
}

/// Prediction of another circuit, for the same positions.
fn predicted_by(circuit: &TimeLead, time: u64, count: i64, position: impl Fn(i64) -> i64) -> i64 {
    predictions(circuit, time, [count, 1], position)[0]
}

/// Predictions at the last CKs of so many, CK 0 the last.
fn predictions(
    circuit: &TimeLead,
    time: u64,
    [count, last]: [i64; 2],
    position: impl Fn(i64) -> i64,
) -> Vec<i64> {
    let mut simulator = LastTicks::simulator(circuit).unwrap();
    let mut i: time_lead::In<Value> = time_lead::In {
        ck: true,
        restart: false,
        position: 0,
        lead_time: time,
    };
    let width = simulator.signals().i.position.width();
    let mut seen = Vec::new();
    for ck in 1 - count..=0 {
        i.position = position(ck).cut(width);
        i.ck = true;
        simulator.step_with(&i, |_| ()).unwrap();
        if ck <= -last {
            continue;
        }
        i.ck = false;
        let [present, lead] = simulator
            .step_with(&i, |now| {
                assert!(now.w.enough && now.w.fresh);
                [now.w.present, now.w.lead]
            })
            .unwrap();
        seen.push(wrap(present + lead, 24));
    }
    seen
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Speeds in 1/65536 of a count per CK, either way, at any phase and across the wrap.
    #[test]
    fn at_constant_speed_the_error_is_within_the_bound(
        code in 0usize..519,
        speed in -2000i64 << 16..2000 << 16,
        phase in -1i64 << 39..1 << 39,
    ) {
        let code = codes::grid(199)[code];
        let at = |ck: i64| speed * ck + phase;
        let predicted = predicted(code.time, 202, |ck| at(ck) >> 16);
        // In 1/65536 of a count; the short way round.
        let error = wrap((predicted << 16) - at(code.time as i64), 40);
        let ratio = code.ratio as i64;
        prop_assert!(error > -(ratio + 1) << 16 && error < ratio << 16, "{code:?}: {error}");
    }

    /// Accelerations in 1/65536 of a count per CK².
    #[test]
    fn at_constant_acceleration_the_error_follows_its_formula(
        code in 0usize..519,
        acceleration in -40i64 << 10..40 << 10,
        speed in -500i64 << 16..500 << 16,
    ) {
        let code = codes::grid(199)[code];
        let at = |ck: i64| (speed * ck + acceleration * ck * ck / 2) as f64 / 65_536.0;
        let predicted = predicted(code.time, 202, |ck| at(ck).floor() as i64);
        let error = predicted as f64 - at(code.time as i64);
        let (time, ratio) = (code.time as f64, code.ratio as f64);
        let a = acceleration as f64 / 65_536.0;
        let formula = -(a * time * time / 2.0) * (1.0 + 1.0 / ratio);
        let range = f64::from(1 << 24);
        let off = (error - formula + range / 2.0).rem_euclid(range) - range / 2.0;
        prop_assert!(off > -(ratio + 1.1) && off < ratio + 0.1, "{code:?}: {error}, {formula}");
    }
}

/// The bound is no larger than it has to be.
#[test]
#[ignore = "takes long"]
fn the_bound_is_reached() {
    for (ratio, time) in [(1, 199), (2, 398), (5, 995), (10, 1990)] {
        let (mut least, mut most) = (0, 0);
        for speed in 1..400i64 {
            for phase in [0, 1, 65_535] {
                let at = |ck: i64| speed * 164 * ck + phase;
                let predicted = predicted(time, 202, |ck| at(ck) >> 16);
                let error = (predicted << 16) - at(time as i64);
                (least, most) = (least.min(error), most.max(error));
            }
        }
        let share = |error: i64| error as f64 / 65_536.0;
        assert!(share(most) > f64::from(ratio) * 0.97, "{ratio}: {most}");
        let bound = -f64::from(ratio + 1);
        assert!(share(least) < bound * 0.97, "{ratio}: {least}");
    }
}

/// Purpose of N: without it, with ten times the memory, the prediction uses older samples.
#[test]
fn a_long_memory_with_n_fixed_at_one_is_further_off_in_acceleration() {
    let long = TimeLead {
        division: Division::One,
        ..TimeLead::new(1990, 24, Memory::Ram)
    };
    // 40,000 counts/s² at a CK of 0.1 ms.
    let at = |ck: i64| ck * ck / 5_000;
    let short = TimeLead::new(199, 24, Memory::ShiftRegister);
    // The root of the mean square over a hundred CKs in a row, in which N has all its phases.
    let rms = |circuit: &TimeLead, time: u64| {
        let seen = predictions(circuit, time, [2_100, 100], at);
        let errors = seen.iter().zip(-99..).map(|(predicted, ck)| {
            let error = predicted - at(ck + time as i64);
            (error * error) as f64
        });
        (errors.sum::<f64>() / 100.0).sqrt()
    };
    // Values of the note.
    for (time, n, noted) in [
        (199, 1, [15.6, 15.6]),
        (398, 2, [47.2, 63.1]),
        (995, 5, [236.9, 395.8]),
        (1990, 10, [870.0, 1583.8]),
    ] {
        for ((circuit, n), noted) in [(&short, n), (&long, 1)].into_iter().zip(noted) {
            // (aΔt²/2)(1 + 1/N), and what counts cut off.
            let wanted = (time * time) as f64 / 5_000.0 * (1.0 + 1.0 / f64::from(n));
            let found = rms(circuit, time);
            println!("{time} CKs, N = {n}: {found:.1} counts, {wanted:.1} in theory");
            let right = (found - wanted).abs() < 1.5 && (found - noted).abs() < 0.06;
            assert!(right, "{time}, {n}: {found}, not {wanted}, {noted}");
        }
    }
}
