//! Vector correction 4 of one axis (equations (6) and (7)).
//!
//! ```text
//!              ┌───────────────────┐
//!  correct ───▶│                   ├──▶ corrected
//!  reference ─▶│ vector_correction ├──▶ correction
//!  response ──▶│                   ├──▶ fresh
//!  command ───▶│                   │
//!              └───────────────────┘
//! ```
//!
//! E = Pr − Ps, Pd = Pc + E: how far the response would be from the path is added to the command.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic};
use crate::signals;

/// What is added to the position commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Correction {
    /// E = Pr − Ps, worked out in every period (equations (6), (7)).
    #[default]
    Vector,
    /// Nothing.
    None,
    /// The prior art (¶0004): along the normal, by what is right at constant speed. E = Pr − Pc, with
    /// Pr on a path whose arcs are so much wider.
    Steady,
}

impl Correction {
    /// The name it has in scenarios.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Correction::Vector => "vector",
            Correction::None => "none",
            Correction::Steady => "steady",
        }
    }
}

signals! {
    /// Ports in.
    pub struct In<L, const P: usize> {
        /// All three points stand.
        pub correct: L::Bit,
        /// Pr: the reference point.
        pub target: L::I<P>,
        /// Ps: the servo response.
        pub response: L::I<P>,
        /// Pc: the position command.
        pub command: L::I<P>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize> {
        /// E: the correction.
        pub correction: L::I<P> as Analog = 0,
        /// Pd: the corrected position command.
        pub corrected: L::I<P> as Analog = 0,
        /// They are new in this tick.
        pub fresh: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize> {
        /// What is added.
        vector: L::I<P>,
    }
}

/// Correction of points of `P` bits.
#[derive(Debug, Clone, Default)]
pub struct VectorCorrection<const P: usize> {
    /// What is added.
    pub correction: Correction,
}

impl<const P: usize> Circuit for VectorCorrection<P> {
    const NAME: &'static str = "vector_correction";
    const ABOUT: &'static str = "reference point minus response, added to the command";
    type In<L: Logic> = In<L, P>;
    type Reg<L: Logic> = Reg<L, P>;
    type Net<L: Logic> = Net<L, P>;

    fn comb<L: Logic>(&self, _: &Reg<L, P>, i: &In<L, P>) -> Net<L, P> {
        Net {
            vector: match self.correction {
                Correction::Vector => i.target - i.response,
                Correction::None => 0.into(),
                Correction::Steady => i.target - i.command,
            },
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, P>, w: &Net<L, P>, i: &In<L, P>) -> Reg<L, P> {
        Reg {
            correction: i.correct.mux(w.vector, q.correction),
            corrected: i.correct.mux(i.command + w.vector, q.corrected),
            fresh: i.correct,
        }
    }
}

impl<const P: usize> Specified for VectorCorrection<P> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new().step(
            "command and response differ by what corrected command and reference do",
            |now, next| {
                let (i, end) = (now.i, 1i64 << P);
                let expected = match (i.correct.get(), self.correction) {
                    (false, _) => [now.q.correction.get(), now.q.corrected.get()],
                    (true, Correction::None) => [0, i.command.get()],
                    (true, Correction::Vector) => {
                        let vector = i.target.get() - i.response.get();
                        [vector, i.command.get() + vector]
                    }
                    (true, Correction::Steady) => {
                        [i.target.get() - i.command.get(), i.target.get()]
                    }
                };
                let seen = [next.correction.get(), next.corrected.get()];
                let same = (0..2).all(|k| (seen[k] - expected[k]).rem_euclid(end) == 0);
                let right = same && next.fresh == i.correct;
                require(right, ["correction", "corrected", "fresh"], || {
                    format!("not {expected:?}")
                })
            },
        )
    }
}
