//! The machine: what the control computer of an X-Y plotter is connected to.
//!
//! ```text
//!                          ┌─────────┐
//!  periods ───────────────▶│         ├──▶ step_x, step_y, dir_x, dir_y
//!  halt ──────────────────▶│         ├──▶ torque_x, torque_y
//!  pulse, lines, arcs, … ─▶│ machine ├──▶ drive, reverse, speed, brake
//!  encoders ──────────────▶│         ├──▶ counts_x, counts_y, position_x, position_y
//!                          └─────────┘
//! ```

use super::{CommandJoin, Enables, command_join, enables, ports};
use crate::arc_generator::{ArcGenerator, generator};
use crate::jobs::lead_angle::job::RamLead;
use crate::jobs::pulse_interpolator::job::JobGroup;
use crate::jobs::trajectory_controller::job::Controller;
use crate::kernel::{Circuit, Instance};
use crate::lead_angle::{Compensator, compensator};
use crate::linear_interpolator::{LinearInterpolator, interpolator};
use crate::logic::{Logic, Signed, Sim};
use crate::pulse_interpolator::group;
use crate::signals;
use crate::trajectory_controller::controller;

/// Bits behind the count in the trajectory controller.
const GUARD: usize = 16;

/// Pulse interpolator of the steppers.
pub type Pulse = JobGroup<2>;
/// Trajectory controller of the servos, on paths of up to 256 segments.
pub type Trajectory = Controller<2, 8, 12>;
/// Lead-angle compensator of the pen lift.
pub type Lift = Compensator<RamLead>;
/// Lines and arcs as one command.
pub type Join = CommandJoin<32, 24>;

signals! {
    /// Ports in: the control computer, the encoders.
    pub struct In<L> {
        /// Ends every movement where it is.
        pub halt: L::Bit,
        /// Rates of all circuits.
        pub rates: enables::In<L, 24>,
        /// To the pulse interpolator.
        pub pulse: ports::Pulse<L>,
        /// To the linear interpolator.
        pub lines: ports::Lines<L>,
        /// To the arc generator.
        pub arcs: ports::Arcs<L>,
        /// To the trajectory controller.
        pub trajectory: ports::Trajectory<L>,
        /// To the lead-angle compensator.
        pub lift: ports::Lift<L>,
    }
}

signals! {
    /// Registers of the circuits.
    pub struct Reg<L> {
        /// Unit time, scan, CK, Ts.
        pub enables: enables::Reg<L, 24>,
        /// Pulses of the steppers.
        pub pulse_interpolator: <Pulse as Circuit>::Reg<L>,
        /// Commands of the servos on lines.
        pub linear_interpolator: <LinearInterpolator as Circuit>::Reg<L>,
        /// Commands of the servos on arcs.
        pub arc_generator: <ArcGenerator as Circuit>::Reg<L>,
        /// Both as one.
        pub command_join: <Join as Circuit>::Reg<L>,
        /// Corrects the commands, drives the servos.
        pub trajectory_controller: <Trajectory as Circuit>::Reg<L>,
        /// Lifts and lowers the pen.
        pub lead_angle: <Lift as Circuit>::Reg<L>,
    }
}

