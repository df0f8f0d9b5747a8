//! The model on a recorded stimulus.

use super::theirs::ROTATION;
use motion_rtl::hdl::Circuit;
use motion_rtl::sim::{Needs, Observer, RecordedInputs, ReplayTick, RunError, Sample, Simulator};
use motion_rtl::trace::{Clock, Fst, Options, Vcd, VcdBehind};
use std::fs::File;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

/// The bits by which an output is rotated in the word that all outputs have a part in.
fn place(output: usize) -> u32 {
    (output as u32 * ROTATION) % 64
}

/// One word that all outputs have a part in.
fn word<C: Circuit>(outputs: &[usize], now: &Sample<'_, C>) -> u64 {
    let engine = now.engine();
    let turned = outputs
        .iter()
        .enumerate()
        .map(|(output, &leaf)| engine.leaf(leaf).unwrap_or(0).rotate_left(place(output)));
    turned.fold(0, |word, turned| word ^ turned)
}

/// The checksum over the outputs of every so many ticks: where a tick is not seen they are held.
struct Checksum<'o> {
    outputs: &'o [usize],
    every: u64,
    sum: u64,
    /// The outputs of the tick seen last.
    word: u64,
    /// The first tick that is not in the sum.
    tick: u64,
}

impl<'o> Checksum<'o> {
    fn new(outputs: &'o [usize], every: u64) -> Self {
        Checksum {
            outputs,
            every,
            sum: 0,
            word: 0,
            tick: 0,
        }
    }

    fn until(&mut self, tick: u64) {
        if self.every == 1 {
            for _ in self.tick..tick {
                self.sum = self.sum.rotate_left(1).wrapping_add(self.word);
            }
            self.tick = tick;
        }
        while self.tick < tick {
            self.sum = self.sum.rotate_left(1).wrapping_add(self.word);
            self.tick += self.every;
        }
    }
}

impl<C: Circuit> Observer<C> for Checksum<'_> {
    fn needs(&self) -> Needs {
        Needs::NONE
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.until(now.tick);
        self.word = word(self.outputs, now);
        Ok(ControlFlow::Continue(()))
    }
}

/// Way of running a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Tick by tick, in compiled code.
    Compiled,
    /// Tick by tick, by the interpreter.
    Interpreted,
    /// Compiled, idle ticks gone over.
    Forward,
}

/// A circuit that is ready to run.
pub struct Ours<C: Circuit> {
    simulator: Simulator<C>,
    outputs: Vec<usize>,
    way: Way,
}

impl<C: Circuit> Ours<C> {
    /// Elaborates and plans it; a first run over the stimulus has it compiled.
    pub fn new(circuit: &C, stimulus: &RecordedInputs, way: Way) -> Self {
        let watched = Simulator::watching(circuit, false, |watch| watch.ports_out());
        let (mut simulator, outputs) = watched.expect("a netlist");
        if way == Way::Interpreted {
            simulator.interpret();
        }
        let ours = Ours {
            simulator,
            outputs,
            way,
        };
        if way != Way::Interpreted {
            ours.run(stimulus, 1);
        }
        ours
    }

    /// A run, and the checksum over the outputs of every so many ticks.
    pub fn run(&self, stimulus: &RecordedInputs, every: u64) -> (Duration, u64) {
        let mut sum = Checksum::new(&self.outputs, every);
        let mut words = vec![0; self.outputs.len()];
        let mut simulator = self.simulator.clone();
        let (ticks, changes, outputs) = (stimulus.ticks, &stimulus.changes, &self.outputs);
        let begun = Instant::now();
        let see = |now: ReplayTick<'_>| {
            sum.until(now.tick);
            for (output, word) in now.changes() {
                let old = std::mem::replace(&mut words[output], word);
                sum.word ^= (old ^ word).rotate_left(place(output));
            }
        };
        let run = match self.way {
            Way::Forward => simulator.fast_replay(ticks, changes, outputs, see),
            _ => simulator.replay(ticks, changes, outputs, see),
        };
        sum.until(stimulus.ticks);
        let taken = begun.elapsed();
        run.expect("no observer objects");
        (taken, sum.sum)
    }
}

/// Waves of every signal.
#[derive(Debug, Clone, Copy)]
pub enum Waves {
    /// VCD, written by the run itself.
    Vcd,
    /// VCD, formatted and written by a thread behind the run.
    VcdBehind,
    /// FST, which has a thread of its own.
    Fst,
}

/// A run with waves from a tick on: how long these take, behind their head, and the checksum.
pub fn dump<C: Circuit>(
    circuit: &C,
    stimulus: &RecordedInputs,
    from: u64,
    waves: Waves,
    path: &Path,
) -> (Duration, u64) {
    let clock = Clock::from_hz(100_000_000).expect("a good rate");
    let options = Options {
        ticks: from..u64::MAX,
        only: None,
    };
    let file = File::create(path).expect("a file");
    match waves {
        Waves::Vcd => {
            let mut vcd = Vcd::new(file, circuit, clock, &options).expect("a good circuit");
            let (begun, sum) = seen(circuit, stimulus, from, &mut vcd);
            vcd.finish().expect("room");
            (begun.elapsed(), sum)
        }
        Waves::VcdBehind => {
            let mut vcd = VcdBehind::new(file, circuit, clock, &options).expect("a good circuit");
            let (begun, sum) = seen(circuit, stimulus, from, &mut vcd);
            vcd.finish().expect("room");
            (begun.elapsed(), sum)
        }
        Waves::Fst => {
            let mut fst = Fst::new(file, circuit, clock, &options).expect("a good circuit");
            let (begun, sum) = seen(circuit, stimulus, from, &mut fst);
            fst.finish().expect("room");
            (begun.elapsed(), sum)
        }
    }
}

/// A run with an observer from a tick on: when that began, and the checksum over the outputs of
/// every tick.
fn seen<C: Circuit>(
    circuit: &C,
    stimulus: &RecordedInputs,
    from: u64,
    observer: impl Observer<C>,
) -> (Instant, u64) {
    let mut replay = stimulus.playback();
    let watched = Simulator::watching(circuit, true, |watch| watch.ports_out());
    let (mut simulator, outputs) = watched.expect("a netlist");
    let mut sum = Checksum::new(&outputs, 1);
    let before = simulator.run_changes(from, |at| replay.tick(at), &mut sum);
    before.expect("no observer objects");
    let observers = (observer, &mut sum);
    let begun = Instant::now();
    let run = simulator.run_changes(stimulus.ticks - from, |at| replay.tick(at), observers);
    sum.until(stimulus.ticks);
    run.expect("room");
    (begun, sum.sum)
}
