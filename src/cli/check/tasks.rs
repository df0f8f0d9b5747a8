//! Proofs and sweeps to run, in the order of the table.

use super::report::{Asked, ITS_BLOCKS, Kind, TOO_WIDE};
use super::shard::Shard;
use crate::cli::Failure;
use crate::cli::chosen::{self, entries, matching};
use crate::cli::named;
use motion_rtl::nearest::did_you_mean;
use motion_rtl::registry::{AnySweep, Entry, Pair};

/// The most cases of a sweep.
const MOST_CASES: u64 = 1 << 32;

/// A proof or a sweep of a circuit with changed keys.
#[derive(Debug, Clone)]
pub struct Task {
    pub entry: &'static Entry,
    pub pairs: Vec<Pair>,
    pub kind: Kind,
    /// Text that its properties contain; all if there is none.
    pub property: Option<String>,
}

impl Task {
    /// Returns the properties that are proved, or the statement of the law.
    fn properties(&self) -> Vec<String> {
        let proof = || Some(self.entry.proof(&self.pairs).ok()?.invariants());
        let law = || Some(vec![self.entry.law(&self.pairs).ok()?.law().to_owned()]);
        let properties = match self.kind {
            Kind::Proof => proof(),
            Kind::Sweep => law(),
        };
        properties.unwrap_or_default()
    }

    /// Returns those of the properties that are asked for.
    pub fn asked(&self, properties: Vec<String>) -> Vec<String> {
        let Some(text) = &self.property else {
            return properties;
        };
        let all = properties.iter().map(String::as_str);
        let asked = matching(text, all).into_iter();
        asked.map(|index| properties[index].clone()).collect()
    }

    /// Name of the circuit.
    pub fn circuit(&self) -> &'static str {
        self.entry.name
    }
}

/// Returns the requested tasks, and the circuits that can be neither proved nor swept.
pub fn of(asked: &Asked) -> Result<(Vec<Task>, Vec<String>), Failure> {
    let (mut tasks, mut others) = (Vec::new(), Vec::new());
    if asked.circuits.is_empty() && !asked.changes.is_empty() {
        return Err(chosen::no_circuit(&asked.changes, "check"));
    }
    // Each circuit comes once: the rows of parts are matched by circuit.
    for entry in entries(&asked.circuits)? {
        let kinds = [(entry.proved, Kind::Proof), (entry.swept, Kind::Sweep)];
        let kinds = kinds.into_iter().filter(|(has, _)| *has);
        let before = tasks.len();
        for (_, kind) in kinds {
            let pairs = asked.changes.pairs(entry)?;
            tasks.push(Task {
                entry,
                pairs,
                kind,
                property: asked.property.clone(),
            });
        }
        if tasks.len() == before {
            others.push(entry.name.to_owned());
        }
    }
    if tasks.is_empty()
        && let Some(name) = others.first()
    {
        return Err(Failure::Argument {
            field: "CIRCUIT",
            problem: format!("{name} {TOO_WIDE}"),
            allowed: ITS_BLOCKS.into(),
        });
    }
    for task in &tasks {
        made(task, asked.circuits.len() < 2)?;
    }
    if let Some(text) = &asked.property {
        tasks = with_property(tasks, text, &asked.circuits)?;
        others.clear();
    }
    Ok((tasks, others))
}

/// Returns the tasks that have a property of this text. Each circuit that is named has one.
fn with_property(tasks: Vec<Task>, text: &str, circuits: &[String]) -> Result<Vec<Task>, Failure> {
    let (mut having, mut without) = (Vec::new(), Vec::new());
    for task in tasks {
        let properties = task.properties();
        match task.asked(properties.clone()).is_empty() {
            true => without.push((task, properties)),
            false => having.push(task),
        }
    }
    let lacks = |circuit: &str| having.iter().all(|task| task.circuit() != circuit);
    let mut named_without = without.iter().filter(|(task, _)| lacks(task.circuit()));
    let refused = |problem: String, allowed: String| {
        Err(Failure::Argument {
            field: "--property",
            problem,
            allowed,
        })
    };
    let text = named(text);
    match named_without.next() {
        Some((task, _)) if !circuits.is_empty() => {
            let circuit = task.circuit();
            let own = without.iter().filter(|(task, _)| task.circuit() == circuit);
            let own: Vec<_> = own.flat_map(|(_, properties)| properties).collect();
            let near = did_you_mean(text, own.iter().map(|property| property.as_str()));
            let own: Vec<_> = own.iter().map(|property| property.as_str()).collect();
            refused(
                format!("no property of {circuit} contains {text}{near}"),
                own.join("; "),
            )
        }
        Some(_) if having.is_empty() => refused(
            format!("no property of any circuit contains {text}"),
            "a part of a property's text; `motion-rtl list NAME` shows them".to_owned(),
        ),
        _ => Ok(having),
    }
}

/// Returns the tasks of a part of the work: of the proofs every `of`-th, every sweep.
pub fn of_shard(shard: Shard, tasks: &[Task]) -> Vec<&Task> {
    let mut proofs = 0;
    let mine = tasks.iter().filter(|task| {
        let turn = proofs % shard.of + 1;
        match task.kind {
            Kind::Sweep => true,
            Kind::Proof => {
                proofs += 1;
                turn == shard.part
            }
        }
    });
    mine.collect()
}

/// Says what is wrong with a law of more cases than can be swept.
pub fn too_wide(law: &dyn AnySweep) -> Option<String> {
    match law.cases() {
        Ok(cases) if cases <= MOST_CASES => None,
        Ok(cases) => Some(format!("a sweep over {cases} cases")),
        Err(error) => Some(error.to_string()),
    }
}

/// The allowed cases of a sweep.
pub fn allowed_cases() -> String {
    format!("smaller widths, for {MOST_CASES} cases at most")
}

/// Checks that a task can be made; a law that is too wide is an error only if it is `alone`.
fn made(task: &Task, alone: bool) -> Result<(), Failure> {
    let refused = |error| chosen::refused(task.entry, error);
    match task.kind {
        Kind::Proof => task.entry.proof(&task.pairs).map(drop).map_err(refused),
        Kind::Sweep => {
            let law = task.entry.law(&task.pairs).map_err(refused)?;
            match too_wide(&*law).filter(|_| alone) {
                None => Ok(()),
                Some(problem) => Err(Failure::Argument {
                    field: "--set",
                    problem: format!("{}: {problem}", task.circuit()),
                    allowed: allowed_cases(),
                }),
            }
        }
    }
}
