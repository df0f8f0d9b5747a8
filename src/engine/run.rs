use super::flat::{Flat, Op, Place, mask};
use super::input::InputError;
use super::interpreter::{self, Counts};
use super::layout::Spot;
use super::lines::Lines;
use super::program::Program;
use super::tier::Tier;
use super::value;
use std::cell::RefCell;
use std::sync::Arc;

/// A circuit that runs, its type forgotten.
///
/// A tick is: [`input`](Self::input) for ports in that change, [`settle`](Self::settle), a look at
/// the leaves, [`edge`](Self::edge).
#[derive(Debug)]
pub struct Engine {
    program: Arc<Program>,
    slab: Vec<u64>,
    tier: Tier,
    lines: Option<Box<Lines>>,
    pause: Pause,
    /// All blocks run in every tick.
    straight: bool,
    /// All leaves of this tick, where one was asked for that is not watched.
    whole: RefCell<Option<Vec<u64>>>,
    /// The words of memories that were asked for, and how often they had been written then.
    memories: RefCell<Vec<Option<Read>>>,
}

impl Clone for Engine {
    fn clone(&self) -> Self {
        let mut tier = self.tier.clone();
        tier.adopt();
        Engine {
            program: self.program.clone(),
            slab: self.slab.clone(),
            tier,
            lines: None,
            pause: self.pause,
            straight: self.straight,
            whole: RefCell::default(),
            memories: RefCell::default(),
        }
    }
}

/// A memory's words, and how often it had been written.
type Read = (u64, Arc<[u64]>);

/// When idle ticks are looked for again.
#[derive(Debug, Clone, Copy, Default)]
struct Pause {
    /// Ticks to come until then.
    left: u64,
    /// Ticks the last one was of.
    ticks: u64,
    /// By how much more tries took of late than they saved, in compiled steps.
    debt: i64,
}

impl Pause {
    /// Ticks of a pause at most: where tries have paid of late, and where they have not.
    const LONGEST: [u64; 2] = [64, 512];
    const CREDIT: i64 = 1 << 20;

    fn after(&mut self, took: u64, saved: u64) {
        let took = took as i64;
        let saved = saved.min(u32::MAX.into()) as i64;
        // What is long ago counts for less, and what long jumps save not for ever.
        self.debt = (self.debt - self.debt / 64 + took - saved).max(-Self::CREDIT);
        let pays = self.debt <= 0;
        self.ticks = match saved > 0 && pays {
            true => 0,
            false => (2 * self.ticks).clamp(1, Self::LONGEST[usize::from(!pays)]),
        };
        self.left = self.ticks;
    }
}

impl Engine {
    /// At power-on, all ports in low.
    pub(crate) fn new(program: Arc<Program>) -> Self {
        Engine {
            slab: program.plan.layout.power_on(),
            tier: Tier::new(&program.plan),
            program,
            lines: None,
            pause: Pause::default(),
            straight: false,
            whole: RefCell::default(),
            memories: RefCell::default(),
        }
    }

    /// The same that compiles at once, with all blocks in line: where each tick is another state.
    pub(crate) fn straight(program: Arc<Program>) -> Self {
        let mut engine = Engine::new(program);
        engine.straight = engine.tier.straight(&engine.program.plan);
        engine
    }

    /// What runs.
    #[inline]
    pub(crate) fn program(&self) -> &Program {
        &self.program
    }

    /// Sets a port in by its number, counted from 0, to the bits of `word`.
    ///
    /// # Errors
    /// There is no such port, or the word is wider than it; nothing is set then.
    pub fn input(&mut self, port: usize, word: u64) -> Result<(), InputError> {
        self.check(port, word)?;
        self.drive(port, word);
        Ok(())
    }

