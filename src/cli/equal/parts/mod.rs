//! A design proved part by part: each instance equals the circuit's instance of that name, and so do
//! the connections of the instances.
//!
//! A part is proved for all inputs from power-on. In the proof of the connections, the outputs of the
//! parts are inputs, equal on both sides, and the inputs of the parts are outputs. Both together are
//! a proof of the whole, by induction over the ticks: without loops in a tick, values that agree with
//! all parts of the design are the only ones.

mod instances;

use super::Failure;
use super::check::{Check, Paired, Work};
use super::netlist::Netlist;
use super::pairs::{Pair, Pairs, Part, Sides, key, listed};
use super::report;
use super::script::{self, Names};
use super::task::Task;
use super::tool::End;
use instances::Instance;
use motion_rtl::compare::Map;
use motion_rtl::netlist::Role;
use motion_rtl::sim::{PortDirection, SignalInfo};
use std::time::Instant;

/// Files of the proofs: their extensions and texts.
pub type Texts = Vec<(String, String)>;

/// Result of the proofs of the parts and of their connections.
#[derive(Debug, Default)]
pub struct Parts {
    /// Names of the parts that are proved.
    pub proved: Vec<String>,
    /// What is not proved, in words.
    pub open: Option<String>,
    pub texts: Texts,
}

/// Stands for a part in the names of files about the connections.
const CONNECTIONS: &str = "connections";

/// A part of the circuit and its partner.
struct Partners {
    golden: Instance,
    design: Instance,
}

