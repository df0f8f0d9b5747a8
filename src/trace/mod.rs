//! What a run looks like: value change dumps and their GTKWave save files, recordings, text
//! waves, timing charts that are executed, and the stimulus as a file.
//!
//! At tick n everything is sampled at time n·P with `clk` high, `clk` falls half a period later,
//! and the registers of tick n + 1 show from (n + 1)·P on.

pub mod atomic;
pub mod chart;
mod clock;
pub mod gtkw;
mod layout;
mod record;
mod stimulus_file;
pub mod text;
pub(crate) mod value;
mod vcd;

pub use clock::{Clock, ClockError};
pub use layout::{LayoutError, Options};
pub use record::{RecordError, Recorder};
pub use stimulus_file::StimulusFile;
pub use vcd::Vcd;

use crate::kernel::{Circuit, Observer, RunError, Simulator};
use crate::logic::Sim;
use atomic::AtomicFile;
use std::fs;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Ticks that the window of a replay shows at first.
const FOCUS: u64 = 40;

/// Runs a circuit from power-on on these inputs, one a tick, and writes `<stem>.vcd` and the save
/// file `<stem>.gtkw` into `dir`. Returns both paths.
///
/// Both files appear whole; where something fails, no new file is there.
///
/// # Errors
/// The files cannot be written; two signals of the circuit have the same name.
pub fn replay<C: Circuit>(
    circuit: &C,
    inputs: impl IntoIterator<Item = C::In<Sim>>,
    clock: Clock,
    dir: &Path,
    stem: &str,
) -> Result<Vec<PathBuf>, RunError> {
    let options = Options::default();
    let file = AtomicFile::create(dir.join(format!("{stem}.vcd")))?;
    let mut vcd = Vcd::new(file, circuit, clock, &options).map_err(io::Error::from)?;
    let mut simulator = Simulator::new(circuit);
    for i in inputs {
        let (next, seen) = simulator.step(i, |now| vcd.sample(now));
        simulator = next;
        if let ControlFlow::Break(()) = seen? {
            break;
        }
    }
    let ticks = simulator.tick();
    let dump = vcd.finish()?;

    let focus = 0..ticks.min(FOCUS);
    let save = gtkw::save_file(circuit, clock, &options, stem, focus).map_err(io::Error::from)?;
    let mut save_file = AtomicFile::create(dir.join(format!("{stem}.gtkw")))?;
    save_file.write_all(save.as_bytes())?;
    let dump = dump.commit()?;
    match save_file.commit() {
        Ok(save_file) => Ok(vec![dump, save_file]),
        Err(error) => {
            // The first error is the one to report.
            let _ = fs::remove_file(dump);
            Err(error.into())
        }
    }
}
