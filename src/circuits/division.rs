//! Division as a network, for properties: no circuit divides in a tick.

use crate::hdl::U;

/// Returns quotient and rest of two words of the same width. Of a divisor of 0 all bits of the
/// quotient are high, and the rest is the dividend.
pub(super) fn divided(dividend: U, divisor: U) -> (U, U) {
    let width = dividend.width();
    let mut rest = U::new(0, width);
    let mut quotient: Option<U> = None;
    for bit in (0..width).rev() {
        // The bit above decides too; of the difference it is none.
        let above = rest.bit(width - 1);
        let partial = rest.shift_left(1) | dividend.bit(bit).word().resize(width);
        let fits = above | !partial.below(divisor);
        rest = fits.mux(partial - divisor, partial);
        quotient = Some(match quotient {
            Some(high) => high.join(fits.word()),
            None => fits.word(),
        });
    }
    (quotient.unwrap_or(rest), rest)
}
