//! Replay of a position log on a compensator: its control signals, and the quality of its
//! predictions.

use super::computer::{ControlComputer, word};
use super::sensor::{Sensor, carrier};
use super::settings::{Action, LeadBy, Settings, Targets};
use crate::circuits::lead_angle::Compensator;
use crate::hdl::At;
use crate::input::position_log::PositionLog;
use crate::jobs::JobError;
use crate::plant::waves::{Body, BodySignals};
use crate::plant::{Encoder, Operation};
use crate::settings::SettingError;
use crate::sim::{Observer, Sample, Simulator, Watcher};
use serde::Serialize;

/// Control signal caused by the log.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Signal {
    /// Index of the step whose target caused it.
    pub step: usize,
    /// Target Sx in the log's counts.
    pub target: i64,
    /// Tick of the signal.
    pub tick: u64,
    /// Time of the signal.
    pub seconds: f64,
    /// Lead time in milliseconds.
    pub lead_ms: f64,
    /// Position at the signal, in the log's counts.
    pub position: i64,
    /// Position one lead time after the sample that caused the signal, in the log's counts; `None`
    /// if the log has ended by then.
    pub position_after: Option<f64>,
    /// Position at which the operation took effect, minus the target; `None` if it did not.
    pub effect_error_counts: Option<f64>,
    /// `position_after` minus the target: the error of the prediction.
    pub error_counts: Option<f64>,
}

/// Number of parts of a log whose greatest errors are recorded separately.
pub const PARTS: usize = 400;

/// Errors of the predictions in all CKs, in counts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Predictions {
    /// Number of predictions that the log can verify.
    #[serde(rename = "predictions")]
    pub count: u64,
    /// Root mean square error.
    #[serde(rename = "error_rms_counts")]
    pub rms: f64,
    /// Greatest error.
    #[serde(rename = "error_max_counts")]
    pub largest: f64,
    /// Root mean square error without a lead.
    #[serde(rename = "without_lead_rms_counts")]
    pub rms_without: f64,
    /// Greatest error without a lead.
    #[serde(rename = "without_lead_max_counts")]
    pub largest_without: f64,
}

/// Result of a log.
#[derive(Debug, Clone, Default)]
pub struct Replayed {
    /// Number of ticks.
    pub ticks: u64,
    /// Signals in order.
    pub signals: Vec<Signal>,
    /// All predictions that were made with a lead.
    pub predictions: Predictions,
    /// Greatest errors with and without the lead in each of [`PARTS`] equal parts of the log, in
    /// counts; `NaN` if there was no prediction.
    pub parts: Vec<[f64; 2]>,
    /// True if the encoder was too fast.
    pub lost: bool,
}

/// Returns the settings for replaying a log: targets count from its first sample. A signal does
/// not stop a log, so nothing is learned from stops; learning from operations remains, as the body
/// continues in any case. The next step begins as soon as possible.
#[must_use]
pub fn settings_for(log: &PositionLog, settings: &Settings) -> Settings {
    let mut settings = settings.clone();
    if settings.targets == Targets::Absolute {
        for step in &mut settings.steps {
            step.target = step.target.saturating_sub(origin(log));
        }
    }
    let ck_ms = settings.ck_ms();
    if settings.action == Action::Stop {
        settings.learn = false;
        settings.time_out_ms = ck_ms;
    }
    // A log has a single load.
    for step in &mut settings.steps {
        step.load_lead_ms = None;
    }
    settings.standstill_ms = ck_ms;
    settings.rest_ms = ck_ms;
    settings
}

/// Checks settings for a replay. The stop of the log's body is unknown, so a lead table is
/// refused; its motion is given, so that targets may be arbitrarily near.
///
/// # Errors
/// Returns an error that names the first field at fault, its value and the allowed range.
pub fn validate(settings: &Settings) -> Result<(), SettingError> {
    if settings.lead == LeadBy::Table {
        let allowed = "time or speed with a log, of whose body no stop is known";
        return Err(SettingError::value("lead", "table", allowed));
    }
    settings.validate_fields()
}

/// Returns the counts of the first sample.
fn origin(log: &PositionLog) -> i64 {
    log.samples.first().map_or(0, |sample| sample.counts)
}

/// Observed signals.
struct See {
    arm: At<bool>,
    control: At<bool>,
    fire: At<bool>,
    fresh: At<bool>,
    enough: At<bool>,
    lost: At<bool>,
    step: At<u64>,
    time: At<u64>,
    position: At<i64>,
    target: At<i64>,
    compared: [At<i64>; 2],
    carrier: Option<At<u64>>,
}

impl See {
    fn of(watch: &Watcher<'_, Compensator>) -> Self {
        let (w, comparator) = (&watch.w, &watch.p.comparator.i);
        See {
            arm: watch.at(watch.p.sequencer.q.arm),
            control: watch.at(watch.p.comparator.q.control),
            fire: watch.at(w.fire),
            fresh: watch.at(comparator.evaluate),
            enough: watch.at(comparator.valid),
            lost: watch.at(w.lost),
            step: watch.at(w.step),
            time: watch.at(w.lead_time),
            position: watch.at(w.position),
            target: watch.at(w.target),
            compared: [comparator.position, comparator.target].map(|at| watch.at(at)),
            carrier: carrier(watch),
        }
    }
}

