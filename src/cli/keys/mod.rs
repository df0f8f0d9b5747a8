//! `keys`: the keys of a job's scenarios, with types, units, defaults and ranges.

mod schema;

use super::{Failure, print, print_json};
use clap::Args;
use motion_rtl::nearest::nearest;
use motion_rtl::scenario::Runnable;
use motion_rtl::settings::{Row, rows};
use std::fmt::Write as _;

/// Arguments of `keys`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Job, named as by the key `circuit` of scenarios; by default the names of all jobs are
    /// printed.
    name: Option<String>,
    /// Prints the keys as JSON.
    #[arg(long)]
    json: bool,
    /// Prints a JSON schema of the job's scenarios, for editors.
    #[arg(long, requires = "name", conflicts_with = "json")]
    json_schema: bool,
}

pub fn keys(arguments: &Arguments) -> Result<(), Failure> {
    let names = || Runnable::ALL.map(Runnable::name).into_iter();
    let Some(name) = &arguments.name else {
        let names: Vec<_> = names().collect();
        return match arguments.json {
            true => print_json(&names),
            false => print(&(names.join("\n") + "\n")),
        };
    };
    let Some(job) = Runnable::ALL.into_iter().find(|job| job.name() == name) else {
        let near = nearest(name, names()).map(|near| format!("{near} is the nearest; "));
        let names: Vec<_> = names().collect();
        return Err(Failure::Argument {
            field: "NAME",
            problem: format!("no job is called {name}"),
            allowed: format!("{}one of {}", near.unwrap_or_default(), names.join(", ")),
        });
    };
    let (keys, defaults) = job.keys();
    match (arguments.json_schema, arguments.json) {
        (true, _) => print_json(&schema::of(job, &keys, &defaults)),
        (_, true) => print_json(&rows(&keys, &defaults)),
        _ => print(&text(&rows(&keys, &defaults))),
    }
}

/// Formats the keys as text: two lines each, with an empty line between them.
fn text(rows: &[Row]) -> String {
    let mut text = String::new();
    for row in rows {
        let parts = [row.kind.as_str(), row.unit, row.range.as_str()];
        let parts = parts.into_iter().filter(|part| !part.is_empty());
        let parts: Vec<_> = parts.collect();
        // Writing to a string does not fail.
        let _ = match row.default.as_str() {
            "required" => writeln!(text, "{} (required): {}", row.key, parts.join(", ")),
            default => writeln!(text, "{} = {default}: {}", row.key, parts.join(", ")),
        };
        let _ = writeln!(text, "    {}\n", row.about);
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}
