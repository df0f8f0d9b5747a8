//! `run` of two groups, each with patterns and unit times of its own.

use super::summary::{AxisSummary, axes, write_axes};
use super::{Pattern, found, patterns, stored_fault};
use crate::cli::Failure;
use crate::cli::arguments::Arguments;
use crate::cli::progress::Work;
use crate::cli::pulse::by_axis::ByAxis;
use crate::cli::pulse::has_no_segments;
use crate::cli::pulse::series::of_groups;
use crate::cli::pulse::waves::ending;
use crate::cli::report::{Outcome, Report, conclude};
use crate::cli::setup::Setup;
use crate::cli::simulate::{Stage, with_waves};
use crate::cli::source::Source;
use crate::cli::traces::{End, Focus};
use crate::cli::waves_of::System;
use motion_rtl::circuits::pulse_interpolator::{AXIS_NAMES, Groups};
use motion_rtl::hdl::Circuit;
use motion_rtl::input::Fault;
use motion_rtl::jobs::pulse_interpolator::groups::{Member, circuit, play};
use motion_rtl::jobs::pulse_interpolator::job::Played;
use motion_rtl::jobs::pulse_interpolator::{StepTiming, Stored, StoredError};
use motion_rtl::picture::{Curve, Panel, Picture, Points};
use motion_rtl::scenario::Loaded;
use motion_rtl::scenario::pulse_interpolator::{GroupKeys, Settings};
use motion_rtl::sim::{Elaborated, Observer, RunError};
use motion_rtl::trace::SeriesLayout;
use serde::Serialize;
use std::fmt::Write as _;

/// Approximate time that a simulated tick takes, in seconds.
const TICK_S: f64 = 40e-9;

/// Unit times of the first group that the save file's window shows.
const UNITS_SHOWN: u64 = 6;

/// Latest tick of a first command.
const LATEST_COMMAND: u64 = 1_000_000_000_000;

/// Names of the groups.
const NAMES: [&str; 2] = ["first", "second"];

/// Scopes of their signals.
const SCOPES: [&str; 2] = ["of_first.", "of_second."];

/// Names of their axes among those of both.
const AXES: [[&str; 8]; 2] = [
    [
        "first_x", "first_y", "first_z", "first_a", "first_b", "first_c", "first_u", "first_v",
    ],
    [
        "second_x", "second_y", "second_z", "second_a", "second_b", "second_c", "second_u",
        "second_v",
    ],
];

/// Top rows of the save file; an axis that the job has not is left out.
const OVERVIEW: [&str; 14] = [
    "of_first.unit_rst",
    "of_first.busy",
    "of_first.step_x",
    "of_first.dir_x",
    "of_first.step_y",
    "of_first.dir_y",
    "second_starting",
    "second.unit_time.active",
    "of_second.unit_rst",
    "of_second.busy",
    "of_second.step_x",
    "of_second.dir_x",
    "of_second.step_y",
    "of_second.dir_y",
];

/// Groups ready to play.
pub struct Job {
    /// Scenario that they came from.
    pub loaded: Loaded,
    /// Stem of the names of its files.
    pub stem: String,
    scenario: Settings,
    timing: StepTiming,
    members: [Member; 2],
}

impl Job {
    /// Reads the tables of the patterns and puts them into the memories of both groups.
    pub fn prepare(source: Source, scenario: &Settings) -> Result<Self, Failure> {
        let loaded = &source.loaded;
        for (key, given) in [
            ("play", scenario.play.is_some()),
            ("rewrite", !scenario.rewrite.is_empty()),
            ("standalone", scenario.standalone),
            ("motor", scenario.motor.is_some()),
        ] {
            if given {
                let allowed = "one of both".to_owned();
                return Err(loaded
                    .fault(key, "given beside [[group]]".into(), allowed)
                    .into());
            }
        }
        let patterns = patterns(&source, scenario)?;
        let [first, second] = &scenario.group[..] else {
            let problem = match scenario.group.len() {
                1 => "is given once".to_owned(),
                count => format!("is given {count} times"),
            };
            return Err(loaded.fault("group", problem, "twice".into()).into());
        };
        let member = |group, keys| member(loaded, scenario, &patterns, (group, keys));
        let members = [member(0, first)?, member(1, second)?];
        let Source { loaded, stem, .. } = source;
        Ok(Job {
            loaded,
            stem,
            timing: scenario.timing,
            scenario: scenario.clone(),
            members,
        })
    }
}

