mod pair;
mod runs;

use super::{Graph, Prediction};
use crate::engine::flat::{Flat, Id, Instance, Memory, Node, Op, Place, Port, Register};
use crate::engine::interpreter::{self, Counts};
use crate::engine::plan::Plan;

/// Circuit under construction, of one instance.
struct Builder(Flat);

impl Builder {
    fn new() -> Self {
        Builder(Flat {
            instances: vec![Instance {
                path: Vec::new(),
                circuit: "made".to_owned(),
            }],
            ..Flat::default()
        })
    }

    fn node(&mut self, op: Op, width: u8) -> Id {
        let instance = 0;
        self.0.nodes.push(Node {
            op,
            width,
            instance,
        });
        self.0.nodes.len() as Id - 1
    }

    fn constant(&mut self, bits: u64, width: u8) -> Id {
        self.node(Op::Constant(bits), width)
    }

    fn register(&mut self, width: u8, power_on: u64) -> Id {
        let id = self.node(Op::Register(self.0.registers.len() as u32), width);
        self.0.registers.push(Register {
            width,
            power_on,
            next: id,
            instance: 0,
        });
        id
    }

    fn next(&mut self, register: Id, next: Id) {
        if let Op::Register(number) = self.0.node(register).op {
            self.0.registers[number as usize].next = next;
        }
    }

    /// Adds a register that counts by `step`, modulo 2^width.
    fn counter(&mut self, width: u8, power_on: u64, step: u64) -> Id {
        let count = self.register(width, power_on);
        let step = self.constant(step, width);
        let next = self.node(Op::Add(count, step), width);
        self.next(count, next);
        count
    }

    fn watch(mut self, id: Id) -> Flat {
        self.0.leaves.push(Place::Node(id));
        self.0
    }
}

/// Returns by slot if a plan watches it.
fn held(plan: &Plan) -> Vec<bool> {
    let mut held = vec![false; plan.layout.words as usize];
    for watched in &plan.layout.watched {
        held[watched.slot as usize] = true;
    }
    held
}

/// Returns the horizon of a circuit at power-on with all leaves watched.
fn horizon(flat: &Flat, most: u64) -> u64 {
    let plan = Plan::of(flat, &vec![true; flat.leaves.len()]);
    let mut slab = plan.layout.power_on();
    interpreter::settle(
        &plan,
        &mut slab,
        &mut Counts::from(vec![0; plan.blocks.len()]),
    );
    let cold = vec![false; plan.blocks.len()];
    let mut prediction = Prediction::new(&plan, Graph::new(&plan, &held(&plan)).into());
    prediction.horizon(&plan, &cold, &slab, most)
}

#[test]
fn an_enable_counter_up_to_the_tick_of_its_pulse() {
    let mut builder = Builder::new();
    let count = builder.register(8, 3);
    let (one, zero, period) = (
        builder.constant(1, 8),
        builder.constant(0, 8),
        builder.constant(100, 8),
    );
    let sum = builder.node(Op::Add(count, one), 8);
    let below = builder.node(Op::Below(sum, period), 1);
    let next = builder.node(Op::Mux(below, sum, zero), 8);
    builder.next(count, next);
    let pulse = builder.node(Op::Equal(count, zero), 1);
    // 99 is followed by 0: the edges from 3 to 98 are on the line.
    assert_eq!(horizon(&builder.watch(pulse), 1000), 96);
}

#[test]
fn a_down_counter_to_zero() {
    let mut builder = Builder::new();
    let count = builder.register(8, 50);
    let (one, zero, load) = (
        builder.constant(1, 8),
        builder.constant(0, 8),
        builder.constant(77, 8),
    );
    let less = builder.node(Op::Subtract(count, one), 8);
    let end = builder.node(Op::Equal(count, zero), 1);
    let next = builder.node(Op::Mux(end, load, less), 8);
    builder.next(count, next);
    assert_eq!(horizon(&builder.watch(end), 1000), 50);
}

