//! `keys`: the keys of a job's scenarios, with types, units, defaults and ranges.

pub mod schema;

use super::{Failure, json, named, to_standard_output};
use clap::Args;
use motion_rtl::nearest::did_you_mean;
use motion_rtl::registry::{self, CATALOGUE, Entry};
use motion_rtl::scenario::Runnable;
use motion_rtl::settings::{Row, rows};
use serde::Serialize;
use std::fmt::Write as _;

/// Arguments of `keys`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Job, which is a value of the key `circuit`, or circuit of the catalogue; without it, all names
    /// are printed.
    name: Option<String>,
    /// Prints the keys as JSON.
    #[arg(long)]
    json: bool,
    /// Prints a JSON schema of the job's scenarios, for editors.
    #[arg(long, requires = "name", conflicts_with = "json")]
    json_schema: bool,
}

/// Names without their keys.
#[derive(Debug, Serialize)]
struct Names {
    jobs: Vec<&'static str>,
    circuits: Vec<&'static str>,
}

/// Keys of one name, which a job and a circuit can have both.
#[derive(Debug, Serialize)]
struct Keys {
    /// Keys of the job's scenarios.
    #[serde(skip_serializing_if = "Option::is_none")]
    scenario: Option<Vec<Row>>,
    /// Keys of the circuit, for `--set` of `verilog`, `check` and others.
    #[serde(skip_serializing_if = "Option::is_none")]
    circuit: Option<Vec<registry::Key>>,
}

pub fn keys(arguments: &Arguments) -> Result<(), Failure> {
    let jobs = Runnable::ALL.map(Runnable::name).to_vec();
    let circuits: Vec<_> = CATALOGUE.iter().map(|entry| entry.name).collect();
    let Some(name) = &arguments.name else {
        let lines = |names: &[&str]| format!("  {}\n", names.join("\n  "));
        let text = format!("jobs\n{}\ncircuits\n{}", lines(&jobs), lines(&circuits));
        let names = Names { jobs, circuits };
        return match arguments.json {
            true => json::print(&names),
            false => to_standard_output(&text),
        };
    };
    let job = Runnable::ALL.into_iter().find(|job| job.name() == name);
    let circuit = registry::find(name).filter(|_| !arguments.json_schema);
    if job.is_none() && circuit.is_none() {
        let names = match arguments.json_schema {
            true => jobs,
            false => [jobs, circuits].concat(),
        };
        let near = did_you_mean(name, names.iter().copied());
        let kind = match arguments.json_schema {
            true => "job",
            false => "job or circuit",
        };
        return Err(Failure::Argument {
            field: "NAME",
            problem: match registry::find(name) {
                Some(_) => format!("{name} is a circuit, whose keys stand in no file"),
                None => format!("no {kind} is called {}{near}", named(name)),
            },
            allowed: match arguments.json_schema {
                true => format!(
                    "a job, for a schema of its scenarios: {}; --json for the keys of a circuit",
                    names.join(", ")
                ),
                false => "a name of a job or a circuit; `motion-rtl keys` lists all".to_owned(),
            },
        });
    }
    if let (Some(job), true) = (job, arguments.json_schema) {
        let (keys, defaults) = job.keys();
        return json::print_alone(&schema::of(job, &keys, &defaults));
    }
    let scenario = job.map(|job| {
        let (keys, defaults) = job.keys();
        rows(&keys, &defaults)
    });
    let keys = Keys {
        scenario,
        circuit: circuit.map(Entry::keys),
    };
    match arguments.json {
        true => json::print(&keys),
        false => to_standard_output(&keys.text()),
    }
}

impl Keys {
    fn text(&self) -> String {
        let scenario = self.scenario.as_deref().map(text);
        let circuit = self.circuit.as_deref().map(circuit_text);
        match (scenario, circuit) {
            (Some(scenario), Some(circuit)) => {
                format!("keys of a scenario\n\n{scenario}\nkeys of the circuit\n\n{circuit}")
            }
            (scenario, circuit) => [scenario, circuit].into_iter().flatten().collect(),
        }
    }
}

/// Formats the keys of a circuit, two lines each with an empty line between them: the value as it is
/// built, that of the small one, and what is allowed; the meaning.
fn circuit_text(keys: &[registry::Key]) -> String {
    let value = |value: &Option<String>| value.clone().unwrap_or_else(|| "not set".to_owned());
    let lines = keys.iter().map(|key| {
        let (full, small) = (value(&key.full), value(&key.small));
        let parts = [key.kind.as_str(), key.unit, key.range.as_str()];
        let parts: Vec<_> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        let small = match full == small {
            true => String::new(),
            false => format!(", small: {small}"),
        };
        let (name, about) = (&key.name, &key.about);
        format!(
            "{name} = {full}{small}: {}\n    {about}\n",
            parts.join(", ")
        )
    });
    lines.collect::<Vec<_>>().join("\n")
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
