//! What there is to do, in the order of the table.

use super::entry;
use super::report::{Asked, Kind};
use crate::cli::Failure;
use motion_rtl::registry::{CATALOGUE, Entry, SweepEntry, WIDTHS, sweeps};

/// A proof or a sweep.
#[derive(Debug, Clone)]
pub enum Task {
    Proof(&'static Entry, Vec<u64>),
    Sweep(&'static SweepEntry, Vec<u64>),
}

impl Task {
    /// The circuit's name.
    pub fn circuit(&self) -> &'static str {
        match self {
            Task::Proof(entry, _) => entry.name,
            Task::Sweep(entry, _) => entry.circuit,
        }
    }

    pub fn kind(&self) -> Kind {
        match self {
            Task::Proof(..) => Kind::Proof,
            Task::Sweep(..) => Kind::Sweep,
        }
    }
}

/// What was asked for, and the circuits of which nothing can be proved or swept.
pub fn of(asked: &Asked) -> Result<(Vec<Task>, Vec<String>), Failure> {
    let mut entries: Vec<&Entry> = Vec::new();
    for name in &asked.circuits {
        let named = entry(name)?;
        // Once is enough; and the rows of parts are told apart by their circuit.
        if !entries.iter().any(|other| other.name == named.name) {
            entries.push(named);
        }
    }
    if entries.is_empty() {
        entries.extend(CATALOGUE);
    }
    let (mut tasks, mut others) = (Vec::new(), Vec::new());
    for entry in entries {
        let before = tasks.len();
        let given = |width: u64| [&[asked.width.unwrap_or(width)], &asked.with[..]].concat();
        if let Some(width) = entry.proof_width {
            tasks.push(Task::Proof(entry, given(width)));
        }
        let sweeps = sweeps(entry.name).map(|sweep| Task::Sweep(sweep, given(sweep.width)));
        tasks.extend(sweeps);
        if tasks.len() == before {
            others.push(entry.name.to_owned());
        }
    }
    if !asked.circuits.is_empty()
        && let Some(name) = others.first()
    {
        return Err(Failure::Argument {
            field: "CIRCUIT",
            problem: format!("{name} is too wide for a proof by exhaustion"),
            allowed: "its blocks; what is tested of it stands in its note".into(),
        });
    }
    if let Some(width) = asked.width {
        widths(width, &tasks)?;
    }
    for task in &tasks {
        made(task)?;
    }
    Ok((tasks, others))
}

/// A width that no proof is made at is refused; where there are sweeps alone, one that none has.
fn widths(width: u64, tasks: &[Task]) -> Result<(), Failure> {
    let sweeps = tasks.iter().map(|task| match task {
        Task::Sweep(sweep, _) => Some(sweep.widths),
        Task::Proof(..) => None,
    });
    let allowed = match sweeps.collect::<Option<Vec<_>>>() {
        Some(widths) if !widths.concat().contains(&width) => {
            let widths = widths.concat();
            let widths: Vec<_> = widths.iter().map(u64::to_string).collect();
            Some(widths.join(", "))
        }
        None if !WIDTHS.contains(&width) => Some(format!("{} to {}", WIDTHS.start(), WIDTHS.end())),
        _ => None,
    };
    match allowed {
        None => Ok(()),
        Some(allowed) => Err(Failure::Argument {
            field: "--width",
            problem: format!("is {width}"),
            allowed,
        }),
    }
}

/// Whether it can be made.
fn made(task: &Task) -> Result<(), Failure> {
    let (name, given, made, arguments) = match task {
        Task::Proof(entry, given) => {
            let made = (entry.make)(given).is_some();
            (entry.name, given, made, entry.arguments)
        }
        Task::Sweep(sweep, given) => {
            let made = (sweep.make)(given).is_some();
            (sweep.circuit, given, made, entry(sweep.circuit)?.arguments)
        }
    };
    match made {
        true => Ok(()),
        false => Err(Failure::Argument {
            field: "--with",
            problem: format!("{name} cannot be made with {given:?}"),
            allowed: arguments.to_owned(),
        }),
    }
}
