//! Small circuits.

use motion_rtl::check::SamePorts;
use motion_rtl::kernel::Circuit;
use motion_rtl::logic::{Bit, Image, Logic, Ram, ShiftRegister, Signed, Unsigned};
use motion_rtl::signals;

/// Writes the head of a circuit whose three structs are `$In`, `$Reg` and `$Net`.
macro_rules! parts {
    ($name:literal, $in:ident, $reg:ident, $net:ident) => {
        const NAME: &'static str = $name;
        const ABOUT: &'static str = "a circuit to be checked";
        type In<L: Logic> = $in<L>;
        type Reg<L: Logic> = $reg<L>;
        type Net<L: Logic> = $net<L>;
    };
}

signals! { pub struct Enable<L> { pub enable: L::Bit } }
signals! { pub struct UpReg<L> { pub count: L::U<4> } }
signals! { pub struct UpNet<L> { pub last: L::Bit, carry: L::Bit } }

/// Counts modulo `n`.
#[derive(Debug)]
pub struct Up {
    pub n: u64,
}

impl Circuit for Up {
    parts!("modulo", Enable, UpReg, UpNet);
    fn comb<L: Logic>(&self, q: &UpReg<L>, i: &Enable<L>) -> UpNet<L> {
        let last = q.count.equals((self.n - 1).into());
        UpNet {
            last,
            carry: last & i.enable,
        }
    }
    fn next<L: Logic>(&self, q: UpReg<L>, w: &UpNet<L>, i: &Enable<L>) -> UpReg<L> {
        let step = w.carry.mux(0.into(), q.count + 1);
        UpReg {
            count: i.enable.mux(step, q.count),
        }
    }
}

signals! { pub struct DownReg<L> { left: L::I<6> = 4 } }
signals! { pub struct DownNet<L> { pub last: L::Bit, pub count: L::U<6> } }

/// Counts modulo 5 too, as what is left to count; it shows the count on a net, two bits wider.
#[derive(Debug)]
pub struct Down {
    /// What is added on top of the count where it is 4.
    pub flaw: u64,
}

impl Circuit for Down {
    parts!("modulo", Enable, DownReg, DownNet);
    fn comb<L: Logic>(&self, q: &DownReg<L>, _: &Enable<L>) -> DownNet<L> {
        let last = q.left.is_zero();
        let count = (-q.left + 4).unsigned();
        DownNet {
            last,
            count: last.mux(count + self.flaw, count),
        }
    }
    fn next<L: Logic>(&self, q: DownReg<L>, w: &DownNet<L>, i: &Enable<L>) -> DownReg<L> {
        let step = w.last.mux(4.into(), q.left - 1);
        DownReg {
            left: i.enable.mux(step, q.left),
        }
    }
}

signals! { pub struct ToggleReg<L> { pub last: L::Bit } }
signals! { pub struct ToggleNet<L> { hidden: L::Bit, pub parity: L::Bit } }

/// Has one port out in common with the counters.
#[derive(Debug)]
pub struct Toggle;

impl Circuit for Toggle {
    parts!("toggle", Enable, ToggleReg, ToggleNet);
    fn comb<L: Logic>(&self, q: &ToggleReg<L>, i: &Enable<L>) -> ToggleNet<L> {
        ToggleNet {
            hidden: !q.last,
            parity: q.last ^ i.enable,
        }
    }
    fn next<L: Logic>(&self, _: ToggleReg<L>, w: &ToggleNet<L>, _: &Enable<L>) -> ToggleReg<L> {
        ToggleReg { last: w.parity }
    }
}

/// Circuits with the one port in.
macro_rules! enabled {
    ($($left:ty, $right:ty;)*) => {$(
        impl SamePorts<$left> for $right {
            fn ports<L: Logic>(i: &Enable<L>) -> &Enable<L> {
                i
            }
        }
    )*};
}
enabled! { Up, Down; Up, Toggle; Toggle, Up; }

signals! { pub struct Digit<L> { pub digit: L::U<2> } }
signals! { pub struct LockReg<L> { pub right: L::U<2> as States(&["shut", "one", "two", "open"]) } }
signals! { pub struct LockNet<L> { wanted: L::U<2>, pub fits: L::Bit } }

/// A lock that opens on three digits in a row and then stays open.
#[derive(Debug)]
pub struct Lock {
    pub code: [u64; 3],
}

impl Circuit for Lock {
    parts!("lock", Digit, LockReg, LockNet);
    fn comb<L: Logic>(&self, q: &LockReg<L>, i: &Digit<L>) -> LockNet<L> {
        let code = Image::<2, 2>::new(self.code);
        let wanted = code.read::<L>(q.right);
        LockNet {
            wanted,
            fits: i.digit.equals(wanted),
        }
    }
    fn next<L: Logic>(&self, q: LockReg<L>, w: &LockNet<L>, _: &Digit<L>) -> LockReg<L> {
        let step = w.fits.mux(q.right + 1, 0.into());
        LockReg {
            right: q.right.equals(3.into()).mux(q.right, step),
        }
    }
}

signals! { pub struct Requests<L> { pub request: [L::Bit; 2] } }
signals! { pub struct ArbiterReg<L> { pub served: L::Bit } }
signals! { pub struct ArbiterNet<L> { pub grant: [L::Bit; 2] } }

