//! Readers under what is nearly right: the inputs of `fuzz/corpus` with random changes.

mod readers;

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::{Config, TestRunner};
use readers::{READERS, Reader};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::mpsc::channel;
use std::thread;
use std::time::{Duration, Instant};

/// Seconds for each reader, unless `FUZZ_SECONDS` says otherwise.
const SECONDS: u64 = 10;

/// Address space of all readers, in KiB.
const MEMORY: u64 = 512 * 1024;

/// Set where that is the limit.
const LIMITED: &str = "FUZZ_LIMITED";

/// Beyond it an input takes too long.
const LONGEST: Duration = Duration::from_secs(20);

/// Words that a reader of numbers, paths or commands may not expect.
const WORDS: [&[u8]; 16] = [
    b"0",
    b"-1",
    b"1e999",
    b"nan",
    b"18446744073709551616",
    b"\xff",
    b"\0",
    b"\r\n",
    b"\"",
    b"$end",
    b"[",
    b"]",
    b"#",
    b";",
    b"(",
    b"\xef\xbb\xbf",
];

/// A change of an input.
#[derive(Debug, Clone)]
enum Change {
    Flip(Index, u8),
    Insert(Index, Vec<u8>),
    Word(Index, usize),
    Remove(Index, usize),
    /// Some bytes again, elsewhere.
    Repeat(Index, Index, usize),
    Cut(Index),
}

impl Change {
    fn apply(&self, bytes: &mut Vec<u8>) {
        let at = |index: &Index, bytes: &[u8]| index.index(bytes.len() + 1);
        match self {
            Change::Flip(index, mask) => {
                let place = at(index, bytes);
                if let Some(byte) = bytes.get_mut(place) {
                    *byte ^= mask;
                }
            }
            Change::Insert(index, more) => {
                let place = at(index, bytes);
                bytes.splice(place..place, more.iter().copied());
            }
            Change::Word(index, word) => {
                let place = at(index, bytes);
                bytes.splice(place..place, WORDS[*word].iter().copied());
            }
            Change::Remove(index, length) => {
                let place = at(index, bytes);
                let end = (place + length).min(bytes.len());
                bytes.drain(place..end);
            }
            Change::Repeat(from, to, length) => {
                let (from, to) = (at(from, bytes), at(to, bytes));
                let more = bytes[from..(from + length).min(bytes.len())].to_vec();
                bytes.splice(to..to, more);
            }
            Change::Cut(index) => bytes.truncate(at(index, bytes)),
        }
    }
}

fn change() -> impl Strategy<Value = Change> {
    let index = any::<Index>;
    prop_oneof![
        4 => (index(), 1..=255u8).prop_map(|(at, mask)| Change::Flip(at, mask)),
        2 => (index(), vec(any::<u8>(), 1..9)).prop_map(|(at, more)| Change::Insert(at, more)),
        4 => (index(), 0..WORDS.len()).prop_map(|(at, word)| Change::Word(at, word)),
        2 => (index(), 1..17usize).prop_map(|(at, length)| Change::Remove(at, length)),
        2 => (index(), index(), 1..65usize)
            .prop_map(|(from, to, length)| Change::Repeat(from, to, length)),
        1 => index().prop_map(Change::Cut),
    ]
}

fn fuzz_directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz")
}

fn corpus(name: &str) -> Vec<Vec<u8>> {
    let directory = fuzz_directory().join("corpus").join(name);
    let read = fs::read_dir(&directory).unwrap_or_else(|error| panic!("{directory:?}: {error}"));
    let mut paths: Vec<_> = read.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert!(!paths.is_empty(), "{directory:?}: empty");
    paths
        .into_iter()
        .map(|path| fs::read(path).unwrap())
        .collect()
}

/// Gives a reader changed inputs until the time is over; returns how many.
fn play(seeds: Vec<Vec<u8>>, reader: Reader, time: Duration) -> Result<u64, String> {
    let inputs = (any::<Index>(), vec(change(), 1..9)).prop_map(move |(seed, changes)| {
        let mut bytes = seeds[seed.index(seeds.len())].clone();
        for change in &changes {
            change.apply(&mut bytes);
        }
        bytes
    });
    let config = Config {
        cases: 200,
        failure_persistence: None,
        ..Config::default()
    };
    let (begun, mut played) = (Instant::now(), 0);
    while begun.elapsed() < time {
        let mut runner = TestRunner::new(config.clone());
        let done = runner.run(&inputs, |bytes| {
            let begun = Instant::now();
            reader(&bytes);
            prop_assert!(begun.elapsed() < LONGEST, "it takes {:?}", begun.elapsed());
            Ok(())
        });
        done.map_err(|failed| failed.to_string())?;
        played += u64::from(config.cases);
    }
    Ok(played)
}

/// The test of this name in a process of its own, with less memory than an input may ask for.
fn limited(test: &str) {
    let script = format!("ulimit -c 0; ulimit -v {MEMORY}; exec \"$0\" \"$@\"");
    let status = Command::new("sh")
        .args(["-c", &script])
        .arg(std::env::current_exe().unwrap())
        .args([test, "--exact", "--ignored", "--nocapture"])
        .env(LIMITED, "1")
        .status()
        .unwrap();
    assert!(status.success(), "{status} under {MEMORY} KiB");
}

#[test]
#[ignore = "takes a minute"]
fn readers_refuse_or_take_whatever_is_nearly_right() {
    if cfg!(target_os = "linux") && std::env::var_os(LIMITED).is_none() {
        return limited("fuzz::readers_refuse_or_take_whatever_is_nearly_right");
    }
    let seconds = std::env::var("FUZZ_SECONDS").map_or(SECONDS, |text| text.parse().unwrap());
    let time = Duration::from_secs(seconds);
    for pair in READERS.chunks(2) {
        let (done, wait) = channel();
        for &(name, reader) in pair {
            let (seeds, done) = (corpus(name), done.clone());
            for seed in &seeds {
                reader(seed);
            }
            thread::spawn(move || done.send((name, play(seeds, reader, time))));
        }
        for _ in pair {
            let played = wait.recv_timeout(time + 3 * LONGEST);
            let (name, played) = played.unwrap_or_else(|_| panic!("one of {pair:?} never ends"));
            let played = played.unwrap_or_else(|failed| panic!("{name}: {failed}"));
            println!("{name}: {played} inputs");
            assert!(played > 0, "{name}");
        }
    }
}

/// In a checkout: the package is without `fuzz`.
#[test]
fn every_reader_is_a_target_with_a_corpus() {
    let directory = fuzz_directory();
    if !directory.exists() {
        return;
    }
    let manifest = fs::read_to_string(directory.join("Cargo.toml")).unwrap();
    let manifest: toml::Table = manifest.parse().unwrap();
    let bins = manifest["bin"].as_array().unwrap();
    let bins: BTreeSet<_> = bins
        .iter()
        .map(|bin| bin["name"].as_str().unwrap())
        .collect();
    let readers: BTreeSet<_> = READERS.iter().map(|(name, _)| *name).collect();
    assert_eq!(bins, readers);
    for (name, reader) in READERS {
        let target = directory.join(format!("fuzz_targets/{name}.rs"));
        let text = fs::read_to_string(target).unwrap();
        assert!(
            text.contains(&format!("readers::{name}(")),
            "{name}: {text}"
        );
        for seed in corpus(name) {
            reader(&seed);
        }
    }
}
