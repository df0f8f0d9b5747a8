//! Conventional lead of Fig. 7: speed detector 2, and lead angle calculation 1 as a product.
//!
//! ```text
//!                          ┌────────────┐
//!  ck, position, restart ─▶│            ├──▶ present, speed, lead
//!  lead_parameter, gate ──▶│ speed lead ├──▶ fresh, enough
//!                          └────────────┘
//! ```
//!
//! The lead is speed times `lead_parameter` (a), rounded down: θa = f(ν, a) for a constant stopping time.

use super::{SpeedDetector, speed_detector};
use crate::prelude::*;

/// Conventional lead. A position that is present in the tick of CK is at `present` in the next
/// tick.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpeedLead {
    /// Width of a position.
    pub position: usize,
    /// Width of a gate in CKs.
    pub gate: usize,
}

signals! { for SpeedLead as c;
    /// Input ports.
    pub struct In {
        /// CK: a sample is taken.
        pub ck: Bit,
        /// Discards the samples taken so far.
        pub restart: Bit,
        /// Position, in counts.
        pub position: I(c.position),
        /// a: lead time in units of 1/256 gate.
        pub lead_parameter: U(14),
        /// Length of a gate in CKs; 0 counts as 1.
        pub gate: U(c.gate),
    }
    /// The circuit inside.
    pub struct Parts {
        /// Speed detector 2.
        pub detector: Part<SpeedDetector>(SpeedDetector { position: c.position, gate: c.gate }),
    }
    /// Nets.
    pub struct Net {
        /// Dx: present sample.
        pub present: I(c.position) as Analog,
        /// The sample is new in this tick.
        pub fresh: Bit,
        /// A whole gate has been measured since the last restart.
        pub enough: Bit,
        /// ν: distance of the last gate, in counts.
        pub speed: I(c.position) as Analog,
        /// a as a signed word.
        factor: I(15),
        /// ν·a, in units of 1/256 count.
        product: I(64),
        /// 1: lead angle θa, in counts.
        pub lead: I(c.position) as Analog,
    }
}

impl Circuit for SpeedLead {
    const NAME: &'static str = "speed_lead";
    const ABOUT: &'static str = "conventional lead: measured speed times a parameter";
    records!(In, Nothing, Net, Parts);

    fn objection(&self) -> Option<String> {
        let fits = self.position + 15 <= 64;
        (!fits).then(|| "a position has at most 49 bits, its product with a at most 64".into())
    }

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let detector = p.detector.settle(speed_detector::In {
            ck: i.ck,
            restart: i.restart,
            position: i.position,
            gate: i.gate,
        });
        let factor = i.lead_parameter.resize(15).signed();
        let product = detector.q.speed.times(factor, 64);
        let net = Net {
            present: detector.q.present,
            fresh: detector.q.fresh,
            enough: detector.q.enough,
            speed: detector.q.speed,
            factor,
            product,
            lead: product.shift_right(8).resize(self.position),
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        // In units of 1/256 count, modulo the range of a position.
        let bits = self.position + 8;
        let factor = now.i.lead_parameter.resize(15).signed();
        let product = now.p.detector.q.speed.times(factor, self.position + 15);
        let lead = now.w.lead.resize(bits).shift_left(8);
        let rest = (product.resize(bits) - lead).unsigned();
        vec![Property::always(
            "lead is speed times lead_parameter divided by 256, rounded down",
            &["lead"],
            rest.below(256),
        )]
    }
}

impl Specified for SpeedLead {
    /// Parameters as a proof can bear: none, one half, one, the greatest.
    fn applies(&self, i: &In<Value>) -> bool {
        [0, 128, 256, 16_383].contains(&i.lead_parameter)
    }
}
