//! Position detector 10 as an absolute encoder of a turn: its word, taken with its own sampling clock
//! and continued beyond the turn.
//!
//! ```text
//!                 ┌───────────────────┐
//!  strobe, code ─▶│                   ├──▶ sample, position
//!  turn, clear ──▶│ absolute detector ├──▶ lost
//!                 └───────────────────┘
//! ```
//!
//! The encoder gives a new Gray word with each rise of `strobe`, its sampling clock. Every wire goes
//! through two flip-flops. The word is taken a tick after the rise was seen, when all of its wires
//! have come through. A word at the pins from tick n on, with its strobe, is in `position` from tick
//! n + 4 on, with `sample` in that tick: CK of the memory 11, as the text advises.
//!
//! A turn of T counts has the T words in the middle of the code, (2^code − T)/2 on either side being
//! unused: so where T is even its last word and its first differ in one bit too. What the encoder goes
//! from sample to sample is the shorter way round, and is added to a position that wraps at 2^position
//! only. The text says nothing of turns.
//!
//! Departures: the position after power-on or `clear` is the place in the turn. Beyond a quarter of a
//! turn in a sample the way is counted but `lost` is high: half a turn more would look the same
//! in the other direction. A word that no place in the turn has is not counted, and is `lost` too.

use crate::hdl::prelude::*;

/// Absolute detector of a turn, with a position that goes on.
#[derive(Debug, Clone)]
pub struct AbsoluteDetector {
    /// Width of the encoder's word.
    pub code: usize,
    /// Width of the position, greater than that.
    pub position: usize,
}

/// Of two bits, of four, and so on.
const PARITIES: &[&str] = &["parity_2", "parity_4", "parity_8", "parity_16", "parity_32"];

impl AbsoluteDetector {
    /// Doublings from a bit to a parity of more than half of them.
    fn parities(&self) -> usize {
        log2(self.code) - 1
    }
}

signals! { for AbsoluteDetector as c;
    /// Ports in.
    pub struct In {
        /// The encoder's sampling clock, asynchronous; a new word comes with each rise. High and low
        /// for a tick at least, four ticks from rise to rise.
        pub strobe: Bit,
        /// The encoder's word in Gray code, asynchronous.
        pub code: U(c.code) as Hex,
        /// T: counts of a turn; 0 for 2^code.
        pub turn: U(c.code),
        /// The next word is taken for the position, as after power-on; `lost` off.
        pub clear: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// The last four levels of the strobe, the newest in bit 0, which is the flip-flop at the pin.
        sync_strobe: U(4) as Hex = 0,
        /// The word's flip-flops at the pins.
        pin_code: U(c.code) as Hex = 0,
        /// The word, synchronised.
        sync_code: U(c.code) as Hex = 0,
        /// A word was taken since power-on or `clear`.
        known: Bit,
        /// Place in the turn of the last sample.
        last: U(c.code),
        /// A sample is new in this tick: CK.
        pub sample: Bit,
        /// Dx: place in the turn, and the turns since; wraps.
        pub position: I(c.position) as Analog = 0,
        /// The encoder was too fast, or a word was none of the turn, since `clear`.
        pub lost: Bit,
    }
    /// Nets.
    pub struct Net {
        /// A word is taken.
        take: Bit,
        /// Parities of 2, 4, … bits of it from each one up.
        parity: [U(c.code); c.parities()] as Elements(PARITIES),
        /// Its number in the code: the parity of all of them.
        number: U(c.code),
        /// Counts of a turn, with room for all of them.
        counts: U(c.code + 1),
        /// Words of the code that the turn has not.
        unused: U(c.code + 1),
        /// The number of the turn's first word.
        first: U(c.code),
        /// Its place in the turn.
        place: U(c.code + 1),
        /// The turn has no such place.
        outside: Bit,
        /// Place, turn and half a turn, with room for a sign.
        placed: I(c.code + 2),
        /// T.
        whole: I(c.code + 2),
        /// T/2.
        half: I(c.code + 2),
        /// Places gone since the last sample, in either direction.
        gone: I(c.code + 2),
        /// The same by the shorter way round.
        way: I(c.code + 2),
        /// The way is longer than a quarter of a turn.
        far: Bit,
        /// What a sample adds to the position.
        step: I(c.position),
    }
}

