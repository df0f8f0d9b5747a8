//! Conventional lead of Fig. 7 with its calculation 1 as a memory: the lead of each speed is read
//! by the speed.
//!
//! ```text
//!                          ┌────────────┐
//!  ck, position, restart ─▶│            ├──▶ present, speed, lead
//!  gate ──────────────────▶│ table lead ├──▶ fresh, enough
//!                          └────────────┘
//! ```
//!
//! The upper bits of ν are the address, sign included, so each direction has its own leads. The
//! lower bits interpolate linearly to the lead of the next word. The memory is addressed by the
//! distance that becomes ν at the same edge: θa is valid in the same tick as ν.
//!
//! Departures: the text has a lead for each speed; here the leads are 2^`fraction` counts apart. A
//! speed beyond the memory gets the lead of the last speed that the memory covers.

use super::SpeedDetector;
pub use super::speed_detector::In;
use crate::prelude::*;

/// Leads by speed, as a memory holds them: f(ν) at every 2^`fraction` counts.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeadTable {
    /// Leads in counts, from a speed of 0 up; the upper half is of negative speeds, as two's
    /// complement has them. A power of two in number.
    pub leads: Vec<i64>,
    /// Growth from each lead to the next word's; as many as there are leads.
    pub increments: Vec<i64>,
    /// Bits of a speed below the address.
    pub fraction: usize,
}

impl LeadTable {
    /// 2^`address` words for positions of `position` bits; `lead` is f(ν), ν in counts of a gate.
    #[must_use]
    pub fn new(
        address: usize,
        position: usize,
        fraction: usize,
        lead: impl Fn(i64) -> i64,
    ) -> Self {
        let speed = |word: usize| {
            let word = word as i64;
            (if word < 1 << (address - 1) {
                word
            } else {
                word - (1 << address)
            }) << fraction
        };
        // In two's complement, modulo 2^position as a position is.
        let words = |value: &dyn Fn(usize) -> i64| {
            let words = (0..1 << address).map(|word| value(word).cut(position));
            words.collect()
        };
        let grows = |speed: i64| lead(speed + (1 << fraction)) - lead(speed);
        LeadTable {
            leads: words(&|word| lead(speed(word))),
            increments: words(&|word| grows(speed(word))),
            fraction,
        }
    }

    /// Width of an address.
    fn address(&self) -> usize {
        log2(self.leads.len())
    }

    /// Bits of a speed that the memory covers.
    fn bits(&self) -> usize {
        self.address() + self.fraction
    }
}

/// Lead from a memory. A position that is present in the tick of CK is at `present` in the next
/// tick.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableLead {
    /// Width of a position.
    pub position: usize,
    /// Width of a gate in CKs.
    pub gate: usize,
    /// Contents of the memory.
    pub table: LeadTable,
}

impl TableLead {
    /// Contents of a memory of leads or increments.
    fn image(&self, words: &[i64]) -> Image {
        let words = words.iter().map(|word| (*word as u64).cut(self.position));
        Image::of(self.table.address(), self.position, words)
    }

    /// Returns a speed, limited to the range of the memory.
    fn limited(&self, speed: I) -> I {
        let bits = self.table.bits();
        let greatest = (1 << (bits - 1)) - 1;
        let upper = speed.below(greatest).mux(speed, greatest);
        let least = -greatest - 1;
        speed.below(least).mux(least, upper).resize(bits)
    }
}

/// The word at a speed of 0.
fn first(words: &[i64]) -> i64 {
    words.first().copied().unwrap_or(0)
}

signals! { for TableLead as c;
    /// Output registers of the memory.
    pub struct Reg {
        /// Lead of the table speed at or below ν.
        base: I(c.position) as Analog = first(&c.table.leads),
        /// Increase of the lead to the next table speed.
        increment: I(c.position) = first(&c.table.increments),
        /// Distance from the table speed to ν, as a fraction of the table step in units of
        /// 2^−`fraction`.
        part: U(c.table.fraction) = 0,
    }
    /// The circuit inside.
    pub struct Parts {
        /// Speed detector 2.
        pub detector: Part<SpeedDetector>(SpeedDetector { position: c.position, gate: c.gate }),
    }
    /// Nets.
    pub struct Net {
        /// Dx: present sample.
        pub present: I(c.position) as Analog,
        /// The sample is new in this tick.
        pub fresh: Bit,
        /// A whole gate has been measured since the last restart.
        pub enough: Bit,
        /// ν: distance of the last gate, in counts.
        pub speed: I(c.position) as Analog,
        /// The memory covers the distance of the gate that ends.
        covered: Bit,
        /// Distance of the gate that ends, limited to the range of the memory.
        held: I(c.table.bits()),
        /// `held` as an unsigned word.
        word: U(c.table.bits()),
        /// Address that is read.
        address: U(c.table.address()),
        /// `part` as a signed word.
        share: I(c.table.fraction + 1),
        /// `increment` times `share`.
        product: I(c.position + c.table.fraction + 1),
        /// 1: lead angle θa, in counts.
        pub lead: I(c.position) as Analog,
    }
}

