//! Writing on a thread of its own.

use crate::zoo::{Zoo, inputs};
use crate::{SEED, clock, run_zoo};
use motion_rtl::kernel::{RunError, Simulator};
use motion_rtl::trace::{Options, Vcd, WriteBehind, atomic::AtomicFile};
use std::fs;
use std::io::{self, Write};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};

const TICKS: u64 = 5_000;

#[test]
fn a_thread_writes_the_same_bytes() {
    let (wanted, _) = run_zoo(TICKS, &Options::default());
    assert!(wanted.len() > 1 << 20, "several buffers");
    let out = WriteBehind::new(Vec::new()).unwrap();
    let mut vcd = Vcd::new(out, &Zoo, clock(), &Options::default()).unwrap();
    let mut inputs = inputs(SEED);
    Simulator::new(&Zoo)
        .run(TICKS, |_, _| inputs.next().unwrap(), &mut vcd)
        .unwrap();
    assert!(vcd.finish().unwrap().finish().unwrap() == wanted);
}

#[test]
fn pieces_of_any_length_come_through_in_their_order() {
    let mut out = WriteBehind::new(Vec::new()).unwrap();
    let mut wanted = Vec::new();
    for length in [1, 0, 300_000, 7, 1 << 20, 3] {
        let piece: Vec<u8> = (0..length).map(|k| (k % 251) as u8).collect();
        out.write_all(&piece).unwrap();
        wanted.extend(piece);
    }
    assert!(out.finish().unwrap() == wanted);
}

/// A disk that is full from the start.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_at_the_latest_at_the_end() {
    let full = || fs::File::options().write(true).open("/dev/full").unwrap();
    let mut short = WriteBehind::new(full()).unwrap();
    short.write_all(b"a").unwrap();
    assert_eq!(
        short.finish().unwrap_err().kind(),
        io::ErrorKind::StorageFull
    );

    let out = WriteBehind::new(full()).unwrap();
    let mut vcd = Vcd::new(out, &Zoo, clock(), &Options::default()).unwrap();
    let mut inputs = inputs(SEED);
    let run = Simulator::new(&Zoo).run(1_000_000, |_, _| inputs.next().unwrap(), &mut vcd);
    assert!(
        matches!(run, Err(RunError::Waves(error)) if error.kind() == io::ErrorKind::StorageFull)
    );
    assert!(vcd.finish().is_err());
}

/// A file on a disk that becomes full.
#[derive(Debug)]
struct Full(usize, AtomicFile);

impl Write for Full {
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

#[test]
fn a_disk_that_becomes_full_leaves_no_file() {
    let directory = tempfile::tempdir().unwrap();
    let file = AtomicFile::create(directory.path().join("a.vcd")).unwrap();
    let mut out = WriteBehind::new(Full(1_000_000, file)).unwrap();
    let error = (0..100).find_map(|_| out.write_all(&[b'a'; 100_000]).err());
    assert_eq!(error.unwrap().kind(), io::ErrorKind::StorageFull);
    out.finish().unwrap_err();
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
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
fn who_writes_waits_for_a_slow_file() {
    let slow = Slow {
        open: Arc::default(),
        taken: Arc::default(),
    };
    let (gate, taken) = (slow.open.clone(), slow.taken.clone());
    let given = Arc::new(AtomicUsize::new(0));
    let mut out = WriteBehind::new(slow).unwrap();
    let writer = std::thread::spawn({
        let given = given.clone();
        move || {
            for _ in 0..100 {
                out.write_all(&[0; 64 * 1024]).unwrap();
                given.fetch_add(64 * 1024, Ordering::SeqCst);
            }
            out.finish().map(drop)
        }
    });
    // It gets as far as the buffers reach, and no further.
    while given.load(Ordering::SeqCst) < 512 * 1024 {
        std::thread::yield_now();
    }
    std::thread::sleep(std::time::Duration::from_millis(50));
    assert_eq!(taken.load(Ordering::SeqCst), 0);
    assert!(given.load(Ordering::SeqCst) <= 768 * 1024);
    *gate.0.lock().unwrap() = true;
    gate.1.notify_all();
    writer.join().unwrap().unwrap();
    assert_eq!(taken.load(Ordering::SeqCst), 100 * 64 * 1024);
}

#[test]
fn dropped_it_leaves_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let file = AtomicFile::create(directory.path().join("a.vcd")).unwrap();
    let mut out = WriteBehind::new(file).unwrap();
    out.write_all(&[b'a'; 1_000_000]).unwrap();
    drop(out);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
}
