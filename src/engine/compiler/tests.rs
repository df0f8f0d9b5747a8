use super::super::flat::{Flat, Instance, Memory, Node, Op, Place, Port, Register, mask};
use super::super::interpreter::{self, Counts};
use super::super::layout::Spot;
use super::super::passes;
use super::super::plan::Plan;
use super::super::random::{Case, Hold, Plain, cases};
use super::{Code, CompileError, FRAME, PART};
use proptest::collection::vec;
use proptest::prelude::*;

/// Returns a leaf or, after the leaves, a property, if the slab has it.
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

/// Returns masks of the bits that both backends must leave equal: all but the words of steps and
/// the bits of hot blocks.
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

/// Clears the change marks, as an observer does.
fn seen(plan: &Plan, slab: &mut [u64]) {
    let layout = &plan.layout;
    slab[layout.event as usize] = 0;
    slab[layout.changed as usize..][..layout.changed_words as usize].fill(0);
}

/// Compares the interpreter, with and without passes, with the evaluation of every node in every
/// tick.
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
                    // Properties have no change marks.
                    if index < flat.leaves.len() {
                        prop_assert!(before.is_none_or(|before| before == value) || event);
                    }
                }
            }
        }
    }
    Ok(())
}

/// Compares compiled code, in parts of `part` words, with the interpreter.
fn compiled(case: &Case, part: usize, single_pass: bool) -> Result<(), TestCaseError> {
    let plan = Plan::of(&case.flat, &case.wanted);
    let code = Code::in_parts(&plan, &case.hot, part, single_pass).expect("it compiles");
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

/// Adds a node to the outermost circuit; returns its index.
fn add(nodes: &mut Vec<Node>, op: Op, width: u8) -> u32 {
    nodes.push(Node {
        op,
        width,
        instance: 0,
    });
    nodes.len() as u32 - 1
}

/// Returns a circuit of registers that choose among words, a memory that some of them read, and a
/// register of another block. The seeds of a register are a tree of choices.
fn chooser(width: u8, seeds: &[Vec<u8>]) -> Flat {
    let mut flat = Flat {
        inputs: vec![1, 1, 1, width],
        instances: [vec![], vec!["far".to_owned()]]
            .map(|path| Instance {
                path,
                circuit: "chooser".to_owned(),
            })
            .to_vec(),
        ..Flat::default()
    };
    let mut add = |op, width| add(&mut flat.nodes, op, width);
    let ports = [0, 1, 2].map(|port| add(Op::Input(port), 1));
    let inverted = ports.map(|port| add(Op::Not(port), 1));
    let mut ons = [ports, inverted].concat();
    ons.push(add(Op::Constant(1), 1));
    let one = add(Op::Constant(1), width);
    let mut words = vec![add(Op::Input(3), width)];
    words.extend((0..=seeds.len()).map(|register| add(Op::Register(register as u32), width)));
    let far = words[words.len() - 1];
    words.push(add(Op::Add(words[1], one), width));
    words.push(add(Op::Add(words[1], words[2]), width));
    words.push(add(Op::Read(0, words[2]), width));
    ons.push(add(Op::Slice(words[1], 0), 1));
    ons.push(add(Op::Below(words[2], words[1]), 1));
    let of = |list: &[u32], seed: u8| list[usize::from(seed) % list.len()];
    for seeds in seeds {
        // From the leaves to the root.
        let mut level: Vec<u32> = seeds[..8].iter().map(|&seed| of(&words, seed)).collect();
        for depth in [8, 12, 14] {
            let sides = level.chunks(2).zip(&seeds[depth..]);
            let choices = sides.map(|(sides, &seed)| match seed % 4 {
                0 => sides[0],
                _ => add(Op::Mux(of(&ons, seed / 4), sides[0], sides[1]), width),
            });
            level = choices.collect();
        }
        flat.registers.push(Register {
            width,
            power_on: 0,
            next: level[0],
            instance: 0,
        });
    }
    flat.nodes.push(Node {
        op: Op::Mux(ports[1], words[1], far),
        width,
        instance: 1,
    });
    flat.registers.push(Register {
        width,
        power_on: 1,
        next: flat.nodes.len() as u32 - 1,
        instance: 1,
    });
    flat.memories.push(Memory {
        width,
        contents: vec![0; 4],
        port: Port::Ram {
            enable: ons[0],
            address: words[1],
            data: words[words.len() - 1],
        },
        instance: 0,
    });
    let registers = (0..=seeds.len()).map(|register| Place::Register(register as u32));
    flat.leaves = registers
        .chain((0..4).map(|word| Place::Word(0, word)))
        .collect();
    flat
}

fn choosers() -> impl Strategy<Value = Case> {
    let seeds = vec(vec(any::<u8>(), 15), 2..6);
    let hold = (vec((0..4usize, any::<u64>()), 0..4), 0..4u64);
    (1..6u8, seeds, vec(hold, 8), any::<[bool; 8]>()).prop_map(|(width, seeds, holds, hot)| {
        let flat = chooser(width, &seeds);
        let held = holds.into_iter().map(|(changes, ticks)| {
            let fit = |(port, word): (usize, u64)| (port, word & mask(flat.inputs[port]));
            let changes = changes.into_iter().map(fit).collect();
            Hold { changes, ticks }
        });
        Case {
            stimulus: held.collect(),
            wanted: vec![true; flat.leaves.len()],
            hot: hot.to_vec(),
            flat,
        }
    })
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
        compiled(&case, PART, false)?;
    }

    #[test]
    fn the_code_does_what_the_interpreter_does_where_little_is_wanted(case in cases(false)) {
        compiled(&case, PART, false)?;
    }

    #[test]
    fn code_in_parts_does_what_the_interpreter_does(
        case in cases(true),
        part in 1..8usize,
        single_pass: bool,
    ) {
        compiled(&case, part, single_pass)?;
    }

    #[test]
    fn registers_that_choose_take_old_words(case in choosers()) {
        compiled(&case, PART, false)?;
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
    assert!(code.size > 0);
}

/// Returns a circuit of `count` registers that each take a mixture of others, all watched.
fn registers(count: u32) -> Flat {
    let node = |op, width| Node {
        op,
        width,
        instance: 0,
    };
    let mut flat = Flat {
        inputs: vec![16],
        instances: vec![Instance {
            path: Vec::new(),
            circuit: "wide".to_owned(),
        }],
        ..Flat::default()
    };
    flat.nodes.push(node(Op::Input(0), 16));
    flat.nodes
        .extend((0..count).map(|number| node(Op::Register(number), 16)));
    let held = |number: u32| 1 + number % count;
    for number in 0..count {
        let sum = flat.nodes.len() as u32;
        let mixed = [
            node(Op::Add(held(number), held(number * 7 + 1)), 16),
            node(Op::Xor(sum, held(number + count / 2)), 16),
            node(Op::Below(sum, 0), 1),
            node(Op::Mux(sum + 2, sum + 1, held(number + 1)), 16),
        ];
        flat.nodes.extend(mixed);
        flat.registers.push(Register {
            width: 16,
            power_on: u64::from(number),
            next: sum + 3,
            instance: 0,
        });
    }
    flat.leaves = (0..count).map(Place::Register).collect();
    flat
}

fn wide(count: u32) -> Plan {
    Plan::of(&registers(count), &vec![true; count as usize])
}

/// Returns the CPU time of this thread in nanoseconds.
#[cfg(target_os = "linux")]
fn run_for() -> u64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").expect("Linux has it");
    let first = text.split(' ').next().expect("there are three numbers");
    first.parse().expect("a number")
}

