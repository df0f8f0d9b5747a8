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
//! Block RAM with a registered output: the address of the next unit time is applied in the tick of
//! RST, the word is at the output from the first tick of that unit time on.
//!
//! Departures: the text has an EPROM without direction. Here each word has a direction bit, a
//! half-period of 0 is "no pulse", and a write port lets the control computer fill one pattern
//! while another plays (¶0033 leaves the kind of memory open). Power-on contents make it the
//! text's EPROM.

use super::Widths;
use crate::prelude::*;

/// Contents of an axis's memory at power-on.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contents {
    /// Half-periods, one word per unit time.
    pub half_periods: Image,
    /// Directions, one bit per unit time; left out in a configuration, all up.
    #[serde(default = "upwards")]
    pub directions: Image,
}

/// Directions of an axis that never goes down.
fn upwards() -> Image {
    Image::new(0, 1)
}

impl Contents {
    /// Creates contents with all words "no pulse", for half-periods and addresses of these widths.
    pub fn new(half_period: usize, address: usize) -> Self {
        Contents {
            half_periods: Image::new(address, half_period),
            directions: Image::new(address, 1),
        }
    }
}

/// Pattern memory 10 of one axis.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PatternMemory {
    /// Width of a half-period in bits.
    pub half_period: usize,
    /// Width of an address.
    pub address: usize,
    /// The number of this axis, 0 to 7.
    pub axis: u64,
    /// Contents at power-on.
    pub contents: Contents,
}

impl PatternMemory {
    /// Creates the memory of axis number `axis` with all words "no pulse", for half-periods and
    /// addresses of these widths.
    pub fn new(half_period: usize, address: usize, axis: u64) -> Self {
        PatternMemory {
            half_period,
            address,
            axis,
            contents: Contents::new(half_period, address),
        }
    }

    /// Returns the contents at power-on, in the present widths.
    fn contents(&self) -> Contents {
        let Contents {
            half_periods,
            directions,
        } = &self.contents;
        Contents {
            half_periods: half_periods.resized(self.address, self.half_period),
            directions: directions.resized(self.address, 1),
        }
    }
}

signals! { for (PatternMemory, Widths) as c;
    /// The port by which the words of all axes are written.
    pub struct WritePort {
        /// Writes a word of the axis with the number `write_axis`.
        pub write: Bit,
        /// Number of the axis to write.
        pub write_axis: U(3),
        /// Address to write.
        pub write_address: U(c.address) as Hex,
        /// Half-period to write, in ticks; 0 for no pulse.
        pub write_half_period: U(c.half_period),
        /// Direction to write; high counts down.
        pub write_direction: Bit,
    }
}

impl WritePort<Value> {
    /// Returns true if all its signals are low.
    pub(super) fn is_quiet(&self) -> bool {
        let words = [self.write_axis, self.write_address, self.write_half_period];
        words == [0; 3] && !self.write_direction && !self.write
    }
}

signals! { for PatternMemory as c;
    /// Input ports.
    pub struct In {
        /// Reads the word at `address` into the output registers.
        pub read: Bit,
        /// Puts "no pulse" into the output registers; the direction stays. `read` has priority.
        pub blank: Bit,
        /// Address of the next unit time.
        pub address: U(c.address) as Hex,
        /// Write port; writes a word if `write_axis` is this axis.
        pub port: WritePort(c) as Flat,
    }
    /// Flip-flops and memories.
    pub struct Reg {
        /// Half-periods, one word per unit time.
        half_periods: Ram(c.address, c.half_period) = &c.contents().half_periods,
        /// Directions, one bit per unit time.
        directions: Ram(c.address, 1) = &c.contents().directions,
        /// Half-period of the current unit time, in ticks; 0 for no pulse.
        pub half_period: U(c.half_period) = 0,
        /// Direction of the current unit time; high counts down.
        pub direction: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A word of this axis is written.
        selected: Bit,
        /// The output becomes "no pulse".
        clear: Bit,
    }
}

impl Circuit for PatternMemory {
    const NAME: &'static str = "pattern_memory";
    const ABOUT: &'static str = "direction and half-period per unit time, for one axis";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let port = i.port;
        let axis = U::parameter("axis", self.axis, 3);
        let selected = port.write & port.write_axis.equals(axis);
        let clear = i.blank & !i.read;
        // A clear before the read, as the output register of block RAM has it.
        let read = q.half_periods.read_when(i.read, i.address, q.half_period);
        let direction = q
            .directions
            .read_when(i.read, i.address, q.direction.word());
        let next = Reg {
            half_period: clear.mux(0, read),
            direction: direction.bit(0),
            half_periods: q.half_periods.write(
                selected,
                port.write_address,
                port.write_half_period,
            ),
            directions: q.directions.write(
                selected,
                port.write_address,
                port.write_direction.word(),
            ),
        };
        (Net { selected, clear }, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let output = |half_period: U, direction: Bit| {
            next.half_period.equals(half_period) & next.direction.equals(direction)
        };
        let read = output(
            q.half_periods.read(i.address),
            q.directions.read(i.address).bit(0),
        );
        let blank = next.half_period.is_zero() & next.direction.equals(q.direction);
        let port = &i.port;
        let axis = U::parameter("axis", self.axis, 3);
        let written = port.write & port.write_axis.equals(axis);
        // Of any word: the address is free where nothing is read.
        let here = written & port.write_address.equals(i.address);
        let half_period = here.mux(port.write_half_period, q.half_periods.read(i.address));
        let direction = here.mux(port.write_direction.word(), q.directions.read(i.address));
        let word = next.half_periods.read(i.address).equals(half_period)
            & next.directions.read(i.address).equals(direction);
        vec![
            Property::step(
                "a read outputs the word that was stored before the edge",
                &["half_period", "direction"],
                i.read.implies(read),
            ),
            Property::step(
                "blank without read sets half_period to 0 and keeps direction",
                &["half_period", "direction"],
                (i.blank & !i.read).implies(blank),
            ),
            Property::step(
                "without read and blank, half_period and direction keep their values",
                &["half_period", "direction"],
                i.read | i.blank | output(q.half_period, q.direction),
            ),
            Property::step(
                "only a write to this axis changes a word, and only the word at write_address",
                &["half_periods", "directions"],
                word,
            ),
        ]
    }
}

impl Specified for PatternMemory {}
