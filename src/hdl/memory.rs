//! Memories: handles to them, and their power-on contents.

use super::build::{self, Id};
use super::property;
use super::record::{Cells, MemoryShape, Source};
use super::words::{Bit, U};
use crate::netlist::{Field, Node, Site, unsigned};
use bitvec::prelude::*;
use std::sync::Arc;

/// Greatest width of a memory's address in bits. Every word is a signal with a name of its own: millions
/// of them take gigabytes.
pub(crate) const MOST_ADDRESS: usize = 17;

/// A memory with one write port, before the edge.
///
/// This is a handle: [`write`](Self::write) takes it by value, so the new contents cannot be read
/// in the same tick. A read in the tick of a write to the same address returns the old word
/// (read-first).
#[derive(Debug)]
pub struct Ram(pub(super) usize);

/// A shift register before the edge. Stage 0 takes the input, stage k the word of stage k − 1. A
/// handle like [`Ram`].
#[derive(Debug)]
pub struct Shift {
    pub(super) memory: usize,
    pub(super) stages: usize,
}

/// Effect of an edge on a memory.
#[derive(Debug, Clone, Copy, Default)]
pub struct Written(pub(super) Option<(usize, State)>);

/// Kind of write to a memory.
#[derive(Debug, Clone, Copy)]
pub(super) enum State {
    Kept,
    Written { enable: Id, address: Id, data: Id },
    Shifted { enable: Id, data: Id },
}

impl Ram {
    /// Reads the word at `address`, combinationally.
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

    /// Returns the next value of an output register: the word at `address` if `enable` is high,
    /// else `held`. Block RAM has this form.
    #[track_caller]
    pub fn read_when(&self, enable: Bit, address: U, held: U) -> U {
        let read = self.read(address);
        let next = enable.mux(read, held);
        U(build::called(next.0, "", read.0))
    }

    /// Writes `data` at `address` if `enable` is high; returns the memory after the edge.
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

    /// Leaves the memory unchanged.
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

    /// Returns the number of stages.
    pub fn stages(&self) -> usize {
        self.stages
    }

    /// Returns stage `index`, counted from the input; 0 is the newest.
    #[track_caller]
    pub fn stage(&self, index: usize) -> U {
        match index < self.stages {
            true => self.read(build::constant(index as u64, unsigned(64))),
            false => {
                let name = build::builder(|builder| builder.memory_name(self.memory).to_owned());
                let last = self.stages.saturating_sub(1);
                build::mistake(
                    build::here(),
                    format!("stage {index} of `{name}`, which has 0 to {last}"),
                );
                self.zero()
            }
        }
    }

    /// Returns the stage that `tap` selects; zero if there is no such stage.
    #[track_caller]
    pub fn tap(&self, tap: U) -> U {
        // A single stage has no index.
        let stage = match self.stages {
            0 | 1 => self.stage(0),
            _ => self.read(tap.0),
        };
        // A tap that can select more stages than there are reads zero for those.
        let stages = self.stages as u64;
        match stages.checked_shr(tap.width() as u32).unwrap_or(0) {
            0 => {
                let known = tap.below(stages).mux(stage, self.zero());
                U(build::called(known.0, "", stage.0))
            }
            _ => stage,
        }
    }

    /// Shifts by one stage if `enable` is high; returns the register after the edge.
    #[track_caller]
    pub fn shift(self, enable: Bit, input: U) -> Written {
        let shape = build::memory_shape(self.memory);
        let shifted = State::Shifted {
            enable: enable.0,
            data: build::fit(input.0, unsigned(shape.width), "the word shifted in"),
        };
        Written(Some((self.memory, shifted)))
    }

    /// Leaves the register unchanged.
    pub fn keep(self) -> Written {
        Written(Some((self.memory, State::Kept)))
    }
}

/// Words of a memory or stages of a shift register, in [properties](super::Moment).
#[derive(Debug, Clone, Copy)]
pub struct Words {
    memory: usize,
    words: usize,
    /// True for the words before the edge, in a property over one.
    past: bool,
}

impl Words {
    pub(super) fn of(cells: &Cells) -> Self {
        Words {
            memory: cells.first,
            words: cells.words,
            past: cells.past,
        }
    }

