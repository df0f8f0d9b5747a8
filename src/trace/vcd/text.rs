//! Values as lines of text.

use super::time::{self, Times};
use crate::trace::walk::Change;
use std::num::NonZeroU32;
use vcd::IdCode;

/// Longest line of a number: `b`, 64 digits, the line end with its padding.
const LINE: usize = 1 + 64 + END;
/// Space for the end of a line.
const END: usize = 8;
/// Number of changes for which space is reserved at once.
const SOME: usize = 64;
/// Initial size of the buffer in bytes, doubled if a tick needs more.
const ROOM: usize = 16 * 1024;

/// Text form of a leaf. There is one per leaf and every change reads one, so it is small.
#[derive(Debug, Clone, Copy)]
struct Signal {
    end: End,
    /// Index of its states from 1, if it has any.
    states: Option<NonZeroU32>,
}

/// Text after a value on its line.
#[derive(Debug, Clone, Copy)]
struct End {
    /// For a word: space, code, line end; for a scalar the same without the space. Padded with
    /// zeros: up to five characters hold any 32-bit index.
    text: [u8; END],
    /// Length of the text.
    len: u8,
    /// True for a word, which has a `b` before its digits.
    word: bool,
}

/// Names of values.
#[derive(Debug, Clone, Copy)]
struct States {
    names: &'static [&'static str],
    end: End,
}

/// Text forms of all leaves.
#[derive(Debug)]
pub struct Signals {
    signals: Vec<Signal>,
    states: Vec<States>,
    /// Greatest length of the lines of a change, with padding.
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

    /// Adds the next leaf. The names of its states are the variable after its own.
    pub fn push(&mut self, variable: u32, width: usize, names: Option<&'static [&'static str]>) {
        let states = names.and_then(|names| {
            self.states.push(States {
                names,
                end: End::new(variable + 1, true),
            });
            // A number has at most twenty digits.
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

    /// Writes the end at a position in a line; returns the end of the line.
    #[inline(always)]
    fn put(&self, line: &mut [u8], at: usize) -> usize {
        line[at..][..END].copy_from_slice(&self.text);
        at + usize::from(self.len)
    }

    /// Writes the line of a value and returns its length. Leading zeros are left out: a reader
    /// extends a value that begins with 1 by zeros.
    ///
    /// Branches on changes and lengths cannot be predicted: writing more digits than needed costs
    /// less than a branch.
    #[inline(always)]
    fn line(&self, line: &mut [u8], bits: u64) -> usize {
        let lead = usize::from(self.word);
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

/// Lines that are not yet written.
#[derive(Debug)]
pub struct Text {
    /// Longer than the text, so that a line can be stored at its full length.
    buffer: Vec<u8>,
    len: usize,
    times: Times,
}

impl Text {
    pub fn new(head: Vec<u8>) -> Self {
        let len = head.len();
        let mut buffer = head;
        buffer.resize(len + ROOM, 0);
        Text {
            buffer,
            len,
            times: Times::default(),
        }
    }

    pub fn bytes(&self) -> &[u8] {
        &self.buffer[..self.len]
    }

    pub fn clear(&mut self) {
        self.len = 0;
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

    pub fn raw(&mut self, bytes: &[u8]) {
        self.room(bytes.len());
        self.buffer[self.len..][..bytes.len()].copy_from_slice(bytes);
        self.len += bytes.len();
    }

    /// Adds the lines of new values.
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

    /// Adds a time, and the text that follows on and after its line.
    #[inline(always)]
    pub fn time<const N: usize>(&mut self, time: u64, then: &[u8; N]) {
        self.room(time::ROOM);
        if let Some(line) = self.buffer[self.len..].first_chunk_mut() {
            self.len += self.times.put(line, time, then);
        }
    }
}

/// Writes the bits of bytes, eight digits each.
#[inline(always)]
fn put_digits(mut digits: &mut [u8], bytes: &[u8]) {
    for &byte in bytes {
        let Some((eight, behind)) = digits.split_first_chunk_mut() else {
            break;
        };
        *eight = eight_digits(byte);
        digits = behind;
    }
}

/// Returns the bits of a byte as text, the highest first: a copy for each, whose bit is at the top
/// of its own byte.
#[inline]
pub fn eight_digits(byte: u8) -> [u8; 8] {
    let ones = u64::from(byte).wrapping_mul(0x8040_2010_0804_0201) >> 7 & 0x0101_0101_0101_0101;
    (ones | 0x3030_3030_3030_3030).to_le_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines fit wherever they are in the buffer when it grows, and however long a name is.
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

    /// Values of every length, over the rest of longer lines, with codes of every length.
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
                let scalar = bits & 1;
                let changes = [(0, bits), (1, scalar)].map(|(leaf, bits)| Change { leaf, bits });
                text.changes(&signals, &changes);
                let wanted = format!("b{bits:b} {code}\n{scalar}{code}\n");
                assert_eq!(str::from_utf8(text.bytes()).unwrap(), wanted);
            }
        }
    }

    /// Names fit wherever they are in the buffer when it grows.
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
}
