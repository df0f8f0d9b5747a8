//! `run`: a job on its circuit, with waves, save file and picture.

use super::arguments::Arguments;
use super::job::Job;
use super::series::SeriesPath;
use super::source::Source;
use super::traces::DIRECTORY;
use super::viewer::Viewer;
use super::wave_format::Format;
use super::{Failure, progress};
use motion_rtl::trace::SeriesFormat;
use std::path::Path;

/// The key that `--beside` sets.
const BESIDE: &str = "beside=true";

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    progress::begin();
    let done = play(arguments);
    progress::end();
    done
}

fn play(arguments: &Arguments) -> Result<(), Failure> {
    check_window(arguments)?;
    // Before the run, which may be long.
    arguments.open.then(Viewer::find).transpose()?;
    let mut input = arguments.input.clone();
    input
        .sets
        .extend(arguments.beside.then(|| BESIDE.to_owned()));
    let mut source = Source::read(&input)?;
    if let Some(series) = &arguments.series {
        source.spare_inputs("--series", &series.path, &input)?;
    }
    if let Some(page) = &arguments.html {
        check_page(page)?;
        source.spare_inputs("--html", page, &input)?;
    }
    let directory = arguments.out.as_deref().unwrap_or(Path::new(DIRECTORY));
    let arguments = match arguments.html {
        Some(_) => &with_page(arguments, directory, &source.stem),
        None => arguments,
    };
    // An input with a format of its own may have any extension.
    for extension in ["vcd", "fst", "svg"] {
        let output = directory.join(format!("{}.{extension}", source.stem));
        source.spare_inputs("--out", &output, &input)?;
    }
    source.compares |= arguments.waves_of.is_some();
    Job::prepare(source)?.run(arguments)
}

/// Returns the arguments with the files that a page shows.
fn with_page(arguments: &Arguments, directory: &Path, stem: &str) -> Arguments {
    let series = || SeriesPath {
        path: directory.join(format!("{stem}.csv")),
        format: SeriesFormat::Csv,
    };
    Arguments {
        format: Format::Fst,
        series: Some(arguments.series.clone().unwrap_or_else(series)),
        ..arguments.clone()
    }
}

/// Refuses a page with the name of another file of the run.
fn check_page(page: &Path) -> Result<(), Failure> {
    match page
        .extension()
        .is_some_and(|extension| extension == "html")
    {
        true => Ok(()),
        false => Err(Failure::Argument {
            field: "--html",
            problem: format!("{} is no name of a page", page.display()),
            allowed: "a file whose name ends in .html".into(),
        }),
    }
}

/// Refuses a window of nothing.
fn check_window(arguments: &Arguments) -> Result<(), Failure> {
    let has_window = arguments.from.is_some() || arguments.to.is_some();
    match has_window && arguments.no_vcd && arguments.series.is_none() {
        false => Ok(()),
        true => Err(Failure::Argument {
            field: "--from, --to",
            problem: "given with --no-vcd".into(),
            allowed: "with waves or --series".into(),
        }),
    }
}
