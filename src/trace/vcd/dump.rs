use crate::kernel::{Changed, Declaration, Field, Format, Probe, Shape, Words};
use vcd::IdCode;

/// The code of a variable, spelt out as it stands behind every value.
#[derive(Debug, Clone, Copy)]
pub struct Id {
    index: u32,
    /// Five characters hold any 32-bit index.
    text: [u8; 5],
    len: u8,
}

impl Id {
    pub fn new(index: u32) -> Self {
        let mut id = Id {
            index,
            text: [0; 5],
            len: 0,
        };
        let text = id.code().to_string();
        for (place, byte) in id.text.iter_mut().zip(text.bytes()) {
            *place = byte;
            id.len += 1;
        }
        id
    }

    pub fn code(self) -> IdCode {
        IdCode::from(self.index)
    }

    fn bytes(&self) -> &[u8] {
        &self.text[..usize::from(self.len)]
    }
}

/// How a leaf is written.
#[derive(Debug, Clone, Copy)]
pub struct Signal {
    pub id: Id,
    selected: bool,
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
            selected,
            scalar: leaf.shape.width == 1,
            states: match leaf.field.format {
                Format::States(names) => Some((id(), names)),
                _ => None,
            },
        }
    }
}

/// The walk that writes what changed.
#[derive(Debug)]
pub struct Dump {
    pub signals: Vec<Signal>,
    /// The values of the tick before, in the order of the walk.
    pub previous: Vec<u64>,
    pub clk: Id,
    /// The leaf that comes next.
    pub cursor: usize,
    /// At the first tick everything is written, changed or not.
    pub first: bool,
    /// Look at all words of memories, whatever they say they changed.
    pub every_word: bool,
    pub buffer: Vec<u8>,
}

impl Dump {
    #[inline]
    fn look(&mut self, index: usize, bits: u64) {
        if self.previous[index] != bits || self.first {
            self.previous[index] = bits;
            self.change(index, bits);
        }
    }

    fn change(&mut self, index: usize, bits: u64) {
        let Signal {
            id,
            selected,
            scalar,
            states,
        } = self.signals[index];
        if !selected {
            return;
        }
        if scalar {
            self.scalar(b'0' + (bits & 1) as u8, id);
        } else {
            self.vector(bits, id);
        }
        if let Some((id, names)) = states {
            self.state(bits, names, id);
        }
    }

    pub fn scalar(&mut self, digit: u8, id: Id) {
        self.buffer.push(digit);
        self.end_line(id);
    }

    /// Leading zeros are left out: a reader extends a value that begins with 1 by zeros.
    fn vector(&mut self, bits: u64, id: Id) {
        let mut digits = [0; 64];
        let digits = &mut digits[..(64 - bits.leading_zeros()).max(1) as usize];
        let mut rest = bits;
        for digit in digits.iter_mut().rev() {
            *digit = b'0' + (rest & 1) as u8;
            rest >>= 1;
        }
        self.buffer.push(b'b');
        self.buffer.extend_from_slice(digits);
        self.buffer.push(b' ');
        self.end_line(id);
    }

    fn state(&mut self, bits: u64, names: &[&str], id: Id) {
        self.buffer.push(b's');
        let name = usize::try_from(bits).ok().and_then(|bits| names.get(bits));
        match name {
            Some(name) => self.buffer.extend_from_slice(name.as_bytes()),
            None => self.decimal(bits),
        }
        self.buffer.push(b' ');
        self.end_line(id);
    }

    pub fn time(&mut self, time: u64) {
        self.buffer.push(b'#');
        self.decimal(time);
        self.buffer.push(b'\n');
    }

    fn decimal(&mut self, number: u64) {
        let mut digits = [0; 20];
        let mut start = digits.len();
        let mut rest = number;
        loop {
            start -= 1;
            digits[start] = b'0' + (rest % 10) as u8;
            rest /= 10;
            if rest == 0 {
                break;
            }
        }
        self.buffer.extend_from_slice(&digits[start..]);
    }

    fn end_line(&mut self, id: Id) {
        self.buffer.extend_from_slice(id.bytes());
        self.buffer.push(b'\n');
    }
}

impl Probe for Dump {
    #[inline]
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        let index = self.cursor;
        self.cursor += 1;
        self.look(index, bits);
    }

    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let start = self.cursor;
        self.cursor += words.len();
        let changed = if self.every_word {
            Changed::All
        } else {
            words.changed()
        };
        match changed {
            Changed::None => {}
            Changed::One(index) => self.look(start + index, words.word(index)),
            Changed::All => {
                for index in 0..words.len() {
                    self.look(start + index, words.word(index));
                }
            }
        }
    }
}
