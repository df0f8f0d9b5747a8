use super::super::flat::Flat;
use super::super::interpreter::{self, Counts};
use super::super::layout::Spot;
use super::super::passes;
use super::super::plan::Plan;
use super::super::random::{Case, Plain, cases};
use super::Code;
use proptest::prelude::*;

/// A leaf, or behind them a property, where the slab shows it.
fn leaf(plan: &Plan, slab: &[u64], index: usize) -> Option<u64> {
    let layout = &plan.layout;
    let leaves = layout.leaves.len();
    match *layout
        .leaves
        .get(index)
        .unwrap_or_else(|| &layout.properties[index - leaves])
    {
        Spot::Slot(slot) => Some(slab[slot as usize]),
        Spot::Constant(bits) => Some(bits),
        Spot::Stage(memory, stage) => {
            let memory = &plan.memories[memory as usize];
            Some(interpreter::read(memory, slab, stage.into()))
        }
        Spot::Gone => None,
    }
}

/// What both backends are to leave as it is with the other one: all but the words of steps and the
/// bits of hot blocks.
fn common(plan: &Plan, hot: &[bool]) -> Vec<u64> {
    let mut masks = vec![u64::MAX; plan.layout.words as usize];
    for (place, block) in plan.blocks.iter().enumerate() {
        for step in &block.steps {
            masks[step.to as usize] = 0;
        }
        if hot[place] {
            let bit = plan.bit(place);
            masks[plan.layout.dirty as usize + bit / 64] &= !(1 << (bit % 64));
        }
    }
    masks
}

fn same(masks: &[u64], one: &[u64], other: &[u64]) -> Result<(), TestCaseError> {
    for (slot, ((mask, one), other)) in masks.iter().zip(one).zip(other).enumerate() {
        prop_assert_eq!(one & mask, other & mask, "slot {}", slot);
    }
    Ok(())
}

fn put(plan: &Plan, slab: &mut [u64], changes: &[(usize, u64)]) {
    for &(port, word) in changes {
        interpreter::put(&plan.layout, slab, plan.layout.inputs[port], word);
    }
}

/// Whoever looked forgets what has changed.
fn seen(plan: &Plan, slab: &mut [u64]) {
    let layout = &plan.layout;
    slab[layout.event as usize] = 0;
    slab[layout.changed as usize..][..layout.changed_words as usize].fill(0);
}

/// The interpreter with and without passes, and every node in every tick.
fn interpreted(case: &Case) -> Result<(), TestCaseError> {
    let Case { flat, wanted, .. } = case;
    let plans = [flat.clone(), passes::all(flat, wanted)].map(|flat| Plan::of(&flat, wanted));
    for plan in plans {
        let mut plain = Plain::new(flat);
        let mut slab = plan.layout.power_on();
        let mut counts = Counts::from(vec![0; plan.blocks.len()]);
        let mut shown: Vec<_> = (0..wanted.len()).map(|_| None).collect();
        for hold in &case.stimulus {
            for tick in 0..=hold.ticks {
                seen(&plan, &mut slab);
                match tick {
                    0 => {
                        put(&plan, &mut slab, &hold.changes);
                        for &(port, word) in &hold.changes {
                            plain.inputs[port] = word;
                        }
                    }
                    _ => {
                        interpreter::edge(&plan, &mut slab, &mut counts);
                        plain.edge();
                    }
                }
                interpreter::settle(&plan, &mut slab, &mut counts);
                plain.settle();
                let count = flat.leaves.len() + flat.properties.len();
                for index in (0..count).filter(|&index| wanted[index]) {
                    let value = leaf(&plan, &slab, index);
                    prop_assert_eq!(value, Some(plain.leaf(index)), "leaf {}", index);
                    let before = shown[index].replace(value);
                    let event = slab[plan.layout.event as usize] == 1;
                    // Nobody is told of properties.
                    if index < flat.leaves.len() {
                        prop_assert!(before.is_none_or(|before| before == value) || event);
                    }
                }
            }
        }
    }
    Ok(())
}

fn compiled(case: &Case) -> Result<(), TestCaseError> {
    let plan = Plan::of(&case.flat, &case.wanted);
    let code = Code::compile(&plan, &case.hot).expect("it compiles");
    let masks = common(&plan, &case.hot);
    let mut counts = Counts::from(vec![0; plan.blocks.len()]);
    let mut reference = plan.layout.power_on();
    let mut slab = reference.clone();
    for hold in &case.stimulus {
        put(&plan, &mut reference, &hold.changes);
        put(&plan, &mut slab, &hold.changes);
        interpreter::settle(&plan, &mut reference, &mut counts);
        code.settle(&mut slab);
        same(&masks, &reference, &slab)?;
        for _ in 0..hold.ticks {
            seen(&plan, &mut reference);
            seen(&plan, &mut slab);
            interpreter::edge(&plan, &mut reference, &mut counts);
            code.edge(&mut slab);
            same(&masks, &reference, &slab)?;
            interpreter::settle(&plan, &mut reference, &mut counts);
            code.settle(&mut slab);
            same(&masks, &reference, &slab)?;
        }
    }
    Ok(())
}

fn advanced(case: &Case) -> Result<(), TestCaseError> {
    let plan = Plan::of(&case.flat, &case.wanted);
    let code = Code::compile(&plan, &case.hot).expect("it compiles");
    let masks = common(&plan, &case.hot);
    let mut counts = Counts::from(vec![0; plan.blocks.len()]);
    let mut reference = plan.layout.power_on();
    let mut slab = reference.clone();
    for hold in &case.stimulus {
        put(&plan, &mut reference, &hold.changes);
        put(&plan, &mut slab, &hold.changes);
        interpreter::settle(&plan, &mut reference, &mut counts);
        code.settle(&mut slab);
        let mut left = hold.ticks * 3;
        while left > 0 {
            seen(&plan, &mut reference);
            seen(&plan, &mut slab);
            let mut ticks = 0;
            while ticks < left && reference[plan.layout.event as usize] == 0 {
                interpreter::edge(&plan, &mut reference, &mut counts);
                interpreter::settle(&plan, &mut reference, &mut counts);
                ticks += 1;
            }
            prop_assert_eq!(code.advance(&mut slab, left), ticks);
            same(&masks, &reference, &slab)?;
            left -= ticks;
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn the_interpreter_does_what_the_nodes_say(case in cases(true)) {
        interpreted(&case)?;
    }

    #[test]
    fn the_interpreter_does_what_the_nodes_say_where_little_is_wanted(case in cases(false)) {
        interpreted(&case)?;
    }

    #[test]
    fn the_code_does_what_the_interpreter_does(case in cases(true)) {
        compiled(&case)?;
    }

    #[test]
    fn the_code_does_what_the_interpreter_does_where_little_is_wanted(case in cases(false)) {
        compiled(&case)?;
    }

    #[test]
    fn the_code_stops_where_something_changes(case in cases(false)) {
        advanced(&case)?;
    }
}

#[test]
fn a_slab_of_another_length_is_left_alone() {
    let plan = Plan::of(
        &Flat {
            inputs: vec![4],
            ..Flat::default()
        },
        &[],
    );
    let code = Code::compile(&plan, &[]).expect("it compiles");
    let mut slab = vec![3; plan.layout.words as usize + 1];
    code.settle(&mut slab);
    code.edge(&mut slab);
    assert_eq!(code.advance(&mut slab, 7), 0);
    assert!(slab.iter().all(|&word| word == 3));
    assert!(code.size() > 0);
}
