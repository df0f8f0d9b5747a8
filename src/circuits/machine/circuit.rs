//! The machine: all circuits that the control computer of an X-Y plotter is connected to.
//!
//! ```text
//!                          ┌─────────┐
//!  periods ───────────────▶│         ├──▶ step_x, step_y, dir_x, dir_y
//!  halt ──────────────────▶│         ├──▶ torque_x, torque_y
//!  pulse, lines, arcs, … ─▶│ machine ├──▶ drive, reverse, speed, brake
//!  encoders ──────────────▶│         ├──▶ counts_x, counts_y, position_x, position_y
//!                          └─────────┘
//! ```

use super::enables::In as Rates;
use super::ports::{Lift, Lines, Pulse, Trajectory};
use super::{CommandJoin, Enables, command_join};
use crate::circuits::arc_generator::generator::{self, ArcGenerator, Segments};
use crate::circuits::blocks::difference_engine::of_record;
use crate::circuits::blocks::record_sequencer::given_of_records;
use crate::circuits::lead_angle::{Compensator, LeadForm, LeadFrom, Memory, compensator};
use crate::circuits::linear_interpolator::LinearInterpolator;
use crate::circuits::linear_interpolator::command_source::{self, Orders};
use crate::circuits::pulse_interpolator::{self, Group, group};
use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::circuits::trajectory_controller::{self, TrajectoryController, controller};
use crate::prelude::*;

/// Two steppers, two servos and a pen lift on one clock.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Machine {
    /// Step pulses of the step motors.
    pub pulse_interpolator: Group,
    /// Commands of the servos on lines.
    pub linear_interpolator: LinearInterpolator,
    /// Commands of the servos on arcs.
    pub arc_generator: ArcGenerator,
    /// Correction of the commands, and the servos.
    pub trajectory_controller: TrajectoryController,
    /// Control of the pen lift.
    pub lead_angle: Compensator,
}

impl Machine {
    /// Builds a machine of the circuits' own widths, with paths of up to 256 segments.
    /// `correction` is that of the servos' commands, `history` the memory of the pen lift's
    /// positions; `lead_times` are those of its steps in CKs.
    pub fn new(correction: Correction, history: Memory, lead_times: Image) -> Self {
        let widths = trajectory_controller::Widths {
            segment: 8,
            ..trajectory_controller::Widths::FULL
        };
        let pulse = pulse_interpolator::Widths::default();
        // The machine's own enable ends the unit time.
        let period = u64::MAX.cut(pulse.period);
        Machine {
            pulse_interpolator: Group::new(2, pulse, Default::default(), period),
            linear_interpolator: LinearInterpolator::default(),
            arc_generator: ArcGenerator::default(),
            trajectory_controller: TrajectoryController::new(
                widths,
                2,
                correction,
                Default::default(),
            ),
            lead_angle: Compensator {
                widths: Default::default(),
                lead_from: LeadFrom::Time {
                    memory: history,
                    form: LeadForm::Embodiment,
                },
                variant: Default::default(),
                rom: lead_times,
            },
        }
    }

    fn enables(&self) -> Enables {
        Enables {
            width: self.arc_generator.widths.period,
        }
    }

    fn command_join(&self) -> CommandJoin {
        CommandJoin {
            line: self.linear_interpolator.widths.position,
            arc: self.arc_generator.widths.position,
        }
    }
}

signals! { for Machine as c;
    /// Input ports: the control computer, the encoders.
    pub struct In {
        /// Ends every movement at once.
        pub halt: Bit,
        /// Periods of all enables.
        pub rates: Rates(&c.enables()),
        /// Inputs of the pulse interpolator.
        pub pulse: Pulse(&c.pulse_interpolator),
        /// Inputs of the linear interpolator.
        pub lines: Lines(&c.linear_interpolator),
        /// Inputs of the arc generator.
        pub arcs: Segments(&c.arc_generator.widths),
        /// Inputs of the trajectory controller.
        pub trajectory: Trajectory(&c.trajectory_controller),
        /// Inputs of the lead-angle compensator.
        pub lift: Lift(&c.lead_angle),
    }
    /// The circuits.
    pub struct Parts {
        /// Counters of unit time, scan, CK and Ts.
        pub enables: Part<Enables>(c.enables()),
        /// Step pulses of the step motors.
        pub pulse_interpolator: Part<Group>(c.pulse_interpolator.clone()),
        /// Commands of the servos on lines.
        pub linear_interpolator: Part<LinearInterpolator>(c.linear_interpolator.clone()),
        /// Commands of the servos on arcs.
        pub arc_generator: Part<ArcGenerator>(c.arc_generator.clone()),
        /// Sum of both commands.
        pub command_join: Part<CommandJoin>(c.command_join()),
        /// Correction of the commands, and the servos.
        pub trajectory_controller: Part<TrajectoryController>(c.trajectory_controller.clone()),
        /// Control of the pen lift.
        pub lead_angle: Part<Compensator>(c.lead_angle.clone()),
    }
    /// Output ports.
    pub struct Net {
        /// Step pulses of X; a step is a rising edge.
        pub step_x: Bit,
        /// Step pulses of Y; a step is a rising edge.
        pub step_y: Bit,
        /// Direction of X; high counts down.
        pub dir_x: Bit,
        /// Direction of Y; high counts down.
        pub dir_y: Bit,
        /// Ready: the pulse interpolator accepts a command without `now`.
        pub pulse_ready: Bit,
        /// A pattern is running.
        pub pulse_busy: Bit,
        /// Position command of X, in counts.
        pub counts_x: I(c.command_join().line) as Analog,
        /// Position command of Y, in counts.
        pub counts_y: I(c.command_join().line) as Analog,
        /// Ready: a target is accepted.
        pub lines_ready: Bit,
        /// A line is running.
        pub lines_busy: Bit,
        /// A record of an arc is free to be written.
        pub arcs_ready: Bit,
        /// An arc is running.
        pub arcs_busy: Bit,
        /// A record of the profile is free to be written.
        pub profile_ready: Bit,
        /// The profile is running.
        pub profile_busy: Bit,
        /// Torque command of X.
        pub torque_x: I(c.trajectory_controller.widths.torque) as Analog,
        /// Torque command of Y.
        pub torque_y: I(c.trajectory_controller.widths.torque) as Analog,
        /// Position of the motor of X, in counts.
        pub position_x: I(c.trajectory_controller.widths.position) as Analog,
        /// Position of the motor of Y, in counts.
        pub position_y: I(c.trajectory_controller.widths.position) as Analog,
        /// The motor of the pen lift is on.
        pub drive: Bit,
        /// Direction of the pen lift's motor; high counts down.
        pub reverse: Bit,
        /// Speed command of the pen lift's motor.
        pub speed: U(c.lead_angle.widths.speed),
        /// Brake of the pen lift.
        pub brake: Bit,
        /// A step of the pen lift is running.
        pub lift_busy: Bit,
        /// A scan, a sampling time or a segment came too late, a target was refused, or an encoder
        /// edge was lost.
        pub fault: Bit,
    }
}

