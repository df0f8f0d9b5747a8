//! One axis: pattern memory 10, pulse generator 20 and sync stage 40 (¶0012).
//!
//! ```text
//!                ┌──────┐
//!  unit_rst ────▶│      ├──▶ step
//!  read, blank ─▶│ axis ├──▶ dir
//!  address ─────▶│      │
//!  write… ──────▶│      │
//!                └──────┘
//! ```

use super::pattern_memory::WritePort;
use super::{PatternMemory, PulseGenerator, SyncStage, Variant};
use super::{pattern_memory, pulse_generator, sync_stage};
use crate::prelude::*;

/// One axis, with the widths of its memory.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Pattern memory 10.
    pub memory: PatternMemory,
    /// Registers that RST clears.
    pub variant: Variant,
}

signals! { for Axis as c;
    /// Input ports.
    pub struct In {
        /// RST: high in the last tick of the unit time.
        pub unit_rst: Bit,
        /// Reads the word at `address` for the next unit time.
        pub read: Bit,
        /// The next unit time has no pulses.
        pub blank: Bit,
        /// Address of the next unit time.
        pub address: U(c.memory.address) as Hex,
        /// Port through which the words of all axes are written.
        pub port: WritePort(&c.memory) as Flat,
    }
    /// The circuits inside.
    pub struct Parts {
        /// Pattern memory 10.
        pub memory: Part<PatternMemory>(c.memory.clone()),
        /// Pulse generator 20.
        pub generator: Part<PulseGenerator>(PulseGenerator {
            width: c.memory.half_period,
            variant: c.variant,
        }),
        /// Sync stage 40.
        pub sync: Part<SyncStage>(SyncStage {}),
    }
    /// Output ports.
    pub struct Net {
        /// Step pulses; a step is a rising edge.
        pub step: Bit,
        /// Direction; high counts down. Changes only in the first tick of a unit time.
        pub dir: Bit,
    }
}

impl Circuit for Axis {
    const NAME: &'static str = "axis";
    const ABOUT: &'static str = "pattern memory, pulse generator and sync stage of one axis";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let memory = p.memory.settle(pattern_memory::In {
            read: i.read,
            blank: i.blank,
            address: i.address,
            port: i.port,
        });
        let generator = p.generator.settle(pulse_generator::In {
            half_period: memory.q.half_period,
            unit_rst: i.unit_rst,
        });
        let sync = p.sync.settle(sync_stage::In {
            pulse: generator.w.pulse,
            unit_rst: i.unit_rst,
        });
        let net = Net {
            step: sync.q.step,
            dir: memory.q.direction,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, p, next) = (&now.i, &now.p, &now.next.p);
        let (toggle, step) = (p.generator.q.toggle, p.sync.q.step);
        vec![
            Property::step(
                "step is low in the tick after RST",
                &["sync.step", "unit_rst"],
                i.unit_rst.implies(!next.sync.q.step),
            ),
            Property::step(
                "dir changes only after a tick with read",
                &["dir", "read"],
                i.read | next.memory.q.direction.equals(p.memory.q.direction),
            ),
            Property::always(
                "generator.toggle equals sync.step",
                &["generator.toggle", "sync.step"],
                toggle.equals(step),
            ),
        ]
    }
}

impl Specified for Axis {
    /// A word is read or blanked at RST only, as the address sequencer does it; the write port's
    /// words without a write do not matter, nor does the number of another axis.
    fn applies(&self, i: &In<Value>) -> bool {
        let written = i.port.write && i.port.write_axis < 2;
        let moves = i.read || i.blank;
        (written || i.port.is_quiet()) && (i.unit_rst || !moves)
    }
}
