//! Correction arithmetic 28: Δt2 = Δt1 + Δt1·d2/d1, on the grid of the codes.
//!
//! ```text
//!                             ┌───────────────────────┐ start, multiplicand, …
//!  complete, learn, missed ──▶│                       ├──▶ mul_div
//!  lead_time, overrun, error ▶│ correction arithmetic │◀── done, quotient
//!  seed ─────────────────────▶│                       ├──▶ raw, learned
//!                             └───────────────────────┘──▶ corrected
//! ```
//!
//! The quotient is rounded to the nearest and made of magnitudes. Its sign is that of d2/d1, so it
//! is right for both directions. The [ratio logic](super::ratio_logic) puts `raw` on the grid.
//!
//! Departures, all of them where the text is silent: an overrun of 0 teaches nothing. A time of 0
//! would never change, so learning begins with `seed` if there was an error. The result is at least
//! one CK and at most the largest code. A positioning that was halted teaches nothing.

use super::codes;
use crate::prelude::*;

/// Correction arithmetic 28.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CorrectionArithmetic {
    /// Stages of history: times end at ten times as many.
    pub stages: usize,
    /// Width of a position.
    pub position: usize,
}

impl CorrectionArithmetic {
    /// Width of the divider's words: that of a time and that of a position.
    #[must_use]
    pub fn word(&self) -> usize {
        self.time() + self.position
    }

    /// Width of a time.
    #[must_use]
    pub fn time(&self) -> usize {
        codes::time_width(self.stages)
    }

    /// Largest code of a time.
    pub(super) fn last(&self) -> u64 {
        codes::largest(self.stages)
    }
}

signals! { for CorrectionArithmetic as c;
    /// Input ports.
    pub struct In {
        /// High for one tick: the positioning is complete.
        pub complete: Bit,
        /// Enables learning.
        pub learn: Bit,
        /// The control signal did not come from the comparator.
        pub missed: Bit,
        /// Δt1 in CKs.
        pub lead_time: U(c.time()),
        /// d1: distance since the control signal.
        pub overrun: I(c.position),
        /// d2: distance past the target.
        pub error: I(c.position),
        /// Lead time, in CKs, that a step without one gets after its first stop error.
        pub seed: U(c.time()),
        /// The divider has a result.
        pub done: Bit,
        /// |Δtd| from the divider.
        pub quotient: U(c.word()),
    }
    /// Flip-flops.
    pub struct Reg {
        /// The divider is working on a correction.
        pub(super) dividing: Bit,
        /// Δtd is negative.
        pub negative: Bit,
        /// Δt2 in CKs, before it is put on the grid.
        pub raw: U(c.time()),
        /// High for one tick: `raw` is a new time.
        pub learned: Bit,
        /// High for one tick: the correction is over, with or without a new time.
        pub corrected: Bit,
    }
    /// Nets.
    pub struct Net {
        /// A correction is requested.
        wanted: Bit,
        /// Starts the divider.
        pub divide: Bit,
        /// The step takes the seed as its time.
        sow: Bit,
        /// |d2|, first factor.
        pub multiplicand: U(c.word()),
        /// Δt1, second factor.
        pub multiplier: U(c.time()),
        /// |d1|.
        pub divisor: U(c.word()),
        /// Half of |d1|, which rounds the quotient to the nearest.
        pub addend: U(c.word()),
        /// The division of a correction ends.
        divided: Bit,
        /// Δt1 + |Δtd|.
        sum: U(c.word()),
        /// Δt1 + |Δtd|, at most the largest code.
        longer: U(c.time()),
        /// |Δtd| is at least Δt1.
        vanishes: Bit,
        /// Δt1 − |Δtd|.
        rest: U(c.word()),
        /// Δt1 − |Δtd|, at least 1.
        shorter: U(c.time()),
    }
}

