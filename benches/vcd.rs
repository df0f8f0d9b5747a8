//! Cost of a dump per tick: fifty signals of which none or half change, and eight memories of
//! 4,096 words; formatted alone, and into a file as VCD, as VCD with a thread that formats and
//! writes, as FST.

use divan::counter::ItemsCount;
use motion_rtl::prelude::*;
use motion_rtl::sim::Observer;
use motion_rtl::trace::{Clock, Fst, Options, Vcd, VcdBehind};
use std::fs::File;
use std::io;

/// Ticks of a run whose bytes go nowhere, and of one into a file.
const TICKS: u64 = 20_000;
const LONG: u64 = 400_000;

/// Names of the phases.
const PHASES: &[&str] = &["IDLE", "RUN", "STOP"];

/// Six signals.
#[derive(Debug, Clone)]
struct Walker;

signals! { for (Walker, Bank) as _c;
    /// Ports in.
    pub struct In {
        /// Size of a step.
        step: U(3),
        /// Upwards.
        up: Bit,
    }
}

signals! { for Walker as _c;
    /// Flip-flops.
    pub struct Reg {
        /// Where it is.
        level: I(9) as Analog,
        /// Number of wraps.
        phase: U(2) as States(PHASES),
    }
    /// Nets.
    pub struct Net {
        /// Next level.
        next_level: I(9),
        /// The level wraps.
        wrapped: Bit,
    }
}

impl Circuit for Walker {
    const NAME: &'static str = "walker";
    const ABOUT: &'static str = "goes up and down";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let step = i.step.resize(9).signed();
        let level = i.up.mux(q.level + step, q.level - step);
        let wrapped = level.is_negative() ^ q.level.is_negative();
        let phase = wrapped.mux(q.phase + 1, q.phase);
        let net = Net {
            next_level: level,
            wrapped,
        };
        (net, Reg { level, phase })
    }
}

/// Eight parts of six signals on the same two ports.
#[derive(Debug, Clone)]
struct Bank;

signals! { for Bank as _c;
    /// The parts.
    pub struct Parts {
        /// The parts.
        part: [Part<Walker>(Walker); 8],
    }
}

impl Circuit for Bank {
    const NAME: &'static str = "bank";
    const ABOUT: &'static str = "eight parts";
    records!(In, Nothing, Nothing, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Nothing, Nothing) {
        settle_each(p.part, |_| i.clone());
        (Nothing, Nothing)
    }
}

/// Eight memories of 4,096 words.
#[derive(Debug, Clone)]
struct Store;

signals! { for Store as _c;
    /// Ports in.
    pub struct StoreIn {
        /// The word is written.
        write: Bit,
        /// The word, with its address in its lower bits.
        word: U(24),
    }
    /// Memories.
    pub struct StoreReg {
        /// The memories.
        word: [Ram(12, 24); 8],
    }
    /// Nets.
    pub struct StoreNet {
        /// Write address.
        address: U(12),
    }
}

impl Circuit for Store {
    const NAME: &'static str = "store";
    const ABOUT: &'static str = "eight memories";
    records!(StoreIn, StoreReg, StoreNet);

    fn tick(&self, i: StoreIn, q: StoreReg, _: Nothing) -> (StoreNet, StoreReg<Edge>) {
        let address = i.word.resize(12);
        let memories = q.word.into_iter();
        let word = memories.map(|ram| ram.write(i.write, address, i.word));
        let next = StoreReg {
            word: word.collect(),
        };
        (StoreNet { address }, next)
    }
}

fn run<C: Circuit>(
    circuit: &C,
    ticks: u64,
    i: impl Fn(u64) -> C::In<Value>,
    observer: impl Observer<C>,
) {
    let run = Simulator::new(circuit)
        .unwrap()
        .run(ticks, |tick, _| i(tick), observer);
    divan::black_box(run.is_ok());
}

fn part_in(step: u64) -> impl Fn(u64) -> In<Value> {
    move |_| In { step, up: true }
}

