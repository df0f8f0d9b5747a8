//! The linear interpolator: 14, 20, 21, 24 and 25, from targets to the position commands of X and
//! Y (Figs 5 and 6).
//!
//! ```text
//!                       ┌─────────────────────┐
//!  scan, hold ─────────▶│                     ├──▶ x, y
//!  push, target… ──────▶│ linear interpolator ├──▶ ready, busy
//!  halt, clear ───────▶│                     ├──▶ late, refused
//!                       └─────────────────────┘
//! ```

use super::{
    AxisSwitch, Differentiator, Integrator, PatternGenerator, Rule, Sequencer, TargetData,
    axis_switch, differentiator, integrator, pattern_generator, sequencer, target_data,
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
        /// Steady speed on the way there: counts of the master axis a scan, with `T` bits of
        /// fraction.
        pub speed: L::U<P>,
        /// Acceleration time in scans.
        pub acceleration_time: L::U<T>,
        /// Deceleration time in scans.
        pub deceleration_time: L::U<T>,
        /// Ends the cycle along the line and forgets the targets that wait; one that is pushed with
        /// it is kept, and is where the axes go next.
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
        const R: usize,
    > {
        /// Target data 20.
        pub targets: target_data::Reg<L, A, P, T, 1>,
        /// Sequencer.
        pub sequencer: sequencer::Reg<L, P>,
        /// Position pattern generator 14.
        pub pattern: pattern_generator::Reg<L, P, T, M, Q>,
        /// Differentiator 21.
        pub differentiator: differentiator::Reg<L, P>,
        /// Integrator 24.
        pub integrator: integrator::Reg<L, P, R>,
        /// Adder 25 and axis switch.
        pub switch: axis_switch::Reg<L, P>,
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
        const R: usize,
    > {
        /// Target data 20.
        pub targets: Instance<TargetData<A, P, T>, L>,
        /// Sequencer.
        pub sequencer: Instance<Sequencer<P>, L>,
        /// Position pattern generator 14.
        pub pattern: Instance<PatternGenerator<P, T, M, Q>, L>,
        /// Differentiator 21.
        pub differentiator: Instance<Differentiator<P>, L>,
        /// Integrator 24.
        pub integrator: Instance<Integrator<P, R>, L>,
        /// Adder 25 and axis switch.
        pub switch: Instance<AxisSwitch<P>, L>,
        /// Position command x(n).
        pub x: L::I<P> as Analog,
        /// Position command y(n).
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

/// Linear interpolator with a buffer of 2^`A` − 1 targets, positions of `P` bits and times of `T`;
/// M = 2T + 1 and Q = P + 2T + 2 are the words of the generator's divider, R = 2P that of the
/// integrator's.
#[derive(Debug, Clone, Default)]
pub struct LinearInterpolator<
    const A: usize = 6,
    const P: usize = 32,
    const T: usize = 12,
    const M: usize = 25,
    const Q: usize = 58,
    const R: usize = 64,
> {
    /// Target data 20.
    pub targets: TargetData<A, P, T>,
    /// Sequencer.
    pub sequencer: Sequencer<P>,
    /// Position pattern generator 14.
    pub pattern: PatternGenerator<P, T, M, Q>,
    /// Differentiator 21.
    pub differentiator: Differentiator<P>,
    /// Integrator 24.
    pub integrator: Integrator<P, R>,
    /// Adder 25 and axis switch.
    pub switch: AxisSwitch<P>,
}

impl<const A: usize, const P: usize, const T: usize, const M: usize, const Q: usize, const R: usize>
    LinearInterpolator<A, P, T, M, Q, R>
{
    /// Ticks from `scan` to the tick in which the commands of that scan stand. A scan that is
    /// shorter is late.
    pub const LATENCY: u64 =
        1 + PatternGenerator::<P, T, M, Q>::SCAN_LATENCY + Integrator::<P, R>::LATENCY + 1;
    /// Ticks from an end of a cycle with a target waiting to the tick from which on a `scan` is
    /// the first of the next.
    pub const TURNAROUND: u64 = 6 + PatternGenerator::<P, T, M, Q>::PREPARE_LATENCY;

    /// An interpolator whose integrator rounds by `rule`.
    pub fn new(rule: Rule) -> Self {
        LinearInterpolator {
            integrator: Integrator::new(rule),
            ..Default::default()
        }
    }
}

impl<const A: usize, const P: usize, const T: usize, const M: usize, const Q: usize, const R: usize>
    Circuit for LinearInterpolator<A, P, T, M, Q, R>
{
    const NAME: &'static str = "linear_interpolator";
    const ABOUT: &'static str = "targets in, position commands of X and Y on one straight line out";
    type In<L: Logic> = In<L, P, T>;
    type Reg<L: Logic> = Reg<L, A, P, T, M, Q, R>;
    type Net<L: Logic> = Net<L, A, P, T, M, Q, R>;

    fn comb<L: Logic>(
        &self,
        q: &Reg<L, A, P, T, M, Q, R>,
        i: &In<L, P, T>,
    ) -> Net<L, A, P, T, M, Q, R> {
        let targets = Instance::settle(
            &self.targets,
            &q.targets,
            target_data::In {
                push: i.push,
                x: i.target_x,
                y: i.target_y,
                speed: [i.speed],
                acceleration_time: [i.acceleration_time],
                deceleration_time: [i.deceleration_time],
                pop: q.sequencer.pop,
                flush: i.halt,
            },
        );
        let pattern = Instance::settle(
            &self.pattern,
            &q.pattern,
            pattern_generator::In {
                start: q.sequencer.start,
                from: q.sequencer.master_from,
                distance: q.sequencer.master,
                speed: q.targets.target_speed[0],
                acceleration_time: q.targets.target_acceleration[0],
                deceleration_time: q.targets.target_deceleration[0],
                advance: q.sequencer.advance,
                halt: i.halt,
            },
        );
        let differentiator = Instance::settle(
            &self.differentiator,
            &q.differentiator,
            differentiator::In {
                load: q.sequencer.start,
                from: q.sequencer.master_from,
                valid: pattern.w.valid,
                position: pattern.w.position,
            },
        );
        let integrator = Instance::settle(
            &self.integrator,
            &q.integrator,
            integrator::In {
                clear: q.sequencer.start,
                master: q.sequencer.master,
                slave: q.sequencer.slave,
                start: pattern.w.valid,
                increment: differentiator.w.increment,
            },
        );
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
                x: q.switch.x,
                y: q.switch.y,
                pattern_active: pattern.w.active,
                pattern_ready: pattern.w.ready,
                pattern_valid: pattern.w.valid,
                integrating: integrator.w.busy,
                load: integrator.w.valid,
            },
        );
        let switch = Instance::settle(
            &self.switch,
            &q.switch,
            axis_switch::In {
                load: integrator.w.valid,
                swapped: q.sequencer.swapped,
                position: pattern.w.position,
                slave_from: q.sequencer.slave_from,
                integral: integrator.w.integral,
                clear: sequencer.w.home,
            },
        );
        Net {
            x: q.switch.x,
            y: q.switch.y,
            start: q.sequencer.start,
            load: integrator.w.valid,
            ready: targets.w.ready,
            busy: sequencer.w.busy | targets.w.available,
            late: q.sequencer.late,
            refused: q.sequencer.refused,
            home: sequencer.w.home,
            targets,
            sequencer,
            pattern,
            differentiator,
            integrator,
            switch,
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, A, P, T, M, Q, R>,
        w: &Net<L, A, P, T, M, Q, R>,
        _: &In<L, P, T>,
    ) -> Reg<L, A, P, T, M, Q, R> {
        Reg {
            targets: w.targets.next(&self.targets, q.targets),
            sequencer: w.sequencer.next(&self.sequencer, q.sequencer),
            pattern: w.pattern.next(&self.pattern, q.pattern),
            differentiator: w
                .differentiator
                .next(&self.differentiator, q.differentiator),
            integrator: w.integrator.next(&self.integrator, q.integrator),
            switch: w.switch.next(&self.switch, q.switch),
        }
    }
}
