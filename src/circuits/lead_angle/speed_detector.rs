//! Speed detector 2 of Fig. 7: measures the distance moved in a gate.
//!
//! ```text
//!                          ┌────────────────┐
//!  ck, position, restart ─▶│                ├──▶ present, speed, way, over
//!  gate ──────────────────▶│ speed detector ├──▶ fresh, enough
//!                          └────────────────┘
//! ```
//!
//! The speed is the distance moved in a gate of `gate` CKs. It is held until the next gate ends, so
//! on average it is a whole gate old.

use super::TableLead;
use crate::prelude::*;

/// Speed detector. A position that is present in the tick of CK is at `present` in the next tick.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpeedDetector {
    /// Width of a position.
    pub position: usize,
    /// Width of a gate in CKs.
    pub gate: usize,
}

signals! { for (SpeedDetector, TableLead) as c;
    /// Input ports; also those of the [lead from a memory](super::table_lead).
    pub struct In {
        /// CK: a sample is taken.
        pub ck: Bit,
        /// Discards the samples taken so far.
        pub restart: Bit,
        /// Position, in counts.
        pub position: I(c.position),
        /// Length of a gate in CKs; 0 counts as 1.
        pub gate: U(c.gate),
    }
}

signals! { for SpeedDetector as c;
    /// Flip-flops.
    pub struct Reg {
        /// Dx: present sample.
        pub present: I(c.position) as Analog,
        /// The sample is new in this tick.
        pub fresh: Bit,
        /// A whole gate has been measured since the last restart.
        pub enough: Bit,
        /// CKs since the gate began.
        count: U(c.gate),
        /// A gate has begun since the last restart.
        begun: Bit,
        /// Sample with which the gate began.
        gate_position: I(c.position),
        /// ν: distance of the last gate, in counts.
        pub speed: I(c.position) as Analog,
    }
    /// Nets.
    pub struct Net {
        /// CKs of the gate, including this one.
        next_count: U(c.gate),
        /// The gate ends with this sample.
        pub over: Bit,
        /// Distance of the gate that ends; it is ν from the next tick on.
        pub way: I(c.position),
        /// A gate begins with this sample.
        begins: Bit,
    }
}

impl Circuit for SpeedDetector {
    const NAME: &'static str = "speed_detector";
    const ABOUT: &'static str = "measures the speed as the distance moved in a gate";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let next_count = q.count + 1;
        let over = i.ck & q.begun & !next_count.below(i.gate);
        let way = i.position - q.gate_position;
        let begins = over | (i.ck & !q.begun);
        let counted = i.ck.mux(next_count, q.count);
        let edge = Reg {
            present: i.ck.mux(i.position, q.present),
            fresh: i.ck & !i.restart,
            enough: (q.enough | over) & !i.restart,
            count: (begins | i.restart).mux(0, counted),
            begun: (q.begun | i.ck) & !i.restart,
            gate_position: begins.mux(i.position, q.gate_position),
            speed: over.mux(way, q.speed),
        };
        let net = Net {
            next_count,
            over,
            way,
            begins,
        };
        (net, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let last = !q.count.below(i.gate - 1) | i.gate.is_zero();
        let ends = i.ck & q.begun & last;
        let way = i.position - q.gate_position;
        let measured = next.speed.equals(ends.mux(way, q.speed));
        let enough = (q.enough | ends) & !i.restart;

        let begins = ends | (i.ck & !q.begun);
        let start = begins.mux(i.position, q.gate_position);
        let more = next.count.equals(q.count + 1) & q.count.below(next.count);
        let counted = i.ck.mux(more, next.count.equals(q.count));
        let counts = (begins | i.restart).mux(next.count.is_zero(), counted);
        let begun = (q.begun | i.ck) & !i.restart;

        let sample = i.ck.mux(i.position, q.present);
        let fresh = i.ck & !i.restart;
        vec![
            Property::step(
                "only the last CK of a gate sets speed, to the distance moved in the gate",
                &["speed", "enough"],
                measured & next.enough.equals(enough),
            ),
            Property::step(
                "a gate begins when the previous one ends, or with the first sample",
                &["gate_position", "count", "begun"],
                next.gate_position.equals(start) & counts & next.begun.equals(begun),
            ),
            Property::step(
                "present holds the last sample, and fresh is high in the tick after CK",
                &["present", "fresh"],
                next.present.equals(sample) & next.fresh.equals(fresh),
            ),
            Property::helper(
                "the count never reaches its greatest value",
                &["count"],
                q.count.below(u64::MAX.cut(self.gate)),
            ),
        ]
    }
}

impl Specified for SpeedDetector {}
