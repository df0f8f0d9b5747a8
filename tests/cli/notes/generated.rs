//! The generated parts of the notes: what stands between
//! `<!-- begin generated: KIND NAME -->` and `<!-- end generated -->`.
//!
//! `UPDATE_NOTES=1 cargo test --release --test cli notes` writes them anew.

use super::full_width::Subject;
use super::{
    Note, axes, blends, connections, expect_none, full_width, miscounts, notes, rotations, small,
    states,
};
use motion_rtl::circuits::pulse_interpolator::counts;
use motion_rtl::hdl::{Declaration, MemoryDeclaration};
use motion_rtl::netlist::{Format, Kind, Role};
use motion_rtl::registry::{Base, CATALOGUE, Entry, Pair, ProofSearch, Verdict, find};
use motion_rtl::scenario::Runnable;
use motion_rtl::settings::rows;
use rayon::prelude::*;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::fs;

/// Proofs of more transitions take long; unless they are asked for, the note is believed.
const LONG: u64 = 1_000_000;

const BEGIN: &str = "<!-- begin generated: ";
const END: &str = "<!-- end generated -->";

/// The text between the markers for what the first of them names, in a note in which `stands` is
/// what it was; `long`: with proofs that take long.
fn make(what: &str, note: &str, stands: &str, long: bool) -> Result<String, String> {
    let (kind, name) = what.split_once(' ').unwrap_or((what, ""));
    match (kind, find(name)) {
        ("signals", Some(entry)) => Ok(signals(entry)),
        ("charts", Some(entry)) => small::sentence(entry, note),
        ("connections", Some(entry)) => Ok(connections::table(entry)),
        ("blocks", None) => Ok(blocks(name)),
        ("proofs" | "variants", None) => {
            let stands = if long { "" } else { stands };
            let subjects = match kind {
                "proofs" => of(name).map(Subject::from).collect(),
                _ => variants(name)?,
            };
            Ok(proofs(&subjects, stands) + &full_width::table(&subjects, stands))
        }
        ("keys", _) => keys(name),
        ("literal", None) => Ok(literal()),
        ("axes", None) => Ok(axes::table()),
        ("miscounts", None) => Ok(miscounts::table()),
        ("vectors", None) => Ok(vectors()),
        ("counts", None) => Ok(offers()),
        ("rotation_errors", None) => Ok(rotations::errors()),
        ("blend_errors", None) => Ok(blends::errors()),
        ("operations", None) => Ok(rotations::operations()),
        _ => Err(format!("nothing is called `{what}`")),
    }
}

/// The note with its generated parts made anew. A mark is a line of its own, outside code blocks.
fn regenerate(text: &str, long: bool) -> Result<String, String> {
    let mut fresh = String::new();
    let mut fence: Option<usize> = None;
    let mut lines = text.lines().zip(1..);
    while let Some((line, number)) = lines.next() {
        fresh += line;
        fresh.push('\n');
        let marks = line.len() - line.trim_start_matches('`').len();
        match fence {
            Some(open) if marks >= open && marks == line.len() => fence = None,
            None if marks >= 3 => fence = Some(marks),
            _ => {}
        }
        let what = line.strip_prefix(BEGIN).filter(|_| fence.is_none());
        if let Some(what) = what.and_then(|what| what.strip_suffix(" -->")) {
            let mut stands = String::new();
            loop {
                match lines.next() {
                    Some((line, _)) if line == END => break,
                    Some((line, _)) => stands = stands + line + "\n",
                    None => return Err(format!("{number}: `{what}` has no `{END}`")),
                }
            }
            fresh +=
                &make(what, text, &stands, long).map_err(|error| format!("{number}: {error}"))?;
            fresh += END;
            fresh.push('\n');
        }
    }
    Ok(fresh)
}