fn store_in(write: bool) -> impl Fn(u64) -> StoreIn<Value> {
    move |word| StoreIn { write, word }
}

fn clock() -> Clock {
    Clock::from_hz(50_000_000).expect("a good rate")
}

fn vcd<C: Circuit, W: io::Write>(circuit: &C, out: W) -> Vcd<W> {
    Vcd::new(out, circuit, clock(), &Options::default()).expect("a good circuit")
}

fn vcd_behind<C: Circuit>(circuit: &C, out: File) -> VcdBehind<File> {
    VcdBehind::new(out, circuit, clock(), &Options::default()).expect("a good circuit and a thread")
}

fn fst<C: Circuit>(circuit: &C, out: File) -> Fst<File> {
    Fst::new(out, circuit, clock(), &Options::default()).expect("a good circuit and a good file")
}

fn file() -> File {
    tempfile::tempfile().expect("a file")
}

fn measure<C: Circuit>(
    bencher: divan::Bencher<'_, '_>,
    circuit: &C,
    i: impl Fn(u64) -> C::In<Value> + Sync,
) {
    bencher
        .counter(ItemsCount::new(TICKS))
        .with_inputs(|| vcd(circuit, io::sink()))
        .bench_local_values(|mut vcd| {
            run(circuit, TICKS, &i, &mut vcd);
            vcd.finish().is_ok()
        });
}

/// Steps of 0 (`clk` alone changes) and 1 (more than a third of the signals changes
/// in every tick).
#[divan::bench(args = [0, 1])]
fn fifty_signals(bencher: divan::Bencher<'_, '_>, step: u64) {
    measure(bencher, &Bank, part_in(step));
}

/// No word, or one in each memory, changes in every tick.
#[divan::bench(args = [false, true])]
fn eight_memories(bencher: divan::Bencher<'_, '_>, write: bool) {
    measure(bencher, &Store, store_in(write));
}

#[divan::bench(args = [0, 1], sample_count = 20, sample_size = 1)]
fn file_vcd(bencher: divan::Bencher<'_, '_>, step: u64) {
    bencher
        .counter(ItemsCount::new(LONG))
        .with_inputs(|| vcd(&Bank, file()))
        .bench_local_values(|mut vcd| {
            run(&Bank, LONG, part_in(step), &mut vcd);
            vcd.finish().is_ok()
        });
}

#[divan::bench(args = [0, 1], sample_count = 20, sample_size = 1)]
fn file_vcd_thread(bencher: divan::Bencher<'_, '_>, step: u64) {
    bencher
        .counter(ItemsCount::new(LONG))
        .with_inputs(|| vcd_behind(&Bank, file()))
        .bench_local_values(|mut vcd| {
            run(&Bank, LONG, part_in(step), &mut vcd);
            vcd.finish().is_ok()
        });
}

#[divan::bench(args = [0, 1], sample_count = 20, sample_size = 1)]
fn file_fst(bencher: divan::Bencher<'_, '_>, step: u64) {
    bencher
        .counter(ItemsCount::new(LONG))
        .with_inputs(|| fst(&Bank, file()))
        .bench_local_values(|mut fst| {
            run(&Bank, LONG, part_in(step), &mut fst);
            fst.finish().is_ok()
        });
}

fn bytes_a_tick(what: &str, step: u64) {
    let (mut vcd, mut fst) = (vcd(&Bank, file()), fst(&Bank, file()));
    run(&Bank, LONG, part_in(step), (&mut vcd, &mut fst));
    let length = |file: File| file.metadata().map_or(0, |file| file.len());
    for (format, file) in [("VCD", vcd.finish()), ("FST", fst.finish())] {
        let bytes = file.map_or(0, length);
        println!(
            "{what}: {:.2} bytes a tick of {format}",
            bytes as f64 / LONG as f64
        );
    }
}

fn main() {
    bytes_a_tick("fifty signals, step 0", 0);
    bytes_a_tick("fifty signals, step 1", 1);
    divan::main();
}
