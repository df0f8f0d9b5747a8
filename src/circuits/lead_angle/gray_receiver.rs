//! Receiver of an absolute encoder's words: the place in a turn, by the encoder's own sampling clock.
//! Part of position detector 10 of JPH0646367B2.
//!
//! ```text
//!           ┌───────────────┐
//!  strobe ─▶│               ├──▶ take
//!  code ───▶│ gray receiver ├──▶ place
//!  turn ───▶│               ├──▶ outside
//!           └───────────────┘
//! ```
//!
//! The encoder gives a new Gray word with each rise of `strobe`. Every wire goes through two
//! flip-flops. The word is taken a tick after the rise was seen, when all of its wires have come
//! through.
//!
//! A turn of T counts has the T words in the middle of the code, (2^code − T)/2 on either side being
//! unused: so where T is even its last word and its first differ in one bit too.

use crate::prelude::*;

/// Receiver of Gray words; a word at the pins from tick n on, with its strobe, is taken in n + 3.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GrayReceiver {
    /// Width of the encoder's word.
    pub code: usize,
}

/// Names of the parities of two bits, of four, and so on.
const PARITIES: &[&str] = &["parity_2", "parity_4", "parity_8", "parity_16", "parity_32"];

impl GrayReceiver {
    /// Doublings from a bit to a parity of more than half of them.
    fn parities(&self) -> usize {
        log2(self.code) - 1
    }
}

signals! { for GrayReceiver as c;
    /// Input ports.
    pub struct In {
        /// The encoder's sampling clock, asynchronous; a new word comes with each rise. High and low
        /// for a tick at least, four ticks from rise to rise.
        pub strobe: Bit,
        /// The encoder's word in Gray code, asynchronous.
        pub code: U(c.code) as Hex,
        /// T: counts of a turn; 0 for 2^code.
        pub turn: U(c.code),
    }
    /// Flip-flops.
    pub struct Reg {
        /// The last four levels of the strobe, the newest in bit 0, which is the flip-flop at the pin.
        sync_strobe: U(4) as Hex = 0,
        /// The word's flip-flops at the pins.
        pin_code: U(c.code) as Hex = 0,
        /// The word, synchronised.
        sync_code: U(c.code) as Hex = 0,
    }
    /// Nets.
    pub struct Net {
        /// A word is taken.
        pub take: Bit,
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
        /// Its place in the turn; below the turn's first word a great number.
        pub place: U(c.code + 1),
        /// The turn has no such place.
        pub outside: Bit,
    }
}

impl Circuit for GrayReceiver {
    const NAME: &'static str = "gray_receiver";
    const ABOUT: &'static str = "place in a turn from the Gray words of an absolute encoder";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        (self.code < 2).then(|| "a word has 2 bits at least".into())
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
        let place = number.resize(n + 1) - first.resize(n + 1);
        let outside = !place.below(counts);
        let net = Net {
            take,
            parity,
            number,
            counts,
            unused,
            first,
            place,
            outside,
        };
        let next = Reg {
            sync_strobe: q.sync_strobe.resize(3).join(i.strobe.word()),
            pin_code: i.code,
            sync_code: q.pin_code,
        };
        (net, next)
    }
}

impl Specified for GrayReceiver {
    fn invariants(&self) -> Invariants<'_, Self> {
        let codes = 1i64 << self.code;
        Invariants::<Self>::new()
            .always(
                "a word is taken two ticks behind its strobe, by its place in the turn",
                move |now| {
                    // By counting through the code; none where the turn is without it.
                    let (turn, word) = (now.i.turn as i64, now.q.sync_code);
                    let counts = if turn == 0 { codes } else { turn };
                    let number = (0..codes).find(|number| (number ^ (number >> 1)) as u64 == word);
                    let place = number.unwrap_or(codes) - (codes - counts) / 2;
                    let inside = (0..counts).contains(&place);
                    let right = now.w.take == (now.q.sync_strobe & 0b1100 == 0b0100)
                        && now.w.outside != inside
                        && (!inside || now.w.place as i64 == place);
                    require(right, ["place", "outside", "take"], || {
                        format!("{place} of {counts}")
                    })
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
