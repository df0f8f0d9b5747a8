use super::super::alike::{self, Compiled, choosers, common, same, wide};
use super::super::flat::Flat;
use super::super::interpreter::{self, Counts};
use super::super::plan::Plan;
use super::super::random::{Case, cases};
use super::{EDGE, LONG, PART, RUN, SETTLE, encode};
use proptest::prelude::*;
use wasmi::{Engine, Linker, Memory, MemoryType, Module, Store, TypedFunc};

/// Address of the slab in the memory of a test.
const SLAB: usize = 40;

/// Module of a plan on a memory of its own.
struct Instance {
    store: Store<()>,
    memory: Memory,
    run: TypedFunc<(i32, i32, i64), i64>,
}

impl Instance {
    fn new(plan: &Plan, module: &[u8]) -> Self {
        let engine = Engine::default();
        let module = Module::new(&engine, module).expect("it is valid");
        let mut store = Store::new(&engine, ());
        let bytes = SLAB + 8 * plan.layout.words as usize;
        let pages = MemoryType::new(bytes.div_ceil(1 << 16) as u32, None);
        let memory = Memory::new(&mut store, pages).expect("a memory");
        let mut linker = Linker::new(&engine);
        linker.define("env", "memory", memory).expect("once");
        let instance = linker.instantiate_and_start(&mut store, &module);
        let instance = instance.expect("it takes the memory alone");
        let run = instance.get_typed_func(&store, RUN).expect("its entry");
        Instance { store, memory, run }
    }

    fn run(&mut self, slab: &mut [u64], phase: u32, ticks: u64) -> u64 {
        let bytes: Vec<u8> = slab.iter().flat_map(|word| word.to_le_bytes()).collect();
        let memory = self.memory.data_mut(&mut self.store);
        memory.fill(0xa5);
        memory[SLAB..][..bytes.len()].copy_from_slice(&bytes);
        let arguments = (SLAB as i32, phase as i32, ticks as i64);
        let left = self.run.call(&mut self.store, arguments).expect("no trap");
        let memory = self.memory.data(&self.store);
        let (own, others) = memory[SLAB..].split_at(bytes.len());
        let mut others = others.iter().chain(&memory[..SLAB]);
        assert!(others.all(|&byte| byte == 0xa5), "beside the slab");
        for (word, bytes) in slab.iter_mut().zip(own.as_chunks().0) {
            *word = u64::from_le_bytes(*bytes);
        }
        left as u64
    }
}

impl Compiled for Instance {
    fn settle(&mut self, slab: &mut [u64]) {
        assert_eq!(self.run(slab, SETTLE, 1), 0);
    }

    fn edge(&mut self, slab: &mut [u64]) {
        assert_eq!(self.run(slab, EDGE, 0), 0);
    }

    fn advance(&mut self, slab: &mut [u64], ticks: u64) -> u64 {
        ticks - self.run(slab, EDGE, ticks)
    }
}

fn instance(case: &Case, plan: &Plan, part: usize, long: usize) -> Instance {
    let module = encode(plan, &case.hot, part, long).expect("it compiles");
    Instance::new(plan, &module)
}

fn compiled(case: &Case, part: usize, long: usize) -> Result<(), TestCaseError> {
    alike::compiled(case, |plan| instance(case, plan, part, long))
}

proptest! {
    #[test]
    fn a_module_does_what_the_interpreter_does(case in cases(true)) {
        compiled(&case, PART, LONG)?;
    }

    #[test]
    fn a_module_does_what_the_interpreter_does_where_little_is_wanted(case in cases(false)) {
        compiled(&case, PART, LONG)?;
    }

    #[test]
    fn many_functions_do_what_the_interpreter_does(
        case in cases(true),
        part in 1..8usize,
        long in 0..400usize,
    ) {
        compiled(&case, part, long)?;
    }

    #[test]
    fn registers_that_choose_take_old_words(case in choosers()) {
        compiled(&case, PART, LONG)?;
    }

    #[test]
    fn a_module_stops_where_something_changes(case in cases(false)) {
        alike::advanced(&case, |plan| instance(&case, plan, PART, LONG))?;
    }
}

#[test]
fn a_wide_circuit_is_divided_into_functions() {
    let plan = wide(600);
    let hot = [true, true];
    let module = encode(&plan, &hot, PART, LONG).expect("it compiles");
    let mut code = Instance::new(&plan, &module);
    let masks = common(&plan, &hot);
    let mut slab = plan.layout.power_on();
    let mut reference = slab.clone();
    let mut counts = Counts::from(vec![0; plan.blocks.len()]);
    for _ in 0..3 {
        code.settle(&mut slab);
        interpreter::settle(&plan, &mut reference, &mut counts);
        code.edge(&mut slab);
        interpreter::edge(&plan, &mut reference, &mut counts);
        same(&masks, &reference, &slab).expect("the same");
    }
}

#[test]
fn a_plan_with_a_slot_outside_of_its_slab_is_refused() {
    let mut plan = wide(2);
    plan.registers[1].slot = plan.layout.words;
    assert!(encode(&plan, &[], PART, LONG).is_err());
    let whole = Plan::of(&Flat::default(), &[]);
    assert!(encode(&whole, &[], PART, LONG).is_ok());
}
