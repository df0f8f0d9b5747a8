//! Proofs and sweeps to run, in the order of the table.

use super::report::{Asked, ITS_BLOCKS, Kind, TOO_WIDE};
use super::shard::Shard;
use crate::cli::Failure;
use crate::cli::chosen::{self, entries};
use motion_rtl::registry::{AnySweep, Entry, Pair};

/// The most cases of a sweep.
const MOST_CASES: u64 = 1 << 32;

/// A proof or a sweep of a circuit with changed keys.
#[derive(Debug, Clone)]
pub struct Task {
    pub entry: &'static Entry,
    pub pairs: Vec<Pair>,
    pub kind: Kind,
}

impl Task {
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
            tasks.push(Task { entry, pairs, kind });
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
    Ok((tasks, others))
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
