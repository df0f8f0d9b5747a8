//! Error 27, position register 30 and overrun 31: the distances from which a lead time is learned.
//!
//! ```text
//!                       ┌────────────┐
//!  fire ───────────────▶│            ├──▶ overrun
//!  position, target ───▶│ stop error ├──▶ error
//!                       └────────────┘
//! ```
//!
//! `overrun` (d1) is the distance since the control signal, `error` (d2) the distance past the
//! target. Both are positive upwards. They are used when the positioning is complete.
//!
//! Departure: the text's error is Sx − Dx. With that sign, learning goes the wrong way: the
//! relative error r of a time becomes r² where it should become (1 − r)². That is the variant
//! [`Sign::Literal`].

use crate::prelude::*;
use serde::{Deserialize, Serialize};

/// Sign convention of the error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sign {
    /// Dx − Sx: learning converges.
    #[default]
    Converging,
    /// Sx − Dx, as the text has it: learning diverges.
    Literal,
}

/// Error and overrun; `overrun` counts from the tick after `fire` on.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StopError {
    /// Width of a position.
    pub position: usize,
    /// Sign convention of the error.
    pub sign: Sign,
}

signals! { for StopError as c;
    /// Input ports.
    pub struct In {
        /// High for one tick: the control signal begins.
        pub fire: Bit,
        /// Dx.
        pub position: I(c.position),
        /// Sx.
        pub target: I(c.position),
    }
    /// Flip-flops.
    pub struct Reg {
        /// 30: position at the start of the control signal.
        trigger_position: I(c.position) as Analog,
    }
    /// Nets.
    pub struct Net {
        /// 31: d1, distance since the control signal.
        pub overrun: I(c.position),
        /// 27: d2, distance past the target.
        pub error: I(c.position),
    }
}

impl Circuit for StopError {
    const NAME: &'static str = "stop_error";
    const ABOUT: &'static str = "overrun since the control signal, and distance past the target";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let net = Net {
            overrun: i.position - q.trigger_position,
            error: match self.sign {
                Sign::Converging => i.position - i.target,
                Sign::Literal => i.target - i.position,
            },
        };
        let trigger_position = i.fire.mux(i.position, q.trigger_position);
        (net, Reg { trigger_position })
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let trigger = i.fire.mux(i.position, q.trigger_position);
        let overrun = i.position.equals(q.trigger_position + w.overrun);
        let error = match self.sign {
            Sign::Converging => i.position.equals(i.target + w.error),
            Sign::Literal => i.target.equals(i.position + w.error),
        };
        vec![
            Property::step(
                "fire stores the position in trigger_position, which otherwise stays",
                &["trigger_position"],
                next.trigger_position.equals(trigger),
            ),
            Property::always(
                "overrun and error are the distances from trigger_position and from target",
                &["overrun", "error"],
                overrun & error,
            ),
        ]
    }
}

impl Specified for StopError {}
