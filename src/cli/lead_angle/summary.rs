//! Summary of a run.

use super::Job;
use super::systems::{EXACT, LEARNING, SECOND_ORDER, System, learner};
use crate::cli::report::Outcome;
use motion_rtl::jobs::lead_angle::job::{Played, Positioning};
use motion_rtl::jobs::lead_angle::settings::{Action, LeadBy, Settings, Sign};
use serde::Serialize;
use std::ops::Range;

/// Positionings of a step within which learning is to be settled.
const SETTLED_WITHIN: usize = 6;

/// The summary of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Fields that all summaries share.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Settings of the run, by the keys of `keys lead_angle --json-schema`.
    #[cfg_attr(
        feature = "schema",
        schemars(with = "crate::cli::schema::Settings<Settings>")
    )]
    pub settings: Settings,
    /// All systems with their errors.
    pub systems: Vec<SystemSummary>,
    /// The system whose lead times are shown: the scenario's own where it learns, or else the one
    /// that does, or where nothing is compared its own, if its lead is a time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lead_times_of: Option<&'static str>,
    /// The steps before the load change and after it.
    pub phases: Vec<Phase>,
    /// Every positioning, with the errors of all systems.
    pub positionings: Vec<Row>,
}

/// Figures of all positionings on one system.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SystemSummary {
    /// Name of the system.
    pub name: &'static str,
    /// True if the scenario selects this system.
    pub own: bool,
    /// Largest amount of a stop error, in counts.
    pub error_max_counts: u64,
    /// Root of the mean square of the stop errors, in counts.
    pub error_rms_counts: f64,
    /// Largest amount by which the detector was off where a positioning was complete, in counts.
    pub position_error_max_counts: f64,
    /// Positionings that missed their target and were stopped by the control computer.
    pub missed: usize,
    /// Positionings whose time was over before the body stood still: their errors are of where it
    /// was then, still turning.
    pub timed_out: usize,
}

/// The steps while the load stays the same.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Phase {
    /// From this positioning on, from 0.
    pub from: usize,
    /// Up to this one.
    pub to: usize,
    /// The load has changed.
    pub loaded: bool,
    /// Each step in the phase.
    pub steps: Vec<StepSummary>,
}

/// One step in one phase.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StepSummary {
    /// Its number.
    pub step: usize,
    /// Sx in counts, from where targets count from.
    pub target: i64,
    /// Speed of the step.
    pub speed_counts_per_s: u32,
    /// Count of its positionings in the phase.
    pub positionings: usize,
    /// Stop error of its last positioning in the phase, for each system, in counts.
    pub last_error_counts: Vec<i64>,
    /// True if that positioning timed out before the body stood still, for each system.
    pub last_timed_out: Vec<bool>,
    /// Lead of the system `lead_times_of`.
    #[serde(flatten)]
    pub lead: Option<StepLead>,
}

/// Result of a step in a phase, by a lead that is a time.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StepLead {
    /// Lead time of the last positioning.
    #[serde(flatten)]
    pub last: Lead,
    /// After how many positionings of the phase the stops stay within a code's travel; `null` where
    /// they never do.
    pub settled_after: Option<usize>,
    /// Settling by each function of error and overrun, where these are compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub settled_by_function: Option<ByFunction>,
}

/// The lead time of a positioning.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Lead {
    /// Lead time in milliseconds.
    pub lead_ms: f64,
    /// Travel of one code at that speed, in counts.
    pub code_travel_counts: f64,
}

/// Positionings until learning stays within a code's travel; `null` if it never does.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ByFunction {
    /// To first order.
    pub first_order: Option<usize>,
    /// To second order.
    pub second_order: Option<usize>,
    /// By the exact relation.
    pub exact: Option<usize>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Row {
    /// Its number, from 0.
    pub positioning: usize,
    /// Its step.
    pub step: usize,
    /// The load has changed.
    pub loaded: bool,
    /// Stop error of each system, in counts.
    pub error_counts: Vec<i64>,
    /// Error of each system's detector at that time, in counts.
    pub position_error_counts: Vec<f64>,
    /// True if it timed out before the body stood still, for each system; its error is then of the
    /// position at the time-out.
    pub timed_out: Vec<bool>,
    /// Speed at which the body still turned when it was complete, for each system, in counts a
    /// second.
    pub end_speed_counts_per_s: Vec<f64>,
    /// Lead time of `lead_times_of`.
    #[serde(flatten)]
    pub lead: Option<Lead>,
}

/// Counts that a body goes in one step of the code that a positioning used.
pub fn code_travel(settings: &Settings, positioning: &Positioning) -> f64 {
    let cks = settings.ratio(positioning.code) as f64;
    positioning.speed_counts_per_s.abs() * settings.ck_ms() / 1e3 * cks
}

