use super::flat::{Flat, Op, Place, mask};
use super::input::InputError;
use super::interpreter::{self, Counts};
use super::layout::Spot;
use super::prediction::Prediction;
use super::program::Program;
use super::replay::Replay;
use super::tier::Tier;
use super::value;
use std::cell::RefCell;
use std::sync::Arc;

/// Running circuit with its type erased.
///
/// A tick is: [`input`](Self::input) for the ports that change, [`settle`](Self::settle), reading
/// of leaves, [`edge`](Self::edge).
#[derive(Debug)]
pub struct Engine {
    pub(super) program: Arc<Program>,
    pub(super) slab: Vec<u64>,
    tier: Tier,
    prediction: Option<Box<Prediction>>,
    pause: Pause,
    /// True if all blocks run in every tick.
    straight: bool,
    /// All leaves of this tick, computed when an unwatched one was requested.
    whole: RefCell<Option<Vec<u64>>>,
    /// Memory words that were requested, and the number of writes at that time.
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
            prediction: None,
            pause: self.pause,
            straight: self.straight,
            whole: RefCell::default(),
            memories: RefCell::default(),
        }
    }
}

/// Number of writes, and words of a memory.
type Read = (u64, Arc<[u64]>);

/// Time of the next search for idle ticks.
#[derive(Debug, Clone, Copy, Default)]
struct Pause {
    /// Ticks left until then.
    left: u64,
    /// Length of the last pause in ticks.
    ticks: u64,
    /// Recent cost of attempts minus the ticks they saved, in compiled steps.
    debt: i64,
}

impl Pause {
    /// Longest pause in ticks, if recent attempts have paid off and if they have not.
    const LONGEST: [u64; 2] = [64, 512];
    /// If attempts have not paid off, the longest pause is at least the time of this many of them.
    const RARE: u64 = 128;
    const CREDIT: i64 = 1 << 20;

    /// Sets the pause after an attempt; a tick costs `pace`.
    fn after(&mut self, took: u64, saved: u64, pace: u64) {
        let rare = Self::RARE * took / pace.max(1);
        let took = took as i64;
        let saved = saved.min(u32::MAX.into()) as i64;
        // Old costs fade, and long jumps do not count for ever.
        self.debt = (self.debt - self.debt / 64 + took - saved).max(-Self::CREDIT);
        let pays = self.debt <= 0;
        let longest = match pays {
            true => Self::LONGEST[0],
            false => Self::LONGEST[1].max(rare),
        };
        self.ticks = match saved > 0 && pays {
            true => 0,
            false => (2 * self.ticks).clamp(1, longest),
        };
        self.left = self.ticks;
    }
}

impl Engine {
    /// Creates an engine in the power-on state, all input ports low.
    pub(crate) fn new(program: Arc<Program>) -> Self {
        Engine {
            slab: program.plan.layout.power_on(),
            tier: Tier::new(&program.plan),
            program,
            prediction: None,
            pause: Pause::default(),
            straight: false,
            whole: RefCell::default(),
            memories: RefCell::default(),
        }
    }

    /// Creates an engine that compiles at once, with all blocks inlined: for searches, in which
    /// each tick has another state.
    pub(crate) fn straight(program: Arc<Program>) -> Self {
        let mut engine = Engine::new(program);
        engine.straight = engine.tier.straight(&engine.program.plan);
        engine
    }

    /// Returns the program.
    #[inline]
    pub(crate) fn program(&self) -> &Program {
        &self.program
    }

    /// Sets an input port by its number, counted from 0, to the bits of `word`.
    ///
    /// # Errors
    /// Returns an error if there is no such port, or the word is wider than it; nothing is set
    /// then.
    pub fn input(&mut self, port: usize, word: u64) -> Result<(), InputError> {
        self.check(port, word)?;
        self.drive(port, word);
        Ok(())
    }

    /// Sets all input ports to the bits of `words`.
    ///
    /// # Errors
    /// Returns an error if the number of words is not that of the ports, or a word is wider than
    /// its port; nothing is set then.
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

    /// Returns the number of input ports.
    pub fn ports(&self) -> usize {
        self.flat().inputs.len()
    }

    /// Sets an input port to a word that fits it.
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

    /// Sets the first input ports to words that fit them.
    #[inline]
    pub(crate) fn drive_all(&mut self, words: &[u64]) {
        for (port, &word) in words.iter().enumerate() {
            self.drive(port, word);
        }
    }

    /// Returns the bits of an input port; `None` if there is no such port.
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

    /// Makes the registers of the next tick, and clears the change marks.
    #[inline]
    pub fn edge(&mut self) {
        self.begin();
        self.pause.left = self.pause.left.saturating_sub(1);
        self.tier.edge(&self.program.plan, &mut self.slab);
    }

