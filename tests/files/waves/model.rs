//! Waves of a running model, switched on and off.

use super::zoo::{In, Zoo, inputs};
use super::{SEED, clock, options};
use motion_rtl::Model;
use motion_rtl::compare::{Settings, compare};
use motion_rtl::hdl::Value;
use motion_rtl::sim::{ModelError, Observer, Simulator};
use motion_rtl::trace::{Clock, Options, Vcd, gtkw};
use std::fs;
use std::path::{Path, PathBuf};

const TICKS: u64 = 2000;
const ON: u64 = 1000;
const OFF: u64 = 1500;

/// Steps a model with the inputs of a simulator.
struct Run {
    simulator: Simulator<Zoo>,
    model: Model,
}

impl Run {
    fn new() -> Self {
        Run {
            simulator: Simulator::new(&Zoo).unwrap(),
            model: Model::of(&Zoo).unwrap(),
        }
    }

    /// Runs up to a tick; the observer sees the simulator.
    fn to(
        &mut self,
        tick: u64,
        inputs: &mut impl Iterator<Item = In<Value>>,
        mut observer: impl Observer<Zoo>,
    ) {
        while self.model.tick() < tick {
            let i = inputs.next().unwrap();
            let ((), flow) = self.simulator.look(&i, &mut observer, |_| ()).unwrap();
            assert!(flow.is_continue());
            for port in 0..self.simulator.engine().ports() {
                let word = self.simulator.engine().port(port).unwrap();
                self.model
                    .set_bits(self.model.at(port).unwrap(), word)
                    .unwrap();
            }
            self.simulator.step();
            self.model.step();
        }
    }

    fn same_registers(&mut self) {
        for signal in self.model.signals() {
            let leaf = signal.handle.index();
            let golden = self.simulator.now(|now| now.engine().leaf(leaf).unwrap());
            let seen = self.model.get(signal.handle).unwrap();
            assert_eq!(seen, golden, "{}", signal.path);
        }
    }
}

/// Waves of ticks 1000 to 1499 by a model, and those of the whole run by an observer.
fn both(directory: &Path, name: &str, options: &Options) -> (Vec<PathBuf>, PathBuf) {
    let mut inputs = inputs(SEED);
    let mut run = Run::new();
    let mut whole = Vcd::new(Vec::new(), &Zoo, clock(), &Options::default()).unwrap();
    run.to(ON, &mut inputs, &mut whole);
    let path = directory.join(name);
    run.model.waves_with(&path, clock(), options).unwrap();
    run.to(OFF, &mut inputs, &mut whole);
    let files = run.model.finish_waves().unwrap();
    run.same_registers();
    run.to(TICKS, &mut inputs, &mut whole);
    run.same_registers();
    let path = directory.join("whole.vcd");
    fs::write(&path, whole.finish().unwrap()).unwrap();
    (files, path)
}

/// The waves of a simulator in these ticks.
fn slice(options: &Options) -> Vec<u8> {
    let mut vcd = Vcd::new(Vec::new(), &Zoo, clock(), options).unwrap();
    let mut inputs = inputs(SEED);
    Simulator::new(&Zoo)
        .unwrap()
        .run(TICKS, |_, _| inputs.next().unwrap(), &mut vcd)
        .unwrap();
    vcd.finish().unwrap()
}

#[test]
fn a_window_is_the_slice_of_the_whole_dump() {
    let directory = tempfile::tempdir().unwrap();
    let (files, whole) = both(directory.path(), "window.vcd", &Options::default());
    let names = ["window.vcd", "window.gtkw"].map(|name| directory.path().join(name));
    assert_eq!(files, names);
    let window = options(ON..OFF, &[]);
    assert!(fs::read(&files[0]).unwrap() == slice(&window), "other text");
    let save = gtkw::save_file(&Zoo, clock(), &window, "window.vcd", ON..ON + 40).unwrap();
    assert_eq!(fs::read_to_string(&files[1]).unwrap(), save);

    let report = compare(&whole, &files[0], &Settings::default()).unwrap();
    assert!(report.is_equal(), "{report}");
    assert_eq!((report.ticks, report.other.first_tick), (OFF - ON, ON));
}

#[test]
fn an_fst_is_the_vcd() {
    let directory = tempfile::tempdir().unwrap();
    let (files, whole) = both(directory.path(), "window.fst", &Options::default());
    let report = compare(&whole, &files[0], &Settings::default()).unwrap();
    assert!(report.is_equal(), "{report}");
    assert_eq!((report.ticks, report.other.first_tick), (OFF - ON, ON));
}