#[test]
fn states_that_are_never_held_are_those_that_nothing_makes() {
    let of = |name, register, names| states::unreached(find(name).unwrap(), register, names);
    assert_eq!(of("mul_div", "state", 3), [3]);
    assert_eq!(of("trapezoid", "state", 7), [7]);
    assert_eq!(of("blend_weight", "pass", 3), [3]);
    assert_eq!(of("sequencer", "state", 6), [6, 7]);
    assert_eq!(of("step_sequencer", "state", 7), [7]);
    // A state that something makes, and a number that comes from outside.
    assert_eq!(of("mul_div", "state", 2), [0; 0]);
    assert_eq!(of("record_sequencer", "kind", 3), [0; 0]);
}

#[test]
fn generated_parts_are_those_of_the_code() {
    are_those_of_the_code(false);
}

#[test]
#[ignore = "takes a minute"]
fn long_proofs_are_those_of_the_code_too() {
    are_those_of_the_code(true);
}

fn are_those_of_the_code(long: bool) {
    let update = std::env::var_os("UPDATE_NOTES").is_some_and(|value| value == "1");
    let long = long || update;
    let wrong = notes()
        .into_par_iter()
        .filter_map(|note| match regenerate(&note.text, long) {
            Err(error) => Some(format!("{}:{error}", note.name)),
            Ok(fresh) if fresh == note.text => None,
            Ok(fresh) if update => {
                fs::write(&note.path, fresh).expect("a note can be written");
                None
            }
            Ok(fresh) => {
                let mut lines = fresh.lines().zip(note.text.lines()).zip(1..);
                let other = lines.find(|((fresh, old), _)| fresh != old);
                let (expected, line) = other.map_or(("", 0), |((fresh, _), line)| (fresh, line));
                Some(format!(
                    "{}:{line}: not what the code says:\n  {expected}\n  \
                     UPDATE_NOTES=1 cargo test --release --test cli notes writes it anew",
                    note.name
                ))
            }
        });
    expect_none(&wrong.collect::<Vec<_>>());
}

/// The keys of a job's scenarios.
fn keys(name: &str) -> Result<String, String> {
    let job = Runnable::ALL.into_iter().find(|job| job.name() == name);
    let (keys, defaults) = job.ok_or(format!("no job is called {name}"))?.keys();
    let mut text = String::from(
        "| key | type | unit | default | range | meaning |\n|---|---|---|---|---|---|\n",
    );
    for row in rows(&keys, &defaults) {
        let (key, kind, unit, default) = (row.key, row.kind, row.unit, row.default);
        let (range, about) = (row.range, row.about);
        let _ = writeln!(
            text,
            "| `{key}` | {kind} | {unit} | {default} | {range} | {about} |"
        );
    }
    Ok(text)
}

/// The circuits of a patent.
fn of(patent: &str) -> impl Iterator<Item = &'static Entry> {
    CATALOGUE
        .iter()
        .filter(move |entry| entry.source.starts_with(patent))
}

/// The circuits of a patent, with what they do.
fn blocks(patent: &str) -> String {
    let mut text =
        String::from("| circuit | source | what it does | widths |\n|---|---|---|---|\n");
    let notes = notes();
    for entry in of(patent) {
        let (name, source, about) = (entry.name, entry.source, entry.about);
        let (page, widths) = (page(&notes, name), widths(entry, Base::Full));
        let _ = writeln!(
            text,
            "| [`{name}`]({page}) | {source} | {about} | {widths} |"
        );
    }
    text
}

/// The page with a circuit's signals, as a link from another page of its folder or beside it.
fn page(notes: &[Note], name: &str) -> String {
    let mark = format!("\n{BEGIN}signals {name} -->\n");
    let page = notes.iter().find(|note| note.text.contains(&mark));
    let page = page.unwrap_or_else(|| panic!("no page has the signals of {name}"));
    page.name.replacen("rtl_notes", "..", 1)
}

/// The most sizes that are listed; those of a circuit with more are those of its parts.
const LISTED: usize = 20;

