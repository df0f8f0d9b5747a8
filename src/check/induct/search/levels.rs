//! Levels of a search: the sets of states that are not reached within some edges.

use super::{Cube, End, Search};
use batsat::Lit;

/// Clauses of a level.
pub(super) struct Level {
    /// Literal that makes the clauses of the level count.
    pub active: Lit,
    pub cubes: Vec<Cube>,
}

impl Search<'_> {
    pub(super) fn deepen(&mut self) {
        let active = self.clauses.free();
        let cubes = Vec::new();
        self.levels.push(Level { active, cubes });
    }

    /// Returns the literals that restrict the state to a level.
    pub(super) fn inside(&mut self, level: usize) -> Vec<Lit> {
        if level > 0 {
            let levels = self.levels[level..].iter();
            return levels.map(|level| level.active).collect();
        }
        let bits = (0..self.bits.len()).map(|bit| (bit, self.power_on[bit]));
        let bits: Cube = bits.collect();
        self.lits(&bits, |search| &search.bits)
    }

    pub(super) fn is_blocked(&self, cube: &Cube, level: usize) -> bool {
        let mut known = self.levels[level..].iter().flat_map(|level| &level.cubes);
        known.any(|known| is_subset(known, cube))
    }

    /// Returns a larger set that no edge enters from a state of a level outside of it, if an edge
    /// does not enter this one.
    pub(super) fn apart(&mut self, cube: &Cube, level: usize) -> Result<Option<Cube>, End> {
        let outside = self.clauses.free();
        let mut clause = vec![!outside];
        let here = self.lits(cube, |search| &search.bits);
        clause.extend(here.into_iter().map(|lit| !lit));
        self.clauses.assert(&clause);
        let after = self.lits(cube, |search| &search.next);
        let mut assumed = self.inside(level);
        assumed.push(outside);
        assumed.push(self.lit(self.property));
        assumed.extend(&after);
        let entered = self.solve(&assumed);
        let bits = cube.iter().copied().zip(after);
        let needed = |lit: Lit| self.clauses.is_needed(lit);
        let needed = bits.filter(|&(_, lit)| needed(lit)).map(|(bit, _)| bit);
        let mut smaller: Cube = needed.collect();
        self.clauses.assert(&[!outside]);
        if entered? {
            return Ok(None);
        }
        if self.has_power_on(&smaller) {
            let mut bits = cube.iter();
            let other = bits.find(|&&(index, high)| self.power_on[index] != high);
            smaller.extend(other);
            smaller.sort_unstable();
        }
        Ok(Some(smaller))
    }

    /// Makes a set that no edge enters from the level below as large as possible, and excludes it
    /// from the highest level for which that holds. Returns the level above that one.
    pub(super) fn exclude(&mut self, mut cube: Cube, mut level: usize) -> Result<usize, End> {
        for bit in cube.clone() {
            let mut larger = cube.clone();
            larger.retain(|other| *other != bit);
            if larger.len() == cube.len() || self.has_power_on(&larger) {
                continue;
            }
            if let Some(larger) = self.apart(&larger, level - 1)? {
                cube = larger;
            }
        }
        while level + 1 < self.levels.len() && self.apart(&cube, level)?.is_some() {
            level += 1;
        }
        self.add(cube, level);
        Ok(level + 1)
    }

    pub(super) fn add(&mut self, cube: Cube, level: usize) {
        for known in &mut self.levels[..=level] {
            known.cubes.retain(|known| !is_subset(&cube, known));
        }
        let here = self.lits(&cube, |search| &search.bits);
        let mut clause = vec![!self.levels[level].active];
        clause.extend(here.into_iter().map(|lit| !lit));
        self.clauses.assert(&clause);
        self.levels[level].cubes.push(cube);
    }

    /// Excludes the sets of a level from the next one if no edge enters them.
    pub(super) fn propagate(&mut self, level: usize) -> Result<(), End> {
        for cube in self.levels[level].cubes.clone() {
            if self.apart(&cube, level)?.is_some() {
                self.add(cube, level + 1);
            }
        }
        Ok(())
    }
}

/// True if every bit of the first set is one of the second: the second contains fewer states.
fn is_subset(few: &Cube, many: &Cube) -> bool {
    few.iter().all(|bit| many.binary_search(bit).is_ok())
}