    /// Sets all ports in to the bits of `words`.
    ///
    /// # Errors
    /// The number of words is not that of the ports, or a word is wider than its port; nothing is
    /// set then.
    pub fn inputs(&mut self, words: &[u64]) -> Result<(), InputError> {
        let ports = self.ports();
        if words.len() != ports {
            let words = words.len();
            return Err(InputError::Count { words, ports });
        }
        for (port, &word) in words.iter().enumerate() {
            self.check(port, word)?;
        }
        self.drive_all(words);
        Ok(())
    }

    fn check(&self, port: usize, word: u64) -> Result<(), InputError> {
        match self.flat().inputs.get(port) {
            Some(&width) if word & !mask(width) == 0 => Ok(()),
            Some(&width) => Err(InputError::bits(port.to_string(), word, width.into())),
            None => {
                let ports = self.ports();
                Err(InputError::Port { port, ports })
            }
        }
    }

    /// Number of ports in.
    pub fn ports(&self) -> usize {
        self.flat().inputs.len()
    }

    /// Sets a port in to a word that fits it.
    #[inline]
    pub(crate) fn drive(&mut self, port: usize, word: u64) {
        let layout = &self.program.plan.layout;
        let Some(&slot) = layout.inputs.get(port) else {
            return;
        };
        if self.slab[slot as usize] != word {
            interpreter::put(layout, &mut self.slab, slot, word);
            *self.whole.get_mut() = None;
        }
    }

    /// Sets the first ports in to words that fit them.
    #[inline]
    pub(crate) fn drive_all(&mut self, words: &[u64]) {
        for (port, &word) in words.iter().enumerate() {
            self.drive(port, word);
        }
    }

    /// Bits that stand at a port in; `None` if there is no such port.
    #[inline]
    pub fn port(&self, port: usize) -> Option<u64> {
        let slot = self.program.plan.layout.inputs.get(port);
        slot.map(|&slot| self.slab[slot as usize])
    }

    /// Settles the nets.
    #[inline]
    pub fn settle(&mut self) {
        self.tier.settle(&self.program.plan, &mut self.slab);
    }

    /// Makes the registers of the next tick. What has changed is counted from here.
    #[inline]
    pub fn edge(&mut self) {
        self.begin();
        self.pause.left = self.pause.left.saturating_sub(1);
        self.tier.edge(&self.program.plan, &mut self.slab);
    }

    /// An edge with reset: flip-flops as at power-on, memories as the edge makes them.
    pub fn reset(&mut self) {
        self.edge();
        let program = &self.program;
        for (register, &word) in program.plan.registers.iter().zip(&program.power_on) {
            interpreter::put(&program.plan.layout, &mut self.slab, register.slot, word);
        }
        // The edge that would make a register again what it was has nothing else to wake it.
        self.wake_all();
    }

    #[inline]
    fn begin(&mut self) {
        let layout = &self.program.plan.layout;
        self.slab[layout.event as usize] = 0;
        let changed = layout.changed as usize;
        self.slab[changed..changed + layout.changed_words as usize].fill(0);
        *self.whole.get_mut() = None;
    }

    /// Up to so many times an edge and a settling with ports in as they are; ends where a watched
    /// leaf has changed. Returns how often.
    pub(crate) fn advance(&mut self, ticks: u64) -> u64 {
        self.begin();
        let event = self.program.plan.layout.event as usize;
        let mut done = 0;
        while done < ticks && self.slab[event] == 0 {
            done += self
                .tier
                .advance(&self.program.plan, &mut self.slab, ticks - done);
        }
        self.pause.left = self.pause.left.saturating_sub(done);
        done
    }

    /// Whether something watched has changed since the tick before.
    pub(crate) fn has_changed(&self) -> bool {
        self.slab[self.program.plan.layout.event as usize] != 0
    }