impl Circuit for AbsoluteDetector {
    const NAME: &'static str = "absolute_detector";
    const ABOUT: &'static str = "position from the Gray words of an absolute encoder of a turn";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let wider = self.position > self.code && self.code >= 2;
        (!wider).then(|| "a position is wider than a word, and that has 2 bits at least".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let n = self.code;
        let take = q.sync_strobe.bit(2) & !q.sync_strobe.bit(3);
        // A bit is the parity of those from it up.
        let doubled = |word: U, k: usize| word ^ word.shift_right(1 << k);
        let mut parity = Vec::new();
        for k in 0..self.parities() {
            parity.push(doubled(*parity.last().unwrap_or(&q.sync_code), k));
        }
        let last = *parity.last().unwrap_or(&q.sync_code);
        let number = doubled(last, self.parities());
        let counts = i.turn.is_zero().word().join(i.turn);
        let unused = U::new(1 << n, n + 1) - counts;
        let first = unused.slice(1, n);
        // Below the first it is a great number.
        let place = number.resize(n + 1) - first.resize(n + 1);
        let outside = !place.below(counts);
        let signed = |word: U| word.resize(n + 2).signed();
        let placed = signed(place);
        let gone = placed - signed(q.last);
        let (whole, half) = (signed(counts), signed(counts.shift_right(1)));
        let up = half.below(gone);
        let down = gone.below(-half);
        let way = up.mux(gone - whole, down.mux(gone + whole, gone));
        let far = counts.shift_right(2).below_any(way.magnitude());
        let taken = take & !outside;
        let step = q.known.mux(way, placed).resize(self.position);
        let before = q.known.mux(q.position, 0);
        let sampled = q.sync_strobe.resize(3).join(i.strobe.word());
        let net = Net {
            take,
            parity,
            number,
            counts,
            unused,
            first,
            place,
            outside,
            placed,
            whole,
            half,
            gone,
            way,
            far,
            step,
        };
        let next = Reg {
            sync_strobe: sampled,
            pin_code: i.code,
            sync_code: q.pin_code,
            known: (q.known | taken) & !i.clear,
            last: taken.mux(place.resize(n), q.last),
            sample: take,
            position: taken.mux(before + step, q.position),
            lost: (q.lost | (take & (outside | (q.known & far)))) & !i.clear,
        };
        (net, next)
    }
}

impl Specified for AbsoluteDetector {
    fn invariants(&self) -> Invariants<'_, Self> {
        let codes = 1i64 << self.code;
        let range = 1i64 << self.position;
        // The place of a word by counting through the code; none where the turn is without it.
        let place = move |word: u64, turn: u64| {
            let counts = if turn == 0 { codes } else { turn as i64 };
            let number = (0..codes).position(|number| (number ^ (number >> 1)) as u64 == word);
            let place = number.map_or(-1, |number| number as i64) - (codes - counts) / 2;
            (
                counts,
                Some(place).filter(|place| (0..counts).contains(place)),
            )
        };
        Invariants::<Self>::new()
            .step(
                "a sample moves the position by the shorter way round, or is its place at first",
                move |now, next| {
                    let (q, after) = (now.q, &next.q);
                    let (counts, place) = place(q.sync_code, now.i.turn);
                    let rises = q.sync_strobe & 0b1100 == 0b0100;
                    let (mut position, mut last) = (q.position, q.last);
                    let mut lost = q.lost;
                    if rises {
                        let ways = place.map(|place| {
                            let gone = place - q.last as i64;
                            [gone, gone - counts, gone + counts]
                        });
                        let way =
                            ways.and_then(|ways| ways.into_iter().min_by_key(|way| way.abs()));
                        let known = way.filter(|_| q.known);
                        lost |= place.is_none() || known.is_some_and(|way| way.abs() > counts / 4);
                        if let Some(place) = place {
                            position = known.map_or(place, |way| q.position + way);
                            last = place as u64;
                        }
                    }
                    let right = (after.position - position).rem_euclid(range) == 0
                        && after.last == last
                        && after.sample == rises
                        && after.lost == (lost && !now.i.clear)
                        && after.known == ((q.known || (rises && place.is_some())) && !now.i.clear);
                    require(
                        right,
                        ["position", "last", "sample", "lost", "known"],
                        || format!("{} at {place:?} of {counts}", after.position),
                    )
                },
            )
            .step("wires pass their flip-flops, the word two", |now, next| {
                let passed = next.q.pin_code == now.i.code
                    && next.q.sync_code == now.q.pin_code
                    && next.q.sync_strobe
                        == (now.q.sync_strobe << 1 & 15 | u64::from(now.i.strobe));
                require(passed, ["pin_code", "sync_code", "sync_strobe"], || {
                    "not so".into()
                })
            })
    }
}
