//! Rounding of a limit to six digits for a message, so that the value shown is allowed.

/// Rounds down to six digits.
pub(crate) fn round_down(value: f64) -> f64 {
    six_digits(value, f64::floor)
}

/// Rounds up to six digits; ignores excess from floating-point rounding.
pub(crate) fn round_up(value: f64) -> f64 {
    six_digits(value, |units| (units * (1.0 - 1e-12)).ceil())
}

fn six_digits(value: f64, whole: impl Fn(f64) -> f64) -> f64 {
    if value <= 0.0 || !value.is_finite() {
        return value;
    }
    let unit = 10f64.powi(value.log10().floor() as i32 - 5);
    let rounded = whole(value / unit) * unit;
    // Nearest short decimal.
    format!("{rounded:.12e}").parse().unwrap_or(rounded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_on_the_right_side() {
        assert_eq!(round_down(84.852_813), 84.8528);
        assert_eq!(round_up(84.852_813), 84.8529);
        assert_eq!(round_up(60.000_000_000_000_01), 60.0);
        assert_eq!(round_up(0.1 + 0.2), 0.3);
        assert_eq!(round_down(1_234_567.0), 1_234_560.0);
        assert_eq!(round_up(1_234_561.0), 1_234_570.0);
        assert_eq!((round_down(0.0), round_up(0.0)), (0.0, 0.0));
    }
}
