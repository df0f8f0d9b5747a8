//! Linear prediction: jumps over idle ticks, in which every register changes linearly.
//!
//! A line is a word `value + slope · k` over the ticks k. In a settled tick, the step that this
//! edge would make is taken as the slope of each register. Sums of lines are lines. A comparison,
//! a choice, or the upper bits of a word are constant up to a tick that arithmetic gives: the
//! horizon. If the registers after the edge are on the same lines, all ticks up to the least
//! horizon are one jump.

mod graph;
mod notes;
mod pair;
mod recipe;
mod record;
mod tree;
mod walk;

#[cfg(test)]
mod tests;

use super::flat::mask;
use super::interpreter::put;
use super::layout::Slot;
use super::plan::{Block, Plan, PlannedRegister};
pub use graph::Graph;
use graph::{bits, has, insert, unite};
use pair::Line;
use recipe::Recipe;
use record::Recorder;
use std::sync::Arc;
use walk::{Known, Moving, Pairs, Stop, Words};

/// Linear prediction of a plan's registers.
#[derive(Debug, Clone)]
pub struct Prediction {
    graph: Arc<Graph>,
    stamp: u64,
    pair_stamp: u64,
    words: Vec<Known<u64>>,
    lines: Vec<Known<(Line, u64)>>,
    /// Registers that move, found by the last attempt.
    moving: Vec<Moving>,
    /// Slopes, by slot of a register.
    slopes: Vec<u64>,
    /// Nets, blocks and watched nets that the moving registers affect; see [`Graph::touches`].
    touched: Vec<u64>,
    /// Edge blocks that always run, as given and as bits.
    hot: Vec<bool>,
    hot_bits: Vec<u64>,
    /// Edge blocks that run at this edge.
    due: Vec<u64>,
    /// Due edge blocks that were not examined yet.
    left: Vec<u64>,
    /// Registers and edge blocks that stopped recent attempts, the latest first.
    last_offenders: [u32; 6],
    last_blocks: [usize; 4],
    recipes: Vec<Recipe>,
    /// Indices of the recipes, the one that matched last first.
    order: Vec<usize>,
    /// By slot: true if a recipe loads the word again each time, since it changes while choices
    /// are the same.
    reloaded: Vec<bool>,
    /// Successful attempts to wait until the next recipe is recorded, and the interval after that
    /// one.
    wait: u32,
    interval: u32,
    /// Last horizon, if a stop was found there.
    end: u64,
    /// Register that moved and its word, in a tick that is the end of its line.
    line_end: Option<(Slot, u64)>,
    /// Cost of the last attempt, in compiled steps.
    work: u64,
    /// Costs of the edge blocks in steps.
    costs: Vec<u64>,
}

/// Cost in compiled steps of starting an attempt, and of one node that it examines.
const ATTEMPT: u64 = 200;
const NODE: u64 = 24;
/// Cost of recording a recipe, in evaluations of it.
const RECORDING: u64 = 256;

/// Number of recipes kept.
const RECIPES: usize = 16;
/// Least and greatest interval between recorded recipes, in successful attempts. A matching recipe
/// shortens it.
const INTERVALS: [u32; 2] = [2, 128];

impl Prediction {
    /// Creates the prediction of a plan.
    pub fn new(plan: &Plan, graph: Arc<Graph>) -> Prediction {
        let edges = plan.blocks.len() - plan.settling;
        let edge_blocks = plan.blocks[plan.settling..].iter();
        Prediction {
            stamp: 0,
            pair_stamp: 0,
            words: vec![Known::nothing(0); graph.nodes.len()],
            lines: vec![Known::nothing((Line::still(0), 0)); graph.nodes.len()],
            moving: Vec::with_capacity(plan.registers.len()),
            slopes: vec![0; graph.slots],
            touched: vec![0; graph.stride],
            hot: vec![false; edges],
            hot_bits: vec![0; edges.div_ceil(64)],
            due: vec![0; edges.div_ceil(64)],
            left: vec![0; edges.div_ceil(64)],
            last_offenders: [u32::MAX; 6],
            last_blocks: [usize::MAX; 4],
            recipes: Vec::with_capacity(RECIPES),
            order: Vec::with_capacity(RECIPES),
            reloaded: vec![false; plan.layout.words as usize],
            end: u64::MAX,
            line_end: None,
            work: 0,
            costs: edge_blocks.map(Block::cost).collect(),
            wait: 0,
            interval: INTERVALS[0],
            graph,
        }
    }

