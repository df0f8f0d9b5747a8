//! Prediction without the subtractor 15: (N + 1)·Dx − N·Dx(−Δt/N).
//!
//! ```text
//!                 ┌───────────────┐
//!  present, old ─▶│               │
//!                 │ lead products ├──▶ predicted
//!  ratio ────────▶│               │
//!                 └───────────────┘
//! ```
//!
//! The text's alternative to 15 and 16, with a product of each sample. Where N is fixed at 1 it is
//! 2·Dx − Dx(−Δt), without a multiplier. Adder 17 is included: the output is Dx(+Δt).

pub use super::lead::In;
use crate::prelude::*;

/// Prediction from two products. Combinational.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeadProducts {
    /// Width of a position.
    pub position: usize,
    /// N is 1, or 0 for no lead.
    pub one: bool,
}

signals! { for LeadProducts as c;
    /// Nets.
    pub struct Net {
        /// N as a signed word.
        factor: I(6),
        /// (N + 1)·Dx.
        present_product: I(c.position) as Analog,
        /// N·Dx(−Δt/N).
        old_product: I(c.position) as Analog,
        /// Dx(+Δt): predicted position.
        pub predicted: I(c.position) as Analog,
    }
}

impl Circuit for LeadProducts {
    const NAME: &'static str = "lead_products";
    const ABOUT: &'static str = "prediction as the difference of two products, one per sample";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let (some, ratio) = (i.ratio.bit(0), i.ratio.resize(6).signed());
        let (present_product, old_product) = match self.one {
            true => (
                some.mux(i.present.shift_left(1), i.present),
                some.mux(i.old, 0),
            ),
            false => (
                i.present.times(ratio + 1, self.position),
                i.old.times(ratio, self.position),
            ),
        };
        let net = Net {
            factor: ratio,
            present_product,
            old_product,
            predicted: present_product - old_product,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, w) = (&now.i, &now.w);
        let ratio = i.ratio.resize(6).signed();
        // Multiplied out. A proof that ratio·(present − old) is the same number takes too long for
        // wide words.
        let present = i.present.times(ratio + 1, self.position);
        let old = i.old.times(ratio, self.position);
        let mut all = vec![Property::always(
            "predicted is present plus ratio times (present minus old), modulo the range",
            &["predicted"],
            w.predicted.equals(present - old),
        )];
        if self.one {
            all.push(Property::given("ratio is at most 1", i.ratio.below(2)));
        }
        all
    }
}

impl Specified for LeadProducts {}
