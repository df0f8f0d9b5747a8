//! Filling of areas with parallel lines (FT, FP).

use super::curve::sin_cos_deg;

/// Fill of an area (FT).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) enum Fill {
    /// Lines at a distance of the pen's width, in alternating directions.
    #[default]
    Solid,
    /// Lines at a distance of the pen's width, all in one direction.
    OneWay,
    /// Parallel lines.
    Hatched(Hatching),
    /// Parallel lines, and others across them.
    CrossHatched(Hatching),
    /// Shading and patterns, which a pen cannot draw: number of the type.
    Pattern(u32),
}

/// Parallel lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hatching {
    /// Distance in user units along X; `None` is 1 % of the distance of P1 and P2.
    pub(super) spacing: Option<f64>,
    /// Angle anticlockwise from X, in degrees.
    pub(super) angle_deg: f64,
}

/// Definition of the inside of polygons that cross themselves or others (FP).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Inside {
    /// Points from which a way out crosses an odd number of edges.
    EvenOdd,
    /// Points around which the edges wind.
    Winding,
}

/// Positions of a fill's lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Lines {
    /// Through the anchor, and at multiples of a distance from it.
    Anchored { anchor: [f64; 2], spacing: f64 },
    /// Evenly spaced over the area, half a distance from its ends, at most `most` apart.
    Even { most: f64 },
}

type Line = [[f64; 2]; 2];

struct Edge {
    low: [f64; 2],
    high: [f64; 2],
    /// 1 upwards, −1 downwards.
    way: i32,
}

impl Edge {
    /// Returns the position of the edge at a height between its ends.
    fn at(&self, height: f64) -> f64 {
        let ([x1, y1], [x2, y2]) = (self.low, self.high);
        x1 + (height - y1) * (x2 - x1) / (y2 - y1)
    }
}

/// Returns the lines that fill closed polygons, each given by its corners, in order; with
/// `to_and_fro` every second one is reversed. Returns `None` if there are more than `most`.
pub(super) fn lines(
    polygons: &[Vec<[f64; 2]>],
    lines: Lines,
    angle_deg: f64,
    inside: Inside,
    to_and_fro: bool,
    most: usize,
) -> Option<Vec<Line>> {
    // Rotated so that the lines are level.
    let [sin, cos] = sin_cos_deg(angle_deg);
    let level = |[x, y]: [f64; 2]| [x * cos + y * sin, y * cos - x * sin];
    let back = |[x, y]: [f64; 2]| [x * cos - y * sin, y * cos + x * sin];
    let mut edges = edges(polygons, level);
    let lowest = edges.iter().map(|edge| edge.low[1]).reduce(f64::min);
    let highest = edges.iter().map(|edge| edge.high[1]).reduce(f64::max);
    let (Some(lowest), Some(highest)) = (lowest, highest) else {
        return Some(Vec::new());
    };
    let (first, step, count) = match lines {
        Lines::Anchored { anchor, spacing } => {
            let [_, base] = level(anchor);
            let from = ((lowest - base) / spacing).ceil();
            let to = ((highest - base) / spacing).floor();
            (base + from * spacing, spacing, to - from + 1.0)
        }
        Lines::Even { most } => {
            let count = ((highest - lowest) / most - 1e-9).ceil().max(1.0);
            let step = (highest - lowest) / count;
            (lowest + step / 2.0, step, count)
        }
    };
    if count > most as f64 {
        return None;
    }
    edges.sort_by(|a, b| a.low[1].total_cmp(&b.low[1]));
    let mut waiting = edges.into_iter().peekable();
    let mut crossed: Vec<Edge> = Vec::new();
    let mut filled = Vec::new();
    let mut crossings: Vec<(f64, i32)> = Vec::new();
    let mut left = most.saturating_mul(4);
    for k in 0..count.max(0.0) as u64 {
        let height = first + k as f64 * step;
        while let Some(edge) = waiting.next_if(|edge| edge.low[1] <= height) {
            crossed.push(edge);
        }
        crossed.retain(|edge| edge.high[1] > height);
        // Bounds the work also if many edges give few lines.
        left = left.checked_sub(crossed.len())?;
        crossings.clear();
        crossings.extend(crossed.iter().map(|edge| (edge.at(height), edge.way)));
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let start = filled.len();
        let (mut number, mut around) = (0i32, 0i32);
        for pair in crossings.windows(2) {
            let [(x1, way), (x2, _)] = [pair[0], pair[1]];
            number += 1;
            around += way;
            let is_inside = match inside {
                Inside::EvenOdd => number % 2 == 1,
                Inside::Winding => around != 0,
            };
            if is_inside && x1 < x2 {
                filled.push([back([x1, height]), back([x2, height])]);
            }
        }
        if to_and_fro && k % 2 == 1 {
            let line = filled.get_mut(start..).unwrap_or_default();
            line.reverse();
            line.iter_mut().for_each(|part| part.reverse());
        }
        if filled.len() > most {
            return None;
        }
    }
    Some(filled)
}

