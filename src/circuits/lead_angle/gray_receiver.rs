//! Receiver of an absolute encoder's words: gives the place in a turn, with the encoder's own
//! sampling clock. Part of position detector 10 of JPH0646367B2.
//!
//! ```text
//!           ┌───────────────┐
//!  strobe ─▶│               ├──▶ take
//!  code ───▶│ gray receiver ├──▶ place
//!  turn ───▶│               ├──▶ outside
//!           └───────────────┘
//! ```
//!
//! The encoder outputs a new Gray word with each rising edge of `strobe`. Every wire goes through
//! two flip-flops. The word is taken one tick after the edge was seen, when all of its wires have
//! passed them.
//!
//! A turn of T counts uses the T words in the middle of the code, and leaves (2^code − T)/2 words
//! unused on either side. So for an even T, its last word and its first word differ in one bit too.

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
        /// Sampling clock of the encoder, asynchronous; a new word comes with each rising edge.
        /// High and low for at least one tick; at least four ticks from edge to edge.
        pub strobe: Bit,
        /// Word of the encoder in Gray code, asynchronous.
        pub code: U(c.code) as Hex,
        /// T: counts of a turn; 0 for 2^code.
        pub turn: U(c.code),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Last four samples of the strobe, the newest in bit 0, which is the flip-flop at the pin.
        sync_strobe: U(4) as Hex = 0,
        /// Flip-flops of the word at the pins.
        pin_code: U(c.code) as Hex = 0,
        /// Synchronized word.
        sync_code: U(c.code) as Hex = 0,
    }
    /// Nets.
    pub struct Net {
        /// A word is taken.
        pub take: Bit,
        /// Bit i: parity of the word's bits from i up, of as many bits as the name says.
        parity: [U(c.code); c.parities()] as Elements(PARITIES),
        /// Number of the word in the code; bit i is the parity of all bits from i up.
        number: U(c.code),
        /// Counts of a turn, 2^code where `turn` is 0.
        counts: U(c.code + 1),
        /// Words of the code that the turn does not use.
        unused: U(c.code + 1),
        /// Number of the first word of the turn.
        first: U(c.code),
        /// Place of the word in the turn; a large number for words below the first one.
        pub place: U(c.code + 1),
        /// The word is outside the turn.
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
                "take is high three ticks after strobe rises, with the word's place in the turn",
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
            .step(
                "code passes two flip-flops and strobe four, one per tick",
                |now, next| {
                    let passed = next.q.pin_code == now.i.code
                        && next.q.sync_code == now.q.pin_code
                        && next.q.sync_strobe
                            == (now.q.sync_strobe << 1 & 15 | u64::from(now.i.strobe));
                    require(passed, ["pin_code", "sync_code", "sync_strobe"], || {
                        "not so".into()
                    })
                },
            )
    }
}
