//! What a dump costs a tick: fifty signals of which none or half change, and eight memories of
//! 4,096 words; formatted alone, and into a file as VCD, as VCD with a thread that formats and writes,
//! as FST.

#[path = "../tests/files/waves/zoo.rs"]
#[expect(dead_code, reason = "only its part is measured here")]
mod zoo;

use divan::counter::ItemsCount;
use motion_rtl::kernel::{Circuit, Instance, Observer, Simulator};
use motion_rtl::logic::{Logic, Ram, Sim, Unsigned};
use motion_rtl::signals;
use motion_rtl::trace::{Clock, Fst, Options, Vcd, VcdBehind};
use std::fs::File;
use std::io;
use zoo::{Part, PartIn, PartReg};

/// Ticks of a run whose bytes go nowhere, and of one into a file.
const TICKS: u64 = 20_000;
const LONG: u64 = 400_000;

signals! { struct BankReg<L> { part: [PartReg<L>; 8] } }
signals! { struct BankNet<L> { part: [Instance<Part, L>; 8] } }

/// Eight parts of six signals on the same two ports.
struct Bank;

impl Circuit for Bank {
    const NAME: &'static str = "bank";
    const ABOUT: &'static str = "eight parts";
    type In<L: Logic> = PartIn<L>;
    type Reg<L: Logic> = BankReg<L>;
    type Net<L: Logic> = BankNet<L>;

    fn comb<L: Logic>(&self, q: &BankReg<L>, i: &PartIn<L>) -> BankNet<L> {
        BankNet {
            part: std::array::from_fn(|k| Instance::settle(&Part, &q.part[k], i.clone())),
        }
    }

    fn next<L: Logic>(&self, q: BankReg<L>, w: &BankNet<L>, _: &PartIn<L>) -> BankReg<L> {
        let mut nets = w.part.iter();
        BankReg {
            part: q.part.map(|q| match nets.next() {
                Some(part) => part.next(&Part, q),
                None => q,
            }),
        }
    }
}

signals! { struct StoreIn<L> { write: L::Bit, word: L::U<24> } }
signals! { struct StoreReg<L> { word: [L::Ram<12, 24>; 8] } }
signals! { struct StoreNet<L> { address: L::U<12> } }

/// Eight memories of 4,096 words.
struct Store;

impl Circuit for Store {
    const NAME: &'static str = "store";
    const ABOUT: &'static str = "eight memories";
    type In<L: Logic> = StoreIn<L>;
    type Reg<L: Logic> = StoreReg<L>;
    type Net<L: Logic> = StoreNet<L>;

    fn comb<L: Logic>(&self, _: &StoreReg<L>, i: &StoreIn<L>) -> StoreNet<L> {
        StoreNet {
            address: i.word.resize(),
        }
    }

    fn next<L: Logic>(&self, q: StoreReg<L>, w: &StoreNet<L>, i: &StoreIn<L>) -> StoreReg<L> {
        StoreReg {
            word: q.word.map(|ram| ram.write(i.write, w.address, i.word)),
        }
    }
}

fn run<C: Circuit>(
    circuit: &C,
    ticks: u64,
    i: impl Fn(u64) -> C::In<Sim>,
    observer: impl Observer<C>,
) {
    let run = Simulator::new(circuit)
        .unwrap()
        .run(ticks, |tick, _| i(tick), observer);
    divan::black_box(run.is_ok());
}

fn part_in(step: u64) -> impl Fn(u64) -> PartIn<Sim> {
    move |_| PartIn {
        step: step.into(),
        up: true.into(),
    }
}

fn store_in(write: bool) -> impl Fn(u64) -> StoreIn<Sim> {
    move |tick| StoreIn {
        write: write.into(),
        word: tick.into(),
    }
}

fn clock() -> Clock {
    Clock::from_hz(50_000_000).expect("a good rate")
}

fn vcd<C: Circuit, W: io::Write>(circuit: &C, out: W) -> Vcd<C, W> {
    Vcd::new(out, circuit, clock(), &Options::default()).expect("a good circuit")
}

fn vcd_behind<C: Circuit>(circuit: &C, out: File) -> VcdBehind<C, File> {
    VcdBehind::new(out, circuit, clock(), &Options::default()).expect("a good circuit and a thread")
}

fn fst<C: Circuit>(circuit: &C, out: File) -> Fst<C, File> {
    Fst::new(out, circuit, clock(), &Options::default()).expect("a good circuit and a good file")
}

fn file() -> File {
    tempfile::tempfile().expect("a file")
}

fn measure<C: Circuit + Sync>(
    bencher: divan::Bencher<'_, '_>,
    circuit: &C,
    i: impl Fn(u64) -> C::In<Sim> + Sync,
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
