//! Waves: every signal is in the dump, at the right time, in every reader.

mod behind;
mod beside;
mod chart;
mod dump;
mod fst;
mod gtkwave;
mod last_ticks;
mod model;
mod names;
mod reader;
mod replay;
mod reset;
mod series;
mod surfer;
mod text;
mod watched;
mod windows;
mod zoo;

use motion_rtl::hdl::{Circuit, Value};
use motion_rtl::sim::{RunError, Simulator};
use motion_rtl::trace::{Clock, Options, Recorder, Vcd};
use std::ops::Range;
use zoo::{Zoo, inputs};

const SEED: u64 = 2026;

fn clock() -> Clock {
    Clock::from_hz(50_000_000).unwrap()
}

fn options(ticks: Range<u64>, only: &[&str]) -> Options {
    let only = only.iter().map(|&path| path.to_owned()).collect::<Vec<_>>();
    Options {
        ticks,
        only: (!only.is_empty()).then_some(only),
    }
}

/// Runs the zoo on random inputs and returns its dump and its recording.
fn run_zoo(ticks: u64, options: &Options) -> (Vec<u8>, Recorder) {
    let mut vcd = Vcd::new(Vec::new(), &Zoo, clock(), options).unwrap();
    let mut recorder = Recorder::new(&Zoo, &Options::default()).unwrap();
    let mut inputs = inputs(SEED);
    Simulator::new(&Zoo)
        .unwrap()
        .run(
            ticks,
            |_, _| inputs.next().unwrap(),
            (&mut vcd, &mut recorder),
        )
        .unwrap();
    (vcd.finish().unwrap(), recorder)
}

/// Runs a circuit on the same inputs in every tick and returns its dump.
fn dump<C: Circuit>(
    circuit: &C,
    ticks: u64,
    clock: Clock,
    i: impl Fn() -> C::In<Value>,
) -> Result<Vec<u8>, RunError> {
    let options = Options::default();
    let mut vcd = Vcd::new(Vec::new(), circuit, clock, &options).map_err(std::io::Error::from)?;
    Simulator::new(circuit)?.run(ticks, |_, _| i(), &mut vcd)?;
    Ok(vcd.finish()?)
}
