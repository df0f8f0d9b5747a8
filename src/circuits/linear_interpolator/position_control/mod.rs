//! Position control of one axis (¶0003): subtractor 10, gain 11, D/A converter 12.
//!
//! ```text
//!               ┌──────────────────┐
//!  scan ───────▶│                  ├──▶ speed_ref, saturated
//!  command ────▶│                  │
//!  feedback ───▶│ position control ├──▶ deviation
//!  gain ───────▶│                  │
//!  window ─────▶│                  ├──▶ in_position
//!               └──────────────────┘
//! ```
//!
//! In the tick of `scan` the deviation is multiplied by the gain, rounded, limited to the range of
//! the D/A converter and loaded into `speed_ref`, which shows it a tick later and holds it until
//! the next scan.
//!
//! The text has a gain and a D/A converter and says nothing of fraction bits, rounding or
//! saturation, and it has no in-position window. Here the product is rounded to nearest, halves
//! away from zero, and the range of the converter is symmetric, so that the loop behaves equally
//! in both directions.

use super::LoopWidths;
use crate::prelude::*;

/// Position control.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PositionControl {
    /// Word widths, by name.
    pub widths: LoopWidths,
}

impl PositionControl {
    /// Half an LSB of the D/A converter, in units of the product.
    fn half(&self) -> u64 {
        (1 << self.widths.fraction) >> 1
    }

    /// The greatest reference.
    fn limit(&self) -> u64 {
        (1 << (self.widths.converter - 1)) - 1
    }
}

signals! { for PositionControl as c;
    /// Input ports.
    pub struct In {
        /// Strobe: loads the speed reference. It changes at no other time.
        pub scan: Bit,
        /// Position command in counts.
        pub command: I(c.widths.position) as Analog,
        /// Position of the motor in counts.
        pub feedback: I(c.widths.position) as Analog,
        /// 11: position gain, LSB of the D/A converter per count, with F fraction bits.
        pub gain: U(c.widths.gain),
        /// In-position window in counts.
        pub window: U(c.widths.position),
    }
    /// Flip-flops.
    pub struct Reg {
        /// 12: speed reference, the word of the D/A converter; from −(2^(D−1) − 1) to 2^(D−1) − 1.
        pub speed_ref: I(c.widths.converter) as Analog = 0,
        /// The reference is at its limit.
        pub saturated: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// 10: command − feedback in counts, valid in every tick; wraps.
        pub deviation: I(c.widths.position) as Analog,
        /// Magnitude of the deviation, in counts.
        distance: U(c.widths.position),
        /// 11: distance · gain plus half an LSB of the D/A converter, with F fraction bits.
        product: U(c.widths.product()),
        /// The product is at the limit or beyond.
        limited: Bit,
        /// Magnitude of the reference that a scan loads.
        amount: U(c.widths.converter),
        /// 12: reference that a scan loads.
        limited_reference: I(c.widths.converter),
        /// The magnitude of the deviation is at most the window; valid in every tick.
        pub in_position: Bit,
    }
}

impl Circuit for PositionControl {
    const NAME: &'static str = "position_control";
    const ABOUT: &'static str = "speed reference from position command and feedback, by a gain";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let LoopWidths {
            gain,
            fraction,
            converter,
            ..
        } = self.widths;
        if fraction > gain {
            return Some("the fraction is a part of the gain".into());
        }
        let fits = (2..=self.widths.product()).contains(&converter);
        (!fits).then(|| {
            "the D/A converter has two bits at least, and is no wider than the product".into()
        })
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let LoopWidths {
            fraction,
            converter,
            ..
        } = self.widths;
        let deviation = i.command - i.feedback;
        let distance = deviation.magnitude();
        // Without its sign, so that halves go away from zero.
        let product = distance.times(i.gain, self.widths.product()) + self.half();
        let limited = !product.below(self.limit() << fraction);
        let rounded = product.shift_right(fraction).resize(converter);
        let amount = limited.mux(self.limit(), rounded);
        let limited_reference = amount.signed().negated_by(deviation.is_negative());
        let next = Reg {
            speed_ref: i.scan.mux(limited_reference, q.speed_ref),
            saturated: i.scan.mux(limited, q.saturated),
        };
        let net = Net {
            deviation,
            distance,
            product,
            limited,
            amount,
            limited_reference,
            in_position: !i.window.below(distance),
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let wide = self.widths.position + 1;
        let (deviation, window) = (w.deviation.resize(wide), i.window.resize(wide).signed());
        let inside = !deviation.below(-window) & !window.below(deviation);
        let held = next.speed_ref.equals(q.speed_ref) & next.saturated.equals(q.saturated);
        let at_limit = q.speed_ref.magnitude().equals(self.limit());
        vec![
            Property::always(
                "deviation is the shorter distance from feedback to command",
                &["deviation"],
                (i.feedback + w.deviation).equals(i.command),
            ),
            Property::always(
                "in_position is high if and only if deviation is at most window",
                &["in_position"],
                w.in_position.equals(inside),
            ),
            Property::step(
                "a scan loads the nearest reference within the limits, halves away from zero",
                &["speed_ref"],
                i.scan.implies(self.is_nearest(i, w, next.speed_ref)),
            ),
            Property::step(
                "between scans, speed_ref and saturated keep their values",
                &["speed_ref", "scan"],
                i.scan | held,
            ),
            Property::always(
                "saturated is high if and only if speed_ref is at its limit",
                &["saturated"],
                q.saturated.equals(at_limit),
            ),
        ]
    }
}

impl PositionControl {
    /// High if `reference` is the nearest one to the product of deviation and gain, halves away
    /// from zero, within the limits.
    fn is_nearest(&self, i: &In, w: &Net, reference: I) -> Bit {
        let width = self.widths.product();
        let one = 1 << self.widths.fraction;
        let product = w.deviation.magnitude().times(i.gain, width);
        let amount = reference.magnitude();
        // In units of the product. Within the limits nothing wraps.
        let exact = amount.resize(width).shift_left(self.widths.fraction);
        let reached = !(product + self.half()).below(exact);
        let near = product.below(exact + (one - self.half()));
        let limit = U::new(self.limit(), self.widths.converter);
        let limited = near | amount.equals(limit);
        let same_sign = reference.is_negative().equals(w.deviation.is_negative());
        let sign = amount.is_zero() | (!product.is_zero() & same_sign);
        !limit.below(amount) & reached & limited & sign
    }
}

impl Specified for PositionControl {}

#[cfg(test)]
mod tests;
