//! A design proved part by part: each instance equals the circuit's instance of that name, and so do
//! the connections of the instances.
//!
//! A part is proved for all inputs from power-on. In the proof of the connections, the outputs of the
//! parts are inputs, equal on both sides, and the inputs of the parts are outputs. Both together are
//! a proof of the whole, by induction over the ticks: without loops in a tick, values that agree with
//! all parts of the design are the only ones.

mod connections;
mod instances;
mod leaf;

use super::Failure;
use super::check::{Check, Paired, Work};
use super::netlist::Netlist;
use super::pairs::{Part, key, listed};
use super::report;
use super::script::{self, Names};
use super::task::Task;
use super::tool::End;
use connections::connections;
use instances::Instance;
use leaf::{Leaf, leaf};
use std::time::Instant;

/// Files of the proofs: their extensions and texts.
pub type Texts = Vec<(String, String)>;

/// Result of the proofs of the parts and of their connections.
#[derive(Debug, Default)]
pub struct Parts {
    /// Names of the parts that are proved.
    pub proved: Vec<String>,
    /// Reason why the proof part by part is incomplete, in words; `None` if it is complete.
    pub open: Option<String>,
    /// Nets of the circuit that the connections can drive in another way, with their partners.
    pub suspects: Vec<(String, Part)>,
    pub texts: Texts,
}

/// Stands for a part in the names of files about the connections.
const CONNECTIONS: &str = "connections";

/// A part of the circuit and its partner.
pub struct Partners {
    pub golden: Instance,
    pub design: Instance,
}

impl Parts {
    fn open(mut self, problem: String) -> Self {
        self.open = Some(problem);
        self
    }
}

/// Proves the connections of the parts, then the parts. `read` are the commands that read both sides.
pub fn prove(
    check: &Check<'_>,
    work: &Work,
    whole: &Paired,
    read: &[String; 2],
    until: Instant,
) -> Result<Parts, Failure> {
    let mut parts = Parts::default();
    let partners = match partners(check, work, read, until)? {
        Ok(partners) => partners,
        Err(problem) => return Ok(parts.open(problem)),
    };
    let mut leaves: Vec<Leaf> = Vec::new();
    for partners in partners {
        let name = partners.golden.name.clone();
        match leaf(
            check,
            work,
            read,
            whole,
            (partners, &mut parts.texts),
            until,
        )? {
            Ok(leaf) => leaves.push(leaf),
            Err(problem) => return Ok(parts.open(format!("{name}: {problem}"))),
        }
    }
    let texts = &mut parts.texts;
    let (signals, paired) = match connections(check, work, whole, read, (&leaves, texts), until)? {
        Ok(connections) => connections,
        Err(problem) => return Ok(parts.open(problem)),
    };
    let stem = stem(check, CONNECTIONS);
    let task = Task {
        check,
        names: Names { stem: &stem },
        signals: &signals,
        paired: &paired,
        clock: &check.design.clock,
        reset: check.reset(),
    };
    if let Some(problem) = unproved(&task, CONNECTIONS, work, &mut parts, until)? {
        return Ok(parts.open(format!("the {CONNECTIONS} {problem}")));
    }
    for (place, leaf) in leaves.iter().enumerate() {
        let name = &leaf.partners.golden.name;
        // Instances of the same modules have one proof.
        if !leaves[..place].iter().any(|other| other.is_like(leaf)) {
            let stem = self::stem(check, name);
            let task = leaf.task(check, &stem);
            if let Some(problem) = unproved(&task, name, work, &mut parts, until)? {
                return Ok(parts.open(format!("the part {name} {problem}")));
            }
        }
        parts.proved.push(name.clone());
    }
    Ok(parts)
}

/// Tries a proof and keeps its miter and script; returns what is the matter if it is not found.
fn unproved(
    task: &Task<'_>,
    part: &str,
    work: &Work,
    parts: &mut Parts,
    until: Instant,
) -> Result<Option<String>, Failure> {
    let proof = task.prove(work, until)?;
    let miter = task.miter(&proof.invariants);
    let script = task.names.miter(&miter.exposed(), proof.induction);
    let texts = &mut parts.texts;
    texts.push((format!("{part}.miter.v"), miter.text()));
    texts.push((format!("{part}.miter.ys"), script));
    Ok(match proof.ran.end {
        End::Success if proof.ran.is_proof() => None,
        End::Success => {
            let trace = task.read_trace(work)?;
            let pairs = report::differing_pairs(task.signals, task.paired, &trace);
            let signals = pairs.iter().map(|pair| &task.signals[pair.signal]);
            let differing = listed(signals.clone().map(|signal| &*signal.path));
            if part == CONNECTIONS {
                let nets = signals.map(|signal| signal.verilog.clone());
                let partners = pairs.iter().map(|pair| pair.part.clone());
                parts.suspects = nets.zip(partners).collect();
            }
            let reachable = match proof.ran.is_difference() {
                true => "can differ in",
                false => "can, from states that may be unreachable, differ in",
            };
            Some(format!("{reachable} {differing}"))
        }
        End::Failure => Some(format!("cannot be proved: {}", proof.ran.errors())),
        End::Late => Some("cannot be proved in time".to_owned()),
    })
}

