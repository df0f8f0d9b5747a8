//! A circuit with every kind of leaf there is.

use motion_rtl::prelude::*;

pub const PHASES: &[&str] = &["IDLE", "RUN", "STOP"];
const AXES: &[&str] = &["left", "right"];

#[derive(Debug, Clone)]
pub struct Part;

signals! { for Part as _c;
    /// Ports in of a part.
    pub struct PartIn { pub step: U(3), pub up: Bit }
    /// Registers of a part.
    pub struct PartReg {
        pub level: I(9) as Analog,
        /// Three of four codes have a name.
        pub phase: U(2) as States(PHASES),
    }
    /// Nets of a part.
    pub struct PartNet { next_level: I(9), pub wrapped: Bit }
}

impl Circuit for Part {
    const NAME: &'static str = "part";
    const ABOUT: &'static str = "goes up and down";
    records!(PartIn, PartReg, PartNet);

    fn tick(&self, i: PartIn, q: PartReg, _: Nothing) -> (PartNet, PartReg<Edge>) {
        let step = i.step.resize(9).signed();
        let next_level = i.up.mux(q.level + step, q.level - step);
        let wrapped = next_level.is_negative() ^ q.level.is_negative();
        let next = PartReg {
            level: next_level,
            phase: wrapped.mux(q.phase + 1, q.phase),
        };
        (
            PartNet {
                next_level,
                wrapped,
            },
            next,
        )
    }
}

#[derive(Debug, Clone)]
pub struct Zoo;

signals! { for Zoo as _c;
    /// Ports in.
    pub struct In {
        pub reset: Bit,
        pub wide: U(64) as Hex,
        pub amount: I(12, 5),
        pub address: U(4) as Hex,
        pub write: Bit,
    }
    /// Registers of every kind.
    pub struct Reg {
        pub count: U(10, 2) as Analog = 1020,
        held: U(64) as Hex = 0xdead_beef_u64,
        /// All ones at first: what a dump may take for nothing yet.
        total: I(64) = -1,
        flags: [Bit; 3],
        pair: [U(5); 2] as Elements(&["first", "second"]),
        single: U(1),
        store: Ram(4, 7),
        great: Ram(7, 33),
        delay: Shift(5, 6),
    }
    /// Parts.
    pub struct Parts { axes: [Part<Part>(Part); 2] as Elements(AXES) }
    /// Nets.
    pub struct Net {
        pub read: U(7) as Hex,
        tap: U(6),
        pub busy: Bit,
    }
}

impl Circuit for Zoo {
    const NAME: &'static str = "zoo";
    const ABOUT: &'static str = "has every kind of leaf";
    records!(In, Reg, Net, Parts);

    fn tick(&self, i: In, q: Reg, p: Parts) -> (Net, Reg<Edge>) {
        let step = i.wide.slice(0, 3);
        let axes = settle_each(p.axes, |axis| PartIn {
            step,
            up: i.write ^ (axis == 1),
        });
        let net = Net {
            read: q.store.read(i.address),
            tap: q.delay.stage(4),
            busy: axes[0].w.wrapped | axes[1].w.wrapped,
        };
        let next = Reg {
            count: i.reset.mux(0, q.count + 1),
            held: i.write.mux(i.wide, q.held),
            total: q.total + i.amount.resize(64),
            flags: vec![i.reset, q.flags[0], net.busy],
            pair: vec![q.pair[1], i.wide.resize(5)],
            single: i.write.word(),
            store: q.store.write(i.write, i.address, i.wide.resize(7)),
            great: q.great.write(i.reset, i.wide.resize(7), i.wide.resize(33)),
            delay: q.delay.shift(i.write, i.wide.slice(7, 6)),
        };
        (net, next)
    }
}

/// The words of inputs, each as wide as its port.
pub fn words(i: &In<Value>) -> Vec<u64> {
    let amount = (i.amount as u64).cut(12);
    vec![i.reset.into(), i.wide, amount, i.address, i.write.into()]
}

/// Pseudo-random inputs, one a tick (splitmix64).
pub fn inputs(seed: u64) -> impl Iterator<Item = In<Value>> {
    let mut state = seed;
    let mut random = move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    std::iter::repeat_with(move || {
        let kind = random();
        In {
            reset: kind & 15 == 0,
            wide: random() >> (kind >> 58),
            amount: (random() as i64).cut(12),
            address: random().cut(4),
            write: kind >> 8 & 3 == 0,
        }
    })
}
