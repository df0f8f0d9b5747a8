//! What goes into a circuit during a job, recorded once and applied to both models.

use motion_rtl::hdl::{Circuit, Declarations, Observer, Role, RunError, Sample, Value, inputs};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::ops::ControlFlow;
use std::path::Path;

/// A port in takes a value.
#[derive(Debug, Clone, Copy)]
struct Change {
    tick: u32,
    port: u32,
    value: u64,
}

/// The changes of all ports in, in the order of ticks; at power-on they are low.
#[derive(Debug, Default)]
pub struct Stimulus {
    changes: Vec<Change>,
    pub ticks: u64,
}

impl Stimulus {
    /// For the Verilated model: 16 bytes a change.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        let mut out = BufWriter::new(File::create(path)?);
        for change in self.changes.iter().chain([&END]) {
            out.write_all(&change.tick.to_le_bytes())?;
            out.write_all(&change.port.to_le_bytes())?;
            out.write_all(&change.value.to_le_bytes())?;
        }
        out.into_inner()?.sync_data()
    }
}

/// Comes in no tick.
const END: Change = Change {
    tick: u32::MAX,
    port: 0,
    value: 0,
};

/// Records the inputs of a run, and ends it after so many ticks.
#[derive(Debug)]
pub struct Recorder {
    stimulus: Stimulus,
    /// Of the circuit's own ports in: others stand beside it.
    words: Vec<u64>,
    most: u64,
}

impl Recorder {
    pub fn new<C: Circuit>(circuit: &C, most: u64) -> Self {
        let leaves = Declarations::of(circuit).leaves;
        let ports = leaves.iter().take_while(|leaf| leaf.role == Role::Input);
        Recorder {
            stimulus: Stimulus::default(),
            words: ports.map(|_| 0).collect(),
            most,
        }
    }

    pub fn finish(self) -> Stimulus {
        self.stimulus
    }
}

impl<C: Circuit> Observer<C> for Recorder {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        for (port, word) in self.words.iter_mut().enumerate() {
            let value = now.engine().port(port);
            if *word != value {
                *word = value;
                self.stimulus.changes.push(Change {
                    tick: self.stimulus.ticks as u32,
                    port: port as u32,
                    value,
                });
            }
        }
        self.stimulus.ticks += 1;
        Ok(match self.stimulus.ticks < self.most {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        })
    }
}

/// The recorded inputs, tick after tick.
pub struct Replay<'a, C: Circuit> {
    circuit: &'a C,
    changes: &'a [Change],
    /// Of the ports that have changed, and those before them.
    words: Vec<u64>,
    next: u64,
}

impl<'a, C: Circuit> Replay<'a, C> {
    pub fn new(circuit: &'a C, stimulus: &'a Stimulus) -> Self {
        Replay {
            circuit,
            next: stimulus
                .changes
                .first()
                .map_or(u64::MAX, |change| change.tick.into()),
            changes: &stimulus.changes,
            words: Vec::new(),
        }
    }

    pub fn tick(&mut self, tick: u64) -> C::In<Value> {
        if tick == self.next {
            self.apply();
        }
        let mut words = self.words.iter().copied();
        // Those that have not changed yet are low.
        inputs(self.circuit, |_| words.next().unwrap_or_default())
    }

    /// The same, and for how many ticks they are held: the next tick asked for is in these, or the
    /// one after them.
    pub fn held(&mut self, tick: u64) -> (C::In<Value>, u64) {
        let i = self.tick(tick);
        (i, self.next - tick)
    }

    fn apply(&mut self) {
        while let Some((change, rest)) = self.changes.split_first() {
            if u64::from(change.tick) != self.next {
                break;
            }
            let port = change.port as usize;
            self.words.resize(self.words.len().max(port + 1), 0);
            self.words[port] = change.value;
            self.changes = rest;
        }
        self.next = self
            .changes
            .first()
            .map_or(u64::MAX, |change| change.tick.into());
    }
}
