//! The tables of connections: of what parts a circuit is made, and what drives their ports in.

use super::{expect_none, notes};
use motion_rtl::netlist::{Kind, Role, Shape};
use motion_rtl::registry::{CATALOGUE, Entry, find};
use motion_rtl::verilog::{Connection, Connections, Part};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// What a circuit is made of, at its own widths.
fn connections(entry: &Entry) -> Connections {
    entry.full().connections().expect("a netlist")
}

/// The table of a circuit.
pub fn table(entry: &Entry) -> String {
    let connections = connections(entry);
    let ports = ports(entry, |role, _| role == Role::Input);
    let mut text = String::from("| part | circuit | port | driven by |\n|---|---|---|---|\n");
    let mut left = &connections.parts[..];
    while let Some(first) = left.first() {
        let mut counts = (2..=left.len()).rev();
        let alike = counts.find_map(|count| Alike::of(&left[..count]));
        let alike = alike.unwrap_or_else(|| Alike::alone(first));
        left = &left[alike.parts.len()..];
        text += &alike.rows(&ports);
    }
    let own = [
        ("out", &connections.outputs),
        ("net", &connections.nets),
        ("register, at the edge", &connections.registers),
    ];
    for (role, own) in own {
        let driven = own
            .iter()
            .map(|Connection { name, driver, .. }| (&name[..], Some(driver.clone()), code(driver)));
        for (names, driver) in grouped(&driven.collect::<Vec<_>>(), &BTreeMap::new()) {
            let _ = writeln!(text, "| – | – | {names}, {role} | {driver} |");
        }
    }
    text
}

/// Ports of a circuit and their bits.
fn ports(entry: &Entry, wanted: impl Fn(Role, bool) -> bool) -> BTreeMap<String, usize> {
    let declarations = entry.declarations();
    let own = declarations.own().into_iter();
    let own = own.map(|(index, name)| (name, &declarations.leaves[index]));
    let own = own.filter(|(_, leaf)| wanted(leaf.role, leaf.field.public));
    own.map(|(name, leaf)| (name, leaf.shape.width)).collect()
}

/// In a cell of a table, where a bar would end it.
fn code(text: &str) -> String {
    format!("`{}`", text.replace('|', "\\|"))
}

/// What drives a port, if it is a signal of the same name: what has that signal, and nothing for
/// the circuit around.
fn same_name<'d>(driver: &'d str, port: &str) -> Option<&'d str> {
    let around = driver.strip_suffix(port)?;
    let is_path = |character: char| character.is_ascii_alphanumeric() || "_.".contains(character);
    match around.strip_suffix('.') {
        Some(part) => part.chars().all(is_path).then_some(part),
        None => around.is_empty().then_some(""),
    }
}

/// Rows of signals: name, driver if there is one for all parts, and what is said of it. Those that
/// are driven by signals of their names share a row.
fn grouped(
    driven: &[(&str, Option<String>, String)],
    around: &BTreeMap<String, usize>,
) -> Vec<(String, String)> {
    let source = |index: usize| {
        let (name, driver, _) = &driven[index];
        let source = same_name(driver.as_ref()?, name)?;
        (!source.is_empty() || around.contains_key(*name)).then_some(source)
    };
    let mut rows = Vec::new();
    for (index, (_, _, said)) in driven.iter().enumerate() {
        let together: Vec<usize> = match source(index) {
            None => vec![index],
            here => (0..driven.len())
                .filter(|other| source(*other) == here)
                .collect(),
        };
        if together[0] < index {
            continue;
        }
        let names = together.iter().map(|index| code(driven[*index].0));
        let names = names.collect::<Vec<_>>().join(", ");
        rows.push(match source(index).filter(|_| together.len() > 1) {
            Some("") => (names, "input ports of the same names".to_owned()),
            Some(source) => (
                names,
                format!("signals of the same names in {}", code(source)),
            ),
            None => (names, said.clone()),
        });
    }
    rows
}

/// Parts that differ in little more than a word of their names.
struct Alike<'c> {
    parts: &'c [Part],
    /// That word of each; none where there is only one.
    words: Vec<&'c str>,
}

impl<'c> Alike<'c> {
    fn alone(part: &'c Part) -> Self {
        Alike {
            parts: std::slice::from_ref(part),
            words: Vec::new(),
        }
    }

    /// These parts, if they are alike: the same ports, most of them driven alike.
    fn of(parts: &'c [Part]) -> Option<Self> {
        let [first, others @ ..] = parts else {
            return None;
        };
        let ports = |part: &Part| -> Vec<_> {
            let inputs = part.inputs.iter();
            let inputs = inputs.map(|input| (input.name.clone(), input.shape));
            inputs.chain(part.outputs.iter().cloned()).collect()
        };
        let same = |other: &Part| other.circuit == first.circuit && ports(other) == ports(first);
        if !others.iter().all(same) {
            return None;
        }
        let names = parts.iter().map(|part| part.name.split('_').collect());
        let names: Vec<Vec<&str>> = names.collect();
        let length = names[0].len();
        if names.iter().any(|name| name.len() != length) {
            return None;
        }
        let differs = |place: &usize| names.iter().any(|name| name[*place] != names[0][*place]);
        let places: Vec<usize> = (0..length).filter(differs).collect();
        let [place] = places[..] else {
            return None;
        };
        let alike = Alike {
            parts,
            words: names.iter().map(|name| name[place]).collect(),
        };
        let count = first.inputs.len();
        let common = (0..count).filter(|port| alike.driver(*port).is_some());
        (common.count() * 2 >= count).then_some(alike)
    }

