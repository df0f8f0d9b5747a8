use crate::trace::section::Section;
use crate::trace::walk::Change;

/// The changes of a section by leaf; those of a leaf stay in their order.
#[derive(Debug, Default)]
pub struct Sorted {
    /// Where the changes of a leaf end in `runs`.
    ends: Vec<u32>,
    runs: Vec<Value>,
}

/// A value and when it begins: the place in the table of times.
#[derive(Debug, Default, Clone, Copy)]
pub struct Value {
    pub place: u32,
    pub bits: u64,
}

impl Sorted {
    /// Sorts by counting.
    pub fn sort(&mut self, section: &Section, leaves: usize) {
        let Sorted { ends, runs } = self;
        ends.clear();
        ends.resize(leaves, 0);
        for change in &section.changes {
            ends[change.leaf as usize] += 1;
        }
        let mut start = 0;
        for end in ends.iter_mut() {
            // Until all are placed, where the next one goes.
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

    /// Those of a leaf.
    pub fn run(&self, leaf: usize) -> &[Value] {
        let start = leaf.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.runs[start as usize..self.ends[leaf] as usize]
    }
}
