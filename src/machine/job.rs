//! A job on the machine: steppers, servos and pen lift around it, and what came of it.

use super::circuit::{In, Machine, Reg};
use super::host::{Host, Stage};
use super::program::Program;
use super::settings::Settings;
use super::waves::{Plants, Signals};
use crate::kernel::{Observer, RunError, Sample, Simulator, With, WithIn};
use crate::lead_angle::settings::SPEED_UNIT_COUNTS_PER_S;
use crate::lead_angle::{Compensator, Variant};
use crate::logic::{Image, Sim};
use crate::plant::{BrakedBody, TwoMassAxis};
use crate::pulse_interpolator::step_dir::Driver;
use crate::pulse_interpolator::{self as pulse, StepTiming};
use crate::settings::{JobError, SettingError};
use crate::trajectory_controller::job::patience;
use std::array::from_fn;

/// The machine with its plants beside it in the waves.
pub type Plant = With<Machine, Plants>;

/// The machine of these settings.
#[must_use]
pub fn machine(settings: &Settings) -> Plant {
    let lift = settings.lift();
    let codes = lift
        .steps
        .iter()
        .map(|step| lift.code(step.lead_ms).unwrap_or(0));
    With::new(Machine {
        enables: Default::default(),
        pulse_interpolator: pulse::Group::new(pulse::Variant::Safe, u64::MAX),
        linear_interpolator: Default::default(),
        arc_generator: Default::default(),
        command_join: Default::default(),
        trajectory_controller: super::circuit::Trajectory::new(
            settings.correction,
            Default::default(),
        ),
        lead_angle: Compensator::new(Variant::default(), Image::new(codes)),
    })
}

/// Where everything is at a sampling time of the servos, from where the job begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The tick in which the torques stand.
    pub tick: u64,
    /// The move that the servos are at.
    pub index: usize,
    /// They are on the way; or the pen moves, or the motors come to rest.
    pub moving: bool,
    /// Position command in counts.
    pub command: [i64; 2],
    /// The corrected command, in guard units.
    pub corrected: [i64; 2],
    /// Of the servos' models, in guard units.
    pub model: [i64; 2],
    /// Of the motors, in counts.
    pub motor: [i64; 2],
    /// Of the loads, in counts.
    pub load: [f64; 2],
    /// Of the pen lift, in counts.
    pub lift: i64,
}

/// A step of the pen lift.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lifting {
    /// The move that it was for.
    pub index: usize,
    /// The pen goes down.
    pub down: bool,
    /// Tick of the control signal.
    pub fired: u64,
    /// Tick in which it was complete.
    pub completed: u64,
    /// Lead time that was applied, in CKs.
    pub lead: u64,
    /// Way past the target in the direction of the move, in counts.
    pub error: i64,
    /// Lead time that was learned, in CKs.
    pub learned: Option<u64>,
}

/// When a move of the servos was under way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Timed {
    /// The tick in which it was begun.
    pub begun: u64,
    /// The tick in which the motors were in position.
    pub ended: u64,
}

/// What came of a job.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Played {
    /// Ticks of the run.
    pub ticks: u64,
    /// The servos, sampling time by sampling time.
    pub frames: Vec<Frame>,
    /// The steppers at the end of each unit time, in steps from where the job begins.
    pub steps: Vec<[i64; 2]>,
    /// The ticks of these.
    pub step_ticks: Vec<u64>,
    /// Pulses of the steppers, either way.
    pub pulses: [u64; 2],
    /// The moves of the servos.
    pub moves: Vec<Timed>,
    /// The steps of the pen lift.
    pub liftings: Vec<Lifting>,
    /// Position commands at the end, in counts.
    pub command: [i64; 2],
    /// Encoders of the servos at the end, in counts.
    pub motor: [i64; 2],
    /// Steppers at the end, in steps.
    pub stepper: [i64; 2],
    /// The job's end was reached: all moves done, motors on their last count, steppers at rest.
    pub settled: bool,
    /// Something came too late, or could not be counted.
    pub fault: bool,
}

/// Everything around the circuit.
struct Surroundings {
    servos: [TwoMassAxis; 2],
    lift: BrakedBody,
    drivers: [Driver; 2],
}

impl Surroundings {
    fn new(settings: &Settings) -> Result<Self, SettingError> {
        let tick_s = 1.0 / settings.clock_hz as f64;
        Ok(Surroundings {
            servos: [
                TwoMassAxis::new(&settings.axis, tick_s)?,
                TwoMassAxis::new(&settings.axis, tick_s)?,
            ],
            lift: BrakedBody::new(&settings.lift, tick_s)?,
            drivers: [0, 1].map(|_| Driver::new(StepTiming::default())),
        })
    }

    /// Steps the plants by what the registers say, and gives the encoders' channels.
    fn step(&mut self, q: &Reg<Sim>, i: &mut In<Sim>) {
        for (axis, servo) in self.servos.iter_mut().enumerate() {
            let registers = &q.trajectory_controller.axes[axis];
            let (a, b) = servo.step(registers.servo.arithmetic.torque.get());
            i.trajectory.a[axis] = a.into();
            i.trajectory.b[axis] = b.into();
        }
        let lift = &q.lead_angle;
        let speed = lift.target_setter.speed.get() * u64::from(SPEED_UNIT_COUNTS_PER_S);
        let (a, b) = self.lift.step(
            lift.sequencer.drive.get(),
            lift.sequencer.reverse.get(),
            speed as f64,
            lift.comparator.control.get(),
        );
        i.lift.a = a.into();
        i.lift.b = b.into();
    }
}

