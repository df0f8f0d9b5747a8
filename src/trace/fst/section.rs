use crate::trace::walk::Change;

/// A piece of a run.
#[derive(Debug, Default)]
pub struct Section {
    pub ticks: Vec<Tick>,
    pub changes: Vec<Change>,
    /// When the run is over, in the last one.
    pub end: Option<u64>,
}

/// A tick in it.
#[derive(Debug, Clone, Copy)]
pub struct Tick {
    /// When `clk` rises and everything changes.
    pub rise: u64,
    /// When `clk` falls.
    pub fall: u64,
    /// How many changes there have been after it.
    pub changes: usize,
}

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
        let mut from = 0;
        for (tick, place) in section.ticks.iter().zip((0..).step_by(2)) {
            for &Change { leaf, bits } in &section.changes[from..tick.changes] {
                let next = &mut ends[leaf as usize];
                runs[*next as usize] = Value { place, bits };
                *next += 1;
            }
            from = tick.changes;
        }
    }

    /// Those of a leaf.
    pub fn run(&self, leaf: usize) -> &[Value] {
        let start = leaf.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.runs[start as usize..self.ends[leaf] as usize]
    }
}
