//! Tracking loop: follows the angle of a resolver's windings, with its speed. Part of position
//! detector 10 of JPH0646367B2.
//!
//! ```text
//!               ┌───────────────┐
//!  done ───────▶│               ├──▶ phase ──▶ CORDIC
//!  quadrature ─▶│ tracking loop ├──▶ speed
//!  in_phase ───▶│               ├──▶ take, fault
//!               └───────────────┘
//! ```
//!
//! The loop is of type II. The windings, rotated back by the loop's angle φ, are a·sin(θ − φ),
//! which is the error, and a·cos(θ − φ), where a is the amplitude. Once per conversion the error is
//! integrated into a speed, and the speed plus a multiple of the error into the angle. All words
//! are fractions of a pitch and wrap with it.
//!
//! The error is rounded to a word whose unit is larger than that of the angle. So there is always
//! an angle at which the error is 0, and for a body at rest the angle rests too.
//!
//! Beyond a quarter of a pitch the sine decreases again, to 0 at half a pitch, where the loop would
//! stop. So where the cosine is negative, its magnitude is added: the error grows on to 1.41·a, and
//! is a at half a pitch. There the loop moves upwards.
//!
//! Departures: the text has no such loop. The first conversions after power-on let the loop settle,
//! and no place is taken from them.

use crate::prelude::*;

/// Tracking loop. The result of a conversion is in `phase` from the tick after `done` on, for the
/// next one.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrackingLoop {
    /// A: width of an angle, in units of 2^−A pitch.
    pub angle: usize,
    /// G: how often the loop's bandwidth is halved.
    pub smoothing: usize,
    /// Width of a number of conversions: 2^settling − 1 settle the loop.
    pub settling: usize,
}

/// Bits by which the error is rounded.
const ROUNDED: usize = 4;

impl TrackingLoop {
    /// Creates the loop of a detector for angles of this width: at 17 bits its bandwidth is halved
    /// twice, and 255 conversions settle it.
    #[must_use]
    pub const fn new(angle: usize) -> Self {
        TrackingLoop {
            angle,
            smoothing: angle / 8,
            settling: angle / 2,
        }
    }

    /// Width of the output of the CORDIC: full scale is 2^(A − 1), times √2 and its gain.
    #[must_use]
    pub const fn vector(&self) -> usize {
        self.angle + 2
    }

    /// Bits of the phase below the angle.
    #[must_use]
    pub const fn fraction(&self) -> usize {
        2 * self.smoothing
    }

    /// Width of phase and speed.
    #[must_use]
    pub const fn phase(&self) -> usize {
        self.angle + self.fraction()
    }

    /// The least a·cos(θ − φ): of an amplitude of 0.30 of full scale at the angle.
    const fn least(&self) -> i64 {
        1 << self.angle.saturating_sub(2)
    }

    /// Returns the error, rounded, in the width of a phase. No bit is lost on the way.
    fn rounded(&self, i: &In) -> I {
        let exact = |word: I| word.resize(self.vector() + 2);
        let (sine, cosine) = (exact(i.quadrature), exact(i.in_phase));
        let beyond = sine.is_negative().mux(sine + cosine, sine - cosine);
        let error = cosine.is_negative().mux(beyond, sine);
        (error + 8).shift_right(4).resize(self.phase())
    }
}

