//! Enables: the block of counters that every slower rate of the machine comes from.
//!
//! ```text
//!                  ┌─────────┐
//!  unit_period ───▶│         ├──▶ unit
//!  scan_period ───▶│ enables ├──▶ scan
//!  ck_period ─────▶│         ├──▶ ck, ck_led
//!  sample_period ─▶│         ├──▶ sample, sample_led
//!                  └─────────┘
//! ```
//!
//! A circuit with an enable counter of its own is led by its period port: a period of 0 ends its
//! period in this tick, one of all ones never does before ours.

use crate::blocks::{EnableCounter, enable_counter};
use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Instance};
use crate::logic::{Bit, Logic};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const W: usize> {
        /// T: ticks of a unit time; 0 counts as 1, as in the others.
        pub unit_period: L::U<W>,
        /// Ticks of a scan.
        pub scan_period: L::U<W>,
        /// Ticks of CK.
        pub ck_period: L::U<W>,
        /// Ts: ticks of a sampling time.
        pub sample_period: L::U<W>,
    }
}

signals! {
    /// Registers of the counters.
    pub struct Reg<L, const W: usize> {
        /// Of the unit time.
        pub unit_counter: enable_counter::Reg<L, W>,
        /// Of the scan.
        pub scan_counter: enable_counter::Reg<L, W>,
        /// Of CK.
        pub ck_counter: enable_counter::Reg<L, W>,
        /// Of Ts.
        pub sample_counter: enable_counter::Reg<L, W>,
    }
}

signals! {
    /// Nets of the counters, and the ports out.
    pub struct Net<L, const W: usize> {
        /// Of the unit time.
        pub unit_counter: Instance<EnableCounter<W>, L>,
        /// Of the scan.
        pub scan_counter: Instance<EnableCounter<W>, L>,
        /// Of CK.
        pub ck_counter: Instance<EnableCounter<W>, L>,
        /// Of Ts.
        pub sample_counter: Instance<EnableCounter<W>, L>,
        /// The unit time ends.
        pub unit: L::Bit,
        /// A scan begins.
        pub scan: L::Bit,
        /// CK.
        pub ck: L::Bit,
        /// A sampling time begins.
        pub sample: L::Bit,
        /// Period of a counter that CK leads.
        pub ck_led: L::U<W>,
        /// Period of a counter that Ts leads.
        pub sample_led: L::U<W>,
    }
}

/// Four enable counters of `W` bits. Periods up to 2^`W` − 1 ticks, in any ratio; all begin at
/// power-on.
#[derive(Debug, Clone, Default)]
pub struct Enables<const W: usize = 24> {
    /// The counter, four times.
    pub counter: EnableCounter<W>,
}

impl<const W: usize> Circuit for Enables<W> {
    const NAME: &'static str = "enables";
    const ABOUT: &'static str = "unit time, scan, CK and Ts from one block of counters";
    type In<L: Logic> = In<L, W>;
    type Reg<L: Logic> = Reg<L, W>;
    type Net<L: Logic> = Net<L, W>;

    fn comb<L: Logic>(&self, q: &Reg<L, W>, i: &In<L, W>) -> Net<L, W> {
        let counter = |registers, period| {
            Instance::settle(&self.counter, registers, enable_counter::In { period })
        };
        let unit_counter = counter(&q.unit_counter, i.unit_period);
        let scan_counter = counter(&q.scan_counter, i.scan_period);
        let ck_counter = counter(&q.ck_counter, i.ck_period);
        let sample_counter = counter(&q.sample_counter, i.sample_period);
        let led = |enable: L::Bit| enable.mux(0.into(), u64::MAX.into());
        Net {
            unit: unit_counter.w.enable,
            scan: scan_counter.w.enable,
            ck: ck_counter.w.enable,
            sample: sample_counter.w.enable,
            ck_led: led(ck_counter.w.enable),
            sample_led: led(sample_counter.w.enable),
            unit_counter,
            scan_counter,
            ck_counter,
            sample_counter,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, W>, w: &Net<L, W>, _: &In<L, W>) -> Reg<L, W> {
        Reg {
            unit_counter: w.unit_counter.next(&self.counter, q.unit_counter),
            scan_counter: w.scan_counter.next(&self.counter, q.scan_counter),
            ck_counter: w.ck_counter.next(&self.counter, q.ck_counter),
            sample_counter: w.sample_counter.next(&self.counter, q.sample_counter),
        }
    }
}

impl<const W: usize> Specified for Enables<W> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "a counter begins anew after its own enable, and after no other",
                |now, next| {
                    let (q, w) = (now.q, now.w);
                    let counters = [
                        (&q.unit_counter, w.unit, &next.unit_counter),
                        (&q.scan_counter, w.scan, &next.scan_counter),
                        (&q.ck_counter, w.ck, &next.ck_counter),
                        (&q.sample_counter, w.sample, &next.sample_counter),
                    ];
                    let right = counters.iter().all(|(now, enable, next)| {
                        let due = match enable.get() {
                            true => 0,
                            false => now.count.get() + 1,
                        };
                        next.count.get() == due
                    });
                    require(right, ["unit", "scan", "ck", "sample"], || {
                        "another count".into()
                    })
                },
            )
            .always(
                "a led counter ends its period with the enable that leads it, and not before",
                |now| {
                    let led = [(now.w.ck, now.w.ck_led), (now.w.sample, now.w.sample_led)];
                    let never = (1 << W) - 1;
                    let right = led.iter().all(|(enable, period)| {
                        period.get() == if enable.get() { 0 } else { never }
                    });
                    require(right, ["ck_led", "sample_led"], || "not led".into())
                },
            )
    }
}
