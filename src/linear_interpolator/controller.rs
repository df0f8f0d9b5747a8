//! Controller 1 (Fig. 5): scan, position commands, and a position loop for each axis.
//!
//! ```text
//!                             ┌────────────┐
//!  push, target… ────────────▶│            ├──▶ ready, busy
//!  halt, clear, exact_stop ─▶│            ├──▶ reference_x, reference_y
//!  scan_period ──────────────▶│ controller ├──▶ command_x, command_y
//!  gain_x, gain_y, window ───▶│            ├──▶ feedback_x, feedback_y
//!  a_x, b_x, a_y, b_y ───────▶│            ├──▶ late, refused, lost_x, lost_y
//!                             └────────────┘
//! ```
//!
//! The same around the conventional system of Fig. 3: what makes the commands is a parameter.

use super::target_data::{ACCELERATION_TIME, DECELERATION_TIME, SPEED};
use super::{Conventional, CycleGate, LinearInterpolator, PositionLoop};
use super::{conventional, cycle_gate, interpolator, position_loop};
use crate::blocks::{EnableCounter, enable_counter};
use crate::kernel::{Circuit, Instance};
use crate::logic::{Logic, Sim};
use crate::signals;
use std::fmt::Debug;

/// What makes the position commands of a controller, from targets with `N` settings of speed and
/// times: one for both axes, or one for each.
pub trait CommandSource<const P: usize, const T: usize, const N: usize>:
    Circuit + Clone + Debug
{
    /// The name of a controller with it.
    const CONTROLLER: &'static str;
    /// What such a controller is, in one line.
    const CONTROLLER_ABOUT: &'static str;
    /// Its ports in.
    fn ports<L: Logic>(i: SourcePorts<L, P, T, N>) -> Self::In<L>;
    /// Its ports out.
    fn commands<L: Logic>(w: &Self::Net<L>) -> Commands<L, P>;
}

/// Ports in of a [`CommandSource`].
#[derive(Debug, Clone)]
pub struct SourcePorts<L: Logic, const P: usize, const T: usize, const N: usize> {
    /// A scan begins.
    pub scan: L::Bit,
    /// No new cycle begins.
    pub hold: L::Bit,
    /// A target is given.
    pub push: L::Bit,
    /// Its X and Y.
    pub target: [L::I<P>; 2],
    /// Its speeds.
    pub speed: [L::U<P>; N],
    /// Its acceleration times.
    pub acceleration_time: [L::U<T>; N],
    /// Its deceleration times.
    pub deceleration_time: [L::U<T>; N],
    /// Ends the cycle.
    pub halt: L::Bit,
    /// The commands become 0.
    pub clear: L::Bit,
}

/// Ports out of a [`CommandSource`].
#[derive(Debug, Clone)]
pub struct Commands<L: Logic, const P: usize> {
    /// Position command of X.
    pub x: L::I<P>,
    /// Position command of Y.
    pub y: L::I<P>,
    /// A cycle begins.
    pub start: L::Bit,
    /// New commands show from the next tick on.
    pub load: L::Bit,
    /// A push is taken.
    pub ready: L::Bit,
    /// A cycle runs or is prepared, or a target waits.
    pub busy: L::Bit,
    /// A scan came too early since the last `clear`.
    pub late: L::Bit,
    /// A target was too far since the last `clear`.
    pub refused: L::Bit,
    /// `clear` is taken.
    pub home: L::Bit,
}

macro_rules! command_source {
    (
        [$($width:ident),*], $circuit:ident, $settings:literal, $module:ident,
        |$one:ident| $setting:expr, $name:literal, $about:literal
    ) => {
        impl<$(const $width: usize),*> CommandSource<P, T, $settings> for $circuit<$($width),*> {
            const CONTROLLER: &'static str = $name;
            const CONTROLLER_ABOUT: &'static str = $about;

            fn ports<L: Logic>(i: SourcePorts<L, P, T, $settings>) -> Self::In<L> {
                let [target_x, target_y] = i.target;
                $module::In {
                    scan: i.scan,
                    hold: i.hold,
                    push: i.push,
                    target_x,
                    target_y,
                    speed: { let $one = i.speed; $setting },
                    acceleration_time: { let $one = i.acceleration_time; $setting },
                    deceleration_time: { let $one = i.deceleration_time; $setting },
                    halt: i.halt,
                    clear: i.clear,
                }
            }

            fn commands<L: Logic>(w: &Self::Net<L>) -> Commands<L, P> {
                Commands {
                    x: w.x,
                    y: w.y,
                    start: w.start,
                    load: w.load,
                    ready: w.ready,
                    busy: w.busy,
                    late: w.late,
                    refused: w.refused,
                    home: w.home,
                }
            }
        }
    };
}