impl CorrectionArithmetic {
    /// Returns the time plus or minus the quotient, limited to codes from 1 to the last, as a word of
    /// the divider.
    fn limited(&self, i: &In, negative: Bit) -> U {
        let (time, last) = (i.lead_time.resize(self.word()), self.last());
        let sum = time + i.quotient;
        let longer = sum.below(last).mux(sum, last);
        let shorter = i.quotient.below(time).mux(time - i.quotient, 1);
        negative.mux(shorter, longer)
    }
}

impl Circuit for CorrectionArithmetic {
    const NAME: &'static str = "correction_arithmetic";
    const ABOUT: &'static str = "next lead time from overrun and error";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let wanted = i.complete & i.learn & !i.missed;
        let none = i.lead_time.is_zero();
        let divisor = i.overrun.magnitude().resize(self.word());
        let time = i.lead_time.resize(self.word());
        let sum = time + i.quotient;
        let last = U::new(self.last(), self.word());
        let vanishes = !i.quotient.below(time);
        let rest = time - i.quotient;
        let divided = q.dividing & i.done;
        let divide = wanted & !none & !divisor.is_zero();
        let sow = wanted & none & !i.error.is_zero();
        let multiplicand = i.error.magnitude().resize(self.word());
        let addend = divisor.shift_right(1);
        let longer = last.below(sum).mux(last, sum).resize(self.time());
        let shorter = vanishes.mux(1, rest.resize(self.time()));
        let opposed = i.error.is_negative() ^ i.overrun.is_negative();
        let result = q.negative.mux(shorter, longer);
        let edge = Reg {
            dividing: divide | (q.dividing & !i.done),
            negative: divide.mux(opposed, q.negative),
            raw: divided.mux(result, sow.mux(i.seed, q.raw)),
            learned: divided | sow,
            corrected: divided | (i.complete & !divide),
        };
        let net = Net {
            wanted,
            divide,
            sow,
            multiplicand,
            multiplier: i.lead_time,
            divisor,
            addend,
            divided,
            sum,
            longer,
            vanishes,
            rest,
            shorter,
        };
        (net, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let learns = i.complete & i.learn & !i.missed;
        let divided = q.dividing & i.done;
        let sown = learns & i.lead_time.is_zero() & !i.error.is_zero();
        let divides = learns & !i.lead_time.is_zero() & !i.overrun.is_zero();

        let corrected = next.corrected.equals(divided | (i.complete & !w.divide));
        let dividing = next.dividing.equals(w.divide | (q.dividing & !i.done));
        let learned = next.learned.equals(sown | divided);
        let seeded = !sown | divided | next.raw.equals(i.seed);
        let raw = next.raw.resize(self.word());
        let opposed = i.error.is_negative() ^ i.overrun.is_negative();
        let none = i.error.is_zero() | i.overrun.is_zero();
        let last = U::new(self.last(), self.time());
        vec![
            Property::step(
                "corrected is high after every completion, or after its division if there is one",
                &["corrected", "dividing"],
                corrected & dividing,
            ),
            Property::step(
                "a lead time of 0 with an error learns seed, and any other learns by division",
                &["learned", "divide", "raw"],
                learned & seeded & w.divide.equals(divides),
            ),
            Property::step(
                "raw is lead_time plus or minus quotient, limited to codes from 1 to the last",
                &["raw"],
                divided.implies(raw.equals(self.limited(i, q.negative))),
            ),
            Property::step(
                "a division sets negative if error and overrun have opposite signs",
                &["negative"],
                w.divide.implies(none | next.negative.equals(opposed)),
            ),
            Property::given(
                "lead_time is from 1 to the largest code when a division ends",
                divided.implies(!(i.lead_time.is_zero() | last.below(i.lead_time))),
            ),
            Property::given(
                "quotient is below half of its range when a division ends",
                divided.implies(!i.quotient.bit(self.word() - 1)),
            ),
        ]
    }
}

impl Specified for CorrectionArithmetic {
    /// Excludes seeds above 1: a seed is only stored.
    fn applies(&self, i: &In<Value>) -> bool {
        i.seed <= 1
    }
}