signals! { for TrackingLoop as c;
    /// Input ports.
    pub struct In {
        /// The CORDIC has a result: `quadrature` and `in_phase` are valid.
        pub done: Bit,
        /// a·sin(θ − φ), times the CORDIC's gain. The magnitudes of `quadrature` and `in_phase` add
        /// up to less than 2^(A + 1).
        pub quadrature: I(c.vector()) as Analog,
        /// a·cos(θ − φ), times the CORDIC's gain.
        pub in_phase: I(c.vector()) as Analog,
    }
    /// Flip-flops.
    pub struct Reg {
        /// φ, in units of 2^−(A + 2·G) pitch; wraps. The upper A bits are the angle.
        pub phase: U(c.phase(), c.phase()) as Analog = 0,
        /// Change of the phase per conversion, in units of 2^−(A + 2·G) pitch; wraps.
        pub speed: I(c.phase(), c.phase()) as Analog = 0,
        /// Conversions since power-on; stops at its greatest value.
        settled: U(c.settling) = 0,
    }
    /// Nets.
    pub struct Net {
        /// The error is beyond a quarter of a pitch.
        beyond: Bit,
        /// Error that keeps growing beyond a quarter of a pitch.
        folded: I(c.vector()),
        /// `folded` plus half a unit of `error`.
        raised: I(c.vector() + 1),
        /// `folded`, rounded.
        error: I(c.angle.saturating_sub(1)) as Analog,
        /// Speed plus error.
        next_speed: I(c.phase()),
        /// Part of the angle's change that is proportional to the error.
        proportional: I(c.phase()),
        /// The angle with which the conversion began is taken as a place.
        pub take: Bit,
        /// The angle is invalid: there is no signal, or the loop is not locked.
        pub fault: Bit,
    }
}

impl Circuit for TrackingLoop {
    const NAME: &'static str = "tracking_loop";
    const ABOUT: &'static str = "angle and speed of a resolver, tracked by the angle error";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        (self.angle < 4).then(|| "an angle has 4 bits at least, or no error is a unit".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let wide = self.phase();
        let beyond = i.in_phase.is_negative();
        let amount = i.in_phase.negated_by(!i.quadrature.is_negative());
        let folded = i.quadrature + beyond.mux(amount, I::new(0, self.vector()));
        let half = 1 << (ROUNDED - 1);
        let raised = folded.resize(self.vector() + 1) + half;
        let error = raised.shift_right(ROUNDED).resize(self.angle - 1);
        let next_speed = q.speed + error.resize(wide);
        let proportional = error.resize(wide).shift_left(self.smoothing + 2);
        let over = (!q.settled).is_zero();
        let net = Net {
            beyond,
            folded,
            raised,
            error,
            next_speed,
            proportional,
            take: i.done & over,
            fault: i.in_phase.below(self.least()),
        };
        let turned = q.phase + (next_speed + proportional).unsigned();
        let next = Reg {
            phase: i.done.mux(turned, q.phase),
            speed: i.done.mux(next_speed, q.speed),
            settled: (i.done & !over).mux(q.settled + 1, q.settled),
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let (error, done) = (w.error.resize(self.phase()), i.done);
        let speed = q.speed + error;
        let gained = error.shift_left(2 + self.smoothing);
        let phase = q.phase + (speed + gained).unsigned();
        let moved = next.speed.equals(speed) & next.phase.equals(phase);
        let stays = next.speed.equals(q.speed) & next.phase.equals(q.phase);

        let over = q.settled.equals(u64::MAX.cut(self.settling));
        let counts = (done & !over).mux(q.settled + 1, q.settled);
        let small = i.in_phase.below(1i64 << (self.angle - 2));
        let length = i.quadrature.magnitude().plus(i.in_phase.magnitude());
        vec![
            Property::always(
                "the error is quadrature with the magnitude of a negative in_phase, rounded",
                &["error"],
                error.equals(self.rounded(i)),
            ),
            Property::step(
                "only a conversion changes speed and phase, and it corrects them by the error",
                &["speed", "phase"],
                done.mux(moved, stays),
            ),
            Property::step(
                "take is high with done once settled, and fault while in_phase is too small",
                &["take", "settled", "fault"],
                w.take.equals(done & over) & next.settled.equals(counts) & w.fault.equals(small),
            ),
            // Each winding is at most full scale, 2^(A − 1), and the gain of the CORDIC below 2.
            Property::given(
                "the magnitudes of quadrature and in_phase add up to less than 2^(angle + 1)",
                length.below(2u64 << self.angle),
            ),
        ]
    }
}

impl Specified for TrackingLoop {}
