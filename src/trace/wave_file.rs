use super::behind::Behind;
use super::dump::{Dump, Format, observes};
use super::fst::Encoder;
use super::layout::Layout;
use super::vcd::VcdFile;
use super::walk::Change;
use super::{Clock, Options};
use crate::engine::Engine;
use crate::files::AtomicFile;
use crate::sim::{Described, LeafView as View, RunError};
use std::io;
use std::path::Path;

/// Waveform format.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum WaveFormat {
    /// Text that every waveform viewer reads; see [`Vcd`](super::Vcd).
    #[default]
    Vcd,
    /// Format of GTKWave, a fifth to a hundredth of the bytes; see [`Fst`](super::Fst).
    Fst,
}

impl WaveFormat {
    /// Returns the format that the extension of a file names.
    pub(crate) fn of(path: &Path) -> io::Result<Self> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("vcd") => Ok(WaveFormat::Vcd),
            Some("fst") => Ok(WaveFormat::Fst),
            _ => {
                let problem = format!(
                    "{}: the extension names no format; allowed: .vcd, .fst",
                    path.display()
                );
                Err(io::Error::new(io::ErrorKind::InvalidInput, problem))
            }
        }
    }
}

/// Waves of a run in a format chosen at run time; a thread formats them and writes the file.
///
/// If the format is known at compile time, [`VcdBehind`](super::VcdBehind) and [`Fst`](super::Fst)
/// do the same with any writer.
#[derive(Debug)]
#[must_use]
pub struct WaveFile {
    dump: Dump<Either>,
}

impl WaveFile {
    /// Begins a dump of `circuit` to `file`.
    ///
    /// # Errors
    /// Returns a [`LayoutError`](super::LayoutError) inside if a name is duplicate in a scope or
    /// cannot be written, or a selected path does not exist. Returns an error if the file cannot
    /// be written.
    pub fn new(
        file: AtomicFile,
        format: WaveFormat,
        circuit: &impl Described,
        clock: Clock,
        options: &Options,
    ) -> io::Result<Self> {
        let layout = Layout::of(circuit, options.only.as_deref())?;
        let file = match format {
            WaveFormat::Vcd => Either::Vcd(Behind::new(VcdFile::new(file, &layout, clock))?),
            WaveFormat::Fst => Either::Fst(Behind::new(Encoder::new(file, &layout, clock)?)?),
        };
        Ok(WaveFile {
            dump: Dump::new(&layout, clock, options, file),
        })
    }

    /// Writes a settled tick if it is selected.
    pub(super) fn tick(&mut self, tick: u64, engine: &Engine) -> Result<(), RunError> {
        self.dump.sample(tick, View::of(engine)).map(drop)
    }

    /// Gives the last tick its full length, waits until everything is written and returns the
    /// file, which is not yet committed.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn finish(self) -> io::Result<AtomicFile> {
        self.dump.finish()
    }
}

observes!([] WaveFile);

/// A single walk for both: otherwise the circuit would be compiled with each of them.
#[derive(Debug)]
enum Either {
    Vcd(Behind<VcdFile<AtomicFile>>),
    Fst(Behind<Encoder<AtomicFile>>),
}

impl Format for Either {
    type Out = AtomicFile;

    fn tick(&mut self, rise: u64, fall: u64, changes: &[Change]) -> io::Result<()> {
        match self {
            Either::Vcd(file) => file.tick(rise, fall, changes),
            Either::Fst(file) => file.tick(rise, fall, changes),
        }
    }

    fn finish(self, end: Option<u64>) -> io::Result<AtomicFile> {
        match self {
            Either::Vcd(file) => file.finish(end),
            Either::Fst(file) => file.finish(end),
        }
    }
}