impl Circuit for TableLead {
    const NAME: &'static str = "table_lead";
    const ABOUT: &'static str = "conventional lead: read from a memory by the measured speed";
    records!(In, Reg, Net, Parts);

    fn objection(&self) -> Option<String> {
        let LeadTable {
            leads,
            increments,
            fraction,
        } = &self.table;
        let words = leads.len();
        if words != increments.len() || words < 2 || !words.is_power_of_two() {
            let increments = increments.len();
            return Some(format!(
                "{words} leads and {increments} increments; allowed: as many of both, 2, 4, 8, …"
            ));
        }
        if *fraction == 0 || self.table.bits() > self.position {
            return Some(format!(
                "address and fraction, of 1 bit or more, have {} bits together, a position {}",
                self.table.bits(),
                self.position
            ));
        }
        let wide = |word: &&i64| word.cut(self.position) != **word;
        if let Some(word) = leads.iter().chain(increments).find(wide) {
            return Some(format!(
                "a position of {} bits has no {word}",
                self.position
            ));
        }
        let product = self.position + fraction + 1;
        (product > 64).then(|| format!("a product has at most 64 bits, and this one {product}"))
    }

    fn tick(&self, i: In, q: Reg, p: Parts) -> (Net, Reg<Edge>) {
        let LeadTable {
            leads,
            increments,
            fraction,
        } = &self.table;
        let (bits, fraction) = (self.table.bits(), *fraction);
        let detector = p.detector.settle(i);
        let (over, way) = (detector.w.over, detector.w.way);
        let cut = way.resize(bits);
        let covered = cut.resize(self.position).equals(way);
        let greatest = (1 << (bits - 1)) - 1;
        let end = way.is_negative().mux(I::new(-greatest - 1, bits), greatest);
        let held = covered.mux(cut, end);
        let word = held.unsigned();
        let address = word.slice(fraction, self.table.address());
        let read = |words: &[i64]| self.image(words).rom(address).signed();
        let share = q.part.resize(fraction + 1).signed();
        let product = q.increment.times(share, self.position + fraction + 1);
        let edge = Reg {
            base: over.mux(read(leads), q.base),
            increment: over.mux(read(increments), q.increment),
            part: over.mux(word.slice(0, fraction), q.part),
        };
        let net = Net {
            present: detector.q.present,
            fresh: detector.q.fresh,
            enough: detector.q.enough,
            speed: detector.q.speed,
            covered,
            held,
            word,
            address,
            share,
            product,
            lead: q.base + product.shift_right(fraction).resize(self.position),
        };
        (net, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (q, fraction) = (&now.q, self.table.fraction);
        let word = self.limited(now.p.detector.q.speed).unsigned();
        let address = word.slice(fraction, self.table.address());
        let read = |words: &[i64]| self.image(words).rom(address).signed();
        // The registers are those of the speed, and the lead is theirs.
        let base = q.base.equals(read(&self.table.leads));
        let increment = q.increment.equals(read(&self.table.increments));
        let registers = base & increment & q.part.equals(word.slice(0, fraction));
        // In units of 2^−fraction counts, modulo the range of a position.
        let bits = self.position + fraction;
        let part = q.part.resize(fraction + 1).signed();
        let product = q.increment.times(part, bits + 1).resize(bits);
        let grown = (now.w.lead - q.base).resize(bits).shift_left(fraction);
        let rest = (product - grown).unsigned();
        vec![Property::always(
            "lead is interpolated between the table words around the speed, rounded down",
            &["lead"],
            registers & rest.shift_right(fraction).is_zero(),
        )]
    }
}

impl Specified for TableLead {}
