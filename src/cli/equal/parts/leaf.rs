//! A part of the circuit and its partner in the design.

use super::instances::Instance;
use super::{Partners, Texts, netlists};
use crate::cli::equal::Failure;
use crate::cli::equal::check::{Check, Paired, Work};
use crate::cli::equal::pairs::{Pair, Part, Sides};
use crate::cli::equal::script::Names;
use crate::cli::equal::task::Task;
use motion_rtl::compare::Map;
use motion_rtl::netlist::Role;
use motion_rtl::sim::{PortDirection, SignalInfo};
use std::time::Instant;

/// Both sides of a part, with the pairs of its ports and registers.
pub struct Leaf {
    pub partners: Partners,
    pub signals: Vec<SignalInfo>,
    pub paired: Paired,
}

/// Reads both sides of a part and pairs their ports and registers.
pub fn leaf(
    check: &Check<'_>,
    work: &Work,
    read: &[String; 2],
    whole: &Paired,
    (partners, texts): (Partners, &mut Texts),
    until: Instant,
) -> Result<Result<Leaf, String>, Failure> {
    let Partners { golden, design } = &partners;
    let text = |side: usize, instance: &Instance| {
        format!("{}hierarchy -check -top {}\n", read[side], instance.module)
    };
    let read = [text(0, golden), text(1, design)];
    let clocks = ["clk", design.clock.as_deref().unwrap_or_default()];
    let sides = netlists(check, work, &golden.name, &read, (clocks, texts), until)?;
    let [own, other] = match sides {
        Ok(sides) => sides,
        Err(problem) => return Ok(Err(problem)),
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
    let mut pairs = sides.pairs()?;
    // What a map pairs in the part.
    let scope = format!("{}.", design.name);
    for pair in &whole.pairs.held {
        let like = &check.signals[pair.signal];
        if let Some(name) = like.verilog.strip_prefix(&inside)
            && let Some(net) = pair.part.net.strip_prefix(&scope)
            && own.nets.contains_key(name)
            && other.nets.contains_key(net)
            && pairs
                .held
                .iter()
                .all(|held| signals[held.signal].verilog != name)
        {
            let mut signal = like.clone();
            signal.path = name.to_owned();
            signal.verilog = name.to_owned();
            signals.push(signal);
            pairs.held.push(Pair {
                signal: signals.len() - 1,
                part: Part {
                    net: net.to_owned(),
                    ..pair.part.clone()
                },
            });
        }
    }
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
    pub fn is_like(&self, other: &Leaf) -> bool {
        let of = |leaf: &Leaf| {
            let Partners { golden, design } = &leaf.partners;
            let modules = [golden.module.clone(), design.module.clone()];
            (modules, design.clock.clone(), design.reset.clone())
        };
        of(self) == of(other) && self.paired.pairs == other.paired.pairs
    }

    /// True if the proof of this part compares a pair of the whole.
    pub fn compares(&self, pair: &Pair, whole: &Paired, signals: &[SignalInfo]) -> bool {
        let Partners { golden, design } = &self.partners;
        let bits = |net: &str| whole.design.nets.get(net).map(|net| &net.bits);
        self.paired.pairs.held.iter().any(|own| {
            let signal = format!("{}.{}", golden.name, self.signals[own.signal].verilog);
            let net = format!("{}.{}", design.name, own.part.net);
            let rest = |pair: &Pair| (pair.part.low, pair.part.width, pair.part.invert);
            signal == signals[pair.signal].verilog
                && bits(&net).is_some_and(|own| Some(own) == bits(&pair.part.net))
                && rest(own) == rest(pair)
        })
    }

    /// Returns the reset of the design's part, and true if it is active low.
    pub fn reset(&self, check: &Check<'_>) -> Option<(&str, bool)> {
        let low = check.reset().is_some_and(|(_, low)| low);
        Some((self.partners.design.reset.as_deref()?, low))
    }

    pub fn task<'t>(&'t self, check: &'t Check<'t>, stem: &'t str) -> Task<'t> {
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

/// Returns a signal with another name; `port` is its direction if it is a port.
pub fn renamed(like: &SignalInfo, name: &str, width: usize, port: PortDirection) -> SignalInfo {
    let mut signal = like.clone();
    signal.path = name.to_owned();
    signal.verilog = name.to_owned();
    signal.shape.width = width;
    signal.port = Some(port);
    signal.role = Role::Net;
    signal
}
