//! Length clamp: limits a length to the path.
//!
//! ```text
//!             ┌──────────────┐
//!  length ───▶│ length_clamp ├──▶ clamped
//!  path_end ─▶│              │
//!             └──────────────┘
//! ```
//!
//! Departure: the text does not say what happens where the tangential response overshoots the end
//! of the path, as it does with K2 < 4·K1. There is no path beyond the end, so the reference point
//! stays at the end. The command's length is clamped too, whatever the profile says. With `back`, a
//! distance is subtracted from the length before it is clamped, which gives a point behind another
//! one.

use crate::prelude::*;

/// Clamp of lengths.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LengthClamp {
    /// Width of a length in bits.
    pub width: usize,
    /// Amount subtracted from the length.
    pub back: u64,
}

signals! { for LengthClamp as c;
    /// Input ports.
    pub struct In {
        /// Length along the path.
        pub length: I(c.width),
        /// L: length of the path; not negative.
        pub path_end: I(c.width),
    }
    /// Nets.
    pub struct Net {
        /// Length minus `back`.
        less: I(c.width + usize::from(c.back > 0)),
        /// `less` is beyond the end.
        beyond: Bit,
        /// `less`, limited to 0 … `path_end`.
        pub clamped: U(c.width),
    }
}

impl Circuit for LengthClamp {
    const NAME: &'static str = "length_clamp";
    const ABOUT: &'static str = "limits a length to the path";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let less = match self.back {
            0 => i.length,
            back => i.length.minus(I::new(back as i64, self.width)),
        };
        let beyond = i.path_end.below_any(less);
        let on = beyond.mux(i.path_end, less.resize(self.width));
        let clamped = less.is_negative().mux(0, on.unsigned());
        let net = Net {
            less,
            beyond,
            clamped,
        };
        (net, Nothing)
    }

    fn objection(&self) -> Option<String> {
        let narrow = self.back >> (self.width - 1) > 0;
        narrow.then(|| format!("{} is no length of {} bits", self.back, self.width))
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (end, clamped) = (now.i.path_end, now.w.clamped);
        let less = match self.back {
            0 => now.i.length,
            back => now.i.length.minus(I::new(back as i64, self.width)),
        };
        let inside = clamped.equals(less.resize(self.width).unsigned());
        let before = clamped.is_zero();
        let beyond = clamped.equals(end.unsigned());
        let on_path = end.below_any(less).mux(beyond, inside);
        vec![Property::always(
            "the result is length minus back, limited to the path",
            &["clamped"],
            end.is_negative() | less.is_negative().mux(before, on_path),
        )]
    }
}

impl Specified for LengthClamp {}
