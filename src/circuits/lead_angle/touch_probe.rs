//! Touch probe: latches the position at which the operation of the control signal took effect.
//!
//! ```text
//!                        ┌─────────────┐
//!  active, effect ──────▶│             ├──▶ taken
//!                        │ touch probe │
//!  position, present ───▶│             ├──▶ measured
//!                        └─────────────┘
//! ```
//!
//! A control signal need not stop the body (停止制御のみならず): it can start any operation while the body
//! moves on. A sensor then reports when the operation takes effect. At its rising edge the count of
//! the detector is latched, not a sample, which would be up to one CK older.

use crate::prelude::*;

/// Touch probe; `taken` and the latched count are valid in the tick after the rising edge of
/// `effect`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TouchProbe {
    /// Width of a position.
    pub position: usize,
}

signals! { for TouchProbe as c;
    /// Input ports.
    pub struct In {
        /// The control signal of an operation is active.
        pub active: Bit,
        /// High when the operation takes effect; synchronous to the clock.
        pub effect: Bit,
        /// Count of the detector.
        pub position: I(c.position),
        /// Dx: present sample.
        pub present: I(c.position),
    }
    /// Flip-flops.
    pub struct Reg {
        /// `effect` one tick ago.
        effect_before: Bit = 0,
        /// The operation has taken effect since the control signal.
        pub taken: Bit = 0,
        /// Count at the effect.
        latched: I(c.position) as Analog,
    }
    /// Nets.
    pub struct Net {
        /// The operation takes effect, for the first time since the control signal.
        comes: Bit,
        /// Position of the positioning: the count at the effect; before the effect, the present
        /// sample.
        pub measured: I(c.position) as Analog,
    }
}

impl Circuit for TouchProbe {
    const NAME: &'static str = "touch_probe";
    const ABOUT: &'static str = "latches the position at which an operation took effect";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let comes = i.effect & !q.effect_before & i.active & !q.taken;
        let edge = Reg {
            effect_before: i.effect,
            taken: (q.taken | comes) & i.active,
            latched: comes.mux(i.position, q.latched),
        };
        let measured = q.taken.mux(q.latched, i.present);
        (Net { comes, measured }, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let rises = i.effect & !q.effect_before;
        let first = i.active & !q.taken & rises;
        let taken = i.active & (q.taken | rises);
        let latched = next.latched.equals(first.mux(i.position, q.latched));
        let before = next.effect_before.equals(i.effect);
        vec![
            Property::step(
                "the first rise of effect while active is high stores the position in latched",
                &["taken", "latched"],
                next.taken.equals(taken) & latched & before,
            ),
            Property::always(
                "measured is latched after an effect, and the present position before it",
                &["measured"],
                w.measured.equals(q.taken.mux(q.latched, i.present)),
            ),
        ]
    }
}

impl Specified for TouchProbe {}
