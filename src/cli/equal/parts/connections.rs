//! Proof of the connections between parts. Output ports of the parts are inputs of this proof, and
//! input ports of the parts are compared.

use super::leaf::{Leaf, renamed};
use super::{CONNECTIONS, Partners, Texts, netlists};
use crate::cli::equal::check::{Check, Paired, Work};
use crate::cli::equal::pairs::{Pair, Pairs, Part};
use crate::cli::equal::{Failure, script};
use motion_rtl::sim::{PortDirection, SignalInfo};
use std::time::Instant;

/// Reads what connects the parts on both sides, and pairs the ports of the parts.
pub fn connections(
    check: &Check<'_>,
    work: &Work,
    whole: &Paired,
    read: &[String; 2],
    (leaves, texts): (&[Leaf], &mut Texts),
    until: Instant,
) -> Result<Result<(Vec<SignalInfo>, Paired), String>, Failure> {
    let names = |name: fn(&Partners) -> &String| {
        let names = leaves.iter().map(move |leaf| name(&leaf.partners));
        script::without(names)
    };
    let read = [
        read[0].clone() + &names(|partners| &partners.golden.name),
        read[1].clone() + &names(|partners| &partners.design.name),
    ];
    let clocks = ["clk", &check.design.clock];
    let sides = netlists(check, work, CONNECTIONS, &read, (clocks, texts), until)?;
    let [golden, design] = match sides {
        Ok(sides) => sides,
        Err(problem) => return Ok(Err(problem)),
    };
    let part_of = |path: &str| {
        leaves.iter().find(|leaf| {
            let rest = path.strip_prefix(&leaf.partners.golden.name);
            rest.is_some_and(|rest| rest.starts_with('.'))
        })
    };
    let mut signals = check.signals.clone();
    let mut pairs = Pairs {
        inputs: whole.pairs.inputs.clone(),
        ..Pairs::default()
    };
    for pair in &whole.pairs.held {
        let SignalInfo { verilog, path, .. } = &signals[pair.signal];
        let net = &pair.part.net;
        let is_compared = match part_of(verilog) {
            Some(leaf) => leaf.compares(pair, whole, &signals),
            None => {
                pairs.held.push(pair.clone());
                golden.nets.contains_key(verilog) && design.nets.contains_key(net)
            }
        };
        if !is_compared {
            let problem = format!("no part has both {path} and {net} of the design");
            return Ok(Err(problem));
        }
    }
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
