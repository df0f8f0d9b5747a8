//! Sequence of positionings: a compensator, a body, and its brake.

use super::computer::{ControlComputer, word};
use super::sensor::{Sensor, carrier};
use super::settings::{Completion, SPEED_UNIT_COUNTS_PER_S, Settings, TimeSource};
use crate::circuits::lead_angle::compensator::In;
use crate::circuits::lead_angle::{Compensator, Variant, Widths};
use crate::hdl::{At, Image, Value};
use crate::jobs::JobError;
use crate::plant::waves::{Body, BodySignals};
use crate::plant::{BrakedBody, Operation};
use crate::sim::{Observer, Sample, Simulator, Watcher};

/// Widths of the jobs' compensator.
pub(super) const WIDTHS: Widths = Widths::FULL;

/// Time after passing its target at which the control computer stops a body, in seconds.
const MISSED_S: f64 = 0.1;
/// Time after which an incomplete positioning is given up, in seconds.
const PATIENCE_S: f64 = 600.0;

/// Input ports of a compensator.
pub(super) type Ports = In<Value>;

pub fn positioner(settings: &Settings) -> Compensator {
    let steps = settings.steps.iter();
    let codes = steps.map(|step| settings.code(step.lead_ms).unwrap_or(0));
    let rom = match settings.time_source {
        TimeSource::Rom => Image::of(WIDTHS.step, WIDTHS.time(), codes),
        TimeSource::Setter => Image::new(WIDTHS.step, WIDTHS.time()),
    };
    Compensator {
        widths: WIDTHS,
        lead_from: settings.lead_from(),
        variant: Variant {
            placement: settings.placement,
            comparing: settings.comparing,
            sign: settings.sign,
            function: settings.function,
            detector: settings.detector,
        },
        rom,
    }
}

/// Result of one positioning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Positioning {
    /// Index of the step.
    pub step: usize,
    /// Last tick in which it was armed.
    pub begun: u64,
    /// Target Sx, counted from the start: for a body that keeps turning it exceeds the word.
    pub target: i64,
    /// True if it moved to greater counts.
    pub upward: bool,
    /// Lead time Δt1 in CKs.
    pub code: u64,
    /// Tick of the control signal.
    pub fired: u64,
    /// Position Dx at the control signal, counted from the start.
    pub trigger_position: i64,
    /// True speed at the control signal, in counts per second.
    pub speed_counts_per_s: f64,
    /// Tick of completion.
    pub completed: u64,
    /// Position Dx at completion, counted from the start.
    pub stopped: i64,
    /// Distance past the target in the direction of the move; negative if it stopped short, or the
    /// operation took effect before it. After a timeout, it refers to the body's position at that
    /// time.
    pub error: i64,
    /// Position error of the detector at completion: Dx minus true position, in counts.
    pub position_error_counts: f64,
    /// True if the time expired before the body stood still, or the operation took effect.
    pub timed_out: bool,
    /// True speed at completion, in counts per second.
    pub end_speed_counts_per_s: f64,
    /// True if the target was missed, and the control computer stopped the body.
    pub missed: bool,
    /// Learned time Δt2 in CKs, if any.
    pub learned: Option<u64>,
}

/// Result of a run.
#[derive(Debug, Clone, Default)]
pub struct Played {
    /// Number of ticks.
    pub ticks: u64,
    /// Position Dx in the last tick, counted from the start like targets.
    pub position: i64,
    /// Positionings in order.
    pub positionings: Vec<Positioning>,
    /// True if the encoder was too fast.
    pub lost: bool,
    /// True if a positioning stayed incomplete for too long, and the run was given up.
    pub unsettled: bool,
}

/// Observed signals.
struct See {
    speed: At<u64>,
    drive: At<bool>,
    reverse: At<bool>,
    control: At<bool>,
    arm: At<bool>,
    fire: At<bool>,
    halting: At<bool>,
    complete: At<bool>,
    learned: At<bool>,
    learned_time: At<u64>,
    running: At<bool>,
    busy: At<bool>,
    lost: At<bool>,
    timed_out: At<bool>,
    missed: At<bool>,
    step: At<u64>,
    position: At<i64>,
    target: At<i64>,
    time: At<u64>,
    carrier: Option<At<u64>>,
}