/// Sums of the measures.
#[derive(Default)]
struct Sums {
    squares: [f64; 2],
    largest: [f64; 2],
    count: u64,
    parts: Vec<[f64; 2]>,
}

impl Sums {
    fn add(&mut self, part: usize, errors: [f64; 2]) {
        self.count += 1;
        let part = &mut self.parts[part];
        for (index, error) in errors.into_iter().enumerate() {
            self.squares[index] += error * error;
            self.largest[index] = self.largest[index].max(error.abs());
            part[index] = part[index].max(error.abs());
        }
    }

    fn finish(&self) -> Predictions {
        let rms = |squares: f64| (squares / self.count.max(1) as f64).sqrt();
        Predictions {
            count: self.count,
            rms: rms(self.squares[0]),
            largest: self.largest[0],
            rms_without: rms(self.squares[1]),
            largest_without: self.largest[1],
        }
    }
}

/// Replays `log` on `circuit` to its end, with the settings of [`settings_for`]; `observer` sees
/// it too.
///
/// # Errors
/// Returns an error for a setting that [`validate`] refuses, or the error of `observer`.
pub fn replay(
    circuit: &Compensator,
    settings: &Settings,
    log: &PositionLog,
    observer: &mut dyn Observer<Compensator>,
) -> Result<Replayed, JobError> {
    validate(settings)?;
    let origin = origin(log);
    let tick_s = 1.0 / settings.clock_hz as f64;
    let ticks = (log.seconds() / tick_s).floor() as u64;
    let at = |seconds: f64| log.position_at(seconds) - origin as f64;
    let (mut replayed, mut sums) = (Replayed::default(), Sums::default());
    sums.parts = vec![[f64::NAN; 2]; PARTS];
    let mut computer = ControlComputer::new(settings);
    let mut i = computer.standing(circuit);
    let mut sensor = Sensor::of(settings);
    let mut operation = Operation::new(settings.operation_delay(false));
    let (mut before, mut effect) = (0.0, false);
    let (mut simulator, see) =
        Simulator::watching_beside(circuit, &Body, observer.needs(), See::of)?;
    for tick in 0..=ticks {
        let seconds = tick as f64 * tick_s;
        let position = at(seconds);
        let (a, b) = Encoder::default().channels(position);
        let [arm, control] = simulator.state(|q| [see.arm, see.control].map(|at| q.get(at)));
        computer.tick(&mut i, tick, [arm, true], true);
        i.a = a;
        i.b = b;
        let phase = see.carrier.map_or(0, |at| simulator.state(|q| q.get(at)));
        sensor.step(&mut i, position, phase);
        i.effect = operation.step(control && i.passing);
        let takes_effect = i.effect && !effect;
        effect = i.effect;
        let speed = (position - before) / tick_s;
        before = position;
        simulator.watch_for(&observer);
        if observer.looks(tick) {
            simulator.show::<Body>(&BodySignals::at(position, speed))?;
        }
        let take = |now: &Sample<'_, _>| {
            let fire = now.get(see.fire);
            let lead_ms = match settings.lead {
                LeadBy::Time => settings.lead_ms(now.get(see.time)),
                LeadBy::Speed | LeadBy::Table => settings.speed_lead_ms,
            };
            let predicts = now.get(see.fresh) && now.get(see.enough) && lead_ms > 0.0;
            let known = if predicts || fire {
                // The sample of this pair was taken one tick ago.
                let after = seconds - tick_s + lead_ms / 1e3;
                (after <= log.seconds()).then(|| at(after))
            } else {
                None
            };
            if let Some(truth) = known
                && predicts
            {
                let [predicted, wanted] = see.compared.map(|at| now.get(at));
                let (position, target) = (now.get(see.position), now.get(see.target));
                // Independent of the placement.
                let lead = word(predicted - wanted + target - position) as f64;
                let position = position as f64;
                let part = u128::from(tick) * PARTS as u128 / (u128::from(ticks) + 1);
                sums.add(part as usize, [position + lead - truth, position - truth]);
            }
            if let Some(signal) = replayed.signals.last_mut()
                && takes_effect
            {
                let position = position + origin as f64;
                signal.effect_error_counts = Some(position - signal.target as f64);
            }
            if fire {
                let target = now.get(see.target) + origin;
                let position_after = known.map(|position| position + origin as f64);
                replayed.signals.push(Signal {
                    step: now.get(see.step) as usize,
                    target,
                    tick,
                    seconds: tick as f64 / settings.clock_hz as f64,
                    lead_ms,
                    position: now.get(see.position) + origin,
                    position_after,
                    effect_error_counts: None,
                    error_counts: position_after.map(|at| at - target as f64),
                });
            }
            replayed.ticks = tick + 1;
            replayed.lost = now.get(see.lost);
        };
        let ((), flow) = simulator.step_watched(&i, &mut *observer, take)?;
        if flow.is_break() {
            break;
        }
    }
    replayed.predictions = sums.finish();
    replayed.parts = sums.parts;
    Ok(replayed)
}
