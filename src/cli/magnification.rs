//! Magnification of the errors in drawings.

/// The largest error is drawn as large as this part of the drawing.
const PART: f64 = 0.0625;

/// By what errors are multiplied, for `largest` to become a visible part of a drawing of `size`:
/// 1, 2 or 5 times a power of ten, and 1 where that is too much already.
pub fn magnification(largest: f64, size: f64) -> f64 {
    let wanted = PART * size / largest;
    if !(wanted.is_finite() && wanted > 1.0) {
        return 1.0;
    }
    let decade = 10f64.powf(wanted.log10().floor());
    let steps = [10.0, 5.0, 2.0, 1.0].map(|step| step * decade);
    steps
        .into_iter()
        .find(|step| *step <= wanted)
        .unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_error_becomes_a_round_multiple_that_is_visible() {
        // A sixteenth of 32 mm is 2 mm.
        for (largest, factor) in [
            (2.0, 1.0),
            (50.0, 1.0),
            (1.0, 2.0),
            (0.5, 2.0),
            (0.4, 5.0),
            (0.2, 10.0),
            (0.0021, 500.0),
            (0.0019, 1000.0),
        ] {
            assert_eq!(magnification(largest, 32.0), factor, "{largest}");
        }
        assert_eq!(magnification(0.0, 100.0), 1.0);
        assert_eq!(magnification(0.0, 0.0), 1.0);
    }
}
