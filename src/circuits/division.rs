//! Division as a network, for properties: no circuit divides in a tick.

use crate::hdl::U;

/// Returns quotient and rest of two words of the same width. Of a divisor of 0 all bits of the
/// quotient are high, and the rest is the dividend.
pub(super) fn divided(dividend: U, divisor: U) -> (U, U) {
    let width = dividend.width();
    let wide = divisor.resize(width + 1);
    let mut rest = U::new(0, width);
    let mut quotient: Option<U> = None;
    for bit in (0..width).rev() {
        let partial = rest.join(dividend.bit(bit).word());
        let fits = !partial.below(wide);
        rest = fits.mux(partial - wide, partial).resize(width);
        quotient = Some(match quotient {
            Some(above) => above.join(fits.word()),
            None => fits.word(),
        });
    }
    (quotient.unwrap_or(rest), rest)
}
