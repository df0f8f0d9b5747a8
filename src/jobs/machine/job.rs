//! A job on the machine: steppers, servos and pen lift around it, and what came of it.

use super::host::{Host, Stage};
use super::program::Program;
use super::settings::Settings;
use super::surroundings::{Bodies, Drives, Surroundings};
use super::waves::Plants;
use crate::circuits::lead_angle;
use crate::circuits::machine::Machine;
use crate::hdl::{At, Image, Observer, Sample, Simulator, Watcher};
use crate::jobs::trajectory_controller::job::patience;
use crate::settings::JobError;
use std::array::from_fn;

/// The machine of these settings.
#[must_use]
pub fn machine(settings: &Settings) -> Machine {
    let (lift, widths) = (settings.lift(), lead_angle::Widths::default());
    let codes = lift
        .steps
        .iter()
        .map(|step| lift.code(step.lead_ms).unwrap_or(0));
    let lead_times = Image::of(widths.step, widths.time(), codes);
    Machine::new(
        settings.correction,
        settings.lift_history.memory(),
        lead_times,
    )
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
    /// What of it.
    pub causes: Causes,
}

/// What came too late, or could not be counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Causes {
    /// A scan of the linear interpolator.
    pub scan: bool,
    /// A sampling time of the arc generator or of the trajectory controller.
    pub sample: bool,
    /// An edge of a servo's encoder.
    pub servo: bool,
    /// An edge of the pen lift's encoder.
    pub lift: bool,
}

/// What is looked at.
struct See {
    /// Step and direction of X and Y.
    lines: [(At<bool>, At<bool>); 2],
    pulse_busy: At<bool>,
    unit: At<bool>,
    fault: At<bool>,
    scan: [At<bool>; 2],
    sample: [At<bool>; 5],
    servo: [At<bool>; 2],
    lift_lost: At<bool>,
    lift: SeeLift,
    lift_busy: At<bool>,
    driven: At<bool>,
    command: [At<i64>; 2],
    corrected: [At<i64>; 2],
    model: [At<i64>; 2],
    counts: [At<i64>; 2],
    motor: [At<i64>; 2],
}

impl See {
    /// Whether a tick that shows the same again is written down no other than this one.
    fn is_quiet(&self, now: &Sample<'_, Machine>) -> bool {
        let lift = &self.lift;
        let strobes = [
            self.unit,
            self.driven,
            lift.fire,
            lift.complete,
            lift.learned,
        ];
        strobes.iter().all(|&strobe| !now.get(strobe))
    }
}

/// What is looked at of the pen lift.
struct SeeLift {
    fire: At<bool>,
    complete: At<bool>,
    learned: At<bool>,
    learned_time: At<u64>,
    lead_time: At<u64>,
    position: At<i64>,
    target: At<i64>,
}

impl See {
    fn of(watch: &Watcher<'_, Machine>) -> Self {
        let (p, w) = (&watch.p, &watch.w);
        let lift = &p.lead_angle.w;
        let (lines, arcs) = (&p.linear_interpolator.w, &p.arc_generator.w);
        let (trajectory, axes) = (&p.trajectory_controller.w, &p.trajectory_controller.p.axes);
        See {
            lines: [(w.step_x, w.dir_x), (w.step_y, w.dir_y)]
                .map(|(step, dir)| (watch.at(step), watch.at(dir))),
            pulse_busy: watch.at(w.pulse_busy),
            unit: watch.at(p.enables.w.unit),
            fault: watch.at(w.fault),
            scan: [lines.late, lines.refused].map(|bit| watch.at(bit)),
            sample: [
                arcs.late,
                arcs.starved,
                trajectory.late,
                trajectory.profile_late,
                trajectory.starved,
            ]
            .map(|bit| watch.at(bit)),
            servo: from_fn(|axis| watch.at(trajectory.lost[axis])),
            lift_lost: watch.at(lift.lost),
            lift: SeeLift {
                fire: watch.at(lift.fire),
                complete: watch.at(lift.complete),
                learned: watch.at(lift.learned),
                learned_time: watch.at(lift.learned_time),
                lead_time: watch.at(lift.lead_time),
                position: watch.at(lift.position),
                target: watch.at(lift.target),
            },
            lift_busy: watch.at(w.lift_busy),
            driven: watch.at(axes[0].w.driven),
            command: [p.command_join.q.x, p.command_join.q.y].map(|axis| watch.at(axis)),
            corrected: from_fn(|k| watch.at(axes[k].p.corrector.q.corrected)),
            model: from_fn(|k| watch.at(axes[k].p.servo.p.model.p.integrators.q.position)),
            counts: [w.counts_x, w.counts_y].map(|axis| watch.at(axis)),
            motor: [w.position_x, w.position_y].map(|axis| watch.at(axis)),
        }
    }
}