/// A group with the patterns that it plays in its memory.
fn member(
    loaded: &Loaded,
    scenario: &Settings,
    patterns: &[Pattern],
    (group, keys): (usize, &GroupKeys),
) -> Result<Member, Fault> {
    if keys.command_tick > LATEST_COMMAND {
        let problem = format!("is {}", keys.command_tick);
        let allowed = format!("0 to {LATEST_COMMAND}");
        return Err(loaded.table_fault(("group", group), "command_tick", problem, allowed));
    }
    let refuse = |problem, allowed| loaded.table_fault(("group", group), "play", problem, allowed);
    let order = found(scenario, &keys.play, refuse)?;
    let mut held = order.clone();
    held.sort_unstable();
    held.dedup();
    let tables: Vec<_> = held
        .iter()
        .map(|pattern| &patterns[*pattern].table)
        .collect();
    let places = order
        .iter()
        .map(|pattern| held.partition_point(|other| other < pattern));
    let places: Vec<_> = places.collect();
    let stored = Stored::new(&tables, &places, scenario.variant.into(), false);
    let stored = stored.map_err(|error| match error {
        StoredError::Nothing => refuse("is empty".into(), "the name of a pattern".into()),
        StoredError::Axes {
            pattern,
            axes,
            first,
        } => {
            let pattern = held[pattern];
            stored_fault(
                loaded,
                StoredError::Axes {
                    pattern,
                    axes,
                    first,
                },
            )
        }
        StoredError::Full {
            pattern,
            units,
            room,
        } => {
            let pattern = held[pattern];
            stored_fault(
                loaded,
                StoredError::Full {
                    pattern,
                    units,
                    room,
                },
            )
        }
        other => stored_fault(loaded, other),
    })?;
    Ok(Member {
        stored,
        command_tick: keys.command_tick,
    })
}

/// The end of a run; the second group begins in its window.
fn end(job: &Job, played: &[Played; 2]) -> End {
    let unit = job.members[0].stored.group.period;
    let focus = Focus {
        action: played[1].begun,
        before: unit,
        shown: UNITS_SHOWN * unit,
        overview: &OVERVIEW,
    };
    End {
        ticks: played[0].ticks,
        focus,
    }
}

/// Ticks until both groups are done.
fn ticks(job: &Job) -> u64 {
    job.members.iter().map(Member::ticks).max().unwrap_or(0)
}

/// Systems that `--waves-of` knows: the circuit alone.
pub fn systems(job: &Job) -> Vec<System<'_>> {
    let make = move || {
        let circuit = circuit(&job.members);
        let model = Elaborated::new(&circuit).map_err(RunError::from)?;
        let run = move |circuit: &Groups, observer: &mut dyn Observer<Groups>| {
            let played = play(circuit, &job.members, observer)?;
            let ends = played.iter().zip(AXES).flat_map(|(played, names)| {
                let ends = played.axes.iter().map(|axis| axis.position());
                names.into_iter().zip(ends)
            });
            Ok(ending(end(job, &played), ends))
        };
        Ok((circuit, model, run))
    };
    vec![System::new(Groups::NAME, ticks(job), make)]
}

/// The time series: the tables of both groups and their steps.
fn series_of(job: &Job) -> SeriesLayout<'_> {
    let groups = SCOPES.into_iter().zip(&job.members).zip(&AXES);
    of_groups(groups.map(|((scope, member), names)| (scope, &member.stored.played, &names[..])))
}

/// Has both groups play.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    has_no_segments(arguments)?;
    let setup = Setup::new(arguments, &job.loaded, &job.stem)?;
    let circuit = circuit(&job.members);
    let ticks = ticks(job);
    let stage = Stage {
        circuit: &circuit,
        model: &Elaborated::new(&circuit).map_err(RunError::from)?,
        subject: &job.stem,
        work: Work {
            ticks,
            runs: 1,
            seconds: ticks as f64 * TICK_S,
        },
        series: setup.series(|| series_of(job)),
    };
    let (played, mut files) = with_waves(&setup, stage, |observer| {
        let played = play(&circuit, &job.members, observer)?;
        let end = end(job, &played);
        Ok((played, end))
    })?;
    files.write("svg", &draw(job, &played))?;
    conclude(&setup, files, Summary::new(job, &played))
}