    /// Goes over idle ticks, of this settled one and at most `most` in all, ports in as they are.
    /// Returns how many, 0 where it is not idle or none are looked for yet; the one behind them is
    /// yet to settle. In none of them, the first aside, has a port out changed.
    pub(crate) fn forward(&mut self, most: u64) -> u64 {
        if self.pause.left > 0 || most < 2 {
            return 0;
        }
        let program = &self.program;
        let lines = self
            .lines
            .get_or_insert_with(|| Box::new(Lines::new(&program.plan, &program.held)));
        let ticks = lines.horizon(&program.plan, self.tier.hot(), &self.slab, most);
        let saved = if ticks < 2 {
            0
        } else {
            ticks.saturating_mul(self.tier.pace())
        };
        self.pause.after(lines.work(), saved);
        if ticks < 2 {
            return 0;
        }
        self.begin();
        if let Some(lines) = &mut self.lines {
            lines.jump(&self.program.plan, &mut self.slab, ticks);
        }
        ticks
    }

    /// For how many ticks it is not asked again whether they are idle.
    pub(crate) fn pause(&self) -> u64 {
        self.pause.left.max(1)
    }

    /// How many leaves there are.
    pub fn leaves(&self) -> usize {
        self.program.plan.layout.leaves.len()
    }

    /// Bits of a leaf of the walk; `None` if there is no such leaf. A net needs a settled tick.
    pub fn leaf(&self, leaf: usize) -> Option<u64> {
        (leaf < self.leaves()).then(|| self.word(leaf))
    }

    /// Bits of a leaf that is there.
    #[inline]
    pub(crate) fn word(&self, leaf: usize) -> u64 {
        match self.program.plan.layout.leaves.get(leaf) {
            Some(Spot::Slot(slot)) => self.slab[*slot as usize],
            Some(spot) => self.spot(*spot, leaf),
            None => 0,
        }
    }

    fn spot(&self, spot: Spot, leaf: usize) -> u64 {
        match spot {
            Spot::Slot(slot) => self.slab[slot as usize],
            Spot::Constant(word) => word,
            Spot::Stage(memory, stage) => {
                let memory = &self.program.plan.memories[memory as usize];
                interpreter::read(memory, &self.slab, stage.into())
            }
            Spot::Gone => {
                let mut whole = self.whole.borrow_mut();
                let whole = whole.get_or_insert_with(|| self.settled_whole());
                whole.get(leaf).copied().unwrap_or(0)
            }
        }
    }

    /// Whether a property holds.
    pub(crate) fn property(&self, property: usize) -> bool {
        let spot = self.program.plan.layout.properties.get(property);
        let leaf = self.leaves() + property;
        spot.is_none_or(|&spot| self.spot(spot, leaf) != 0)
    }

    /// All leaves and properties, node by node from the netlist as it was written.
    fn settled_whole(&self) -> Vec<u64> {
        let flat = self.program.flat();
        let plan = &self.program.plan;
        let mut words: Vec<u64> = Vec::with_capacity(flat.nodes.len());
        for node in &flat.nodes {
            let word = match node.op {
                Op::Input(port) => self.slab[plan.layout.inputs[port as usize] as usize],
                Op::Register(register) => {
                    self.slab[plan.registers[register as usize].slot as usize]
                }
                Op::Read(memory, address) => {
                    let memory = &plan.memories[memory as usize];
                    interpreter::read(memory, &self.slab, words[address as usize])
                }
                _ => value::of(*node, |id| (words[id as usize], flat.node(id).width)),
            };
            words.push(word);
        }
        let leaves = flat
            .leaves
            .iter()
            .enumerate()
            .map(|(leaf, place)| match *place {
                Place::Node(id) => words[id as usize],
                _ => self.leaf_in_slab(leaf),
            });
        let properties = flat.properties.iter().map(|&id| words[id as usize]);
        leaves.chain(properties).collect()
    }

    fn leaf_in_slab(&self, leaf: usize) -> u64 {
        match self.program.plan.layout.leaves.get(leaf) {
            Some(Spot::Gone) | None => 0,
            Some(&spot) => self.spot(spot, leaf),
        }
    }