/// The sizes of a circuit by their keys; numbers of axes and of stages are no widths.
fn widths(entry: &Entry, base: Base) -> String {
    let sizes = entry.sizes(base, &[]);
    if sizes.len() > LISTED {
        return String::new();
    }
    let widths = entry.widths(base, &[]);
    let sizes = sizes
        .into_iter()
        .map(|size| match (&size, widths.contains(&size)) {
            ((key, bits), true) => format!("{key} = {bits} bits"),
            ((key, count), false) => format!("{key} = {count}"),
        });
    sizes.collect::<Vec<_>>().join(", ")
}

/// What a register holds in tick 0; other signals have no such value.
fn power_on(leaf: &Declaration) -> String {
    let shape = leaf.shape;
    match (leaf.role, leaf.field.format) {
        (Role::Input | Role::Net, _) => "–".to_owned(),
        (Role::Register, Format::States(names)) => names[leaf.power_on as usize].to_owned(),
        (Role::Register, _) if shape.kind == Kind::Signed => {
            let unused = 64 - shape.width;
            ((leaf.power_on << unused) as i64 >> unused).to_string()
        }
        (Role::Register, _) => leaf.power_on.to_string(),
    }
}

/// A circuit's own signals, those of its blocks left out.
fn signals(entry: &Entry) -> String {
    let mut text = match widths(entry, Base::Full) {
        widths if widths.is_empty() => widths,
        widths => format!("Widths: {widths}.\n\n"),
    };
    text += "| signal | bits | role | power-on | meaning |\n|---|---|---|---|---|\n";
    let declarations = entry.full().declarations().expect("a netlist");
    let names: HashMap<_, _> = declarations.own().into_iter().collect();
    let mut memories = declarations
        .memories
        .iter()
        .filter(|memory| memory.scopes.len() == 1)
        .peekable();
    for (index, leaf) in declarations.leaves.iter().enumerate() {
        if let Some(memory) = memories.next_if(|memory| memory.first == index) {
            text += &memory_row(memory);
        }
        let Some(name) = names.get(&index) else {
            continue;
        };
        let field = leaf.field;
        let bits = match leaf.shape.kind {
            Kind::Signed => format!("{}, signed", leaf.shape.width),
            Kind::Bit | Kind::Unsigned => leaf.shape.width.to_string(),
        };
        let role = match (leaf.role, field.public) {
            (Role::Input, _) => "in",
            (Role::Register, true) => "register, out",
            (Role::Register, false) => "register",
            (Role::Net, true) => "net, out",
            (Role::Net, false) => "net",
        };
        let states = match field.format {
            Format::States(names) => {
                let nameless = states::unreached(entry, name, names.len());
                let nameless: Vec<_> = nameless.iter().map(u64::to_string).collect();
                let nameless = match nameless.is_empty() {
                    true => String::new(),
                    false => format!("; never {}", nameless.join(" or ")),
                };
                format!(" States: {}{nameless}.", names.join(", "))
            }
            _ => String::new(),
        };
        let doc = cell(&field.plain_doc());
        let power_on = power_on(leaf);
        let _ = writeln!(
            text,
            "| `{name}` | {bits} | {role} | {power_on} | {doc}{states} |"
        );
    }
    text
}

/// A doc comment as a cell of a table.
pub fn cell(doc: &str) -> String {
    doc.replace('|', "\\|")
}

fn memory_row(memory: &MemoryDeclaration) -> String {
    let MemoryDeclaration {
        name, words, width, ..
    } = memory;
    let doc = cell(&memory.field.plain_doc());
    format!("| `{name}` | {words} × {width} | memory | contents | {doc} |\n")
}

/// Variants of a circuit: `NAME KEY=VALUE KEY=VALUE`, one for each pair.
fn variants(what: &str) -> Result<Vec<Subject>, String> {
    let (name, pairs) = what.split_once(' ').unwrap_or((what, ""));
    let entry = find(name).ok_or_else(|| format!("no circuit is called `{name}`"))?;
    let subject = |pair: &str| {
        let pairs = vec![pair.parse().map_err(|error| format!("{pair}: {error}"))?];
        Ok(Subject { entry, pairs })
    };
    pairs.split(' ').map(subject).collect()
}

