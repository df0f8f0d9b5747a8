//! `run --waves-of`: one system of a scenario's summary with its waves.

use super::Failure;
use super::files::Files;
use super::progress::{self, Work};
use super::report::{Outcome, Report, conclude};
use super::run::{Arguments, in_waves, options};
use super::traces::{Focus, Traces};
use motion_rtl::hdl::{Circuit, Model, Observer};
use motion_rtl::scenario::Loaded;
use motion_rtl::trace::Options;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Seconds that a tick takes, about: of the circuits between 50 and 200 ns.
const TICK_S: f64 = 1e-7;

/// A system of a job, ready to be played with its waves.
pub struct System<'a> {
    /// Name in the summary.
    name: String,
    play: Play<'a>,
}

/// Plays a system; gives the circuit's name too.
type Play<'a> = Box<dyn FnOnce(&Stage<'_>) -> Result<Shown, Failure> + 'a>;
type Shown = (&'static str, Ending, Files);

/// Arguments and input of a system's run.
struct Stage<'s> {
    arguments: &'s Arguments,
    options: &'s Options,
    loaded: &'s Loaded,
    stem: &'s str,
}

/// End of a system's run.
pub struct Ending {
    /// Ticks of the run.
    pub ticks: u64,
    /// Window of the save file.
    pub focus: Focus,
    /// Last position of each axis or body.
    pub position: BTreeMap<&'static str, i64>,
    /// Unit of the positions.
    pub unit: &'static str,
}

/// A circuit with the model that the waves show, its plant included, and the run of it.
pub type Staged<C, P> = (C, Model, P);

impl<'a> System<'a> {
    /// Creates a system with its name in the summary and the approximate ticks of its run; `make`
    /// returns circuit, model and run.
    pub fn new<C, P>(
        name: impl Into<String>,
        ticks: u64,
        make: impl FnOnce() -> Result<Staged<C, P>, Failure> + 'a,
    ) -> Self
    where
        C: Circuit,
        P: FnOnce(&C, &mut dyn Observer<C>) -> Result<Ending, Failure>,
    {
        let play = move |stage: &Stage<'_>| {
            let (circuit, model, play) = make()?;
            let scenario = (stage.loaded, stage.stem);
            let shown = (&model, &circuit);
            let options = stage.options;
            let traces = Traces::begin(shown, stage.arguments, scenario, options, ticks)?;
            let work = Work {
                ticks,
                runs: 1,
                seconds: ticks as f64 * TICK_S,
                in_waves: in_waves(stage.arguments, options, ticks),
            };
            progress::run(stage.stem, work);
            let (ending, files) = traces.play(
                &model,
                |observer| play(&circuit, observer),
                |ending: &Ending| (ending.focus, ending.ticks),
            )?;
            Ok((model.name(), ending, files))
        };
        System {
            name: name.into(),
            play: Box::new(play),
        }
    }

    /// Name on the command line: that of the summary in snake case.
    pub fn key(&self) -> String {
        let words = self.name.split(|c: char| !c.is_ascii_alphanumeric());
        let words: Vec<_> = words.filter(|word| !word.is_empty()).collect();
        words.join("_").to_ascii_lowercase()
    }
}

/// The summary of a system that was played alone.
#[derive(Debug, Serialize)]
struct Summary {
    #[serde(flatten)]
    outcome: Outcome,
    /// Name in the summary of the scenario.
    system: String,
    /// Last position of each axis or body.
    end_position: BTreeMap<&'static str, i64>,
    /// Unit of the positions.
    unit: &'static str,
}

impl Report for Summary {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, _: bool) -> std::fmt::Result {
        let subject = self.outcome.subject();
        writeln!(
            text,
            "{subject}, system {}: {}",
            self.system,
            self.outcome.length()
        )?;
        let ends = self.end_position.iter();
        let ends: Vec<_> = ends.map(|(axis, at)| format!("{axis} {at}")).collect();
        match ends.is_empty() {
            true => Ok(()),
            false => writeln!(text, "ends at {} {}\n", ends.join(", "), self.unit),
        }
    }
}

/// Plays the system that is asked for, with waves of its own: `STEM_NAME.vcd`.
pub fn run(
    arguments: &Arguments,
    wanted: &str,
    (loaded, stem): (&Loaded, &str),
    systems: Vec<System<'_>>,
) -> Result<(), Failure> {
    let keys: Vec<_> = systems.iter().map(System::key).collect();
    let found = systems.into_iter().find(|system| system.key() == wanted);
    let Some(system) = found else {
        return Err(Failure::Argument {
            field: "--waves-of",
            problem: format!("{stem} has no system {wanted}"),
            allowed: keys.join(", "),
        });
    };
    let scenario = &loaded.scenario;
    let options = options(arguments, scenario.vcd_ticks())?;
    let stage = Stage {
        arguments,
        options: &options,
        loaded,
        stem: &format!("{stem}_{wanted}"),
    };
    let (circuit, ending, files) = (system.play)(&stage)?;
    let summary = Summary {
        outcome: Outcome::new(circuit, stem, scenario.clock_hz(), ending.ticks),
        system: system.name,
        end_position: ending.position,
        unit: ending.unit,
    };
    conclude(arguments, &options, files, summary)
}
