//! Count law as a circuit that can be proved: unit time after unit time, each with its own
//! half-period and T, and ghost registers, which exist for the proof only.
//!
//! ```text
//!                ┌──────────┐
//!  half_period ─▶│ unit law ├──▶ step
//!  period ──────▶│          │
//!                └──────────┘
//! ```

use super::{PulseGenerator, SyncStage, Variant, counts, pulse_generator, sync_stage};
use crate::circuits::blocks::{EnableCounter, enable_counter};
use crate::prelude::*;

/// Sequence of unit times with arbitrary half-period and T.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnitLaw {
    /// Width of half-period and T in bits.
    pub width: usize,
    /// Registers that RST clears.
    pub variant: Variant,
}

signals! { for UnitLaw as c;
    /// Input ports.
    pub struct In {
        /// Half-period of the next unit time; sampled in the tick of RST only.
        pub half_period: U(c.width),
        /// T of the next unit time; sampled in the tick of RST only.
        pub period: U(c.width),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Half-period of the current unit time, in ticks.
        held_half_period: U(c.width),
        /// T of the current unit time, in ticks.
        held_period: U(c.width) = 1,
        /// Ghost: pulses of the current unit time before this tick.
        pulses: U(c.width),
        /// Ghost: level of `step` one tick ago; low in the first tick of a unit time.
        lagged: Bit,
        /// Ghost: whole half-periods of the current unit time before this tick; 0 if the half-period
        /// is 0.
        toggles: U(c.width),
        /// Ghost: ticks since the last of them.
        rest: U(c.width),
    }
    /// The circuits inside.
    pub struct Parts {
        /// Unit-time counter 30.
        pub counter: Part<EnableCounter>(EnableCounter { width: c.width }),
        /// Pulse generator 20.
        pub generator: Part<PulseGenerator>(PulseGenerator { width: c.width, variant: c.variant }),
        /// Sync stage 40.
        pub sync: Part<SyncStage>(SyncStage {}),
    }
    /// Nets.
    pub struct Net {
        /// Ghost: pulses of the current unit time, including this tick.
        counted: U(c.width),
        /// Ghost: a half-period ends with this tick.
        ends: Bit,
        /// Step pulses.
        pub step: Bit,
    }
}

impl Circuit for UnitLaw {
    const NAME: &'static str = "unit_law";
    const ABOUT: &'static str =
        "unit times with arbitrary half-period and T, and a ghost pulse counter";
    records!(In, Reg, Net, Parts);

    fn tick(&self, i: In, q: Reg, p: Parts) -> (Net, Reg<Edge>) {
        let period = q.held_period;
        let counter = p.counter.settle(enable_counter::In { period });
        let unit_rst = counter.w.enable;
        let half_period = q.held_half_period;
        let generator = p.generator.settle(pulse_generator::In {
            half_period,
            unit_rst,
        });
        let pulse = generator.w.pulse;
        let sync = p.sync.settle(sync_stage::In { pulse, unit_rst });
        let step = sync.q.step;
        let counted = (step & !q.lagged).mux(q.pulses + 1, q.pulses);
        let ends = (q.rest + 1).equals(half_period);
        let toggles = ends.mux(q.toggles + 1, q.toggles);
        let next = Reg {
            held_half_period: unit_rst.mux(i.half_period, half_period),
            held_period: unit_rst.mux(i.period, period),
            pulses: unit_rst.mux(0, counted),
            lagged: !unit_rst & step,
            toggles: unit_rst.mux(0, toggles),
            rest: (unit_rst | ends).mux(0, q.rest + 1),
        };
        let net = Net {
            counted,
            ends,
            step,
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (q, w, next) = (&now.q, &now.w, &now.next.q);
        let (counter, generator) = (&now.p.counter, &now.p.generator.q);
        let elapsed = counter.q.count;
        let half_period = q.held_half_period;
        let none = q.held_period.is_zero();
        let end = none.mux(0, q.held_period - 1);
        let still = half_period.is_zero();

        // Quotient and rest of the elapsed ticks and the half-period, step by step.
        let whole = elapsed - q.rest;
        let next_whole = now.next.p.counter.q.count - next.rest;
        let from_zero = next.toggles.is_zero() & next_whole.is_zero();
        let one_more = next.toggles.equals(q.toggles + 1) & next_whole.equals(whole + half_period);
        let stays = next.toggles.equals(q.toggles) & next_whole.equals(whole);
        let steps = counter.w.enable.mux(from_zero, one_more | stays);
        let divided = still.mux(
            q.toggles.is_zero() & whole.is_zero(),
            q.rest.below(half_period) & !elapsed.below(q.rest) & !whole.below(q.toggles),
        );
        // The step signal toggles at each multiple of the half-period; every other toggle is a
        // rising edge.
        let rises = (q.toggles + 1).shift_right(1);
        let is_at = still.mux(
            generator.count.is_zero() & !generator.toggle,
            generator.count.equals(q.rest) & generator.toggle.equals(q.toggles.bit(0)),
        );
        vec![
            Property::always(
                "the number of pulses in a unit time obeys the count law",
                &["step", "counter.enable", "counted"],
                counter.w.enable.implies(w.counted.equals(rises)),
            ),
            Property::always(
                "step is low in the first tick of a unit time",
                &["step", "counter.count"],
                elapsed.is_zero().implies(!w.step),
            ),
            Property::always(
                "count, toggle and step depend only on the half-period and the ticks since RST",
                &["generator.count", "generator.toggle", "step"],
                is_at & w.step.equals(generator.toggle),
            ),
            Property::always(
                "a unit time has T ticks",
                &["counter.count", "counter.enable"],
                counter.w.enable.equals(elapsed.equals(end)),
            ),
            Property::step(
                "toggles counts half-periods, and the ticks up to the rest grow by one with each",
                &["toggles", "rest"],
                steps,
            ),
            Property::always(
                "rest is below the half-period, and toggles at most the other ticks since RST",
                &["rest", "toggles"],
                divided,
            ),
            Property::helper(
                "the number of pulses so far obeys the count law",
                &["counted", "toggles"],
                w.counted.equals(rises),
            ),
        ]
    }
}

impl UnitLaw {
    /// The count law alone, which the literal variant violates with valid data.
    pub fn count_law(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new().always(
            "the number of pulses in a unit time obeys the count law",
            |now| {
                let (n, period) = (now.q.held_half_period, now.q.held_period.max(1));
                let law = counts::pulses(n as u32, period as u32);
                let count = now.w.counted;
                let right = !now.p.counter.w.enable || count == u64::from(law);
                require(right, ["step", "counter.enable", "counted"], || {
                    format!("{count} pulses with n = {n} and T = {period}, the law says {law}")
                })
            },
        )
    }
}

impl Specified for UnitLaw {}
