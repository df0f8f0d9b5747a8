//! Idle ticks: as long as every register goes on along a straight line, there is nothing to see.
//!
//! In a settled tick each register is taken to move by the same step in every tick. Sums of such
//! lines are lines; a comparison, a choice or the upper bits of a word are what they are until some
//! tick that arithmetic gives. If the registers after the edge are on the same lines, a run goes
//! over all ticks up to the first of these in one.

mod course;
mod graph;
mod notes;
mod pair;
mod record;
mod tree;
mod walk;

#[cfg(test)]
mod tests;

use super::flat::mask;
use super::interpreter::put;
use super::layout::Slot;
use super::plan::{Plan, PlannedRegister};
use course::Course;
use graph::{Graph, bits, has, insert, unite};
use pair::Line;
use record::Recorder;
use walk::{Ends, Known, Moving, Pairs, Words};

/// How far the registers of a plan go along straight lines.
#[derive(Debug, Clone)]
pub struct Lines {
    graph: Graph,
    stamp: u64,
    pair_stamp: u64,
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
    /// Those of them that were not looked at yet.
    left: Vec<u64>,
    /// Registers and edge blocks that ended lines, the last one first.
    bent: [u32; 6],
    ended: [usize; 4],
    courses: Vec<Course>,
    /// The courses, the one that was right last first.
    order: Vec<usize>,
    /// By slot: words that change while choices are as they were.
    loose: Vec<bool>,
    /// Tries to come before the next course is written down, and before the one behind that.
    wait: u32,
    price: u32,
    /// The last horizon, if it was no greater for what was found.
    end: u64,
    /// A register that moved and where it came to, in a tick that is the end of its line.
    bend: Option<(Slot, u64)>,
    /// How long the last try took, in compiled steps.
    work: u64,
}

/// How many compiled steps take as long as to begin a try, and as one node that it looks at.
const TRY: u64 = 200;
const NODE: u64 = 24;
/// How often a course could be gone through in the time that it takes to write it down.
const NOTE: u64 = 64;

/// Courses that are kept.
const COURSES: usize = 16;
/// Tries that found idle ticks, from one course that is written down to the next: the fewest, where
/// the last was of use, and the most.
const PRICES: [u32; 2] = [2, 128];

