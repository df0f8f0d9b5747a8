//! Circuits in circuits, bundles, aliases, registers that do little.

use super::memories::{self, Memories};
use motion_rtl::kernel::{Circuit, Instance, Nothing};
use motion_rtl::logic::{Bit, Image, Logic, Ram, Sim, Unsigned};
use motion_rtl::signals;

const STATES: &[&str] = &["IDLE", "GO", "HALT"];
const SIDES: &[&str] = &["left", "right"];

signals! {
    /// A bundle.
    pub struct Point<L> { pub x: L::I<9>, pub y: L::I<9> }
}
signals! {
    /// A bundle in a bundle.
    pub struct Line<L> { pub from: Point<L>, pub to: Point<L>, pub drawn: L::Bit }
}

signals! {
    pub struct LeafIn<L> { pub step: L::Bit, pub line: Line<L>, pub spare: L::U<3> }
}
signals! {
    pub struct LeafReg<L> {
        pub count: L::U<6> = 9,
        pub state: L::U<2> as States(STATES) = 1,
        pub stored: Point<L>,
        constant: L::U<5> = 21,
        late: L::Bit,
        store: L::Ram<2, 6>,
    }
}
signals! {
    pub struct LeafNet<L> {
        pub hit: L::Bit,
        pub same: L::U<6>,
        pub delta: Point<L>,
        inner: Line<L>,
    }
}

/// A counter that two parameters and the contents of a memory make different.
#[derive(Debug)]
pub struct Leaf {
    pub limit: u64,
    pub store: Image<2, 6>,
}

impl Circuit for Leaf {
    const NAME: &'static str = "leaf";
    const ABOUT: &'static str = "counts to its limit";
    type In<L: Logic> = LeafIn<L>;
    type Reg<L: Logic> = LeafReg<L>;
    type Net<L: Logic> = LeafNet<L>;

    fn comb<L: Logic>(&self, q: &LeafReg<L>, i: &LeafIn<L>) -> LeafNet<L> {
        let limit = L::parameter::<6>("limit", self.limit);
        let delta = Point {
            x: i.line.to.x - i.line.from.x,
            y: i.line.to.y - i.line.from.y + L::parameter::<9>("offset", self.limit * 3).signed(),
        };
        LeafNet {
            hit: q.count.equals(limit),
            same: q.count,
            inner: Line {
                from: q.stored.clone(),
                to: delta.clone(),
                drawn: q.late,
            },
            delta,
        }
    }

    fn next<L: Logic>(&self, q: LeafReg<L>, w: &LeafNet<L>, i: &LeafIn<L>) -> LeafReg<L> {
        let read = q.store.read(q.state);
        LeafReg {
            count: w.hit.mux(read, i.step.mux(q.count + 1, q.count)),
            state: (i.step & w.hit).mux(q.state + 1, q.state),
            stored: Point {
                x: i.line.drawn.mux(w.delta.x, q.stored.x),
                y: i.line.drawn.mux(w.inner.to.y, q.stored.y),
            },
            constant: q.constant,
            late: i.step,
            store: q.store.write(w.hit, q.state, q.count),
        }
    }

    fn power_on(&self) -> LeafReg<Sim> {
        LeafReg {
            count: 9.into(),
            state: 1.into(),
            stored: Point {
                x: (-7).into(),
                y: 0.into(),
            },
            constant: 21.into(),
            late: false.into(),
            store: self.store.clone().into(),
        }
    }
}

signals! {
    pub struct BranchReg<L> { leaves: [LeafReg<L>; 2] as Elements(SIDES), third: LeafReg<L> }
}
signals! {
    pub struct BranchNet<L> {
        leaves: [Instance<Leaf, L>; 2] as Elements(SIDES),
        third: Instance<Leaf, L>,
        pub any: L::Bit,
        pub total: L::U<6>,
    }
}

/// Three leaves; the third takes what the first two give.
#[derive(Debug)]
pub struct Branch(pub [Leaf; 3]);

impl Circuit for Branch {
    const NAME: &'static str = "branch";
    const ABOUT: &'static str = "three leaves";
    type In<L: Logic> = LeafIn<L>;
    type Reg<L: Logic> = BranchReg<L>;
    type Net<L: Logic> = BranchNet<L>;

    fn comb<L: Logic>(&self, q: &BranchReg<L>, i: &LeafIn<L>) -> BranchNet<L> {
        let left = Instance::settle(&self.0[0], &q.leaves[0], i.clone());
        let inputs = LeafIn {
            step: !i.step,
            line: Line {
                from: left.w.delta.clone(),
                to: q.third.stored.clone(),
                drawn: i.line.drawn & left.w.hit,
            },
            spare: 5.into(),
        };
        let right = Instance::settle(&self.0[1], &q.leaves[1], inputs);
        let inputs = LeafIn {
            step: left.w.hit | right.w.hit,
            line: Line {
                from: left.w.delta.clone(),
                to: right.w.delta.clone(),
                drawn: q.leaves[0].count.bit(3),
            },
            spare: i.spare + 1,
        };
        let third = Instance::settle(&self.0[2], &q.third, inputs);
        BranchNet {
            any: left.w.hit | right.w.hit | third.w.hit,
            total: left.w.same + right.w.same - q.third.count,
            leaves: [left, right],
            third,
        }
    }

