//! Values as lines of text.

use crate::kernel::{Declaration, Format};
use crate::trace::walk::Change;
use vcd::IdCode;

/// The longest line of a number: `b`, 64 digits, the end of the line with its padding.
const LINE: usize = 1 + 64 + 8;
/// Changes for which there is room at once.
const SOME: usize = 64;
/// The room in the buffer at first, doubled where a tick needs more.
const ROOM: usize = 16 * 1024;
/// Eight digits more.
const EIGHT: u64 = 100_000_000;

/// The code of a variable, spelt out as it stands behind every value: up to five characters hold
/// any 32-bit index.
#[derive(Debug, Clone, Copy)]
pub struct Id {
    index: u32,
    /// A space, the code, the end of the line; zeros behind it.
    end: [u8; 8],
    /// How much of that there is.
    len: u8,
}

impl Id {
    pub fn new(index: u32) -> Self {
        let code = IdCode::from(index).to_string();
        let mut end = [0; 8];
        let text = " ".bytes().chain(code.bytes()).chain("\n".bytes());
        for (place, byte) in end.iter_mut().zip(text) {
            *place = byte;
        }
        Id {
            index,
            end,
            len: code.len() as u8 + 2,
        }
    }

    pub fn code(self) -> IdCode {
        IdCode::from(self.index)
    }
}

/// How a leaf is written.
#[derive(Debug, Clone, Copy)]
pub struct Signal {
    pub id: Id,
    scalar: bool,
    pub states: Option<(Id, &'static [&'static str])>,
}

impl Signal {
    pub fn new(leaf: &Declaration, selected: bool, next: &mut u32) -> Self {
        let mut id = || {
            let id = Id::new(*next);
            *next += u32::from(selected);
            id
        };
        Signal {
            id: id(),
            scalar: leaf.shape.width == 1,
            states: match leaf.field.format {
                Format::States(names) => Some((id(), names)),
                _ => None,
            },
        }
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

    pub fn raw(&mut self, bytes: &[u8]) {
        for part in bytes.chunks(LINE) {
            self.line()[..part.len()].copy_from_slice(part);
            self.len += part.len();
        }
    }

    /// Lines of new values.
    pub fn changes(&mut self, signals: &[Signal], changes: &[Change]) {
        for some in changes.chunks(SOME) {
            self.room(SOME * LINE);
            for change in some {
                let signal = &signals[change.leaf as usize];
                let line = &mut self.buffer[self.len..][..LINE];
                self.len += match signal.scalar {
                    true => scalar(line, change.bits, &signal.id),
                    false => vector(line, change.bits, &signal.id),
                };
                if let Some((id, names)) = &signal.states {
                    // A name has any length.
                    self.state(change.bits, names, id);
                    self.room(SOME * LINE);
                }
            }
        }
    }

    pub fn scalar(&mut self, bit: u64, id: &Id) {
        self.len += scalar(self.line(), bit, id);
    }

    fn state(&mut self, bits: u64, names: &[&str], id: &Id) {
        let name = usize::try_from(bits).ok().and_then(|bits| names.get(bits));
        self.raw(b"s");
        match name {
            Some(name) => self.raw(name.as_bytes()),
            None => self.raw(bits.to_string().as_bytes()),
        }
        self.raw(&id.end[..usize::from(id.len)]);
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

/// Writes a line of one bit, and returns its length.
#[inline(always)]
fn scalar(line: &mut [u8], bit: u64, id: &Id) -> usize {
    line[..8].copy_from_slice(&id.end);
    // In place of the space.
    line[0] = b'0' + (bit & 1) as u8;
    usize::from(id.len)
}

/// The same of a word. Leading zeros are left out: a reader extends a value that begins with 1 by
/// zeros.
#[inline(always)]
fn vector(line: &mut [u8], bits: u64, id: &Id) -> usize {
    let digits = 64 - (bits | 1).leading_zeros() as usize;
    let mut rest = bits << (64 - digits);
    line[0] = b'b';
    for eight in line[1..65].chunks_exact_mut(8).take(digits.div_ceil(8)) {
        eight.copy_from_slice(&eight_digits((rest >> 56) as u8));
        rest <<= 8;
    }
    line[1 + digits..][..8].copy_from_slice(&id.end);
    1 + digits + usize::from(id.len)
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
        let states = Signal {
            id: Id::new(1),
            scalar: false,
            states: Some((Id::new(2), names)),
        };
        let word = Signal {
            id: Id::new(3),
            scalar: false,
            states: None,
        };
        let signals = [states, word];
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
                    "b0 {0}\ns{1} {2}\n",
                    signals[0].id.code(),
                    names[0],
                    signals[0].states.unwrap().0.code()
                ),
                _ => format!("b{:b} {}\n", change.bits, signals[1].id.code()),
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
