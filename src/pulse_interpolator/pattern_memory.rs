//! Pattern memory 10 (¶0013–0014, ¶0019): direction and half-period per unit time, for one axis.
//!
//! ```text
//!               ┌────────────────┐
//!  read ───────▶│                ├──▶ half_period
//!  blank ──────▶│ pattern memory ├──▶ direction
//!  address ────▶│                │
//!  write… ─────▶│                │
//!               └────────────────┘
//! ```
//!
//! Block RAM with a registered output: the address of the unit time to come is applied in the
//! tick of RST, the word stands at the output from the first tick of that unit time on.
//!
//! Departures: the text has an EPROM without direction. Here each word has a direction bit, a
//! half-period of 0 is "no pulse", and a write port lets the control computer fill one pattern
//! while another plays (¶0033 leaves the kind of memory open). Power-on contents make it the
//! text's EPROM.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Image, Logic, Ram, Sim, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const N: usize, const A: usize> {
        /// Reads the word at `address` into the output registers.
        pub read: L::Bit,
        /// Puts "no pulse" into the output registers; the direction stays. `read` has priority.
        pub blank: L::Bit,
        /// Address of the unit time to come.
        pub address: L::U<A> as Hex,
        /// Writes a word if `write_axis` names this axis.
        pub write: L::Bit,
        /// The axis written to.
        pub write_axis: L::U<3>,
        /// Address written to.
        pub write_address: L::U<A> as Hex,
        /// Half-period written.
        pub write_half_period: L::U<N>,
        /// Direction written.
        pub write_direction: L::Bit,
    }
}

signals! {
    /// Flip-flops and memories.
    pub struct Reg<L, const N: usize, const A: usize> {
        /// Half-periods, one word per unit time.
        half_periods: L::Ram<A, N>,
        /// Directions, one bit per unit time.
        directions: L::Ram<A, 1>,
        /// Half-period of the unit time that runs, in ticks; 0 for no pulse.
        pub half_period: L::U<N> = 0,
        /// Direction of the unit time that runs; high counts down.
        pub direction: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L> {
        /// A word is written to this axis.
        selected: L::Bit,
        /// The output becomes "no pulse".
        clear: L::Bit,
    }
}

/// Pattern memory 10 of one axis: 2^`A` words of a direction bit and `N` bits of half-period.
#[derive(Debug, Clone)]
pub struct PatternMemory<const N: usize, const A: usize> {
    /// The number of this axis, 0 to 7.
    pub axis: u64,
    /// Half-periods at power-on.
    pub half_periods: Image<A, N>,
    /// Directions at power-on.
    pub directions: Image<A, 1>,
}

impl<const N: usize, const A: usize> PatternMemory<N, A> {
    /// The memory of axis number `axis`, all words "no pulse".
    pub fn new(axis: u64) -> Self {
        PatternMemory {
            axis,
            half_periods: Image::zeroed(),
            directions: Image::zeroed(),
        }
    }
}

impl<const N: usize, const A: usize> Circuit for PatternMemory<N, A> {
    const NAME: &'static str = "pattern_memory";
    const ABOUT: &'static str = "direction and half-period per unit time, for one axis";
    type In<L: Logic> = In<L, N, A>;
    type Reg<L: Logic> = Reg<L, N, A>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, _: &Reg<L, N, A>, i: &In<L, N, A>) -> Net<L> {
        Net {
            selected: i.write & i.write_axis.equals(L::parameter("axis", self.axis)),
            clear: i.blank & !i.read,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, N, A>, w: &Net<L>, i: &In<L, N, A>) -> Reg<L, N, A> {
        // A clear before the read, as the output register of block RAM has it.
        let read = q.half_periods.read_when(i.read, i.address, q.half_period);
        let direction = q.direction.word();
        Reg {
            half_period: w.clear.mux(0.into(), read),
            direction: q.directions.read_when(i.read, i.address, direction).bit(0),
            half_periods: q
                .half_periods
                .write(w.selected, i.write_address, i.write_half_period),
            directions: q
                .directions
                .write(w.selected, i.write_address, i.write_direction.word()),
        }
    }

    fn power_on(&self) -> Reg<Sim, N, A> {
        Reg {
            half_periods: self.half_periods.clone().into(),
            directions: self.directions.clone().into(),
            half_period: 0.into(),
            direction: false.into(),
        }
    }
}

impl<const N: usize, const A: usize> Specified for PatternMemory<N, A> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "a read brings the word as it was before the edge",
                |now, next| {
                    let address = now.i.address;
                    let word = now.q.half_periods.read(address) == next.half_period
                        && now.q.directions.read(address).bit(0) == next.direction;
                    let held = !now.i.read.get() || word;
                    require(held, ["half_period", "direction"], || "another word".into())
                },
            )
            .step(
                "blank stops the pulses and keeps the direction",
                |now, next| {
                    let blank = now.i.blank.get() && !now.i.read.get();
                    let quiet = next.half_period.get() == 0 && next.direction == now.q.direction;
                    require(!blank || quiet, ["half_period", "direction"], || {
                        "not blank".into()
                    })
                },
            )
            .step("without read or blank the output stays", |now, next| {
                let kept =
                    next.half_period == now.q.half_period && next.direction == now.q.direction;
                let held = now.i.read.get() || now.i.blank.get() || kept;
                require(held, ["half_period", "direction"], || {
                    "changed by itself".into()
                })
            })
            .step(
                "a word changes by a write to this axis and its address, and only so",
                |now, next| {
                    let written = now.i.write.get() && now.i.write_axis.get() == self.axis;
                    let good = (0..1u64 << A).all(|address| {
                        let here = written && now.i.write_address.get() == address;
                        let address = address.into();
                        let (half_period, direction) = match here {
                            true => (now.i.write_half_period, now.i.write_direction.word()),
                            false => (
                                now.q.half_periods.read(address),
                                now.q.directions.read(address),
                            ),
                        };
                        next.half_periods.read(address) == half_period
                            && next.directions.read(address) == direction
                    });
                    require(good, ["half_periods", "directions"], || {
                        "another content".into()
                    })
                },
            )
    }
}