    /// Calls `see` with the place in [`Layout::watched`](super::Layout::watched) of all that has
    /// changed since the tick before.
    #[inline]
    pub(crate) fn changed(&self, mut see: impl FnMut(usize)) {
        let layout = &self.program.plan.layout;
        for word in 0..layout.changed_words as usize {
            let mut bits = self.slab[layout.changed as usize + word];
            while bits != 0 {
                see(word * 64 + bits.trailing_zeros() as usize);
                bits &= bits - 1;
            }
        }
    }

    /// The words of the memory whose first word is a leaf, in their order.
    pub(crate) fn memory_at(&self, leaf: usize) -> Option<Arc<[u64]>> {
        let Some(Place::Word(number, 0)) = self.program.flat().leaves.get(leaf) else {
            return None;
        };
        let number = *number as usize;
        let memory = &self.program.plan.memories[number];
        let mark = self.slab[memory.mark as usize];
        let mut cache = self.memories.borrow_mut();
        cache.resize(self.program.plan.memories.len(), None);
        match &cache[number] {
            Some((known, words)) if *known == mark => Some(words.clone()),
            _ => {
                let words = 0..u64::from(memory.words);
                let words = words.map(|word| interpreter::read(memory, &self.slab, word));
                let words: Arc<[u64]> = words.collect();
                cache[number] = Some((mark, words.clone()));
                Some(words)
            }
        }
    }

    /// How often a memory was written, and where last.
    pub(crate) fn written(&self, memory: usize) -> (u64, u64) {
        let memory = &self.program.plan.memories[memory];
        (
            self.slab[memory.mark as usize],
            self.slab[memory.written as usize],
        )
    }

    /// The whole state: registers, memories and what has been settled.
    #[inline]
    pub(crate) fn slab(&self) -> &[u64] {
        &self.slab
    }

    /// Takes over a state of an engine of the same program.
    pub(crate) fn restore(&mut self, slab: &[u64]) {
        self.slab.copy_from_slice(slab);
        *self.whole.get_mut() = None;
        self.memories.take();
    }

    /// Sets a register or a word of a memory, by its leaf, and wakes everything.
    pub(crate) fn set_leaf(&mut self, leaf: usize, word: u64) {
        let plan = &self.program.plan;
        let slot = match plan.layout.leaves.get(leaf) {
            Some(Spot::Slot(slot)) => *slot,
            Some(Spot::Stage(memory, stage)) => {
                let memory = &plan.memories[*memory as usize];
                // The stages are in their order from here on.
                let head = memory.head.map_or(0, |head| self.slab[head as usize]);
                memory.first + ((u64::from(*stage) + head) % u64::from(memory.words)) as u32
            }
            _ => return,
        };
        self.slab[slot as usize] = word;
    }

    /// Every block is to run: what [`set_leaf`](Self::set_leaf) has set is new.
    pub(crate) fn wake(&mut self) {
        if !self.straight {
            self.wake_all();
        }
        *self.whole.get_mut() = None;
        self.memories.take();
    }

    fn wake_all(&mut self) {
        self.program.plan.layout.wake(&mut self.slab);
    }

    /// How often each block has run, as far as it was counted.
    pub(crate) fn counts(&self) -> &Counts {
        self.tier.counts()
    }

    /// Compiles now, instead of when it pays: blocks that ran in more than half of the ticks so far
    /// are in line. Whether the machine code is there.
    pub fn compile(&mut self) -> bool {
        self.tier.compile_now(&self.program.plan)
    }

    /// Goes on by the interpreter, which counts blocks, and never compiles.
    pub fn interpret(&mut self) {
        self.tier.interpret();
        // Blocks in line of the code have left their bits as they were.
        self.wake_all();
    }

    /// Netlist that it was made from.
    #[inline]
    pub(crate) fn flat(&self) -> &Flat {
        self.program.flat()
    }
}