    /// What these are all, with X for the word that they differ in.
    fn common(&self, texts: &[&str]) -> Option<String> {
        let words: Vec<Vec<&str>> = texts.iter().map(|text| words(text)).collect();
        let length = words[0].len();
        if words.iter().any(|other| other.len() != length) {
            return None;
        }
        let word = |place: usize| {
            let here: Vec<&str> = words.iter().map(|words| words[place]).collect();
            match here.iter().all(|word| *word == here[0]) {
                true => Some(here[0]),
                false => (here == self.words).then_some("X"),
            }
        };
        (0..length).map(word).collect()
    }

    /// What drives a port of all of them.
    fn driver(&self, port: usize) -> Option<String> {
        let drivers = self.parts.iter();
        let drivers = drivers.map(|part| &part.inputs[port].driver[..]);
        self.common(&drivers.collect::<Vec<_>>())
    }

    /// What is said of all, or of each its own.
    fn said(&self, common: Option<String>, own: impl Fn(&Part) -> String) -> String {
        common.unwrap_or_else(|| {
            let each = self.words.iter().zip(self.parts);
            let each = each.map(|(word, part)| format!("{word}: {}", own(part)));
            each.collect::<Vec<_>>().join("; ")
        })
    }

    /// Ports and what drives them; `around` are the ports in of the circuit around.
    fn drivers(&self, around: &BTreeMap<String, usize>) -> Vec<(String, String)> {
        let inputs = self.parts[0].inputs.iter().enumerate();
        let driven = inputs.map(|(port, input)| {
            let driver = self.driver(port);
            let own = |part: &Part| code(&part.inputs[port].driver);
            let said = self.said(driver.as_deref().map(code), own);
            (&input.name[..], driver, said)
        });
        grouped(&driven.collect::<Vec<_>>(), around)
    }

    /// The numbers that they have, unless they are those that their own tables show.
    fn parameters(&self) -> Option<String> {
        let entry = find(&self.parts[0].circuit).expect("a part is in the catalogue");
        let list = |part: &Part| {
            let numbers = part.parameters.iter();
            let numbers = numbers.map(|(name, number)| format!("`{name}` {number}"));
            numbers.collect::<Vec<_>>().join(", ")
        };
        let shown: Vec<(String, u64)> = match self.parts.iter().all(|p| p.parameters.is_empty()) {
            true => Vec::new(),
            false => {
                let inside = connections(entry).parts.into_iter();
                let numbers = inside.flat_map(|part| {
                    let numbers = part.parameters.into_iter();
                    numbers.map(move |(name, number)| (format!("{}.{name}", part.name), number))
                });
                numbers.collect()
            }
        };
        let mut parameters = self.parts.iter().flat_map(|part| &part.parameters);
        let known = parameters.all(|parameter| shown.contains(parameter));
        let first = &self.parts[0];
        let same = self
            .parts
            .iter()
            .all(|part| part.parameters == first.parameters);
        (!known).then(|| self.said(same.then(|| list(first)), list))
    }

    /// The rows of the table.
    fn rows(&self, around: &BTreeMap<String, usize>) -> String {
        let mut rows = self.drivers(around);
        let parameters = self
            .parameters()
            .map(|numbers| ("parameters".to_owned(), numbers));
        rows.extend(parameters);
        if rows.is_empty() {
            // It has no ports in.
            rows.push(("–".to_owned(), "–".to_owned()));
        }
        let names: Vec<&str> = self.parts.iter().map(|part| &part.name[..]).collect();
        let name = self.common(&names).unwrap_or_default();
        let part = match self.words.is_empty() {
            true => format!("`{name}`"),
            false => format!("`{name}`, X: {}", self.words.join(", ")),
        };
        let circuit = format!("`{}`{}", self.parts[0].circuit, other_ports(&self.parts[0]));
        let mut text = String::new();
        for (index, (port, driver)) in rows.iter().enumerate() {
            let _ = match index {
                0 => writeln!(text, "| {part} | {circuit} | {port} | {driver} |"),
                _ => writeln!(text, "| | | {port} | {driver} |"),
            };
        }
        text
    }
}

/// A text as words and what stands between them.
fn words(text: &str) -> Vec<&str> {
    let is_word = |character: char| character.is_ascii_alphanumeric();
    let mut words = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let end = rest.find(|next| is_word(next) != is_word(first));
        let (word, after) = rest.split_at(end.unwrap_or(rest.len()));
        words.push(word);
        rest = after;
    }
    words
}

