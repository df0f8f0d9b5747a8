//! The files of a run while it goes on: waves, save file, and the circuit in Verilog with its
//! stimulus.

use super::Failure;
use super::export::Export;
use super::files::Files;
use super::plan::{Noted, of_job};
use super::progress::Part;
use super::run::{Arguments, clock};
use clap::ValueEnum;
use motion_rtl::files::AtomicFile;
use motion_rtl::hdl::{Circuit, Described, Model, Observer, RunError, Without};
use motion_rtl::scenario::Loaded;
use motion_rtl::trace::{
    Clock, LayoutError, Options, OutputFile, StimulusFile, WaveFile, WaveFormat, gtkw,
};
use motion_rtl::verilog::Verilog;
use std::io;
use std::ops::Range;
use std::path::Path;

/// Scopes that a refusal lists.
const MOST_SCOPES: usize = 40;

/// The files of a run.
pub struct Traces<'a> {
    stem: &'a str,
    format: Format,
    options: &'a Options,
    clock: Clock,
    /// Every signal at every tick.
    pub waves: Option<WaveFile>,
    /// The inputs.
    pub stimulus: Option<StimulusFile<AtomicFile>>,
    /// The outputs.
    outputs: Option<OutputFile<AtomicFile>>,
    /// The inputs once more, for the plan.
    pub noted: Option<Noted>,
    // Last, as their directory can go only when the files above are gone.
    files: Files,
}

/// A format of waves.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Text that every waveform viewer reads.
    #[default]
    Vcd,
    /// GTKWave's own, a fifth to a hundredth of the bytes.
    Fst,
}

impl From<Format> for WaveFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::Vcd => WaveFormat::Vcd,
            Format::Fst => WaveFormat::Fst,
        }
    }
}

impl Format {
    fn extension(self) -> &'static str {
        match self {
            Format::Vcd => "vcd",
            Format::Fst => "fst",
        }
    }
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

impl<'a> Traces<'a> {
    /// Begins the requested files of a run of about `ticks` ticks. `printed` is the circuit to
    /// print as Verilog: the same one, or the part without its plant.
    pub fn begin(
        (circuit, printed): (&impl Described, &impl Described),
        arguments: &Arguments,
        (loaded, stem): (&Loaded, &'a str),
        options: &'a Options,
        ticks: u64,
    ) -> Result<Self, Failure> {
        let clock = clock(arguments, loaded, ticks, options)?;
        let directory = arguments.out.as_deref().unwrap_or(Path::new("waves"));
        let mut files = Files::begin(directory, stem)?;
        let format = arguments.format;
        let waves = match arguments.no_vcd {
            true => None,
            false => {
                let file = files.create(format.extension())?;
                let waves = WaveFile::new(file, format.into(), circuit, clock, options);
                Some(waves.map_err(refused)?)
            }
        };
        let (stimulus, outputs) = match arguments.verilog {
            true => Some(verilog(printed, clock, stem, &mut files)?).unzip(),
            false => (None, None),
        };
        Ok(Traces {
            stem,
            format,
            options,
            clock,
            files,
            waves,
            stimulus,
            outputs,
            noted: arguments.plan.then(Noted::default),
        })
    }

    /// Returns true if nothing of the run is written.
    pub fn is_empty(&self) -> bool {
        self.waves.is_none() && self.stimulus.is_none() && self.noted.is_none()
    }

    /// Plays a circuit, observed by all files, and closes them; `end` returns the window of the
    /// save file and the ticks of the run.
    pub fn play<C: Circuit, T>(
        mut self,
        model: &Model,
        play: impl FnOnce(&mut dyn Observer<C>) -> Result<T, Failure>,
        end: impl FnOnce(&T) -> (Focus, u64),
    ) -> Result<(T, Files), Failure> {
        let mut progress = Part::default();
        let stimulus = self.stimulus.as_mut().map(Without);
        let outputs = self.outputs.as_mut().map(Without);
        let played = play(&mut (
            self.waves.as_mut(),
            (stimulus, outputs),
            self.noted.as_mut(),
            &mut progress,
        ))?;
        let (focus, ticks) = end(&played);
        let files = self.finish(model, &focus, ticks)?;
        Ok((played, files))
    }

    /// Closes the files after `ticks` ticks and writes the save file; refuses a window outside the
    /// run.
    pub fn finish(
        mut self,
        circuit: &impl Described,
        focus: &Focus,
        ticks: u64,
    ) -> Result<Files, Failure> {
        no_such_tick(self.options, ticks)?;
        if let Some(stimulus) = self.stimulus {
            self.files.push(stimulus.finish()?);
        }
        if let Some(outputs) = self.outputs {
            self.files.push(outputs.finish()?);
        }
        if let Some(Noted(inputs)) = self.noted {
            self.files.write("plan.txt", &of_job(circuit, &inputs)?)?;
        }
        if let Some(waves) = self.waves {
            let Range { start, end } = self.options.ticks;
            let first = match focus.action < end {
                true => focus.action.saturating_sub(focus.before).max(start),
                false => start,
            };
            let end = first.saturating_add(focus.shown);
            let window = first..end.min(ticks.max(first.saturating_add(1)));
            // First, as both take memory for every word of the circuit's memories.
            let file = waves.finish().map_err(RunError::Waves)?;
            self.files.push(file);
            let dump = format!("{}.{}", self.stem, self.format.extension());
            let options = self.options;
            let save =
                gtkw::save_file_with(circuit, self.clock, options, &dump, window, focus.overview);
            self.files.write("gtkw", &save.map_err(io::Error::from)?)?;
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
    let verilog = Verilog::of(circuit).map_err(|error| Failure::Check(error.to_string()))?;
    files.export(Export::new(&verilog, Some(clock), format!("run {stem}")))?;
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
            format!("there is no {wanted}"),
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

/// Refuses a window that begins after the end of the run.
pub fn no_such_tick(options: &Options, ticks: u64) -> Result<(), Failure> {
    if options.ticks.start < ticks {
        return Ok(());
    }
    Err(Failure::Argument {
        field: "--from",
        problem: format!("is {}", options.ticks.start),
        allowed: format!("0 to {}, the last tick of the run", ticks.saturating_sub(1)),
    })
}
