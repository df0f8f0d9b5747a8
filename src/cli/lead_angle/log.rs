//! `run` on a position log: where signals would have been given, and how good the predictions were.

use super::{Job, Traces};
use crate::cli::run::{Arguments, Progress, no_such_tick};
use crate::cli::{Failure, print, print_json};
use motion_rtl::input::position_log::PositionLog;
use motion_rtl::lead_angle::LeadSource;
use motion_rtl::lead_angle::job::{Positioner, RamLead, ShiftLead, positioner};
use motion_rtl::lead_angle::replay::{Replayed, Signal, replay, settings_for};
use motion_rtl::lead_angle::settings::{History, Settings};
use motion_rtl::picture::{Curve, Panel, Picture};
use motion_rtl::trace::Options;
use serde::Serialize;
use std::fmt::Write as _;
use std::ops::Range;

/// Signals in the summary for people, unless all are asked for.
const SHOWN: usize = 16;

/// The summary of a log.
#[derive(Debug, Serialize)]
struct Summary {
    circuit: &'static str,
    input: String,
    samples: usize,
    seconds: f64,
    ticks: u64,
    clock_hz: u64,
    ck_ticks: u32,
    /// Predictions with a lead that the log can judge, and their errors in counts.
    predictions: u64,
    error_rms_counts: f64,
    error_max_counts: f64,
    without_lead_rms_counts: f64,
    without_lead_max_counts: f64,
    signals: Vec<Row>,
    complaints: Vec<String>,
    vcd_window: Option<[u64; 2]>,
    files: Vec<String>,
}

/// One signal.
#[derive(Debug, Serialize)]
struct Row {
    step: usize,
    target: i64,
    tick: u64,
    seconds: f64,
    lead_ms: f64,
    /// Position at the signal.
    position: i64,
    /// Position a lead time later; `null` where the log is over by then.
    position_after: Option<f64>,
    /// The same less the target: what the prediction was off.
    error_counts: Option<f64>,
}

/// Replays a log with its waves.
pub fn run(
    arguments: &Arguments,
    job: &Job,
    log: &PositionLog,
    options: &Options,
) -> Result<(), Failure> {
    let settings = settings_for(log, &job.settings);
    match settings.history {
        History::ShiftRegister => on(
            &positioner::<ShiftLead>(&settings),
            &settings,
            arguments,
            job,
            log,
            options,
        ),
        History::Ram => on(
            &positioner::<RamLead>(&settings),
            &settings,
            arguments,
            job,
            log,
            options,
        ),
    }
}

fn on<P: LeadSource<11, 24, 16> + 'static>(
    circuit: &Positioner<P>,
    settings: &Settings,
    arguments: &Arguments,
    job: &Job,
    log: &PositionLog,
    options: &Options,
) -> Result<(), Failure> {
    let ticks = (log.seconds() * settings.clock_hz as f64) as u64 + 1;
    if options.ticks.start >= ticks {
        return Err(no_such_tick(options, ticks));
    }
    let (mut traces, clock) = Traces::begin(circuit, arguments, job, options, ticks)?;
    let mut progress = Progress::new(ticks);
    let files = (traces.vcd.as_mut(), traces.stimulus.as_mut());
    let replayed = replay(circuit, settings, log, (files, &mut progress)).map_err(Failure::Run)?;
    drop(progress);
    let action = replayed.signals.first().map_or(0, |signal| signal.tick);
    let mut files = traces.finish(circuit, clock, job, options, [action, replayed.ticks])?;
    files.write("svg", &draw(job, log, settings, &replayed))?;
    let mut summary = summary(job, log, settings, &replayed);
    if !arguments.no_vcd {
        let Range { start, end } = options.ticks;
        summary.vcd_window = Some([start, end.min(replayed.ticks).max(start)]);
    }
    summary.files = files.commit()?;
    match arguments.json {
        true => print_json(&summary)?,
        false => print(&summary.text(arguments.segments))?,
    }
    if summary.complaints.is_empty() {
        return Ok(());
    }
    Err(Failure::Check(summary.complaints.join("\n")))
}

