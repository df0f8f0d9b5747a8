//! The group: axes that interpolate together under one unit-time counter (¶0012, ¶0032).
//!
//! ```text
//!                  ┌───────┐
//!  command… ──────▶│       ├──▶ step_x, step_y, …
//!  period, write ─▶│ group ├──▶ dir_x, dir_y, …
//!  write… ────────▶│       ├──▶ ready, busy, unit_rst
//!  unit_end ──────▶│       │
//!                  └───────┘
//! ```
//!
//! Without a control computer (all input ports low) it plays the free-running pattern, if there is
//! one.

use super::pattern_memory::{Contents, WritePort};
use super::{AXES_MAX, AXIS_NAMES, AddressSequencer, Axis, CommandPort, Pattern, PatternMemory};
use super::{UnitTimeRegister, Variant, Widths};
use super::{address_sequencer, axis, command_port, pulse_generator, unit_time_register};
use crate::circuits::blocks::{EnableCounter, enable_counter};
use crate::prelude::*;

/// Names of the step outputs.
pub(super) const STEP: &[&str] = &[
    "step_x", "step_y", "step_z", "step_a", "step_b", "step_c", "step_u", "step_v",
];
/// Names of the direction outputs.
pub(super) const DIR: &[&str] = &[
    "dir_x", "dir_y", "dir_z", "dir_a", "dir_b", "dir_c", "dir_u", "dir_v",
];

/// 1 to 8 axes.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// Number of axes.
    pub axes: usize,
    /// Word widths.
    pub widths: Widths,
    /// Unit time at power-on, in ticks.
    pub period: u64,
    /// Pattern that it plays without a command from power-on on.
    pub free_running: Option<Pattern>,
    /// Registers that RST clears.
    pub variant: Variant,
    /// Contents of the axes' pattern memories at power-on; "no pulse" in those of further axes.
    pub memories: Vec<Contents>,
}

impl Group {
    /// A group with empty memories that waits for its control computer; `period` is the unit time
    /// at power-on, in ticks.
    pub fn new(axes: usize, widths: Widths, variant: Variant, period: u64) -> Self {
        Group {
            axes,
            widths,
            period,
            free_running: None,
            variant,
            memories: vec![Contents::new(widths.half_period, widths.address); axes],
        }
    }

    /// Creates a group that plays `pattern` of its memories without a command (¶0032); fill
    /// `memories` before use.
    pub fn free_running(axes: usize, widths: Widths, variant: Variant, pattern: Pattern) -> Self {
        Group {
            free_running: Some(pattern),
            ..Group::new(axes, widths, variant, pattern.period)
        }
    }

    /// An axis.
    fn axis(&self, number: usize) -> Axis {
        let Widths {
            half_period,
            address,
            ..
        } = self.widths;
        let mut memory = PatternMemory::new(half_period, address, number as u64);
        if let Some(contents) = self.memories.get(number) {
            memory.contents = contents.clone();
        }
        Axis {
            memory,
            variant: self.variant,
        }
    }
}

signals! { for Group as c;
    /// Input ports: the control computer 2.
    pub struct In {
        /// Gives a command; see [`command_port::In`].
        pub command: Bit,
        /// First address of the command's pattern.
        pub base: U(c.widths.address) as Hex,
        /// Last address of the command's pattern.
        pub last: U(c.widths.address) as Hex,
        /// The command's pattern repeats after its last word.
        pub cyclic: Bit,
        /// High: the command starts a pattern; low: it stops the running one.
        pub run: Bit,
        /// High: the command is taken at the next RST; low: at the RST that ends the running
        /// pattern.
        pub now: Bit,
        /// Unit time in ticks, for the command or for `write_period`.
        pub period: U(c.widths.period),
        /// Writes the unit time, which is in force from the next RST on.
        pub write_period: Bit,
        /// Ends the unit time in this tick, whatever T is. For a group that is timed by another
        /// counter.
        pub unit_end: Bit,
        /// Port through which the words of all axes are written.
        pub port: WritePort(&c.widths) as Flat,
    }
    /// The circuits inside.
    pub struct Parts {
        /// Unit-time register.
        pub unit_time: Part<UnitTimeRegister>(UnitTimeRegister {
            width: c.widths.period,
            period: c.period,
        }),
        /// Unit-time counter 30; its enable is RST.
        pub counter: Part<EnableCounter>(EnableCounter { width: c.widths.period }),
        /// Command port.
        pub port: Part<CommandPort>(CommandPort {
            address: c.widths.address,
            period: c.widths.period,
            free_running: c.free_running,
        }),
        /// Address sequencer 50.
        pub sequencer: Part<AddressSequencer>(AddressSequencer { width: c.widths.address }),
        /// The axes.
        pub axes: [Part<Axis>(c.axis(k)); k in c.axes] as Elements(&AXIS_NAMES),
    }
    /// Output ports.
    pub struct Net {
        /// Step pulses; a step is a rising edge.
        pub step: [Bit; c.axes] as Elements(STEP),
        /// Directions; high counts down.
        pub dir: [Bit; c.axes] as Elements(DIR),
        /// RST: high in the last tick of the unit time.
        pub unit_rst: Bit,
        /// No command is waiting, so one without `now` is accepted.
        pub ready: Bit,
        /// A pattern is running.
        pub busy: Bit,
    }
}

