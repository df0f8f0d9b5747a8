//! Memory layout of a plan: one slab of words.

use std::ops::Range;

/// Index of a word in the slab.
pub type Slot = u32;

/// Layout of the slab: dirty bits of the blocks, then input ports, registers, nets, memories.
#[derive(Debug, Clone, Default)]
pub struct Layout {
    /// Number of words.
    pub words: Slot,
    /// Word that is not 0 if a watched word has changed.
    pub event: Slot,
    /// First word with one bit per block that is to run.
    pub dirty: Slot,
    /// First word with one bit per block whose shadows are to be committed; same order as `dirty`.
    pub commit: Slot,
    /// First word with one bit per watched word that has changed.
    pub changed: Slot,
    /// Number of words of `dirty`, and of `commit`.
    pub block_words: Slot,
    /// Number of words of `changed`.
    pub changed_words: Slot,
    /// Input ports.
    pub inputs: Vec<Slot>,
    /// Bit of each block.
    pub bits: Vec<u32>,
    /// Spots of the leaves of a walk.
    pub leaves: Vec<Spot>,
    /// Spots of the properties.
    pub properties: Vec<Spot>,
    /// Watched words, in the order of the bits of `changed`.
    pub watched: Vec<Watched>,
    /// Leaves of the watched words, those of a word in a row.
    pub shown: Vec<u32>,
    /// By slot: words of `dirty`, and the bits to set in them when the slot changes.
    pub readers: Vec<Vec<(Slot, u64)>>,
    /// By slot: bit of `changed` to set when the slot changes.
    pub changes: Vec<Option<Change>>,
    /// Slots that are not 0 at power-on, with their words.
    pub initial: Vec<(Slot, u64)>,
    /// Slots that are constant, with their words; also in `initial`.
    pub constants: Vec<(Slot, u64)>,
}

/// Watched word, or write mark of a memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Watched {
    /// Slot of the word.
    pub slot: Slot,
    /// Range of `shown`: the leaves that show the word; for a memory, all its words.
    pub leaves: Range<u32>,
    /// Memory to which the mark belongs.
    pub memory: Option<u32>,
}

/// Bit of `changed`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Change {
    /// Word of the slab.
    pub word: Slot,
    /// Mask of the bit.
    pub mask: u64,
}

/// Spot of a leaf.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spot {
    /// Word of the slab.
    Slot(Slot),
    /// Constant.
    Constant(u64),
    /// Stage of a shift register: memory and stage.
    Stage(u32, u32),
    /// Not computed, since nothing requested it.
    Gone,
}

impl Layout {
    /// Returns the number of bits of `changed`, with the unused ones of its last word.
    pub fn marks(&self) -> usize {
        self.changed_words as usize * 64
    }

    /// Returns the leaves that show a watched word.
    #[inline]
    pub fn shown(&self, watched: &Watched) -> &[u32] {
        &self.shown[watched.leaves.start as usize..watched.leaves.end as usize]
    }

    pub(super) fn new(blocks: usize) -> Self {
        let mut layout = Layout {
            block_words: blocks.div_ceil(64) as u32,
            ..Layout::default()
        };
        layout.event = layout.take(1);
        layout.dirty = layout.take(layout.block_words);
        layout.commit = layout.take(layout.block_words);
        layout
    }

    /// Allocates `words` words; returns the first.
    pub(super) fn take(&mut self, words: u32) -> Slot {
        self.words += words;
        self.words - words
    }

    /// Returns a slab at power-on, with every block woken.
    pub fn power_on(&self) -> Vec<u64> {
        let mut slab = vec![0; self.words as usize];
        for &(slot, word) in &self.initial {
            slab[slot as usize] = word;
        }
        self.wake(&mut slab);
        slab
    }

    /// Wakes every block.
    pub fn wake(&self, slab: &mut [u64]) {
        for bit in &self.bits {
            slab[(self.dirty + bit / 64) as usize] |= 1 << (bit % 64);
        }
    }

    /// Marks every watched word as changed.
    pub fn mark(&self, slab: &mut [u64]) {
        for change in self.changes.iter().flatten() {
            slab[change.word as usize] |= change.mask;
        }
        slab[self.event as usize] = 1;
    }
}