/// Returns true if a positioning stopped within a code's travel; false after a time-out.
fn settled(settings: &Settings, positioning: &Positioning) -> bool {
    !positioning.timed_out
        && positioning.error.unsigned_abs() as f64 <= code_travel(settings, positioning) + 1e-6
}

/// Returns the name of the error that an action keeps small.
pub fn error_name(action: Action) -> &'static str {
    match action {
        Action::Stop => "stop error",
        Action::Operate => "effect error",
    }
}

/// Returns the run of the system of this name.
pub fn run_of<'a>(played: &'a [(System, Played)], name: &str) -> Option<&'a Played> {
    let found = played.iter().find(|(system, _)| system.name == name);
    found.map(|(_, played)| played)
}

impl Summary {
    /// The summary of a job that was played.
    pub fn new(job: &Job, played: &[(System, Played)]) -> Self {
        let settings = &job.settings;
        let own = played.iter().find(|(system, _)| system.own);
        let ticks = own.map_or(0, |(_, run)| run.ticks);
        let learner = match settings.learn {
            true => learner(settings.sign, settings.function),
            false => LEARNING,
        };
        let own_name = own.map(|(system, _)| system.name);
        let lead_times_of = match run_of(played, learner) {
            Some(_) => Some(learner),
            None => own_name.filter(|_| settings.lead == LeadBy::Time),
        };
        let mut summary = Summary {
            outcome: Outcome {
                complaints: own.map_or(Vec::new(), |(_, run)| complaints(settings, run)),
                ..Outcome::new("lead_angle", &job.stem, settings.clock_hz, ticks)
            },
            settings: settings.clone(),
            systems: played.iter().map(system_summary).collect(),
            lead_times_of,
            phases: Vec::new(),
            positionings: Vec::new(),
        };
        let shown = lead_times_of.and_then(|name| run_of(played, name));
        if let Some(run) = shown.or(own.map(|(_, run)| run)) {
            let shown = Shown {
                settings,
                played,
                run,
                leads: lead_times_of.is_some(),
            };
            summary.positionings = shown.rows();
            summary.phases = shown.phases();
        }
        summary.outcome.warnings = warnings(&summary);
        summary
    }
}

fn system_summary((system, run): &(System, Played)) -> SystemSummary {
    let errors = || run.positionings.iter().map(|one| one.error);
    let squares: f64 = errors().map(|error| (error as f64).powi(2)).sum();
    SystemSummary {
        name: system.name,
        own: system.own,
        error_max_counts: errors().map(i64::unsigned_abs).max().unwrap_or(0),
        position_error_max_counts: run
            .positionings
            .iter()
            .map(|one| one.position_error_counts.abs())
            .fold(0.0, f64::max),
        error_rms_counts: (squares / run.positionings.len().max(1) as f64).sqrt(),
        missed: run.positionings.iter().filter(|one| one.missed).count(),
        timed_out: run.positionings.iter().filter(|one| one.timed_out).count(),
    }
}

fn loaded(settings: &Settings, positioning: usize) -> bool {
    let after = settings.load_change_after.map(|after| after as usize);
    after.is_some_and(|after| positioning >= after)
}

/// Returns a value of a positioning on each system.
fn on_each_system<T: Default>(
    played: &[(System, Played)],
    positioning: usize,
    of: impl Fn(&Positioning) -> T,
) -> Vec<T> {
    let value = |run: &Played| {
        run.positionings
            .get(positioning)
            .map(&of)
            .unwrap_or_default()
    };
    played.iter().map(|(_, run)| value(run)).collect()
}

/// All runs, and the one whose positionings and lead times are shown.
struct Shown<'a> {
    settings: &'a Settings,
    played: &'a [(System, Played)],
    run: &'a Played,
    /// Its lead is a time.
    leads: bool,
}