command_source!(
    [A, P, T, M, Q, R],
    LinearInterpolator,
    1,
    interpolator,
    |settings| settings[0],
    "controller",
    "linear interpolator with the position loops of X and Y"
);
command_source!(
    [A, P, T, M, Q],
    Conventional,
    2,
    conventional,
    |settings| settings,
    "conventional_controller",
    "a position pattern for each axis, with the position loops of X and Y"
);

signals! {
    /// Ports in: control computer, settings, encoders.
    pub struct In<
        L,
        const P: usize,
        const T: usize,
        const G: usize,
        const S: usize,
        const N: usize,
    > {
        /// A target is given; not taken unless `ready`, or with `halt`.
        pub push: L::Bit,
        /// Its X.
        pub target_x: L::I<P>,
        /// Its Y.
        pub target_y: L::I<P>,
        /// Steady speed on the way there: counts a scan, with `T` bits of fraction; one of the master
        /// axis, or one of each axis.
        pub speed: [L::U<P>; N] as Elements(SPEED),
        /// Acceleration time in scans.
        pub acceleration_time: [L::U<T>; N] as Elements(ACCELERATION_TIME),
        /// Deceleration time in scans.
        pub deceleration_time: [L::U<T>; N] as Elements(DECELERATION_TIME),
        /// Ends the cycle along the line and forgets the targets that wait; one that is pushed with
        /// it is kept, and is where the axes go next.
        pub halt: L::Bit,
        /// Between two cycles: commands and feedback become 0, the flags go.
        pub clear: L::Bit,
        /// A cycle begins only when both axes are in position.
        pub exact_stop: L::Bit,
        /// Ticks of a scan.
        pub scan_period: L::U<S>,
        /// Position gain of X, see [`position_loop::In::gain`].
        pub gain_x: L::U<G>,
        /// Position gain of Y.
        pub gain_y: L::U<G>,
        /// In-position window in counts.
        pub window: L::U<P>,
        /// Encoder of X, channel A.
        pub a_x: L::Bit,
        /// Encoder of X, channel B.
        pub b_x: L::Bit,
        /// Encoder of Y, channel A.
        pub a_y: L::Bit,
        /// Encoder of Y, channel B.
        pub b_y: L::Bit,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, type C: Circuit, const P: usize, const D: usize, const S: usize> {
        /// Scan counter.
        pub scan_counter: enable_counter::Reg<L, S>,
        /// What makes the commands.
        pub interpolator: C::Reg<L>,
        /// Position loop of X.
        pub loop_x: position_loop::Reg<L, P, D>,
        /// Position loop of Y.
        pub loop_y: position_loop::Reg<L, P, D>,
        /// Cycle gate.
        pub gate: cycle_gate::Reg<L>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<
        L,
        type C: Circuit,
        const P: usize,
        const G: usize,
        const F: usize,
        const D: usize,
        const K: usize,
        const S: usize,
    > {
        /// Scan counter.
        pub scan_counter: Instance<EnableCounter<S>, L>,
        /// What makes the commands.
        pub interpolator: Instance<C, L>,
        /// Position loop of X.
        pub loop_x: Instance<PositionLoop<P, G, F, D, K>, L>,
        /// Position loop of Y.
        pub loop_y: Instance<PositionLoop<P, G, F, D, K>, L>,
        /// Cycle gate.
        pub gate: Instance<CycleGate, L>,
        /// A scan begins.
        pub scan: L::Bit,
        /// Position command of X.
        pub command_x: L::I<P> as Analog,
        /// Position command of Y.
        pub command_y: L::I<P> as Analog,
        /// Position feedback of X.
        pub feedback_x: L::I<P> as Analog,
        /// Position feedback of Y.
        pub feedback_y: L::I<P> as Analog,
        /// Speed reference of X, the word of its D/A converter.
        pub reference_x: L::I<D> as Analog,
        /// Speed reference of Y.
        pub reference_y: L::I<D> as Analog,
        /// A cycle begins.
        pub start: L::Bit,
        /// New commands show from the next tick on.
        pub load: L::Bit,
        /// A push is taken.
        pub ready: L::Bit,
        /// A cycle runs or is prepared, or a target waits, or an axis is not in position.
        pub busy: L::Bit,
        /// A scan came before the one before was computed, since the last `clear`.
        pub late: L::Bit,
        /// A target was too far since the last `clear`.
        pub refused: L::Bit,
        /// The encoder of X was too fast since the last `clear`.
        pub lost_x: L::Bit,
        /// The encoder of Y was too fast since the last `clear`.
        pub lost_y: L::Bit,
    }
}

/// Controller 1 around what makes its commands, with positions of `P` bits and times of `T`, gains
/// of `G` bits of which `F` are a fraction, D/A converters of `D` bits, a scan of `S` bits; `K` is
/// P + G, the width of the loops' products, and `N` the settings of a target.
#[derive(Debug, Clone, Default)]
pub struct Controller<
    C,
    const P: usize = 32,
    const T: usize = 12,
    const G: usize = 16,
    const F: usize = 8,
    const D: usize = 16,
    const K: usize = 48,
    const S: usize = 24,
    const N: usize = 1,
> {
    /// Scan counter.
    pub scan_counter: EnableCounter<S>,
    /// What makes the commands.
    pub interpolator: C,
    /// Position loops.
    pub position_loop: PositionLoop<P, G, F, D, K>,
    /// Cycle gate.
    pub gate: CycleGate,
}

impl<
    C: CommandSource<P, T, N>,
    const P: usize,
    const T: usize,
    const G: usize,
    const F: usize,
    const D: usize,
    const K: usize,
    const S: usize,
    const N: usize,
> Controller<C, P, T, G, F, D, K, S, N>
{
    /// The controller around `interpolator`.
    pub fn new(interpolator: C) -> Self {
        Controller {
            scan_counter: EnableCounter,
            interpolator,
            position_loop: PositionLoop::default(),
            gate: CycleGate,
        }
    }
}

impl<
    C: CommandSource<P, T, N>,
    const P: usize,
    const T: usize,
    const G: usize,
    const F: usize,
    const D: usize,
    const K: usize,
    const S: usize,
    const N: usize,
> Circuit for Controller<C, P, T, G, F, D, K, S, N>
{
    const NAME: &'static str = C::CONTROLLER;
    const ABOUT: &'static str = C::CONTROLLER_ABOUT;
    type In<L: Logic> = In<L, P, T, G, S, N>;
    type Reg<L: Logic> = Reg<L, C, P, D, S>;
    type Net<L: Logic> = Net<L, C, P, G, F, D, K, S>;

    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L> {
        let scan_counter = Instance::settle(
            &self.scan_counter,
            &q.scan_counter,
            enable_counter::In {
                period: i.scan_period,
            },
        );
        let scan = scan_counter.w.enable;
        let interpolator: Instance<C, L> = Instance::settle(
            &self.interpolator,
            &q.interpolator,
            C::ports(SourcePorts {
                scan,
                hold: q.gate.hold,
                push: i.push,
                target: [i.target_x, i.target_y],
                speed: i.speed,
                acceleration_time: i.acceleration_time,
                deceleration_time: i.deceleration_time,
                halt: i.halt,
                clear: i.clear,
            }),
        );
        let commands = C::commands(&interpolator.w);
        let position_loop = |registers, command, [a, b]: [L::Bit; 2], gain| {
            Instance::settle(
                &self.position_loop,
                registers,
                position_loop::In {
                    scan,
                    command,
                    a,
                    b,
                    clear: commands.home,
                    gain,
                    window: i.window,
                },
            )
        };
        let loop_x = position_loop(&q.loop_x, commands.x, [i.a_x, i.b_x], i.gain_x);
        let loop_y = position_loop(&q.loop_y, commands.y, [i.a_y, i.b_y], i.gain_y);
        let gate = Instance::settle(
            &self.gate,
            &q.gate,
            cycle_gate::In {
                exact_stop: i.exact_stop,
                in_position_x: loop_x.w.in_position,
                in_position_y: loop_y.w.in_position,
            },
        );
        let there = loop_x.w.in_position & loop_y.w.in_position;
        Net {
            scan,
            command_x: commands.x,
            command_y: commands.y,
            feedback_x: loop_x.w.feedback,
            feedback_y: loop_y.w.feedback,
            reference_x: loop_x.w.speed_ref,
            reference_y: loop_y.w.speed_ref,
            start: commands.start,
            load: commands.load,
            ready: commands.ready,
            busy: commands.busy | !there,
            late: commands.late,
            refused: commands.refused,
            lost_x: loop_x.w.lost,
            lost_y: loop_y.w.lost,
            scan_counter,
            interpolator,
            loop_x,
            loop_y,
            gate,
        }
    }

    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, _: &Self::In<L>) -> Self::Reg<L> {
        Reg {
            scan_counter: w.scan_counter.next(&self.scan_counter, q.scan_counter),
            interpolator: w.interpolator.next(&self.interpolator, q.interpolator),
            loop_x: w.loop_x.next(&self.position_loop, q.loop_x),
            loop_y: w.loop_y.next(&self.position_loop, q.loop_y),
            gate: w.gate.next(&self.gate, q.gate),
        }
    }

    fn power_on(&self) -> Reg<Sim, C, P, D, S> {
        Reg {
            scan_counter: self.scan_counter.power_on(),
            interpolator: self.interpolator.power_on(),
            loop_x: self.position_loop.power_on(),
            loop_y: self.position_loop.power_on(),
            gate: self.gate.power_on(),
        }
    }
}
