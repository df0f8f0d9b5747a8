//! `run`: a job on its circuit, with waves, save file and picture.

use super::arguments::Arguments;
use super::job::Job;
use super::source::Source;
use super::viewer::Viewer;
use super::{Failure, progress};

/// The key that `--beside` sets.
const BESIDE: &str = "beside=true";

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    progress::begin();
    let done = play(arguments);
    progress::end();
    done
}

fn play(arguments: &Arguments) -> Result<(), Failure> {
    // Before the run, which may be long.
    arguments.open.then(Viewer::find).transpose()?;
    let mut input = arguments.input.clone();
    input
        .sets
        .extend(arguments.beside.then(|| BESIDE.to_owned()));
    let mut source = Source::read(&input)?;
    source.compares |= arguments.waves_of.is_some();
    Job::prepare(source)?.run(arguments)
}
