//! The conventional system of Fig. 3 (¶0004–0005), for comparison: a position pattern for each
//! axis, each with a speed and times of its own.
//!
//! ```text
//!                       ┌────────────────────┐
//!  scan, hold ─────────▶│                    ├──▶ x, y
//!  push, target… ──────▶│ conventional       ├──▶ ready, busy
//!  halt, clear ───────▶│ interpolator       ├──▶ late, refused
//!                       └────────────────────┘
//! ```
//!
//! Ports as those of the linear interpolator, but that speed and times are those of X, and Y has
//! its own. Both patterns begin together. Which settings they get makes the two ways of ¶0005:
//! the same for both axes, or speeds in proportion to the distances with times inverse to them.

use super::target_data::{ACCELERATION_TIME, DECELERATION_TIME, SPEED};
use super::{
    AxisSwitch, PatternGenerator, Sequencer, TargetData, axis_switch, pattern_generator, sequencer,
    target_data,
};
use crate::kernel::{Circuit, Instance};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in: scan and control computer.
    pub struct In<L, const P: usize, const T: usize> {
        /// A scan begins.
        pub scan: L::Bit,
        /// No new cycle begins.
        pub hold: L::Bit,
        /// A target is given; not taken unless `ready`, or with `halt`.
        pub push: L::Bit,
        /// Its X.
        pub target_x: L::I<P>,
        /// Its Y.
        pub target_y: L::I<P>,
        /// Steady speeds of X and of Y: counts a scan, with `T` bits of fraction.
        pub speed: [L::U<P>; 2] as Elements(SPEED),
        /// Acceleration times in scans, from rest to these speeds.
        pub acceleration_time: [L::U<T>; 2] as Elements(ACCELERATION_TIME),
        /// Deceleration times in scans.
        pub deceleration_time: [L::U<T>; 2] as Elements(DECELERATION_TIME),
        /// Ends the cycle, each axis by its own ramp, and forgets the targets that wait; one that is
        /// pushed with it is kept, and is where the axes go next.
        pub halt: L::Bit,
        /// Between two cycles: the commands become 0, the flags go.
        pub clear: L::Bit,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<
        L,
        const A: usize,
        const P: usize,
        const T: usize,
        const M: usize,
        const Q: usize,
    > {
        /// Target data 20.
        pub targets: target_data::Reg<L, A, P, T, 2>,
        /// Sequencer.
        pub sequencer: sequencer::Reg<L, P>,
        /// Position pattern generator 14 of X.
        pub pattern_x: pattern_generator::Reg<L, P, T, M, Q>,
        /// Position pattern generator 14 of Y.
        pub pattern_y: pattern_generator::Reg<L, P, T, M, Q>,
        /// Position commands.
        pub commands: axis_switch::Reg<L, P>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<
        L,
        const A: usize,
        const P: usize,
        const T: usize,
        const M: usize,
        const Q: usize,
    > {
        /// Target data 20.
        pub targets: Instance<TargetData<A, P, T, 2>, L>,
        /// Sequencer.
        pub sequencer: Instance<Sequencer<P>, L>,
        /// Position pattern generator 14 of X.
        pub pattern_x: Instance<PatternGenerator<P, T, M, Q>, L>,
        /// Position pattern generator 14 of Y.
        pub pattern_y: Instance<PatternGenerator<P, T, M, Q>, L>,
        /// Position commands.
        pub commands: Instance<AxisSwitch<P>, L>,
        /// Position command of X.
        pub x: L::I<P> as Analog,
        /// Position command of Y.
        pub y: L::I<P> as Analog,
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
}

/// Conventional system with widths as those of the linear interpolator.
#[derive(Debug, Clone, Default)]
pub struct Conventional<
    const A: usize = 6,
    const P: usize = 32,
    const T: usize = 12,
    const M: usize = 25,
    const Q: usize = 58,
> {
    /// Target data 20.
    pub targets: TargetData<A, P, T, 2>,
    /// Sequencer.
    pub sequencer: Sequencer<P>,
    /// Position pattern generator 14, one for each axis.
    pub pattern: PatternGenerator<P, T, M, Q>,
    /// Position commands.
    pub commands: AxisSwitch<P>,
}

impl<const A: usize, const P: usize, const T: usize, const M: usize, const Q: usize> Circuit
    for Conventional<A, P, T, M, Q>
{
    const NAME: &'static str = "conventional_interpolator";
    const ABOUT: &'static str = "the system before: an independent position pattern for each axis";
    type In<L: Logic> = In<L, P, T>;
    type Reg<L: Logic> = Reg<L, A, P, T, M, Q>;
    type Net<L: Logic> = Net<L, A, P, T, M, Q>;

    fn comb<L: Logic>(&self, q: &Reg<L, A, P, T, M, Q>, i: &In<L, P, T>) -> Net<L, A, P, T, M, Q> {
        let targets = Instance::settle(
            &self.targets,
            &q.targets,
            target_data::In {
                push: i.push,
                x: i.target_x,
                y: i.target_y,
                speed: i.speed,
                acceleration_time: i.acceleration_time,
                deceleration_time: i.deceleration_time,
                pop: q.sequencer.pop,
                flush: i.halt,
            },
        );
        let pattern = |axis: usize, q_pattern, from, distance| {
            Instance::settle(
                &self.pattern,
                q_pattern,
                pattern_generator::In {
                    start: q.sequencer.start,
                    from,
                    distance,
                    speed: q.targets.target_speed[axis],
                    acceleration_time: q.targets.target_acceleration[axis],
                    deceleration_time: q.targets.target_deceleration[axis],
                    advance: q.sequencer.advance,
                    halt: i.halt,
                },
            )
        };
        let pattern_x = pattern(0, &q.pattern_x, q.commands.x, q.sequencer.delta_x);
        let pattern_y = pattern(1, &q.pattern_y, q.commands.y, q.sequencer.delta_y);
        let (x, y) = (&pattern_x.w, &pattern_y.w);
        // Both take the same time for a scan; one of them may be at rest.
        let valid = x.valid | y.valid;
        let sequencer = Instance::settle(
            &self.sequencer,
            &q.sequencer,
            sequencer::In {
                scan: i.scan,
                hold: i.hold,
                halt: i.halt,
                clear: i.clear,
                available: targets.w.available,
                target_x: q.targets.target_x,
                target_y: q.targets.target_y,
                x: q.commands.x,
                y: q.commands.y,
                pattern_active: x.active | y.active,
                pattern_ready: (x.ready | !x.active) & (y.ready | !y.active),
                pattern_valid: valid,
                integrating: false.into(),
                load: valid,
            },
        );
        let commands = Instance::settle(
            &self.commands,
            &q.commands,
            axis_switch::In {
                load: valid,
                swapped: false.into(),
                position: x.position,
                slave_from: y.position,
                integral: 0.into(),
                clear: sequencer.w.home,
            },
        );
        Net {
            x: q.commands.x,
            y: q.commands.y,
            start: q.sequencer.start,
            load: valid,
            ready: targets.w.ready,
            busy: sequencer.w.busy | targets.w.available,
            late: q.sequencer.late,
            refused: q.sequencer.refused,
            home: sequencer.w.home,
            targets,
            sequencer,
            pattern_x,
            pattern_y,
            commands,
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, A, P, T, M, Q>,
        w: &Net<L, A, P, T, M, Q>,
        _: &In<L, P, T>,
    ) -> Reg<L, A, P, T, M, Q> {
        Reg {
            targets: w.targets.next(&self.targets, q.targets),
            sequencer: w.sequencer.next(&self.sequencer, q.sequencer),
            pattern_x: w.pattern_x.next(&self.pattern, q.pattern_x),
            pattern_y: w.pattern_y.next(&self.pattern, q.pattern_y),
            commands: w.commands.next(&self.commands, q.commands),
        }
    }
}
