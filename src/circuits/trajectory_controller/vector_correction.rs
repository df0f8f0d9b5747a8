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
//! E = Pr − Ps and Pd = Pc + E: the distance from the response to the path is added to the command.

use crate::prelude::*;

/// Correction added to the position commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Correction {
    /// E = Pr − Ps, computed in every period (equations (6), (7)).
    #[default]
    Vector,
    /// Nothing.
    None,
    /// The prior art (¶0004): along the normal, by the amount that is right at constant speed. E =
    /// Pr − Pc, with Pr on a path whose arcs are wider by that amount.
    Steady,
    /// The prior art (¶0005): the motors' errors along and across the path, each times its gain.
    Feedback,
}

impl Correction {
    /// The name it has in scenarios.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Correction::Vector => "vector",
            Correction::None => "none",
            Correction::Steady => "steady",
            Correction::Feedback => "feedback",
        }
    }
}

/// Correction of points.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct VectorCorrection {
    /// Width of a point in bits.
    pub width: usize,
    /// Kind of correction.
    pub correction: Correction,
}

signals! { for VectorCorrection as c;
    /// Input ports.
    pub struct In {
        /// All three points are valid.
        pub correct: Bit,
        /// Pr: reference point, or the error feedback.
        pub target: I(c.width),
        /// Ps: servo response.
        pub response: I(c.width),
        /// Pc: position command.
        pub command: I(c.width),
    }
    /// Flip-flops.
    pub struct Reg {
        /// E: correction.
        pub correction: I(c.width) as Analog = 0,
        /// Pd: corrected position command.
        pub corrected: I(c.width) as Analog = 0,
        /// High for one tick: the corrected command has a new value.
        pub fresh: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// Correction to add to the command.
        vector: I(c.width),
    }
}

impl Circuit for VectorCorrection {
    const NAME: &'static str = "vector_correction";
    const ABOUT: &'static str = "reference point minus response, added to the command";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let vector = match self.correction {
            Correction::Vector => i.target - i.response,
            Correction::None => I::new(0, self.width),
            Correction::Steady => i.target - i.command,
            Correction::Feedback => i.target,
        };
        let next = Reg {
            correction: i.correct.mux(vector, q.correction),
            corrected: i.correct.mux(i.command + vector, q.corrected),
            fresh: i.correct,
        };
        (Net { vector }, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let vector = match self.correction {
            Correction::Vector => i.target - i.response,
            Correction::None => I::new(0, self.width),
            Correction::Steady => i.target - i.command,
            Correction::Feedback => i.target,
        };
        let added = (next.corrected - i.command).equals(vector);
        let stays = next.corrected.equals(q.corrected);
        vec![Property::step(
            "corrected command minus command equals reference minus response",
            &["correction", "corrected", "fresh"],
            Bit::all([
                next.correction.equals(i.correct.mux(vector, q.correction)),
                i.correct.mux(added, stays),
                next.fresh.equals(i.correct),
            ]),
        )]
    }
}

impl Specified for VectorCorrection {}
