//! A job on the machine: steppers, servos and pen lift around it, and what came of it.

use super::host::{Host, Stage};
use super::program::Program;
use super::seen::See;
use super::settings::Settings;
use super::surroundings::{Bodies, Drives, Surroundings};
use super::waves::Plants;
use crate::circuits::lead_angle;
use crate::circuits::machine::Machine;
use crate::hdl::{At, Image, Observer, Sample, Simulator};
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
    /// The servos, sampling time by sampling time; none of [`play_each`].
    pub frames: Vec<Frame>,
    /// The steppers at the end of each unit time, in steps from where the job begins; none of
    /// [`play_each`].
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

/// An event of a run, given in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// A sampling time of the servos.
    Frame(Frame),
    /// End of a unit time of the steppers.
    Unit {
        /// Its last tick.
        tick: u64,
        /// Positions in steps from where the job begins.
        steps: [i64; 2],
    },
    /// A move of the servos begins in this tick, behind the frame of the tick.
    Begun(u64),
    /// The motors are in position in this tick, behind the frame of the tick.
    Ended(u64),
    /// The pen lift is stopped or at rest in this tick, before the frame of the tick.
    Lift(u64),
}

/// Writes down what a tick shows.
struct Bench<'a> {
    see: See,
    each: &'a mut dyn FnMut(Event),
    played: Played,
    lifting: Option<Lifting>,
    /// Sampling times in which the motors have not come to rest.
    waiting: usize,
    /// Ticks before the steppers' first pattern.
    begun: bool,
}

impl Bench<'_> {
    fn take(&mut self, now: &Sample<'_, Machine>, around: &mut Surroundings, host: &Host<'_>) {
        let (see, played) = (&self.see, &mut self.played);
        for (driver, (step, dir)) in around.drivers.iter_mut().zip(see.lines) {
            // The drivers ask for nothing here; the table was compiled for what they need.
            let _ = driver.sample(now.tick, now.get(step), now.get(dir));
        }
        let pulsing = now.get(see.pulse_busy);
        self.begun |= pulsing;
        if pulsing && now.get(see.unit) {
            (self.each)(Event::Unit {
                tick: now.tick,
                steps: from_fn(|axis| around.drivers[axis].position()),
            });
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
            (self.each)(Event::Lift(now.tick));
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
            (self.each)(Event::Lift(now.tick));
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
            (self.each)(Event::Frame(Frame {
                tick: now.tick,
                index: host.index,
                moving: matches!(host.stage, Stage::Move(_)),
                command: see.command.map(|axis| now.get(axis)),
                corrected: see.corrected.map(|axis| now.get(axis)),
                model: see.model.map(|axis| now.get(axis)),
                motor: see.motor.map(|axis| now.get(axis)),
                load: from_fn(|k| around.plants.plants.servos[k].load_position_counts()),
                lift: now.get(lift.position),
            }));
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
    let (mut frames, mut steps, mut step_ticks) = (Vec::new(), Vec::new(), Vec::new());
    let each = &mut |event| match event {
        Event::Frame(frame) => frames.push(frame),
        Event::Unit { tick, steps: at } => {
            steps.push(at);
            step_ticks.push(tick);
        }
        Event::Begun(_) | Event::Ended(_) | Event::Lift(_) => {}
    };
    let played = play_each(circuit, program, settings, observer, each)?;
    Ok(Played {
        frames,
        steps,
        step_ticks,
        ..played
    })
}

/// Plays a program as [`play`] does and gives the events one by one, so that a run of any length
/// takes no memory for them.
///
/// # Errors
/// Those of [`play`].
pub fn play_each(
    circuit: &Machine,
    program: &Program,
    settings: &Settings,
    observer: &mut dyn Observer<Machine>,
    each: &mut dyn FnMut(Event),
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
        each,
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
            (Stage::Ready, Stage::Move(_)) => {
                (bench.each)(Event::Begun(tick));
                bench.played.moves.push(Timed {
                    begun: tick,
                    ended: tick,
                });
            }
            (Stage::Settle, Stage::Ready | Stage::Done) => {
                (bench.each)(Event::Ended(tick));
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
