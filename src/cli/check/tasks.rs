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
    let entries: Vec<&Entry> = match &asked.circuit {
        None => CATALOGUE.iter().collect(),
        Some(name) => vec![entry(name)?],
    };
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
    if let (Some(name), []) = (&asked.circuit, &tasks[..]) {
        return Err(Failure::Argument {
            field: "CIRCUIT",
            problem: format!("{name} is too wide for a proof by exhaustion"),
            allowed: "its blocks; what is tested of it stands in its note".into(),
        });
    }
    match asked.width {
        Some(width) => widths(asked, width, &tasks)?,
        None => {}
    }
    for task in &tasks {
        made(task)?;
    }
    Ok((tasks, others))
}

/// A width that nothing has is refused; that of one circuit's sweep only where it is asked for.
fn widths(asked: &Asked, width: u64, tasks: &[Task]) -> Result<(), Failure> {
    let allowed = match (&asked.circuit, tasks) {
        (Some(_), [Task::Sweep(sweep, _)]) => {
            let widths: Vec<_> = sweep.widths.iter().map(u64::to_string).collect();
            (!sweep.widths.contains(&width)).then(|| widths.join(", "))
        }
        _ => (!WIDTHS.contains(&width)).then(|| format!("{} to {}", WIDTHS.start(), WIDTHS.end())),
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
