//! Small circuits.

use motion_rtl::prelude::*;

/// Writes the head of a circuit whose records are these.
macro_rules! head {
    ($name:literal, $($record:ident),+) => {
        const NAME: &'static str = $name;
        const ABOUT: &'static str = "a circuit to be checked";
        records!($($record),+);
    };
}

signals! { for (Up, Down, Toggle, Noise) as _c;
    pub struct Enable { pub enable: Bit }
}

/// Counts modulo `n`.
#[derive(Debug, Clone)]
pub struct Up {
    pub n: u64,
}

signals! { for Up as _c;
    pub struct UpReg { pub count: U(4) }
    pub struct UpNet { pub last: Bit, carry: Bit }
}

impl Circuit for Up {
    head!("modulo", Enable, UpReg, UpNet);
    fn tick(&self, i: Enable, q: UpReg, _: Nothing) -> (UpNet, UpReg<Edge>) {
        let last = q.count.equals(self.n - 1);
        let carry = last & i.enable;
        let step = carry.mux(0, q.count + 1);
        let count = i.enable.mux(step, q.count);
        (UpNet { last, carry }, UpReg { count })
    }
}

/// Counts modulo 5 too, as what is left to count; it shows the count on a net, two bits wider.
#[derive(Debug, Clone)]
pub struct Down {
    /// Error added to the count where it is 4.
    pub flaw: u64,
}

signals! { for Down as _c;
    pub struct DownReg { left: I(6) = 4 }
    pub struct DownNet { pub last: Bit, pub count: U(6) }
}

impl Circuit for Down {
    head!("modulo", Enable, DownReg, DownNet);
    fn tick(&self, i: Enable, q: DownReg, _: Nothing) -> (DownNet, DownReg<Edge>) {
        let last = q.left.is_zero();
        let count = (-q.left + 4).unsigned();
        let count = last.mux(count + self.flaw, count);
        let left = i.enable.mux(last.mux(4, q.left - 1), q.left);
        (DownNet { last, count }, DownReg { left })
    }
}

/// Has one port out in common with the counters.
#[derive(Debug, Clone)]
pub struct Toggle;

signals! { for Toggle as _c;
    pub struct ToggleReg { pub last: Bit }
    pub struct ToggleNet { hidden: Bit, pub parity: Bit }
}

impl Circuit for Toggle {
    head!("toggle", Enable, ToggleReg, ToggleNet);
    fn tick(&self, i: Enable, q: ToggleReg, _: Nothing) -> (ToggleNet, ToggleReg<Edge>) {
        let (hidden, parity) = (!q.last, q.last ^ i.enable);
        (ToggleNet { hidden, parity }, ToggleReg { last: parity })
    }
}

/// A lock that opens on three digits in a row and then stays open.
#[derive(Debug, Clone)]
pub struct Lock {
    pub code: [u64; 3],
}

signals! { for Lock as _c;
    pub struct Digit { pub digit: U(2) }
    pub struct LockReg { pub right: U(2) as States(&["shut", "one", "two", "open"]) }
    pub struct LockNet { wanted: U(2), pub fits: Bit }
}

impl Circuit for Lock {
    head!("lock", Digit, LockReg, LockNet);
    fn tick(&self, i: Digit, q: LockReg, _: Nothing) -> (LockNet, LockReg<Edge>) {
        let wanted = Image::of(2, 2, self.code).rom(q.right);
        let fits = i.digit.equals(wanted);
        let step = fits.mux(q.right + 1, 0);
        let right = q.right.equals(3).mux(q.right, step);
        (LockNet { wanted, fits }, LockReg { right })
    }
}

/// Grants one of two requests, in turn where both ask.
#[derive(Debug, Clone)]
pub struct Arbiter {
    /// Grants both where both ask and it is the turn of the first.
    pub flawed: bool,
}

