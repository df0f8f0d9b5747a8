//! `run` of patterns that stand in the memory: played by command, or without a control computer.

use super::summary::Minima;
use super::text::least;
use super::verdict::{count, miscount};
use super::{has_no_segments, simulate};
use crate::cli::Failure;
use crate::cli::report::{Outcome, Report, conclude};
use crate::cli::run::{Arguments, options};
use crate::cli::source::Source;
use crate::cli::table::{AxisDeviation, ratio};
use motion_rtl::circuits::pulse_interpolator::{AXIS_NAMES, Widths};
use motion_rtl::input::Fault;
use motion_rtl::jobs::pulse_interpolator::job::Played;
use motion_rtl::jobs::pulse_interpolator::table::MAX_UNITS;
use motion_rtl::jobs::pulse_interpolator::{AxisScaling, StepTiming, Stored, StoredError, Table};
use motion_rtl::picture::{Curve, Panel, Picture, Points};
use motion_rtl::scenario::Loaded;
use motion_rtl::scenario::pulse_interpolator::{PatternKeys, Scenario};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Patterns ready to be played.
struct Job {
    loaded: Loaded,
    stem: String,
    scenario: Scenario,
    timing: StepTiming,
    patterns: Vec<Pattern>,
    stored: Stored,
}

/// A pattern of the memory.
struct Pattern {
    keys: PatternKeys,
    /// As it was given.
    given: Table,
    /// As it is played.
    table: Table,
    /// What scaling did to each axis.
    scaling: Option<Vec<AxisScaling>>,
}