#[test]
fn signals_and_ticks_are_selected() {
    let directory = tempfile::tempdir().unwrap();
    let only = options(1100..1200, &["zoo.store", "zoo.count"]);
    let (files, _) = both(directory.path(), "part.vcd", &only);
    assert!(fs::read(&files[0]).unwrap() == slice(&only), "other text");
    let save = gtkw::save_file(&Zoo, clock(), &only, "part.vcd", 1100..1140).unwrap();
    assert_eq!(fs::read_to_string(&files[1]).unwrap(), save);
}

/// Runs, jumps, arrays and resets leave no tick out.
#[test]
fn every_way_to_advance_is_in_the_waves() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    let waves = |name: &str, advance: &dyn Fn(&mut Model)| -> Vec<u8> {
        let mut model = Model::of(&Zoo).unwrap();
        model.waves_to(path(name)).unwrap();
        model.reset();
        advance(&mut model);
        model.reset();
        assert_eq!(model.tick(), 102);
        let files = model.finish_waves().unwrap();
        fs::read(&files[0]).unwrap()
    };
    let stepped = waves("step.vcd", &|model| (0..100).for_each(|_| model.step()));
    let mut golden = Vcd::new(Vec::new(), &Zoo, Clock::default(), &Options::default()).unwrap();
    let mut simulator = Simulator::new(&Zoo).unwrap();
    for tick in 0..102 {
        let flow = simulator.now(|now| golden.sample(now)).unwrap();
        assert!(flow.is_continue());
        match tick {
            0 | 101 => simulator.reset(),
            _ => simulator.step(),
        }
    }
    assert!(golden.finish().unwrap() == stepped);
    assert!(waves("run.vcd", &|model| model.run(100)) == stepped);
    assert!(waves("forward.vcd", &|model| model.fast_forward(100)) == stepped);
    let played = |model: &mut Model| drop(model.play(100, &[], &[]).unwrap());
    assert!(waves("play.vcd", &played) == stepped);
    let replayed = |model: &mut Model| model.fast_replay(100, &[], &[], |_| {}).unwrap();
    assert!(waves("replay.vcd", &replayed) == stepped);
}

#[test]
fn refusals_leave_no_file() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    let mut model = Model::of(&Zoo).unwrap();
    assert!(model.finish_waves().unwrap().is_empty());
    let then = model.snapshot();

    for name in ["zoo", "zoo.txt", "new/zoo.VCD"] {
        let error = model.waves_to(path(name)).unwrap_err().to_string();
        let wanted = format!("{name}: the extension names no format; allowed: .vcd, .fst");
        assert!(
            error.starts_with("the waves could not be written: "),
            "{error}"
        );
        assert!(error.ends_with(&wanted), "{error}");
    }
    let nothing = options(0..10, &["zoo.nothing"]);
    let error = model.waves_with(path("new/zoo.vcd"), Clock::default(), &nothing);
    let error = error.unwrap_err().to_string();
    assert!(
        error.contains("no scope or signal is called zoo.nothing"),
        "{error}"
    );

    model.waves_to(path("new/zoo.vcd")).unwrap();
    let again = model.waves_to(path("other.vcd")).unwrap_err();
    assert!(matches!(again, ModelError::WavesOn { .. }), "{again}");
    let back = model.restore(&then).unwrap_err();
    assert_eq!(
        back.to_string(),
        "a snapshot cannot be restored while waves are written; finish_waves() ends them"
    );
    // A copy has no waves, and a model that is dropped leaves none.
    let mut copy = model.clone();
    copy.run(10);
    assert!(copy.finish_waves().unwrap().is_empty());
    copy.restore(&then).unwrap();
    drop(model);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
}

/// An error of the file ends the waves, not the run.
#[test]
fn a_failed_file_is_said_at_the_end() {
    let directory = tempfile::tempdir().unwrap();
    let mut model = Model::of(&Zoo).unwrap();
    model.waves_to(directory.path().join("zoo.vcd")).unwrap();
    model.run(10);
    fs::create_dir(directory.path().join("zoo.gtkw")).unwrap();
    let error = model.finish_waves().unwrap_err().to_string();
    assert!(
        error.starts_with("the waves could not be written: "),
        "{error}"
    );
    assert!(error.contains("zoo.gtkw"), "{error}");
    assert!(!directory.path().join("zoo.vcd").exists());
    model.run(10);
    assert_eq!(model.tick(), 20);
}
