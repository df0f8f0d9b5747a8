//! A test that fails leaves the waves of its last ticks.

use super::zoo::{Zoo, inputs};
use super::{SEED, clock, options};
use motion_rtl::circuits::blocks::EnableCounter;
use motion_rtl::sim::Simulator;
use motion_rtl::trace::{Clock, LastTicks, Options, Vcd, gtkw};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Runs a test that fails in a thread of its name; returns the names of the files that it leaves.
fn fails(directory: &Path, name: &str, test: impl FnOnce() + Send + 'static) -> Vec<String> {
    let thread = std::thread::Builder::new().name(name.to_owned());
    let ended = thread.spawn(test).unwrap().join();
    assert!(ended.is_err(), "{name} does not fail");
    left(directory)
}

fn left(directory: &Path) -> Vec<String> {
    let files = fs::read_dir(directory).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> = names.collect();
    names.sort();
    names
}

fn keeping(directory: &Path, ticks: usize) -> LastTicks {
    let last = LastTicks::new(&Zoo, ticks).unwrap();
    last.with_clock(clock()).with_directory(directory)
}

/// Steps to a tick, resets in some, and fails in it.
fn fail_at(tick: u64, last: LastTicks) {
    let mut simulator = Simulator::new(&Zoo).unwrap();
    last.keep(&mut simulator);
    for (now, i) in (0..).zip(inputs(SEED)) {
        simulator.apply(&i).unwrap();
        assert_ne!(simulator.tick(), tick);
        match now % 50 {
            7 => simulator.reset(),
            _ => simulator.step(),
        }
    }
}

/// The waves of these ticks of that run.
fn window(ticks: std::ops::Range<u64>) -> String {
    let mut vcd = Vcd::new(Vec::new(), &Zoo, clock(), &options(ticks.clone(), &[])).unwrap();
    let mut simulator = Simulator::new(&Zoo).unwrap();
    for (now, i) in (0..ticks.end).zip(inputs(SEED)) {
        let (_, _) = simulator.look(&i, &mut vcd, |_| ()).unwrap();
        match now % 50 {
            7 => simulator.reset(),
            _ => simulator.step(),
        }
    }
    String::from_utf8(vcd.finish().unwrap()).unwrap()
}

#[test]
fn the_last_ticks_are_those_of_the_whole_run() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let last = keeping(path, LastTicks::TICKS);
    let names = fails(path, "clocks::drift", move || fail_at(300, last));
    assert_eq!(names, ["clocks.drift.gtkw", "clocks.drift.vcd"]);
    let waves = fs::read_to_string(path.join("clocks.drift.vcd")).unwrap();
    assert_eq!(waves, window(101..301));
    // Two units of time a tick.
    let times: Vec<_> = waves.lines().filter(|line| line.starts_with('#')).collect();
    assert_eq!([times[0], times[times.len() - 1]], ["#202", "#602"]);
    assert_eq!(times.len(), 401);
    let save = fs::read_to_string(path.join("clocks.drift.gtkw")).unwrap();
    let dump = "clocks.drift.vcd";
    let expected = gtkw::save_file(&Zoo, clock(), &Options::default(), dump, 261..301).unwrap();
    assert_eq!(save, expected);
}

#[test]
fn a_short_run_has_fewer_ticks() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("waves/of it");
    for (last, ticks) in [(1, 3..4), (2, 2..4), (4, 0..4), (50, 0..4)] {
        let keeping = keeping(&path, last);
        fails(&path, "short", move || fail_at(3, keeping));
        let waves = fs::read_to_string(path.join("short.vcd")).unwrap();
        assert_eq!(waves, window(ticks), "{last}");
    }
}

