//! Circuits in circuits, bundles, aliases, registers that do little.

use super::memories::{self, In as BankIn, Memories};
use motion_rtl::prelude::*;

const STATES: &[&str] = &["IDLE", "GO", "HALT"];
const SIDES: &[&str] = &["left", "right"];

/// A counter that two parameters and the contents of a memory make different.
#[derive(Debug, Clone)]
pub struct Leaf {
    /// What it counts from.
    pub starts: u64,
    pub limit: u64,
    pub store: Image,
}

signals! { for (Leaf, Branch, Tree) as c;
    /// A bundle.
    pub struct Point { pub x: I(9), pub y: I(9) }
    /// A bundle in a bundle.
    pub struct Line { pub from: Point(c), pub to: Point(c), pub drawn: Bit }
    pub struct LeafIn { pub step: Bit, pub line: Line(c), pub spare: U(3) }
}
signals! { for Leaf as c;
    pub struct Stored { pub x: I(9) = -7, pub y: I(9) }
    pub struct LeafReg {
        pub count: U(6) = c.starts,
        pub state: U(2) as States(STATES) = 1,
        pub stored: Stored(c),
        constant: U(5) = 21,
        late: Bit,
        store: Ram(2, 6) = &c.store,
    }
    pub struct LeafNet {
        pub hit: Bit,
        pub same: U(6),
        pub delta: Point(c),
        inner: Line(c),
    }
}

impl Circuit for Leaf {
    const NAME: &'static str = "leaf";
    const ABOUT: &'static str = "counts to its limit";
    records!(LeafIn, LeafReg, LeafNet);

    fn tick(&self, i: LeafIn, q: LeafReg, _: Nothing) -> (LeafNet, LeafReg<Edge>) {
        let limit = U::parameter("limit", self.limit, 6);
        let offset = U::parameter("offset", self.limit * 3, 9).signed();
        let delta = Point {
            x: i.line.to.x - i.line.from.x,
            y: i.line.to.y - i.line.from.y + offset,
        };
        let hit = q.count.equals(limit);
        let read = q.store.read(q.state);
        let next = LeafReg {
            count: hit.mux(read, i.step.mux(q.count + 1, q.count)),
            state: (i.step & hit).mux(q.state + 1, q.state),
            stored: Stored {
                x: i.line.drawn.mux(delta.x, q.stored.x),
                y: i.line.drawn.mux(delta.y, q.stored.y),
            },
            constant: q.constant,
            late: i.step,
            store: q.store.write(hit, q.state, q.count),
        };
        let net = LeafNet {
            hit,
            same: q.count,
            inner: Line {
                from: Point {
                    x: q.stored.x,
                    y: q.stored.y,
                },
                to: delta.clone(),
                drawn: q.late,
            },
            delta,
        };
        (net, next)
    }
}

/// Three leaves; the third takes what the first two give.
#[derive(Debug, Clone)]
pub struct Branch(pub [Leaf; 3]);

impl Branch {
    /// The third leaf: the surrounding circuit knows better what it starts with.
    fn third(&self) -> Leaf {
        Leaf {
            starts: 33,
            ..self.0[2].clone()
        }
    }
}

signals! { for Branch as c;
    pub struct BranchParts {
        leaves: [Part<Leaf>(c.0[k].clone()); k in 2] as Elements(SIDES),
        third: Part<Leaf>(c.third()),
    }
    pub struct BranchNet {
        pub any: Bit,
        pub total: U(6),
    }
}

impl Circuit for Branch {
    const NAME: &'static str = "branch";
    const ABOUT: &'static str = "three leaves";
    records!(LeafIn, Nothing, BranchNet, BranchParts);

    fn tick(&self, i: LeafIn, _: Nothing, p: BranchParts) -> (BranchNet, Nothing) {
        let stored = Point {
            x: p.third.q.stored.x,
            y: p.third.q.stored.y,
        };
        let mut leaves = p.leaves.into_iter();
        let (left, right) = (leaves.next().expect("two"), leaves.next().expect("two"));
        let left = left.settle(i.clone());
        let right = right.settle(LeafIn {
            step: !i.step,
            line: Line {
                from: left.w.delta.clone(),
                to: stored,
                drawn: i.line.drawn & left.w.hit,
            },
            spare: U::new(5, 3),
        });
        let third = p.third.settle(LeafIn {
            step: left.w.hit | right.w.hit,
            line: Line {
                from: left.w.delta,
                to: right.w.delta,
                drawn: left.q.count.bit(3),
            },
            spare: i.spare + 1,
        });
        let net = BranchNet {
            any: left.w.hit | right.w.hit | third.w.hit,
            total: left.w.same + right.w.same - third.q.count,
        };
        (net, Nothing)
    }
}

