use super::reader::{self, Variable};
use super::zoo::{PHASES, Part, PartIn, Zoo, inputs};
use super::{SEED, clock, dump, options, run_zoo};
use motion_rtl::check::Random;
use motion_rtl::circuits::pulse_interpolator::{Group, Variant, Widths};
use motion_rtl::files::AtomicFile;
use motion_rtl::hdl::{Circuit, Declarations, Value};
use motion_rtl::netlist::{Format, Role};
use motion_rtl::sim::{Observer, RunError, Simulator};
use motion_rtl::trace::{Clock, Options, Recorder, Vcd};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs;
use std::io::{self, Write};
use wellen::VarType;

const TICKS: u64 = 700;

#[test]
fn every_leaf_is_in_the_dump_with_every_value() {
    let (bytes, recorder) = run_zoo(TICKS, &Options::default());
    complete(&Zoo, &bytes, &recorder);
}

#[test]
fn the_pulse_interpolator_is_dumped_completely() {
    let widths = Widths {
        half_period: 4,
        period: 4,
        address: 2,
    };
    let group = Group::new(2, widths, Variant::Safe, 5);
    let mut vcd = Vcd::new(Vec::new(), &group, clock(), &Options::default()).unwrap();
    let mut recorder = Recorder::new(&group, &Options::default()).unwrap();
    let mut random = Random::new(SEED);
    Simulator::new(&group)
        .unwrap()
        .run(
            TICKS,
            |_, _| random.inputs(&group),
            (&mut vcd, &mut recorder),
        )
        .unwrap();
    complete(&group, &vcd.finish().unwrap(), &recorder);
    let run = recorder
        .column("pulse_interpolator.sequencer.state")
        .unwrap();
    assert!(
        run.contains(&0) && run.contains(&1),
        "the stimulus starts no pattern"
    );
}

/// Holds the variables and all values of a dump against the walk and a recording.
fn complete<C: Circuit>(circuit: &C, bytes: &[u8], recorder: &Recorder) {
    let dump = reader::read(bytes);
    let mut expected = BTreeSet::from([format!("{}.clk", C::NAME)]);
    let leaves = Declarations::of(circuit).leaves;
    assert_eq!(leaves.len(), recorder.leaves().len());
    for leaf in &leaves {
        let path = leaf.path();
        let variable = &dump.variables[&path];
        let width = leaf.shape.width;
        let register = leaf.role == Role::Register;
        let kind = if register {
            VarType::Reg
        } else {
            VarType::Wire
        };
        assert_eq!(variable.kind, kind, "{path}");
        assert_eq!(variable.width, Some(width as u32), "{path}");
        let range = (width > 1).then_some((width as i64 - 1, 0));
        assert_eq!(variable.range, range, "{path}");
        for tick in 0..TICKS {
            let bits = Some(recorder.at(tick, &path).unwrap());
            for time in [2 * tick, 2 * tick + 1] {
                assert_eq!(variable.number_at(time), bits, "{path} at tick {tick}");
            }
        }
        expected.insert(path.clone());
        if let Format::States(names) = leaf.field.format {
            let name = format!("{path}_name");
            let companion = &dump.variables[&name];
            assert_eq!(companion.kind, VarType::String, "{name}");
            for tick in 0..TICKS {
                let state = recorder.at(tick, &path).unwrap();
                let shown = names
                    .get(state as usize)
                    .map_or(state.to_string(), |&name| name.into());
                assert_eq!(
                    companion.at(2 * tick),
                    Some(&*shown),
                    "{name} at tick {tick}"
                );
            }
            expected.insert(name);
        }
    }
    assert_eq!(
        dump.variables.into_keys().collect::<BTreeSet<_>>(),
        expected
    );
}

/// The stimulus is worth something only if it brings every signal to change.
#[test]
fn the_stimulus_moves_every_kind_of_leaf() {
    let (_, recorder) = run_zoo(TICKS, &Options::default());
    for (index, leaf) in recorder.leaves().iter().enumerate() {
        let column = recorder.column_at(index);
        let still = column.iter().all(|bits| *bits == column[0]);
        assert!(
            !still || leaf.path().contains("great"),
            "{} holds still",
            leaf.path()
        );
    }
    let phases = recorder.column("zoo.left.phase").unwrap();
    assert!((0..=PHASES.len() as u64).all(|phase| phases.contains(&phase)));
}

