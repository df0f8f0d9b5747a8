//! Length clamp: a length is held on the path.
//!
//! ```text
//!             ┌──────────────┐
//!  length ───▶│ length_clamp ├──▶ clamped
//!  path_end ─▶│              │
//!             └──────────────┘
//! ```
//!
//! Departure: the text has no answer where the tangential response overshoots the path's end, as it
//! does with K2 < 4·K1. There is no path behind it: the reference point stays on the end. The
//! command's length goes through the same, whatever the profile says.

use crate::hdl::prelude::*;

/// Clamp of lengths.
#[derive(Debug, Clone)]
pub struct LengthClamp {
    /// Width of a length in bits.
    pub width: usize,
}

signals! { for LengthClamp as c;
    /// Ports in.
    pub struct In {
        /// A length along the path.
        pub length: I(c.width),
        /// L: where the path ends; not negative.
        pub path_end: I(c.width),
    }
    /// Nets.
    pub struct Net {
        /// The length is behind the end.
        beyond: Bit,
        /// The length, 0 at least and the end at most.
        pub clamped: U(c.width),
    }
}

impl Circuit for LengthClamp {
    const NAME: &'static str = "length_clamp";
    const ABOUT: &'static str = "holds a length on the path";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let beyond = i.path_end.below(i.length);
        let on = beyond.mux(i.path_end.unsigned(), i.length.unsigned());
        let clamped = i.length.is_negative().mux(0, on);
        (Net { beyond, clamped }, Nothing)
    }
}

impl Specified for LengthClamp {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new().always("it is on the path, and the length where that is", |now| {
            let end = now.i.path_end;
            let expected = now.i.length.clamp(0, end.max(0)) as u64;
            let right = end < 0 || now.w.clamped == expected;
            require(right, ["clamped"], || format!("not {expected}"))
        })
    }
}