/// A part whose proof is found, with the pairs of its ports.
struct Leaf {
    partners: Partners,
    signals: Vec<SignalInfo>,
    paired: Paired,
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
        match leaf(check, work, read, (partners, &mut parts.texts), until)? {
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
    if let Some(problem) = unproved(&task, CONNECTIONS, work, &mut parts.texts, until)? {
        return Ok(parts.open(format!("the {CONNECTIONS} {problem}")));
    }
    for (place, leaf) in leaves.iter().enumerate() {
        let name = &leaf.partners.golden.name;
        // Instances of the same modules have one proof.
        if !leaves[..place].iter().any(|other| other.is_like(leaf)) {
            let stem = self::stem(check, name);
            let task = leaf.task(check, &stem);
            if let Some(problem) = unproved(&task, name, work, &mut parts.texts, until)? {
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
    texts: &mut Texts,
    until: Instant,
) -> Result<Option<String>, Failure> {
    let proof = task.prove(work, until)?;
    let miter = task.miter(&proof.invariants);
    texts.push((format!("{part}.miter.v"), miter.text()));
    let script = task.names.miter(&miter.exposed(), proof.induction);
    texts.push((format!("{part}.miter.ys"), script));
    Ok(match proof.ran.end {
        End::Success if proof.ran.is_proof() => None,
        End::Success => {
            let differing = report::differing(task.signals, task.paired, &task.read_trace(work)?);
            let differing = listed(differing.iter().map(String::as_str));
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

/// Pairs the instances of both sides by their names.
fn partners(
    check: &Check<'_>,
    work: &Work,
    read: &[String; 2],
    until: Instant,
) -> Result<Result<Vec<Partners>, String>, Failure> {
    let reset = check.reset().map(|(reset, _)| reset);
    let mut sides = Vec::new();
    for ((side, read), (clock, reset)) in ["golden", "design"]
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

/// Returns a signal with another name; `port` is its direction if it is a port.
fn renamed(like: &SignalInfo, name: &str, width: usize, port: PortDirection) -> SignalInfo {
    let mut signal = like.clone();
    signal.path = name.to_owned();
    signal.verilog = name.to_owned();
    signal.shape.width = width;
    signal.port = Some(port);
    signal.role = Role::Net;
    signal
}

/// Reads both sides of a part and pairs their ports and registers.
fn leaf(
    check: &Check<'_>,
    work: &Work,
    read: &[String; 2],
    (partners, texts): (Partners, &mut Texts),
    until: Instant,
) -> Result<Result<Leaf, String>, Failure> {
    let stem = stem(check, &partners.golden.name);
    let names = Names { stem: &stem };
    let Partners { golden, design } = &partners;
    let mut sides = Vec::new();
    for (((side, read), instance), clock) in ["golden", "design"]
        .into_iter()
        .zip(read)
        .zip([golden, design])
        .zip([Some("clk"), design.clock.as_deref()])
    {
        let text = format!("{read}hierarchy -check -top {}\n", instance.module);
        let text = names.flat(side, &text);
        texts.push((format!("{}.{side}.ys", golden.name), text.clone()));
        let files = (names.side(side, "ys"), names.side(side, "json"));
        let json = match read_json(check, work, (&files.0, &files.1), &text, until)? {
            Ok(json) => json,
            Err(problem) => return Ok(Err(problem)),
        };
        match Netlist::read(&json, side, clock.unwrap_or_default()) {
            Ok(netlist) => sides.push(netlist),
            Err(problem) => return Ok(Err(problem)),
        }
    }
    let (Some(other), Some(own)) = (sides.pop(), sides.pop()) else {
        return Ok(Err("a side is missing".to_owned()));
    };
    // Without a reset, the part is proved with that of the circuit low.
    let is_reset = match check.reset() {
        Some(_) => design.reset.is_some(),
        None => golden.reset.is_some(),
    };
    if own.inputs.contains_key("rst") && !is_reset {
        return Ok(Err("the reset of the design is no input of it".to_owned()));
    }
    // The part's registers, and its ports, which are no signals of the whole.
    let inside = format!("{}.", golden.name);
    let registers = check
        .signals
        .iter()
        .filter(|signal| signal.role == Role::Register);
    let mut signals: Vec<SignalInfo> = registers
        .filter_map(|signal| {
            let mut own = signal.clone();
            own.path = signal.path.strip_prefix(&inside)?.to_owned();
            own.verilog = signal.verilog.strip_prefix(&inside)?.to_owned();
            Some(own)
        })
        .collect();
    let Some(like) = check.signals.first() else {
        return Ok(Err("the circuit has no signals".to_owned()));
    };
    // A register may be a port out.
    for signal in &mut signals {
        let is_output = own.outputs.contains(&signal.verilog);
        signal.port = is_output.then_some(PortDirection::Out);
    }
    let inputs = own
        .inputs
        .iter()
        .filter(|(port, _)| *port != "clk" && *port != "rst");
    signals.extend(inputs.map(|(port, width)| renamed(like, port, *width, PortDirection::In)));
    for port in &own.outputs {
        if signals.iter().all(|signal| signal.verilog != *port) {
            let width = own.nets.get(port).map_or(1, |net| net.width());
            signals.push(renamed(like, port, width, PortDirection::Out));
        }
    }
    let map = Map::default();
    let sides = Sides {
        circuit: &golden.module,
        signals: &signals,
        golden: &own,
        design: &other,
        reserved: [design.clock.as_deref(), design.reset.as_deref()],
        map: &map,
    };
    let pairs = sides.pairs()?;
    Ok(Ok(Leaf {
        signals,
        paired: Paired {
            golden: own,
            design: other,
            pairs,
        },
        partners,
    }))
}

impl Leaf {
    /// True if the proof of the other one is the proof of this one.
    fn is_like(&self, other: &Leaf) -> bool {
        let of = |leaf: &Leaf| {
            let Partners { golden, design } = &leaf.partners;
            let modules = [golden.module.clone(), design.module.clone()];
            (modules, design.clock.clone(), design.reset.clone())
        };
        of(self) == of(other)
    }

    /// Returns the reset of the design's part, and true if it is active low.
    fn reset(&self, check: &Check<'_>) -> Option<(&str, bool)> {
        let low = check.reset().is_some_and(|(_, low)| low);
        Some((self.partners.design.reset.as_deref()?, low))
    }

    fn task<'t>(&'t self, check: &'t Check<'t>, stem: &'t str) -> Task<'t> {
        Task {
            check,
            names: Names { stem },
            signals: &self.signals,
            paired: &self.paired,
            clock: self.partners.design.clock.as_deref().unwrap_or_default(),
            reset: self.reset(check),
        }
    }
}

/// Reads what connects the parts on both sides, and pairs the ports of the parts.
fn connections(
    check: &Check<'_>,
    work: &Work,
    whole: &Paired,
    read: &[String; 2],
    (leaves, texts): (&[Leaf], &mut Texts),
    until: Instant,
) -> Result<Result<(Vec<SignalInfo>, Paired), String>, Failure> {
    let stem = stem(check, CONNECTIONS);
    let names = Names { stem: &stem };
    let mut sides = Vec::new();
    for ((side, read), clock) in ["golden", "design"]
        .into_iter()
        .zip(read)
        .zip(["clk", &check.design.clock])
    {
        let instances = leaves.iter().map(|leaf| match side {
            "golden" => &leaf.partners.golden.name,
            _ => &leaf.partners.design.name,
        });
        let text = format!("{read}{}", script::without(instances));
        let text = names.flat(side, &text);
        texts.push((format!("{CONNECTIONS}.{side}.ys"), text.clone()));
        let files = (names.side(side, "ys"), names.side(side, "json"));
        let json = match read_json(check, work, (&files.0, &files.1), &text, until)? {
            Ok(json) => json,
            Err(problem) => return Ok(Err(problem)),
        };
        match Netlist::read(&json, side, clock) {
            Ok(netlist) => sides.push(netlist),
            Err(problem) => return Ok(Err(problem)),
        }
    }
    let (Some(design), Some(golden)) = (sides.pop(), sides.pop()) else {
        return Ok(Err("a side is missing".to_owned()));
    };
    let inside = |path: &str| {
        leaves.iter().any(|leaf| {
            let rest = path.strip_prefix(&leaf.partners.golden.name);
            rest.is_some_and(|rest| rest.starts_with('.'))
        })
    };
    let mut signals = check.signals.clone();
    let mut pairs = Pairs {
        inputs: whole.pairs.inputs.clone(),
        ..Pairs::default()
    };
    let outside = whole.pairs.held.iter().filter(|pair| {
        let signal = &signals[pair.signal];
        !inside(&signal.verilog)
            && golden.nets.contains_key(&signal.verilog)
            && design.nets.contains_key(&pair.part.net)
    });
    pairs.held = outside.cloned().collect();
    for leaf in leaves {
        let Partners {
            golden: own,
            design: other,
        } = &leaf.partners;
        let mut join = |port: &str, width: usize, part: Part, direction: PortDirection| {
            let name = format!("{}.{port}", own.name);
            let Some(like) = check.signals.first() else {
                return;
            };
            signals.push(renamed(like, &name, width, direction));
            let pair = Pair {
                signal: signals.len() - 1,
                part: Part {
                    net: format!("{}.{}", other.name, part.net),
                    ..part
                },
            };
            match direction {
                PortDirection::In => pairs.inputs.push(pair),
                PortDirection::Out => pairs.held.push(pair),
            }
        };
        // The inputs of a part are outputs of what connects the parts.
        for pair in &leaf.paired.pairs.inputs {
            let signal = &leaf.signals[pair.signal];
            join(
                &signal.verilog,
                signal.width(),
                pair.part.clone(),
                PortDirection::Out,
            );
        }
        if let Some((reset, low)) = leaf.reset(check)
            && leaf.paired.golden.inputs.contains_key("rst")
        {
            let part = Part {
                net: reset.to_owned(),
                low: 0,
                width: 1,
                invert: low,
            };
            join("rst", 1, part, PortDirection::Out);
        }
        for pair in &leaf.paired.pairs.held {
            let signal = &leaf.signals[pair.signal];
            let is_output = leaf.paired.golden.outputs.contains(&signal.verilog);
            if is_output && leaf.paired.design.outputs.contains(&pair.part.net) {
                join(
                    &signal.verilog,
                    signal.width(),
                    pair.part.clone(),
                    PortDirection::In,
                );
            }
        }
    }
    // The other ports of the parts may have any value, but stand in the miter.
    for (port, width) in &golden.inputs {
        let is_port =
            |signal: &SignalInfo| signal.verilog == *port && signal.port == Some(PortDirection::In);
        if !signals.iter().any(is_port)
            && port != "clk"
            && port != "rst"
            && let Some(like) = check.signals.first()
        {
            signals.push(renamed(like, port, *width, PortDirection::In));
        }
    }
    Ok(Ok((
        signals,
        Paired {
            golden,
            design,
            pairs,
        },
    )))
}