/// Returns the stem of the files of a part.
fn stem(check: &Check<'_>, part: &str) -> String {
    format!("{}.{part}", check.entry.name)
}

/// Runs a script that leaves a JSON, and reads that.
fn read_json(
    check: &Check<'_>,
    work: &Work,
    (script, json): (&str, &str),
    text: &str,
    until: Instant,
) -> Result<Result<String, String>, Failure> {
    work.write(script, text)?;
    let ran = work.run(check, script, until)?;
    match ran.end {
        End::Success => Ok(Ok(work.read(json)?)),
        End::Late => Ok(Err("Yosys has not read it in time".to_owned())),
        End::Failure => Ok(Err(ran.errors())),
    }
}

/// Makes netlists of both sides of a part, after the commands that read them.
fn netlists(
    check: &Check<'_>,
    work: &Work,
    part: &str,
    read: &[String; 2],
    (clocks, texts): ([&str; 2], &mut Texts),
    until: Instant,
) -> Result<Result<[Netlist; 2], String>, Failure> {
    let stem = stem(check, part);
    let names = Names { stem: &stem };
    let mut netlist = |side: usize| -> Result<Result<Netlist, String>, Failure> {
        let name = script::SIDES[side];
        let text = names.flat(name, &read[side]);
        let files = (names.side(name, "ys"), names.side(name, "json"));
        let json = read_json(check, work, (&files.0, &files.1), &text, until)?;
        texts.push((format!("{part}.{name}.ys"), text));
        Ok(json.and_then(|json| Netlist::read(&json, name, clocks[side])))
    };
    Ok(match (netlist(0)?, netlist(1)?) {
        (Ok(golden), Ok(design)) => Ok([golden, design]),
        (Err(problem), _) | (_, Err(problem)) => Err(problem),
    })
}

/// Pairs the instances of both sides by their names.
fn partners(
    check: &Check<'_>,
    work: &Work,
    read: &[String; 2],
    until: Instant,
) -> Result<Result<Vec<Partners>, String>, Failure> {
    let reset = check.reset().map(|(reset, _)| reset);
    let mut sides = Vec::new();
    for ((side, read), (clock, reset)) in script::SIDES
        .into_iter()
        .zip(read)
        .zip([("clk", Some("rst")), (&check.design.clock, reset)])
    {
        let name = |extension: &str| format!("{}.{side}.parts.{extension}", check.entry.name);
        let (script, json) = (name("ys"), name("json"));
        let text = format!("{read}proc\nwrite_json {json}\n");
        let text = match read_json(check, work, (&script, &json), &text, until)? {
            Ok(text) => text,
            Err(problem) => return Ok(Err(problem)),
        };
        match instances::read(&text, clock, reset) {
            Ok(instances) => sides.push(instances),
            Err(problem) => return Ok(Err(problem)),
        }
    }
    let [golden, design] = &sides[..] else {
        return Ok(Err("a side is missing".to_owned()));
    };
    let scopes = check.design.map.scopes();
    let mut partners = Vec::new();
    for own in golden.iter().filter(|own| own.clock.is_some()) {
        let path = format!("{}.{}", check.entry.name, own.name);
        let mapped = scopes
            .iter()
            .find(|scope| scope.golden == path || scope.golden == own.name);
        let name = mapped.map_or(&*own.name, |scope| {
            scope.other.rsplit('.').next().unwrap_or_default()
        });
        let same = |other: &&Instance| key(&other.name) == key(name) && other.clock.is_some();
        if let Some(other) = design.iter().find(same) {
            partners.push(Partners {
                golden: own.clone(),
                design: other.clone(),
            });
        }
    }
    match partners.is_empty() {
        false => Ok(Ok(partners)),
        true => {
            let names: Vec<&str> = golden.iter().map(|own| own.name.as_str()).collect();
            Ok(Err(format!(
                "no instance of {} has the name of one of {}: {}",
                check.design.top,
                check.entry.name,
                names.join(", ")
            )))
        }
    }
}
