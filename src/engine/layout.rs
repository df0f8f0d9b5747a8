//! Where everything of a plan stands: one slab of words.

/// A place in the slab.
pub type Slot = u32;

/// The slab: bits that say which blocks are to run, then ports in, registers, nets, memories.
#[derive(Debug, Clone, Default)]
pub struct Layout {
    /// How many words it has.
    pub words: Slot,
    /// High where a watched word has changed.
    pub event: Slot,
    /// A bit for each block that is to run.
    pub dirty: Slot,
    /// A bit for each block whose shadows are to be taken over, as in `dirty`.
    pub commit: Slot,
    /// A bit for each watched word that has changed.
    pub changed: Slot,
    /// The words of `dirty` and of `commit`.
    pub block_words: Slot,
    /// The words of `changed`.
    pub changed_words: Slot,
    /// Ports in.
    pub inputs: Vec<Slot>,
    /// The bit of each block.
    pub bits: Vec<u32>,
    /// Where the leaves of a walk are.
    pub leaves: Vec<Spot>,
    /// Where the properties are.
    pub properties: Vec<Spot>,
    /// What is watched, in the order of the bits of `changed`.
    pub watched: Vec<Watched>,
    /// By slot: the words of `dirty` and what is to be set in them where it changes.
    pub readers: Vec<Vec<(Slot, u64)>>,
    /// By slot: what is to be set where it changes.
    pub changes: Vec<Option<Change>>,
    /// What stands in it at power-on, where that is not 0.
    pub initial: Vec<(Slot, u64)>,
    /// What stands in it all the time: these too are in `initial`.
    pub constants: Vec<(Slot, u64)>,
}

/// A watched word, or the mark of a memory.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Watched {
    /// Where it is.
    pub slot: Slot,
    /// The leaves that show it; of a memory all its words.
    pub leaves: Vec<u32>,
    /// The memory whose mark it is.
    pub memory: Option<u32>,
}

/// A bit of `changed`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Change {
    /// The word.
    pub word: Slot,
    /// The bit in it.
    pub mask: u64,
}

/// Where a leaf is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spot {
    /// In the slab.
    Slot(Slot),
    /// It is always this.
    Constant(u64),
    /// A stage of a shift register.
    Stage(u32, u32),
    /// Nobody asked for it.
    Gone,
}

impl Layout {
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

    /// So many more words.
    pub(super) fn take(&mut self, words: u32) -> Slot {
        self.words += words;
        self.words - words
    }

    /// A slab at power-on: every block is to run.
    pub fn power_on(&self) -> Vec<u64> {
        let mut slab = vec![0; self.words as usize];
        for &(slot, word) in &self.initial {
            slab[slot as usize] = word;
        }
        self.wake(&mut slab);
        slab
    }

    /// Every block is to run.
    pub fn wake(&self, slab: &mut [u64]) {
        for bit in &self.bits {
            slab[(self.dirty + bit / 64) as usize] |= 1 << (bit % 64);
        }
    }
}