impl See {
    fn of(watch: &Watcher<'_, Compensator>) -> Self {
        let (p, w) = (&watch.p, &watch.w);
        See {
            speed: watch.at(p.target_setter.q.speed),
            drive: watch.at(p.sequencer.q.drive),
            reverse: watch.at(p.sequencer.q.reverse),
            control: watch.at(p.comparator.q.control),
            arm: watch.at(p.sequencer.q.arm),
            fire: watch.at(w.fire),
            halting: watch.at(p.sequencer.q.halting),
            complete: watch.at(w.complete),
            learned: watch.at(w.learned),
            learned_time: watch.at(w.learned_time),
            running: watch.at(p.sequencer.q.busy),
            busy: watch.at(w.busy),
            lost: watch.at(w.lost),
            timed_out: watch.at(w.timed_out),
            missed: watch.at(p.sequencer.q.missed),
            step: watch.at(p.sequencer.q.step),
            position: watch.at(w.position),
            target: watch.at(w.target),
            time: watch.at(w.lead_time),
            carrier: carrier(watch),
        }
    }
}

/// Observer that stops bodies that missed their target, and records the results.
struct Bench<'a> {
    settings: &'a Settings,
    completed: u32,
    /// Ticks since the last completion.
    idle: u64,
    patience: u64,
    /// True if a step was armed in the tick before.
    arming: bool,
    /// True if the body is far past its target.
    past: bool,
    /// True while the operation has effect.
    effect: bool,
    /// Position at which it took effect since the step was armed.
    effect_at: Option<i64>,
    played: Played,
}

impl Bench<'_> {
    /// True if another positioning is to begin.
    fn run(&self) -> bool {
        self.played.positionings.len() < self.settings.positionings as usize
    }

    /// Records if the operation has effect in this tick, according to its sensor.
    fn operate(&mut self, effect: bool, body: &BrakedBody) {
        if effect && !self.effect {
            self.effect_at = Some(body.position_counts().round() as i64);
        }
        self.effect = effect;
    }

    /// Records the tick; returns true if the run continues.
    fn take(&mut self, now: &Sample<'_, Compensator>, see: &See, body: &BrakedBody) -> bool {
        let tick = self.played.ticks;
        self.played.ticks += 1;
        self.idle += 1;
        let arm = now.get(see.arm);
        if arm {
            self.effect_at = None;
            if self.arming {
                // The sample that ends it gives the body's position.
                self.played.positionings.pop();
            }
            let number = self.played.positionings.len();
            let target = self.settings.target(number);
            let position = unwrapped(now.get(see.position), target);
            self.played.positionings.push(Positioning {
                step: now.get(see.step) as usize,
                begun: tick,
                target,
                upward: word(now.get(see.target) - position) >= 0,
                code: now.get(see.time),
                fired: tick,
                trigger_position: position,
                speed_counts_per_s: 0.0,
                completed: tick,
                stopped: position,
                error: 0,
                position_error_counts: 0.0,
                timed_out: false,
                end_speed_counts_per_s: 0.0,
                missed: false,
                learned: None,
            });
        }
        self.arming = arm;
        if let Some(current) = self.played.positionings.last_mut() {
            if now.get(see.fire) || now.get(see.halting) {
                current.fired = tick;
                current.trigger_position = unwrapped(now.get(see.position), current.target);
                current.speed_counts_per_s = body.speed_counts_per_s();
            }
            if now.get(see.complete) {
                let position = unwrapped(now.get(see.position), current.target);
                current.position_error_counts = position as f64 - body.position_counts();
                let position = self.effect_at.unwrap_or(position);
                let way = position - current.target;
                current.completed = tick;
                current.stopped = position;
                current.error = if current.upward { way } else { -way };
                current.end_speed_counts_per_s = body.speed_counts_per_s();
                current.timed_out = match self.settings.completion {
                    Completion::Standstill => now.get(see.timed_out),
                    Completion::FixedTime => current.end_speed_counts_per_s != 0.0,
                };
                current.missed = now.get(see.missed);
                self.completed += 1;
                self.idle = 0;
            }
            if current.learned.is_none() && now.get(see.learned) {
                current.learned = Some(now.get(see.learned_time));
            }
            self.played.position = unwrapped(now.get(see.position), current.target);
            let way = body.position_counts() - current.target as f64;
            let way = if current.upward { way } else { -way };
            let step = self.settings.steps.get(current.step);
            let speed = step.map_or(0, |step| step.speed_counts_per_s);
            self.past = way > f64::from(speed) * MISSED_S;
        }
        self.played.lost = now.get(see.lost);
        self.played.unsettled = self.idle > self.patience;
        let over = self.completed >= self.settings.positionings && !now.get(see.busy);
        !over && !self.played.unsettled
    }
}

