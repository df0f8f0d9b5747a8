//! Position loop of one axis (Fig. 2, ¶0003): feedback counter 13 and position control 10–12.
//!
//! ```text
//!               ┌───────────────┐
//!  scan ───────▶│               ├──▶ speed_ref, saturated
//!  command ────▶│               │
//!  a, b ───────▶│ position loop ├──▶ deviation, in_position
//!  clear ──────▶│               │
//!  gain ───────▶│               ├──▶ feedback, lost
//!  window ─────▶│               │
//!               └───────────────┘
//! ```
//!
//! A level of the encoder that is at the pin in tick n is in the feedback of a scan from tick n +
//! 3 on, and in the reference a tick after that scan.

use super::{LoopWidths, PositionControl, position_control};
use crate::circuits::blocks::{QuadratureCounter, quadrature_counter};
use crate::prelude::*;

/// Position loop.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PositionLoop {
    /// Word widths, by name.
    pub widths: LoopWidths,
}

signals! { for PositionLoop as c;
    /// Input ports.
    pub struct In {
        /// Strobe: computes the speed reference from the inputs of this tick.
        pub scan: Bit,
        /// Position command in counts.
        pub command: I(c.widths.position) as Analog,
        /// Channel A of the encoder, asynchronous.
        pub a: Bit,
        /// Channel B of the encoder, asynchronous.
        pub b: Bit,
        /// Clears `feedback` and `lost`.
        pub clear: Bit,
        /// Position gain, LSB of the D/A converter per count, with F fraction bits.
        pub gain: U(c.widths.gain),
        /// In-position window in counts.
        pub window: U(c.widths.position),
    }
    /// The circuits inside.
    pub struct Parts {
        /// Feedback counter 13.
        pub counter: Part<QuadratureCounter>(QuadratureCounter { width: c.widths.position }),
        /// Position control 10–12.
        pub control: Part<PositionControl>(PositionControl { widths: c.widths }),
    }
    /// Output ports.
    pub struct Net {
        /// Speed reference N_ref: word for the D/A converter.
        pub speed_ref: I(c.widths.converter) as Analog,
        /// The reference is at its limit.
        pub saturated: Bit,
        /// Command − feedback in counts.
        pub deviation: I(c.widths.position) as Analog,
        /// The magnitude of the deviation is at most the window.
        pub in_position: Bit,
        /// Position of the motor in counts.
        pub feedback: I(c.widths.position) as Analog,
        /// Both encoder channels have changed at once: the feedback is wrong; cleared by `clear`.
        pub lost: Bit,
    }
}

impl Circuit for PositionLoop {
    const NAME: &'static str = "position_loop";
    const ABOUT: &'static str = "position loop of one axis: encoder in, speed reference out";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let counter = p.counter.settle(quadrature_counter::In {
            a: i.a,
            b: i.b,
            clear: i.clear,
        });
        let control = p.control.settle(position_control::In {
            scan: i.scan,
            command: i.command,
            feedback: counter.q.position,
            gain: i.gain,
            window: i.window,
        });
        let net = Net {
            speed_ref: control.q.speed_ref,
            saturated: control.q.saturated,
            deviation: control.w.deviation,
            in_position: control.w.in_position,
            feedback: counter.q.position,
            lost: counter.q.lost,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, w, counter) = (&now.i, &now.w, &now.p.counter.q);
        let cleared = &now.next.p.counter.q;
        let drive = now.next.p.control.q.speed_ref;
        let way = i.command - counter.position;
        let moves = !way.is_zero() & !i.gain.is_zero();
        let towards = moves & drive.is_negative().equals(way.is_negative());
        let there = counter.position.equals(i.command);
        vec![
            Property::step(
                "a scan sets speed_ref towards the command, and to 0 at the command",
                &["speed_ref", "command"],
                i.scan.implies(drive.is_zero() | towards),
            ),
            Property::step(
                "between scans, speed_ref keeps its value",
                &["speed_ref", "scan"],
                i.scan | drive.equals(now.p.control.q.speed_ref),
            ),
            Property::step(
                "clear sets feedback to 0 and resets lost",
                &["feedback", "lost"],
                i.clear.implies(cleared.position.is_zero() & !cleared.lost),
            ),
            Property::always(
                "with a window of 0, in_position is high if and only if feedback equals command",
                &["in_position", "feedback"],
                i.window.is_zero().implies(w.in_position.equals(there)),
            ),
        ]
    }
}

impl Specified for PositionLoop {
    /// Windows 0 and 1 only: the others are those of the position control.
    fn applies(&self, i: &In<Value>) -> bool {
        i.window < 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_proved() {
        let widths = LoopWidths {
            position: 2,
            gain: 2,
            fraction: 1,
            converter: 2,
        };
        let circuit = PositionLoop { widths };
        let all = circuit.invariants();
        let outcome = reach(&circuit, &all).run().expect("narrow enough");
        assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
        println!("{outcome}");
    }
}