/// In what the ports of a part are other than those in the table of the circuit's own signals.
fn other_ports(part: &Part) -> String {
    let entry = find(&part.circuit).expect("a part is in the catalogue");
    let table = ports(entry, |role, public| role == Role::Input || public);
    let inputs = part.inputs.iter().map(|input| (&input.name, input.shape));
    let outputs = part.outputs.iter().map(|(name, shape)| (name, *shape));
    let here: BTreeMap<_, _> = inputs.chain(outputs).collect();
    let (known, new): (Vec<_>, Vec<_>) = here
        .iter()
        .partition(|(name, _)| table.contains_key(**name));
    let wider = known
        .iter()
        .filter(|(name, shape)| table[**name] != shape.width);
    let bits = |(name, shape): &(&&String, &Shape)| format!("`{name}` {}", shape.width);
    let lists = [
        ("bits: ", wider.map(bits).collect::<Vec<_>>()),
        ("also ", new.iter().map(bits).collect()),
        (
            "no ",
            table
                .keys()
                .filter(|name| !here.contains_key(name))
                .map(|name| code(name))
                .collect(),
        ),
    ];
    let lists = lists.iter().filter(|(_, list)| !list.is_empty());
    let lists: Vec<String> = lists
        .map(|(what, list)| format!("{what}{}", list.join(", ")))
        .collect();
    match lists.is_empty() {
        true => String::new(),
        false => format!(" ({})", lists.join("; ")),
    }
}

/// Of every circuit that has parts there is a table, on the page that has its signals.
#[test]
fn every_composite_has_a_table_of_its_connections() {
    let notes = notes();
    let wrong = CATALOGUE.par_iter().filter_map(|entry| {
        let marker = |kind| format!("\n<!-- begin generated: {kind} {} -->\n", entry.name);
        let mut own = notes
            .iter()
            .filter(|note| note.text.contains(&marker("signals")));
        let shown = own.any(|note| note.text.contains(&marker("connections")));
        let expected = !connections(entry).parts.is_empty();
        let what = if expected {
            "wants"
        } else {
            "has no parts for"
        };
        (shown != expected).then(|| {
            format!(
                "{}: its page {what} {}",
                entry.name,
                marker("connections").trim()
            )
        })
    });
    expect_none(&wrong.collect::<Vec<_>>());
}

/// A part of a circuit that the catalogue does not need to know.
fn part(name: &str, drivers: [&str; 3]) -> Part {
    let shape = Shape {
        kind: Kind::Bit,
        width: 1,
    };
    let inputs = ["load", "data", "step"].iter().zip(drivers);
    let inputs = inputs.map(|(name, driver)| Connection {
        name: (*name).to_owned(),
        shape,
        driver: driver.to_owned(),
    });
    Part {
        name: name.to_owned(),
        circuit: "row".to_owned(),
        parameters: Vec::new(),
        inputs: inputs.collect(),
        outputs: Vec::new(),
    }
}

#[test]
fn parts_that_differ_in_a_word_share_rows() {
    let around = BTreeMap::from([("load".to_owned(), 1)]);
    let rows = |parts: &[Part]| Alike::of(parts).map(|alike| alike.drivers(&around));
    let row = |ports: &str, driver: &str| (ports.to_owned(), driver.to_owned());
    let x = part("row_x", ["load", "given ? given_x : point.x", "x_max"]);
    // The word in the driver is that in the name, whatever else is the same.
    let y = part("row_y", ["load", "given ? given_y : point.y", "x_max"]);
    assert_eq!(
        rows(&[x.clone(), y]),
        Some(vec![
            row("`load`", "`load`"),
            row("`data`", "`given ? given_X : point.X`"),
            row("`step`", "`x_max`"),
        ])
    );
    // What is each one's own is said of each.
    let y = part("row_y", ["load", "given ? given_y : point.z", "x_max"]);
    let own = "x: `given ? given_x : point.x`; y: `given ? given_y : point.z`";
    assert_eq!(rows(&[x.clone(), y]).unwrap()[1], row("`data`", own));
    let y = part("row_y", ["load", "1'b0", "y_max"]);
    assert_eq!(
        rows(&[x.clone(), y]).map(|rows| rows[2].1.clone()),
        Some("`X_max`".into())
    );
    // Most of it is each one's own.
    let y = part("row_y", ["load", "1'b0", "1'b1"]);
    assert_eq!(rows(&[x.clone(), y]), None);
    // Two words differ.
    assert_eq!(rows(&[x, part("column_y", ["load"; 3])]), None);
}

#[test]
fn ports_of_the_same_names_share_a_row() {
    let around = BTreeMap::from([("load".to_owned(), 1), ("step".to_owned(), 1)]);
    let rows = |drivers| Alike::alone(&part("row", drivers)).drivers(&around);
    let row = |ports: &str, driver: &str| (ports.to_owned(), driver.to_owned());
    assert_eq!(
        rows(["load", "memory.data", "step"]),
        [
            row("`load`, `step`", "input ports of the same names"),
            row("`data`", "`memory.data`")
        ]
    );
    assert_eq!(
        rows(["memory.load", "memory.data", "!step"]),
        [
            row("`load`, `data`", "signals of the same names in `memory`"),
            row("`step`", "`!step`")
        ]
    );
}
