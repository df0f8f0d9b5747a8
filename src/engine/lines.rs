//! Idle ticks: as long as every register goes on along a straight line, there is nothing to see.
//!
//! In a settled tick each register is taken to move by the same step in every tick. Sums of such
//! lines are lines; a comparison, a choice or the upper bits of a word are what they are until some
//! tick that arithmetic gives. If the registers after the edge are on the same lines, a run goes
//! over all ticks up to the first of these in one.

mod graph;
mod pair;
mod tree;
mod walk;

#[cfg(test)]
mod tests;

use super::flat::mask;
use super::interpreter::put;
use super::plan::Plan;
use graph::{Graph, bits, has, insert};
use pair::Line;
use walk::{Ends, Known, Moving, Pairs, Words};

/// How far the registers of a plan go along straight lines.
#[derive(Debug, Clone)]
pub struct Lines {
    graph: Graph,
    stamp: u64,
    words: Vec<Known<u64>>,
    lines: Vec<Known<(Line, u64)>>,
    /// What the last try found.
    moving: Vec<Moving>,
    /// By slot, of registers.
    slopes: Vec<u64>,
    /// What these move.
    touched: Vec<u64>,
    /// Edge blocks that always run, as they were said to, and as bits.
    hot: Vec<bool>,
    hot_bits: Vec<u64>,
    /// Edge blocks that this edge runs.
    due: Vec<u64>,
    /// The edge block that did more than move registers last, and the one that left its lines.
    busy: usize,
    bent: usize,
}

impl Lines {
    /// Room for a plan. By slot: which nets and registers are to stay as they are.
    pub fn new(plan: &Plan, held: &[bool]) -> Lines {
        let graph = Graph::new(plan, held);
        let edges = plan.blocks.len() - plan.settling;
        Lines {
            stamp: 0,
            words: vec![Known::nothing(0); graph.nodes.len()],
            lines: vec![Known::nothing((Line::still(0), 0)); graph.nodes.len()],
            moving: Vec::with_capacity(plan.registers.len()),
            slopes: vec![0; graph.slots],
            touched: vec![0; graph.stride],
            hot: vec![false; edges],
            hot_bits: vec![0; edges.div_ceil(64)],
            due: vec![0; edges.div_ceil(64)],
            busy: 0,
            bent: 0,
            graph,
        }
    }

    /// For how many ticks from this one on, at most so many, all edges leave every register on a
    /// straight line and everything watched as it is.
    ///
    /// The slab is settled, before its edge. What is watched may be another word after so many
    /// ticks, not before. 0 where the edge does more, or where nothing better is known. Blocks
    /// that are `hot` run though nothing wakes them.
    pub fn horizon(&mut self, plan: &Plan, hot: &[bool], slab: &[u64], most: u64) -> u64 {
        for moving in self.moving.drain(..) {
            self.slopes[moving.slot as usize] = 0;
        }
        if most == 0 {
            return 0;
        }
        self.stamp += 1;
        self.heat(&hot[plan.settling..]);
        if self.step(plan, slab).is_err() {
            self.moving.clear();
            return 0;
        }
        if self.moving.is_empty() || most == 1 {
            return most;
        }
        self.touched.fill(0);
        let stride = self.graph.stride;
        for moving in &self.moving {
            self.slopes[moving.slot as usize] = moving.slope;
            let touches = &self.graph.touches[moving.register as usize * stride..][..stride];
            for (to, from) in self.touched.iter_mut().zip(touches) {
                *to |= from;
            }
        }
        self.follow(plan, slab, most).unwrap_or(0)
    }

    /// Finds what this edge moves.
    fn step(&mut self, plan: &Plan, slab: &[u64]) -> Result<(), Ends> {
        let mut words = Words {
            plan,
            graph: &self.graph,
            slab,
            known: &mut self.words,
            stamp: self.stamp,
        };
        let first = plan.layout.dirty as usize + plan.settling.div_ceil(64);
        for (word, (due, hot)) in self.due.iter_mut().zip(&self.hot_bits).enumerate() {
            *due = slab[first + word] | hot;
        }
        // What did more last time is likely to do so again.
        let busy = self.busy;
        if has(&self.due, busy) {
            words.edge(busy, &mut self.moving)?;
        }
        for edge in bits(&self.due).filter(|&edge| edge != busy) {
            if let Err(ends) = words.edge(edge, &mut self.moving) {
                self.busy = edge;
                return Err(ends);
            }
        }
        Ok(())
    }

    /// For how many ticks, at most so many, everything stays on the lines that were found.
    fn follow(&mut self, plan: &Plan, slab: &[u64], most: u64) -> Result<u64, Ends> {
        let graph = &self.graph;
        let mut pairs = Pairs {
            plan,
            graph,
            slab,
            known: &mut self.lines,
            stamp: self.stamp,
            slopes: &self.slopes,
            touched: &self.touched,
            until: most,
        };
        let edges = &self.touched[graph.edge_word..graph.sight_word];
        let bent = self.bent;
        if has(edges, bent) {
            pairs.edge(bent)?;
        }
        for edge in bits(edges).filter(|&edge| edge != bent) {
            if let Err(ends) = pairs.edge(edge) {
                self.bent = edge;
                return Err(ends);
            }
        }
        for sight in bits(&self.touched[graph.sight_word..]) {
            pairs.net(graph.sights[sight])?;
        }
        Ok(pairs.until)
    }

    /// Takes over which edge blocks are hot.
    fn heat(&mut self, hot: &[bool]) {
        if hot == self.hot {
            return;
        }
        self.hot.copy_from_slice(hot);
        self.hot_bits.fill(0);
        for (edge, _) in hot.iter().enumerate().filter(|(_, hot)| **hot) {
            insert(&mut self.hot_bits, edge);
        }
    }

    /// Goes over so many ticks, at most as many as the last horizon.
    ///
    /// The slab is then as after so many edges with a settling before each.
    pub fn jump(&mut self, plan: &Plan, slab: &mut [u64], ticks: u64) {
        for moving in &self.moving {
            let way = moving.slope.wrapping_mul(ticks);
            let value = slab[moving.slot as usize].wrapping_add(way);
            put(&plan.layout, slab, moving.slot, value & mask(moving.width));
        }
    }
}