#[test]
fn every_tick_of_a_run_is_kept_however_it_goes_on() {
    let circuit = EnableCounter { width: 16 };
    let mut vcd = Vcd::new(
        Vec::new(),
        &circuit,
        Clock::default(),
        &options(251..301, &[]),
    )
    .unwrap();
    let mut whole = Simulator::new(&circuit).unwrap();
    whole.set(|i| i.period, 90).unwrap();
    for _ in 0..301 {
        let ((), _) = whole.look_as_set(&mut vcd, |_| ()).unwrap();
        whole.step();
    }
    let whole = String::from_utf8(vcd.finish().unwrap()).unwrap();
    type Run = fn(&mut Simulator<EnableCounter>);
    let runs: [Run; 5] = [
        |counter| counter.fast_forward(300, |_| Ok(300), ()).unwrap(),
        |counter| counter.samples(|_| ()).take(300).for_each(|()| ()),
        |counter| {
            let mut left = 300;
            while left > 0 {
                left -= counter.go_on(left);
            }
        },
        |counter| counter.run_changes(300, |_| Ok(300), ()).unwrap(),
        |counter| {
            let i = motion_rtl::circuits::blocks::enable_counter::In { period: 90 };
            counter.run(300, |_, _| i.clone(), ()).unwrap();
        },
    ];
    for (index, run) in runs.into_iter().enumerate() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().to_owned();
        let last = LastTicks::new(&circuit, 50).unwrap().with_directory(&path);
        let circuit = circuit.clone();
        let names = fails(&path, "runs", move || {
            // Only the enable is watched.
            let chosen = Simulator::watching(&circuit, false, |watch| watch.at(watch.w.enable));
            let (mut counter, _) = chosen.unwrap();
            last.keep(&mut counter);
            counter.set(|i| i.period, 90).unwrap();
            run(&mut counter);
            panic!("in tick {}", counter.tick());
        });
        assert_eq!(names, ["runs.gtkw", "runs.vcd"]);
        let waves = fs::read_to_string(path.join("runs.vcd")).unwrap();
        assert_eq!(waves, whole, "{index}");
    }
}

#[test]
fn each_simulator_of_a_test_has_files_of_its_own() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().to_owned();
    let at = path.clone();
    let names = fails(&path, "two of/them", move || {
        let both = || {
            let lasts = [10, 20].map(|ticks| keeping(&at, ticks));
            let simulators = lasts.map(|last| {
                let mut simulator = Simulator::new(&Zoo).unwrap();
                last.keep(&mut simulator);
                simulator.samples(|_| ()).nth(30);
                simulator
            });
            panic!("{}", simulators.len());
        };
        // The second time, as a shrinking test runs, nothing is added.
        assert!(std::panic::catch_unwind(both).is_err());
        both();
    });
    let expected = ["gtkw", "vcd"].map(|end| format!("two_of_them.{end}"));
    let second = ["gtkw", "vcd"].map(|end| format!("two_of_them-2.{end}"));
    assert_eq!(names, [second, expected].concat());
}

#[test]
fn what_passes_or_is_not_looked_at_leaves_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().to_owned();
    let mut simulator = Simulator::new(&Zoo).unwrap();
    keeping(&path, 10).keep(&mut simulator);
    simulator.samples(|_| ()).nth(30);
    // A copy keeps nothing.
    let copy = simulator.clone();
    drop(simulator);
    let at = path.clone();
    let names = fails(&path, "copy", move || {
        let _copy = copy;
        let _unused = keeping(&at, 10);
        panic!("before the first tick");
    });
    assert_eq!(names, [""; 0]);
}

#[test]
fn a_directory_that_cannot_be_made_hides_no_failure() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("file");
    fs::write(&file, "").unwrap();
    let last = keeping(&file.join("below"), 10);
    let names = fails(directory.path(), "nowhere", move || fail_at(3, last));
    assert_eq!(names, ["file"]);
}

/// Fails only where [`the_files_are_named_where_a_test_fails`] runs it.
#[test]
fn fails_on_purpose() {
    let mut simulator = LastTicks::simulator(&Zoo).unwrap();
    simulator.samples(|_| ()).nth(30);
    assert!(std::env::var_os("FAIL_ON_PURPOSE").is_none());
}

#[test]
fn the_files_are_named_where_a_test_fails() {
    let program = std::env::current_exe().unwrap();
    let name = "waves::last_ticks::fails_on_purpose";
    let mut test = Command::new(&program);
    test.args([name, "--exact", "--test-threads=2"]);
    let output = test.env("FAIL_ON_PURPOSE", "1").output().unwrap();
    assert!(!output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let waves = "waves of ticks 0 to 31: ";
    let named = text.lines().find_map(|line| line.strip_prefix(waves));
    let waves = Path::new(named.unwrap_or_else(|| panic!("{text}")));
    assert!(waves.ends_with("failed/waves.last_ticks.fails_on_purpose.vcd"));
    let target = waves.ancestors().nth(2).unwrap();
    assert!(program.starts_with(target));
    let save = waves.with_extension("gtkw");
    assert!(text.contains(&format!("open them with: gtkwave {}", save.display())));
    assert!(fs::read_to_string(waves).unwrap().ends_with("#320\n"));
    fs::remove_file(waves).unwrap();
    fs::remove_file(save).unwrap();
}
