//! Position control against arithmetic with fractions, at every input of a small width and at
//! random ones of the full width.

use super::{In, LoopWidths, PositionControl};
use crate::prelude::*;
use crate::trace::LastTicks;
use proptest::prelude::*;

/// Registers that a scan loads, and the nets of that tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Out {
    deviation: i64,
    in_position: bool,
    speed_ref: i64,
    saturated: bool,
}

fn control(widths: LoopWidths) -> Simulator<PositionControl> {
    LastTicks::simulator(&PositionControl { widths }).unwrap()
}

/// Runs a scan; its result does not depend on earlier ones.
fn scanned(
    control: &mut Simulator<PositionControl>,
    command: i64,
    feedback: i64,
    gain: u64,
    window: u64,
) -> Out {
    let i = In {
        scan: true,
        command,
        feedback,
        gain,
        window,
    };
    let (deviation, in_position) = control
        .step_with(&i, |now| (now.w.deviation, now.w.in_position))
        .unwrap();
    let q = control.registers().q;
    Out {
        deviation,
        in_position,
        speed_ref: q.speed_ref,
        saturated: q.saturated,
    }
}

/// Returns the result by its definition: the quotient by division, halves from its remainder.
fn expected(widths: LoopWidths, command: i64, feedback: i64, gain: u64, window: u64) -> Out {
    let (f, half_turn) = (widths.fraction, 1i128 << (widths.position - 1));
    let way = i128::from(command) - i128::from(feedback);
    let deviation = (way + half_turn).rem_euclid(2 * half_turn) - half_turn;
    let product = deviation * i128::from(gain);
    let (whole, rest) = (product / (1 << f), product % (1 << f));
    let rounded = whole
        + if 2 * rest.abs() >= 1 << f {
            product.signum()
        } else {
            0
        };
    let limit = (1i128 << (widths.converter - 1)) - 1;
    let reference = rounded.clamp(-limit, limit);
    Out {
        deviation: deviation as i64,
        in_position: deviation.abs() <= i128::from(window),
        speed_ref: reference as i64,
        saturated: reference.abs() == limit,
    }
}

/// Every command, feedback and gain of four bits.
fn sweep(fraction: usize, converter: usize) {
    let widths = LoopWidths {
        position: 4,
        gain: 4,
        fraction,
        converter,
    };
    let mut control = control(widths);
    for (command, feedback) in (-8..8).flat_map(|c| (-8..8).map(move |f| (c, f))) {
        for gain in 0..16 {
            for window in [0, 1, 7, 8, 15] {
                let out = scanned(&mut control, command, feedback, gain, window);
                let right = expected(widths, command, feedback, gain, window);
                assert_eq!(
                    out, right,
                    "{command} {feedback} {gain} {window}, {widths:?}"
                );
                let other = scanned(&mut control, feedback, command, gain, window);
                if out.deviation != -8 {
                    assert_eq!(
                        other.speed_ref, -out.speed_ref,
                        "{command} {feedback} {gain}"
                    );
                }
            }
        }
    }
}

#[test]
fn every_product_of_four_bits_is_rounded_and_limited() {
    for (fraction, converter) in [(0, 4), (1, 8), (2, 4), (3, 5), (4, 2), (4, 4)] {
        sweep(fraction, converter);
    }
}

#[test]
fn known_references() {
    let mut control = control(LoopWidths::FULL);
    // 3/4 of a count per LSB, in 1/256: 192.
    for (deviation, reference) in [(1, 1), (2, 2), (-2, -2), (3, 2), (4, 3), (100_000, 32_767)] {
        let out = scanned(&mut control, deviation, 0, 192, 0);
        assert_eq!(out.speed_ref, reference, "{deviation}");
    }
    // Half an LSB goes away from zero, a little less to zero.
    for (gain, reference) in [(127, 0), (128, 1), (129, 1), (383, 1), (384, 2)] {
        let forth = scanned(&mut control, 1, 0, gain, 0).speed_ref;
        let back = scanned(&mut control, 0, 1, gain, 0).speed_ref;
        assert_eq!((forth, back), (reference, -reference));
    }
    // The greatest amount there is, by the greatest gain.
    let most = scanned(&mut control, i32::MIN.into(), 0, 65_535, 0);
    assert_eq!((most.speed_ref, most.saturated), (-32_767, true));
}

#[test]
fn it_is_proved() {
    let widths = LoopWidths {
        position: 3,
        gain: 3,
        fraction: 1,
        converter: 3,
    };
    let circuit = PositionControl { widths };
    let all = circuit.invariants();
    let outcome = reach(&circuit, &all).run().expect("narrow enough");
    assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
}

proptest! {
    #[test]
    fn a_wide_one_does_the_same(
        command: i32, near in -3000..3000i64, far: i32, is_near: bool, gain: u16, window in 0..3000u64
    ) {
        let command = i64::from(command);
        let feedback = if is_near { command.wrapping_sub(near) as i32 } else { far };
        let feedback = i64::from(feedback);
        let (gain, widths) = (u64::from(gain), LoopWidths::FULL);
        let mut simulator = control(widths);
        let out = scanned(&mut simulator, command, feedback, gain, window);
        assert_eq!(out, expected(widths, command, feedback, gain, window));
    }
}
