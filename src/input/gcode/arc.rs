//! The centre of an arc, and whether its end is on its circle.

use crate::input::ZERO_MM;

/// How far the radius at the end may be off that at the start, in millimetres.
const OFF_MM: f64 = 0.005;

/// The same as a part of the radius; the larger of the two counts.
const OFF_RATIO: f64 = 0.001;

fn tolerance(radius: f64) -> f64 {
    OFF_MM.max(OFF_RATIO * radius)
}

/// The centre of an arc of the given radius: the minor arc for a positive one, the major arc for
/// a negative one. A radius short of half the chord by no more than the tolerance gives the
/// half circle over the chord.
///
/// # Errors
///
/// What is wrong with the radius.
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
    if size + tolerance(size) < half {
        let chord = 2.0 * half;
        return Err(format!(
            "a radius of {size:.4} mm does not span {chord:.4} mm"
        ));
    }
    let height = ((size - half) * (size + half)).max(0.0).sqrt();
    // Seen along the chord, a clockwise minor arc has its centre on the right.
    let right = if clockwise == (radius > 0.0) {
        height
    } else {
        -height
    };
    let scale = right / (2.0 * half);
    Ok([x + dx / 2.0 + dy * scale, y + dy / 2.0 - dx * scale])
}

/// Checks the centre of an arc against both its ends.
///
/// # Errors
///
/// The two radii, where they differ by more than the tolerance or are zero.
pub(super) fn check(start: [f64; 2], end: [f64; 2], centre: [f64; 2]) -> Result<(), String> {
    let radius = |point| {
        let [(_, dx), (_, dy)] = chord(centre, point);
        dx.hypot(dy)
    };
    let (first, last) = (radius(start), radius(end));
    // Without a radius at an end there is no angle to start or stop at.
    if first.min(last) < ZERO_MM {
        return Err("a radius of zero".to_owned());
    }
    if (first - last).abs() > tolerance(first) {
        return Err(format!(
            "the radius is {first:.4} mm at the start and {last:.4} mm at the end"
        ));
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
    fn the_tolerance_grows_with_the_radius() {
        let check = |r: f64, off: f64| check([r, 0.0], [0.0, r + off], [0.0, 0.0]).is_ok();
        assert!(check(1.0, 0.0049) && !check(1.0, 0.0051));
        assert!(check(1.0, -0.0049) && !check(1.0, -0.0051));
        assert!(check(100.0, 0.099) && !check(100.0, 0.101));
        assert!(!check(0.0, 0.004) && !check(0.004, -0.004));
    }
}
