//! `run` of patterns that stand in the memory: played by command, or without a control computer.

pub mod groups;
mod summary;

use super::series::of_table;
use super::{has_no_segments, own, play_table};
use crate::cli::Failure;
use crate::cli::arguments::Arguments;
use crate::cli::report::conclude;
use crate::cli::setup::Setup;
use crate::cli::source::Source;
use crate::cli::table::ratio;
use crate::cli::waves_of::System;
use motion_rtl::circuits::pulse_interpolator::{AXIS_NAMES, Widths};
use motion_rtl::input::Fault;
use motion_rtl::jobs::pulse_interpolator::job::Played;
use motion_rtl::jobs::pulse_interpolator::motors::Motors;
use motion_rtl::jobs::pulse_interpolator::table::MAX_UNITS;
use motion_rtl::jobs::pulse_interpolator::{AxisScaling, StepTiming, Stored, StoredError, Table};
use motion_rtl::picture::{Curve, Panel, Picture, Points};
use motion_rtl::scenario::Loaded;
use motion_rtl::scenario::pulse_interpolator::{PatternKeys, Settings};
pub use summary::Summary;

/// Patterns ready to be played.
pub struct Job {
    /// The scenario they came from.
    pub loaded: Loaded,
    /// Stem of the names of its files.
    pub stem: String,
    scenario: Settings,
    timing: StepTiming,
    patterns: Vec<Pattern>,
    stored: Stored,
    motors: Option<Motors>,
}

/// A pattern of the memory.
struct Pattern {
    keys: PatternKeys,
    /// Table before scaling.
    given: Table,
    /// Table as played.
    table: Table,
    /// Effect of scaling on each axis.
    scaling: Option<Vec<AxisScaling>>,
}

impl Job {
    /// Reads the tables of the patterns and puts them into the memory.
    pub fn prepare(source: Source, scenario: &Settings) -> Result<Self, Failure> {
        let loaded = &source.loaded;
        let patterns = patterns(&source, scenario)?;
        let order = order(loaded, scenario)?;
        let tables: Vec<_> = patterns.iter().map(|pattern| &pattern.table).collect();
        let stored = Stored::new(
            &tables,
            &order,
            scenario.variant.into(),
            scenario.standalone,
        )
        .and_then(|stored| stored.rewritten(&scenario.rewrite))
        .map_err(|error| stored_fault(loaded, error))?;
        let motors = scenario.motors(stored.group.axes);
        let motors = motors.map_err(|error| loaded.refuse(error))?;
        let Source { loaded, stem, .. } = source;
        Ok(Job {
            loaded,
            stem,
            timing: scenario.timing,
            scenario: scenario.clone(),
            patterns,
            stored,
            motors,
        })
    }
}

/// Reads the tables of the patterns.
fn patterns(source: &Source, scenario: &Settings) -> Result<Vec<Pattern>, Failure> {
    let loaded = &source.loaded;
    if loaded.scenario.input().is_some() {
        let problem = "given beside [[pattern]]".to_owned();
        return Err(loaded.fault("input", problem, "one of both".into()).into());
    }
    if loaded.scenario.beside() {
        let problem = "given beside [[pattern]]".to_owned();
        let allowed = "a drawing, which the conventional device plays too".to_owned();
        return Err(loaded.fault("beside", problem, allowed).into());
    }
    let mut patterns = Vec::new();
    for (index, keys) in scenario.pattern.iter().enumerate() {
        let refuse = |key, problem: String, allowed: &str| {
            loaded.table_fault(("pattern", index), key, problem, allowed.to_owned())
        };
        if keys.name.is_empty() {
            return Err(refuse("name", "is empty".into(), "a name").into());
        }
        if scenario.pattern[..index]
            .iter()
            .any(|other| other.name == keys.name)
        {
            let problem = format!("is {} once more", keys.name);
            return Err(refuse("name", problem, "a name for each").into());
        }
        let given = source.table(&keys.table, scenario.clock_hz)?;
        let scaled = match &keys.scale {
            None => None,
            Some(text) => {
                let ratio = ratio(text)
                    .map_err(|allowed| refuse("scale", format!("is {text}"), allowed))?;
                let scaled = given.scaled(ratio);
                Some(
                    scaled
                        .map_err(|error| refuse("scale", error.to_string(), "a smaller ratio"))?,
                )
            }
        };
        let (table, scaling) = match scaled {
            None => (given.clone(), None),
            Some(scaled) => (scaled.table, Some(scaled.axes)),
        };
        patterns.push(Pattern {
            keys: keys.clone(),
            given,
            table,
            scaling,
        });
    }
    Ok(patterns)
}

