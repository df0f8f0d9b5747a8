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
//! A level of the encoder that stands at the pin in tick n is in the feedback of a scan from tick
//! n + 3 on, and in the reference a tick after that scan.

use super::position_control;
use super::position_control::PositionControl;
use crate::blocks::{QuadratureCounter, quadrature_counter};
use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Instance};
use crate::logic::{Logic, Sim};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const G: usize> {
        /// Strobe: makes the speed reference from what stands there.
        pub scan: L::Bit,
        /// Position command in counts.
        pub command: L::I<P> as Analog,
        /// Channel A of the encoder, asynchronous.
        pub a: L::Bit,
        /// Channel B of the encoder, asynchronous.
        pub b: L::Bit,
        /// Feedback to 0, `lost` off.
        pub clear: L::Bit,
        /// Position gain, LSB of the D/A converter per count, with F fraction bits.
        pub gain: L::U<G>,
        /// In-position window in counts.
        pub window: L::U<P>,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, const P: usize, const D: usize> {
        /// Feedback counter 13.
        pub counter: quadrature_counter::Reg<L, P>,
        /// Position control 10–12.
        pub control: position_control::Reg<L, D>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<L, const P: usize, const G: usize, const F: usize, const D: usize, const R: usize> {
        /// Feedback counter 13.
        pub counter: Instance<QuadratureCounter<P>, L>,
        /// Position control 10–12.
        pub control: Instance<PositionControl<P, G, F, D, R>, L>,
        /// Speed reference N_ref, the word of the D/A converter.
        pub speed_ref: L::I<D> as Analog,
        /// The reference is at its limit.
        pub saturated: L::Bit,
        /// Command − feedback in counts.
        pub deviation: L::I<P> as Analog,
        /// The amount of the deviation is at most the window.
        pub in_position: L::Bit,
        /// Position of the motor in counts.
        pub feedback: L::I<P> as Analog,
        /// The encoder was too fast since `clear`: the feedback is wrong.
        pub lost: L::Bit,
    }
}

/// Position loop: positions of `P` bits, a gain of `G` bits of which `F` are its fraction, a D/A
/// converter of `D` bits. `R` is P + G, the width of the product.
#[derive(Debug, Clone, Default)]
pub struct PositionLoop<
    const P: usize = 32,
    const G: usize = 16,
    const F: usize = 8,
    const D: usize = 16,
    const R: usize = 48,
> {
    counter: QuadratureCounter<P>,
    control: PositionControl<P, G, F, D, R>,
}

impl<const P: usize, const G: usize, const F: usize, const D: usize, const R: usize> Circuit
    for PositionLoop<P, G, F, D, R>
{
    const NAME: &'static str = "position_loop";
    const ABOUT: &'static str = "position loop of one axis: encoder in, speed reference out";
    type In<L: Logic> = In<L, P, G>;
    type Reg<L: Logic> = Reg<L, P, D>;
    type Net<L: Logic> = Net<L, P, G, F, D, R>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, D>, i: &In<L, P, G>) -> Net<L, P, G, F, D, R> {
        let counter = Instance::settle(
            &self.counter,
            &q.counter,
            quadrature_counter::In {
                a: i.a,
                b: i.b,
                clear: i.clear,
            },
        );
        let control = Instance::settle(
            &self.control,
            &q.control,
            position_control::In {
                scan: i.scan,
                command: i.command,
                feedback: q.counter.position,
                gain: i.gain,
                window: i.window,
            },
        );
        Net {
            speed_ref: q.control.speed_ref,
            saturated: q.control.saturated,
            deviation: control.w.deviation,
            in_position: control.w.in_position,
            feedback: q.counter.position,
            lost: q.counter.lost,
            counter,
            control,
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, P, D>,
        w: &Net<L, P, G, F, D, R>,
        _: &In<L, P, G>,
    ) -> Reg<L, P, D> {
        Reg {
            counter: w.counter.next(&self.counter, q.counter),
            control: w.control.next(&self.control, q.control),
        }
    }
}

impl<const P: usize, const G: usize, const F: usize, const D: usize, const R: usize> Specified
    for PositionLoop<P, G, F, D, R>
{
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("a scan drives towards the command", |now, next| {
                let way = (now.i.command - now.q.counter.position).get();
                let (drive, gain) = (next.control.speed_ref.get(), now.i.gain.get());
                let right =
                    drive.signum() * way.signum() >= 0 && (way != 0 && gain != 0 || drive == 0);
                require(!now.i.scan.get() || right, ["speed_ref", "command"], || {
                    format!("{drive} to go {way}")
                })
            })
            .step("between scans the reference holds", |now, next| {
                let held = next.control.speed_ref == now.q.control.speed_ref;
                require(now.i.scan.get() || held, ["speed_ref", "scan"], || {
                    "changed by itself".into()
                })
            })
            .step(
                "clear makes the feedback 0 and takes the flag off",
                |now, next| {
                    let cleared = next.counter.position.get() == 0 && !next.counter.lost.get();
                    require(!now.i.clear.get() || cleared, ["feedback", "lost"], || {
                        "not cleared".into()
                    })
                },
            )
            .always("in position with a window of 0 is at the command", |now| {
                let there = now.i.command == now.q.counter.position;
                let said = now.w.in_position.get();
                let right = now.i.window.get() != 0 || said == there;
                require(right, ["in_position", "feedback"], || format!("{said}"))
            })
    }

    /// Of the windows 0 and 1 only: the others are those of the position control.
    fn applies(&self, i: &In<Sim, P, G>) -> bool {
        i.window.get() < 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::{Outcome, reach};

    #[test]
    fn it_is_proved() {
        let circuit = PositionLoop::<2, 2, 1, 2, 4>::default();
        let all = circuit.invariants();
        let outcome = reach(&circuit, &all).run().expect("narrow enough");
        assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
        println!("{outcome}");
    }
}
