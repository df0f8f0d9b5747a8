//! A circuit with every kind of leaf there is.

use motion_rtl::kernel::{Circuit, Instance};
use motion_rtl::logic::{Bit, Logic, Ram, ShiftRegister, Signed, Sim, Unsigned};
use motion_rtl::signals;

pub const PHASES: &[&str] = &["IDLE", "RUN", "STOP"];
const AXES: &[&str] = &["left", "right"];

signals! {
    /// Ports in of a part.
    pub struct PartIn<L> { pub step: L::U<3>, pub up: L::Bit }
}
signals! {
    /// Registers of a part.
    pub struct PartReg<L> {
        pub level: L::I<9> as Analog,
        /// Three of four codes have a name.
        pub phase: L::U<2> as States(PHASES),
    }
}
signals! {
    /// Nets of a part.
    pub struct PartNet<L> { next_level: L::I<9>, pub wrapped: L::Bit }
}

#[derive(Debug, Clone)]
pub struct Part;

impl Circuit for Part {
    const NAME: &'static str = "part";
    const ABOUT: &'static str = "goes up and down";
    type In<L: Logic> = PartIn<L>;
    type Reg<L: Logic> = PartReg<L>;
    type Net<L: Logic> = PartNet<L>;

    fn comb<L: Logic>(&self, q: &PartReg<L>, i: &PartIn<L>) -> PartNet<L> {
        let step = i.step.resize::<9>().signed();
        let next_level = i.up.mux(q.level + step, q.level - step);
        let wrapped = next_level.is_negative() ^ q.level.is_negative();
        PartNet {
            next_level,
            wrapped,
        }
    }

    fn next<L: Logic>(&self, q: PartReg<L>, w: &PartNet<L>, _: &PartIn<L>) -> PartReg<L> {
        PartReg {
            level: w.next_level,
            phase: w.wrapped.mux(q.phase + 1, q.phase),
        }
    }
}

signals! {
    /// Ports in.
    pub struct In<L> {
        pub reset: L::Bit,
        pub wide: L::U<64> as Hex,
        pub amount: L::I<12>,
        pub address: L::U<4> as Hex,
        pub write: L::Bit,
    }
}
signals! {
    /// Registers of every kind.
    pub struct Reg<L> {
        pub count: L::U<10> as Analog = 1020,
        held: L::U<64> as Hex = 0xdead_beef,
        /// All ones at first: what a dump may take for nothing yet.
        total: L::I<64> = -1,
        flags: [L::Bit; 3],
        pair: [L::U<5>; 2] as Elements(&["first", "second"]),
        single: L::U<1>,
        axes: [PartReg<L>; 2] as Elements(AXES),
        table: L::Ram<4, 7>,
        large: L::Ram<7, 33>,
        delay: L::ShiftRegister<5, 6>,
    }
}
signals! {
    /// Nets.
    pub struct Net<L> {
        pub read: L::U<7> as Hex,
        tap: L::U<6>,
        axes: [Instance<Part, L>; 2] as Elements(AXES),
        pub busy: L::Bit,
    }
}

#[derive(Debug, Clone)]
pub struct Zoo;

impl Circuit for Zoo {
    const NAME: &'static str = "zoo";
    const ABOUT: &'static str = "has every kind of leaf";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L>, i: &In<L>) -> Net<L> {
        let step = i.wide.resize::<3>();
        let left = Instance::settle(&Part, &q.axes[0], PartIn { step, up: i.write });
        let right = Instance::settle(&Part, &q.axes[1], PartIn { step, up: !i.write });
        Net {
            read: q.table.read(i.address),
            tap: q.delay.stage(4),
            busy: left.w.wrapped | right.w.wrapped,
            axes: [left, right],
        }
    }

    fn next<L: Logic>(&self, q: Reg<L>, w: &Net<L>, i: &In<L>) -> Reg<L> {
        let [left, right] = q.axes;
        let count = q.count + 1;
        Reg {
            count: i.reset.mux(0.into(), count),
            held: i.write.mux(i.wide, q.held),
            total: q.total + i.amount.resize::<64>(),
            flags: [i.reset, q.flags[0], w.busy],
            pair: [q.pair[1], i.wide.resize()],
            single: i.write.word(),
            axes: [w.axes[0].next(&Part, left), w.axes[1].next(&Part, right)],
            table: q.table.write(i.write, i.address, i.wide.resize()),
            large: q.large.write(i.reset, i.wide.resize(), i.wide.resize()),
            delay: q.delay.shift(i.write, i.wide.shift_right(7).resize()),
        }
    }
}

/// Pseudo-random inputs, one a tick (splitmix64).
pub fn inputs(seed: u64) -> impl Iterator<Item = In<Sim>> {
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
            reset: (kind & 15 == 0).into(),
            wide: (random() >> (kind >> 58)).into(),
            amount: (random() as i64).into(),
            address: random().into(),
            write: (kind >> 8 & 3 == 0).into(),
        }
    })
}
