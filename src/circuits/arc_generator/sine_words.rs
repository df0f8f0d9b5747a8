//! Words of sine and cosine: rounds the output of the CORDIC to coefficients, computes vers = 1 −
//! cos, and outputs all three serially, one bit per tick.
//!
//! ```text
//!           ┌────────────┐
//!  copy ───▶│            ├──▶ sine_bit
//!  along ──▶│ sine_words ├──▶ cosine_bit
//!  across ─▶│            ├──▶ versine_bit
//!           └────────────┘
//! ```

use crate::prelude::*;

/// Bits of the CORDIC's output below the last bit of a coefficient.
pub const FINE: usize = 6;

/// Words of sine and cosine.
///
/// The lowest bits are valid in the tick after `copy`, the next bits one tick later.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SineWords {
    /// C: width of a coefficient; all bits but two are fraction.
    pub coefficient: usize,
}

impl SineWords {
    /// Width of the output of CORDIC.
    pub const fn radius(&self) -> usize {
        self.coefficient + FINE
    }
}

signals! { for SineWords as c;
    /// Input ports.
    pub struct In {
        /// Loads the words.
        pub copy: Bit,
        /// cos Δθ, from the CORDIC.
        pub along: I(c.radius()),
        /// sin Δθ, from the CORDIC.
        pub across: I(c.radius()),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Remaining bits of the sine.
        sine: U(c.coefficient) as Hex = 0,
        /// Remaining bits of the cosine.
        cosine: U(c.coefficient) as Hex = 0,
        /// Remaining bits of vers Δθ.
        versine: U(c.coefficient) as Hex = 0,
    }
    /// Nets.
    pub struct Net {
        /// sin Δθ plus half a unit of a coefficient, rounded down to coefficient units.
        whole_sine: I(c.radius()),
        /// cos Δθ plus half a unit of a coefficient, rounded down to coefficient units.
        whole_cosine: I(c.radius()),
        /// sin Δθ, rounded to the nearest coefficient.
        nearest_sine: I(c.coefficient),
        /// cos Δθ, rounded to the nearest coefficient.
        nearest_cosine: I(c.coefficient),
        /// vers Δθ = 1 − cos Δθ.
        rest: I(c.coefficient),
        /// Current bit of the sine.
        pub sine_bit: Bit,
        /// Current bit of the cosine.
        pub cosine_bit: Bit,
        /// Current bit of the versine.
        pub versine_bit: Bit,
    }
}

impl Circuit for SineWords {
    const NAME: &'static str = "sine_words";
    const ABOUT: &'static str = "sine, cosine and versine as coefficients, one bit per tick";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let wrong = self.coefficient < 3;
        wrong.then(|| "a coefficient has two bits before the point and one behind".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let whole = |word: I| (word + (1i64 << (FINE - 1))).shift_right(FINE);
        let (whole_sine, whole_cosine) = (whole(i.across), whole(i.along));
        let nearest_sine = whole_sine.resize(self.coefficient);
        let nearest_cosine = whole_cosine.resize(self.coefficient);
        let one = I::new(1 << (self.coefficient - 2), self.coefficient);
        let rest = one - nearest_cosine;
        let bits = |word: I, bits: U| i.copy.mux(word.unsigned(), bits.shift_right(1));
        let next = Reg {
            sine: bits(nearest_sine, q.sine),
            cosine: bits(nearest_cosine, q.cosine),
            versine: bits(rest, q.versine),
        };
        let net = Net {
            whole_sine,
            whole_cosine,
            nearest_sine,
            nearest_cosine,
            rest,
            sine_bit: q.sine.bit(0),
            cosine_bit: q.cosine.bit(0),
            versine_bit: q.versine.bit(0),
        };
        (net, next)
    }
}