    /// Returns the number of ticks from this one on, at most `most`, in which all edges keep every
    /// register on its line and everything watched unchanged.
    ///
    /// The slab is settled, before its edge. A watched word may change after that number of ticks,
    /// not before. Returns 0 if the edge does more, or if nothing is known. `hot` blocks run even
    /// if nothing wakes them.
    pub fn horizon(&mut self, plan: &Plan, hot: &[bool], slab: &[u64], most: u64) -> u64 {
        self.moving.clear();
        self.end = u64::MAX;
        self.work = ATTEMPT;
        let line_end = self.line_end.take();
        if most == 0 || line_end.is_some_and(|(slot, word)| slab[slot as usize] == word) {
            return 0;
        }
        let until = self.find(plan, hot, slab, most);
        if until < most {
            self.end = until;
        }
        until
    }

    /// Returns the steps of a tick like that of the last attempt: those of its edge, and as many to
    /// settle. They are fewer than those of other ticks, if registers only count.
    pub fn idle_steps(&self) -> u64 {
        let edge: u64 = bits(&self.due).map(|edge| self.costs[edge]).sum();
        2 * edge
    }

    /// Returns the cost of the last attempt, in compiled steps.
    pub fn work(&self) -> u64 {
        self.work
    }

    fn find(&mut self, plan: &Plan, hot: &[bool], slab: &[u64], most: u64) -> u64 {
        self.set_hot(&hot[plan.settling..]);
        let first = plan.layout.dirty as usize + plan.settling.div_ceil(64);
        for (word, (due, hot)) in self.due.iter_mut().zip(&self.hot_bits).enumerate() {
            *due = slab[first + word] | hot;
        }
        if let Some(until) = self.recall(slab, most) {
            return until;
        }
        let until = self.examine(plan, slab, most).unwrap_or(0);
        if until > 1 && !self.moving.is_empty() {
            self.remember(plan, slab);
        }
        for moving in &self.moving {
            self.slopes[moving.slot as usize] = 0;
        }
        if until == 0 {
            self.moving.clear();
        }
        until
    }

    /// Examines the circuit; blocks and registers that stopped recent attempts come first.
    fn examine(&mut self, plan: &Plan, slab: &[u64], most: u64) -> Result<u64, Stop> {
        self.stamp += 1;
        self.touched.fill(0);
        for place in 0..self.last_offenders.len() {
            let register = self.last_offenders[place];
            if register != u32::MAX && self.leaves_line(plan, slab, register) {
                self.last_offenders[..=place].rotate_right(1);
                return Err(Stop(None));
            }
        }
        self.left.copy_from_slice(&self.due);
        for place in 0..self.last_blocks.len() {
            let edge = self.last_blocks[place];
            if most > 1 && has(&self.due, edge) {
                self.step(plan, slab, Some(edge))?;
                self.follow(plan, slab, most, Some(edge))?;
            }
        }
        self.step(plan, slab, None)?;
        match self.moving.is_empty() || most == 1 {
            true => Ok(most),
            false => self.follow(plan, slab, most, None),
        }
    }