impl Circuit for Group {
    const NAME: &'static str = "pulse_interpolator";
    const ABOUT: &'static str = "axes that interpolate together under one unit-time counter";
    records!(In, Nothing, Net, Parts);

    fn objection(&self) -> Option<String> {
        if !(1..=AXES_MAX).contains(&self.axes) {
            return Some(format!("a group has 1 to {AXES_MAX} axes"));
        }
        let wrong = self.memories.len() > self.axes;
        wrong.then(|| "there are more pattern memories than axes".into())
    }

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let counter = p.counter.settle(enable_counter::In {
            // A T of 0 ends the unit time immediately.
            period: i.unit_end.mux(0, p.unit_time.q.active),
        });
        let unit_rst = counter.w.enable;
        let sequencer = p.sequencer.settle(address_sequencer::In {
            unit_rst,
            pending: p.port.q.pending,
            pending_base: p.port.q.pending_base,
            pending_last: p.port.q.pending_last,
            pending_cyclic: p.port.q.pending_cyclic,
            pending_run: p.port.q.pending_run,
            pending_now: p.port.q.pending_now,
        });
        let port = p.port.settle(command_port::In {
            valid: i.command,
            base: i.base,
            last: i.last,
            cyclic: i.cyclic,
            run: i.run,
            now: i.now,
            period: i.period,
            take: sequencer.w.take,
        });
        p.unit_time.settle(unit_time_register::In {
            write: i.write_period,
            period: i.period,
            unit_rst,
            take: sequencer.w.take,
            take_period: port.q.pending_period,
        });
        let axes = settle_each(p.axes, |_| axis::In {
            unit_rst,
            read: sequencer.w.read,
            blank: sequencer.w.blank,
            address: sequencer.w.next_address,
            port: i.port.clone(),
        });
        let net = Net {
            step: axes.iter().map(|axis| axis.w.step).collect(),
            dir: axes.iter().map(|axis| axis.w.dir).collect(),
            unit_rst,
            ready: port.w.ready,
            busy: sequencer.q.state.bit(0),
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (w, p, next) = (&now.w, &now.p, &now.next.p);
        let axes = || p.axes.iter();
        let words = axes().zip(&next.axes).map(|(now, next)| {
            let (now, next) = (&now.p.memory.q, &next.p.memory.q);
            next.half_period.equals(now.half_period) & next.direction.equals(now.direction)
        });
        let kept = [
            next.unit_time.q.active.equals(p.unit_time.q.active),
            next.sequencer.q.address.equals(p.sequencer.q.address),
            next.sequencer.q.state.equals(p.sequencer.q.state),
        ];
        let elapsed = p.counter.q.count;
        let starts = axes().map(|axis| {
            let (generator, step) = (&axis.p.generator.q, axis.p.sync.q.step);
            generator.count.is_zero() & !generator.toggle & !step
        });
        // From tick to tick: with the start, the place in the half-period after any number of ticks.
        let goes_on = axes().zip(&next.axes).map(|(now, next)| {
            let half_period = now.p.memory.q.half_period;
            let after = &next.p.generator.q;
            pulse_generator::goes_on(&now.p.generator.q, after, half_period)
                & next.p.sync.q.step.equals(after.toggle)
        });
        let within = axes().map(|axis| {
            let count = axis.p.generator.q.count;
            count.is_zero() | count.below(axis.p.memory.q.half_period)
        });
        let quiet = axes().map(|axis| axis.p.memory.q.half_period.is_zero() & !axis.p.sync.q.step);
        vec![
            Property::step(
                "unit time, address, state and memory outputs change only at RST",
                &["unit_time.active", "sequencer.address", "sequencer.state"],
                w.unit_rst | Bit::all(words.chain(kept)),
            ),
            Property::always(
                "in the first tick of a unit time, no axis has begun a half-period",
                &["counter.count", "step_x"],
                elapsed.is_zero().implies(Bit::all(starts)),
            ),
            Property::step(
                "each axis depends only on its half-period and the ticks since RST",
                &["counter.count", "step_x"],
                w.unit_rst | Bit::all(goes_on),
            ),
            Property::always(
                "an idle group outputs no pulses",
                &["busy", "step_x"],
                w.busy | Bit::all(quiet),
            ),
            Property::helper(
                "the ticks since RST stay below the unit time, the count of an axis below its half-period",
                &["counter.count"],
                (elapsed.is_zero() | elapsed.below(p.unit_time.q.active)) & Bit::all(within),
            ),
        ]
    }
}

impl Specified for Group {
    /// The contents of the memories are free, but fixed: the EPROM of the text.
    fn applies(&self, i: &In<Value>) -> bool {
        i.port.is_quiet()
    }
}