    /// Number of words.
    #[expect(clippy::len_without_is_empty, reason = "a memory has a word at least")]
    pub fn len(&self) -> usize {
        self.words
    }

    /// Returns the word at `address`; zero past the last one.
    ///
    /// In a property over an edge, the address of a word before the edge is computed from signals
    /// before it.
    #[track_caller]
    pub fn read(&self, address: U) -> U {
        let shape = build::memory_shape(self.memory);
        let address = match shape.address {
            Some(wanted) => build::fit(address.0, unsigned(wanted), "the address"),
            None => address.0,
        };
        let word = unsigned(shape.width);
        if !self.past {
            return U(build::node(Node::Read(self.memory, address), word));
        }
        match property::before(address) {
            Some(address) => {
                let read = build::node(Node::Read(self.memory, address), word);
                U(build::node(Node::Past(read), word))
            }
            None => {
                let what = "a word before the edge is read at an address of after it";
                build::mistake(build::here(), what.to_owned());
                U(build::constant(0, word))
            }
        }
    }

    /// Returns the word with this index.
    #[track_caller]
    pub fn word(&self, index: usize) -> U {
        let address = build::memory_shape(self.memory).address.unwrap_or(64);
        self.read(U(build::constant(index as u64, unsigned(address))))
    }

    /// Returns all words in order.
    pub fn iter(&self) -> impl Iterator<Item = U> + '_ {
        (0..self.words).map(|index| self.word(index))
    }
}

/// A word of a RAM.
pub(crate) static WORD: Field = Field::named("word");
/// A word of a shift register.
pub(crate) static STAGE: Field = Field::named("stage");

/// Makes the memory of a record.
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

/// Makes the shift register of a record.
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

/// Power-on contents of a memory: the words of an image, or zeros.
#[derive(Debug, Clone, Default)]
pub struct Contents(Option<Image>);

impl Contents {
    /// Returns the contents given by `image`.
    #[doc(hidden)]
    pub fn of(image: &Image) -> Self {
        Contents(Some(image.clone()))
    }

    /// Returns the words, cut or filled with zeros to the size of the memory.
    pub(super) fn words(&self, shape: MemoryShape) -> Vec<u64> {
        let image = self.0.iter().flat_map(Image::iter);
        let mut words: Vec<u64> = image.take(shape.words).collect();
        words.resize(shape.words, 0);
        words
    }

    /// Returns address and word width of the image, if there is one.
    pub(super) fn shape(&self) -> Option<(usize, usize)> {
        self.0.as_ref().map(|image| (image.address, image.width))
    }

    /// Returns a message about values that do not fit the image, and where they were given.
    pub(super) fn wrong(&self) -> Option<(Site, String)> {
        self.0.as_ref().and_then(Image::wrong)
    }
}

/// Contents of a memory, known at elaboration: a ROM, or the power-on contents of a RAM.
///
/// Words and addresses that do not fit are a mistake of the circuit that has the image: see
/// [`elaborate`](super::elaborate()).
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    address: usize,
    width: usize,
    /// First word that does not fit.
    unfit: Option<Unfit>,
    /// Shared, since circuits are cloned often.
    bits: Arc<BitVec<usize, Lsb0>>,
}

/// Word that does not fit its image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Unfit {
    /// Source location that gave the word.
    site: Site,
    address: usize,
    word: u64,
    /// Number of further words that do not fit.
    others: usize,
}

impl Image {
    /// Returns 2^`address` words of `width` bits, all zero. An address has at most 16 bits, a word
    /// 1 to 64. Other sizes give an image without words, which no memory accepts.
    pub fn new(address: usize, width: usize) -> Self {
        let words = match (address, width) {
            (0..=MOST_ADDRESS, 1..=64) => 1 << address,
            _ => 0,
        };
        Image {
            address,
            width,
            unfit: None,
            bits: Arc::new(bitvec![usize, Lsb0; 0; words * width]),
        }
    }

    /// Returns an image whose words `word` computes from the address.
    #[track_caller]
    pub fn from_fn(address: usize, width: usize, word: impl FnMut(usize) -> u64) -> Self {
        Image::made(address, width, build::here(), word)
    }