signals! { for Arbiter as _c;
    pub struct Requests { pub request: [Bit; 2] }
    pub struct ArbiterReg { pub served: Bit }
    pub struct ArbiterNet { pub grant: [Bit; 2] }
}

impl Circuit for Arbiter {
    head!("arbiter", Requests, ArbiterReg, ArbiterNet);
    fn tick(&self, i: Requests, q: ArbiterReg, _: Nothing) -> (ArbiterNet, ArbiterReg<Edge>) {
        let (a, b) = (i.request[0], i.request[1]);
        let first = a & (!b | q.served);
        let second = b & (!first | q.served & self.flawed);
        let served = second.mux(true, first.mux(false, q.served));
        let grant = vec![first, second];
        (ArbiterNet { grant }, ArbiterReg { served })
    }
}

/// Two words of two bits behind an output register.
#[derive(Debug, Clone)]
pub struct Store;

signals! { for Store as _c;
    pub struct Port { write: Bit, read: Bit, address: U(1), data: U(2) }
    pub struct StoreReg { ram: Ram(1, 2), pub out: U(2) = 2 }
    pub struct StoreNet { next_out: U(2) }
}

impl Circuit for Store {
    head!("store", Port, StoreReg, StoreNet);
    fn tick(&self, i: Port, q: StoreReg, _: Nothing) -> (StoreNet, StoreReg<Edge>) {
        let next_out = q.ram.read_when(i.read, i.address, q.out);
        // The third value is never stored: so not every packed state is reachable.
        let write = i.write & !i.data.equals(3);
        let next = StoreReg {
            ram: q.ram.write(write, i.address, i.data),
            out: next_out,
        };
        (StoreNet { next_out }, next)
    }
}

/// An automaton by its table: the state after `state` on `way` stands at `2 * state + way`.
#[derive(Debug, Clone)]
pub struct Table(pub Image);

signals! { for Table as _c;
    pub struct Choice { pub way: Bit }
    pub struct TableReg { pub state: U(4) }
    pub struct TableNet { pub next: U(4) }
}

impl Circuit for Table {
    head!("automaton", Choice, TableReg, TableNet);
    fn tick(&self, i: Choice, q: TableReg, _: Nothing) -> (TableNet, TableReg<Edge>) {
        let next = self.0.rom(q.state.join(i.way.word()));
        (TableNet { next }, TableReg { state: next })
    }
}

/// `stages` stages of 13 bits and 12 more bits; takes words of `width` bits.
#[derive(Debug, Clone)]
pub struct Wide {
    pub width: usize,
    pub stages: usize,
}

signals! { for Wide as c;
    pub struct Word { pub word: U(c.width) }
    pub struct Line { line: Shift(c.stages, 13), above: U(12) }
    pub struct Through { some: Bit }
}

impl Circuit for Wide {
    head!("wide", Word, Line, Through);
    fn tick(&self, i: Word, q: Line, _: Nothing) -> (Through, Line<Edge>) {
        let some = !i.word.is_zero();
        let next = Line {
            line: q.line.shift(some, i.word.resize(13)),
            above: q.above + 1,
        };
        (Through { some }, next)
    }
}

/// A linear feedback shift register of 20 bits with the primitive polynomial x^20 + x^17 + 1,
/// stopped by its input.
#[derive(Debug, Clone)]
pub struct Noise;

signals! { for Noise as _c;
    pub struct Lfsr { pub state: U(20) = 1 }
    pub struct Feedback { shift_in: Bit }
}

impl Circuit for Noise {
    head!("noise", Enable, Lfsr, Feedback);
    fn tick(&self, i: Enable, q: Lfsr, _: Nothing) -> (Feedback, Lfsr<Edge>) {
        let shift_in = q.state.bit(19) ^ q.state.bit(16);
        let shifted = q.state.slice(0, 19).join(shift_in.word());
        let state = i.enable.mux(shifted, q.state);
        (Feedback { shift_in }, Lfsr { state })
    }
}
