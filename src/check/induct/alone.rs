//! Parts that are proved alone.
//!
//! A part that assumes nothing keeps the assumptions of the parts inside it in any circuit, if it
//! keeps them with free inputs: whatever the circuit around it does, it runs from power-on with some
//! inputs. Its netlist is small, and two equal parts are proved once.

use super::prover::{self, Basis, Found, Task};
use super::search::{Never, StateBit};
use super::{MEMORY_BITS, is_obligation};
use crate::engine::{EngineError, Flat, Place, Statement};
use crate::netlist::{Claim, Design, Module, Setting};
use std::time::Duration;

/// Share of the time for a property that one of a part may take.
const LEMMA: u32 = 4;

/// Proof of an assumption of a part.
#[derive(Debug, Clone)]
pub(super) struct Kept {
    /// Basis of the proof, in places of the netlist of the circuit.
    pub basis: Basis,
    /// Statements on which it relies.
    pub with: Vec<Statement>,
    /// Time of the search.
    pub time: Duration,
}

/// Proofs of parts.
#[derive(Debug)]
pub(super) struct Alone {
    /// Proof of each statement that a part keeps alone.
    pub kept: Vec<Option<Kept>>,
    /// Paths of the parts that keep all assumptions inside them.
    parts: Vec<Vec<String>>,
}

impl Alone {
    /// Proves what parts of a circuit keep alone; `stated` are the statements of its netlist.
    pub fn of(
        design: &Design,
        flat: &Flat,
        stated: &[Statement],
        limit: Duration,
    ) -> Result<Self, EngineError> {
        let mut alone = Alone {
            kept: vec![None; stated.len()],
            parts: Vec::new(),
        };
        let mut known: Vec<(Design, Vec<(Statement, Kept)>)> = Vec::new();
        for (module, path) in free(design) {
            let part = part(design, module, &path);
            let proved = match known.iter().find(|(other, _)| *other == part) {
                Some((_, proved)) => proved.clone(),
                None => {
                    let proved = prove(&part, limit)?;
                    known.push((part, proved.clone()));
                    proved
                }
            };
            let within = Within::new(flat, &path);
            for (statement, kept) in proved {
                let path = [&path[..], &statement.path].concat();
                let mut all = stated.iter();
                let at = all.position(|it| {
                    is_obligation(it) && it.path == path && it.name == statement.name
                });
                if let Some(at) = at {
                    alone.kept[at] = Some(within.kept(kept));
                }
            }
            let mut inside = stated.iter().zip(&alone.kept);
            let is_kept = |it: &Statement, kept: &Option<Kept>| {
                !is_obligation(it) || !it.path.starts_with(&path) || kept.is_some()
            };
            if inside.all(|(it, kept)| is_kept(it, kept)) {
                alone.parts.push(path);
            }
        }
        Ok(alone)
    }

    /// True if a statement is one of a part that keeps all assumptions inside it.
    pub fn contains(&self, statement: &Statement) -> bool {
        let mut parts = self.parts.iter();
        parts.any(|part| statement.path.starts_with(part))
    }
}

/// Place of a part's netlist in that of the circuit.
struct Within<'p> {
    path: &'p [String],
    registers: u32,
    memories: u32,
}

impl<'p> Within<'p> {
    fn new(flat: &Flat, path: &'p [String]) -> Self {
        // Registers and memories are in the order of the instances.
        let instance = flat.instances.iter().position(|it| it.path == path);
        let instance = instance.unwrap_or_default() as u32;
        let registers = flat.registers.iter();
        let memories = flat.memories.iter();
        Within {
            path,
            registers: registers.take_while(|it| it.instance < instance).count() as u32,
            memories: memories.take_while(|it| it.instance < instance).count() as u32,
        }
    }

    fn kept(&self, kept: Kept) -> Kept {
        let inside = |statement: Statement| Statement {
            path: [self.path, &statement.path].concat(),
            ..statement
        };
        let bit = |bit: &StateBit| StateBit {
            place: match bit.place {
                Place::Register(register) => Place::Register(register + self.registers),
                Place::Word(memory, word) => Place::Word(memory + self.memories, word),
                place => place,
            },
            ..*bit
        };
        let never = |never: &Never| never.iter().map(bit).collect();
        Kept {
            basis: match &kept.basis {
                Basis::Search(all) => Basis::Search(all.iter().map(never).collect()),
                basis => basis.clone(),
            },
            with: kept.with.into_iter().map(inside).collect(),
            time: kept.time,
        }
    }
}

