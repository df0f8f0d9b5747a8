//! Run of a job on the machine, with steppers, servos and pen lift around it, and its result.

use super::host::{Host, Stage};
use super::program::Program;
use super::seen::See;
use super::settings::Settings;
use super::surroundings::{Bodies, Drives, Surroundings};
use super::waves::Plants;
use crate::circuits::lead_angle;
use crate::circuits::machine::Machine;
use crate::hdl::{At, Image};
use crate::jobs::JobError;
use crate::jobs::trajectory_controller::job::patience;
use crate::sim::{Observer, Sample, Simulator};
use std::array::from_fn;

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

/// State of all parts at a sampling time of the servos, relative to the start of the job.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Tick in which the torques are output.
    pub tick: u64,
    /// Index of the servos' move.
    pub index: usize,
    /// True if the servos move; false while the pen moves or the motors come to rest.
    pub moving: bool,
    /// Position command in counts.
    pub command: [i64; 2],
    /// Corrected command in guard units.
    pub corrected: [i64; 2],
    /// Position of the servos' models in guard units.
    pub model: [i64; 2],
    /// Position of the motors in counts.
    pub motor: [i64; 2],
    /// Position of the loads in counts.
    pub load: [f64; 2],
    /// Position of the pen lift in counts.
    pub lift: i64,
}

/// Step of the pen lift.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lifting {
    /// Index of its move.
    pub index: usize,
    /// True if the pen goes down.
    pub down: bool,
    /// Tick of the control signal.
    pub fired: u64,
    /// Tick of completion.
    pub completed: u64,
    /// Lead time applied, in CKs.
    pub lead: u64,
    /// Distance past the target in the direction of the move, in counts.
    pub error: i64,
    /// Lead time learned, in CKs.
    pub learned: Option<u64>,
}

/// Time of a servo move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Timed {
    /// Tick in which it began.
    pub begun: u64,
    /// Tick in which the motors were in position.
    pub ended: u64,
}

/// Result of a job.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Played {
    /// Number of ticks of the run.
    pub ticks: u64,
    /// States of the servos, one per sampling time; empty for [`play_each`].
    pub frames: Vec<Frame>,
    /// Positions of the steppers at the end of each unit time, in steps from the start of the job;
    /// empty for [`play_each`].
    pub steps: Vec<[i64; 2]>,
    /// Ticks of these positions.
    pub step_ticks: Vec<u64>,
    /// Number of pulses of the steppers, in either direction.
    pub pulses: [u64; 2],
    /// Moves of the servos.
    pub moves: Vec<Timed>,
    /// Steps of the pen lift.
    pub liftings: Vec<Lifting>,
    /// Position commands at the end, in counts.
    pub command: [i64; 2],
    /// Encoders of the servos at the end, in counts.
    pub motor: [i64; 2],
    /// Steppers at the end, in steps.
    pub stepper: [i64; 2],
    /// True if the job's end was reached: all moves done, motors on their last count, steppers at
    /// rest.
    pub settled: bool,
    /// True if something was too late or could not be counted.
    pub fault: bool,
    /// Causes of the fault.
    pub causes: Causes,
}

/// Causes of a fault: true for each part that was too late or could not be counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Causes {
    /// Scan of the linear interpolator.
    pub scan: bool,
    /// Sampling time of the arc generator or of the trajectory controller.
    pub sample: bool,
    /// Edge of a servo's encoder.
    pub servo: bool,
    /// Edge of the pen lift's encoder.
    pub lift: bool,
}

/// Event of a run; events come in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// Sampling time of the servos.
    Frame(Frame),
    /// End of a unit time of the steppers.
    Unit {
        /// Last tick of the unit time.
        tick: u64,
        /// Positions in steps from the start of the job.
        steps: [i64; 2],
    },
    /// A move of the servos begins in this tick, after the frame of the tick.
    Begun(u64),
    /// The motors are in position in this tick, after the frame of the tick.
    Ended(u64),
    /// The pen lift stops or comes to rest in this tick, before the frame of the tick.
    Lift(u64),
}

/// Recorder of ticks.
struct Bench<'a> {
    see: See,
    each: &'a mut dyn FnMut(Event),
    played: Played,
    lifting: Option<Lifting>,
    /// Number of sampling times for which the motors have not come to rest.
    waiting: usize,
    /// True once the steppers' first pattern has begun.
    begun: bool,
}

impl Bench<'_> {
    fn take(&mut self, now: &Sample<'_, Machine>, around: &mut Surroundings, host: &Host<'_>) {
        let (see, played) = (&self.see, &mut self.played);
        for (driver, (step, dir)) in around.drivers.iter_mut().zip(see.lines) {
            // The drivers have no requirements here; the table was compiled for theirs.
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

/// Plays a program until steppers and servos have done the job, or the motors do not settle for
/// too long; `observer` sees it too.
///
/// # Errors
/// Returns an error if a parameter of a plant is out of range, or the error of `observer`.
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

/// Plays a program as [`play`] does and passes the events to `each`, so that memory use does not
/// depend on the length of the run.
///
/// # Errors
/// Returns the errors of [`play`].
pub fn play_each(
    circuit: &Machine,
    program: &Program,
    settings: &Settings,
    observer: &mut dyn Observer<Machine>,
    each: &mut dyn FnMut(Event),
) -> Result<Played, JobError> {
    let (mut simulator, (drives, mut host, see)) =
        Simulator::watching_beside(circuit, &Plants, observer.needs(), |watch| {
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
        simulator.watch_for(&observer);
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