/// The patterns that are played, by their numbers.
fn order(loaded: &Loaded, scenario: &Settings) -> Result<Vec<usize>, Fault> {
    match &scenario.play {
        None => Ok((0..scenario.pattern.len()).collect()),
        Some(play) => found(scenario, play, |problem, allowed| {
            loaded.fault("play", problem, allowed)
        }),
    }
}

/// The patterns of these names, by their numbers.
fn found(
    scenario: &Settings,
    play: &[String],
    refuse: impl Fn(String, String) -> Fault,
) -> Result<Vec<usize>, Fault> {
    let names = || scenario.pattern.iter().map(|pattern| pattern.name.as_str());
    let find = |name: &String| {
        names().position(|other| other == name).ok_or_else(|| {
            let allowed = names().collect::<Vec<_>>().join(", ");
            refuse(format!("{name} is no pattern"), allowed)
        })
    };
    play.iter().map(find).collect()
}

/// Returns an error of the memory or of the group, with its place in the scenario.
fn stored_fault(loaded: &Loaded, error: StoredError) -> Fault {
    let table = |pattern, problem, allowed| {
        loaded.table_fault(("pattern", pattern), "table", problem, allowed)
    };
    match error {
        StoredError::Axes {
            pattern,
            axes,
            first,
        } => table(
            pattern,
            format!("has {axes} axes"),
            format!("{first}, as the first"),
        ),
        StoredError::Full {
            pattern,
            units,
            room,
        } => {
            let words = 1 << Widths::default().address;
            let allowed = format!("{room} of the {words} words of the memory");
            table(pattern, format!("has {units} unit times"), allowed)
        }
        StoredError::Alone { commands } => {
            let problem = format!("it would take {commands} commands");
            let allowed = "one pattern of one T, played once".to_owned();
            loaded.fault("standalone", problem, allowed)
        }
        StoredError::Rewrite { rewrite, unit } => {
            let problem = format!("is {unit}");
            let allowed = "unit times in order, each of 4 ticks or more and not the last of its \
                           pattern; unit_ticks 1 to 16777215";
            loaded.table_fault(("rewrite", rewrite), "unit", problem, allowed.to_owned())
        }
        StoredError::Nothing => {
            loaded.fault("play", "is empty".into(), "the name of a pattern".into())
        }
        StoredError::TooLong => {
            let allowed = format!("{MAX_UNITS} unit times in all");
            loaded.fault("play", "takes too long".into(), allowed)
        }
    }
}

/// The one system of the summary.
pub fn systems(job: &Job) -> Vec<System<'_>> {
    let (stored, motors) = (&job.stored, job.motors.clone());
    let (group, table) = (stored.group.clone(), &stored.played);
    vec![own(group, table, motors, move |_| stored.computer())]
}

/// Plays patterns.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    has_no_segments(arguments)?;
    let setup = Setup::new(arguments, &job.loaded, &job.stem)?;
    let stored = &job.stored;
    let (played, mut files) = play_table(
        &setup,
        (&stored.group, &stored.played),
        Some(of_table(&stored.played, "")),
        (&mut stored.computer(), job.motors.clone()),
        stored.writes.is_empty(),
    )?;
    files.write("svg", &draw(job, &played))?;
    conclude(&setup, files, Summary::new(job, &played))
}

/// The positions at the end of every unit time: Y over X, and each axis over time.
fn draw(job: &Job, played: &Played) -> String {
    let axes = job.stored.group.axes;
    let mut path = Points::expecting(played.positions.units);
    let mut curves = vec![Points::expecting(played.positions.units); axes];
    let mut ticks = 0;
    let table = &job.stored.played;
    for ((period, _), at) in table.iter().zip(played.positions.of(table)) {
        ticks += u64::from(period);
        let seconds = ticks as f64 / job.scenario.clock_hz as f64;
        for (curve, position) in curves.iter_mut().zip(at.iter()) {
            curve.push((seconds, f64::from(*position)));
        }
        if let [x, y, ..] = *at {
            path.push((f64::from(x), f64::from(y)));
        }
    }
    let mut picture = Picture::new(format!("{}: pulse interpolator, patterns", job.stem));
    if axes > 1 {
        let panel = Panel::new("path", "x in steps", "y in steps").equal_scales();
        picture = picture.panel(panel.curve(Curve::thinned("as pulsed", path).colour("#0072b2")));
    }
    let mut panel = Panel::new("positions", "time in s", "steps");
    for (name, curve) in AXIS_NAMES.iter().zip(curves) {
        panel = panel.curve(Curve::thinned(*name, curve));
    }
    picture.panel(panel).render()
}
