//! The files of a run while it goes on: waves, save file, and the circuit in Verilog with its
//! stimulus.

use super::export::{Export, Printed};
use super::files::Files;
use super::plan::{Noted, of_job};
use super::progress::Part;
use super::series::SeriesPath;
use super::setup::Setup;
use super::{Failure, named};
use motion_rtl::files::AtomicFile;
use motion_rtl::hdl::Circuit;
use motion_rtl::sim::{Described, Observer, RunError, Without};
use motion_rtl::trace::{
    Clock, LayoutError, OutputFile, SeriesFile, SeriesLayout, StimulusFile, WaveFile, gtkw, surfer,
};
use motion_rtl::verilog::Verilog;
use std::io;
use std::ops::Range;
use std::path::Path;

/// Directory of the files of a run, unless `--out` names another.
pub const DIRECTORY: &str = "waves";

/// Scopes that a refusal lists.
const MOST_SCOPES: usize = 40;

/// The files of a run.
pub struct Traces<'a> {
    setup: &'a Setup<'a>,
    clock: Clock,
    /// Every signal at every tick.
    waves: Option<WaveFile>,
    /// The inputs of the circuit alone.
    stimulus: Option<Without<StimulusFile<AtomicFile>>>,
    /// The outputs of the circuit alone.
    outputs: Option<Without<OutputFile<AtomicFile>>>,
    /// The inputs once more, for the plan.
    noted: Option<Noted>,
    /// Positions over time.
    series: Option<SeriesFile<'a, AtomicFile>>,
    progress: Part,
    // Last, as their directory can go only when the files above are gone.
    files: Files,
}

/// Window of the save file.
#[derive(Debug, Clone, Copy)]
pub struct Focus {
    /// The tick that matters.
    pub action: u64,
    /// Ticks before it, where they are in the dump.
    pub before: u64,
    /// Ticks shown.
    pub shown: u64,
    /// Signals that are shown on top.
    pub overview: &'static [&'static str],
}

/// End of a run.
#[derive(Debug, Clone, Copy)]
pub struct End {
    /// Ticks of the run.
    pub ticks: u64,
    /// Window of the save file.
    pub focus: Focus,
}

impl<'a> Traces<'a> {
    /// Begins the requested files of a run of about `ticks` ticks. `printed` is the circuit to
    /// print as Verilog: the same one, or the part without its plant.
    pub fn begin(
        (circuit, printed): (&impl Described, &impl Described),
        setup: &'a Setup<'a>,
        ticks: u64,
        series: Option<SeriesLayout<'a>>,
    ) -> Result<Self, Failure> {
        let clock = setup.clock(ticks)?;
        let Setup {
            arguments, stem, ..
        } = *setup;
        let directory = arguments.out.as_deref().unwrap_or(Path::new(DIRECTORY));
        let mut files = Files::begin(directory, stem)?;
        let format = arguments.format;
        let waves = match arguments.no_vcd {
            true => None,
            false => {
                let file = files.create(format.extension())?;
                let waves = WaveFile::new(file, format.into(), circuit, clock, &setup.options);
                Some(waves.map_err(refused)?)
            }
        };
        let (stimulus, outputs) = match arguments.verilog {
            true => Some(verilog(printed, clock, stem, &mut files)?).unzip(),
            false => (None, None),
        };
        let series = match (&arguments.series, series) {
            (Some(SeriesPath { path, format }), Some(layout)) => {
                let hz = setup.loaded.scenario.clock_hz();
                let file = files.create_at("--series", path)?;
                let rows = setup.series_ticks();
                Some(SeriesFile::new(file, *format, circuit, hz, rows, layout)?)
            }
            _ => None,
        };
        Ok(Traces {
            setup,
            clock,
            files,
            waves,
            stimulus: stimulus.map(Without),
            outputs: outputs.map(Without),
            series,
            noted: arguments.plan.then(Noted::default),
            progress: Part::default(),
        })
    }