signals! {
    /// Nets of the circuits, and the ports out.
    pub struct Net<L> {
        /// Unit time, scan, CK, Ts.
        pub enables: Instance<Enables, L>,
        /// Pulses of the steppers.
        pub pulse_interpolator: Instance<Pulse, L>,
        /// Commands of the servos on lines.
        pub linear_interpolator: Instance<LinearInterpolator, L>,
        /// Commands of the servos on arcs.
        pub arc_generator: Instance<ArcGenerator, L>,
        /// Both as one.
        pub command_join: Instance<Join, L>,
        /// Corrects the commands, drives the servos.
        pub trajectory_controller: Instance<Trajectory, L>,
        /// Lifts and lowers the pen.
        pub lead_angle: Instance<Lift, L>,
        /// Step pulses of X.
        pub step_x: L::Bit,
        /// Step pulses of Y.
        pub step_y: L::Bit,
        /// Direction of X; high counts down.
        pub dir_x: L::Bit,
        /// Direction of Y.
        pub dir_y: L::Bit,
        /// A free half of the pattern memory awaits a command.
        pub pulse_ready: L::Bit,
        /// A pattern runs.
        pub pulse_busy: L::Bit,
        /// Position command of X in counts.
        pub counts_x: L::I<32> as Analog,
        /// Position command of Y.
        pub counts_y: L::I<32> as Analog,
        /// A target is taken.
        pub lines_ready: L::Bit,
        /// A line is under way.
        pub lines_busy: L::Bit,
        /// There is a free record of an arc.
        pub arcs_ready: L::Bit,
        /// An arc is under way.
        pub arcs_busy: L::Bit,
        /// There is a free record of the profile.
        pub profile_ready: L::Bit,
        /// The profile is under way.
        pub profile_busy: L::Bit,
        /// Torque of X.
        pub torque_x: L::I<16> as Analog,
        /// Torque of Y.
        pub torque_y: L::I<16> as Analog,
        /// Position of the motor of X in counts.
        pub position_x: L::I<31> as Analog,
        /// Position of the motor of Y.
        pub position_y: L::I<31> as Analog,
        /// The pen lift's motor is on.
        pub drive: L::Bit,
        /// It turns downwards.
        pub reverse: L::Bit,
        /// Its speed.
        pub speed: L::U<16>,
        /// Its brake.
        pub brake: L::Bit,
        /// The pen lift moves.
        pub lift_busy: L::Bit,
        /// Something came too late, or cannot be counted: a scan, a sampling time, an edge of an
        /// encoder.
        pub fault: L::Bit,
    }
}

/// Two steppers, two servos and a pen lift on one clock.
#[derive(Debug, Clone)]
pub struct Machine {
    /// Unit time, scan, CK, Ts.
    pub enables: Enables,
    /// Pulses of the steppers.
    pub pulse_interpolator: Pulse,
    /// Commands of the servos on lines.
    pub linear_interpolator: LinearInterpolator,
    /// Commands of the servos on arcs.
    pub arc_generator: ArcGenerator,
    /// Both as one.
    pub command_join: Join,
    /// Corrects the commands, drives the servos.
    pub trajectory_controller: Trajectory,
    /// Lifts and lowers the pen.
    pub lead_angle: Lift,
}

