//! Where user units land on the paper.

/// Plotter units in a millimetre.
pub(super) const UNITS_PER_MM: f64 = 40.0;

/// P1 and P2 of an HP 7475A loaded with A4 paper, in plotter units.
pub(super) const DEFAULT_CORNERS: Corners = Corners {
    p1: [250.0, 279.0],
    p2: [10_250.0, 7_479.0],
};

/// The scaling points, in plotter units (IP).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corners {
    pub(super) p1: [f64; 2],
    pub(super) p2: [f64; 2],
}

/// What the user calls P1 and P2, in user units (SC).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
    /// For equal units on both axes: how much of the room left over goes before the window, 0 to
    /// 1, on each axis. Without it the window fills the whole area from P1 to P2.
    pub(super) isotropic: Option<[f64; 2]>,
}

/// One axis of the mapping: `user` lands at `plotter`, and `den` user units span `num` plotter
/// units. A fraction rather than a factor: the ends of a window then land on P1 and P2 exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Axis {
    user: f64,
    plotter: f64,
    num: f64,
    den: f64,
}

impl Axis {
    const UNSCALED: Self = Self {
        user: 0.0,
        plotter: 0.0,
        num: 1.0,
        den: 1.0,
    };

    fn spanning(user: [f64; 2], from: f64, to: f64) -> Self {
        let [first, last] = user;
        Self {
            user: first,
            plotter: from,
            num: to - from,
            den: last - first,
        }
    }

    /// Plotter units per user unit, without the sign.
    fn size(&self) -> f64 {
        (self.num / self.den).abs()
    }

    /// Takes over the size of the `other` axis, which is the smaller, and leaves the given part
    /// of the room this frees before the window.
    fn shrink_to(&mut self, other: &Self, before: f64) {
        let room = self.num;
        let mirrored = (self.num < 0.0) != (self.den < 0.0);
        let sign = if mirrored { -1.0 } else { 1.0 };
        let width = self.den * other.num.abs() / other.den.abs() * sign;
        self.plotter += (room - width) * before;
        self.num = width;
    }

    fn to_plotter(self, user: f64) -> f64 {
        self.plotter + (user - self.user) * self.num / self.den
    }

    fn to_user(self, plotter: f64) -> f64 {
        self.user + (plotter - self.plotter) * self.den / self.num
    }
}

/// User units to millimetres and back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    x: Axis,
    y: Axis,
}

impl Scale {
    /// Both pairs of corners must differ on both axes. Without a window, user units are plotter
    /// units.
    pub(super) fn new(corners: Corners, window: Option<Window>) -> Self {
        let Some(window) = window else {
            return Self {
                x: Axis::UNSCALED,
                y: Axis::UNSCALED,
            };
        };
        let ([x1, y1], [x2, y2]) = (corners.p1, corners.p2);
        let mut x = Axis::spanning(window.x, x1, x2);
        let mut y = Axis::spanning(window.y, y1, y2);
        if let Some([left, bottom]) = window.isotropic {
            if x.size() > y.size() {
                x.shrink_to(&y, left);
            } else {
                y.shrink_to(&x, bottom);
            }
        }
        Self { x, y }
    }

    pub(super) fn to_mm(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.to_plotter(x), self.y.to_plotter(y)].map(|units| units / UNITS_PER_MM)
    }

    pub(super) fn to_user(self, mm: [f64; 2]) -> [f64; 2] {
        let [x, y] = mm.map(|mm| mm * UNITS_PER_MM);
        [self.x.to_user(x), self.y.to_user(y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: Corners = Corners {
        p1: [400.0, 800.0],
        p2: [4_400.0, 2_800.0],
    };

    fn scale(x: [f64; 2], y: [f64; 2], isotropic: Option<[f64; 2]>) -> Scale {
        Scale::new(CORNERS, Some(Window { x, y, isotropic }))
    }

    #[test]
    fn without_a_window_forty_units_are_a_millimetre() {
        let scale = Scale::new(CORNERS, None);
        assert_eq!(scale.to_mm([40.0, -20.0]), [1.0, -0.5]);
        assert_eq!(scale.to_user([1.0, -0.5]), [40.0, -20.0]);
    }

    #[test]
    fn the_window_lands_on_the_corners() {
        let scale = scale([0.0, 7.0], [-3.0, 10.0], None);
        assert_eq!(scale.to_mm([0.0, -3.0]), [10.0, 20.0]);
        assert_eq!(scale.to_mm([7.0, 10.0]), [110.0, 70.0]);
        assert_eq!(scale.to_user([60.0, 45.0]), [3.5, 3.5]);
    }

    #[test]
    fn a_mirrored_window_turns_the_axis() {
        let scale = scale([10.0, 0.0], [0.0, 10.0], None);
        assert_eq!(scale.to_mm([10.0, 0.0]), [10.0, 20.0]);
        assert_eq!(scale.to_mm([9.0, 1.0]), [20.0, 25.0]);
    }

    #[test]
    fn isotropic_units_are_square_and_placed() {
        // The area is 100 x 50 mm, the window 10 x 10: 5 mm a unit, 50 mm left over in X.
        let unit = ([0.0, 10.0], [0.0, 10.0]);
        for (left, x0) in [(0.0, 10.0), (0.5, 35.0), (1.0, 60.0)] {
            let scale = scale(unit.0, unit.1, Some([left, 0.25]));
            assert_eq!(scale.to_mm([0.0, 0.0]), [x0, 20.0]);
            assert_eq!(scale.to_mm([10.0, 10.0]), [x0 + 50.0, 70.0]);
        }
        // 40 x 10: 2.5 mm a unit, 25 mm left over in Y.
        let scale = scale([0.0, 40.0], [0.0, 10.0], Some([0.25, 1.0]));
        assert_eq!(scale.to_mm([0.0, 0.0]), [10.0, 45.0]);
        assert_eq!(scale.to_mm([40.0, 10.0]), [110.0, 70.0]);
    }

    #[test]
    fn isotropic_and_mirrored() {
        let scale = scale([10.0, 0.0], [0.0, 10.0], Some([0.0, 0.0]));
        assert_eq!(scale.to_mm([10.0, 0.0]), [10.0, 20.0]);
        assert_eq!(scale.to_mm([0.0, 10.0]), [60.0, 70.0]);
    }
}
