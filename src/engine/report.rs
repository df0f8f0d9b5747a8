//! Text report of a circuit's plan, to show where its ticks go.

use super::layout::Spot;
use super::plan::{Block, Plan};
use super::run::Engine;
use std::collections::HashMap;
use std::fmt::Write as _;

/// Greatest number of waking signals that a line names.
const NAMED: usize = 3;

/// Returns the blocks of an engine's plan in execution order: steps, waking signals, and the share
/// of `ticks` in which each ran, as far as the interpreter counted. `name` returns the name of a
/// leaf of the walk.
pub fn report(engine: &Engine, ticks: u64, name: &dyn Fn(usize) -> String) -> String {
    let plan = engine.program().plan();
    let names = names(plan, name);
    let makers = makers(plan);
    let mut rows = vec![["block", "part", "does", "steps", "ran", "woken by"].map(str::to_owned)];
    for (place, block) in plan.blocks.iter().enumerate() {
        let does = match place < plan.settling {
            true => format!("settles {}", block.outputs.len()),
            false => format!("edge of {}", block.registers.len() + block.writes.len()),
        };
        let counted = engine.counts().get(place).copied().unwrap_or(0);
        let ran = match ticks {
            0 => "-".to_owned(),
            _ => format!("{:.1} %", 100.0 * counted as f64 / ticks as f64),
        };
        rows.push([
            place.to_string(),
            part(plan, block).to_owned(),
            does,
            block.steps.len().to_string(),
            ran,
            woken(plan, block, &names, &makers),
        ]);
    }
    let steps: usize = plan.blocks.iter().map(|block| block.steps.len()).sum();
    let mut text = format!(
        "blocks: {}, of which {} make the edge; steps: {steps}; registers: {}; memories: {}; words of state: {}\n\n",
        plan.blocks.len(),
        plan.blocks.len() - plan.settling,
        plan.registers.len(),
        plan.memories.len(),
        plan.layout.words,
    );
    let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    let widths: [usize; 6] = std::array::from_fn(width);
    for row in &rows {
        let [block, part, does, steps, ran, woken] = row;
        let [a, b, c, d, e, _] = widths;
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{block:>a$}  {part:<b$}  {does:<c$}  {steps:>d$}  {ran:>e$}  {woken}"
        );
    }
    text
}

fn part<'p>(plan: &'p Plan, block: &Block) -> &'p str {
    match plan
        .instances
        .get(block.instance as usize)
        .map(String::as_str)
    {
        None | Some("") => "(whole)",
        Some(path) => path,
    }
}

/// Returns the first leaf that shows each slot.
fn names(plan: &Plan, name: &dyn Fn(usize) -> String) -> HashMap<u32, String> {
    let mut names = HashMap::new();
    for (leaf, spot) in plan.layout.leaves.iter().enumerate() {
        if let Spot::Slot(slot) = spot {
            names.entry(*slot).or_insert_with(|| name(leaf));
        }
    }
    names
}

/// Returns the block that settles each slot.
fn makers(plan: &Plan) -> HashMap<u32, usize> {
    let outputs = |(place, block): (usize, &Block)| {
        let slots: Vec<u32> = block.outputs.iter().map(|(_, slot)| *slot).collect();
        slots.into_iter().map(move |slot| (slot, place))
    };
    plan.blocks.iter().enumerate().flat_map(outputs).collect()
}

fn woken(
    plan: &Plan,
    block: &Block,
    names: &HashMap<u32, String>,
    makers: &HashMap<u32, usize>,
) -> String {
    let mut woken: Vec<String> = Vec::new();
    for slot in &block.reads {
        let name = match (names.get(slot), makers.get(slot)) {
            (Some(name), _) => name.clone(),
            // An unwatched net has no name.
            (None, Some(maker)) => format!("block {maker}"),
            (None, None) => continue,
        };
        if !woken.contains(&name) {
            woken.push(name);
        }
    }
    let bit = plan
        .blocks
        .iter()
        .position(|other| std::ptr::eq(other, block));
    let bit = bit.map(|place| plan.bit(place) as u32);
    if bit.is_some_and(|bit| {
        plan.memories
            .iter()
            .any(|memory| memory.readers.contains(&bit))
    }) {
        woken.push("its memory".to_owned());
    }
    let more = woken.len().saturating_sub(NAMED);
    woken.truncate(NAMED);
    match more {
        0 => woken.join(", "),
        _ => format!("{} and {more} more", woken.join(", ")),
    }
}