fn summary(job: &Job, log: &PositionLog, settings: &Settings, replayed: &Replayed) -> Summary {
    let row = |signal: &Signal| Row {
        step: signal.step,
        target: signal.target,
        tick: signal.tick,
        seconds: signal.tick as f64 / settings.clock_hz as f64,
        lead_ms: signal.code as f64 * settings.ck_ms(),
        position: signal.position,
        position_after: signal.position_after,
        error_counts: signal.position_after.map(|at| at - signal.target as f64),
    };
    let predictions = replayed.predictions;
    let lost = "the encoder was too fast for the detector".to_owned();
    Summary {
        circuit: "lead_angle",
        input: log.file.clone(),
        samples: log.samples.len(),
        seconds: log.seconds(),
        ticks: replayed.ticks,
        clock_hz: settings.clock_hz,
        ck_ticks: job.settings.ck_ticks,
        predictions: predictions.count,
        error_rms_counts: predictions.rms,
        error_max_counts: predictions.largest,
        without_lead_rms_counts: predictions.rms_without,
        without_lead_max_counts: predictions.largest_without,
        signals: replayed.signals.iter().map(row).collect(),
        complaints: replayed.lost.then_some(lost).into_iter().collect(),
        vcd_window: None,
        files: Vec::new(),
    }
}

impl Summary {
    fn text(&self, all: bool) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = self.write(&mut text, all);
        text
    }

    fn write(&self, text: &mut String, all: bool) -> std::fmt::Result {
        writeln!(
            text,
            "{} on {}: {} samples, {:.3} s, {} ticks at {} Hz, CK of {} ticks\n",
            self.input,
            self.circuit,
            self.samples,
            self.seconds,
            self.ticks,
            self.clock_hz,
            self.ck_ticks
        )?;
        match self.predictions {
            0 => writeln!(text, "no prediction with a lead\n")?,
            count => writeln!(
                text,
                "{count} predictions   rms error  largest\n\
                 with the lead    {:>11.1}  {:>7.1}\n\
                 without          {:>11.1}  {:>7.1}\n",
                self.error_rms_counts,
                self.error_max_counts,
                self.without_lead_rms_counts,
                self.without_lead_max_counts
            )?,
        }
        let shown = if all {
            self.signals.len()
        } else {
            SHOWN.min(self.signals.len())
        };
        if shown > 0 {
            writeln!(
                text,
                "step   target      time      lead  position  a lead later   error"
            )?;
        }
        for row in &self.signals[..shown] {
            let [after, error] = [row.position_after, row.error_counts]
                .map(|counts| counts.map_or("-".to_owned(), |counts| format!("{counts:.1}")));
            writeln!(
                text,
                "{:>4}  {:>7}  {:>7.3}s  {:>5.1} ms  {:>8}  {after:>12}  {error:>6}",
                row.step, row.target, row.seconds, row.lead_ms, row.position
            )?;
        }
        let more = self.signals.len() - shown;
        if more > 0 {
            writeln!(text, "and {more} more: --segments shows all")?;
        }
        if self.signals.is_empty() {
            writeln!(
                text,
                "no signal: the log never reaches a target of the step that waits"
            )?;
        }
        for file in &self.files {
            writeln!(text, "wrote {file}")?;
        }
        Ok(())
    }
}

fn draw(job: &Job, log: &PositionLog, settings: &Settings, replayed: &Replayed) -> String {
    let samples = log.samples.iter();
    let path = samples.map(|at| (at.seconds, at.counts as f64)).collect();
    let mut signals = Vec::new();
    for signal in &replayed.signals {
        let from = signal.tick as f64 / settings.clock_hz as f64;
        let to = from + signal.code as f64 * settings.ck_ms() / 1e3;
        signals.push((from, signal.position as f64));
        signals.push((to, signal.target as f64));
        signals.push((f64::NAN, f64::NAN));
    }
    let panel = Panel::new(
        "position, and from each signal to its target",
        "time in s",
        "counts",
    )
    .curve(Curve::new("log", path).colour("#8c8c8c").width(1.0))
    .curve(
        Curve::new("signal to target", signals)
            .colour("#d55e00")
            .width(1.4),
    );
    Picture::new(format!("{}: lead-angle compensator on a log", job.stem))
        .panel(panel)
        .render()
}