impl Circuit for Machine {
    const NAME: &'static str = "machine";
    const ABOUT: &'static str = "all five circuits as one motion controller";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let In {
            halt,
            rates,
            pulse,
            lines,
            arcs,
            trajectory,
            lift,
        } = i;
        let enables = p.enables.settle(rates);
        let period = self.pulse_interpolator.widths.period;
        let pulse = p.pulse_interpolator.settle(group::In {
            command: pulse.command,
            base: pulse.base,
            last: pulse.last,
            run: pulse.run,
            now: pulse.now,
            // Its own counter never ends a unit time: the enable does.
            period: U::new(u64::MAX.cut(period), period),
            unit_end: enables.w.unit,
            port: pulse.port,
            ..group::In::low(&self.pulse_interpolator)
        });
        let lines = p.linear_interpolator.settle(command_source::In {
            scan: enables.w.scan,
            orders: Orders {
                push: lines.push,
                target_x: lines.target_x,
                target_y: lines.target_y,
                settings: lines.settings,
                halt,
            },
            ..command_source::In::low(&self.linear_interpolator)
        });
        let arcs = p.arc_generator.settle(generator::In {
            segments: arcs,
            halt,
            sample_period: enables.w.sample_led,
        });
        let join = p.command_join.settle(command_join::In {
            take: enables.w.sample,
            line_x: lines.w.x,
            line_y: lines.w.y,
            arc_x: arcs.w.x,
            arc_y: arcs.w.y,
        });
        let widths = self.trajectory_controller.widths;
        let guarded = |counts: I| counts.resize(widths.point).shift_left(widths.guard());
        let trajectory = p.trajectory_controller.settle(controller::In {
            record: trajectory.record,
            start: trajectory.start,
            halt,
            path: trajectory.path,
            last: trajectory.last,
            path_end: trajectory.path_end,
            period: enables.w.sample_led,
            axis_gain_1: vec![trajectory.model_gains.gain_1; self.trajectory_controller.axes],
            axis_gain_2: vec![trajectory.model_gains.gain_2; self.trajectory_controller.axes],
            model_gains: trajectory.model_gains,
            position_gain: trajectory.position_gain,
            speed_gain: trajectory.speed_gain,
            integral_gain: trajectory.integral_gain,
            inertia: trajectory.inertia,
            limit: trajectory.limit,
            given: Bit::high(),
            given_command: vec![guarded(join.q.x), guarded(join.q.y)],
            a: trajectory.a,
            b: trajectory.b,
            ..controller::In::low(&self.trajectory_controller)
        });
        let lift = p.lead_angle.settle(compensator::In {
            a: lift.a,
            b: lift.b,
            run: lift.run,
            halt,
            learn: lift.learn,
            last_step: lift.last_step,
            ck_period: enables.w.ck_led,
            standstill: lift.standstill,
            time_out: lift.time_out,
            rest: lift.rest,
            seed: lift.seed,
            write_target: lift.write_target,
            write_step: lift.write_step,
            step_target: lift.step_target,
            step_speed: lift.step_speed,
            ..compensator::In::low(&self.lead_angle)
        });
        let late = lines.w.late | arcs.w.late | trajectory.w.late | trajectory.w.profile_late;
        let lost = trajectory.w.lost[0] | trajectory.w.lost[1] | lift.w.lost;
        let net = Net {
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
            torque_x: trajectory.w.torque[0],
            torque_y: trajectory.w.torque[1],
            position_x: trajectory.w.position[0],
            position_y: trajectory.w.position[1],
            drive: lift.w.drive,
            reverse: lift.w.reverse,
            speed: lift.w.speed,
            brake: lift.w.brake,
            lift_busy: lift.w.busy,
            fault: late | lost | arcs.w.starved | trajectory.w.starved | lines.w.refused,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let mut blocks = generator::of_records(&now.p.arc_generator.p);
        blocks.push(of_record(&now.p.trajectory_controller.p.profile));
        let mut all = given_of_records(blocks).to_vec();
        all.push(Property::given(
            "the lead time of a step is at most the largest code",
            self.lead_angle.is_code(now.p.lead_angle.w.lead_time),
        ));
        all
    }

    fn objection(&self) -> Option<String> {
        let axes = [
            self.pulse_interpolator.axes,
            self.trajectory_controller.axes,
        ];
        (axes != [2, 2]).then(|| "X and Y are two axes".into())
    }
}