impl Job {
    fn prepare(source: Source, scenario: &Scenario) -> Result<Self, Failure> {
        let loaded = &source.loaded;
        if scenario.input.is_some() {
            let problem = "given beside [[pattern]]".to_owned();
            return Err(loaded.fault("input", problem, "one of both".into()).into());
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
            let scaled =
                match &keys.scale {
                    None => None,
                    Some(text) => {
                        let ratio = ratio(text)
                            .map_err(|allowed| refuse("scale", format!("is {text}"), allowed))?;
                        let scaled = given.scaled(ratio);
                        Some(scaled.map_err(|error| {
                            refuse("scale", error.to_string(), "a smaller ratio")
                        })?)
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
        let order = order(loaded, scenario)?;
        let tables: Vec<_> = patterns.iter().map(|pattern| &pattern.table).collect();
        let stored = Stored::new(
            &tables,
            &order,
            scenario.variant.into(),
            scenario.standalone,
        )
        .map_err(|error| stored_fault(loaded, error))?;
        let Source { loaded, stem, .. } = source;
        Ok(Job {
            loaded,
            stem,
            timing: scenario.timing(),
            scenario: scenario.clone(),
            patterns,
            stored,
        })
    }
}

/// The patterns that are played, by their numbers.
fn order(loaded: &Loaded, scenario: &Scenario) -> Result<Vec<usize>, Fault> {
    let names = || scenario.pattern.iter().map(|pattern| pattern.name.as_str());
    let Some(play) = &scenario.play else {
        return Ok((0..scenario.pattern.len()).collect());
    };
    let find = |name: &String| {
        names().position(|other| other == name).ok_or_else(|| {
            let allowed = names().collect::<Vec<_>>().join(", ");
            loaded.fault("play", format!("{name} is no pattern"), allowed)
        })
    };
    play.iter().map(find).collect()
}

/// What the memory or the group objects to.
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
        StoredError::Nothing => {
            loaded.fault("play", "is empty".into(), "the name of a pattern".into())
        }
        StoredError::TooLong => {
            let allowed = format!("{MAX_UNITS} unit times in all");
            loaded.fault("play", "takes too long".into(), allowed)
        }
    }
}

/// Plays patterns.
pub fn run(arguments: &Arguments, source: Source, scenario: &Scenario) -> Result<(), Failure> {
    has_no_segments(arguments)?;
    let job = Job::prepare(source, scenario)?;
    let options = options(arguments, scenario.vcd_ticks)?;
    let stored = &job.stored;
    let (played, mut files) = simulate(
        arguments,
        (&job.loaded, &job.stem),
        (&stored.group, &stored.played),
        &options,
        &mut stored.computer(),
    )?;
    files.write("svg", &draw(&job, &played))?;
    conclude(arguments, &options, files, Summary::new(&job, &played))
}

/// The positions at the end of every unit time: Y over X, and each axis over time.
fn draw(job: &Job, played: &Played) -> String {
    let axes = job.stored.group.axes;
    let mut path = Points::expecting(played.positions.len() / axes);
    let mut curves = vec![Points::expecting(played.positions.len() / axes); axes];
    let mut ticks = 0;
    let units = job
        .stored
        .played
        .iter()
        .zip(played.positions.chunks_exact(axes));
    for ((period, _), at) in units {
        ticks += u64::from(period);
        let seconds = ticks as f64 / job.scenario.clock_hz as f64;
        for (curve, position) in curves.iter_mut().zip(at) {
            curve.push((seconds, f64::from(*position)));
        }
        if let [x, y, ..] = at {
            path.push((f64::from(*x), f64::from(*y)));
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

/// What came of patterns that were played.
#[derive(Debug, Serialize)]
struct Summary {
    #[serde(flatten)]
    outcome: Outcome,
    /// What RST cleared.
    variant: &'static str,
    /// Whether every unit time has the pulses that its word makes, and every axis kept the driver's
    /// timing.
    exact: bool,
    /// Whether there is no control computer.
    standalone: bool,
    /// Commands that it gave.
    commands: usize,
    /// Words of an axis that patterns take in the memory, and how many there are.
    memory_words: [u64; 2],
    patterns: Vec<PatternSummary>,
    axes: BTreeMap<&'static str, AxisSummary>,
    /// Unit times played.
    units: usize,
    /// Unit times without pulses between two patterns.
    idle_units: u64,
}

/// A pattern of the memory.
#[derive(Debug, Serialize)]
struct PatternSummary {
    name: String,
    table: String,
    /// Its first and its last address.
    addresses: [u64; 2],
    /// Its unit times T, in the order in which they come.
    unit_ticks: Vec<u32>,
    /// Whether it ends where it begins, as it was given.
    closed: bool,
    /// Steps from where it begins to where it ends, as it is played, of each axis.
    end_steps: Vec<i64>,
    /// The ratio that its data were multiplied by.
    scale: Option<String>,
    /// What that did to each axis: where the path was closed, `drift_steps` is how far it is open.
    scaling: Option<Vec<AxisDeviation>>,
}

/// An axis, as its motor driver saw it.
#[derive(Debug, Serialize)]
struct AxisSummary {
    pulses_up: u64,
    pulses_down: u64,
    end_position: i64,
    timing_min_ticks: Minima,
}

/// Steps of each axis over a table, by the count law.
fn steps(table: &Table) -> Vec<i64> {
    let mut steps = vec![0; table.axes()];
    for (period, words) in table.iter() {
        for (sum, word) in steps.iter_mut().zip(words) {
            *sum += count(*word, period);
        }
    }
    steps
}

impl Summary {
    fn new(job: &Job, played: &Played) -> Self {
        let stored = &job.stored;
        let mut complaints = Vec::new();
        let mut axes = BTreeMap::new();
        for (axis, (name, seen)) in AXIS_NAMES.into_iter().zip(&played.axes).enumerate() {
            let minima = Minima::from(seen.minima);
            let miscounted = miscount(&stored.played, played, axis);
            let short = minima.too_short(&job.timing);
            let all = miscounted.into_iter().chain(short);
            complaints.extend(all.map(|text| format!("{name}: {text}")));
            let summary = AxisSummary {
                pulses_up: seen.pulses_up,
                pulses_down: seen.pulses_down,
                end_position: seen.position(),
                timing_min_ticks: minima,
            };
            axes.insert(name, summary);
        }
        let patterns = job.patterns.iter().zip(&stored.places);
        let patterns = patterns.map(|(pattern, place)| PatternSummary {
            name: pattern.keys.name.clone(),
            table: pattern.keys.table.display().to_string(),
            addresses: *place,
            unit_ticks: pattern
                .given
                .patterns()
                .iter()
                .map(|part| part.period)
                .collect(),
            closed: steps(&pattern.given).iter().all(|steps| *steps == 0),
            end_steps: steps(&pattern.table),
            scale: pattern.keys.scale.clone(),
            scaling: pattern
                .scaling
                .as_ref()
                .map(|axes| axes.iter().map(Into::into).collect()),
        });
        Summary {
            exact: complaints.is_empty(),
            variant: job.scenario.variant.name(),
            standalone: job.scenario.standalone,
            commands: stored.commands.len(),
            memory_words: [
                stored.places.last().map_or(0, |[_, last]| last + 1),
                1 << stored.group.widths.address,
            ],
            patterns: patterns.collect(),
            axes,
            units: stored.played.units(),
            idle_units: played.idle_units,
            outcome: Outcome {
                complaints,
                ..Outcome::new(
                    "pulse_interpolator",
                    &job.stem,
                    job.scenario.clock_hz,
                    played.ticks,
                )
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
        let [taken, room] = self.memory_words;
        let by = match (self.standalone, self.commands) {
            (true, _) => "no control computer".to_owned(),
            (false, 1) => "1 command".to_owned(),
            (false, commands) => format!("{commands} commands"),
        };
        writeln!(
            text,
            "{taken} of {room} words of the memory, none rewritten; {by}\n"
        )?;
        writeln!(text, "pattern       addresses      T (ticks)  end (steps)")?;
        for pattern in &self.patterns {
            let [first, last] = pattern.addresses;
            let list =
                |numbers: &mut dyn Iterator<Item = String>| numbers.collect::<Vec<_>>().join(", ");
            let periods = list(&mut pattern.unit_ticks.iter().map(u32::to_string));
            let ends = list(&mut pattern.end_steps.iter().map(i64::to_string));
            writeln!(
                text,
                "{:<12}  {:>9}  {periods:>13}  {ends}",
                pattern.name,
                format!("{first}-{last}")
            )?;
        }
        for pattern in &self.patterns {
            let scaled = pattern.scale.iter().zip(&pattern.scaling);
            for (ratio, axes) in scaled {
                let name = &pattern.name;
                writeln!(text, "{name}: data times {ratio}")?;
                for (axis, name) in axes.iter().zip(AXIS_NAMES) {
                    let end = match pattern.closed {
                        true => "the closed path ends",
                        false => "the end is",
                    };
                    writeln!(
                        text,
                        "  {name}: {end} {:+.3} steps off, at most {:.3} pulses in a unit time",
                        axis.drift_steps, axis.largest_deviation_pulses_per_unit
                    )?;
                }
            }
        }
        writeln!(
            text,
            "\naxis      up    down  end position   high   low setup  hold (min ticks)"
        )?;
        for (name, axis) in &self.axes {
            let Minima {
                high,
                low,
                setup,
                hold,
            } = axis.timing_min_ticks;
            writeln!(
                text,
                "{name:<4}  {:>6}  {:>6}  {:>12}  {:>5} {:>5} {:>5} {:>5}",
                axis.pulses_up,
                axis.pulses_down,
                axis.end_position,
                least(high),
                least(low),
                least(setup),
                least(hold),
            )?;
        }
        writeln!(text, "\n{} unit times", self.units)?;
        if self.idle_units > 0 {
            let idle = self.idle_units;
            writeln!(
                text,
                "{idle} unit times without pulses between two patterns"
            )?;
        }
        Ok(())
    }
}