/// Returns the outermost parts that assume nothing and contain a part that does: module and path.
fn free(design: &Design) -> Vec<(usize, Vec<String>)> {
    let mut found = Vec::new();
    let Some(top) = design.modules.len().checked_sub(1) else {
        return found;
    };
    let mut open = vec![(top, Vec::new())];
    while let Some((module, path)) = open.pop() {
        for child in &design.modules[module].instances {
            let path = [&path[..], std::slice::from_ref(&child.name)].concat();
            let inner = &design.modules[child.module];
            match assumes(inner) {
                false if relies(design, inner) => found.push((child.module, path)),
                _ => open.push((child.module, path)),
            }
        }
    }
    found
}

fn assumes(module: &Module) -> bool {
    let mut assertions = module.assertions.iter();
    assertions.any(|it| it.claim == Claim::Given)
}

/// True if a part inside assumes something.
fn relies(design: &Design, module: &Module) -> bool {
    let mut parts = module.instances.iter().map(|it| &design.modules[it.module]);
    parts.any(|part| assumes(part) || relies(design, part))
}

/// Returns a part as a design of its own, with the same settings.
fn part(design: &Design, module: usize, path: &[String]) -> Design {
    let settings = design.settings.iter();
    let settings = settings.filter_map(|setting| {
        let path = setting.path.strip_prefix(path)?.to_vec();
        Some(Setting {
            path,
            ..setting.clone()
        })
    });
    Design {
        modules: design.modules[..=module].to_vec(),
        settings: settings.collect(),
    }
}

/// Proves the assumptions of a circuit's parts, for any inputs of the circuit.
fn prove(design: &Design, limit: Duration) -> Result<Vec<(Statement, Kept)>, EngineError> {
    let (flat, stated) = Flat::with_parts(design)?;
    let alone = Alone::of(design, &flat, &stated, limit)?;
    let task = Task::new(&flat, &stated, &alone, is_obligation, limit);
    let results = prover::prove(&task);
    let mut proved = Vec::new();
    for (statement, kept) in stated.iter().zip(&alone.kept) {
        proved.extend(kept.clone().map(|kept| (statement.clone(), kept)));
    }
    for (&index, (found, time)) in task.properties.iter().zip(results.found) {
        let Found::Proved(grounds) = found else {
            continue;
        };
        // What a second check refuses is asked again in the circuit around.
        if results.refused.is_empty() {
            let with = grounds.with.iter();
            let kept = Kept {
                basis: grounds.basis.clone(),
                with: with.map(|&lemma| stated[lemma].clone()).collect(),
                time,
            };
            proved.push((stated[index].clone(), kept));
        }
    }
    Ok(proved)
}

impl<'f> Task<'f> {
    /// Returns the task of a circuit: to prove those statements that are asked for, unless a part
    /// keeps them alone.
    pub(super) fn new(
        flat: &'f Flat,
        stated: &[Statement],
        alone: &Alone,
        is_asked: fn(&Statement) -> bool,
        limit: Duration,
    ) -> Self {
        let of = |is: &dyn Fn(usize, &Statement) -> bool| {
            let all = stated.iter().enumerate();
            let all = all.filter(|&(index, it)| is(index, it));
            all.map(|(index, _)| index).collect()
        };
        Task {
            flat,
            properties: of(&|index, it| is_asked(it) && alone.kept[index].is_none()),
            lemmas: of(&|_, it| !is_asked(it) && it.claim.is_proved() && !alone.contains(it)),
            givens: of(&|_, it| it.claim == Claim::Given && it.path.is_empty()),
            memory_bits: MEMORY_BITS,
            limit,
        }
    }

    /// Returns the properties to prove, and those that may become lemmas.
    pub(super) fn proved(&self) -> impl Iterator<Item = usize> {
        self.properties.iter().chain(&self.lemmas).copied()
    }

    /// Returns the time for a property.
    pub(super) fn limit(&self, property: usize) -> Duration {
        match self.lemmas.contains(&property) {
            true => self.limit / LEMMA,
            false => self.limit,
        }
    }
}
