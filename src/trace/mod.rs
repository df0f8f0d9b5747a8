//! What a run looks like: dumps as VCD and FST and their GTKWave save files, recordings, text
//! waves, timing charts that are executed, and the stimulus as a file.
//!
//! At tick n everything is sampled at time n·P with `clk` high, `clk` falls half a period later,
//! and the registers of tick n + 1 show from (n + 1)·P on.

mod behind;
pub mod chart;
mod clock;
mod dump;
mod fst;
pub mod gtkw;
mod layout;
mod record;
mod section;
mod stimulus_file;
pub mod text;
pub(crate) mod value;
mod vcd;
mod walk;
mod wave_file;

pub use clock::{Clock, ClockError};
pub(crate) use dump::Dump;
pub use fst::Fst;
pub(crate) use layout::Layout;
pub use layout::{LayoutError, Options};
pub use record::{RecordError, Recorder};
pub(crate) use stimulus_file::Lines;
pub use stimulus_file::StimulusFile;
pub(crate) use vcd::VcdFile;
pub use vcd::{Vcd, VcdBehind};
pub use wave_file::{WaveFile, WaveFormat};

use crate::engine::Watch;
use crate::files::{AtomicFile, Directory, commit_all};
use crate::hdl::{Described, LeafView as View, Model, RunError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Begins the comment of a VCD that names the ports out; their paths follow.
pub(crate) const PORTS_OUT: &str = "ports out:";

/// Ticks that the window of a replay shows at first.
const FOCUS: u64 = 40;

/// Runs a circuit from power-on on these words of its ports in, a tick each, and writes
/// `<stem>.vcd` and the save file `<stem>.gtkw` into `dir`, which is made where it is missing.
/// Returns both paths.
///
/// Both files appear whole; where something fails, no new file or directory is there.
///
/// # Errors
/// The files cannot be written; two signals of the circuit have the same name; a tick has not one
/// word for each port in, or a word is wider than its port.
pub fn replay(
    circuit: &impl Described,
    inputs: impl IntoIterator<Item = Vec<u64>>,
    clock: Clock,
    dir: &Path,
    stem: &str,
) -> Result<Vec<PathBuf>, RunError> {
    play(
        &circuit.described()?,
        &mut inputs.into_iter(),
        clock,
        dir,
        stem,
    )
}

/// The same for a circuit that is elaborated.
pub(crate) fn play(
    model: &Model,
    inputs: &mut dyn Iterator<Item = Vec<u64>>,
    clock: Clock,
    dir: &Path,
    stem: &str,
) -> Result<Vec<PathBuf>, RunError> {
    let name = format!("{stem}.vcd");
    let _directory = Directory::create(dir)?;
    let mut dump = AtomicFile::create(dir.join(&name))?;
    let leaves = model.declarations().leaves.clone();
    let layout = Layout::new(model.name(), leaves, None).map_err(io::Error::from)?;
    let file = VcdFile::new(&mut dump, &layout, clock);
    let mut waves = Dump::new(&layout, clock, &Options::default(), file);
    let mut engine = model.engine(Watch::All);
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
