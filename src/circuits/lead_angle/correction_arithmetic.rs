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

    fn last(&self) -> u64 {
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
        /// Time from which a step without a time begins to learn, in CKs.
        pub seed: U(c.time()),
        /// The divider has a result.
        pub done: Bit,
        /// |Δtd| from the divider.
        pub quotient: U(c.word()),
    }
    /// Flip-flops.
    pub struct Reg {
        /// The divider is working on a correction.
        dividing: Bit,
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
}

impl Specified for CorrectionArithmetic {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "corrected is high after every completion, or after its division if there is one",
                |now, next| {
                    let divides = now.w.divide;
                    let ended = now.q.dividing && now.i.done;
                    let corrected = ended || (now.i.complete && !divides);
                    let dividing = divides || (now.q.dividing && !ended);
                    let right = next.q.corrected == corrected && next.q.dividing == dividing;
                    require(right, ["corrected", "dividing"], || {
                        format!("{corrected} and {dividing} expected")
                    })
                },
            )
            .step(
                "a lead time of 0 with an error learns seed, and any other learns by division",
                |now, next| {
                    let (i, next) = (now.i, &next.q);
                    let learns = i.complete && i.learn && !i.missed;
                    let (time, error) = (i.lead_time, i.error);
                    let sown = learns && time == 0 && error != 0;
                    let divided = now.q.dividing && i.done;
                    let right = next.learned == (sown || divided)
                        && (!sown || divided || next.raw == i.seed)
                        && now.w.divide == (learns && time > 0 && i.overrun != 0);
                    require(right, ["learned", "divide", "raw"], || {
                        format!("a time of {time} with an error of {error}")
                    })
                },
            )
            .step(
                "raw is lead_time plus or minus quotient, limited to codes from 1 to the last",
                |now, next| {
                    if !(now.q.dividing && now.i.done) {
                        return Ok(());
                    }
                    let (time, by) = (i128::from(now.i.lead_time), i128::from(now.i.quotient));
                    let sum = if now.q.negative { time - by } else { time + by };
                    let expected = sum.clamp(1, i128::from(self.last()));
                    require(i128::from(next.q.raw) == expected, ["raw"], || {
                        format!("{expected} expected")
                    })
                },
            )
            .step(
                "a division sets negative if error and overrun have opposite signs",
                |now, next| {
                    let signs = now.i.error.signum() * now.i.overrun.signum();
                    let right = next.q.negative == (signs < 0) || signs == 0;
                    require(!now.w.divide || right, ["negative"], || "wrong".into())
                },
            )
    }

    /// Times as the memory holds them, and quotients that such a division can have.
    fn applies(&self, i: &In<Value>) -> bool {
        i.lead_time <= self.last() && i.seed <= 1
    }
}
