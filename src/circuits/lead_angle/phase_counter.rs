//! Phase counter: generates the carrier of a phase-shift transducer, and measures the place in a
//! pitch by the phase of the secondary. Part of position detector 10 of JPH0646367B2.
//!
//! ```text
//!             ┌───────────────┐
//!             │               ├──▶ phase, square_wave
//!  secondary ▶│ phase counter ├──▶ take
//!  modulus ──▶│               ├──▶ place
//!             │               ├──▶ fault
//!             └───────────────┘
//! ```
//!
//! Two primaries are excited by sine and cosine of `phase`, and the secondary outputs sin(phase −
//! place): it crosses zero upwards when the phase equals the place in the pitch. The phase of that
//! tick is latched, and taken at the next 0 phase, as in the text (1次コイルを励磁する基準交流信号の0位相毎に). A pitch
//! has as many counts as the carrier period has ticks.
//!
//! The secondary goes through two flip-flops, so a crossing gets the phase of two ticks ago. A
//! crossing at 0 phase belongs to the period that begins with it.
//!
//! Departures: a moving body shifts the secondary's frequency, so near the end of a pitch a carrier
//! period can have no crossing or two, however slow the body is. Therefore the period of the
//! secondary is monitored. A crossing less than 3/4 of the carrier period after the last one is a
//! fault, and so is none within 5/4. Such a sample is not taken as a place.

use crate::prelude::*;

/// Phase counter. A crossing at the pin in tick n is latched in tick n + 3; the place of a period
/// is taken two ticks after 0 phase.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PhaseCounter {
    /// Width of a phase.
    pub phase: usize,
}

/// Ticks from the pin to where a crossing is seen.
const SEEN: u64 = 2;

signals! { for PhaseCounter as c;
    /// Input ports.
    pub struct In {
        /// Secondary above zero, from a comparator with hysteresis; asynchronous.
        pub secondary: Bit,
        /// M: ticks of the carrier period, and counts of a pitch; at least 4, or 0 for 2^phase.
        pub modulus: U(c.phase),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Phase of the carrier, for the D/A converters of the primaries.
        pub phase: U(c.phase) as Analog = 0,
        /// Last three samples of the secondary, the newest in bit 0, which is the flip-flop at the
        /// pin. High at power-on, so that the first crossing has a low level before it.
        sync_secondary: U(3) as Hex = 7,
        /// Place in the pitch: phase of the last crossing.
        pub place: U(c.phase) as Analog = 0,
        /// Ticks since the last crossing; stops when the crossing is overdue.
        elapsed: U(c.phase + 1) as Analog = 0,
        /// A crossing has come since power-on.
        crossed: Bit,
        /// Since the last 0 phase, a crossing came too early or was overdue.
        pub fault: Bit,
    }
    /// Nets.
    pub struct Net {
        /// Ticks of the carrier period, 2^phase where `modulus` is 0.
        counts: U(c.phase + 1),
        /// Quarter of the carrier period, in ticks.
        quarter: U(c.phase + 1),
        /// `phase + 1`: ticks of the period, including this one.
        next_phase: U(c.phase + 1),
        /// Phase of the carrier when the present level was at the pin.
        seen_phase: U(c.phase),
        /// Square wave in phase with the carrier's sine: high in the first half of the period.
        pub square_wave: Bit,
        /// The secondary crosses zero upwards.
        crossing: Bit,
        /// The crossing is too early.
        early: Bit,
        /// The crossing is overdue.
        late: Bit,
        /// The period ends, for the levels that are seen now.
        zero: Bit,
        /// A place is taken.
        pub take: Bit,
    }
}

