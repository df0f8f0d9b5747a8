//! `run --waves-of`: one system of a scenario's summary with its waves.

use super::arguments::Arguments;
use super::files::Files;
use super::progress::Work;
use super::report::{Outcome, Report, conclude};
use super::setup::Setup;
use super::simulate::{Stage, with_waves};
use super::traces::End;
use super::{Failure, named};
use motion_rtl::hdl::Circuit;
use motion_rtl::scenario::Loaded;
use motion_rtl::sim::{Elaborated, Observer};
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
type Play<'a> = Box<dyn FnOnce(&Setup<'_>) -> Result<Shown, Failure> + 'a>;
type Shown = (&'static str, Ending, Files);

/// End of a system's run.
pub struct Ending {
    /// End of its circuit's run.
    pub end: End,
    /// Last position of each axis or body.
    pub position: BTreeMap<&'static str, i64>,
    /// Unit of the positions.
    pub unit: &'static str,
}

/// A circuit with the model that the waves show, its plant included, and the run of it.
pub type Staged<C, P> = (C, Elaborated, P);

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
        let play = move |setup: &Setup<'_>| {
            let (circuit, model, play) = make()?;
            let stage = Stage {
                circuit: &circuit,
                model: &model,
                subject: setup.stem,
                work: Work {
                    ticks,
                    runs: 1,
                    seconds: ticks as f64 * TICK_S,
                },
                series: None,
            };
            let (ending, files) = with_waves(setup, stage, |observer| {
                let ending = play(&circuit, observer)?;
                let end = ending.end;
                Ok((ending, end))
            })?;
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Fields that all summaries share.
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
            problem: format!("{stem} has no system {}", named(wanted)),
            allowed: keys.join(", "),
        });
    };
    let of_system = format!("{stem}_{wanted}");
    let setup = Setup::new(arguments, loaded, &of_system)?;
    let (circuit, ending, files) = (system.play)(&setup)?;
    let summary = Summary {
        outcome: Outcome::new(circuit, stem, loaded.scenario.clock_hz(), ending.end.ticks),
        system: system.name,
        end_position: ending.position,
        unit: ending.unit,
    };
    conclude(&setup, files, summary)
}