impl Lines {
    /// Room for a plan. By slot: which nets and registers are to stay as they are.
    pub fn new(plan: &Plan, held: &[bool]) -> Lines {
        let graph = Graph::new(plan, held);
        let edges = plan.blocks.len() - plan.settling;
        Lines {
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
            bent: [u32::MAX; 6],
            ended: [usize::MAX; 4],
            courses: Vec::with_capacity(COURSES),
            order: Vec::with_capacity(COURSES),
            loose: vec![false; plan.layout.words as usize],
            end: u64::MAX,
            bend: None,
            work: 0,
            wait: 0,
            price: PRICES[0],
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
        self.moving.clear();
        self.end = u64::MAX;
        self.work = TRY;
        let bend = self.bend.take();
        if most == 0 || bend.is_some_and(|(slot, word)| slab[slot as usize] == word) {
            return 0;
        }
        let until = self.find(plan, hot, slab, most);
        if until < most {
            self.end = until;
        }
        until
    }

    /// How long the last try took, in compiled steps.
    pub fn work(&self) -> u64 {
        self.work
    }

    fn find(&mut self, plan: &Plan, hot: &[bool], slab: &[u64], most: u64) -> u64 {
        self.heat(&hot[plan.settling..]);
        let first = plan.layout.dirty as usize + plan.settling.div_ceil(64);
        for (word, (due, hot)) in self.due.iter_mut().zip(&self.hot_bits).enumerate() {
            *due = slab[first + word] | hot;
        }
        if let Some(until) = self.recall(slab, most) {
            return until;
        }
        let until = self.seek(plan, slab, most).unwrap_or(0);
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

    /// Looks at everything, at what ended lines of late first.
    fn seek(&mut self, plan: &Plan, slab: &[u64], most: u64) -> Result<u64, Ends> {
        self.stamp += 1;
        self.touched.fill(0);
        for place in 0..self.bent.len() {
            let register = self.bent[place];
            if register != u32::MAX && self.bends(plan, slab, register) {
                self.bent[..=place].rotate_right(1);
                return Err(Ends(None));
            }
        }
        self.left.copy_from_slice(&self.due);
        for place in 0..self.ended.len() {
            let edge = self.ended[place];
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

    /// Finds what this edge moves, or no more than what a block depends on.
    fn step(&mut self, plan: &Plan, slab: &[u64], of: Option<usize>) -> Result<(), Ends> {
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
                    return Err(self.end_at(edge, ends.0));
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

    /// For how many ticks, at most so many, everything stays on the lines that were found, or a
    /// block.
    fn follow(
        &mut self,
        plan: &Plan,
        slab: &[u64],
        most: u64,
        only: Option<usize>,
    ) -> Result<u64, Ends> {
        let graph = &self.graph;
        self.pair_stamp += 1;
        let mut pairs = Pairs {
            plan,
            graph,
            slab,
            known: &mut self.lines,
            stamp: self.pair_stamp,
            slopes: &self.slopes,
            touched: &self.touched,
            work: &mut self.work,
            until: most,
            all: false,
        };
        let edges = &self.touched[graph.edge_word..graph.sight_word];
        if let Some(edge) = only {
            if has(edges, edge)
                && let Err(ends) = pairs.edge(edge)
            {
                let alone = ends.0.filter(|&register| graph.alone[register as usize]);
                return Err(self.end_at(edge, alone));
            }
            return Ok(pairs.until);
        }
        let end = bits(edges).find_map(|edge| Some((edge, pairs.edge(edge).err()?)));
        if let Some((edge, ends)) = end {
            let alone = ends.0.filter(|&register| graph.alone[register as usize]);
            return Err(self.end_at(edge, alone));
        }
        for sight in bits(&self.touched[graph.sight_word..]) {
            pairs.net(graph.sights[sight])?;
        }
        Ok(pairs.until)
    }

    /// Whether a register leaves its line at once, as far as it alone can say.
    fn bends(&mut self, plan: &Plan, slab: &[u64], register: u32) -> bool {
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
        self.pair_stamp += 1;
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
            all: false,
        };
        let bends = pairs.line(next).slope != slope || pairs.until <= 1;
        self.slopes[slot as usize] = 0;
        bends
    }

    /// It is this block that ends lines.
    fn end_at(&mut self, edge: usize, register: Option<u32>) -> Ends {
        match register {
            Some(register) => recall_first(&mut self.bent, register),
            None => recall_first(&mut self.ended, edge),
        }
        Ends(register)
    }

    /// What a course says.
    fn recall(&mut self, slab: &[u64], most: u64) -> Option<u64> {
        for place in 0..self.order.len() {
            let number = self.order[place];
            let course = &mut self.courses[number];
            self.work += course.steps;
            if let Some(until) = course.run(slab, &self.due, most) {
                self.moving.extend_from_slice(&course.moving);
                self.order[..=place].rotate_right(1);
                self.wait = self.wait.saturating_sub(1);
                self.price = self.price.min(PRICES[0].max(self.price / 2));
                return Some(until);
            }
        }
        None
    }

    /// Writes down what this try found.
    fn remember(&mut self, plan: &Plan, slab: &[u64]) {
        if self.wait > 0 {
            self.wait -= 1;
            return;
        }
        self.wait = self.price;
        self.price = PRICES[1].min(2 * self.price);
        self.moving.sort_unstable_by_key(|moving| moving.register);
        // The same again with other words: these are taken anew from now on.
        let place = self.order.iter().position(|&number| {
            let course = &self.courses[number];
            course.moving == self.moving && course.loosen(slab, &mut self.loose)
        });
        let graph = &self.graph;
        let mut edges = self.due.clone();
        let touched = &self.touched[graph.edge_word..graph.sight_word];
        edges
            .iter_mut()
            .zip(touched)
            .for_each(|(to, from)| *to |= from);
        let sights = bits(&self.touched[graph.sight_word..]).map(|sight| graph.sights[sight]);
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
        let recorder = Recorder::new(&mut pairs, &self.loose);
        let Some(mut course) = recorder.record(&edges, sights) else {
            return;
        };
        course.moving.clone_from(&self.moving);
        course.steps = 16 + (course.makings.len() + course.bounds.len()) as u64 * 8;
        self.work += course.steps * NOTE;
        let number = match place {
            Some(place) => self.order.remove(place),
            None if self.courses.len() < COURSES => {
                self.courses.push(Course::default());
                self.courses.len() - 1
            }
            None => self.order.pop().unwrap_or(0),
        };
        self.courses[number] = course;
        self.order.insert(0, number);
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
            let value = slab[moving.slot as usize].wrapping_add(way) & mask(moving.width);
            put(&plan.layout, slab, moving.slot, value);
        }
        if ticks == self.end
            && let Some(moving) = self.moving.first()
        {
            self.bend = Some((moving.slot, slab[moving.slot as usize]));
        }
    }
}

/// Puts one first, in place of the last if it is new.
fn recall_first<T: PartialEq>(list: &mut [T], one: T) {
    let last = list.len() - 1;
    let place = list.iter().position(|known| *known == one);
    list[..=place.unwrap_or(last)].rotate_right(1);
    list[0] = one;
}