#[test]
fn clk_rises_with_the_tick_and_falls_half_a_period_later() {
    let (bytes, _) = run_zoo(5, &Options::default());
    let dump = reader::read(&bytes);
    let edges: Vec<_> = (0..10u64)
        .map(|time| (time, if time % 2 == 0 { "1" } else { "0" }.to_owned()))
        .collect();
    assert_eq!(dump.variables["zoo.clk"].changes, edges);
    assert_eq!(dump.timescale, "10 NanoSeconds");
    assert_eq!(
        dump.times.last(),
        Some(&10),
        "the last tick has its full length"
    );
}

/// Inputs with which a part goes up.
fn up() -> PartIn<Value> {
    PartIn { step: 1, up: true }
}

#[test]
fn timescales_of_all_rates() {
    let cases = [
        (1, "100 MilliSeconds", 10),
        (1_000, "100 MicroSeconds", 10),
        (3_000_000, "1 FemtoSeconds", 333_333_334),
        (50_000_000, "10 NanoSeconds", 2),
        (1_000_000_000, "100 PicoSeconds", 10),
        (33_333_333, "1 FemtoSeconds", 30_000_000),
    ];
    for (hz, unit, period) in cases {
        let bytes = dump(&Part, 3, Clock::from_hz(hz).unwrap(), up).unwrap();
        let dump = reader::read(&bytes);
        assert_eq!(dump.timescale, unit, "{hz} Hz");
        let times = [
            0,
            period / 2,
            period,
            period + period / 2,
            2 * period,
            2 * period + period / 2,
            3 * period,
        ];
        assert_eq!(dump.times, times, "{hz} Hz");
    }
    let rounded = dump(&Part, 1, Clock::from_hz(3_000_000).unwrap(), up);
    let text = String::from_utf8(rounded.unwrap()).unwrap();
    assert!(text.contains("(rounded to an even number)"), "{text}");
}

fn values(
    dump: &BTreeMap<String, Variable>,
    path: &str,
    times: impl Iterator<Item = u64>,
) -> Vec<Option<u64>> {
    times.map(|time| dump[path].number_at(time)).collect()
}

#[test]
fn a_window_is_the_same_piece_of_the_whole() {
    let (whole, _) = run_zoo(TICKS, &Options::default());
    let (piece, _) = run_zoo(TICKS, &options(100..140, &[]));
    let whole = reader::read(&whole).variables;
    let piece = reader::read(&piece);
    assert_eq!(piece.times.first(), Some(&200));
    assert_eq!(piece.times.last(), Some(&280));
    let piece = piece.variables;
    assert_eq!(piece.len(), whole.len());
    for path in piece.keys().filter(|path| !path.ends_with("_name")) {
        assert_eq!(
            values(&piece, path, 200..280),
            values(&whole, path, 200..280),
            "{path}"
        );
        assert_eq!(piece[path].at(199), None, "{path}");
    }
}

#[test]
fn only_selects_on_component_boundaries() {
    let names = |only: &[&str]| -> Vec<String> {
        let (bytes, _) = run_zoo(3, &options(0..10, only));
        reader::read(&bytes).variables.into_keys().collect()
    };
    assert_eq!(
        names(&["zoo.pair0"; 0]).len(),
        Declarations::of(&Zoo).leaves.len() + 3
    );
    assert_eq!(names(&["zoo.count"]), ["zoo.clk", "zoo.count"]);
    let left = names(&["zoo.left", "zoo.store.word3"]);
    assert_eq!(
        left,
        [
            "zoo.clk",
            "zoo.left.level",
            "zoo.left.next_level",
            "zoo.left.phase",
            "zoo.left.phase_name",
            "zoo.left.step",
            "zoo.left.up",
            "zoo.left.wrapped",
            "zoo.store.word3",
        ]
    );
    let wrong = Vcd::new(Vec::new(), &Zoo, clock(), &options(0..10, &["zoo.lef"]));
    assert_eq!(
        wrong.unwrap_err().to_string(),
        "no scope or signal is called zoo.lef; scopes: zoo, zoo.store, zoo.great, \
         zoo.delay, zoo.left, zoo.right"
    );
}