/// The proof of every circuit that has one, at its proof width; those that stand there and take long
/// as they stand.
fn proofs(subjects: &[Subject], stands: &str) -> String {
    let mut text = String::from(
        "| circuit | widths | states | transitions | depth |\n|---|---|---|---|---|\n",
    );
    let proved = subjects.par_iter().filter(|subject| subject.entry.proved);
    let rows = proved.map(|subject| {
        let circuit = subject.entry.proof(&subject.pairs);
        let circuit = circuit.expect("it is made for its proof");
        let begin = format!(
            "| {} | {} | ",
            subject.cell(),
            widths(subject.entry, Base::Small)
        );
        if let Some(row) = long_proof(stands, &begin) {
            return format!("{row}\n");
        }
        let verdict = circuit.prove(&ProofSearch::default(), &mut |_| {});
        let Ok(Verdict::Proved(proof)) = verdict else {
            panic!("{} is not proved: {verdict:?}", subject.cell());
        };
        format!(
            "{begin}{} | {} | {} |\n",
            thousands(proof.states),
            thousands(proof.transitions),
            proof.depth,
        )
    });
    text.extend(rows.collect::<Vec<_>>());
    text
}

/// The row that begins so, if there is one and its proof takes long.
fn long_proof<'s>(stands: &'s str, begin: &str) -> Option<&'s str> {
    let row = stands.lines().find(|row| row.starts_with(begin))?;
    let cells: Vec<_> = row.split('|').collect();
    let transitions: u64 = cells.get(4)?.trim().replace(',', "").parse().ok()?;
    (transitions > LONG).then_some(row)
}

/// What breaks first in the literal variant.
fn literal() -> String {
    let mut text = String::from("| circuit | widths | what breaks first |\n|---|---|---|\n");
    for name in ["pulse_generator", "axis", "unit_law"] {
        let entry = find(name).expect("it is in the catalogue");
        let width = widths(entry, Base::Small);
        let literal = [Pair::new("variant", "literal")];
        let circuit = entry.proof(&literal).expect("it has a literal variant");
        let verdict = circuit.prove(&ProofSearch::default(), &mut |_| {});
        let Ok(Verdict::Broken(violation)) = verdict else {
            panic!("the literal {name} is not broken: {verdict:?}");
        };
        let report = violation.to_string();
        let first = report.lines().next().unwrap_or_default().trim();
        let _ = writeln!(text, "| `{name}` | {width} | {first} |");
    }
    text
}

/// Counts of a unit time of 1000 ticks.
fn vectors() -> String {
    let mut text = String::from("| n | pulses in T = 1000 |\n|---|---|\n");
    for n in [0, 1, 2, 3, 10, 20, 100, 333, 334, 999, 1000, 65_535] {
        let _ = writeln!(text, "| {n} | {} |", counts::pulses(n, 1000));
    }
    text
}

/// How many counts a unit time offers, and up to which the recipe is exact.
fn offers() -> String {
    let mut text = String::from(
        "| T | different counts, 0 among them | 1.4·√T | first impossible | most pulses | recipe \
         exact up to |\n|---|---|---|---|---|---|\n",
    );
    for period in [16, 64, 256, 1000, 4096, 10_000, 100_000] {
        let first = (0..).find(|&count| !counts::attainable(count, period));
        let exact = (1..).take_while(|&count| {
            let half_period = counts::recipe(count, period);
            half_period.is_some_and(|n| counts::pulses(n, period) == count)
        });
        let _ = writeln!(
            text,
            "| {period} | {} | {:.1} | {} | {} | {} |",
            counts::attainable_count(period),
            1.4 * f64::from(period).sqrt(),
            first.unwrap_or_default(),
            counts::pulses(1, period),
            exact.last().unwrap_or_default(),
        );
    }
    text
}

fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}