#[test]
#[cfg(target_os = "linux")]
#[ignore = "takes long, and other programs beside it count"]
fn a_register_takes_as_long_to_compile_in_a_wide_circuit() {
    let time = |count: u32| {
        let plan = wide(count);
        let start = run_for();
        Code::compile(&plan, &[true, true]).expect("it compiles");
        (run_for() - start) / u64::from(count)
    };
    let few = time(250).min(time(250)).min(time(250));
    for count in [500, 1000, 2000, 4000, 8000] {
        let each = time(count);
        println!("{count} registers: {each} ns each, {few} of 250");
        assert!(each <= 2 * few, "{count}: {each} ns, {few} of 250");
    }
    assert!(time(8000) * 8000 <= 2_000_000_000);
}

/// Two registers that exchange their words by every one of many select signals: 2^30 paths.
#[test]
fn code_grows_with_the_steps_and_not_with_the_paths() {
    let size = |stages: u32, registers: u32| {
        let mut flat = Flat {
            inputs: vec![1; stages as usize],
            instances: vec![Instance {
                path: Vec::new(),
                circuit: "exchanges".to_owned(),
            }],
            ..Flat::default()
        };
        let mut add = |op, width| add(&mut flat.nodes, op, width);
        let ons: Vec<u32> = (0..stages).map(|port| add(Op::Input(port), 1)).collect();
        let words: Vec<u32> = (0..registers)
            .map(|number| add(Op::Register(number), 8))
            .collect();
        let mut pair = [words[0], words[1]];
        for &on in &ons {
            let [one, other] = pair;
            pair = [
                add(Op::Mux(on, one, other), 8),
                add(Op::Mux(on, other, one), 8),
            ];
        }
        for number in 0..registers {
            let next = match number {
                0 | 1 => pair[number as usize],
                // Each has the whole tree on one side of a choice of its own.
                _ => {
                    let on = ons[number as usize % ons.len()];
                    let own = add(Op::Add(words[number as usize], words[0]), 8);
                    add(Op::Mux(on, pair[0], own), 8)
                }
            };
            flat.registers.push(Register {
                width: 8,
                power_on: number.into(),
                next,
                instance: 0,
            });
        }
        flat.leaves = (0..registers).map(Place::Register).collect();
        let plan = Plan::of(&flat, &vec![true; registers as usize]);
        Code::compile(&plan, &[]).expect("it compiles").size
    };
    assert!(size(30, 2) < 20_000, "{}", size(30, 2));
    assert!(size(20, 30) < 100_000, "{}", size(20, 30));
}

#[test]
fn code_that_takes_too_much_of_the_stack_is_refused() {
    let plan = wide(17_000);
    let refused = Code::compile(&plan, &[true, true]).expect_err("its frame is larger");
    let CompileError::Frame(bytes) = refused else {
        panic!("{refused}");
    };
    assert!(bytes > FRAME);
}

#[test]
fn a_wide_circuit_runs_on_a_small_stack() {
    // With a single pass, its frame has 32 bytes per register.
    for (count, single_pass) in [(2000, false), (200, true)] {
        let plan = wide(count);
        let hot = [true, true];
        let code = Code::in_parts(&plan, &hot, PART, single_pass).expect("it compiles");
        let masks = common(&plan, &hot);
        let mut slab = plan.layout.power_on();
        let mut reference = slab.clone();
        std::thread::scope(|scope| {
            let small = std::thread::Builder::new().stack_size(16 * 1024);
            let run = || {
                code.settle(&mut slab);
                code.edge(&mut slab);
            };
            small.spawn_scoped(scope, run).expect("a thread");
        });
        let mut counts = Counts::from(vec![0; plan.blocks.len()]);
        interpreter::settle(&plan, &mut reference, &mut counts);
        interpreter::edge(&plan, &mut reference, &mut counts);
        same(&masks, &reference, &slab).expect("the same");
    }
}
