//! A run of a circuit with its files: the one place where a circuit is played with waves.

use super::Failure;
use super::files::Files;
use super::progress::{self, Work};
use super::setup::Setup;
use super::traces::{End, Traces};
use motion_rtl::hdl::Circuit;
use motion_rtl::sim::{Elaborated, Observer};
use motion_rtl::trace::SeriesLayout;

/// A circuit to be played.
#[derive(Debug)]
pub struct Stage<'a, C> {
    /// The circuit alone, which is printed as Verilog.
    pub circuit: &'a C,
    /// The circuit with its plant, which the waves show.
    pub model: &'a Elaborated,
    /// Name of the work in messages of progress.
    pub subject: &'a str,
    /// Expected length of the run and of those beside it.
    pub work: Work,
    /// Layout of the time series, if one is requested.
    pub series: Option<SeriesLayout<'a>>,
}

/// Opens the requested files, announces the run and plays it. Returns what `play` returns and the
/// complete files; after an error no file is left.
///
/// The files are opened first, so that errors in their options are reported at once.
pub fn with_waves<C: Circuit, T>(
    setup: &Setup<'_>,
    stage: Stage<'_, C>,
    play: impl FnOnce(&mut dyn Observer<C>) -> Result<(T, End), Failure>,
) -> Result<(T, Files), Failure> {
    let Stage {
        circuit,
        model,
        subject,
        work,
        series,
    } = stage;
    let mut traces = Traces::begin((model, circuit), setup, work.ticks, series)?;
    progress::run(subject, work, setup.in_waves(work.ticks));
    let (played, end) = play(&mut traces.observer())?;
    let files = traces.finish(model, &end)?;
    Ok((played, files))
}