/// Returns the position nearest to `target` that this word represents.
fn unwrapped(position: i64, target: i64) -> i64 {
    target + word(position - target)
}

/// Plays the positionings of `settings` on `circuit`, with a body and its brake; `observer` sees
/// it too.
///
/// # Errors
/// Returns an error if a setting or a parameter of the body is out of range, or the error of
/// `observer`.
pub fn play(
    circuit: &Compensator,
    settings: &Settings,
    observer: &mut dyn Observer<Compensator>,
) -> Result<Played, JobError> {
    settings.validate_driven()?;
    let clock = settings.clock_hz as f64;
    let mut body = BrakedBody::new(&settings.body, 1.0 / clock)?;
    let mut bench = Bench {
        settings,
        completed: 0,
        idle: 0,
        patience: (PATIENCE_S * clock) as u64,
        arming: false,
        past: false,
        effect: false,
        effect_at: None,
        played: Played::default(),
    };
    let mut computer = ControlComputer::new(settings);
    let mut i = computer.standing(circuit);
    let mut operation = Operation::new(settings.operation_delay(false));
    let mut sensor = Sensor::of(settings);
    let mut loaded = false;
    let mut stands = false;
    let (mut simulator, see) =
        Simulator::watching_beside(circuit, &Body, observer.needs(), See::of)?;
    loop {
        if settings.load_change_after == Some(bench.completed) && !loaded {
            body.set_load(settings.load)?;
            operation.set_delay(settings.operation_delay(true));
            loaded = true;
        }
        let ([drive, reverse], [control, arm, busy], [speed, step, phase]) = simulator.state(|q| {
            (
                [q.get(see.drive), q.get(see.reverse)],
                [q.get(see.control), q.get(see.arm), q.get(see.running)],
                [
                    q.get(see.speed),
                    q.get(see.step),
                    see.carrier.map_or(0, |at| q.get(at)),
                ],
            )
        });
        let speed = speed * u64::from(SPEED_UNIT_COUNTS_PER_S);
        let (a, b) = body.step(drive, reverse, speed as f64, control && !i.passing);
        stands &= sensor.step(&mut i, body.position_counts(), phase);
        let effect = operation.step(control && i.passing);
        bench.operate(effect, &body);
        stands &= computer.tick(&mut i, bench.played.ticks, [arm, busy], bench.run());
        stands &= computer.choose_parameter(&mut i, step);
        let halt = bench.past && drive;
        let before = (i.a, i.b, i.effect, i.halt);
        (i.a, i.b, i.effect, i.halt) = (a, b, effect, halt);
        if !stands || before != (a, b, effect, halt) {
            simulator.apply(&i)?;
            stands = true;
        }
        simulator.watch_for(&observer);
        if observer.looks(bench.played.ticks) {
            simulator.show::<Body>(&BodySignals::of(&body))?;
        }
        let take = |now: &Sample<'_, _>| bench.take(now, &see, &body);
        let (goes_on, flow) = simulator.look_as_set(&mut *observer, take)?;
        simulator.step();
        if !goes_on || flow.is_break() {
            return Ok(bench.played);
        }
    }
}
