use super::super::alike::{self, Compiled, add, choosers, common, put, same, seen, wide};
use super::super::flat::{Flat, Instance, Op, Place, Register};
use super::super::interpreter::{self, Counts};
use super::super::layout::Spot;
use super::super::passes;
use super::super::plan::Plan;
use super::super::random::{Case, Plain, cases};
use super::{Code, CompileError, FRAME, PART};
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

impl Compiled for Code {
    fn settle(&mut self, slab: &mut [u64]) {
        Code::settle(self, slab);
    }

    fn edge(&mut self, slab: &mut [u64]) {
        Code::edge(self, slab);
    }

    fn advance(&mut self, slab: &mut [u64], ticks: u64) -> u64 {
        Code::advance(self, slab, ticks)
    }
}

/// Compares code in parts of `part` words with the interpreter.
fn compiled(case: &Case, part: usize, single_pass: bool) -> Result<(), TestCaseError> {
    alike::compiled(case, |plan| {
        Code::in_parts(plan, &case.hot, part, single_pass).expect("it compiles")
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
        alike::advanced(&case, |plan| Code::compile(plan, &case.hot).expect("it compiles"))?;
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
