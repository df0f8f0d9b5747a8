//! Values as lines of text.

use crate::trace::walk::Change;
use std::num::NonZeroU32;
use vcd::IdCode;

/// The longest line of a number: `b`, 64 digits, the end of the line with its padding.
const LINE: usize = 1 + 64 + END;
/// Room for the end of a line.
const END: usize = 8;
/// Changes for which there is room at once.
const SOME: usize = 64;
/// The room in the buffer at first, doubled where a tick needs more.
const ROOM: usize = 16 * 1024;
/// Eight digits more.
const EIGHT: u64 = 100_000_000;

/// How a leaf is written. There is one for every leaf and every change looks at one: it is kept
/// small.
#[derive(Debug, Clone, Copy)]
struct Signal {
    end: End,
    /// Where its states stand, from 1 on, if it has some.
    states: Option<NonZeroU32>,
}

/// What stands behind a value on its line.
#[derive(Debug, Clone, Copy)]
struct End {
    /// For a word a space, the code, the end of the line; for a scalar the same without the space.
    /// Zeros behind it: up to five characters hold any 32-bit index.
    text: [u8; END],
    /// How much of that there is.
    len: u8,
    /// It is a word, with a `b` before its digits.
    word: bool,
}

/// The names of values.
#[derive(Debug, Clone, Copy)]
struct States {
    names: &'static [&'static str],
    end: End,
}

/// How every leaf is written.
#[derive(Debug)]
pub struct Signals {
    signals: Vec<Signal>,
    states: Vec<States>,
    /// The most that the lines of a change take, with padding.
    room: usize,
}

impl Signals {
    pub fn new() -> Self {
        Signals {
            signals: Vec::new(),
            states: Vec::new(),
            room: LINE,
        }
    }

    /// The next leaf. The names of its states are the variable after its own.
    pub fn push(&mut self, variable: u32, width: usize, names: Option<&'static [&'static str]>) {
        let states = names.and_then(|names| {
            self.states.push(States {
                names,
                end: End::new(variable + 1, true),
            });
            // A number has twenty digits at most.
            let longest = names.iter().fold(20, |most, name| most.max(name.len()));
            self.room = self.room.max(LINE + 1 + longest + END);
            NonZeroU32::new(self.states.len() as u32)
        });
        self.signals.push(Signal {
            end: End::new(variable, width != 1),
            states,
        });
    }
}

impl End {
    fn new(variable: u32, word: bool) -> Self {
        let code = IdCode::from(variable).to_string();
        let space = if word { " " } else { "" };
        let all = [space, &code, "\n"].concat();
        let mut text = [0; END];
        text[..all.len()].copy_from_slice(all.as_bytes());
        End {
            text,
            len: all.len() as u8,
            word,
        }
    }

    /// Puts it at a place in a line; returns where the line ends.
    #[inline(always)]
    fn put(&self, line: &mut [u8], at: usize) -> usize {
        line[at..][..END].copy_from_slice(&self.text);
        at + usize::from(self.len)
    }

    /// Writes the line of a value and returns its length. Leading zeros are left out: a reader
    /// extends a value that begins with 1 by zeros.
    ///
    /// Which signals change, and how long they are, no processor foresees: more digits than there
    /// are cost less than a branch.
    #[inline(always)]
    fn line(&self, line: &mut [u8], bits: u64) -> usize {
        let lead = usize::from(self.word);
        // All bits of a word, the lowest of a scalar.
        let bits = bits & (1 | u64::from(self.word).wrapping_neg());
        let digits = 64 - (bits | 1).leading_zeros() as usize;
        let rest = (bits << (64 - digits)).to_be_bytes();
        line[0] = b'b';
        let all = &mut line[lead..][..64];
        put_digits(&mut all[..16], &rest[..2]);
        if digits > 16 {
            put_digits(&mut all[16..32], &rest[2..4]);
        }
        if digits > 32 {
            put_digits(&mut all[32..], &rest[4..]);
        }
        self.put(line, lead + digits)
    }
}

impl States {
    /// Writes the line of a name, or of the number of a state without one, and returns its length.
    fn line(&self, line: &mut [u8], bits: u64) -> usize {
        let name = usize::try_from(bits)
            .ok()
            .and_then(|bits| self.names.get(bits));
        let number;
        let name = match name {
            Some(name) => name,
            None => {
                number = bits.to_string();
                &*number
            }
        };
        let at = 1 + name.len();
        line[0] = b's';
        line[1..at].copy_from_slice(name.as_bytes());
        self.end.put(line, at)
    }
}