impl Circuit for Machine {
    const NAME: &'static str = "machine";
    const ABOUT: &'static str = "all five circuits as one motion controller";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L>, i: &In<L>) -> Net<L> {
        let enables = Instance::settle(&self.enables, &q.enables, i.rates.clone());
        let low: L::Bit = false.into();
        let pulse = Instance::settle(
            &self.pulse_interpolator,
            &q.pulse_interpolator,
            group::In {
                command: i.pulse.command,
                base: i.pulse.base,
                last: i.pulse.last,
                cyclic: low,
                run: i.pulse.run,
                now: i.pulse.now,
                // Its own counter never ends a unit time: the enable does.
                period: u64::MAX.into(),
                write_period: low,
                unit_end: enables.w.unit,
                write: i.pulse.write,
                write_axis: i.pulse.write_axis,
                write_address: i.pulse.write_address,
                write_half_period: i.pulse.write_half_period,
                write_direction: i.pulse.write_direction,
            },
        );
        let lines = Instance::settle(
            &self.linear_interpolator,
            &q.linear_interpolator,
            interpolator::In {
                scan: enables.w.scan,
                hold: low,
                push: i.lines.push,
                target_x: i.lines.target_x,
                target_y: i.lines.target_y,
                speed: i.lines.speed,
                acceleration_time: i.lines.acceleration_time,
                deceleration_time: i.lines.deceleration_time,
                halt: i.halt,
                clear: low,
            },
        );
        let arcs = Instance::settle(
            &self.arc_generator,
            &q.arc_generator,
            generator::In {
                write: i.arcs.write,
                write_word: i.arcs.write_word,
                write_data: i.arcs.write_data,
                push: i.arcs.push,
                start: i.arcs.start,
                halt: i.halt,
                sample_period: enables.w.sample_led,
            },
        );
        let join = Instance::settle(
            &self.command_join,
            &q.command_join,
            command_join::In {
                take: enables.w.sample,
                line_x: lines.w.x,
                line_y: lines.w.y,
                arc_x: arcs.w.x,
                arc_y: arcs.w.y,
            },
        );
        let of = &i.trajectory;
        let trajectory = Instance::settle(
            &self.trajectory_controller,
            &q.trajectory_controller,
            controller::In {
                write: of.write,
                write_word: of.write_word,
                write_data: of.write_data,
                push: of.push,
                start: of.start,
                halt: i.halt,
                restart: low,
                write_begin: of.write_begin,
                begin_segment: of.begin_segment,
                begin_length: of.begin_length,
                write_path: of.write_path,
                path_address: of.path_address,
                path_data: of.path_data,
                last: of.last,
                path_end: of.path_end,
                period: enables.w.sample_led,
                gain_1: of.gain_1,
                gain_2: of.gain_2,
                position_gain: of.position_gain,
                speed_gain: of.speed_gain,
                integral_gain: of.integral_gain,
                inertia: of.inertia,
                limit: of.limit,
                given: true.into(),
                given_command: [q.command_join.x, q.command_join.y]
                    .map(|counts| counts.resize().shift_left(GUARD)),
                a: of.a,
                b: of.b,
            },
        );
        let lift = Instance::settle(
            &self.lead_angle,
            &q.lead_angle,
            compensator::In {
                a: i.lift.a,
                b: i.lift.b,
                clear: low,
                run: i.lift.run,
                halt: i.halt,
                learn: i.lift.learn,
                common: low,
                last_step: i.lift.last_step,
                ck_period: enables.w.ck_led,
                standstill: i.lift.standstill,
                time_out: i.lift.time_out,
                rest: i.lift.rest,
                seed: i.lift.seed,
                lead_parameter: 0.into(),
                gate: 0.into(),
                write_target: i.lift.write_target,
                write_time: low,
                write_step: i.lift.write_step,
                step_target: i.lift.step_target,
                step_speed: i.lift.step_speed,
                step_time: 0.into(),
            },
        );
        let [torque_x, torque_y] = trajectory.w.torque;
        let [position_x, position_y] = trajectory.w.position;
        let [lost_x, lost_y] = trajectory.w.lost;
        let late = lines.w.late | arcs.w.late | trajectory.w.late | trajectory.w.profile_late;
        let lost = lost_x | lost_y | lift.w.lost;
        Net {
            step_x: pulse.w.step[0],
            step_y: pulse.w.step[1],
            dir_x: pulse.w.dir[0],
            dir_y: pulse.w.dir[1],
            pulse_ready: pulse.w.ready,
            pulse_busy: pulse.w.busy,
            counts_x: join.w.counts_x,
            counts_y: join.w.counts_y,
            lines_ready: lines.w.ready,
            lines_busy: lines.w.busy,
            arcs_ready: arcs.w.ready,
            arcs_busy: arcs.w.busy,
            profile_ready: trajectory.w.ready,
            profile_busy: trajectory.w.busy,
            torque_x,
            torque_y,
            position_x,
            position_y,
            drive: lift.w.drive,
            reverse: lift.w.reverse,
            speed: lift.w.speed,
            brake: lift.w.brake,
            lift_busy: lift.w.busy,
            fault: late | lost | arcs.w.starved | trajectory.w.starved | lines.w.refused,
            enables,
            pulse_interpolator: pulse,
            linear_interpolator: lines,
            arc_generator: arcs,
            command_join: join,
            trajectory_controller: trajectory,
            lead_angle: lift,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L>, w: &Net<L>, _: &In<L>) -> Reg<L> {
        Reg {
            enables: w.enables.next(&self.enables, q.enables),
            pulse_interpolator: w
                .pulse_interpolator
                .next(&self.pulse_interpolator, q.pulse_interpolator),
            linear_interpolator: w
                .linear_interpolator
                .next(&self.linear_interpolator, q.linear_interpolator),
            arc_generator: w.arc_generator.next(&self.arc_generator, q.arc_generator),
            command_join: w.command_join.next(&self.command_join, q.command_join),
            trajectory_controller: w
                .trajectory_controller
                .next(&self.trajectory_controller, q.trajectory_controller),
            lead_angle: w.lead_angle.next(&self.lead_angle, q.lead_angle),
        }
    }

    fn power_on(&self) -> Reg<Sim> {
        Reg {
            enables: self.enables.power_on(),
            pulse_interpolator: self.pulse_interpolator.power_on(),
            linear_interpolator: self.linear_interpolator.power_on(),
            arc_generator: self.arc_generator.power_on(),
            command_join: self.command_join.power_on(),
            trajectory_controller: self.trajectory_controller.power_on(),
            lead_angle: self.lead_angle.power_on(),
        }
    }
}
