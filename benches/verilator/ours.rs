//! The model on a recorded stimulus.

use super::stimulus::{Replay, Stimulus};
use super::theirs::ROTATION;
use motion_rtl::kernel::{Circuit, Observer, RunError, Sample, Simulator};
use motion_rtl::logic::sim::{Int, UInt, Wire};
use motion_rtl::logic::{Bit, Signed, Sim};
use motion_rtl::trace::{Clock, Fst, Options, Vcd, VcdBehind};
use std::fs::File;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

/// A circuit whose outputs can be read.
pub trait Outputs: Circuit + Sized {
    /// One word that all of them have a part in, in the order of the ports.
    fn outputs(now: &Sample<'_, Self>) -> Mix;
}

/// What the outputs of a tick come to.
#[derive(Default)]
pub struct Mix {
    pub word: u64,
    place: u32,
}

impl Mix {
    pub fn with<P: Port>(self, port: &P) -> Self {
        port.mix(self)
    }

    fn word(self, word: u64) -> Self {
        Mix {
            word: self.word ^ word.rotate_left(self.place),
            place: (self.place + ROTATION) % 64,
        }
    }
}

/// A port out, or some.
pub trait Port {
    fn mix(&self, mix: Mix) -> Mix;
}

impl Port for Wire {
    fn mix(&self, mix: Mix) -> Mix {
        mix.word(Bit::<Sim>::word(*self).get())
    }
}

impl<const N: usize> Port for UInt<N> {
    fn mix(&self, mix: Mix) -> Mix {
        mix.word(self.get())
    }
}

impl<const N: usize> Port for Int<N> {
    fn mix(&self, mix: Mix) -> Mix {
        mix.word(Signed::<Sim, N>::unsigned(*self).get())
    }
}

impl<P: Port, const K: usize> Port for [P; K] {
    fn mix(&self, mix: Mix) -> Mix {
        self.iter().fold(mix, Mix::with)
    }
}

/// Reads the outputs of every so many ticks.
struct Checksum<const EVERY: u64>(u64);

impl<C: Outputs, const EVERY: u64> Observer<C> for Checksum<EVERY> {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        if now.tick.is_multiple_of(EVERY) {
            self.0 = self.0.rotate_left(1).wrapping_add(C::outputs(now).word);
        }
        Ok(ControlFlow::Continue(()))
    }
}

/// A run, and the checksum over the outputs of every so many ticks.
pub fn run<C: Outputs, const EVERY: u64>(circuit: &C, stimulus: &Stimulus) -> (Duration, u64) {
    let mut replay = Replay::<C>::new(stimulus);
    let mut sum = Checksum::<EVERY>(0);
    let simulator = Simulator::new(circuit).unwrap();
    let begun = Instant::now();
    let run = simulator.run(stimulus.ticks, |tick, _| replay.tick(tick), &mut sum);
    let taken = begun.elapsed();
    drop(run.expect("no observer objects"));
    (taken, sum.0)
}

/// Reads the outputs of every tick, of which it sees those that are not gone over: in the others
/// the outputs are held.
#[derive(Default)]
struct Held {
    sum: u64,
    /// The outputs of the tick seen last.
    word: u64,
    /// The first tick whose outputs are not in the sum.
    tick: u64,
}

impl<C: Outputs> Observer<C> for Held {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.until(now.tick);
        self.word = C::outputs(now).word;
        Ok(ControlFlow::Continue(()))
    }
}

impl Held {
    fn until(&mut self, tick: u64) {
        for _ in self.tick..tick {
            self.sum = self.sum.rotate_left(1).wrapping_add(self.word);
        }
        self.tick = tick;
    }
}

/// A run that goes over idle ticks, and the checksum over the outputs of every tick.
pub fn forward<C: Outputs>(circuit: &C, stimulus: &Stimulus) -> (Duration, u64) {
    let mut replay = Replay::<C>::new(stimulus);
    let mut held = Held::default();
    let simulator = Simulator::new(circuit).unwrap();
    let begun = Instant::now();
    let run = simulator.fast_forward(stimulus.ticks, |tick, _| replay.held(tick), &mut held);
    held.until(stimulus.ticks);
    let taken = begun.elapsed();
    drop(run.expect("no observer objects"));
    (taken, held.sum)
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
pub fn dump<C: Outputs>(
    circuit: &C,
    stimulus: &Stimulus,
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
fn seen<C: Outputs>(
    circuit: &C,
    stimulus: &Stimulus,
    from: u64,
    observer: impl Observer<C>,
) -> (Instant, u64) {
    let mut replay = Replay::<C>::new(stimulus);
    let mut sum = Checksum::<1>(0);
    let simulator = Simulator::new(circuit).unwrap();
    let before = simulator.run(from, |tick, _| replay.tick(tick), &mut sum);
    let before = before.expect("no observer objects");
    let observers = (observer, &mut sum);
    let begun = Instant::now();
    let run = before.run(
        stimulus.ticks - from,
        |tick, _| replay.tick(tick),
        observers,
    );
    drop(run.expect("room"));
    (begun, sum.0)
}