/// Writes down what a tick shows.
struct Bench {
    played: Played,
    lifting: Option<Lifting>,
    /// Sampling times in which the motors have not come to rest.
    waiting: usize,
    /// Ticks before the steppers' first pattern.
    begun: bool,
}

impl Bench {
    fn take(&mut self, now: &Sample<'_, Plant>, around: &mut Surroundings, host: &Host<'_>) {
        let (q, w) = (now.q, now.w);
        let played = &mut self.played;
        let lines = [
            (w.step_x.get(), w.dir_x.get()),
            (w.step_y.get(), w.dir_y.get()),
        ];
        for (driver, (step, dir)) in around.drivers.iter_mut().zip(lines) {
            // The drivers ask for nothing here; the table was compiled for what they need.
            let _ = driver.sample(now.tick, step, dir);
        }
        self.begun |= w.pulse_busy.get();
        if w.enables.w.unit.get() && self.begun && w.pulse_busy.get() {
            played
                .steps
                .push(from_fn(|axis| around.drivers[axis].position()));
            played.step_ticks.push(now.tick);
        }
        played.fault |= w.fault.get();
        let lift = &w.lead_angle.w;
        if lift.fire.get() {
            self.lifting = Some(Lifting {
                index: host.index,
                down: host.lowers(),
                fired: now.tick,
                completed: now.tick,
                lead: lift.lead_time.get(),
                error: 0,
                learned: None,
            });
        }
        if let Some(lifting) = &mut self.lifting
            && lift.complete.get()
        {
            let past = lift.position.get() - lift.target.get();
            let upward = lifting.down == (host.pen_down_counts() > 0);
            lifting.completed = now.tick;
            lifting.error = if upward { past } else { -past };
        }
        if lift.learned.get()
            && let Some(lifting) = &mut self.lifting
        {
            lifting.learned = Some(lift.learned_time.get());
        }
        if !w.lift_busy.get()
            && let Some(lifting) = self.lifting.take()
        {
            played.liftings.push(lifting);
        }
        let axes = &q.trajectory_controller.axes;
        if w.trajectory_controller.w.axes[0].w.driven.get() {
            played.frames.push(Frame {
                tick: now.tick,
                index: host.index,
                moving: matches!(host.stage, Stage::Move(_)),
                command: [q.command_join.x.get(), q.command_join.y.get()],
                corrected: from_fn(|k| axes[k].corrector.corrected.get()),
                model: from_fn(|k| axes[k].servo.model.integrators.position.get()),
                motor: [w.position_x.get(), w.position_y.get()],
                load: from_fn(|k| around.servos[k].load_position_counts()),
                lift: lift.position.get(),
            });
            self.waiting = match host.stage {
                Stage::Settle => self.waiting + 1,
                _ => 0,
            };
        }
    }
}

/// Plays a program, seen by `observer` too, until steppers and servos have done the job, or the
/// motors do not settle for too long.
///
/// # Errors
/// A parameter of a plant is out of range, or what `observer` objects to.
pub fn play(
    circuit: &Plant,
    program: &Program,
    settings: &Settings,
    observer: &mut dyn Observer<Plant>,
) -> Result<Played, JobError> {
    let mut around = Surroundings::new(settings)?;
    let mut host = Host::new(program, settings);
    let mut bench = Bench {
        played: Played::default(),
        lifting: None,
        waiting: 0,
        begun: false,
    };
    let patience = patience(&program.path);
    let mut simulator = Simulator::new(circuit)?;
    loop {
        let before = host.stage;
        let i = {
            let q = simulator.registers();
            let mut i = host.ports(&q);
            around.step(&q, &mut i);
            i
        };
        let beside = Signals::of(&around.servos, &around.lift, &around.drivers);
        let i = WithIn { i, beside };
        let (next, seen) = simulator.step(i, |now| {
            bench.take(now, &mut around, &host);
            host.take(&now.i.i, now.w);
            let flow = observer.sample(now)?;
            let w = now.w;
            bench.played.command = [w.counts_x.get(), w.counts_y.get()];
            bench.played.motor = [w.position_x.get(), w.position_y.get()];
            Ok::<_, RunError>((flow, w.pulse_busy.get()))
        });
        simulator = next;
        let (flow, pulsing) = seen?;
        let tick = bench.played.ticks;
        bench.played.ticks += 1;
        match (before, host.stage) {
            (Stage::Ready, Stage::Move(_)) => bench.played.moves.push(Timed {
                begun: tick,
                ended: tick,
            }),
            (Stage::Settle, Stage::Ready | Stage::Done) => {
                if let Some(timed) = bench.played.moves.last_mut() {
                    timed.ended = tick;
                }
            }
            _ => {}
        }
        let over = host.stage == Stage::Done && bench.begun && !pulsing && host.pulses_given();
        bench.played.settled = over;
        if over || bench.waiting > patience || flow.is_break() {
            break;
        }
    }
    bench.played.stepper = from_fn(|axis| around.drivers[axis].position());
    bench.played.pulses = from_fn(|axis| around.drivers[axis].pulses());
    Ok(bench.played)
}
