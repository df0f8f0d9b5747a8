//! `list`: circuits with ports and widths, and scenarios; or one circuit with its parts.

use super::chosen::{Changes, entry, no_circuit, refused};
use super::connections::{Connections, Signal};
use super::job::Job;
use super::shipped::{SHIPPED, Shipped};
use super::source::Source;
use super::waves_of::System;
use super::{Failure, json, to_standard_output};
use clap::Args;
use motion_rtl::hdl::Declaration;
use motion_rtl::netlist::Role;
use motion_rtl::registry::{AnyModel, Base, CATALOGUE, Entry, Key, Pair};
use motion_rtl::sim::RunError;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Arguments of `list`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Lists only this circuit, with its parts and the drivers of their input ports.
    circuit: Option<String>,
    #[command(flatten)]
    changes: Changes,
    /// Prints the list as JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Listing {
    circuits: Vec<Circuit>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    scenarios: Vec<Scenario>,
}

#[derive(Debug, Serialize)]
struct Circuit {
    name: &'static str,
    about: &'static str,
    source: &'static str,
    /// Keys with their values in the full and the small circuit.
    keys: BTreeMap<String, Values>,
    inputs: Vec<Port>,
    outputs: Vec<Port>,
    registers: usize,
    nets: usize,
    /// Properties of the small circuit that `check` proves, and its law.
    #[serde(skip_serializing_if = "Option::is_none")]
    properties: Option<Vec<String>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    connections: Option<Connections>,
}

#[derive(Debug, Serialize)]
struct Values {
    full: Option<String>,
    small: Option<String>,
}

#[derive(Debug, Serialize)]
struct Port {
    #[serde(flatten)]
    signal: Signal,
    about: String,
}

#[derive(Debug, Serialize)]
struct Scenario {
    file: &'static str,
    about: &'static str,
    /// Names of its systems for `run --waves-of`.
    systems: Vec<String>,
}

impl Scenario {
    fn of(shipped: &'static Shipped) -> Result<Self, Failure> {
        let mut source = Source::shipped(shipped)?;
        source.compares = true;
        let job = Job::prepare(source)?;
        Ok(Scenario {
            file: shipped.file,
            about: shipped.about,
            systems: job.systems().iter().map(System::key).collect(),
        })
    }
}

pub fn list(arguments: &Arguments) -> Result<(), Failure> {
    let listing = match &arguments.circuit {
        None if !arguments.changes.is_empty() => {
            return Err(no_circuit(&arguments.changes, "list"));
        }
        None => Listing {
            circuits: CATALOGUE
                .iter()
                .map(|entry| circuit(entry, &*entry.full()))
                .collect(),
            scenarios: SHIPPED.iter().map(Scenario::of).collect::<Result<_, _>>()?,
        },
        Some(name) => {
            let entry = entry(name)?;
            let pairs = arguments.changes.pairs(entry)?;
            let made = entry.made(Base::Full, &pairs);
            let made = made.map_err(|error| refused(entry, error))?;
            let connections = made.connections().map_err(RunError::from)?;
            let mut circuit = circuit(entry, &*made);
            circuit.connections = Some(Connections::of(connections));
            circuit.properties = Some(properties(entry, &pairs));
            Listing {
                circuits: vec![circuit],
                scenarios: Vec::new(),
            }
        }
    };
    match arguments.json {
        true => json::print(&listing),
        false => to_standard_output(&text(&listing)),
    }
}

fn circuit(entry: &Entry, made: &dyn AnyModel) -> Circuit {
    let declarations = made.outline();
    let keys = entry.keys().into_iter().map(|key| {
        let Key {
            name, full, small, ..
        } = key;
        (name, Values { full, small })
    });
    let leaves = &declarations.leaves;
    let port = |(name, leaf): (String, &Declaration)| Port {
        signal: Signal::of((name, leaf.shape)),
        about: leaf.field.plain_doc(),
    };
    let own = declarations.own().into_iter();
    let own = own.map(|(index, name)| (name, &leaves[index]));
    let (inputs, others): (Vec<_>, Vec<_>) = own.partition(|(_, leaf)| leaf.role == Role::Input);
    let inputs = inputs.into_iter().map(port);
    let outputs = others.into_iter().filter(|(_, leaf)| leaf.field.public);
    let count = |role| leaves.iter().filter(|leaf| leaf.role == role).count();
    Circuit {
        name: entry.name,
        about: entry.about,
        source: entry.source,
        keys: keys.collect(),
        inputs: inputs.collect(),
        outputs: outputs.map(port).collect(),
        registers: count(Role::Register),
        nets: count(Role::Net),
        properties: None,
        connections: None,
    }
}

/// Returns the properties of the small circuit that are proved, and the statement of its law.
fn properties(entry: &Entry, pairs: &[Pair]) -> Vec<String> {
    let proof = entry.proof(pairs).ok();
    let mut properties = proof.map_or_else(Vec::new, |circuit| circuit.invariants());
    let law = entry.law(pairs).ok();
    properties.extend(law.map(|law| law.law().to_owned()));
    properties
}

fn text(listing: &Listing) -> String {
    let mut text = String::from("circuits\n");
    // Writing to a string does not fail.
    for circuit in &listing.circuits {
        let _ = writeln!(
            text,
            "\n  {} ({}): {}",
            circuit.name, circuit.source, circuit.about
        );
        for (of, keys) in keys(&circuit.keys) {
            if !keys.is_empty() {
                let _ = writeln!(text, "    {of:<6}  {keys}");
            }
        }
        let _ = writeln!(text, "    in      {}", ports(&circuit.inputs));
        let _ = writeln!(text, "    out     {}", ports(&circuit.outputs));
        for (index, property) in circuit.properties.iter().flatten().enumerate() {
            let of = if index == 0 { "checked" } else { "" };
            let _ = writeln!(text, "    {of:<7} {property}");
        }
        if let Some(connections) = &circuit.connections {
            text.push_str(&connections.text());
        }
    }
    if listing.scenarios.is_empty() {
        return text;
    }
    text.push_str("\nscenarios\n\n");
    for scenario in &listing.scenarios {
        let _ = writeln!(text, "  {}: {}", scenario.file, scenario.about);
        let _ = writeln!(text, "    waves of  {}", scenario.systems.join(", "));
    }
    text
}

/// Returns the keys with their full values, and those with other values in the small circuit.
fn keys(keys: &BTreeMap<String, Values>) -> [(&'static str, String); 2] {
    let list = |of: &dyn Fn(&Values) -> Option<String>| {
        let all = keys
            .iter()
            .filter_map(|(name, values)| Some(format!("{name}={}", of(values)?)));
        all.collect::<Vec<_>>().join(", ")
    };
    let unset = || "unset".to_owned();
    let full = list(&|values| Some(values.full.clone().unwrap_or_else(unset)));
    let small = list(&|values| {
        let differs = values.small != values.full;
        differs.then(|| values.small.clone().unwrap_or_else(unset))
    });
    [("keys", full), ("small", small)]
}

fn ports(ports: &[Port]) -> String {
    let ports = ports.iter().map(|port| port.signal.text());
    ports.collect::<Vec<_>>().join(", ")
}
