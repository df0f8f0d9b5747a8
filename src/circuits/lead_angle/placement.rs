//! Adder 17 and subtractor 20: apply the lead before position and target are compared.
//!
//! ```text
//!                            ┌───────────┐
//!  position, target, lead ──▶│ placement ├──▶ compared_position, compared_target
//!                            └───────────┘
//! ```
//!
//! The text allows three placements: the position is advanced (Fig. 1), the target is advanced
//! (Fig. 5), or each by one half. All three give the same difference, so they fire in the same
//! tick.
//!
//! Departure: for the third, the text subtracts half the lead from Dx; it has to be added.

use super::lead_source::Lead;
use crate::prelude::*;
use serde::{Deserialize, Serialize};

/// Value that the lead is added to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Placement {
    /// Added to the position: adder 17.
    #[default]
    Position,
    /// Subtracted from the target: subtractor 20.
    Target,
    /// Half of it, rounded down, added to the position, and the rest subtracted from the target.
    Halves,
}

/// Placement of the lead. Combinational.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeadPlacement {
    /// Width of a position.
    pub position: usize,
    /// Value that the lead is added to.
    pub placement: Placement,
}

signals! { for LeadPlacement as c;
    /// Input ports.
    pub struct In {
        /// Dx.
        pub position: I(c.position),
        /// Sx.
        pub target: I(c.position),
        /// N·Δx: lead.
        pub lead: I(c.position),
    }
    /// Nets.
    pub struct Net {
        /// Part of the lead that is added to the position.
        advance: I(c.position),
        /// Dx plus the part of the lead that is added to it.
        pub compared_position: I(c.position) as Analog,
        /// Sx′: Sx minus the part of the lead that is subtracted from it.
        pub compared_target: I(c.position) as Analog,
    }
}

impl Circuit for LeadPlacement {
    const NAME: &'static str = "placement";
    const ABOUT: &'static str = "applies the lead to the position, to the target, or to both";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let advance = match self.placement {
            Placement::Position => i.lead,
            Placement::Target => I::new(0, self.position),
            Placement::Halves => i.lead.shift_right(1),
        };
        let net = Net {
            advance,
            compared_position: i.position + advance,
            compared_target: i.target - (i.lead - advance),
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, w) = (&now.i, &now.w);
        let apart = w.compared_position - w.compared_target;
        let part = match self.placement {
            Placement::Position => i.lead,
            Placement::Target => I::new(0, self.position),
            Placement::Halves => i.lead.shift_right(1),
        };
        vec![
            Property::always(
                "compared_position minus compared_target equals position plus lead minus target",
                &["compared_position", "compared_target"],
                apart.equals(i.position + i.lead - i.target),
            ),
            Property::always(
                "position and target each receive the part of the lead that the placement assigns",
                &["compared_position"],
                (w.compared_position - i.position).equals(part),
            ),
        ]
    }
}

/// Operands of the comparator.
pub(super) struct Compared {
    /// Position that is compared.
    pub(super) position: I,
    /// Target that it is compared with.
    pub(super) target: I,
}

/// Settles the placement. Without one the lead is the place itself, as products give it.
pub(super) fn compared(part: Option<Part<LeadPlacement>>, lead: &Lead, target: I) -> Compared {
    let Some(part) = part else {
        let position = lead.lead;
        return Compared { position, target };
    };
    let ports = In {
        position: lead.present,
        target,
        lead: lead.lead,
    };
    let w = part.settle(ports).w;
    Compared {
        position: w.compared_position,
        target: w.compared_target,
    }
}

impl Specified for LeadPlacement {}
