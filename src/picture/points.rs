/// Number of points above which a curve is thinned to the extremes of intervals.
const MOST: usize = 40_000;
/// Greatest number of points that an interval keeps, besides its interruptions, and of these.
const EXTREMES: usize = 6;
const GAPS: usize = 4;

/// Points of a curve, thinned while they are collected. With more than 40,000, every interval
/// keeps its first and last point, the extremes to each side, and its four widest interruptions,
/// which looks the same.
///
/// ```
/// use motion_rtl::picture::{Curve, Points};
///
/// let mut points = Points::expecting(1_000_000);
/// (0..1_000_000).for_each(|k| points.push((f64::from(k), f64::from(k % 7))));
/// let curve = Curve::thinned("of seven", points);
/// ```
#[derive(Debug, Clone)]
pub struct Points {
    interval: usize,
    kept: Vec<(f64, f64)>,
    /// Points of the current interval.
    latest: Vec<(f64, f64)>,
}

impl Points {
    /// Creates an empty list for about `count` points.
    pub fn expecting(count: usize) -> Self {
        Points {
            interval: match count <= MOST {
                true => 1,
                false => (EXTREMES * count).div_ceil(MOST),
            },
            kept: Vec::new(),
            latest: Vec::new(),
        }
    }

    /// Adds a point; a point that is not finite interrupts the curve.
    pub fn push(&mut self, point: (f64, f64)) {
        if self.interval == 1 {
            self.kept.push(point);
            return;
        }
        self.latest.push(point);
        if self.latest.len() == self.interval {
            self.thin();
        }
    }

    /// Returns the points that are kept.
    pub(super) fn kept(mut self) -> Vec<(f64, f64)> {
        self.thin();
        self.kept
    }

    fn thin(&mut self) {
        let latest = &self.latest;
        let is_finite = |k: &usize| latest[*k].0.is_finite() && latest[*k].1.is_finite();
        let finite = || (0..latest.len()).filter(is_finite);
        let by = |key: fn(&(f64, f64)) -> f64| {
            let order = move |a: &usize, b: &usize| key(&latest[*a]).total_cmp(&key(&latest[*b]));
            [finite().min_by(order), finite().max_by(order)]
        };
        let ends = [latest.first().map(|_| 0), latest.len().checked_sub(1)];
        let extremes = [ends, by(|point| point.0), by(|point| point.1)];
        let mut keep: Vec<usize> = extremes.into_iter().flatten().flatten().collect();

        let mut gaps: Vec<usize> = (0..latest.len()).filter(|k| !is_finite(k)).collect();
        if gaps.len() > GAPS {
            let width = |&gap: &usize| match (gap.checked_sub(1), latest.get(gap + 1)) {
                (Some(before), Some(after)) => {
                    let before = latest[before];
                    (after.0 - before.0).hypot(after.1 - before.1)
                }
                // The width is unknown at an end of the interval.
                _ => f64::INFINITY,
            };
            gaps.sort_by(|a, b| width(b).total_cmp(&width(a)));
            gaps.truncate(GAPS);
        }
        for gap in gaps {
            let around = gap.saturating_sub(1)..=gap + 1;
            keep.extend(around.filter(|k| *k < latest.len()));
        }
        keep.sort_unstable();
        keep.dedup();
        self.kept.extend(keep.into_iter().map(|k| latest[k]));
        self.latest.clear();
    }
}

impl Extend<(f64, f64)> for Points {
    fn extend<I: IntoIterator<Item = (f64, f64)>>(&mut self, points: I) {
        points.into_iter().for_each(|point| self.push(point));
    }
}

impl From<Vec<(f64, f64)>> for Points {
    fn from(points: Vec<(f64, f64)>) -> Self {
        let mut thinned = Points::expecting(points.len());
        match thinned.interval {
            1 => thinned.kept = points,
            _ => points.into_iter().for_each(|point| thinned.push(point)),
        }
        thinned
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_ends_peaks_and_gaps() {
        let mut points: Vec<_> = (0..400_000).map(|k| (f64::from(k), 0.0)).collect();
        points[123_456].1 = 9.0;
        points[200_001].1 = -9.0;
        points[250_003].0 = -5.0;
        points[260_003].0 = 1e6;
        points[300_007].1 = f64::NAN;
        points[123_457].1 = f64::NAN;
        let thinned = Points::from(points.clone()).kept();
        assert!(thinned.len() <= MOST + 6);
        for kept in [0, 123_456, 200_001, 250_003, 260_003, 399_999] {
            assert!(thinned.contains(&points[kept]), "point {kept} is lost");
        }
        assert_eq!(thinned.iter().filter(|point| point.1.is_nan()).count(), 2);
        let order = thinned
            .iter()
            .filter(|point| ![-5.0, 1e6].contains(&point.0));
        assert!(order.is_sorted_by(|a, b| a.0 < b.0));
    }

    /// Strokes between gaps; one gap of many is wide.
    #[test]
    fn of_many_gaps_the_widest_are_kept() {
        let gap = (f64::NAN, f64::NAN);
        let stroke = |k: u32| {
            let from = f64::from(k) + if k >= 77_777 { 1e6 } else { 0.0 };
            [(from, 0.0), (from + 1.0, 0.0), gap]
        };
        let kept = Points::from((0..100_000).flat_map(stroke).collect::<Vec<_>>()).kept();
        assert!(kept.len() < 3 * MOST, "{}", kept.len());
        let jump = kept.iter().position(|point| point.0 == 77_777.0).unwrap();
        assert!(kept[jump + 1].0.is_nan());
        assert_eq!(kept[jump + 2].0, 77_777.0 + 1e6);
    }

    #[test]
    fn few_points_stay_as_they_are() {
        let points: Vec<_> = (0..MOST).map(|k| (k as f64, (k % 7) as f64)).collect();
        assert!(Points::from(points.clone()).kept() == points);
    }
}
