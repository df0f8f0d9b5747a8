//! The words and memories of simulation against oracles that know nothing of them: `i128`
//! arithmetic for words, vectors for memories.

mod edges;
mod memories;
mod signed;
mod unsigned;

use motion_rtl::logic::Bit;
use motion_rtl::logic::sim::Wire;

/// `value` modulo 2^`width`, from 0 up.
fn wrap(value: i128, width: usize) -> u64 {
    value.rem_euclid(1 << width) as u64
}

/// `value` modulo 2^`width`, half of the range below 0.
fn wrap_signed(value: i128, width: usize) -> i64 {
    let value = value.rem_euclid(1 << width);
    let value = if value >= 1 << (width - 1) {
        value - (1 << width)
    } else {
        value
    };
    value as i64
}

/// Calls `$check::<N>` for widths 1 to 6.
macro_rules! small_widths {
    ($check:ident) => {
        $check::<1>();
        $check::<2>();
        $check::<3>();
        $check::<4>();
        $check::<5>();
        $check::<6>();
    };
}
use small_widths;

#[test]
fn wires() {
    for a in [false, true] {
        let wire = Wire::from(a);
        assert_eq!(wire.get(), a);
        assert_eq!((!wire).get(), !a);
        assert_eq!(wire.word().get(), u64::from(a));
        for b in [false, true] {
            let other = Wire::from(b);
            assert_eq!((wire & other).get(), a && b);
            assert_eq!((wire | other).get(), a || b);
            assert_eq!((wire ^ other).get(), a != b);
            for choose in [false, true] {
                let chosen = Wire::from(choose).mux(wire, other);
                assert_eq!(chosen.get(), if choose { a } else { b });
            }
        }
    }
}