    /// Returns an image with the given words from address 0 up, filled with zeros.
    #[track_caller]
    pub fn of(address: usize, width: usize, words: impl IntoIterator<Item = u64>) -> Self {
        let site = build::here();
        let mut words = words.into_iter();
        let mut image = Image::made(address, width, site, |_| words.next().unwrap_or(0));
        if let Some(word) = words.next() {
            image.refuse(site, image.words(), word);
        }
        image
    }

    fn made(address: usize, width: usize, site: Site, mut word: impl FnMut(usize) -> u64) -> Self {
        let mut image = Image::new(address, width);
        for address in 0..image.words() {
            image.put(site, address, word(address));
        }
        image
    }

    /// Records a word that does not fit.
    #[cold]
    fn refuse(&mut self, site: Site, address: usize, word: u64) {
        match &mut self.unfit {
            Some(first) => first.others += 1,
            None => {
                self.unfit = Some(Unfit {
                    site,
                    address,
                    word,
                    others: 0,
                })
            }
        }
    }

    /// Returns a message about values that do not fit, and where they were given.
    fn wrong(&self) -> Option<(Site, String)> {
        let Unfit {
            site,
            address,
            word,
            others,
        } = self.unfit?;
        let mut wrong = match address < self.words() {
            true => match build::fits(word.into(), unsigned(self.width)) {
                Err(wrong) => format!("word {address}: {wrong}"),
                Ok(()) => return None,
            },
            false => format!(
                "word {address}: there are {} words, counted from 0",
                self.words()
            ),
        };
        if others > 0 {
            wrong += &format!("; so with {others} more");
        }
        Some((site, wrong))
    }

    /// Returns the number of words.
    pub fn words(&self) -> usize {
        self.bits.len() / self.width.max(1)
    }

    /// Returns the width of an address in bits.
    pub fn address(&self) -> usize {
        self.address
    }

    /// Returns the width of a word in bits.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Returns the words, from address 0 up.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = u64> {
        self.bits
            .chunks_exact(self.width.max(1))
            .map(|word| word.load_le::<u64>())
    }

    /// Returns the word at `address`; `None` if there is no such address.
    pub fn get(&self, address: usize) -> Option<u64> {
        let bits = self.place(address).and_then(|place| self.bits.get(place));
        bits.map(|word| word.load_le::<u64>())
    }

    /// The words in an image of other widths; words that it has no room for are a mistake, unless
    /// they are zeros at the end.
    #[track_caller]
    pub fn resized(&self, address: usize, width: usize) -> Self {
        match (self.address, self.width) == (address, width) {
            true => self.clone(),
            false => Image::of(address, width, self.written()),
        }
    }

    /// The words up to the last that is not zero.
    pub(super) fn written(&self) -> Vec<u64> {
        let mut words: Vec<u64> = self.iter().collect();
        while words.pop_if(|word| *word == 0).is_some() {}
        words
    }

    /// Replaces the word at `address`.
    #[track_caller]
    pub fn set(&mut self, address: usize, word: u64) {
        self.put(build::here(), address, word);
    }

    fn put(&mut self, site: Site, address: usize, word: u64) {
        let mask = u64::MAX >> (64 - self.width.clamp(1, 64));
        if address >= self.words() || word & !mask != 0 {
            self.refuse(site, address, word);
        }
        let place = self.place(address);
        if let Some(bits) = place.and_then(|place| Arc::make_mut(&mut self.bits).get_mut(place)) {
            bits.store_le(word & mask);
        }
    }

    fn place(&self, address: usize) -> Option<std::ops::Range<usize>> {
        let first = address * self.width;
        (address < self.words()).then(|| first..first + self.width)
    }

    /// Reads the image combinationally, as a ROM.
    #[track_caller]
    pub fn rom(&self, address: U) -> U {
        if let Some((site, wrong)) = self.wrong() {
            build::mistake(site, format!("contents of a ROM: {wrong}"));
        }
        let memory = build::rom(self.width, self.iter().collect());
        let address = build::fit(address.0, unsigned(self.address), "the address");
        U(build::node(
            Node::Read(memory, address),
            unsigned(self.width),
        ))
    }
}