#[test]
fn a_memory_that_is_to_be_written() {
    let mut builder = Builder::new();
    let count = builder.counter(8, 0, 1);
    let limit = builder.constant(20, 8);
    let enable = builder.node(Op::Equal(count, limit), 1);
    let address = builder.constant(1, 2);
    let mut flat = builder.0;
    flat.memories.push(Memory {
        width: 8,
        contents: vec![0; 4],
        port: Port::Ram {
            enable,
            address,
            data: count,
        },
        instance: 0,
    });
    assert_eq!(horizon(&flat, 1000), 20);
    // The tick itself cannot be jumped over, nor can a shift register.
    flat.registers[0].power_on = 20;
    assert_eq!(horizon(&flat, 1000), 0);
    flat.registers[0].power_on = 3;
    flat.memories[0].port = Port::Shift {
        enable,
        data: count,
    };
    assert_eq!(horizon(&flat, 1000), 17);
    flat.registers[0].power_on = 20;
    assert_eq!(horizon(&flat, 1000), 0);
}

#[test]
fn a_memory_read_at_a_moving_address() {
    let mut builder = Builder::new();
    builder.0.memories.push(Memory {
        width: 8,
        contents: vec![7, 7, 7, 9],
        port: Port::Rom,
        instance: 0,
    });
    let count = builder.counter(2, 0, 1);
    let word = builder.node(Op::Read(0, count), 8);
    assert!(horizon(&builder.watch(word), 1000) <= 3);
}

#[test]
fn a_counter_that_wraps_around() {
    let mut builder = Builder::new();
    let count = builder.counter(4, 13, 1);
    let limit = builder.constant(12, 4);
    let below = builder.node(Op::Below(count, limit), 1);
    assert_eq!(horizon(&builder.watch(below), 1000), 3);
    // Zero extension: the word leaves the line when the counter wraps.
    let mut builder = Builder::new();
    let count = builder.counter(4, 13, 1);
    let wide = builder.node(Op::Extend(count), 8);
    let limit = builder.constant(100, 8);
    let sum = builder.node(Op::Add(wide, limit), 8);
    let limit = builder.constant(101, 8);
    let below = builder.node(Op::Below(sum, limit), 1);
    assert_eq!(horizon(&builder.watch(below), 1000), 3);
}

#[test]
fn signed_words_across_the_sign() {
    let below = |power_on: u64, step: u64, limit: u64| {
        let mut builder = Builder::new();
        let count = builder.counter(8, power_on & 0xff, step & 0xff);
        let limit = builder.constant(limit & 0xff, 8);
        let below = builder.node(Op::BelowSigned(count, limit), 1);
        horizon(&builder.watch(below), 1000)
    };
    assert_eq!(below(-5i64 as u64, 1, 0), 5);
    assert_eq!(below(5, -1i64 as u64, 0), 6);
    // From 127 to -128.
    assert_eq!(below(120, 1, 100), 8);
    let mut builder = Builder::new();
    let count = builder.counter(8, 0xfb, 1);
    let wide = builder.node(Op::ExtendSigned(count), 16);
    let zero = builder.constant(0, 16);
    let equal = builder.node(Op::Equal(wide, zero), 1);
    assert_eq!(horizon(&builder.watch(equal), 1000), 5);
}

#[test]
fn equality_met_exactly_or_passed_over() {
    let meets = |power_on: u64, step: u64, with: u64| {
        let mut builder = Builder::new();
        let count = builder.counter(8, power_on, step);
        let with = builder.constant(with, 8);
        let equal = builder.node(Op::Equal(count, with), 1);
        horizon(&builder.watch(equal), 1000)
    };
    assert_eq!(meets(1, 3, 10), 3);
    // The third round meets 11: 1 + 3 * 174 = 2 * 256 + 11.
    assert_eq!(meets(1, 3, 11), 174);
    assert_eq!(meets(1, 2, 10), 1000);
    assert_eq!(meets(7, 2, 7), 0);
    assert_eq!(meets(9, 255, 4), 5);
}

#[test]
fn inputs_stay_for_so_many_ticks_at_most() {
    let mut builder = Builder::new();
    let count = builder.counter(8, 0, 1);
    let limit = builder.constant(200, 8);
    let below = builder.node(Op::Below(count, limit), 1);
    let flat = builder.watch(below);
    assert_eq!(horizon(&flat, 7), 7);
    assert_eq!(horizon(&flat, 1), 1);
    assert_eq!(horizon(&flat, 0), 0);
    // Nothing moves.
    let mut builder = Builder::new();
    let still = builder.register(8, 3);
    assert_eq!(horizon(&builder.watch(still), 9), 9);
}

