//! Subtractor 15 and multiplier 16: compute the lead N·(Dx − Dx(−Δt/N)).
//!
//! ```text
//!                 ┌──────┐
//!  present, old ─▶│ lead ├──▶ difference
//!  ratio ────────▶│      ├──▶ lead
//!                 └──────┘
//! ```
//!
//! Words wrap. So the difference is right while the distance of a tap is below half the range of a
//! position, and the prediction is right wherever on the ring it ends.
//!
//! With N fixed at 1 there is no multiplier (この場合は論理回路13と乗算器16は不要): the lead is the difference, or
//! 0.

use super::LeadProducts;
use crate::prelude::*;

/// Subtractor and multiplier. Combinational.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lead {
    /// Width of a position.
    pub position: usize,
    /// N is 1, or 0 for no lead.
    pub one: bool,
}

signals! { for (Lead, LeadProducts) as c;
    /// Input ports; also those of the [products](super::lead_products).
    pub struct In {
        /// Dx: present sample.
        pub present: I(c.position),
        /// Dx(−Δt/N): earlier sample.
        pub old: I(c.position),
        /// N, up to 10; 0 for no lead.
        pub ratio: U(4),
    }
}

signals! { for Lead as c;
    /// Nets.
    pub struct Net {
        /// N as a signed word.
        factor: I(5),
        /// 15: Δx, the distance moved in the last Δt/N.
        pub difference: I(c.position) as Analog,
        /// 16: N·Δx, the distance that this speed covers in Δt.
        pub lead: I(c.position) as Analog,
    }
}

impl Circuit for Lead {
    const NAME: &'static str = "lead_arithmetic";
    const ABOUT: &'static str = "lead: N times the distance moved since the earlier sample";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let difference = i.present - i.old;
        let factor = i.ratio.resize(5).signed();
        let net = Net {
            factor,
            difference,
            lead: match self.one {
                true => i.ratio.bit(0).mux(difference, 0),
                false => difference.times(factor, self.position),
            },
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, w) = (&now.i, &now.w);
        let difference = i.present - i.old;
        let ratio = i.ratio.resize(5).signed();
        let mut all = vec![
            Property::always(
                "difference is the shorter distance from old to present",
                &["difference"],
                w.difference.equals(difference),
            ),
            Property::always(
                "lead equals ratio times difference, modulo the position range",
                &["lead"],
                w.lead.equals(difference.times(ratio, self.position)),
            ),
        ];
        if self.one {
            all.push(Property::given("ratio is at most 1", i.ratio.below(2)));
        }
        all
    }
}

impl Specified for Lead {}
