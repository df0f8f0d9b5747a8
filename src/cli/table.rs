//! `table`: a drawing compiled into the pattern memory's contents.

use super::files::Named;
use super::pulse::{Job, TableSummary, warnings};
use super::source::{Input, Source};
use super::written::Written;
use super::{Failure, json, print};
use clap::Args;
use motion_rtl::circuits::pulse_interpolator::AXIS_NAMES;
use motion_rtl::files;
use motion_rtl::input::counted;
use motion_rtl::jobs::pulse_interpolator::table::read::columns;
use motion_rtl::jobs::pulse_interpolator::{AxisScaling, Ratio, Report, Scaled, Table};
use serde::Serialize;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments of `table`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    input: Input,
    /// Writes the table as CSV: unit, T, then half-period and direction of each axis.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Multiplies the half-periods by a ratio such as 3/2, which makes the drawing smaller.
    #[arg(long, value_name = "NUM/DEN", allow_hyphen_values = true)]
    scale: Option<String>,
    /// Prints the report as JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Output<'a> {
    input: &'a str,
    clock_hz: u64,
    patterns: usize,
    #[serde(flatten)]
    report: &'a Report,
    scaling: Option<&'a [AxisScaling]>,
    warnings: Vec<String>,
    files: Vec<Named>,
}

pub fn table(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.out.as_deref() == Some(Path::new("-")) {
        return Err(Failure::Argument {
            field: "--out",
            problem: "is -".to_owned(),
            allowed: "the path of a file".to_owned(),
        });
    }
    let source = Source::read(&arguments.input)?;
    if let Some(path) = &arguments.out {
        source.spare_inputs("--out", path, &arguments.input)?;
    }
    let job = Job::prepare(source, false)?;
    let scaled = match &arguments.scale {
        Some(text) => Some(scale(&job.table, text)?),
        None => None,
    };
    let table = scaled.as_ref().map_or(&job.table, |scaled| &scaled.table);
    let mut files = Vec::new();
    if let Some(path) = &arguments.out {
        let directory = super::files::parent(path);
        super::files::clear(directory);
        let list = Written::read(directory);
        let written = files::write(path, csv(table));
        let written = written.map_err(|error| super::files::refuse_file("--out", &error))?;
        list.add([path.as_path()].into_iter());
        files.push(Named::new(&written));
    }
    let scaling = scaled.as_ref().map(|scaled| &scaled.axes[..]);
    let output = Output {
        input: &job.drawing.file,
        clock_hz: job.settings.clock_hz,
        patterns: table.patterns().len(),
        report: &job.report,
        scaling,
        warnings: warnings(&job),
        files,
    };
    match arguments.json {
        true => json::print(&output),
        false => {
            output
                .warnings
                .iter()
                .for_each(|warning| super::warn(warning));
            print(&text(&job, &output))
        }
    }
}

fn scale(table: &Table, text: &str) -> Result<Scaled, Failure> {
    let ratio = ratio(text).map_err(|allowed| Failure::Argument {
        field: "--scale",
        problem: format!("is {text}"),
        allowed: allowed.into(),
    })?;
    table.scaled(ratio).map_err(|error| Failure::Argument {
        field: "--scale",
        problem: error.to_string(),
        allowed: "a smaller ratio".into(),
    })
}

/// Parses a ratio; the error is what is allowed.
pub fn ratio(text: &str) -> Result<Ratio, &'static str> {
    let (num, den) = text.split_once('/').unwrap_or((text, "1"));
    let number = |text: &str| text.trim().parse::<u32>().ok().filter(|number| *number > 0);
    match (number(num), number(den)) {
        (Some(num), Some(den)) => Ok(Ratio { num, den }),
        _ => Err("NUM/DEN, two whole numbers from 1 to 4294967295"),
    }
}

fn csv(table: &Table) -> String {
    let mut text = columns(table.axes()).join(",") + "\n";
    // Writing to a string does not fail.
    for (unit, (period, words)) in table.iter().enumerate() {
        let _ = write!(text, "{unit},{period}");
        for word in words.iter() {
            let _ = write!(
                text,
                ",{},{}",
                word.half_period(),
                u8::from(word.negative())
            );
        }
        text.push('\n');
    }
    text
}

fn text(job: &Job, output: &Output<'_>) -> String {
    let mut text = format!(
        "{}: {} ticks at {} Hz, {}\n\n",
        output.input,
        job.report.total_ticks,
        output.clock_hz,
        counted(output.patterns, "pattern")
    );
    let _ = writeln!(
        text,
        "axis  steps demanded      up    down  end position  following error (unit, line)"
    );
    for (axis, name) in job.report.axes.iter().zip(AXIS_NAMES) {
        let error = axis.following_error;
        let _ = writeln!(
            text,
            "{name:<4}  {:>14}  {:>6}  {:>6}  {:>12}  {:>15} {:>12}",
            axis.steps_demanded,
            axis.pulses_forward,
            axis.pulses_backward,
            axis.end_position,
            format!("{:.3} steps", error.steps),
            format!("({}, {})", error.unit, error.line),
        );
    }
    text.push('\n');
    text.push_str(&TableSummary::new(job).text());
    for (axis, name) in output.scaling.into_iter().flatten().zip(AXIS_NAMES) {
        let _ = writeln!(
            text,
            "scaled, {name}: at most {:.3} pulses a unit time off the ideal, {:+.3} steps at the \
             end, {} half-periods rounded",
            axis.largest_deviation, axis.drift, axis.rounded_units
        );
    }
    for warning in &output.warnings {
        let _ = writeln!(text, "warning: {warning}");
    }
    for file in &output.files {
        let _ = writeln!(text, "wrote {file}");
    }
    text
}
