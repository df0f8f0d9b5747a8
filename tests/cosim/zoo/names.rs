//! Names that are good in Verilog and not in VHDL.
#![allow(non_snake_case, reason = "names that differ in the case of letters")]

use motion_rtl::prelude::*;

const PHASES: &[&str] = &["IDLE", "IS", "next-one", "GO"];

/// A counter with keywords as names.
#[derive(Debug, Clone)]
pub struct Entity {
    pub axis: u64,
}

signals! { for (Entity, Outer) as _c;
    /// A bundle whose signals get names that two bundles could have.
    pub struct Pair { pub a: I(4), pub b_: I(4) }
}
signals! { for Entity as _c;
    pub struct In {
        pub signal: Bit,
        pub units: U(3),
        /// The generic has the name of this port.
        pub axis: U(3),
        pub Taken: U(4),
        pub taken: U(4),
        pub port_: Pair(_c),
        pub port: U(2),
    }
    pub struct Reg {
        pub next: U(4) = 5,
        pub process: U(2) as States(PHASES) = 1,
        /// A state has the name of this register.
        process_idle: Bit,
        range__x: U(4),
        unsigned_: U(3),
        is: Ram(2, 3) = &Image::of(2, 3, [1, 7]),
        limit: Shift(3, 3),
    }
    pub struct Net {
        pub resize: U(4),
        pub to: Bit,
        pub subtype: U(3),
        others: U(4),
        pub rtl: I(4),
        pub work: U(3),
    }
}

impl Circuit for Entity {
    const NAME: &'static str = "entity";
    const ABOUT: &'static str = "keywords as names";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let axis = U::parameter("axis", self.axis, 3);
        let wide = U::parameter("wide", self.axis << 40 | 9, 43);
        let here = i.axis.equals(axis) & i.signal;
        let work = q.is.read(i.port);
        let others = q.next + i.Taken - i.taken;
        let net = Net {
            resize: here.mux(others, q.range__x),
            to: q.process.equals(3) | here,
            subtype: q.limit.tap(i.port),
            others,
            rtl: i.port_.a.below(i.port_.b_).mux(i.port_.a, i.port_.b_),
            work: work + wide.slice(40, 3) - axis,
        };
        let next = Reg {
            next: here.mux(q.next + 1, i.Taken),
            process: here.mux(q.process + 1, q.process.equals(2).mux(0, q.process)),
            process_idle: q.process.is_zero(),
            range__x: others ^ i.taken,
            unsigned_: i.units + q.process_idle.word().resize(3),
            is: q.is.write(i.signal, i.port, q.unsigned_),
            limit: q.limit.shift(here, i.units),
        };
        (net, next)
    }
}

/// Two of them.
#[derive(Debug, Clone)]
pub struct Outer;

signals! { for Outer as c;
    pub struct OuterIn { pub buffer: In(&Entity { axis: 0 }), pub select: Bit }
    pub struct OuterParts {
        component: Part<Entity>(Entity { axis: 5 }),
        map: [Part<Entity>(Entity { axis: 2 + k as u64 }); k in 2],
    }
    pub struct OuterNet { pub of: U(4), pub when: U(3), pub open: I(4) }
}

impl Circuit for Outer {
    const NAME: &'static str = "architecture";
    const ABOUT: &'static str = "circuits with keywords as names";
    records!(OuterIn, Nothing, OuterNet, OuterParts);

    fn tick(&self, i: OuterIn, _: Nothing, p: OuterParts) -> (OuterNet, Nothing) {
        let first = p.component.settle(i.buffer.clone());
        let mut of = first.w.resize;
        let mut when = first.w.work;
        let mut open = first.w.rtl;
        for part in p.map {
            let settled = part.settle(In {
                signal: !i.buffer.signal | first.w.to,
                units: when + 1,
                taken: i.select.mux(of, 3),
                ..i.buffer.clone()
            });
            of = of ^ settled.w.resize;
            when = settled.w.subtype + settled.w.work;
            open = open + settled.w.rtl;
        }
        (OuterNet { of, when, open }, Nothing)
    }
}