impl Shown<'_> {
    fn rows(&self) -> Vec<Row> {
        let (settings, played) = (self.settings, self.played);
        let positionings = self.run.positionings.iter().enumerate();
        positionings
            .map(|(number, one)| Row {
                positioning: number,
                step: one.step,
                loaded: loaded(settings, number),
                error_counts: on_each_system(played, number, |one| one.error),
                position_error_counts: on_each_system(played, number, |one| {
                    one.position_error_counts
                }),
                timed_out: on_each_system(played, number, |one| one.timed_out),
                end_speed_counts_per_s: on_each_system(played, number, |one| {
                    one.end_speed_counts_per_s
                }),
                lead: self.lead(one),
            })
            .collect()
    }

    fn lead(&self, one: &Positioning) -> Option<Lead> {
        self.leads.then(|| Lead {
            lead_ms: self.settings.lead_ms(one.code),
            code_travel_counts: code_travel(self.settings, one),
        })
    }

    fn phases(&self) -> Vec<Phase> {
        let (settings, all) = (self.settings, self.run.positionings.len());
        let change = settings.load_change_after.map(|after| after as usize);
        let change = change.filter(|after| *after < all);
        let bounds = match change {
            Some(change) => vec![(0, change), (change, all)],
            None => vec![(0, all)],
        };
        let phase = |(from, to): (usize, usize)| {
            let steps = 0..settings.steps.len();
            Phase {
                from,
                to,
                loaded: loaded(settings, from),
                steps: steps.filter_map(|step| self.step(step, from..to)).collect(),
            }
        };
        bounds.into_iter().map(phase).collect()
    }

    /// Result of a step in a phase; none if the phase ends before it.
    fn step(&self, step: usize, phase: Range<usize>) -> Option<StepSummary> {
        let (settings, played) = (self.settings, self.played);
        let all = &self.run.positionings;
        let numbers: Vec<usize> = phase.filter(|number| all[*number].step == step).collect();
        let last = *numbers.last()?;
        let after = |run| settled_after(settings, run, &numbers);
        // One of them is missing without a comparison.
        let functions = [LEARNING, SECOND_ORDER, EXACT].map(|name| run_of(played, name));
        let by_function = match functions {
            [Some(first), Some(second), Some(exact)] => Some(ByFunction {
                first_order: after(first),
                second_order: after(second),
                exact: after(exact),
            }),
            _ => None,
        };
        Some(StepSummary {
            step,
            target: settings.steps[step].target,
            speed_counts_per_s: settings.steps[step].speed_counts_per_s,
            positionings: numbers.len(),
            last_error_counts: on_each_system(played, last, |one| one.error),
            last_timed_out: on_each_system(played, last, |one| one.timed_out),
            lead: self.lead(&all[last]).map(|last| StepLead {
                last,
                settled_after: after(self.run),
                settled_by_function: by_function,
            }),
        })
    }
}

/// After how many of these positionings a system stays within a code's travel.
fn settled_after(settings: &Settings, run: &Played, numbers: &[usize]) -> Option<usize> {
    let all = &run.positionings;
    let off = |number: &usize| !all.get(*number).is_some_and(|one| settled(settings, one));
    let after = numbers.iter().rposition(off).map_or(0, |place| place + 1);
    Some(after).filter(|after| *after < numbers.len())
}

/// Returns the faults of a run.
fn complaints(settings: &Settings, run: &Played) -> Vec<String> {
    let mut all = Vec::new();
    let done = run.positionings.len();
    if run.unsettled {
        all.push(format!("positioning {done} is never complete"));
    }
    if run.lost {
        all.push("the encoder was too fast for the detector".to_owned());
    }
    let wanted = settings.positionings as usize;
    if done < wanted && !run.unsettled {
        all.push(format!("{done} positionings where {wanted} are wanted"));
    }
    all
}

/// Returns the warnings of a successful run.
fn warnings(summary: &Summary) -> Vec<String> {
    let mut all = Vec::new();
    for system in summary.systems.iter().filter(|system| system.own) {
        if system.missed > 0 {
            all.push(format!(
                "{} of {} positionings missed their target, and the control computer {}",
                system.missed,
                summary.positionings.len(),
                match summary.settings.action {
                    Action::Stop => "stopped the body",
                    Action::Operate => "started the operation",
                }
            ));
        }
        if system.timed_out > 0 && summary.settings.action == Action::Operate {
            all.push(format!(
                "{} of {} operations had no effect before their time-out: nothing was learned from \
                 them; a longer time_out_ms waits for it",
                system.timed_out,
                summary.positionings.len()
            ));
        } else if system.timed_out > 0 {
            all.push(format!(
                "{} of {} positionings ended by their time-out before the body stood still: their \
                 errors are of where it was then, and nothing of them is a stop; a longer \
                 time_out_ms lets it stop",
                system.timed_out,
                summary.positionings.len()
            ));
        }
    }
    let by_time = summary.settings.lead == LeadBy::Time;
    if !(by_time && summary.settings.learn && summary.settings.sign == Sign::Converging) {
        return all;
    }
    for phase in &summary.phases {
        let settled = |after| after <= SETTLED_WITHIN;
        // With fewer there is nothing to be said yet.
        let late = |step: &&StepSummary| {
            let after = step.lead.as_ref().and_then(|lead| lead.settled_after);
            step.positionings >= SETTLED_WITHIN && !after.is_some_and(settled)
        };
        all.extend(phase.steps.iter().filter(late).map(|step| {
            format!(
                "step {}: not within a code's travel after {SETTLED_WITHIN} positionings from \
                 positioning {} on",
                step.step, phase.from
            )
        }));
    }
    all
}