/// The positions of each group's axes over time.
fn draw(job: &Job, played: &[Played; 2]) -> String {
    let mut picture = Picture::new(format!("{}: pulse interpolator, two groups", job.stem));
    for ((member, played), name) in job.members.iter().zip(played).zip(NAMES) {
        let table = &member.stored.played;
        let mut curves = vec![Points::expecting(played.positions.units); table.axes()];
        let mut tick = played.begun;
        for ((period, _), at) in table.iter().zip(played.positions.of(table)) {
            tick += u64::from(period);
            let seconds = tick as f64 / job.scenario.clock_hz as f64;
            for (curve, position) in curves.iter_mut().zip(at.iter()) {
                curve.push((seconds, f64::from(*position)));
            }
        }
        let mut panel = Panel::new(name, "time in s", "steps");
        for (name, curve) in AXIS_NAMES.iter().zip(curves) {
            panel = panel.curve(Curve::thinned(*name, curve));
        }
        picture = picture.panel(panel);
    }
    picture.render()
}

/// Summary of a run of two groups.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Fields that all summaries share.
    #[serde(flatten)]
    outcome: Outcome,
    /// Variant of RST.
    variant: &'static str,
    /// True if every unit time has the pulses of its word and every axis kept the driver's timing.
    exact: bool,
    /// Both groups.
    groups: [GroupSummary; 2],
}

/// Results of a group.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct GroupSummary {
    /// Names of its patterns, in the order in which they were played.
    play: Vec<String>,
    /// T of each command.
    unit_ticks: Vec<u64>,
    /// Tick of its first command.
    command_tick: u64,
    /// First tick of its first unit time.
    begun_tick: u64,
    /// Number of its commands.
    commands: usize,
    /// Unit times played.
    units: usize,
    /// Unit times without pulses between two patterns.
    idle_units: u64,
    /// Each axis of the group.
    axes: ByAxis<AxisSummary>,
}

impl Summary {
    fn new(job: &Job, played: &[Played; 2]) -> Self {
        let mut complaints = Vec::new();
        let group = |group: usize| {
            let (member, played) = (&job.members[group], &played[group]);
            let (axes, found) = axes(&member.stored.played, played, &job.timing);
            let name = NAMES[group];
            complaints.extend(found.iter().map(|text| format!("{name}: {text}")));
            let commands = &member.stored.commands;
            GroupSummary {
                play: job.scenario.group[group].play.clone(),
                unit_ticks: commands.iter().map(|command| command.period).collect(),
                command_tick: member.command_tick,
                begun_tick: played.begun,
                commands: commands.len(),
                units: played.positions.units,
                idle_units: played.idle_units,
                axes,
            }
        };
        let groups = [0, 1].map(group);
        let (clock, ticks) = (job.scenario.clock_hz, played[0].ticks);
        Summary {
            exact: complaints.is_empty(),
            variant: job.scenario.variant.name(),
            groups,
            outcome: Outcome {
                complaints,
                ..Outcome::new(Groups::NAME, &job.stem, clock, ticks)
            },
        }
    }
}

impl Report for Summary {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, _: bool) -> std::fmt::Result {
        let (subject, length) = (self.outcome.subject(), self.outcome.length());
        writeln!(text, "{subject} ({}): {length}", self.variant)?;
        for (group, name) in self.groups.iter().zip(NAMES) {
            let periods: Vec<_> = group.unit_ticks.iter().map(u64::to_string).collect();
            writeln!(
                text,
                "\n{name}: {}; T = {}; command in tick {}, begins in tick {}",
                group.play.join(", "),
                periods.join(", "),
                group.command_tick,
                group.begun_tick
            )?;
            write_axes(&group.axes, text)?;
            let (units, idle) = (group.units, group.idle_units);
            writeln!(
                text,
                "{units} unit times, {idle} without pulses between two patterns"
            )?;
        }
        Ok(())
    }
}