/// Returns the edges that are not level.
fn edges(polygons: &[Vec<[f64; 2]>], level: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<Edge> {
    let mut edges = Vec::new();
    for polygon in polygons {
        let mut from = polygon.last().copied().map(&level);
        for to in polygon.iter().copied().map(&level) {
            let Some(start) = from.replace(to) else {
                continue;
            };
            let (low, high, way) = if start[1] < to[1] {
                (start, to, 1)
            } else {
                (to, start, -1)
            };
            if low[1] < high[1] {
                edges.push(Edge { low, high, way });
            }
        }
    }
    edges
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn square(x: f64, y: f64, size: f64) -> Vec<[f64; 2]> {
        vec![[x, y], [x + size, y], [x + size, y + size], [x, y + size]]
    }

    fn anchored(spacing: f64) -> Lines {
        Lines::Anchored {
            anchor: [0.0; 2],
            spacing,
        }
    }

    fn fill(polygons: &[Vec<[f64; 2]>], how: Lines, angle: f64, inside: Inside) -> Vec<Line> {
        lines(polygons, how, angle, inside, true, 1000).unwrap()
    }

    #[test]
    fn a_square_is_filled_to_and_fro() {
        let filled = fill(
            &[square(1.0, 1.0, 4.0)],
            anchored(2.0),
            0.0,
            Inside::EvenOdd,
        );
        assert_eq!(filled, [[[1.0, 2.0], [5.0, 2.0]], [[5.0, 4.0], [1.0, 4.0]]]);
        let even = Lines::Even { most: 1.5 };
        let filled = fill(&[square(0.0, 0.0, 3.0)], even, 0.0, Inside::EvenOdd);
        let heights: Vec<f64> = filled.iter().map(|line| line[0][1]).collect();
        assert_eq!(heights, [0.75, 2.25]);
        // Narrower than the pen: still one line.
        let filled = fill(&[square(0.0, 0.0, 1.0)], even, 0.0, Inside::EvenOdd);
        assert_eq!(filled, [[[0.0, 0.5], [1.0, 0.5]]]);
        let polygons = [square(1.0, 1.0, 4.0)];
        let one_way = lines(&polygons, anchored(2.0), 0.0, Inside::EvenOdd, false, 1000);
        assert_eq!(
            one_way.unwrap(),
            [[[1.0, 2.0], [5.0, 2.0]], [[1.0, 4.0], [5.0, 4.0]]]
        );
        let upright = fill(
            &[square(1.0, 1.0, 4.0)],
            anchored(3.0),
            90.0,
            Inside::EvenOdd,
        );
        assert_eq!(upright.len(), 1);
        let [[x1, y1], [x2, y2]] = upright[0];
        assert!((x1 - 3.0).abs() < 1e-9 && (x2 - 3.0).abs() < 1e-9);
        assert!((y1.min(y2) - 1.0).abs() < 1e-9 && (y1.max(y2) - 5.0).abs() < 1e-9);
    }

    #[test]
    fn holes_are_left_out_by_count_and_filled_by_winding() {
        let nested = [square(0.0, 0.0, 9.0), square(3.0, 3.0, 3.0)];
        let how = Lines::Anchored {
            anchor: [0.0, 4.5],
            spacing: 90.0,
        };
        let odd = fill(&nested, how, 0.0, Inside::EvenOdd);
        assert_eq!(odd, [[[0.0, 4.5], [3.0, 4.5]], [[6.0, 4.5], [9.0, 4.5]]]);
        let length = |filled: &[Line]| -> f64 {
            let length = |[[x1, _], [x2, _]]: &Line| (x2 - x1).abs();
            filled.iter().map(length).sum()
        };
        assert_eq!(length(&fill(&nested, how, 0.0, Inside::Winding)), 9.0);
        let mut against = nested.clone();
        against[1].reverse();
        assert_eq!(length(&fill(&against, how, 0.0, Inside::Winding)), 6.0);
    }

    #[test]
    fn too_many_lines_are_none() {
        let polygons = [square(0.0, 0.0, 100.0)];
        let count = |most| {
            let filled = lines(&polygons, anchored(1.0), 0.0, Inside::EvenOdd, true, most);
            filled.map(|filled| filled.len())
        };
        assert_eq!(count(101), Some(100));
        assert_eq!(count(99), None);
        let none = lines(&[], anchored(1.0), 0.0, Inside::EvenOdd, true, 9);
        assert_eq!(none, Some(Vec::new()));
    }

    proptest! {
        /// Lines that are close enough cover the area of a triangle, and no more.
        #[test]
        fn the_lines_cover_the_area(
            corners in proptest::array::uniform6(-100.0..100.0f64),
            angle in -180.0..180.0f64,
        ) {
            let [a, b, c, d, e, f] = corners;
            let area = ((c - a) * (f - b) - (e - a) * (d - b)).abs() / 2.0;
            prop_assume!(area > 500.0);
            let triangle = vec![[a, b], [c, d], [e, f]];
            let filled = lines(&[triangle], anchored(0.1), angle, Inside::EvenOdd, true, 9999);
            let length: f64 = filled
                .unwrap()
                .iter()
                .map(|[[x1, y1], [x2, y2]]| (x2 - x1).hypot(y2 - y1))
                .sum();
            prop_assert!((length * 0.1 - area).abs() < 0.02 * area + 30.0 * 0.1, "{length} {area}");
        }
    }
}