/// The lines that are not written yet.
#[derive(Debug)]
pub struct Text {
    /// More than there are, so that a line can be put in its place at its full length.
    buffer: Vec<u8>,
    len: usize,
    /// The digits of the last time before its last eight, as a number.
    high: u64,
    /// How a line of such a time begins, and zeros behind it.
    head: [u8; 16],
    head_len: usize,
}

impl Text {
    pub fn new(head: Vec<u8>) -> Self {
        let len = head.len();
        let mut buffer = head;
        buffer.resize(len + ROOM, 0);
        let mut text = Text {
            buffer,
            len,
            high: 0,
            head: [0; 16],
            head_len: 0,
        };
        text.begin_times(0);
        text
    }

    pub fn bytes(&self) -> &[u8] {
        &self.buffer[..self.len]
    }

    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// Room for a line.
    #[inline]
    fn line(&mut self) -> &mut [u8] {
        self.room(LINE);
        &mut self.buffer[self.len..][..LINE]
    }

    #[inline]
    fn room(&mut self, bytes: usize) {
        if self.buffer.len() < self.len + bytes {
            self.more(bytes);
        }
    }

    #[cold]
    #[inline(never)]
    fn more(&mut self, bytes: usize) {
        self.buffer.resize(2 * self.buffer.len() + bytes, 0);
    }

    #[inline]
    pub fn raw(&mut self, bytes: &[u8]) {
        for part in bytes.chunks(LINE) {
            self.line()[..part.len()].copy_from_slice(part);
            self.len += part.len();
        }
    }

    /// Lines of new values.
    pub fn changes(&mut self, signals: &Signals, changes: &[Change]) {
        for some in changes.chunks(SOME) {
            self.room(SOME * signals.room);
            let (buffer, mut len) = (&mut self.buffer[..], self.len);
            for &Change { leaf, bits } in some {
                let signal = &signals.signals[leaf as usize];
                len += signal.end.line(&mut buffer[len..][..LINE], bits);
                if let Some(place) = signal.states {
                    let states = &signals.states[place.get() as usize - 1];
                    len += states.line(&mut buffer[len..], bits);
                }
            }
            self.len = len;
        }
    }

    pub fn time(&mut self, time: u64) {
        let (high, low) = (time / EIGHT, time % EIGHT);
        if self.high != high {
            self.begin_times(high);
        }
        let digits = eight_decimals(low);
        // The last digit stands even where all are zero.
        let zeros = match high {
            0 => (digits.trailing_zeros() as usize / 8).min(7),
            _ => 0,
        };
        let digits = (digits | 0x3030_3030_3030_3030) >> (8 * zeros);
        let (head, len) = (self.head, self.head_len);
        let end = len + 8 - zeros;
        let line = self.line();
        line[..16].copy_from_slice(&head);
        line[len..len + 8].copy_from_slice(&digits.to_le_bytes());
        line[end] = b'\n';
        self.len += end + 1;
    }

    /// The times that come have these digits before their last eight, where it is not 0.
    #[cold]
    fn begin_times(&mut self, high: u64) {
        let head = match high {
            0 => "#".to_owned(),
            _ => format!("#{high}"),
        };
        self.high = high;
        self.head_len = head.len();
        self.head[..head.len()].copy_from_slice(head.as_bytes());
    }
}

/// Writes the bits of bytes, eight digits each.
#[inline(always)]
fn put_digits(digits: &mut [u8], bytes: &[u8]) {
    for (eight, &byte) in digits.chunks_exact_mut(8).zip(bytes) {
        eight.copy_from_slice(&eight_digits(byte));
    }
}

/// The digits of a number below 10^8, the first in the lowest byte: four and four, then two and
/// two, then one and one are taken apart at once.
fn eight_decimals(number: u64) -> u64 {
    let fours = (number / 10_000) | ((number % 10_000) << 32);
    let hundreds = (fours * 10_486) >> 20 & 0x0000_007f_0000_007f;
    let twos = hundreds | ((fours - hundreds * 100) << 16);
    let tens = (twos * 103) >> 10 & 0x000f_000f_000f_000f;
    tens | ((twos - tens * 10) << 8)
}