    /// Makes an edge with reset: flip-flops take their power-on values, memories are written as
    /// usual.
    pub fn reset(&mut self) {
        self.edge();
        let program = &self.program;
        for (register, &word) in program.plan.registers.iter().zip(&program.power_on) {
            interpreter::put(&program.plan.layout, &mut self.slab, register.slot, word);
        }
        // An edge that would restore the old register has nothing else to wake it.
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

    /// Makes up to `ticks` edges, each with a settling and constant input ports; stops when a
    /// watched leaf has changed. Returns the number of ticks.
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

    /// True if something watched has changed since the tick before.
    pub(crate) fn has_changed(&self) -> bool {
        self.slab[self.program.plan.layout.event as usize] != 0
    }

    /// Jumps over idle ticks, at most `most` including this settled one, with constant input
    /// ports. Returns their number: 0 if this tick is not idle or no search is due. The tick after
    /// them is not settled. Output ports do not change in them, except in the first.
    pub(crate) fn forward(&mut self, most: u64) -> u64 {
        if self.pause.left > 0 || most < 2 {
            return 0;
        }
        let program = &self.program;
        let prediction = self
            .prediction
            .get_or_insert_with(|| Box::new(Prediction::new(&program.plan, program.graph())));
        let ticks = prediction.horizon(&program.plan, self.tier.hot(), &self.slab, most);
        let saved = if ticks < 2 {
            0
        } else {
            ticks.saturating_mul(self.tier.cost(prediction.idle_steps()))
        };
        self.pause.after(prediction.work(), saved, self.tier.pace());
        if ticks < 2 {
            return 0;
        }
        self.begin();
        if let Some(prediction) = &mut self.prediction {
            prediction.jump(&self.program.plan, &mut self.slab, ticks);
        }
        ticks
    }

    /// Continues a replay until the backend returns.
    pub(super) fn run(&mut self, replay: &mut Replay<'_>) {
        *self.whole.get_mut() = None;
        let start = replay.tick;
        self.tier.replay(&self.program.plan, &mut self.slab, replay);
        self.pause.left = self.pause.left.saturating_sub(replay.tick - start);
    }

    /// Returns the tick of the next search for idle ticks, from `tick` on.
    pub(crate) fn search_after(&self, tick: u64) -> u64 {
        tick.saturating_add(self.pause.left)
    }

    /// Returns the number of ticks until the next search for idle ticks.
    pub(crate) fn pause(&self) -> u64 {
        self.pause.left.max(1)
    }

    /// Returns the number of leaves.
    #[inline]
    pub fn leaves(&self) -> usize {
        self.program.plan.layout.leaves.len()
    }

    /// Returns the bits of a leaf of the walk; `None` if there is no such leaf. A net needs a
    /// settled tick.
    #[inline]
    pub fn leaf(&self, leaf: usize) -> Option<u64> {
        (leaf < self.leaves()).then(|| self.word(leaf))
    }

    /// Returns the bits of a leaf, or 0 if there is no such leaf.
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

    /// True if a leaf is not computed in every tick.
    pub(crate) fn is_unwatched(&self, leaf: usize) -> bool {
        self.program.plan.layout.leaves.get(leaf) == Some(&Spot::Gone)
    }

    /// True if reading a leaf computes all leaves of this tick.
    #[inline]
    pub(crate) fn is_costly(&self, leaf: usize) -> bool {
        let spot = self.program.plan.layout.leaves.get(leaf);
        spot == Some(&Spot::Gone) && self.whole.borrow().is_none()
    }

    /// True if a property holds.
    pub(crate) fn property(&self, property: usize) -> bool {
        let spot = self.program.plan.layout.properties.get(property);
        let leaf = self.leaves() + property;
        spot.is_none_or(|&spot| self.spot(spot, leaf) != 0)
    }

    /// Returns all leaves and properties, computed node by node from the netlist before all
    /// passes.
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

    /// Calls `see` with the index in [`Layout::watched`](super::layout::Layout::watched) of
    /// everything that has changed since the tick before.
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

    /// Returns the words of the memory whose first word is this leaf.
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

    /// Returns the number of writes of a memory, and the address of the last one.
    pub(crate) fn written(&self, memory: usize) -> (u64, u64) {
        let memory = &self.program.plan.memories[memory];
        (
            self.slab[memory.mark as usize],
            self.slab[memory.written as usize],
        )
    }

    /// Returns the whole state: registers, memories and settled nets.
    #[inline]
    pub(crate) fn slab(&self) -> &[u64] {
        &self.slab
    }

    /// Restores a state of an engine of the same program.
    pub(crate) fn restore(&mut self, slab: &[u64]) {
        self.slab.copy_from_slice(slab);
        *self.whole.get_mut() = None;
        self.memories.take();
    }

    /// Sets a register or a word of a memory, by its leaf; [`wake`](Self::wake) must follow.
    pub(crate) fn set_leaf(&mut self, leaf: usize, word: u64) {
        let plan = &self.program.plan;
        let slot = match plan.layout.leaves.get(leaf) {
            Some(Spot::Slot(slot)) => *slot,
            Some(Spot::Stage(memory, stage)) => {
                let memory = &plan.memories[*memory as usize];
                // The stages are in order from here on.
                let head = memory.head.map_or(0, |head| self.slab[head as usize]);
                memory.first + ((u64::from(*stage) + head) % u64::from(memory.words)) as u32
            }
            _ => return,
        };
        self.slab[slot as usize] = word;
    }

    /// Wakes every block, so that words set by [`set_leaf`](Self::set_leaf) take effect.
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

    /// Returns the number of runs of each block, as far as the interpreter counted.
    pub(crate) fn counts(&self) -> &Counts {
        self.tier.counts()
    }

    /// Compiles at once, rather than when it pays; blocks that ran in more than half of the ticks
    /// so far are inlined. Returns true if there is machine code.
    pub fn compile(&mut self) -> bool {
        self.tier.compile_now(&self.program.plan)
    }

    /// True if the circuit runs in machine code.
    #[cfg(test)]
    pub(super) fn is_compiled(&self) -> bool {
        self.tier.is_compiled()
    }

    /// True if the circuit is never compiled.
    pub(crate) fn is_interpreted(&self) -> bool {
        self.tier.is_interpreted()
    }

    /// Continues on the interpreter, which counts blocks, and never compiles.
    pub fn interpret(&mut self) {
        self.tier.interpret();
        // Inlined blocks of the code do not maintain their bits.
        self.wake_all();
    }

    /// Returns the netlist before all passes.
    #[inline]
    pub(crate) fn flat(&self) -> &Flat {
        self.program.flat()
    }
}
