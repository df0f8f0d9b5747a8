//! Mapping of user units to the paper.

/// Plotter units per millimetre.
pub(super) const UNITS_PER_MM: f64 = 40.0;

/// Hard-clip limits of an HP 7475A loaded with paper of size A (8.5 by 11 inches), in plotter
/// units from the origin.
pub(super) const DEFAULT_PAGE: [f64; 2] = [10_365.0, 7_962.0];

/// P1 and P2 of an HP 7475A with that paper, in plotter units.
pub(super) const DEFAULT_CORNERS: Corners = Corners {
    p1: [250.0, 279.0],
    p2: [10_250.0, 7_479.0],
};

/// Scaling points in plotter units (IP).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corners {
    pub(super) p1: [f64; 2],
    pub(super) p2: [f64; 2],
}

impl Corners {
    /// Returns the vector from P1 to P2 in plotter units.
    pub(super) fn span(&self) -> [f64; 2] {
        let ([x1, y1], [x2, y2]) = (self.p1, self.p2);
        [x2 - x1, y2 - y1]
    }

    /// Returns the distance of P1 and P2 in plotter units.
    pub(super) fn diagonal(&self) -> f64 {
        let [x, y] = self.span();
        x.hypot(y)
    }
}

/// User coordinates of P1 and P2 (SC).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Window {
    /// User coordinates of both.
    Ranges {
        x: [f64; 2],
        y: [f64; 2],
        /// For equal units on both axes: share of the remaining space before the window, 0 to 1,
        /// on each axis. `None` fills the whole area from P1 to P2.
        isotropic: Option<[f64; 2]>,
    },
    /// User coordinates of P1, and plotter units per user unit.
    Factors { p1: [f64; 2], factors: [f64; 2] },
}

/// One axis of the mapping: `user` maps to `plotter`, and `den` user units span `num` plotter
/// units. A fraction rather than a factor: the ends of a window then map to P1 and P2 exactly.
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

    fn stretched(user: f64, plotter: f64, factor: f64) -> Self {
        Self {
            user,
            plotter,
            num: factor,
            den: 1.0,
        }
    }

    fn spanning(user: [f64; 2], from: f64, to: f64) -> Self {
        let [first, last] = user;
        Self {
            user: first,
            plotter: from,
            num: to - from,
            den: last - first,
        }
    }

    /// Returns plotter units per user unit, without the sign.
    fn size(&self) -> f64 {
        (self.num / self.den).abs()
    }

    /// Takes over the smaller size of the `other` axis, and leaves the given share of the freed
    /// space before the window.
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

/// Conversion between user and plotter units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    x: Axis,
    y: Axis,
}

impl Scale {
    /// Creates a scale. Both pairs of corners must differ on both axes. Without a window, user
    /// units are plotter units.
    pub(super) fn new(corners: Corners, window: Option<Window>) -> Self {
        let ([x1, y1], [x2, y2]) = (corners.p1, corners.p2);
        match window {
            None => Self {
                x: Axis::UNSCALED,
                y: Axis::UNSCALED,
            },
            Some(Window::Factors { p1, factors }) => {
                let ([user_x, user_y], [x, y]) = (p1, factors);
                Self {
                    x: Axis::stretched(user_x, x1, x),
                    y: Axis::stretched(user_y, y1, y),
                }
            }
            Some(Window::Ranges { x, y, isotropic }) => {
                let mut x = Axis::spanning(x, x1, x2);
                let mut y = Axis::spanning(y, y1, y2);
                if let Some([left, bottom]) = isotropic {
                    if x.size() > y.size() {
                        x.shrink_to(&y, left);
                    } else {
                        y.shrink_to(&x, bottom);
                    }
                }
                Self { x, y }
            }
        }
    }

    /// Converts user units to plotter units.
    pub(super) fn to_plotter(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.to_plotter(x), self.y.to_plotter(y)]
    }

    /// Converts plotter units to user units.
    pub(super) fn to_user(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.to_user(x), self.y.to_user(y)]
    }

    /// Returns plotter units per user unit along X.
    pub(super) fn unit_x(&self) -> f64 {
        self.x.size()
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
        Scale::new(CORNERS, Some(Window::Ranges { x, y, isotropic }))
    }

    #[test]
    fn without_a_window_user_units_are_plotter_units() {
        let scale = Scale::new(CORNERS, None);
        assert_eq!(scale.to_plotter([40.0, -20.0]), [40.0, -20.0]);
        assert_eq!(scale.to_user([1.0, -0.5]), [1.0, -0.5]);
        assert_eq!(scale.unit_x(), 1.0);
    }

    #[test]
    fn factors_are_plotter_units_a_unit() {
        let window = Window::Factors {
            p1: [1.0, -2.0],
            factors: [10.0, -4.0],
        };
        let scale = Scale::new(CORNERS, Some(window));
        assert_eq!(scale.to_plotter([1.0, -2.0]), [400.0, 800.0]);
        assert_eq!(scale.to_plotter([3.0, 3.0]), [420.0, 780.0]);
        assert_eq!(scale.to_user([420.0, 780.0]), [3.0, 3.0]);
        assert_eq!(scale.unit_x(), 10.0);
    }

    #[test]
    fn the_window_lands_on_the_corners() {
        let scale = scale([0.0, 7.0], [-3.0, 10.0], None);
        assert_eq!(scale.to_plotter([0.0, -3.0]), [400.0, 800.0]);
        assert_eq!(scale.to_plotter([7.0, 10.0]), [4_400.0, 2_800.0]);
        assert_eq!(scale.to_user([2_400.0, 1_800.0]), [3.5, 3.5]);
    }

    #[test]
    fn a_mirrored_window_turns_the_axis() {
        let scale = scale([10.0, 0.0], [0.0, 10.0], None);
        assert_eq!(scale.to_plotter([10.0, 0.0]), [400.0, 800.0]);
        assert_eq!(scale.to_plotter([9.0, 1.0]), [800.0, 1_000.0]);
    }

    #[test]
    fn isotropic_units_are_square_and_placed() {
        // Area 4000 x 2000, window 10 x 10: 200 per unit, 2000 remaining in X.
        let unit = ([0.0, 10.0], [0.0, 10.0]);
        for (left, x0) in [(0.0, 400.0), (0.5, 1_400.0), (1.0, 2_400.0)] {
            let scale = scale(unit.0, unit.1, Some([left, 0.25]));
            assert_eq!(scale.to_plotter([0.0, 0.0]), [x0, 800.0]);
            assert_eq!(scale.to_plotter([10.0, 10.0]), [x0 + 2_000.0, 2_800.0]);
        }
        // 40 x 10: 100 per unit, 1000 remaining in Y.
        let scale = scale([0.0, 40.0], [0.0, 10.0], Some([0.25, 1.0]));
        assert_eq!(scale.to_plotter([0.0, 0.0]), [400.0, 1_800.0]);
        assert_eq!(scale.to_plotter([40.0, 10.0]), [4_400.0, 2_800.0]);
    }

    #[test]
    fn isotropic_and_mirrored() {
        let scale = scale([10.0, 0.0], [0.0, 10.0], Some([0.0, 0.0]));
        assert_eq!(scale.to_plotter([10.0, 0.0]), [400.0, 800.0]);
        assert_eq!(scale.to_plotter([0.0, 10.0]), [2_400.0, 2_800.0]);
    }
}