#[test]
fn the_same_run_gives_the_same_bytes() {
    let (first, _) = run_zoo(TICKS, &Options::default());
    let (second, _) = run_zoo(TICKS, &Options::default());
    assert!(first == second);
    assert!(!String::from_utf8(first).unwrap().contains("$date"));
}

/// The identifier and the value of a line of changes.
fn change(line: &str) -> (&str, &str) {
    match line.split_once(' ') {
        Some((value, id)) => (id, value),
        None => (&line[1..], &line[..1]),
    }
}

#[test]
fn only_changes_are_written() {
    let (bytes, _) = run_zoo(TICKS, &Options::default());
    let text = String::from_utf8(bytes).unwrap();
    let (header, body) = text.split_once("$enddefinitions $end\n").unwrap();
    assert_eq!(
        header.matches("$scope ").count(),
        6,
        "a scope is declared once: {header}"
    );
    let mut last = HashMap::new();
    for line in body.lines() {
        if !line.starts_with(['#', '$']) {
            let (id, value) = change(line);
            assert_ne!(last.insert(id, value), Some(value), "{line}");
            let digits = value.strip_prefix('b');
            assert!(
                digits.is_none_or(|d| d == "0" || d.starts_with('1')),
                "{line}"
            );
        }
    }
    assert_eq!(last.len(), header.matches("$var ").count());
}

/// Hides what memories say they changed by skipping through a second dump: a dump of every
/// second tick looks at all words each time.
#[test]
fn the_short_way_through_memories_is_the_long_way() {
    let run = |gaps: bool| {
        let mut vcd = Vcd::new(Vec::new(), &Zoo, clock(), &Options::default()).unwrap();
        let mut inputs = inputs(SEED);
        let mut simulator = Simulator::new(&Zoo).unwrap();
        for tick in 0..TICKS {
            let seen = simulator
                .step_with(&inputs.next().unwrap(), |now| {
                    if gaps && tick % 2 == 1 {
                        return Ok(());
                    }
                    vcd.sample(now).map(|_| ())
                })
                .unwrap();
            seen.unwrap();
        }
        reader::read(&vcd.finish().unwrap()).variables
    };
    let (short, long) = (run(false), run(true));
    for (path, variable) in &short {
        for tick in (0..TICKS).step_by(2) {
            assert_eq!(
                variable.at(2 * tick),
                long[path].at(2 * tick),
                "{path} at {tick}"
            );
        }
    }
}

#[test]
fn a_tick_that_comes_twice_is_an_error() {
    let mut vcd = Vcd::new(Vec::new(), &Zoo, clock(), &Options::default()).unwrap();
    let mut simulator = Simulator::new(&Zoo).unwrap();
    let twice = simulator
        .step_with(&inputs(SEED).next().unwrap(), |now| {
            assert!(vcd.sample(now).unwrap().is_continue());
            vcd.sample(now).unwrap_err().to_string()
        })
        .unwrap();
    assert!(twice.contains("tick 0 comes twice"), "{twice}");
}

/// A disk with room for this many bytes.
struct Full<W>(usize, W);

impl<W: Write> Write for Full<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.0 == 0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        let written = self.1.write(&bytes[..bytes.len().min(self.0)])?;
        self.0 -= written;
        Ok(written)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.1.flush()
    }
}

#[test]
fn a_full_disk_is_an_error_of_the_run_or_of_its_end() {
    let directory = tempfile::tempdir().unwrap();
    let file = AtomicFile::create(directory.path().join("zoo.vcd")).unwrap();
    let full = Full(1000, file);
    let mut vcd = Vcd::new(full, &Zoo, clock(), &Options::default()).unwrap();
    let mut inputs = inputs(SEED);
    let run = Simulator::new(&Zoo)
        .unwrap()
        .run(1_000_000, |_, _| inputs.next().unwrap(), &mut vcd);
    assert!(
        matches!(run, Err(RunError::Waves(error)) if error.kind() == io::ErrorKind::StorageFull)
    );
    assert!(vcd.finish().is_err());
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);

    let mut short = Vcd::new(Full(10, io::sink()), &Part, clock(), &Options::default()).unwrap();
    Simulator::new(&Part)
        .unwrap()
        .run(2, |_, _| up(), &mut short)
        .unwrap();
    let error = short.finish().map(|_| ()).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::StorageFull);
}
