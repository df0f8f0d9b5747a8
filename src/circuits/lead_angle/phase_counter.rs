//! Phase counter: the carrier of a phase-shift transducer, and the place in a pitch by its
//! secondary. Part of position detector 10 of JPH0646367B2.
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
//! Two primaries are excited by sine and cosine of `phase`, and the secondary gives
//! sin(phase − place): it crosses zero upwards when the carrier has come to the place in the pitch.
//! The phase of that tick is latched, and taken at the next 0 phase, as the text has it (1次コイルを励磁
//! する基準交流信号の0位相毎に). A pitch has as many counts as the carrier has ticks.
//!
//! The secondary goes through two flip-flops, and the phase that a crossing is given is the one of two
//! ticks ago. A crossing at 0 phase is of the period that begins with it.
//!
//! Departures: a moving body shifts the secondary's frequency, so that around the end of a pitch a
//! period of the carrier has none or two crossings, however slow the body is. Therefore the
//! secondary's own period is monitored: a crossing within 3/4 of the carrier's period since the
//! one before, and none within 5/4, are faults, and such a sample is not taken for a place.

use crate::prelude::*;

/// Phase counter. A crossing at the pin in tick n is latched in n + 3; a period's place is taken two
/// ticks after 0 phase.
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
        /// The secondary is above zero: a comparator with hysteresis, asynchronous.
        pub secondary: Bit,
        /// M: ticks of the carrier's period, and counts of a pitch; 0 for 2^phase. 4 at least.
        pub modulus: U(c.phase),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Phase of the carrier, for the D/A converters of the primaries.
        pub phase: U(c.phase) as Analog = 0,
        /// The last three levels of the secondary, the newest in bit 0, which is the flip-flop at the
        /// pin. High at power-on, so that a crossing has a low level before it.
        sync_secondary: U(3) as Hex = 7,
        /// The place in the pitch: the phase of the last crossing.
        pub place: U(c.phase) as Analog = 0,
        /// Ticks since the last crossing; stops where it is overdue.
        elapsed: U(c.phase + 1) as Analog = 0,
        /// There was a crossing since power-on.
        crossed: Bit,
        /// A crossing since the last 0 phase was too soon, or there was none for too long.
        pub fault: Bit,
    }
    /// Nets.
    pub struct Net {
        /// Ticks of the carrier, with room for all of them.
        counts: U(c.phase + 1),
        /// A quarter of them.
        quarter: U(c.phase + 1),
        /// `phase + 1`: ticks of the period that are over after this one.
        next_phase: U(c.phase + 1),
        /// The phase of the carrier when the observed level was at the pin.
        seen_phase: U(c.phase),
        /// The carrier is in the first half of its period: a square wave in phase with its sine.
        pub square_wave: Bit,
        /// The secondary crosses zero upwards.
        crossing: Bit,
        /// The crossing is too early.
        early: Bit,
        /// The crossing is overdue.
        late: Bit,
        /// The period ends.
        zero: Bit,
        /// A place is taken.
        pub take: Bit,
    }
}

impl Circuit for PhaseCounter {
    const NAME: &'static str = "phase_counter";
    const ABOUT: &'static str = "place in a pitch from the phase of a secondary, and its carrier";
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
}

impl Specified for PhaseCounter {
    /// Excludes moduli of 1 to 3, which are not allowed.
    fn applies(&self, i: &In<Value>) -> bool {
        i.modulus == 0 || i.modulus >= 4
    }

    fn invariants(&self) -> Invariants<'_, Self> {
        let counts = {
            let all = 1i64 << self.phase;
            move |modulus: u64| if modulus == 0 { all } else { modulus as i64 }
        };
        let crosses = |q: &Reg<Value>| q.sync_secondary >> 1 & 3 == 1;
        Invariants::<Self>::new()
            .step(
                "the phase goes round the carrier's period",
                move |now, next| {
                    let (phase, counts) = (now.q.phase as i64, counts(now.i.modulus));
                    // A period that was cut short is over.
                    let expected = if phase >= counts {
                        0
                    } else {
                        (phase + 1) % counts
                    };
                    let first = 2 * phase < counts - counts % 2;
                    let right = next.q.phase as i64 == expected && now.w.square_wave == first;
                    require(right, ["phase", "square_wave"], || {
                        format!("{phase} of {counts}")
                    })
                },
            )
            .step(
                "a crossing takes the phase of two ticks ago",
                move |now, next| {
                    let (q, counts) = (now.q, counts(now.i.modulus));
                    let phase = q.phase as i64;
                    let expected = match (crosses(q), phase >= counts) {
                        (false, _) => q.place as i64,
                        (true, true) => phase - 2,
                        (true, false) => (phase + counts - 2) % counts,
                    };
                    let right = next.q.place as i64 == expected
                        && next.q.crossed == (q.crossed || crosses(q))
                        && next.q.sync_secondary
                            == (q.sync_secondary << 1 & 7 | u64::from(now.i.secondary));
                    let signals = ["place", "crossed", "sync_secondary"];
                    require(right, signals, || format!("not {expected}"))
                },
            )
            .step(
                "a period of the secondary has 3/4 to 5/4 of the carrier's, or is at fault",
                move |now, next| {
                    let (q, counts) = (now.q, counts(now.i.modulus));
                    let elapsed = 4 * q.elapsed as i64;
                    let late = elapsed > 5 * counts;
                    let wrong = late || (crosses(q) && q.crossed && elapsed < 3 * counts);
                    let expected = match (crosses(q), late) {
                        (true, _) => 1,
                        (false, true) => q.elapsed,
                        (false, false) => q.elapsed + 1,
                    };
                    // The observed level was at the pin two ticks ago.
                    let ends = q.phase == 2;
                    let right = next.q.elapsed == expected
                        && next.q.fault == (wrong || (q.fault && !ends))
                        && now.w.take == (ends && (q.crossed || q.fault));
                    require(right, ["elapsed", "fault", "take"], || {
                        format!("{expected}")
                    })
                },
            )
    }
}
