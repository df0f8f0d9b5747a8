//! The tables of the properties, with the way in which each is proved at full width.

use super::generated::cell;
use motion_rtl::check::{By, Concluded, Conclusion, Violation};
use motion_rtl::netlist::Claim;
use motion_rtl::registry::{Base, Entry, Pair};
use rayon::prelude::*;
use std::time::Duration;

/// Time for a property: that of `check --full`.
const LIMIT: Duration = Duration::from_secs(10);

/// Circuits whose proofs take more than a fifth of a second; unless they are asked for, the note is
/// believed.
const SLOW: &[&str] = &[
    "axis",
    "difference_column",
    "difference_history",
    "gray_receiver",
    "line_law",
    "mul_div",
    "pattern_generator",
    "pattern_memory",
    "phase_counter",
    "position_history",
    "pulse_interpolator",
    "ram_history",
    "ratio_logic",
    "scaler",
    "sequencer",
    "shifter",
    "table_lead",
    "target_data",
    "tracking_loop",
    "unit_law",
    "unwrapper",
    "vector_correction",
];

/// A circuit of the catalogue, some keys changed.
pub struct Subject {
    pub entry: &'static Entry,
    pub pairs: Vec<Pair>,
}

impl Subject {
    /// Name and changed keys, as a cell has them.
    pub fn cell(&self) -> String {
        let pairs = self.pairs.iter().map(|pair| format!(", `{pair}`"));
        format!("`{}`{}", self.entry.name, pairs.collect::<String>())
    }
}

impl From<&'static Entry> for Subject {
    fn from(entry: &'static Entry) -> Self {
        let pairs = Vec::new();
        Subject { entry, pairs }
    }
}

/// The properties of some circuits; those that stand there and take long as they stand.
pub fn table(subjects: &[Subject], stands: &str) -> String {
    let rows = subjects.par_iter().map(|subject| rows(subject, stands));
    let rows: Vec<_> = rows.flatten().collect();
    if rows.is_empty() {
        return String::new();
    }
    let head = "\nThe properties, and how `check NAME --full` proves them at the full widths \
                ([what the words mean](../proofs.md#full-width)):\n\n\
                | circuit | property | at full width by |\n|---|---|---|\n";
    head.to_owned() + &rows.concat()
}

/// Name of the row for the assumptions of the parts of a circuit.
const PARTS: &str = "what its parts assume";

/// The rows of a circuit: properties, what its parts assume, assumptions.
fn rows(subject: &Subject, stands: &str) -> Vec<String> {
    let entry = subject.entry;
    let full = entry.made(Base::Full, &subject.pairs);
    let full = full.expect("it takes these keys");
    let model = full.model().expect("it can be elaborated");
    let (module, parts) = (model.design().modules.split_last()).expect("there is one");
    let begin = |name: &str| format!("| {} | {} | ", subject.cell(), cell(name));
    let named = |of: fn(Claim) -> bool| {
        let all = module.assertions.iter().filter(move |one| of(one.claim));
        all.map(|one| one.name)
    };
    let mut wanted: Vec<_> = named(Claim::is_proved).collect();
    let is_slow = SLOW.contains(&entry.name) || wanted.is_empty();
    let mut of_parts = parts.iter().flat_map(|part| &part.assertions);
    wanted.extend(
        of_parts
            .any(|one| one.claim == Claim::Given)
            .then_some(PARTS),
    );
    let mut rows = Vec::new();
    let known = |name: &&str| stands.lines().find(|row| row.starts_with(&begin(name)));
    let known: Option<Vec<_>> = wanted.iter().map(known).collect();
    match known.filter(|_| is_slow) {
        Some(known) => rows.extend(known.into_iter().map(|row| format!("{row}\n"))),
        None if wanted.is_empty() => {}
        None => {
            let mut concluded = full.induct(LIMIT).expect("it has properties");
            concluded.retain(|one| !matches!(one.conclusion, Conclusion::Assumed));
            let (parts, own): (Vec<_>, Vec<_>) =
                concluded.into_iter().partition(|one| one.part.is_some());
            let row =
                |one: &Concluded<_>| format!("{}{} |\n", begin(&one.property), by(entry, one));
            rows.extend(own.iter().map(row));
            if !parts.is_empty() {
                let all = parts.iter().map(|one| by(entry, one));
                let open = all.filter(|by| by == "open").count();
                let by = match open {
                    0 => format!("{} proved", parts.len()),
                    open => format!("{} proved, {open} open", parts.len() - open),
                };
                rows.push(format!("{}{by} |\n", begin(PARTS)));
            }
        }
    }
    let given = named(|claim| claim == Claim::Given);
    rows.extend(given.map(|name| format!("{}assumed |\n", begin(name))));
    rows
}

/// How a property is proved.
fn by(entry: &Entry, concluded: &Concluded<Violation>) -> String {
    let helper = if concluded.is_helper {
        "; a helper"
    } else {
        ""
    };
    match &concluded.conclusion {
        // The clauses depend on the order of the search.
        Conclusion::Proof {
            by: By::Search { .. },
            ..
        } => format!("search{helper}"),
        Conclusion::Proof { by, .. } => format!("{by}{helper}"),
        Conclusion::Assumed => "assumed".to_owned(),
        // Which of both, and the widest width, depend on the time that a busy machine gives.
        Conclusion::Open { .. } | Conclusion::TooLarge => "open".to_owned(),
        Conclusion::Refuted(found) => panic!("{}: {found}", entry.name),
    }
}

/// A helper or an assumption that is renamed, and a property that has gone, make the note wrong: the
/// row is looked for by its whole text.
#[test]
fn a_row_counts_for_its_own_property_only() {
    let entry = motion_rtl::registry::find("unwrapper").expect("it is in the catalogue");
    let subject = entry.into();
    let rows = rows(&subject, "");
    assert!(!rows.is_empty());
    // Rows that stand there are believed, but not those of another name.
    let told = rows.concat().replace("every state", "hearsay");
    let again = self::rows(&subject, &told);
    assert_eq!(again.len(), rows.len());
    assert!(again.concat() == told, "{again:?}");
    let renamed = told.replacen("| `unwrapper` | ", "| `unwrapper` | not ", 1);
    assert_eq!(self::rows(&subject, &renamed), rows);
}