/// Writes down what a tick shows.
struct Bench {
    see: See,
    played: Played,
    lifting: Option<Lifting>,
    /// Sampling times in which the motors have not come to rest.
    waiting: usize,
    /// Ticks before the steppers' first pattern.
    begun: bool,
}

impl Bench {
    fn take(&mut self, now: &Sample<'_, Machine>, around: &mut Surroundings, host: &Host<'_>) {
        let (see, played) = (&self.see, &mut self.played);
        for (driver, (step, dir)) in around.drivers.iter_mut().zip(see.lines) {
            // The drivers ask for nothing here; the table was compiled for what they need.
            let _ = driver.sample(now.tick, now.get(step), now.get(dir));
        }
        let pulsing = now.get(see.pulse_busy);
        self.begun |= pulsing;
        if pulsing && now.get(see.unit) {
            played
                .steps
                .push(from_fn(|axis| around.drivers[axis].position()));
            played.step_ticks.push(now.tick);
        }
        if now.get(see.fault) {
            let any = |bits: &[At<bool>]| bits.iter().any(|&bit| now.get(bit));
            let causes = &mut played.causes;
            played.fault = true;
            causes.scan |= any(&see.scan);
            causes.sample |= any(&see.sample);
            causes.servo |= any(&see.servo);
            causes.lift |= now.get(see.lift_lost);
        }
        let lift = &see.lift;
        if now.get(lift.fire) {
            self.lifting = Some(Lifting {
                index: host.index,
                down: host.lowers(),
                fired: now.tick,
                completed: now.tick,
                lead: now.get(lift.lead_time),
                error: 0,
                learned: None,
            });
        }
        if let Some(lifting) = &mut self.lifting
            && now.get(lift.complete)
        {
            let past = now.get(lift.position) - now.get(lift.target);
            let upward = lifting.down == (host.pen_down_counts() > 0);
            lifting.completed = now.tick;
            lifting.error = if upward { past } else { -past };
        }
        if let Some(lifting) = &mut self.lifting
            && now.get(lift.learned)
        {
            lifting.learned = Some(now.get(lift.learned_time));
        }
        if !now.get(see.lift_busy)
            && let Some(lifting) = self.lifting.take()
        {
            played.liftings.push(lifting);
        }
        if now.get(see.driven) {
            played.frames.push(Frame {
                tick: now.tick,
                index: host.index,
                moving: matches!(host.stage, Stage::Move(_)),
                command: see.command.map(|axis| now.get(axis)),
                corrected: see.corrected.map(|axis| now.get(axis)),
                model: see.model.map(|axis| now.get(axis)),
                motor: see.motor.map(|axis| now.get(axis)),
                load: from_fn(|k| around.plants.plants.servos[k].load_position_counts()),
                lift: now.get(lift.position),
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
    circuit: &Machine,
    program: &Program,
    settings: &Settings,
    observer: &mut dyn Observer<Machine>,
) -> Result<Played, JobError> {
    let (mut simulator, (drives, mut host, see)) =
        Simulator::watching_beside(circuit, &Plants, observer.needs_all(), |watch| {
            let host = Host::new(circuit, program, settings, watch);
            (Drives::of(watch), host, See::of(watch))
        })?;
    let mut around = Surroundings::new(settings, drives)?;
    let mut i = host.standing(circuit);
    let mut bench = Bench {
        see,
        played: Played::default(),
        lifting: None,
        waiting: 0,
        begun: false,
    };
    let patience = patience(&program.path);
    loop {
        let before = host.stage;
        let by = simulator.state(|now| {
            host.drive(&mut i, now);
            around.driven(now)
        });
        around.step(&by, &mut i);
        if observer.looks(simulator.tick()) {
            simulator.show::<Plants>(&around.signals())?;
        }
        let mut quiet = true;
        let (pulsing, flow) = simulator.look(&i, &mut *observer, |now| {
            bench.take(now, &mut around, &host);
            host.take(now);
            quiet = bench.see.is_quiet(now);
            bench.played.command = bench.see.counts.map(|axis| now.get(axis));
            bench.played.motor = bench.see.motor.map(|axis| now.get(axis));
            now.get(bench.see.pulse_busy)
        })?;
        let tick = simulator.tick();
        bench.played.ticks = tick + 1;
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
        let ends = over || bench.waiting > patience || flow.is_break();
        let most = match quiet && host.stands() && !ends {
            true => simulator.unseen(&observer),
            false => 1,
        };
        let step = |bodies: &mut Bodies| bodies.step(&by);
        around
            .plants
            .go_on(most, step, |ticks| simulator.go_on(ticks));
        if ends {
            break;
        }
    }
    bench.played.stepper = from_fn(|axis| around.drivers[axis].position());
    bench.played.pulses = from_fn(|axis| around.drivers[axis].pulses());
    Ok(bench.played)
}
