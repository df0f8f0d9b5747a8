//! Memories: handles to them, and what they hold at power-on.

use super::build::{self, Id};
use super::record::{Cells, MemoryShape, Source, unsigned};
use super::words::{Bit, U};
use crate::hdl::Field;
use crate::hdl::netlist::Node;
use bitvec::prelude::*;
use std::sync::Arc;

/// A memory with one write port, before the edge.
///
/// A handle: the registers of the next tick take it by value, so what is written cannot be read. A
/// read in the tick of a write to the same address sees the old word (read-first).
#[derive(Debug)]
pub struct Ram(pub(super) usize);

/// Words in a row before the edge: stage 0 takes the input, stage k what stage k - 1 held. A handle
/// like [`Ram`].
#[derive(Debug)]
pub struct Shift {
    pub(super) memory: usize,
    pub(super) stages: usize,
}

/// What an edge does to a memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Written(pub(super) Option<(usize, State)>);

/// How a memory is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    Kept,
    Written { enable: Id, address: Id, data: Id },
    Shifted { enable: Id, data: Id },
}

impl Ram {
    /// The word at `address`, combinationally.
    #[track_caller]
    pub fn read(&self, address: U) -> U {
        let shape = build::memory_shape(self.0);
        let address = match shape.address {
            Some(wanted) => build::fit(address.0, unsigned(wanted), "the address"),
            None => address.0,
        };
        U(build::node(
            Node::Read(self.0, address),
            unsigned(shape.width),
        ))
    }

    /// The next value of an output register: the word at `address` where `enable` is high, `held`
    /// where it is low. This is the form that block RAM has.
    #[track_caller]
    pub fn read_when(&self, enable: Bit, address: U, held: U) -> U {
        enable.mux(self.read(address), held)
    }

    /// The memory after the edge: `data` at `address` where `enable` is high.
    #[track_caller]
    pub fn write(self, enable: Bit, address: U, data: U) -> Written {
        let shape = build::memory_shape(self.0);
        let address = match shape.address {
            Some(wanted) => build::fit(address.0, unsigned(wanted), "the address"),
            None => address.0,
        };
        let data = build::fit(data.0, unsigned(shape.width), "the word written");
        let written = State::Written {
            enable: enable.0,
            address,
            data,
        };
        Written(Some((self.0, written)))
    }

    /// The memory as it is.
    pub fn keep(self) -> Written {
        Written(Some((self.0, State::Kept)))
    }
}

impl Shift {
    #[track_caller]
    fn read(&self, stage: Id) -> U {
        let shape = build::memory_shape(self.memory);
        U(build::node(
            Node::Read(self.memory, stage),
            unsigned(shape.width),
        ))
    }

    fn zero(&self) -> U {
        U(build::constant(
            0,
            unsigned(build::memory_shape(self.memory).width),
        ))
    }

    /// How many stages.
    pub fn stages(&self) -> usize {
        self.stages
    }

    /// Stage `index` counted from the input; one that is not there reads zero.
    #[track_caller]
    pub fn stage(&self, index: usize) -> U {
        match index < self.stages {
            true => self.read(build::constant(index as u64, unsigned(64))),
            false => self.zero(),
        }
    }

    /// The stage that `tap` names; one that is not there reads zero.
    #[track_caller]
    pub fn tap(&self, tap: U) -> U {
        // A single stage has no index.
        let stage = match self.stages {
            0 | 1 => self.stage(0),
            _ => self.read(tap.0),
        };
        // A tap that can name more stages than there are reads zero there.
        let stages = self.stages as u64;
        match stages.checked_shr(tap.width() as u32).unwrap_or(0) {
            0 => tap.below(stages).mux(stage, self.zero()),
            _ => stage,
        }
    }

    /// The register after the edge: shifted by one stage where `enable` is high.
    #[track_caller]
    pub fn shift(self, enable: Bit, input: U) -> Written {
        let shape = build::memory_shape(self.memory);
        let shifted = State::Shifted {
            enable: enable.0,
            data: build::fit(input.0, unsigned(shape.width), "the word shifted in"),
        };
        Written(Some((self.memory, shifted)))
    }

    /// The register as it is.
    pub fn keep(self) -> Written {
        Written(Some((self.memory, State::Kept)))
    }
}

/// A word of a RAM.
pub(crate) static WORD: Field = Field::named("word");
/// A word of a shift register.
pub(crate) static STAGE: Field = Field::named("stage");

