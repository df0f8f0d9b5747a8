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

/// Returns the number of a word in Gray code, from the top bit down: a bit of the number is that of
/// the word, inverted if the bit above it in the number is high.
fn number(word: U) -> U {
    let top = word.width() - 1;
    let mut above = word.bit(top);
    (0..top).rev().fold(above.word(), |number, index| {
        above = above ^ word.bit(index);
        number.join(above.word())
    })
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

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let wide = self.code + 1;
        let codes = U::new(1 << self.code, wide);
        let counts = i.turn.is_zero().mux(codes, i.turn.resize(wide));
        // The turn is in the middle of the code.
        let first = (codes - counts).shift_right(1);
        let number = number(q.sync_code).resize(wide);
        let place = number - first;
        let inside = !number.below(first) & place.below(counts);
        let placed = (w.outside ^ inside) & (!inside | w.place.equals(place));
        let rises = q.sync_strobe.slice(2, 2).equals(0b01);
        let strobes = q.sync_strobe.slice(0, 3).join(i.strobe.word());
        let codes_pass = next.pin_code.equals(i.code) & next.sync_code.equals(q.pin_code);
        vec![
            Property::always(
                "take is high three ticks after strobe rises, with the word's place in the turn",
                &["place", "outside", "take"],
                w.take.equals(rises) & placed,
            ),
            Property::step(
                "code passes two flip-flops and strobe four, one per tick",
                &["pin_code", "sync_code", "sync_strobe"],
                codes_pass & next.sync_strobe.equals(strobes),
            ),
        ]
    }
}

impl Specified for GrayReceiver {}
