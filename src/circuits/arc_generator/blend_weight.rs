//! Weight of a blend's bend: computes (2 − h)h³ of \[5\] and \[10\] by two products, one bit per
//! tick, and outputs both factors of the point bit by bit.
//!
//! ```text
//!                            ┌──────────────┐
//!  step, halt ──────────────▶│              ├──▶ begins ──▶ coefficient_control
//!  copy, fraction, commit ──▶│ blend_weight ├──▶ share_bit, weight_bit, point_commit
//!  share ───────────────────▶│              ├──▶ done
//!                            └──────────────┘
//! ```
//!
//! (2 − h)h³ = u(2h − u) with u = h². The first pass of the control computes u, the second the
//! weight. In the third, the bits of h and of the weight go to the rows. Both products are rounded
//! to the nearest.

use crate::prelude::*;

/// Names of the passes.
const PASSES: &[&str] = &["square", "weight", "point"];
const SQUARE: u64 = 0;
const WEIGHT: u64 = 1;
const POINT: u64 = 2;

/// Weight of a blend's bend.
///
/// `done` is high 3·(C + 2) + 1 ticks after `step`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BlendWeight {
    /// C: width of a coefficient; C − 2 bits of it are fraction.
    pub coefficient: usize,
}

signals! { for BlendWeight as c;
    /// Input ports.
    pub struct In {
        /// Advances to the next point, whose h is valid from the next tick on. Allowed from `done`
        /// on.
        pub step: Bit,
        /// Aborts the point that is being computed; a step in the same tick is ignored.
        pub halt: Bit,
        /// A pass begins: its factors are copied.
        pub copy: Bit,
        /// The current bit is a fraction bit.
        pub fraction: Bit,
        /// The sums of the pass are complete.
        pub commit: Bit,
        /// h: 0 to 1; valid from the copy of the first pass to that of the third.
        pub share: I(c.coefficient),
    }
    /// Flip-flops.
    pub struct Reg {
        /// A pass begins in this tick.
        pub begins: Bit = 0,
        /// Number of the pass.
        pass: U(2) as States(PASSES) = 0,
        /// Multiplicand: h, then u. In the third pass: remaining bits of h.
        factor: U(c.coefficient) as Hex = 0,
        /// Remaining bits of the multiplier: h, then 2h − u. In the third pass: of the weight.
        bits: U(c.coefficient) as Hex = 0,
        /// Partial product, scaled to the weight of the next bit.
        sum: U(c.coefficient) = 0,
        /// Last bit shifted out of the sum; its weight is one half.
        half: Bit = 0,
        /// The new point is valid in this tick.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// The pass is the third.
        points: Bit,
        /// `factor` if the bit of the multiplier is 1, otherwise 0; 0 in the third pass.
        addend: U(c.coefficient),
        /// Sum plus `addend`.
        total: U(c.coefficient),
        /// Product, rounded to the nearest.
        product: U(c.coefficient) as Hex,
        /// Current bit of h, in the third pass.
        pub share_bit: Bit,
        /// Current bit of the weight, in the third pass.
        pub weight_bit: Bit,
        /// The sums of the rows are complete and become the point.
        pub point_commit: Bit,
    }
}

impl Circuit for BlendWeight {
    const NAME: &'static str = "blend_weight";
    const ABOUT: &'static str = "(2 - h)h^3 by two products, then its bits and those of h";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        (self.coefficient < 3).then(|| "a coefficient has a fraction".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let share = i.share.unsigned();
        let points = q.pass.equals(POINT);
        let bit = q.bits.bit(0);
        let addend = (bit & !points).mux(q.factor, 0);
        let total = q.sum + addend;
        let product = q.sum + q.half.word().resize(self.coefficient);
        let point_commit = i.commit & points;
        let net = Net {
            points,
            addend,
            total,
            product,
            share_bit: q.factor.bit(0) & points,
            weight_bit: bit & points,
            point_commit,
        };
        let weighs = q.pass.equals(WEIGHT);
        let by = weighs.mux(share.shift_left(1) - product, points.mux(product, share));
        let factor = points.mux(q.factor.shift_right(1), q.factor);
        let pass = i.commit.mux(points.mux(SQUARE, q.pass + 1), q.pass);
        let next = Reg {
            begins: (i.step | (i.commit & !points)) & !i.halt,
            pass: i.step.mux(SQUARE, pass),
            factor: i.copy.mux(weighs.mux(product, share), factor),
            bits: i.copy.mux(by, q.bits.shift_right(1)),
            // Without bits left the total is the sum.
            sum: i.copy.mux(0, i.fraction.mux(total.shift_right(1), total)),
            half: i.fraction.mux(total.bit(0), q.half),
            done: point_commit,
        };
        (net, next)
    }
}
