//! Enables: the counters from which all slower rates of the machine come.
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
//! A circuit with its own enable counter is controlled through its period port: a period of 0 ends
//! the counter's period in this tick, and a period of all ones does not end it before that.

use crate::circuits::blocks::{EnableCounter, enable_counter};
use crate::prelude::*;

/// Four enable counters, with periods in any ratio. All periods begin at power-on.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Enables {
    /// Width of the counters in bits.
    pub width: usize,
}

impl Enables {
    fn counter(&self) -> EnableCounter {
        EnableCounter { width: self.width }
    }
}

impl Default for Enables {
    fn default() -> Self {
        Enables { width: 24 }
    }
}

signals! { for Enables as c;
    /// Input ports.
    pub struct In {
        /// T: unit time in ticks; 0 counts as 1.
        pub unit_period: U(c.width),
        /// Scan period in ticks; 0 counts as 1.
        pub scan_period: U(c.width),
        /// Period of CK in ticks; 0 counts as 1.
        pub ck_period: U(c.width),
        /// Ts: sampling time in ticks; 0 counts as 1.
        pub sample_period: U(c.width),
    }
    /// The counters.
    pub struct Parts {
        /// Counter of the unit time.
        pub unit_counter: Part<EnableCounter>(c.counter()),
        /// Counter of the scan.
        pub scan_counter: Part<EnableCounter>(c.counter()),
        /// Counter of CK.
        pub ck_counter: Part<EnableCounter>(c.counter()),
        /// Counter of Ts.
        pub sample_counter: Part<EnableCounter>(c.counter()),
    }
    /// Output ports.
    pub struct Net {
        /// The unit time ends.
        pub unit: Bit,
        /// A scan begins.
        pub scan: Bit,
        /// CK: a sample is taken.
        pub ck: Bit,
        /// A sampling time begins.
        pub sample: Bit,
        /// Value for the period port of a counter that follows CK.
        pub ck_led: U(c.width),
        /// Value for the period port of a counter that follows Ts.
        pub sample_led: U(c.width),
    }
}

impl Circuit for Enables {
    const NAME: &'static str = "enables";
    const ABOUT: &'static str = "unit time, scan, CK and Ts from one block of counters";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let enable = |counter: Part<EnableCounter>, period| {
            counter.settle(enable_counter::In { period }).w.enable
        };
        let led = |enable: Bit| enable.mux(U::new(0, self.width), u64::MAX.cut(self.width));
        let ck = enable(p.ck_counter, i.ck_period);
        let sample = enable(p.sample_counter, i.sample_period);
        let net = Net {
            unit: enable(p.unit_counter, i.unit_period),
            scan: enable(p.scan_counter, i.scan_period),
            ck,
            sample,
            ck_led: led(ck),
            sample_led: led(sample),
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (w, p, next) = (&now.w, &now.p, &now.next.p);
        let counters = [
            (&p.unit_counter, w.unit, &next.unit_counter),
            (&p.scan_counter, w.scan, &next.scan_counter),
            (&p.ck_counter, w.ck, &next.ck_counter),
            (&p.sample_counter, w.sample, &next.sample_counter),
        ];
        let counts = counters.map(|(now, enable, next)| {
            let (now, next) = (now.q.count, next.q.count);
            enable.mux(next.is_zero(), next.equals(now + 1) & now.below(next))
        });
        let never = u64::MAX.cut(self.width);
        let led = |enable: Bit, period: U| enable.mux(period.is_zero(), period.equals(never));
        vec![
            Property::step(
                "each counter restarts at 0 after its own enable, and otherwise counts up",
                &["unit", "scan", "ck", "sample"],
                Bit::all(counts),
            ),
            Property::always(
                "ck_led is 0 with ck and all ones without, and sample_led likewise with sample",
                &["ck_led", "sample_led"],
                led(w.ck, w.ck_led) & led(w.sample, w.sample_led),
            ),
        ]
    }
}

impl Specified for Enables {}