/// The bits of a byte as text, the highest first: a copy for each, whose bit stands at the top of
/// a byte of its own.
pub fn eight_digits(byte: u8) -> [u8; 8] {
    let ones = u64::from(byte).wrapping_mul(0x8040_2010_0804_0201) >> 7 & 0x0101_0101_0101_0101;
    (ones | 0x3030_3030_3030_3030).to_le_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(text: &mut Text, time: u64) -> String {
        text.clear();
        text.time(time);
        String::from_utf8(text.bytes().to_vec()).unwrap()
    }

    /// However the lines lie in the buffer when it grows, and however long a name is.
    #[test]
    fn there_is_room_for_every_line() {
        let names: &[&str] = vec![&*"LONG_".repeat(50).leak()].leak();
        let mut signals = Signals::new();
        signals.push(1, 64, Some(names));
        signals.push(3, 64, None);
        let changes: Vec<_> = (0..100)
            .map(|index| match index % 5 {
                0 => Change { leaf: 0, bits: 0 },
                _ => Change {
                    leaf: 1,
                    bits: u64::MAX - index,
                },
            })
            .collect();
        let expected: String = (changes.iter())
            .map(|change| match change.leaf {
                0 => format!(
                    "b0 {}\ns{} {}\n",
                    IdCode::from(1u32),
                    names[0],
                    IdCode::from(2u32)
                ),
                _ => format!("b{:b} {}\n", change.bits, IdCode::from(3u32)),
            })
            .collect();
        for before in (0..8_000).step_by(7) {
            let mut text = Text::new(Vec::new());
            text.raw(&vec![b'x'; before]);
            for _ in 0..3 {
                text.changes(&signals, &changes);
            }
            assert!(
                text.bytes()[before..] == *expected.repeat(3).as_bytes(),
                "{before}"
            );
        }
    }

    /// Of every length, over what is left of longer lines, with codes of every length.
    #[test]
    fn values_of_every_length() {
        let variables = [1, 93, 94, 100_000, 10_000_000, u32::MAX];
        for variable in variables {
            let mut signals = Signals::new();
            signals.push(variable, 64, None);
            signals.push(variable, 1, None);
            let code = IdCode::from(variable);
            let mut text = Text::new(Vec::new());
            for bits in (0..64).flat_map(|place| [1 << place, u64::MAX >> place, 0x5a5a << place]) {
                text.clear();
                text.raw(&[b'x'; 3 * LINE]);
                text.clear();
                text.changes(&signals, &[0, 1].map(|leaf| Change { leaf, bits }));
                let wanted = format!("b{bits:b} {code}\n{}{code}\n", bits & 1);
                assert_eq!(str::from_utf8(text.bytes()).unwrap(), wanted);
            }
        }
    }

    /// However they lie in the buffer when it grows.
    #[test]
    fn states_without_a_name_are_numbers() {
        let mut signals = Signals::new();
        signals.push(1, 64, Some(&["IDLE"]));
        let changes = [0, 1].map(|bits| Change { leaf: 0, bits });
        let long = [Change {
            bits: u64::MAX,
            ..changes[0]
        }; 500];
        let wanted = "b0 \"\nsIDLE #\nb1 \"\ns1 #\n".to_owned();
        let wanted = wanted + &format!("b{0:b} \"\ns{0} #\n", u64::MAX).repeat(500);
        for before in (0..8_000).step_by(70) {
            let mut text = Text::new(Vec::new());
            text.raw(&vec![b'x'; before]);
            text.changes(&signals, &changes);
            text.changes(&signals, &long);
            assert!(text.bytes()[before..] == *wanted.as_bytes(), "{before}");
        }
    }

    #[test]
    fn times_of_every_length_in_any_order() {
        let mut text = Text::new(Vec::new());
        let powers = (0..20).map(|power| 10u64.pow(power));
        let around = powers.flat_map(|power| [power - 1, power, power + 1, power / 8 * 9]);
        for time in around.chain([0, 9_999, 99_990_000, u64::MAX, 7]) {
            assert_eq!(line(&mut text, time), format!("#{time}\n"));
        }
        for time in 0..200_000 {
            assert_eq!(
                line(&mut text, 99_900_000 + time),
                format!("#{}\n", 99_900_000 + time)
            );
        }
    }
}
