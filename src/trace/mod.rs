//! Waves of a run: VCD and FST dumps with GTKWave save files, mapping files for Surfer, recordings,
//! text waves, executable timing charts, and stimulus files.
//!
//! Tick n is sampled at time n·P with `clk` high. `clk` falls half a period later, and the
//! registers of tick n + 1 appear at (n + 1)·P.

mod behind;
mod both;
pub mod chart;
mod clock;
mod dump;
mod fst;
pub mod gtkw;
mod last_ticks;
mod layout;
mod model_waves;
mod output_file;
mod record;
mod section;
mod series;
mod stimulus_file;
pub mod surfer;
pub mod text;
pub(crate) mod value;
mod vcd;
mod walk;
mod wave_file;

pub(crate) use both::{Both, play_both};
pub use clock::{Clock, ClockError};
pub(crate) use dump::Dump;
pub use fst::Fst;
pub use last_ticks::LastTicks;
pub(crate) use layout::Layout;
pub use layout::{LayoutError, Options};
pub use output_file::OutputFile;
pub use record::{RecordError, Recorder};
pub use series::{Position, Rows, SeriesAxis, SeriesFile, SeriesFormat, SeriesLayout, SeriesPlan};
pub(crate) use stimulus_file::Lines;
pub use stimulus_file::StimulusFile;
pub(crate) use vcd::VcdFile;
pub use vcd::{Vcd, VcdBehind};
pub use wave_file::{WaveFile, WaveFormat};

use crate::engine::Watch;
use crate::files::{AtomicFile, Directory, commit_all};
use crate::sim::{Described, Elaborated, LeafView as View, RunError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Prefix of the VCD comment that lists the output ports; their paths follow.
pub(crate) const PORTS_OUT: &str = "ports out:";

/// Ticks that the window of a replay shows at first.
const FOCUS: u64 = 40;

/// Runs a circuit from power-on with the given words of its input ports, one item per tick, and
/// writes `<stem>.vcd` and the save file `<stem>.gtkw` into `dir`, which is created if necessary.
/// Returns both paths.
///
/// Both files appear complete; on an error, no new file or directory is left.
///
/// # Errors
/// Returns an error if the files cannot be written, two signals have the same name, a tick has not
/// one word per input port, or a word is wider than its port.
pub fn replay(
    circuit: &impl Described,
    inputs: impl IntoIterator<Item = Vec<u64>>,
    clock: Clock,
    dir: &Path,
    stem: &str,
) -> Result<Vec<PathBuf>, RunError> {
    play(
        &circuit.described()?,
        Start::default(),
        &mut inputs.into_iter(),
        clock,
        dir,
        stem,
    )
}

/// Start of a replay: at power-on, except for some words.
#[derive(Debug, Default, Clone, Copy)]
pub(crate) struct Start<'a> {
    /// Words of registers and memories, by leaf.
    pub state: &'a [(usize, u64)],
    /// Remark at the head of the waves.
    pub comment: Option<&'a str>,
}

/// Replays an elaborated circuit as [`replay`] does, from any state.
pub(crate) fn play(
    model: &Elaborated,
    start: Start<'_>,
    inputs: &mut dyn Iterator<Item = Vec<u64>>,
    clock: Clock,
    dir: &Path,
    stem: &str,
) -> Result<Vec<PathBuf>, RunError> {
    let name = format!("{stem}.vcd");
    let _directory = Directory::create(dir)?;
    let mut dump = AtomicFile::create(dir.join(&name))?;
    let leaves = model.declarations().leaves.clone();
    let mut layout = Layout::new(model.name(), leaves, None).map_err(io::Error::from)?;
    layout.comment = start.comment.map(str::to_owned);
    let file = VcdFile::new(&mut dump, &layout, clock);
    let mut waves = Dump::new(&layout, clock, &Options::default(), file);
    let mut engine = model.engine(Watch::All);
    for &(leaf, word) in start.state {
        engine.set_leaf(leaf, word);
    }
    if !start.state.is_empty() {
        engine.wake();
    }
    let mut ticks = 0;
    let ports = model.ports();
    for i in inputs {
        ports.check_words(&i).map_err(RunError::at(ticks))?;
        engine.drive_all(&i);
        engine.settle();
        waves.tick(ticks, View::of(&engine))?;
        engine.edge();
        ticks += 1;
    }
    waves.finish()?;

    let save = gtkw::save(&layout, clock, &name, 0..ticks.min(FOCUS), &[]);
    let mut save_file = AtomicFile::create(dir.join(format!("{stem}.gtkw")))?;
    save_file.write_all(save.as_bytes())?;
    Ok(commit_all([dump, save_file])?)
}
