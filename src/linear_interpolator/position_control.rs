//! Position control of one axis (¶0003): subtractor 10, gain 11, D/A converter 12.
//!
//! ```text
//!               ┌──────────────────┐
//!  scan ───────▶│                  ├──▶ speed_ref, saturated
//!  command ────▶│                  │
//!  feedback ───▶│ position control ├──▶ deviation
//!  gain ───────▶│                  │
//!  window ─────▶│                  ├──▶ in_position
//!               └──────────────────┘
//! ```
//!
//! In the tick of `scan` the deviation is multiplied by the gain, rounded, limited to the range of
//! the D/A converter and loaded into `speed_ref`, which shows it a tick later and holds it until
//! the next scan.
//!
//! The text has a gain and a D/A converter and says nothing of fraction bits, rounding or
//! saturation, and it has no in-position window. Here the product is rounded to nearest, halves
//! away from zero, and the range of the converter is symmetric, so that the loop does the same
//! in both directions.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const G: usize> {
        /// Loads the reference, and nothing else does.
        pub scan: L::Bit,
        /// Position command in counts.
        pub command: L::I<P> as Analog,
        /// Position of the motor in counts.
        pub feedback: L::I<P> as Analog,
        /// 11: position gain, LSB of the D/A converter per count, with F fraction bits.
        pub gain: L::U<G>,
        /// In-position window in counts.
        pub window: L::U<P>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const D: usize> {
        /// 12: speed reference, the word of the D/A converter; at most 2^(D−1) − 1 either way.
        pub speed_ref: L::I<D> as Analog = 0,
        /// The reference is at its limit.
        pub saturated: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize, const D: usize, const R: usize> {
        /// 10: command − feedback in counts, in every tick; wraps.
        pub deviation: L::I<P> as Analog,
        /// Amount of the deviation.
        distance: L::U<P>,
        /// 11: distance · gain and half an LSB of the D/A converter, with F fraction bits.
        product: L::U<R>,
        /// The product is at the limit or beyond.
        limited: L::Bit,
        /// Amount of the reference that a scan loads.
        amount: L::U<D>,
        /// 12: reference that a scan loads.
        limited_reference: L::I<D>,
        /// The amount of the deviation is at most the window, in every tick.
        pub in_position: L::Bit,
    }
}

/// Position control: positions of `P` bits, a gain of `G` bits of which `F` are its fraction, a
/// D/A converter of `D` bits. `R` is P + G, the width of the product.
#[derive(Debug, Clone, Default)]
pub struct PositionControl<
    const P: usize = 32,
    const G: usize = 16,
    const F: usize = 8,
    const D: usize = 16,
    const R: usize = 48,
>;

impl<const P: usize, const G: usize, const F: usize, const D: usize, const R: usize>
    PositionControl<P, G, F, D, R>
{
    /// Half an LSB of the D/A converter, in units of the product.
    const HALF: u64 = match F {
        0 => 0,
        _ => 1 << (F - 1),
    };
    /// The greatest reference.
    const LIMIT: u64 = {
        assert!(R == P + G, "R is the width of the product, P + G");
        assert!(R <= 64, "the product has at most 64 bits");
        assert!(F <= G, "the fraction is a part of the gain");
        assert!(
            D >= 2 && D <= R,
            "the D/A converter is no wider than the product"
        );
        (1 << (D - 1)) - 1
    };
}

impl<const P: usize, const G: usize, const F: usize, const D: usize, const R: usize> Circuit
    for PositionControl<P, G, F, D, R>
{
    const NAME: &'static str = "position_control";
    const ABOUT: &'static str = "speed reference from position command and feedback, by a gain";
    type In<L: Logic> = In<L, P, G>;
    type Reg<L: Logic> = Reg<L, D>;
    type Net<L: Logic> = Net<L, P, D, R>;

    fn comb<L: Logic>(&self, _: &Reg<L, D>, i: &In<L, P, G>) -> Net<L, P, D, R> {
        let deviation = i.command - i.feedback;
        let distance = deviation.magnitude();
        // Without its sign, so that halves go away from zero.
        let product = distance.times::<G, R>(i.gain) + Self::HALF;
        let limited = !product.below((Self::LIMIT << F).into());
        let rounded = product.shift_right(F).resize();
        let amount: L::U<D> = limited.mux(Self::LIMIT.into(), rounded);
        let upwards = amount.signed();
        Net {
            deviation,
            distance,
            product,
            limited,
            amount,
            limited_reference: deviation.is_negative().mux(-upwards, upwards),
            in_position: !i.window.below(distance),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, D>, w: &Net<L, P, D, R>, i: &In<L, P, G>) -> Reg<L, D> {
        Reg {
            speed_ref: i.scan.mux(w.limited_reference, q.speed_ref),
            saturated: i.scan.mux(w.limited, q.saturated),
        }
    }
}

impl<const P: usize, const G: usize, const F: usize, const D: usize, const R: usize> Specified
    for PositionControl<P, G, F, D, R>
{
    fn invariants(&self) -> Invariants<'_, Self> {
        let limit = (1i128 << (D - 1)) - 1;
        Invariants::<Self>::new()
            .always(
                "the deviation is the way to go, the short way round",
                |now| {
                    let deviation = i128::from(now.w.deviation.get());
                    let way = i128::from(now.i.command.get()) - i128::from(now.i.feedback.get());
                    let right = (way - deviation) % (1 << P) == 0;
                    require(right, ["deviation"], || format!("{deviation} for {way}"))
                },
            )
            .always("in position is at most the window away", |now| {
                let away = i128::from(now.w.deviation.get()).abs();
                let inside = away <= i128::from(now.i.window.get());
                require(now.w.in_position.get() == inside, ["in_position"], || {
                    format!("{away} away")
                })
            })
            .step(
                "a scan loads the nearest reference within the limits, halves away from zero",
                move |now, next| {
                    let gain = i128::from(now.i.gain.get());
                    let product = i128::from(now.w.deviation.get()) * gain;
                    let reference = i128::from(next.speed_ref.get());
                    // In units of the product: how far it is from the reference that it gets.
                    let short = product.abs() - (reference.abs() << F);
                    let nearest = 2 * short < 1 << F && 2 * short >= -(1 << F);
                    let cut = reference.abs() == limit && 2 * short >= -(1 << F);
                    let sign = reference == 0 || reference.signum() == product.signum();
                    let right = sign && reference.abs() <= limit && (nearest || cut);
                    require(!now.i.scan.get() || right, ["speed_ref"], || {
                        format!("{reference} for a product of {product}")
                    })
                },
            )
            .step("between scans the reference holds", |now, next| {
                let q = now.q;
                let same = next.speed_ref == q.speed_ref && next.saturated == q.saturated;
                require(now.i.scan.get() || same, ["speed_ref", "scan"], || {
                    "changed by itself".into()
                })
            })
            .always("saturated is at the limit", move |now| {
                let at_limit = i128::from(now.q.speed_ref.get()).abs() == limit;
                require(now.q.saturated.get() == at_limit, ["saturated"], || {
                    format!("at {}", now.q.speed_ref.get())
                })
            })
    }
}

#[cfg(test)]
mod tests;
