use crate::trace::section::Section;
use crate::trace::walk::Change;

/// Changes of a section sorted by leaf; those of a leaf keep their order.
#[derive(Debug, Default)]
pub struct Sorted {
    /// End of each leaf's changes in `runs`.
    ends: Vec<u32>,
    runs: Vec<Value>,
}

/// Value, and its start as an index into the time table.
#[derive(Debug, Default, Clone, Copy)]
pub struct Value {
    pub place: u32,
    pub bits: u64,
}

impl Sorted {
    /// Sorts the changes by counting.
    pub fn sort(&mut self, section: &Section, leaves: usize) {
        let Sorted { ends, runs } = self;
        ends.clear();
        ends.resize(leaves, 0);
        for change in &section.changes {
            ends[change.leaf as usize] += 1;
        }
        let mut start = 0;
        for end in ends.iter_mut() {
            // Until all are placed: position of the next one.
            start += std::mem::replace(end, start);
        }
        runs.resize(section.changes.len(), Value::default());
        for ((_, changes), place) in section.ticks().zip((0..).step_by(2)) {
            for &Change { leaf, bits } in changes {
                let next = &mut ends[leaf as usize];
                runs[*next as usize] = Value { place, bits };
                *next += 1;
            }
        }
    }

    /// Returns the changes of a leaf.
    pub fn run(&self, leaf: usize) -> &[Value] {
        let start = leaf.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.runs[start as usize..self.ends[leaf] as usize]
    }
}