#[test]
fn what_is_watched_ends_a_line_where_it_moves() {
    let mut builder = Builder::new();
    let count = builder.counter(8, 0, 1);
    assert!(horizon(&builder.watch(count), 1000) <= 1);
    let mut builder = Builder::new();
    let count = builder.counter(8, 0, 1);
    let one = builder.constant(1, 8);
    let net = builder.node(Op::Add(count, one), 8);
    assert!(horizon(&builder.watch(net), 1000) <= 1);
    // The upper bits move rarely.
    let mut builder = Builder::new();
    let count = builder.counter(8, 5, 1);
    let high = builder.node(Op::Slice(count, 5), 3);
    assert_eq!(horizon(&builder.watch(high), 1000), 27);
}

#[test]
fn two_counters_at_different_speeds() {
    let mut builder = Builder::new();
    let (one, other) = (builder.counter(16, 0, 5), builder.counter(16, 100, 2));
    let below = builder.node(Op::Below(one, other), 1);
    // 5 * 34 is not below 100 + 2 * 34.
    assert_eq!(horizon(&builder.watch(below), 1000), 34);
    let mut builder = Builder::new();
    let (one, other) = (builder.counter(16, 0, 5), builder.counter(16, 100, 2));
    let below = builder.node(Op::Below(other, one), 1);
    assert_eq!(horizon(&builder.watch(below), 1000), 34);
}

#[test]
fn a_multiplied_counter() {
    let mut builder = Builder::new();
    let count = builder.counter(16, 0, 1);
    let (three, limit) = (builder.constant(3, 16), builder.constant(100, 16));
    let product = builder.node(Op::Multiply(count, three), 16);
    let below = builder.node(Op::Below(product, limit), 1);
    assert_eq!(horizon(&builder.watch(below), 1000), 34);
    let mut builder = Builder::new();
    let count = builder.counter(16, 1, 1);
    let limit = builder.constant(100, 16);
    let square = builder.node(Op::Multiply(count, count), 16);
    let below = builder.node(Op::Below(square, limit), 1);
    assert!(horizon(&builder.watch(below), 1000) <= 9);
}

#[test]
fn an_arm_that_is_not_taken_ends_nothing() {
    let mut builder = Builder::new();
    let count = builder.counter(8, 0, 1);
    let taken = builder.register(1, 0);
    let limit = builder.constant(20, 8);
    let soon = builder.node(Op::Below(count, limit), 1);
    let (gated, chosen) = (
        builder.node(Op::And(soon, taken), 1),
        builder.node(Op::Mux(taken, soon, taken), 1),
    );
    let sum = builder.node(Op::Xor(gated, chosen), 1);
    assert_eq!(horizon(&builder.watch(sum), 200), 200);
}

#[test]
fn both_of_two_conditions_or_one() {
    type Two = fn(Id, Id) -> Op;
    let turned: [Two; 2] = [
        |one, other| Op::And(other, one),
        |one, other| Op::Or(other, one),
    ];
    for (ops, wanted) in [([Op::And, turned[0]], 30), ([Op::Or, turned[1]], 40)] {
        for op in ops {
            let mut builder = Builder::new();
            let count = builder.counter(8, 0, 1);
            let (low, high) = (builder.constant(30, 8), builder.constant(40, 8));
            let (one, other) = (
                builder.node(Op::Below(count, low), 1),
                builder.node(Op::Below(count, high), 1),
            );
            let both = builder.node(op(one, other), 1);
            assert_eq!(horizon(&builder.watch(both), 200), wanted);
        }
    }
}

#[test]
fn a_choice_that_moves() {
    let mut builder = Builder::new();
    let count = builder.counter(8, 0, 1);
    let odd = builder.node(Op::Slice(count, 0), 1);
    let (one, other) = (builder.register(8, 3), builder.register(8, 4));
    let chosen = builder.node(Op::Mux(odd, one, other), 8);
    assert!(horizon(&builder.watch(chosen), 1000) <= 1);
}

#[test]
fn a_choice_in_the_same_choice() {
    let mut builder = Builder::new();
    let up = builder.register(1, 1);
    let count = builder.register(8, 0);
    let (one, limit) = (builder.constant(1, 8), builder.constant(20, 8));
    let (more, less) = (
        builder.node(Op::Add(count, one), 8),
        builder.node(Op::Subtract(count, one), 8),
    );
    let inner = builder.node(Op::Mux(up, more, less), 8);
    let next = builder.node(Op::Mux(up, inner, count), 8);
    builder.next(count, next);
    let below = builder.node(Op::Below(count, limit), 1);
    assert_eq!(horizon(&builder.watch(below), 1000), 20);
}