    fn next<L: Logic>(&self, q: BranchReg<L>, w: &BranchNet<L>, _: &LeafIn<L>) -> BranchReg<L> {
        let [left, right] = q.leaves;
        BranchReg {
            leaves: [
                w.leaves[0].next(&self.0[0], left),
                w.leaves[1].next(&self.0[1], right),
            ],
            third: w.third.next(&self.0[2], q.third),
        }
    }

    fn power_on(&self) -> BranchReg<Sim> {
        let mut third = self.0[2].power_on();
        // The surrounding circuit knows better what this one starts with.
        third.count = 33.into();
        BranchReg {
            leaves: [self.0[0].power_on(), self.0[1].power_on()],
            third,
        }
    }
}

signals! {
    pub struct TreeIn<L> { pub leaf: LeafIn<L>, pub memory: memories::In<L> }
}
signals! {
    pub struct TreeReg<L> {
        branches: [BranchReg<L>; 2],
        banks: [memories::Reg<L>; 2] as Elements(SIDES),
        pub last: L::Bit = 1,
        free: FreeReg<L>,
    }
}
signals! {
    pub struct TreeNet<L> {
        branches: [Instance<Branch, L>; 2],
        banks: [Instance<Memories, L>; 2] as Elements(SIDES),
        free: Instance<Free, L>,
        pub total: L::U<6>,
        pub word: L::U<9>,
        pub ticks: L::U<12>,
        copy: L::U<9>,
    }
}

signals! {
    pub struct FreeReg<L> { pub ticks: L::U<12> as Analog }
}

/// A counter without inputs and nets.
#[derive(Debug)]
pub struct Free;

impl Circuit for Free {
    const NAME: &'static str = "free";
    const ABOUT: &'static str = "counts every tick";
    type In<L: Logic> = Nothing<L>;
    type Reg<L: Logic> = FreeReg<L>;
    type Net<L: Logic> = Nothing<L>;

    fn comb<L: Logic>(&self, _: &FreeReg<L>, _: &Nothing<L>) -> Nothing<L> {
        Nothing::new()
    }

    fn next<L: Logic>(&self, q: FreeReg<L>, _: &Nothing<L>, _: &Nothing<L>) -> FreeReg<L> {
        FreeReg { ticks: q.ticks + 1 }
    }
}

/// Everything three deep.
#[derive(Debug)]
pub struct Tree {
    branches: [Branch; 2],
    banks: [Memories; 2],
}

impl Tree {
    pub fn new() -> Self {
        let leaf = |limit: u64| Leaf {
            limit,
            // One of them is empty.
            store: Image::new((0..4).map(|word| word * (limit - 3))),
        };
        Tree {
            branches: [
                Branch([leaf(11), leaf(17), leaf(11)]),
                Branch([leaf(40), leaf(3), leaf(63)]),
            ],
            banks: [Memories::new(1), Memories::new(2)],
        }
    }
}

impl Circuit for Tree {
    const NAME: &'static str = "tree";
    const ABOUT: &'static str = "circuits three deep";
    type In<L: Logic> = TreeIn<L>;
    type Reg<L: Logic> = TreeReg<L>;
    type Net<L: Logic> = TreeNet<L>;

    fn comb<L: Logic>(&self, q: &TreeReg<L>, i: &TreeIn<L>) -> TreeNet<L> {
        let settle = |side: usize, i: &LeafIn<L>| {
            Instance::settle(&self.branches[side], &q.branches[side], i.clone())
        };
        let first = settle(0, &i.leaf);
        let step = LeafIn {
            step: first.w.any,
            ..i.leaf.clone()
        };
        let second = settle(1, &step);
        let bank = |side: usize, i: &memories::In<L>| {
            Instance::settle(&self.banks[side], &q.banks[side], i.clone())
        };
        let left = bank(0, &i.memory);
        let inputs = memories::In {
            data: left.w.read_sum,
            ..i.memory.clone()
        };
        let right = bank(1, &inputs);
        TreeNet {
            total: first.w.total + second.w.total,
            word: q.last.mux(left.w.rom_word, right.w.rom_word),
            ticks: q.free.ticks,
            copy: left.w.rom_word,
            branches: [first, second],
            banks: [left, right],
            free: Instance::settle(&Free, &q.free, Nothing::new()),
        }
    }

    fn next<L: Logic>(&self, q: TreeReg<L>, w: &TreeNet<L>, i: &TreeIn<L>) -> TreeReg<L> {
        let [first, second] = q.branches;
        let [left, right] = q.banks;
        TreeReg {
            branches: [
                w.branches[0].next(&self.branches[0], first),
                w.branches[1].next(&self.branches[1], second),
            ],
            banks: [
                w.banks[0].next(&self.banks[0], left),
                w.banks[1].next(&self.banks[1], right),
            ],
            last: i.leaf.step,
            free: w.free.next(&Free, q.free),
        }
    }

    fn power_on(&self) -> TreeReg<Sim> {
        TreeReg {
            branches: [self.branches[0].power_on(), self.branches[1].power_on()],
            banks: [self.banks[0].power_on(), self.banks[1].power_on()],
            last: true.into(),
            free: Free.power_on(),
        }
    }
}
