//! Maps in the format of `compare`: one to fill in, and one of the pairs that were found.

use super::check::{Check, Paired};
use super::pairs::{Pair, bits};
use motion_rtl::sim::PortDirection;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use toml::Value;

/// Returns a map to fill in: the circuit's signals without partner, and the design's.
pub fn template(check: &Check<'_>, paired: &Paired) -> String {
    let circuit = check.entry.name;
    let mut text = format!(
        "# Names of {} that stand for those of {circuit}.\n\
         # Fill in a name and take the # away. !NAME is inverted, NAME[7:0] is a part.\n\
         # What has no partner on purpose goes into ignore, a port out into leave.\n\n\
         ignore = []\nleave = []\n\n[signals]\n",
        check.design.top
    );
    let pairs = &paired.pairs;
    for &index in pairs.ports_without.iter().chain(&pairs.registers_without) {
        let signal = &check.signals[index];
        let name = Value::from(format!("{circuit}.{}", signal.path));
        let port = match signal.port {
            Some(PortDirection::In) => ", port in",
            Some(PortDirection::Out) => ", port out",
            None => "",
        };
        // Writing to a string does not fail.
        let _ = writeln!(text, "#{name} = \"\" # {}{port}", bits(signal.width()));
    }
    let taken = pairs.inputs.iter().chain(&pairs.held);
    let taken: BTreeSet<_> = taken
        .filter_map(|pair| paired.design.nets.get(&pair.part.net))
        .map(|net| &net.bits)
        .collect();
    let free = paired.design.nets.iter().filter(|(name, net)| {
        let port =
            paired.design.inputs.contains_key(*name) || paired.design.outputs.contains(*name);
        (net.is_register || port) && !taken.contains(&net.bits)
    });
    let reserved = [
        Some(&*check.design.clock),
        check.reset().map(|(reset, _)| reset),
    ];
    let free = free.filter(|(name, _)| !reserved.contains(&Some(name.as_str())));
    let lines: Vec<String> = free
        .map(|(name, net)| format!("#   {name} # {}\n", bits(net.width())))
        .collect();
    if !lines.is_empty() {
        text += "\n# There without partner:\n";
        text += &lines.concat();
    }
    text
}

/// Returns the pairs as a map for the waves of a difference.
pub fn map(check: &Check<'_>, paired: &Paired) -> String {
    let circuit = check.entry.name;
    let pairs = &paired.pairs;
    let held: BTreeSet<usize> = pairs.held.iter().map(|pair| pair.signal).collect();
    let name = |index: usize| Value::from(format!("{circuit}.{}", check.signals[index].path));
    let outputs = check.signals.iter().enumerate();
    let left = outputs
        .filter(|(index, signal)| signal.port == Some(PortDirection::Out) && !held.contains(index));
    let left: Vec<String> = left.map(|(index, _)| name(index).to_string()).collect();
    let mut text = format!("leave = [{}]\n\n[signals]\n", left.join(", "));
    for pair in pairs.inputs.iter().chain(&pairs.held) {
        let _ = writeln!(text, "{} = {}", name(pair.signal), partner(pair, paired));
    }
    text
}

/// Returns the partner of a pair in the waves of the design.
fn partner(pair: &Pair, paired: &Paired) -> Value {
    let part = &pair.part;
    let whole = paired.design.nets.get(&part.net).map(|net| net.width());
    let bits = match (whole == Some(part.width), part.width) {
        (true, _) => String::new(),
        (false, 1) => format!("[{}]", part.low),
        (false, width) => format!("[{}:{}]", part.low + width - 1, part.low),
    };
    let invert = if part.invert { "!" } else { "" };
    Value::from(format!("{invert}miter.design.{}{bits}", part.net))
}
