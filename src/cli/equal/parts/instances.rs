//! The instances in the top module of a design, as Yosys writes it in JSON.

use crate::cli::equal::netlist::Bit;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// An instance of a module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Instance {
    pub name: String,
    /// Name of its module in Yosys, which has the values of parameters.
    pub module: String,
    /// Its ports that are connected to clock and reset of the design.
    pub clock: Option<String>,
    pub reset: Option<String>,
}

#[derive(Deserialize)]
struct File {
    modules: BTreeMap<String, Module>,
}

#[derive(Deserialize)]
struct Module {
    #[serde(default)]
    attributes: BTreeMap<String, Value>,
    ports: BTreeMap<String, Port>,
    cells: BTreeMap<String, Cell>,
}

#[derive(Deserialize)]
struct Port {
    bits: Vec<Bit>,
}

#[derive(Deserialize)]
struct Cell {
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    connections: BTreeMap<String, Vec<Bit>>,
}

/// Reads the instances of the top module of a file.
///
/// # Errors
/// Returns the problem: the file cannot be read, or has no top module.
pub fn read(text: &str, clock: &str, reset: Option<&str>) -> Result<Vec<Instance>, String> {
    let file: File = serde_json::from_str(text).map_err(|error| error.to_string())?;
    let mut modules = file.modules.values();
    let top = modules.find(|module| module.attributes.contains_key("top"));
    let top = top.ok_or("there is no top module")?;
    let instances = top
        .cells
        .iter()
        .filter(|(_, cell)| file.modules.contains_key(&cell.kind));
    let instances = instances.map(|(name, cell)| {
        let connected = |to: Option<&str>| {
            let to = &top.ports.get(to?)?.bits;
            let mut ports = cell.connections.iter();
            ports
                .find(|(_, bits)| *bits == to)
                .map(|(port, _)| port.clone())
        };
        Instance {
            name: name.clone(),
            module: cell.kind.clone(),
            clock: connected(Some(clock)),
            reset: connected(reset),
        }
    });
    Ok(instances.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instances_of_modules_are_listed_with_their_clocks() {
        let text = r#"{"modules": {
            "top": {"attributes": {"top": "1"},
                    "ports": {"ck": {"bits": [2]}, "rst": {"bits": [3]}},
                    "cells": {"a": {"type": "$paramod\\part\\W=4",
                                    "connections": {"c": [2], "r": [3], "d": [4, 5]}},
                              "b": {"type": "part", "connections": {"c": [4], "r": [3]}},
                              "$1": {"type": "$add", "connections": {}}}},
            "$paramod\\part\\W=4": {"ports": {}, "cells": {}},
            "part": {"ports": {}, "cells": {}}}}"#;
        let instances = read(text, "ck", Some("rst")).unwrap();
        let of = |name: &str, module: &str, clock: Option<&str>| Instance {
            name: name.to_owned(),
            module: module.to_owned(),
            clock: clock.map(str::to_owned),
            reset: Some("r".to_owned()),
        };
        assert_eq!(
            instances,
            [
                of("a", "$paramod\\part\\W=4", Some("c")),
                of("b", "part", None)
            ]
        );
        assert_eq!(read(text, "ck", None).unwrap()[0].reset, None);
        assert!(read(r#"{"modules": {}}"#, "ck", None).is_err());
    }
}