/// A counter without inputs and nets.
#[derive(Debug, Clone)]
pub struct Free;

signals! { for Free as _c;
    pub struct FreeReg { pub ticks: U(12) as Analog }
}

impl Circuit for Free {
    const NAME: &'static str = "free";
    const ABOUT: &'static str = "counts every tick";
    records!(Nothing, FreeReg, Nothing);

    fn tick(&self, _: Nothing, q: FreeReg, _: Nothing) -> (Nothing, FreeReg<Edge>) {
        (Nothing, FreeReg { ticks: q.ticks + 1 })
    }
}

choice! {
    /// What stands beside the banks.
    pub enum Beside as BesidePart {
        /// A counter.
        Free(Free),
        /// A leaf that always steps.
        Leaf(Leaf),
    }
}

/// Everything three deep.
#[derive(Debug, Clone)]
pub struct Tree {
    branches: [Branch; 2],
    banks: [Memories; 2],
    beside: [Beside; 2],
}

impl Tree {
    pub fn new() -> Self {
        let leaf = |limit: u64| Leaf {
            starts: 9,
            limit,
            // One of them is empty.
            store: Image::of(2, 6, (0..4).map(|word: u64| (word * (limit - 3)).cut(6))),
        };
        Tree {
            branches: [
                Branch([leaf(11), leaf(17), leaf(11)]),
                Branch([leaf(40), leaf(3), leaf(63)]),
            ],
            banks: [Memories::new(1), Memories::new(2)],
            beside: [Beside::Free(Free), Beside::Leaf(leaf(20))],
        }
    }
}

signals! { for Tree as c;
    pub struct TreeIn { pub leaf: LeafIn(c), pub memory: BankIn(&c.banks[0]) }
    pub struct TreeReg { pub last: Bit = 1 }
    pub struct TreeParts {
        branches: [Part<Branch>(c.branches[k].clone()); k in 2],
        banks: [Part<Memories>(c.banks[k].clone()); k in 2] as Elements(SIDES),
        free: BesidePart(&c.beside[0]),
        other: BesidePart(&c.beside[1]),
    }
    pub struct TreeNet {
        pub total: U(6),
        pub word: U(9),
        pub ticks: U(12),
        copy: U(9),
    }
}

/// What one of the two gives.
fn beside(part: BesidePart, i: &LeafIn) -> U {
    match part {
        BesidePart::Free(part) => part.settle(Nothing).q.ticks,
        BesidePart::Leaf(part) => {
            let i = LeafIn {
                step: Bit::high(),
                ..i.clone()
            };
            part.settle(i).w.same.resize(12)
        }
    }
}

impl Circuit for Tree {
    const NAME: &'static str = "tree";
    const ABOUT: &'static str = "circuits three deep";
    records!(TreeIn, TreeReg, TreeNet, TreeParts);

    fn tick(&self, i: TreeIn, q: TreeReg, p: TreeParts) -> (TreeNet, TreeReg<Edge>) {
        // Each takes something from the one before it.
        let mut step = i.leaf.step;
        let mut total = U::new(0, 6);
        for branch in p.branches {
            let leaf = LeafIn {
                step,
                ..i.leaf.clone()
            };
            let settled = branch.settle(leaf);
            step = settled.w.any;
            total = total + settled.w.total;
        }
        let mut data = i.memory.data;
        let mut words = Vec::new();
        for bank in p.banks {
            let memory = memories::In {
                data,
                ..i.memory.clone()
            };
            let settled = bank.settle(memory);
            data = settled.w.read_sum;
            words.push(settled.w.rom_word);
        }
        let ticks = beside(p.free, &i.leaf) - beside(p.other, &i.leaf);
        let net = TreeNet {
            total,
            word: q.last.mux(words[0], words[1]),
            ticks,
            copy: words[0],
        };
        (net, TreeReg { last: i.leaf.step })
    }
}
