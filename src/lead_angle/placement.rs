//! Adder 17 and subtractor 20: where the lead is put before position and target are compared.
//!
//! ```text
//!                            ┌───────────┐
//!  position, target, lead ──▶│ placement ├──▶ compared_position, compared_target
//!                            └───────────┘
//! ```
//!
//! The text allows three placements: the position is advanced (Fig. 1), the target is advanced
//! (Fig. 5), or each by a half. All three have the same difference, so they fire in the same tick.
//!
//! Departure: the text says of the third that half the lead is subtracted from Dx; it has to be
//! added.

use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Nothing};
use crate::logic::{Logic, Signed};
use crate::signals;
use serde::{Deserialize, Serialize};

/// What the lead is put on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Placement {
    /// Added to the position: adder 17.
    #[default]
    Position,
    /// Taken from the target: subtractor 20.
    Target,
    /// Half of it, rounded down, added to the position, and the rest taken from the target.
    Halves,
}

signals! {
    /// Ports in.
    pub struct In<L, const W: usize> {
        /// Dx.
        pub position: L::I<W>,
        /// Sx.
        pub target: L::I<W>,
        /// N·Δx.
        pub lead: L::I<W>,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const W: usize> {
        /// The part of the lead that is added to the position.
        advance: L::I<W>,
        /// Dx(+Δt), or as much of it as the placement wants.
        pub compared_position: L::I<W> as Analog,
        /// Sx′, likewise.
        pub compared_target: L::I<W> as Analog,
    }
}

/// Placement of the lead, for positions of `W` bits. Combinational.
#[derive(Debug, Clone, Default)]
pub struct LeadPlacement<const W: usize> {
    /// What the lead is put on.
    pub placement: Placement,
}

impl<const W: usize> Circuit for LeadPlacement<W> {
    const NAME: &'static str = "placement";
    const ABOUT: &'static str = "puts the lead on the position, on the target, or on both";
    type In<L: Logic> = In<L, W>;
    type Reg<L: Logic> = Nothing<L>;
    type Net<L: Logic> = Net<L, W>;

    fn comb<L: Logic>(&self, _: &Nothing<L>, i: &In<L, W>) -> Net<L, W> {
        let advance = match self.placement {
            Placement::Position => i.lead,
            Placement::Target => 0.into(),
            Placement::Halves => i.lead.shift_right(1),
        };
        Net {
            advance,
            compared_position: i.position + advance,
            compared_target: i.target - (i.lead - advance),
        }
    }

    fn next<L: Logic>(&self, _: Nothing<L>, _: &Net<L, W>, _: &In<L, W>) -> Nothing<L> {
        Nothing::new()
    }
}

impl<const W: usize> Specified for LeadPlacement<W> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let range = 1i64 << W;
        let placement = self.placement;
        Invariants::<Self>::new()
            .always(
                "position and target are as far apart as with all of the lead on the position",
                move |now| {
                    let apart = now.w.compared_position.get() - now.w.compared_target.get();
                    let wanted = now.i.position.get() + now.i.lead.get() - now.i.target.get();
                    let right = (apart - wanted) % range == 0;
                    require(right, ["compared_position", "compared_target"], || {
                        format!("{apart} where {wanted} is wanted")
                    })
                },
            )
            .always("each bears its part of the lead", move |now| {
                let lead = now.i.lead.get();
                let part = match placement {
                    Placement::Position => lead,
                    Placement::Target => 0,
                    Placement::Halves => lead.div_euclid(2),
                };
                let moved = now.w.compared_position.get() - now.i.position.get();
                require((moved - part) % range == 0, ["compared_position"], || {
                    format!("{moved} of {lead}")
                })
            })
    }
}