/// Grants one of two requests, in turn where both ask.
#[derive(Debug)]
pub struct Arbiter {
    /// Grants both where both ask and it is the turn of the first.
    pub flawed: bool,
}

impl Circuit for Arbiter {
    parts!("arbiter", Requests, ArbiterReg, ArbiterNet);
    fn comb<L: Logic>(&self, q: &ArbiterReg<L>, i: &Requests<L>) -> ArbiterNet<L> {
        let [a, b] = i.request;
        let first = a & (!b | q.served);
        let spare = L::Bit::from(self.flawed) & q.served;
        ArbiterNet {
            grant: [first, b & (!first | spare)],
        }
    }
    fn next<L: Logic>(
        &self,
        q: ArbiterReg<L>,
        w: &ArbiterNet<L>,
        _: &Requests<L>,
    ) -> ArbiterReg<L> {
        let [first, second] = w.grant;
        ArbiterReg {
            served: second.mux(true.into(), first.mux(false.into(), q.served)),
        }
    }
}

signals! { pub struct Port<L> { write: L::Bit, read: L::Bit, address: L::U<1>, data: L::U<2> } }
signals! { pub struct StoreReg<L> { ram: L::Ram<1, 2>, pub out: L::U<2> = 2 } }
signals! { pub struct StoreNet<L> { next_out: L::U<2> } }

/// Two words of two bits behind an output register.
#[derive(Debug)]
pub struct Store;

impl Circuit for Store {
    parts!("store", Port, StoreReg, StoreNet);
    fn comb<L: Logic>(&self, q: &StoreReg<L>, i: &Port<L>) -> StoreNet<L> {
        StoreNet {
            next_out: q.ram.read_when(i.read, i.address, q.out),
        }
    }
    fn next<L: Logic>(&self, q: StoreReg<L>, w: &StoreNet<L>, i: &Port<L>) -> StoreReg<L> {
        // The third value is never stored: so not every packed state is reachable.
        let write = i.write & !i.data.equals(3.into());
        StoreReg {
            ram: q.ram.write(write, i.address, i.data),
            out: w.next_out,
        }
    }
}

signals! { pub struct Choice<L> { pub way: L::Bit } }
signals! { pub struct TableReg<L> { pub state: L::U<4> } }
signals! { pub struct TableNet<L> { pub next: L::U<4> } }

/// An automaton by its table: the state after `state` on `way` stands at `2 * state + way`.
#[derive(Debug)]
pub struct Table(pub Image<5, 4>);

impl Circuit for Table {
    parts!("table", Choice, TableReg, TableNet);
    fn comb<L: Logic>(&self, q: &TableReg<L>, i: &Choice<L>) -> TableNet<L> {
        let address = q.state.join(i.way.word());
        TableNet {
            next: self.0.read::<L>(address),
        }
    }
    fn next<L: Logic>(&self, _: TableReg<L>, w: &TableNet<L>, _: &Choice<L>) -> TableReg<L> {
        TableReg { state: w.next }
    }
}

signals! { pub struct Word<L, const W: usize> { word: L::U<W> } }
signals! { pub struct Line<L, const K: usize> { line: L::ShiftRegister<K, 13>, above: L::U<12> } }
signals! { pub struct Through<L> { some: L::Bit } }

/// `K` words of 13 bits and 12 more bits; it takes words of `W` bits.
#[derive(Debug)]
pub struct Wide<const W: usize, const K: usize>;

impl<const W: usize, const K: usize> Circuit for Wide<W, K> {
    const NAME: &'static str = "wide";
    const ABOUT: &'static str = "a circuit to be checked";
    type In<L: Logic> = Word<L, W>;
    type Reg<L: Logic> = Line<L, K>;
    type Net<L: Logic> = Through<L>;
    fn comb<L: Logic>(&self, _: &Line<L, K>, i: &Word<L, W>) -> Through<L> {
        Through {
            some: !i.word.is_zero(),
        }
    }
    fn next<L: Logic>(&self, q: Line<L, K>, w: &Through<L>, i: &Word<L, W>) -> Line<L, K> {
        Line {
            line: q.line.shift(w.some, i.word.resize()),
            above: q.above + 1,
        }
    }
}

signals! { pub struct Lfsr<L> { pub state: L::U<20> = 1 } }
signals! { pub struct Feedback<L> { bit: L::Bit } }

/// A linear feedback shift register of 20 bits with the primitive polynomial x^20 + x^17 + 1,
/// stopped by its input.
#[derive(Debug)]
pub struct Noise;

impl Circuit for Noise {
    parts!("noise", Enable, Lfsr, Feedback);
    fn comb<L: Logic>(&self, q: &Lfsr<L>, _: &Enable<L>) -> Feedback<L> {
        Feedback {
            bit: q.state.bit(19) ^ q.state.bit(16),
        }
    }
    fn next<L: Logic>(&self, q: Lfsr<L>, w: &Feedback<L>, i: &Enable<L>) -> Lfsr<L> {
        let shifted: L::U<20> = q.state.join(w.bit.word());
        Lfsr {
            state: i.enable.mux(shifted, q.state),
        }
    }
}
