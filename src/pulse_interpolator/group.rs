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
//! Without a control computer (all ports in low) it plays the free-running pattern, if it has one.

use super::{
    AXES_MAX, AXIS_NAMES, AddressSequencer, Axis, CommandPort, Pattern, UnitTimeCounter,
    UnitTimeRegister, Variant,
};
use super::{address_sequencer, axis, command_port, unit_time_counter, unit_time_register};
use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Instance};
use crate::logic::{Bit, Logic, Sim, Unsigned};
use crate::signals;
use std::array::from_fn;

/// Names of the step outputs.
const STEP: &[&str] = &[
    "step_x", "step_y", "step_z", "step_a", "step_b", "step_c", "step_u", "step_v",
];
/// Names of the direction outputs.
const DIR: &[&str] = &[
    "dir_x", "dir_y", "dir_z", "dir_a", "dir_b", "dir_c", "dir_u", "dir_v",
];

signals! {
    /// Ports in: the control computer 2.
    pub struct In<L, const N: usize, const T: usize, const A: usize> {
        /// A command is given; see [`command_port::In`].
        pub command: L::Bit,
        /// First address of its pattern.
        pub base: L::U<A> as Hex,
        /// Last address of its pattern.
        pub last: L::U<A> as Hex,
        /// Its pattern starts again after its last word.
        pub cyclic: L::Bit,
        /// It starts a pattern; low: it stops the one that runs.
        pub run: L::Bit,
        /// It is taken at the next RST; low: at the RST that ends the pattern that runs.
        pub now: L::Bit,
        /// Unit time in ticks: of the command, or written by `write_period`.
        pub period: L::U<T>,
        /// Rewrites the unit time, in force from the next RST on.
        pub write_period: L::Bit,
        /// The unit time ends in this tick, whatever T is: for a group that another counter leads.
        pub unit_end: L::Bit,
        /// Writes a word of the pattern memory.
        pub write: L::Bit,
        /// The axis written to.
        pub write_axis: L::U<3>,
        /// Address written to.
        pub write_address: L::U<A> as Hex,
        /// Half-period written.
        pub write_half_period: L::U<N>,
        /// Direction written.
        pub write_direction: L::Bit,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, const AXES: usize, const N: usize, const T: usize, const A: usize> {
        /// Unit-time register.
        pub unit_time: unit_time_register::Reg<L, T>,
        /// Unit-time counter 30.
        pub counter: unit_time_counter::Reg<L, T>,
        /// Command port.
        pub port: command_port::Reg<L, A, T>,
        /// Address sequencer 50.
        pub sequencer: address_sequencer::Reg<L, A>,
        /// The axes.
        pub axes: [axis::Reg<L, N, A>; AXES] as Elements(&AXIS_NAMES),
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<L, const AXES: usize, const N: usize, const T: usize, const A: usize> {
        /// Unit-time register.
        pub unit_time: Instance<UnitTimeRegister<T>, L>,
        /// Unit-time counter 30.
        pub counter: Instance<UnitTimeCounter<T>, L>,
        /// Command port.
        pub port: Instance<CommandPort<A, T>, L>,
        /// Address sequencer 50.
        pub sequencer: Instance<AddressSequencer<A>, L>,
        /// The axes.
        pub axes: [Instance<Axis<N, A>, L>; AXES] as Elements(&AXIS_NAMES),
        /// Step pulses; a step is a rising edge.
        pub step: [L::Bit; AXES] as Elements(STEP),
        /// Directions; high counts down.
        pub dir: [L::Bit; AXES] as Elements(DIR),
        /// RST: this is the last tick of the unit time.
        pub unit_rst: L::Bit,
        /// A command without `now` would be accepted.
        pub ready: L::Bit,
        /// A pattern runs.
        pub busy: L::Bit,
    }
}

/// 1 to 8 axes with half-periods of `N` bits, a unit time of `T` bits and 2^`A` words of pattern
/// memory per axis.
#[derive(Debug, Clone)]
pub struct Group<const AXES: usize, const N: usize = 16, const T: usize = 24, const A: usize = 12> {
    /// Unit-time register.
    pub unit_time: UnitTimeRegister<T>,
    /// Unit-time counter 30.
    pub counter: UnitTimeCounter<T>,
    /// Command port.
    pub port: CommandPort<A, T>,
    /// Address sequencer 50.
    pub sequencer: AddressSequencer<A>,
    /// The axes.
    pub axes: [Axis<N, A>; AXES],
}

impl<const AXES: usize, const N: usize, const T: usize, const A: usize> Group<AXES, N, T, A> {
    /// A group with empty memories that waits for its control computer; `period` is the unit time
    /// at power-on, in ticks.
    pub fn new(variant: Variant, period: u64) -> Self {
        const { assert!(AXES >= 1 && AXES <= AXES_MAX, "a group has 1 to 8 axes") };
        Group {
            unit_time: UnitTimeRegister { period },
            counter: UnitTimeCounter,
            port: CommandPort { free_running: None },
            sequencer: AddressSequencer,
            axes: from_fn(|axis| Axis::new(axis as u64, variant)),
        }
    }

    /// A group that plays `pattern` of its memories by itself (¶0032); fill `axes` before use.
    pub fn free_running(variant: Variant, pattern: Pattern) -> Self {
        let mut group = Group::new(variant, pattern.period);
        group.port.free_running = Some(pattern);
        group
    }
}

impl<const AXES: usize, const N: usize, const T: usize, const A: usize> Circuit
    for Group<AXES, N, T, A>
{
    const NAME: &'static str = "pulse_interpolator";
    const ABOUT: &'static str = "axes that interpolate together under one unit-time counter";
    type In<L: Logic> = In<L, N, T, A>;
    type Reg<L: Logic> = Reg<L, AXES, N, T, A>;
    type Net<L: Logic> = Net<L, AXES, N, T, A>;

    fn comb<L: Logic>(
        &self,
        q: &Reg<L, AXES, N, T, A>,
        i: &In<L, N, T, A>,
    ) -> Net<L, AXES, N, T, A> {
        let counter = Instance::settle(
            &self.counter,
            &q.counter,
            unit_time_counter::In {
                // A T of 0 ends the unit time at once.
                period: i.unit_end.mux(0.into(), q.unit_time.active),
            },
        );
        let unit_rst = counter.w.unit_rst;
        let sequencer = Instance::settle(
            &self.sequencer,
            &q.sequencer,
            address_sequencer::In {
                unit_rst,
                pending: q.port.pending,
                pending_base: q.port.pending_base,
                pending_last: q.port.pending_last,
                pending_cyclic: q.port.pending_cyclic,
                pending_run: q.port.pending_run,
                pending_now: q.port.pending_now,
            },
        );
        let port = Instance::settle(
            &self.port,
            &q.port,
            command_port::In {
                valid: i.command,
                base: i.base,
                last: i.last,
                cyclic: i.cyclic,
                run: i.run,
                now: i.now,
                period: i.period,
                take: sequencer.w.take,
            },
        );
        let unit_time = Instance::settle(
            &self.unit_time,
            &q.unit_time,
            unit_time_register::In {
                write: i.write_period,
                period: i.period,
                unit_rst,
                take: sequencer.w.take,
                take_period: q.port.pending_period,
            },
        );
        let axes = Instance::settle_each(
            &self.axes,
            &q.axes,
            from_fn(|_| axis::In {
                unit_rst,
                read: sequencer.w.read,
                blank: sequencer.w.blank,
                address: sequencer.w.next_address,
                write: i.write,
                write_axis: i.write_axis,
                write_address: i.write_address,
                write_half_period: i.write_half_period,
                write_direction: i.write_direction,
            }),
        );
        Net {
            step: from_fn(|axis| axes[axis].w.step),
            dir: from_fn(|axis| axes[axis].w.dir),
            unit_rst,
            ready: port.w.ready,
            busy: q.sequencer.state.bit(0),
            unit_time,
            counter,
            port,
            sequencer,
            axes,
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, AXES, N, T, A>,
        w: &Net<L, AXES, N, T, A>,
        _: &In<L, N, T, A>,
    ) -> Reg<L, AXES, N, T, A> {
        Reg {
            unit_time: w.unit_time.next(&self.unit_time, q.unit_time),
            counter: w.counter.next(&self.counter, q.counter),
            port: w.port.next(&self.port, q.port),
            sequencer: w.sequencer.next(&self.sequencer, q.sequencer),
            axes: Instance::next_each(&w.axes, &self.axes, q.axes),
        }
    }

    fn power_on(&self) -> Reg<Sim, AXES, N, T, A> {
        Reg {
            unit_time: self.unit_time.power_on(),
            counter: self.counter.power_on(),
            port: self.port.power_on(),
            sequencer: self.sequencer.power_on(),
            axes: from_fn(|axis| self.axes[axis].power_on()),
        }
    }
}

impl<const AXES: usize, const N: usize, const T: usize, const A: usize> Specified
    for Group<AXES, N, T, A>
{
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "T, address, state and words change only at RST",
                |now, next| {
                    let q = now.q;
                    let words = q.axes.iter().zip(&next.axes).all(|(now, next)| {
                        now.memory.half_period == next.memory.half_period
                            && now.memory.direction == next.memory.direction
                    });
                    let kept = next.unit_time.active == q.unit_time.active
                        && next.sequencer.address == q.sequencer.address
                        && next.sequencer.state == q.sequencer.state;
                    let signals = ["unit_time.active", "sequencer.address", "sequencer.state"];
                    require(kept && words || now.w.unit_rst.get(), signals, || {
                        "changed in mid-unit".into()
                    })
                },
            )
            .always("where the unit time stands decides every axis", |now| {
                let elapsed = now.q.counter.count.get();
                let right = now.q.axes.iter().all(|axis| {
                    let (count, toggle) = match axis.memory.half_period.get() {
                        0 => (0, false),
                        n => (elapsed % n, elapsed / n % 2 == 1),
                    };
                    axis.generator.count.get() == count
                        && axis.generator.toggle.get() == toggle
                        && axis.sync.step.get() == toggle
                });
                require(right, ["counter.count", "step_x"], || {
                    format!("tick {elapsed} of the unit")
                })
            })
            .always("an idle group has no pulses", |now| {
                let quiet = now
                    .q
                    .axes
                    .iter()
                    .all(|axis| axis.memory.half_period.get() == 0 && !axis.sync.step.get());
                require(quiet || now.w.busy.get(), ["busy", "step_x"], || {
                    "a pulse".into()
                })
            })
    }

    /// The contents of the memories are free, but fixed: the EPROM of the text.
    fn applies(&self, i: &In<Sim, N, T, A>) -> bool {
        let unused = i.write_axis.get() == 0
            && i.write_address.get() == 0
            && i.write_half_period.get() == 0
            && !i.write_direction.get();
        !i.write.get() && unused
    }
}
