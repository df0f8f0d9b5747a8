//! What goes into a circuit during a job, recorded once and applied to both models.

use motion_rtl::kernel::{
    Circuit, Field, Observer, Probe, RunError, Sample, Shape, Signals, Source, zero,
};
use motion_rtl::logic::Sim;
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
    words: Vec<u64>,
    port: usize,
    most: u64,
}

impl Recorder {
    pub fn new(most: u64) -> Self {
        Recorder {
            stimulus: Stimulus::default(),
            words: Vec::new(),
            port: 0,
            most,
        }
    }

    pub fn finish(self) -> Stimulus {
        self.stimulus
    }

    /// The tick that comes next.
    pub fn tick<S: Signals<Sim>>(&mut self, i: &S) {
        self.port = 0;
        i.visit(const { &Field::named("") }, self);
        self.stimulus.ticks += 1;
    }
}

impl Probe for Recorder {
    fn leaf(&mut self, _: &'static Field, _: Shape, value: u64) {
        if self.port == self.words.len() {
            self.words.push(0);
        }
        if self.words[self.port] != value {
            self.words[self.port] = value;
            self.stimulus.changes.push(Change {
                tick: self.stimulus.ticks as u32,
                port: self.port as u32,
                value,
            });
        }
        self.port += 1;
    }
}

impl<C: Circuit> Observer<C> for Recorder {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.tick(&**now.i);
        Ok(match self.stimulus.ticks < self.most {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        })
    }
}

/// The recorded inputs, tick after tick.
pub struct Replay<'a, C: Circuit> {
    changes: &'a [Change],
    /// Of the ports that have changed, and those before them.
    words: Vec<u64>,
    i: C::In<Sim>,
    next: u64,
}

impl<'a, C: Circuit> Replay<'a, C> {
    pub fn new(stimulus: &'a Stimulus) -> Self {
        Replay {
            next: stimulus
                .changes
                .first()
                .map_or(u64::MAX, |change| change.tick.into()),
            changes: &stimulus.changes,
            words: Vec::new(),
            i: zero::<C::In<Sim>>(),
        }
    }

    pub fn tick(&mut self, tick: u64) -> C::In<Sim> {
        if tick == self.next {
            self.apply();
        }
        self.i.clone()
    }

    /// The same, and for how many ticks they are held: the next tick asked for is in these, or the
    /// one after them.
    pub fn held(&mut self, tick: u64) -> (C::In<Sim>, u64) {
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
        self.i = C::In::make(const { &Field::named("") }, &mut Given(self.words.iter()));
    }
}

/// Words; those that are missing are low.
struct Given<'a>(std::slice::Iter<'a, u64>);

impl Source for Given<'_> {
    fn leaf(&mut self, _: &'static Field, _: Shape) -> u64 {
        self.0.next().copied().unwrap_or_default()
    }
}
