//! Position control against arithmetic with fractions, at every input of a small width and at
//! random ones of the full width.

use super::{In, PositionControl};
use crate::check::{Outcome, Specified, reach};
use crate::kernel::Simulator;
use crate::logic::Sim;
use proptest::prelude::*;

/// What a scan loads, and the nets of that tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Out {
    deviation: i64,
    in_position: bool,
    speed_ref: i64,
    saturated: bool,
}

fn scanned<const P: usize, const G: usize, const F: usize, const D: usize, const R: usize>(
    command: i64,
    feedback: i64,
    gain: u64,
    window: u64,
) -> Out {
    let control = PositionControl::<P, G, F, D, R>;
    let i: In<Sim, P, G> = In {
        scan: true.into(),
        command: command.into(),
        feedback: feedback.into(),
        gain: gain.into(),
        window: window.into(),
    };
    let nets = |now: &crate::kernel::Sample<'_, _>| -> (i64, bool) {
        let w: &super::Net<Sim, P, D, R> = now.w;
        (w.deviation.get(), w.in_position.get())
    };
    let (after, (deviation, in_position)) =
        Simulator::<PositionControl<P, G, F, D, R>>::new(&control)
            .unwrap()
            .step(i, nets);
    Out {
        deviation,
        in_position,
        speed_ref: after.registers().speed_ref.get(),
        saturated: after.registers().saturated.get(),
    }
}

/// The same from the definition: the quotient by division, halves told from its remainder.
fn expected([p, f, d]: [u32; 3], command: i64, feedback: i64, gain: u64, window: u64) -> Out {
    let half_turn = 1i128 << (p - 1);
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
    let limit = (1i128 << (d - 1)) - 1;
    let reference = rounded.clamp(-limit, limit);
    Out {
        deviation: deviation as i64,
        in_position: deviation.abs() <= i128::from(window),
        speed_ref: reference as i64,
        saturated: reference.abs() == limit,
    }
}

/// Every command, feedback and gain of four bits.
fn sweep<const F: usize, const D: usize>() {
    for (command, feedback) in (-8..8).flat_map(|c| (-8..8).map(move |f| (c, f))) {
        for gain in 0..16 {
            for window in [0, 1, 7, 8, 15] {
                let out = scanned::<4, 4, F, D, 8>(command, feedback, gain, window);
                let right = expected([4, F as u32, D as u32], command, feedback, gain, window);
                assert_eq!(
                    out, right,
                    "{command} {feedback} {gain} {window}, F {F}, D {D}"
                );
                let other = scanned::<4, 4, F, D, 8>(feedback, command, gain, window);
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
    sweep::<0, 4>();
    sweep::<1, 8>();
    sweep::<2, 4>();
    sweep::<3, 5>();
    sweep::<4, 2>();
    sweep::<4, 4>();
}

#[test]
fn known_references() {
    // 3/4 of a count per LSB, in 1/256: 192.
    for (deviation, reference) in [(1, 1), (2, 2), (-2, -2), (3, 2), (4, 3), (100_000, 32_767)] {
        let out = scanned::<32, 16, 8, 16, 48>(deviation, 0, 192, 0);
        assert_eq!(out.speed_ref, reference, "{deviation}");
    }
    // Half an LSB goes away from zero, a little less to zero.
    for (gain, reference) in [(127, 0), (128, 1), (129, 1), (383, 1), (384, 2)] {
        assert_eq!(
            scanned::<32, 16, 8, 16, 48>(1, 0, gain, 0).speed_ref,
            reference
        );
        assert_eq!(
            scanned::<32, 16, 8, 16, 48>(0, 1, gain, 0).speed_ref,
            -reference
        );
    }
    // The greatest amount there is, by the greatest gain.
    let most = scanned::<32, 16, 8, 16, 48>(i32::MIN.into(), 0, 65_535, 0);
    assert_eq!((most.speed_ref, most.saturated), (-32_767, true));
}

#[test]
fn it_is_proved() {
    let circuit = PositionControl::<3, 3, 1, 3, 6>;
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
        let (gain, shape) = (u64::from(gain), [32, 8, 16]);
        let out = scanned::<32, 16, 8, 16, 48>(command, feedback, gain, window);
        prop_assert_eq!(out, expected(shape, command, feedback, gain, window));
    }
}