/// A memory of a record.
#[doc(hidden)]
pub fn ram(
    source: &mut dyn Source,
    field: &'static Field,
    (address, width): (usize, usize),
    contents: &dyn Fn() -> Contents,
) -> Cells {
    let words = 1usize.checked_shl(address as u32).unwrap_or(0);
    let shape = MemoryShape {
        words,
        width,
        address: Some(address),
    };
    source.memory(field, &WORD, shape, contents)
}

/// A shift register of a record.
#[doc(hidden)]
pub fn shift(
    source: &mut dyn Source,
    field: &'static Field,
    (words, width): (usize, usize),
) -> Cells {
    let shape = MemoryShape {
        words,
        width,
        address: None,
    };
    source.memory(field, &STAGE, shape, &Contents::default)
}

/// What a memory holds at power-on: the words of an image, or zeros.
#[derive(Debug, Clone, Default)]
pub struct Contents(Option<Image>);

impl Contents {
    /// Those of `image`.
    #[doc(hidden)]
    pub fn of(image: &Image) -> Self {
        Contents(Some(image.clone()))
    }

    /// The words, as many and as wide as a memory of that shape has.
    pub(super) fn words(&self, shape: MemoryShape) -> Vec<u64> {
        let image = self.0.iter().flat_map(Image::iter);
        let mut words: Vec<u64> = image.take(shape.words).collect();
        words.resize(shape.words, 0);
        words
    }

    /// Widths of address and word of the image, if there is one.
    pub(super) fn shape(&self) -> Option<(usize, usize)> {
        self.0.as_ref().map(|image| (image.address, image.width))
    }
}

/// The contents of a memory, known at elaboration: a ROM, or what a RAM holds at power-on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    address: usize,
    width: usize,
    /// Circuits are cloned wherever they are looked at.
    bits: Arc<BitVec<u64, Lsb0>>,
}

impl Image {
    /// 2^`address` words of `width` bits, all zero. An address has at most 24 bits, a word 1 to 64:
    /// of others there is an image without words, which no memory takes.
    pub fn new(address: usize, width: usize) -> Self {
        let words = match (address, width) {
            (0..=24, 1..=64) => 1 << address,
            _ => 0,
        };
        Image {
            address,
            width,
            bits: Arc::new(bitvec![u64, Lsb0; 0; words * width]),
        }
    }

    /// The words that `word` gives, each cut to the width.
    pub fn from_fn(address: usize, width: usize, mut word: impl FnMut(usize) -> u64) -> Self {
        let mut image = Image::new(address, width);
        let bits = Arc::make_mut(&mut image.bits);
        for (address, place) in bits.chunks_exact_mut(width.max(1)).enumerate() {
            place.store_le(word(address) & u64::MAX >> (64 - width));
        }
        image
    }

    /// The given words from address 0 up, each cut to the width, zeros behind them; words past the
    /// last address are left out.
    pub fn of(address: usize, width: usize, words: impl IntoIterator<Item = u64>) -> Self {
        let mut words = words.into_iter();
        Image::from_fn(address, width, |_| words.next().unwrap_or(0))
    }

    /// The number of words.
    pub fn words(&self) -> usize {
        self.bits.len() / self.width.max(1)
    }

    /// Width of an address in bits.
    pub fn address(&self) -> usize {
        self.address
    }

    /// Width of a word in bits.
    pub fn width(&self) -> usize {
        self.width
    }

    fn place(&self, address: usize) -> std::ops::Range<usize> {
        let first = address % self.words().max(1) * self.width;
        first..first + self.width
    }

    /// Its words, from address 0 up.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = u64> {
        self.bits
            .chunks_exact(self.width.max(1))
            .map(|word| word.load_le())
    }

    /// The word at `address`, which wraps at the number of words.
    pub fn get(&self, address: usize) -> u64 {
        let place = self.place(address);
        self.bits.get(place).map_or(0, |word| word.load_le())
    }

    /// Replaces the word at `address`, which wraps at the number of words, by the low bits of
    /// `word`.
    pub fn set(&mut self, address: usize, word: u64) {
        let place = self.place(address);
        if let Some(bits) = Arc::make_mut(&mut self.bits).get_mut(place) {
            bits.store_le(word & u64::MAX >> (64 - bits.len()));
        }
    }

    /// Combinational read as a ROM.
    #[track_caller]
    pub fn rom(&self, address: U) -> U {
        let memory = build::rom(self.width, self.iter().collect());
        let address = build::fit(address.0, unsigned(self.address), "the address");
        U(build::node(
            Node::Read(memory, address),
            unsigned(self.width),
        ))
    }
}
