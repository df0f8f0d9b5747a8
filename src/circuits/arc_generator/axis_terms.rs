//! Terms of the axis: components of the unit vector k in \[2\] and their products, computed
//! beforehand.
//!
//! ```text
//!                     ┌────────────┐
//!  load, word, data ─▶│ axis_terms ├──▶ x, y, z, xx, yy, zz, xy, xz, yz
//!                     └────────────┘
//! ```

use crate::circuits::blocks::RecordWord;
use crate::prelude::*;

/// Number of the record word that is kx; the other terms follow.
pub const AXIS_WORD: u64 = 19;

/// Terms of the axis.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AxisTerms {
    /// C: width of a coefficient.
    pub coefficient: usize,
    /// D: width of a word of a record.
    pub data: usize,
}

signals! { for AxisTerms as c;
    /// Input ports.
    pub struct In {
        /// Word of a record.
        pub record: RecordWord(&c.data) as Flat,
    }
    /// Flip-flops.
    pub struct Reg {
        /// kx.
        pub x: I(c.coefficient) = 0,
        /// ky.
        pub y: I(c.coefficient) = 0,
        /// kz.
        pub z: I(c.coefficient) = 0,
        /// kx².
        pub xx: I(c.coefficient) = 0,
        /// ky².
        pub yy: I(c.coefficient) = 0,
        /// kz².
        pub zz: I(c.coefficient) = 0,
        /// kx·ky.
        pub xy: I(c.coefficient) = 0,
        /// kx·kz.
        pub xz: I(c.coefficient) = 0,
        /// ky·kz.
        pub yz: I(c.coefficient) = 0,
    }
    /// Nets.
    pub struct Net {
        /// Data word as a coefficient.
        given: I(c.coefficient),
    }
}

impl Circuit for AxisTerms {
    const NAME: &'static str = "axis_terms";
    const ABOUT: &'static str = "components of an axis and their products, from a record";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let short = self.data < self.coefficient;
        short.then(|| "a word of a record holds a coefficient".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let given = i.record.data.resize(self.coefficient).signed();
        let kept = |place: u64, held: I| {
            let own = i.record.load & i.record.word.equals(AXIS_WORD + place);
            own.mux(given, held)
        };
        let next = Reg {
            x: kept(0, q.x),
            y: kept(1, q.y),
            z: kept(2, q.z),
            xx: kept(3, q.xx),
            yy: kept(4, q.yy),
            zz: kept(5, q.zz),
            xy: kept(6, q.xy),
            xz: kept(7, q.xz),
            yz: kept(8, q.yz),
        };
        (Net { given }, next)
    }
}