impl Circuit for PhaseCounter {
    const NAME: &'static str = "phase_counter";
    const ABOUT: &'static str = "place in a pitch from the secondary's phase; makes the carrier";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        (self.phase < 2).then(|| "a phase has 2 bits at least".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let n = self.phase;
        let counts = i.modulus.is_zero().word().join(i.modulus);
        let quarter = counts.shift_right(2);
        let next_phase = q.phase.resize(n + 1) + 1;
        let seen_phase = q.phase - SEEN;
        let seen_phase = q.phase.below(SEEN).mux(seen_phase + i.modulus, seen_phase);
        let crossing = q.sync_secondary.bit(1) & !q.sync_secondary.bit(2);
        let early = crossing & q.crossed & q.elapsed.below(counts - quarter);
        let late = (counts + quarter).below(q.elapsed);
        let zero = seen_phase.is_zero();
        let net = Net {
            counts,
            quarter,
            next_phase,
            seen_phase,
            square_wave: q.phase.below_any(counts.shift_right(1)),
            crossing,
            early,
            late,
            zero,
            take: zero & (q.crossed | q.fault),
        };
        let after = Reg {
            phase: next_phase.below(counts).mux(next_phase.resize(n), 0),
            sync_secondary: q.sync_secondary.resize(2).join(i.secondary.word()),
            place: crossing.mux(seen_phase, q.place),
            elapsed: crossing.mux(1, late.mux(q.elapsed, q.elapsed + 1)),
            crossed: q.crossed | crossing,
            fault: (q.fault & !zero) | early | late,
        };
        (net, after)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let counts = self.counts(now.i.modulus);
        vec![
            Property::step(
                "phase counts through the carrier's period, square_wave is high in its first half",
                &["phase", "square_wave"],
                self.carrier(now, counts),
            ),
            Property::step(
                "a rise of the secondary stores the phase of two ticks ago in place",
                &["place", "crossed", "sync_secondary"],
                self.stored(now, counts),
            ),
            Property::step(
                "a secondary period below 3/4 or above 5/4 of the carrier's sets fault",
                &["elapsed", "fault", "take"],
                self.monitored(now, counts),
            ),
            Property::given("modulus is 0 or at least 4", !counts.below(4)),
        ]
    }
}

/// Statements of the properties; `counts` are the ticks of the carrier period.
impl PhaseCounter {
    /// Returns the ticks of the carrier period.
    fn counts(&self, modulus: U) -> U {
        let wide = self.phase + 1;
        let all = U::new(1 << self.phase, wide);
        modulus.is_zero().mux(all, modulus.resize(wide))
    }

    /// High if the phase counts through the period, with the square wave high in the first half.
    fn carrier(&self, now: &Moment<Self>, counts: U) -> Bit {
        let phase = now.q.phase.resize(self.phase + 1);
        // A period that was cut short is over.
        let ends = !(phase + 1).below(counts);
        let next = now.next.q.phase.resize(self.phase + 1);
        let even = counts.shift_right(1).shift_left(1);
        let first_half = phase.shift_left(1).below(even);
        next.equals(ends.mux(0, phase + 1)) & now.w.square_wave.equals(first_half)
    }

    /// High if a crossing, and nothing else, stores the phase of two ticks ago.
    fn stored(&self, now: &Moment<Self>, counts: U) -> Bit {
        let (q, next, wide) = (&now.q, &now.next.q, self.phase + 1);
        let crosses = crosses(q.sync_secondary);
        let phase = q.phase.resize(wide);
        let seen = phase.below(SEEN).mux(phase + counts, phase) - SEEN;
        let place = crosses.mux(seen, q.place.resize(wide));
        let crossed = next.crossed.equals(q.crossed | crosses);
        let levels = q.sync_secondary.slice(0, 2).join(now.i.secondary.word());
        let passed = next.sync_secondary.equals(levels);
        next.place.resize(wide).equals(place) & crossed & passed
    }

    /// High if the period of the secondary is measured, and a wrong one sets `fault`.
    fn monitored(&self, now: &Moment<Self>, counts: U) -> Bit {
        let (q, w, next) = (&now.q, &now.w, &now.next.q);
        let crosses = crosses(q.sync_secondary);
        // Ticks are more than a quarter of the period if they are more than its whole ticks.
        let quarter = counts.shift_right(2);
        let late = (counts + quarter).below(q.elapsed);
        let early = crosses & q.crossed & q.elapsed.below(counts - quarter);
        let elapsed = crosses.mux(1, late.mux(q.elapsed, q.elapsed + 1));
        // The observed level was at the pin two ticks ago.
        let ends = q.phase.equals(SEEN);
        let fault = early | late | (q.fault & !ends);
        let takes = ends & (q.crossed | q.fault);
        let measured = next.elapsed.equals(elapsed);
        measured & next.fault.equals(fault) & w.take.equals(takes)
    }
}

/// High if the synchronized secondary rises.
fn crosses(sync_secondary: U) -> Bit {
    sync_secondary.slice(1, 2).equals(0b01)
}

impl Specified for PhaseCounter {}
