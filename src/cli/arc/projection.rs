//! Isometric view.

use motion_rtl::input::Point;

/// x to the lower right, y to the upper right, z up, all at one scale.
pub fn projected([x, y, z]: Point) -> (f64, f64) {
    let (sin, cos) = (0.5, 0.75f64.sqrt());
    ((x + y) * cos, z + (y - x) * sin)
}
