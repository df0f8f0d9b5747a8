//! Comparator 19: the control signal, when the compared position reaches the compared target.
//!
//! ```text
//!                               ┌────────────┐
//!  evaluate, valid ────────────▶│            ├──▶ crossing, fire
//!  position, target ───────────▶│ comparator ├──▶ control
//!  arm, halt ──────────────────▶│            ├──▶ upward
//!                               └────────────┘
//! ```
//!
//! It looks, from the first `arm` on, where `evaluate` is high and what it is given is `valid`. A
//! *crossing* is the arrival at the target, or the step over it, from either side; it counts once.
//! The first after `arm` is `fire`, and holds the control signal until the next `arm`.
//!
//! Departures: the text compares for equality, which hits only one target in v where the position
//! moves on by v > 1 counts per CK. That is the variant [`Comparing::Equal`]. A crossing is told
//! from the jump at the far side of the ring, where the difference changes its sign too: for
//! that, moves have to be below a quarter of the range per CK. `arm`, the latch and `halt`, which
//! gives the control signal without a crossing, are additions.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;
use serde::{Deserialize, Serialize};

/// When the comparator finds that the target is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Comparing {
    /// The position arrives at the target or steps over it.
    #[default]
    Crossing,
    /// The position is the target, as the text has it.
    Equal,
}

/// Names of the sides.
const SIDES: &[&str] = &["unknown", "below", "at", "above"];
const UNKNOWN: u64 = 0;
const BELOW: u64 = 1;
const AT: u64 = 2;
const ABOVE: u64 = 3;

signals! {
    /// Ports in.
    pub struct In<L, const W: usize> {
        /// Position and target are new in this tick.
        pub evaluate: L::Bit,
        /// They can be trusted.
        pub valid: L::Bit,
        /// The position, with its lead.
        pub position: L::I<W>,
        /// The target, with its lead.
        pub target: L::I<W>,
        /// Takes the control signal back and forgets the side; goes before all else.
        pub arm: L::Bit,
        /// Gives the control signal at once.
        pub halt: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L> {
        /// Where the position was when it was last looked at, since `arm`.
        side: L::U<2> as States(SIDES) = 0,
        /// It looks at all: from the first `arm` on.
        armed: L::Bit = 0,
        /// The control signal, from the first crossing to the next `arm`.
        pub control: L::Bit = 0,
        /// It came from below.
        pub upward: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const W: usize> {
        /// Position minus target, the short way round.
        pub difference: L::I<W> as Analog,
        /// The position is looked at in this tick.
        look: L::Bit,
        /// The position is the target.
        equal: L::Bit,
        /// The position is on this half of the ring.
        near: L::Bit,
        /// It comes from below.
        upwards: L::Bit,
        /// It comes from above.
        downwards: L::Bit,
        /// The target is reached.
        pub crossing: L::Bit,
        /// The target is reached for the first time since `arm`.
        pub fire: L::Bit,
    }
}

/// Comparator 19 of positions of `W` bits; `control` shows in the tick after `fire`.
#[derive(Debug, Clone, Default)]
pub struct Comparator<const W: usize> {
    /// When the target is reached.
    pub comparing: Comparing,
}

impl<const W: usize> Circuit for Comparator<W> {
    const NAME: &'static str = "comparator";
    const ABOUT: &'static str = "gives the control signal when the position reaches the target";
    type In<L: Logic> = In<L, W>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L, W>;

    fn comb<L: Logic>(&self, q: &Reg<L>, i: &In<L, W>) -> Net<L, W> {
        let difference = i.position - i.target;
        let (negative, equal) = (difference.is_negative(), difference.is_zero());
        let look = i.evaluate & i.valid & q.armed & !i.arm;
        let near = !(negative ^ difference.shift_left(1).is_negative());
        let upwards = q.side.equals(BELOW.into()) & !negative & near;
        let downwards = q.side.equals(ABOVE.into()) & (negative | equal) & near;
        let crossing = match self.comparing {
            Comparing::Crossing => {
                let at_once = q.side.equals(UNKNOWN.into()) & equal;
                look & (upwards | downwards | at_once)
            }
            Comparing::Equal => look & equal & !q.side.equals(AT.into()),
        };
        Net {
            difference,
            look,
            equal,
            near,
            upwards,
            downwards,
            crossing,
            fire: crossing & !q.control,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L>, w: &Net<L, W>, i: &In<L, W>) -> Reg<L> {
        let away = w.difference.is_negative().mux(BELOW.into(), ABOVE.into());
        let side = w.equal.mux(AT.into(), away);
        Reg {
            side: i.arm.mux(UNKNOWN.into(), w.look.mux(side, q.side)),
            armed: q.armed | i.arm,
            control: (q.control | w.fire | i.halt) & !i.arm,
            upward: w.fire.mux(w.upwards, q.upward),
        }
    }
}

impl<const W: usize> Specified for Comparator<W> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let comparing = self.comparing;
        let quarter = 1i64 << (W - 2);
        Invariants::<Self>::new()
            .always(
                "a crossing is an arrival at the target or a step over it",
                move |now| {
                    let difference = now.w.difference.get();
                    let here = (-quarter..quarter).contains(&difference);
                    let reached = match (comparing, now.q.side.get()) {
                        (Comparing::Equal, side) => difference == 0 && side != AT,
                        (Comparing::Crossing, BELOW) => here && difference >= 0,
                        (Comparing::Crossing, ABOVE) => here && difference <= 0,
                        (Comparing::Crossing, UNKNOWN) => difference == 0,
                        (Comparing::Crossing, _) => false,
                    };
                    let i = now.i;
                    let looks =
                        i.evaluate.get() && i.valid.get() && now.q.armed.get() && !i.arm.get();
                    let right = now.w.crossing.get() == (reached && looks);
                    require(right, ["crossing", "difference", "side"], || {
                        format!("a difference of {difference}")
                    })
                },
            )
            .always("it fires only without a control signal", |now| {
                let fires = now.w.crossing.get() && !now.q.control.get();
                require(now.w.fire.get() == fires, ["fire"], || "wrong".into())
            })
            .step(
                "the control signal stands from the tick after fire or halt to the next arm",
                |now, next| {
                    let begun = now.w.fire.get() || now.i.halt.get() || now.q.control.get();
                    let control = begun && !now.i.arm.get();
                    require(next.control.get() == control, ["control"], || {
                        format!("{control} expected")
                    })
                },
            )
            .step("fire says from which side it came", |now, next| {
                let upward = match now.w.fire.get() {
                    true => now.q.side.get() == BELOW,
                    false => now.q.upward.get(),
                };
                require(next.upward.get() == upward, ["upward"], || {
                    format!("{upward} expected")
                })
            })
            .step("it is armed from the first arm on", |now, next| {
                let armed = now.q.armed.get() || now.i.arm.get();
                require(next.armed.get() == armed, ["armed"], || {
                    format!("{armed} expected")
                })
            })
            .step(
                "the side is that of the last look since arm",
                |now, next| {
                    let looks = now.i.evaluate.get() && now.i.valid.get() && now.q.armed.get();
                    let side = match (now.i.arm.get(), looks) {
                        (true, _) => UNKNOWN,
                        (false, false) => now.q.side.get(),
                        (false, true) => match now.w.difference.get().signum() {
                            -1 => BELOW,
                            0 => AT,
                            _ => ABOVE,
                        },
                    };
                    require(next.side.get() == side, ["side"], || {
                        format!("{side} expected")
                    })
                },
            )
    }
}