    /// Finds the registers that this edge moves; with `of`, only those that a block depends on.
    fn step(&mut self, plan: &Plan, slab: &[u64], of: Option<usize>) -> Result<(), Stop> {
        let known = self.moving.len();
        let graph = &self.graph;
        let mut words = Words {
            plan,
            graph,
            slab,
            known: &mut self.words,
            stamp: self.stamp,
            work: &mut self.work,
        };
        let among = of.map(|edge| &graph.suppliers[edge]);
        for (word, left) in self.left.iter_mut().enumerate() {
            let mut now = *left & among.map_or(u64::MAX, |among| among[word]);
            *left &= !now;
            while now != 0 {
                let edge = word * 64 + now.trailing_zeros() as usize;
                now &= now - 1;
                if let Err(ends) = words.edge(edge, &mut self.moving) {
                    return Err(self.stop_at(edge, ends.0));
                }
            }
        }
        for moving in &self.moving[known..] {
            self.slopes[moving.slot as usize] = moving.slope;
            let start = moving.register as usize * graph.stride;
            let touches = &graph.touches[start..start + graph.stride];
            unite(&mut self.touched, touches);
        }
        Ok(())
    }

    /// Returns the number of ticks, at most `most`, in which everything stays on the lines found;
    /// with `only`, one block alone.
    fn follow(
        &mut self,
        plan: &Plan,
        slab: &[u64],
        most: u64,
        only: Option<usize>,
    ) -> Result<u64, Stop> {
        let mut pairs = self.pairs(plan, slab, most);
        let (graph, touched) = (pairs.graph, pairs.touched);
        let edges = &touched[graph.edge_word..graph.watched_word];
        if let Some(edge) = only {
            if has(edges, edge)
                && let Err(ends) = pairs.edge(edge)
            {
                let alone = ends.0.filter(|&register| graph.alone[register as usize]);
                return Err(self.stop_at(edge, alone));
            }
            return Ok(pairs.until);
        }
        let end = bits(edges).find_map(|edge| Some((edge, pairs.edge(edge).err()?)));
        if let Some((edge, ends)) = end {
            let alone = ends.0.filter(|&register| graph.alone[register as usize]);
            return Err(self.stop_at(edge, alone));
        }
        for watched in bits(&touched[graph.watched_word..]) {
            pairs.net(graph.watched_nets[watched])?;
        }
        Ok(pairs.until)
    }

