//! What there is to do, in the order of the table.

use super::report::{Asked, ITS_BLOCKS, Kind, TOO_WIDE};
use super::{entries, entry};
use crate::cli::{Failure, chosen};
use motion_rtl::registry::{Entry, Request, SweepEntry, WIDTHS, sweeps};

/// A proof or a sweep.
#[derive(Debug, Clone)]
pub enum Task {
    Proof(&'static Entry, Request),
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
    let (mut tasks, mut others) = (Vec::new(), Vec::new());
    // Once is enough; and the rows of parts are told apart by their circuit.
    for entry in entries(&asked.circuits)? {
        let before = tasks.len();
        if let Some(width) = entry.proof_width {
            let request = Request {
                width: Some(asked.width.unwrap_or(width)),
                named: asked.widths.clone(),
                with: asked.with.clone(),
            };
            tasks.push(Task::Proof(entry, request));
        }
        // The words of a law follow from one width.
        if asked.widths.is_empty() {
            let given = |width: u64| [&[asked.width.unwrap_or(width)], &asked.with[..]].concat();
            let sweeps = sweeps(entry.name).map(|sweep| Task::Sweep(sweep, given(sweep.width)));
            tasks.extend(sweeps);
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
    if let Some(width) = asked.width
        && asked.circuits.is_empty()
        && !WIDTHS.contains(&width)
    {
        return Err(Failure::Argument {
            field: "--width",
            problem: format!("is {width}"),
            allowed: format!("{} to {}", WIDTHS.start(), WIDTHS.end()),
        });
    }
    for task in &tasks {
        // Of several the others are swept all the same.
        if asked.circuits.len() < 2 || !too_wide(task) {
            made(task)?;
        }
    }
    Ok((tasks, others))
}

/// True if a sweep at this width has no end.
pub fn too_wide(task: &Task) -> bool {
    match task {
        Task::Proof(..) => false,
        Task::Sweep(sweep, given) => given
            .first()
            .is_some_and(|width| width > sweep.widths.end()),
    }
}

/// Whether it can be made.
fn made(task: &Task) -> Result<(), Failure> {
    match task {
        Task::Proof(entry, request) => match entry.proved(request) {
            Ok(_) => Ok(()),
            Err(error) => Err(chosen::refused(entry, request, &error)),
        },
        Task::Sweep(sweep, given) => match given.first() {
            Some(width) if !sweep.widths.contains(width) => Err(Failure::Argument {
                field: "--width",
                problem: format!("is {width}"),
                allowed: format!("{} to {}", sweep.widths.start(), sweep.widths.end()),
            }),
            _ if (sweep.make)(given).is_some() => Ok(()),
            _ => Err(Failure::Argument {
                field: "--with",
                problem: format!("{} cannot be made with {given:?}", sweep.circuit),
                allowed: entry(sweep.circuit)?.arguments.to_owned(),
            }),
        },
    }
}
