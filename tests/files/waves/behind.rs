//! A dump that a thread of its own formats and writes.

use super::zoo::{Zoo, inputs};
use super::{SEED, clock, dump, run_zoo};
use motion_rtl::files::AtomicFile;
use motion_rtl::prelude::*;
use motion_rtl::sim::{RunError, State};
use motion_rtl::trace::{Options, VcdBehind};
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};

/// Ticks of several sections of the zoo.
const TICKS: u64 = 20_000;

fn behind<W: Write + Send + 'static>(out: W) -> VcdBehind<W> {
    VcdBehind::new(out, &Zoo, clock(), &Options::default()).unwrap()
}

fn run<W: Write + Send + 'static>(ticks: u64, vcd: &mut VcdBehind<W>) -> Result<(), RunError> {
    let mut inputs = inputs(SEED);
    Simulator::new(&Zoo)?.run(ticks, |_, _| inputs.next().unwrap(), vcd)
}

#[test]
fn a_thread_writes_the_same_bytes() {
    for ticks in [0, 1, 100, TICKS] {
        let (wanted, _) = run_zoo(ticks, &Options::default());
        let mut vcd = behind(Vec::new());
        run(ticks, &mut vcd).unwrap();
        assert!(vcd.finish().unwrap() == wanted, "{ticks} ticks");
    }
}

/// Two memories, whose words are more than the changes of a section.
#[derive(Debug, Clone)]
struct Wide;

signals! { for Wide as _c;
    struct WideIn { address: U(15), word: U(8) }
    struct WideReg { first: Ram(15, 8), second: Ram(15, 8) }
    struct WideNet { read: U(8) }
}

impl Circuit for Wide {
    const NAME: &'static str = "wide";
    const ABOUT: &'static str = "has many words";
    records!(WideIn, WideReg, WideNet);

    fn tick(&self, i: WideIn, q: WideReg, _: Nothing) -> (WideNet, WideReg<Edge>) {
        let read = q.first.read(i.address);
        let next = WideReg {
            first: q.first.write(Bit::high(), i.address, i.word),
            second: q.second.write(Bit::high(), i.address, read),
        };
        (WideNet { read }, next)
    }
}

#[test]
fn a_tick_with_more_changes_than_a_section() {
    let i = || WideIn {
        address: 5,
        word: 7,
    };
    let wanted = dump(&Wide, 3, clock(), i).unwrap();
    let mut vcd = VcdBehind::new(Vec::new(), &Wide, clock(), &Options::default()).unwrap();
    Simulator::new(&Wide)
        .unwrap()
        .run(3, |_, _| i(), &mut vcd)
        .unwrap();
    assert!(vcd.finish().unwrap() == wanted);
}

/// A file on a disk that becomes full.
#[derive(Debug)]
struct Full<W>(usize, W);

impl<W: Write> Write for Full<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self
            .0
            .checked_sub(bytes.len())
            .ok_or(io::ErrorKind::StorageFull)?;
        self.1.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.1.flush()
    }
}

fn assert_full(run: Result<(), RunError>) {
    assert!(
        matches!(run, Err(RunError::Waves(error)) if error.kind() == io::ErrorKind::StorageFull)
    );
}

#[test]
fn a_full_disk_is_an_error_at_the_latest_at_the_end() {
    let mut short = behind(Full(0, io::sink()));
    run(1, &mut short).unwrap();
    assert_eq!(
        short.finish().map(drop).unwrap_err().kind(),
        io::ErrorKind::StorageFull
    );

    let mut long = behind(Full(0, io::sink()));
    assert_full(run(1_000_000, &mut long));
    assert!(long.finish().is_err());
}

fn files(directory: &Path) -> usize {
    fs::read_dir(directory).unwrap().count()
}

#[test]
fn a_disk_that_becomes_full_leaves_no_file() {
    let directory = tempfile::tempdir().unwrap();
    let file = AtomicFile::create(directory.path().join("a.vcd")).unwrap();
    let mut vcd = behind(Full(1_000_000, file));
    assert_full(run(1_000_000, &mut vcd));
    vcd.finish().unwrap_err();
    assert_eq!(files(directory.path()), 0);
}

/// Counts what it is given, and waits to be told before it takes the first of it.
struct Slow {
    open: Arc<(Mutex<bool>, Condvar)>,
    taken: Arc<AtomicUsize>,
}

impl Write for Slow {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let (open, told) = &*self.open;
        drop(
            told.wait_while(open.lock().unwrap(), |open| !*open)
                .unwrap(),
        );
        self.taken.fetch_add(bytes.len(), Ordering::SeqCst);
        Ok(bytes.len())
    }
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A file that is slower than the run holds the run up: memory is bounded.
#[test]
fn the_run_waits_for_a_slow_file() {
    const LONG: u64 = 100_000;
    let slow = Slow {
        open: Arc::default(),
        taken: Arc::default(),
    };
    let (gate, taken) = (slow.open.clone(), slow.taken.clone());
    let ticks = Arc::new(AtomicU64::new(0));
    let mut vcd = behind(slow);
    let runs = std::thread::spawn({
        let ticks = ticks.clone();
        move || {
            let mut inputs = inputs(SEED);
            let i = |tick, _: &State<'_, Zoo>| {
                ticks.store(tick, Ordering::SeqCst);
                inputs.next().unwrap()
            };
            Simulator::new(&Zoo)
                .unwrap()
                .run(LONG, i, &mut vcd)
                .unwrap();
            vcd.finish().map(drop)
        }
    });
    // The run gets as far as the sections reach, and no further.
    let bytes = |ticks: u64| run_zoo(ticks, &Options::default()).0.len();
    while ticks.load(Ordering::SeqCst) < 1_000 {
        std::thread::yield_now();
    }
    std::thread::sleep(std::time::Duration::from_millis(200));
    assert_eq!(taken.load(Ordering::SeqCst), 0);
    let reached = ticks.load(Ordering::SeqCst);
    assert!(bytes(reached) <= 2 << 20, "{reached} ticks");
    *gate.0.lock().unwrap() = true;
    gate.1.notify_all();
    runs.join().unwrap().unwrap();
    assert_eq!(taken.load(Ordering::SeqCst), bytes(LONG));
}

#[test]
fn dropped_it_leaves_nothing() {
    for ticks in [0, 10, TICKS] {
        let directory = tempfile::tempdir().unwrap();
        let file = AtomicFile::create(directory.path().join("a.vcd")).unwrap();
        let mut vcd = behind(file);
        run(ticks, &mut vcd).unwrap();
        drop(vcd);
        assert_eq!(files(directory.path()), 0);
    }
}
