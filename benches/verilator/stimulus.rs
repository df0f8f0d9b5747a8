//! Inputs of a circuit during a job, recorded once and applied to both models.

use motion_rtl::hdl::{Circuit, Declarations};
use motion_rtl::netlist::Role;
use motion_rtl::sim::{Observer, RunError, Sample, Simulator};
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
    /// Values of the circuit's own input ports.
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
            let value = now.engine().port(port).expect("the circuit's own");
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
pub struct Replay<'a> {
    changes: &'a [Change],
}

impl<'a> Replay<'a> {
    pub fn new(stimulus: &'a Stimulus) -> Self {
        Replay {
            changes: &stimulus.changes,
        }
    }

    /// Sets the inputs that change in the next tick; returns for how many ticks they are held.
    /// That tick must be one of those held before, or the one after them.
    pub fn held<C: Circuit>(&mut self, at: &mut Simulator<C>) -> Result<u64, RunError> {
        while let Some((change, rest)) = self.changes.split_first() {
            let to_come = u64::from(change.tick) - at.tick();
            if to_come > 0 {
                return Ok(to_come);
            }
            at.set_port(change.port as usize, change.value)?;
            self.changes = rest;
        }
        Ok(u64::MAX)
    }

    /// Sets the inputs that change in the next tick; returns at most 1 tick.
    pub fn tick<C: Circuit>(&mut self, at: &mut Simulator<C>) -> Result<u64, RunError> {
        Ok(self.held(at)?.min(1))
    }
}