    /// Returns lines that are exact for up to `most` ticks, none evaluated yet.
    fn pairs<'w>(&'w mut self, plan: &'w Plan, slab: &'w [u64], most: u64) -> Pairs<'w> {
        self.pair_stamp += 1;
        Pairs {
            plan,
            graph: &self.graph,
            slab,
            known: &mut self.lines,
            stamp: self.pair_stamp,
            slopes: &self.slopes,
            touched: &self.touched,
            work: &mut self.work,
            until: most,
            all: false,
        }
    }

    /// True if a register leaves its line at once, judged by this register alone.
    fn leaves_line(&mut self, plan: &Plan, slab: &[u64], register: u32) -> bool {
        let graph = &self.graph;
        let next = graph.nexts[register as usize];
        let PlannedRegister { slot, width, .. } = plan.registers[register as usize];
        let mut words = Words {
            plan,
            graph,
            slab,
            known: &mut self.words,
            stamp: self.stamp,
            work: &mut self.work,
        };
        let slope = words.word(next).wrapping_sub(slab[slot as usize]) & mask(width);
        if slope == 0 {
            return false;
        }
        if words.ends(register, next) {
            return true;
        }
        if !graph.alone[register as usize] {
            return false;
        }
        self.slopes[slot as usize] = slope;
        let mut pairs = self.pairs(plan, slab, u64::MAX);
        let leaves_line = pairs.line(next).slope != slope || pairs.until <= 1;
        self.slopes[slot as usize] = 0;
        leaves_line
    }

    /// Remembers a block or register that stopped an attempt.
    fn stop_at(&mut self, edge: usize, register: Option<u32>) -> Stop {
        match register {
            Some(register) => move_first(&mut self.last_offenders, register),
            None => move_first(&mut self.last_blocks, edge),
        }
        Stop(register)
    }

    /// Returns the horizon of a recipe that matches.
    fn recall(&mut self, slab: &[u64], most: u64) -> Option<u64> {
        for place in 0..self.order.len() {
            let number = self.order[place];
            let recipe = &mut self.recipes[number];
            self.work += recipe.cost;
            if let Some(until) = recipe.run(slab, &self.due, most) {
                self.moving.extend_from_slice(&recipe.moving);
                self.order[..=place].rotate_right(1);
                self.wait = self.wait.saturating_sub(1);
                self.interval = self.interval.min(INTERVALS[0].max(self.interval / 2));
                return Some(until);
            }
        }
        None
    }

    /// Records the result of this attempt as a recipe.
    fn remember(&mut self, plan: &Plan, slab: &[u64]) {
        if self.wait > 0 {
            self.wait -= 1;
            return;
        }
        self.wait = self.interval;
        self.interval = INTERVALS[1].min(2 * self.interval);
        self.moving.sort_unstable_by_key(|moving| moving.register);
        // Words of an otherwise equal recipe that changed are loaded again from now on.
        let place = self.order.iter().position(|&number| {
            let recipe = &self.recipes[number];
            recipe.moving == self.moving && recipe.mark_reloaded(slab, &mut self.reloaded)
        });
        let graph = &self.graph;
        let mut edges = self.due.clone();
        let touched = &self.touched[graph.edge_word..graph.watched_word];
        edges
            .iter_mut()
            .zip(touched)
            .for_each(|(to, from)| *to |= from);
        let watched_nets =
            bits(&self.touched[graph.watched_word..]).map(|watched| graph.watched_nets[watched]);
        let mut pairs = Pairs {
            plan,
            graph,
            slab,
            known: &mut self.lines,
            stamp: self.pair_stamp,
            slopes: &self.slopes,
            touched: &self.touched,
            work: &mut self.work,
            until: u64::MAX,
            all: true,
        };
        let recorder = Recorder::new(&mut pairs, &self.reloaded);
        let Some(mut recipe) = recorder.record(&edges, watched_nets) else {
            return;
        };
        recipe.moving.clone_from(&self.moving);
        recipe.cost = 16 + (recipe.steps.len() + recipe.bounds.len()) as u64 * 8;
        self.work += recipe.cost * RECORDING;
        let number = match place {
            Some(place) => self.order.remove(place),
            None if self.recipes.len() < RECIPES => {
                self.recipes.push(Recipe::default());
                self.recipes.len() - 1
            }
            None => self.order.pop().unwrap_or(0),
        };
        self.recipes[number] = recipe;
        self.order.insert(0, number);
    }

    /// Sets which edge blocks are hot.
    fn set_hot(&mut self, hot: &[bool]) {
        if hot == self.hot {
            return;
        }
        self.hot.copy_from_slice(hot);
        self.hot_bits.fill(0);
        for (edge, _) in hot.iter().enumerate().filter(|(_, hot)| **hot) {
            insert(&mut self.hot_bits, edge);
        }
    }

    /// Jumps over `ticks` ticks, at most the last horizon.
    ///
    /// The slab is then as after `ticks` edges with a settling before each.
    pub fn jump(&mut self, plan: &Plan, slab: &mut [u64], ticks: u64) {
        for moving in &self.moving {
            let way = moving.slope.wrapping_mul(ticks);
            let value = slab[moving.slot as usize].wrapping_add(way) & mask(moving.width);
            put(&plan.layout, slab, moving.slot, value);
        }
        if ticks == self.end
            && let Some(moving) = self.moving.first()
        {
            self.line_end = Some((moving.slot, slab[moving.slot as usize]));
        }
    }
}

/// Moves an item to the front; a new one replaces the last.
fn move_first<T: PartialEq>(list: &mut [T], one: T) {
    let last = list.len() - 1;
    let place = list.iter().position(|known| *known == one);
    list[..=place.unwrap_or(last)].rotate_right(1);
    list[0] = one;
}
