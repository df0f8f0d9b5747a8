//! Centre of an arc, and the check that its end is on its circle.

use crate::input::ZERO_MM;

/// Greatest amount by which a radius (R) may be less than half the chord, in millimetres.
const SHORT_MM: f64 = 0.005;

/// Greatest amount by which it may be less, as a part of the radius; the larger of the two limits
/// counts.
const SHORT_RATIO: f64 = 0.001;

/// Greatest difference of the radii at both ends, as a part of the larger one.
const OFF_RATIO: f64 = 0.001;

/// Greatest multiple of the absolute tolerance that the ratio allows.
const MOST_OFFS: f64 = 100.0;

/// Smallest radius at either end, in millimetres.
const SMALLEST_MM: f64 = 0.000_05 * 25.4;

/// Returns the absolute tolerance of the radii at both ends of an arc, in millimetres: the error
/// of ends and centre when both are rounded to 0.01 mm, or under G20 to 0.001 inch.
pub(super) fn off_mm(mm_per_unit: f64) -> f64 {
    let digit = if mm_per_unit == 1.0 { 0.01 } else { 0.001 };
    2.0 * digit * std::f64::consts::SQRT_2 * mm_per_unit
}

/// Returns the centre of an arc of the given radius: the minor arc for a positive radius, the
/// major arc for a negative one. A radius that is less than half the chord within the tolerance
/// gives the half circle over the chord.
///
/// # Errors
///
/// Returns a message about the radius.
pub(super) fn centre_by_radius(
    start: [f64; 2],
    end: [f64; 2],
    radius: f64,
    clockwise: bool,
) -> Result<[f64; 2], String> {
    let [(x, dx), (y, dy)] = chord(start, end);
    let half = dx.hypot(dy) / 2.0;
    if half * 2.0 < ZERO_MM {
        return Err("an arc by its radius that ends where it starts".to_owned());
    }
    let size = radius.abs();
    if size + SHORT_MM.max(SHORT_RATIO * size) < half {
        let chord = 2.0 * half;
        return Err(format!(
            "a radius of {size:.4} mm does not span {chord:.4} mm"
        ));
    }
    let height = ((size - half) * (size + half)).max(0.0).sqrt();
    // Along the chord, a clockwise minor arc has its centre on the right.
    let right = if clockwise == (radius > 0.0) {
        height
    } else {
        -height
    };
    let scale = right / (2.0 * half);
    Ok([x + dx / 2.0 + dy * scale, y + dy / 2.0 - dx * scale])
}

/// Checks the centre of an arc against both its ends, as LinuxCNC does: the radii may differ by
/// `off_mm`, or by 0.1 %, up to 100 times `off_mm`.
///
/// # Errors
///
/// Returns a message about the radii, and the allowed values.
pub(super) fn check(
    start: [f64; 2],
    end: [f64; 2],
    centre: [f64; 2],
    off_mm: f64,
) -> Result<(), (String, String)> {
    let radius = |point| {
        let [(_, dx), (_, dy)] = chord(centre, point);
        dx.hypot(dy)
    };
    let (first, last) = (radius(start), radius(end));
    let most = MOST_OFFS * off_mm;
    let allowed = || format!("radii that agree to {off_mm:.4} mm, or to 0.1 % and {most:.2} mm");
    // Without a radius at an end there is no start or end angle.
    if first.min(last) < SMALLEST_MM {
        return Err(("a radius of zero".to_owned(), allowed()));
    }
    let off = (first - last).abs();
    if off > most || (off > off_mm && off > OFF_RATIO * first.max(last)) {
        let problem =
            format!("the radius is {first:.4} mm at the start and {last:.4} mm at the end");
        return Err((problem, allowed()));
    }
    Ok(())
}

fn chord([x, y]: [f64; 2], [to_x, to_y]: [f64; 2]) -> [(f64, f64); 2] {
    [(x, to_x - x), (y, to_y - y)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_and_the_sense_choose_the_centre() {
        let (start, end) = ([0.0, 0.0], [6.0, 0.0]);
        for (radius, clockwise, y) in [
            (5.0, true, -4.0),
            (5.0, false, 4.0),
            (-5.0, true, 4.0),
            (-5.0, false, -4.0),
        ] {
            let centre = centre_by_radius(start, end, radius, clockwise);
            assert_eq!(centre, Ok([3.0, y]), "R{radius}, clockwise {clockwise}");
        }
    }

    #[test]
    fn a_radius_a_little_short_gives_the_half_circle() {
        let by_radius = |r| centre_by_radius([1.0, 0.0], [1.0, 10.0], r, true);
        assert_eq!(by_radius(4.9951), Ok([1.0, 5.0]));
        assert_eq!(
            by_radius(4.99),
            Err("a radius of 4.9900 mm does not span 10.0000 mm".to_owned())
        );
    }

    #[test]
    fn the_tolerance_is_that_of_the_digits_written_or_a_part_of_the_radius() {
        let check = |r: f64, off: f64, unit: f64| {
            check([r, 0.0], [0.0, r + off], [0.0, 0.0], off_mm(unit)).is_ok()
        };
        // 2 · 0.01 · √2 mm and 2 · 0.001 · √2 inches.
        for (off, unit) in [(0.02828, 1.0), (-0.02828, 1.0), (0.0718, 25.4)] {
            assert!(check(1.0, off, unit) && !check(1.0, off * 1.002, unit));
        }
        // 0.1 % of the larger radius.
        assert!(check(100.0, 0.1, 1.0) && !check(100.0, 0.1002, 1.0));
        assert!(check(100.0, -0.1, 1.0) && !check(100.0, -0.1001, 1.0));
        // At most 100 times the tolerance.
        assert!(check(9000.0, 2.828, 1.0) && !check(9000.0, 2.829, 1.0));
        assert!(check(9000.0, 7.18, 25.4) && !check(9000.0, 7.19, 25.4));
        assert!(check(0.0013, 0.0, 1.0) && !check(0.0012, 0.01, 1.0));
        assert!(!check(0.02, -0.0188, 1.0) && !check(0.0, 0.02, 1.0));
    }
}