    /// Returns the observer that feeds all files, and the progress.
    pub fn observer<C: Circuit>(&mut self) -> impl Observer<C> {
        (
            self.waves.as_mut(),
            (self.stimulus.as_mut(), self.outputs.as_mut()),
            (self.noted.as_mut(), self.series.as_mut()),
            &mut self.progress,
        )
    }

    /// Closes the files and writes the save file; refuses a window outside the run.
    pub fn finish(mut self, circuit: &impl Described, end: &End) -> Result<Files, Failure> {
        let End { ticks, focus } = end;
        self.setup.check_window(*ticks)?;
        if let Some(stimulus) = self.stimulus {
            self.files.push(stimulus.0.finish()?);
        }
        if let Some(outputs) = self.outputs {
            self.files.push(outputs.0.finish()?);
        }
        if let Some(Noted(inputs)) = self.noted {
            self.files.write("plan.txt", &of_job(circuit, &inputs)?)?;
        }
        if let Some(waves) = self.waves {
            let Setup {
                arguments,
                stem,
                options,
                ..
            } = self.setup;
            let Range { start, end } = options.ticks;
            let first = match focus.action < end {
                true => focus.action.saturating_sub(focus.before).max(start),
                false => start,
            };
            // Within the dump, and from earlier on if the dump ends too soon.
            let last = end.min(*ticks).max(start.saturating_add(1));
            let first = first.min(last.saturating_sub(focus.shown)).max(start);
            let window = first..first.saturating_add(focus.shown).min(last);
            // First, as both take memory for every word of the circuit's memories.
            let file = waves.finish().map_err(RunError::Waves)?;
            self.files.push(file);
            let dump = format!("{stem}.{}", arguments.format.extension());
            let save =
                gtkw::save_file_with(circuit, self.clock, options, &dump, window, focus.overview);
            self.files.write_save(&save.map_err(io::Error::from)?)?;
            if arguments.surfer {
                let mappings = surfer::mappings(circuit, options).map_err(io::Error::from)?;
                self.files.write_mappings(&mappings)?;
            }
        }
        if let Some(series) = self.series {
            self.files.push(series.finish()?);
        }
        Ok(self.files)
    }
}

/// Exports the circuit's Verilog and its testbench; returns the writers of stimulus and outputs.
fn verilog(
    circuit: &impl Described,
    clock: Clock,
    stem: &str,
    files: &mut Files,
) -> Result<(StimulusFile<AtomicFile>, OutputFile<AtomicFile>), Failure> {
    // Every circuit of the crate is printed by a test, so only a new one can fail here.
    let verilog = Verilog::new(circuit).map_err(|error| Failure::Check(error.to_string()))?;
    files.export(Export::new(
        Printed::Verilog(&verilog),
        Some(clock),
        format!("run {stem}"),
    ))?;
    let name = circuit.outlined().0;
    let stimulus = files.create_as(&format!("{name}.stimulus"))?;
    let expected = files.create_as(&format!("{name}.expected"))?;
    let expected = OutputFile::new(expected, circuit);
    let expected = expected.map_err(|error| Failure::Check(error.to_string()))?;
    Ok((StimulusFile::new(stimulus, circuit), expected))
}

fn refused(error: io::Error) -> Failure {
    match error.downcast::<LayoutError>() {
        Ok(error) => not_selected(&error),
        Err(error) => error.into(),
    }
}

fn not_selected(error: &LayoutError) -> Failure {
    let (problem, allowed) = match error {
        LayoutError::Unknown { wanted, scopes } => (
            format!("there is no {}", named(wanted)),
            format!("a signal, or a scope: {}", outermost(scopes)),
        ),
        other => (other.to_string(), "other signals".into()),
    };
    Failure::Argument {
        field: "--only",
        problem,
        allowed,
    }
}

/// Formats all scopes; of a large circuit only those of its blocks.
fn outermost(scopes: &[String]) -> String {
    if scopes.len() <= MOST_SCOPES {
        return scopes.join(", ");
    }
    let outer = |scope: &&String| scope.matches('.').count() <= 1;
    let shown: Vec<_> = scopes.iter().filter(outer).map(String::as_str).collect();
    let within = scopes.len() - shown.len();
    format!("{}, and {within} within these", shown.join(", "))
}
