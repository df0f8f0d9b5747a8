//! Every circuit of the catalogue driven with random inputs: the run can be repeated from its
//! stimulus file, and it moves every bit that can move.

mod still;

use motion_rtl::check::{Drive, Driven, drive};
use motion_rtl::circuits::arc_generator::ArcGenerator;
use motion_rtl::circuits::blocks::EnableCounter;
use motion_rtl::circuits::linear_interpolator::LinearInterpolator;
use motion_rtl::circuits::pulse_interpolator::{
    Axis, Group, PatternMemory, UnitLaw, Variant, Widths,
};
use motion_rtl::hdl::{Circuit, Value, inputs};
use motion_rtl::netlist::Shape;
use motion_rtl::registry::{AnyModel, Base, CATALOGUE};
use motion_rtl::sim::{Observer, Simulator};
use motion_rtl::trace::{Clock, Options, StimulusFile, Vcd};
use rayon::prelude::*;
use std::collections::HashSet;
use std::io;
use still::{FAR, JOBS, NEVER, ZEROS};

fn run(seed: u64, ticks: u64, resets: bool) -> Drive {
    Drive {
        seed,
        ticks,
        resets,
        bounded: false,
        clock: Clock::default(),
    }
}

/// The waves and the stimulus of a run.
fn files<C: Circuit>(circuit: &C, run: &Drive) -> (Vec<u8>, String, Driven) {
    let (mut waves, mut stimulus) = (Vec::new(), Vec::new());
    let driven = drive(circuit, run, &mut waves, &mut stimulus, io::sink()).expect("it is driven");
    let stimulus = String::from_utf8(stimulus).expect("it is text");
    (waves, stimulus, driven)
}

/// A line of a stimulus file: the ports in, and the reset.
fn parse<C: Circuit>(circuit: &C, line: &str) -> (C::In<Value>, bool) {
    let digits = line.chars().rev();
    let mut bits = digits.flat_map(|digit| {
        let digit = digit.to_digit(16).expect("a hexadecimal digit");
        (0..4).map(move |bit| u64::from(digit >> bit & 1))
    });
    let mut word = |width: usize| -> u64 {
        (0..width)
            .map(|place| bits.next().expect("a bit") << place)
            .sum()
    };
    let i = inputs(circuit, |shape| word(shape.width));
    let reset = word(1) == 1;
    let above: Vec<u64> = bits.collect();
    assert!(
        above.len() < 4 && above.iter().all(|bit| *bit == 0),
        "{line}"
    );
    (i, reset)
}

fn group(axes: usize, half_period: usize, period: usize, address: usize) -> Group {
    let widths = Widths {
        half_period,
        period,
        address,
    };
    Group::new(axes, widths, Variant::Safe, 10)
}

fn axis(half_period: usize, address: usize) -> Axis {
    Axis {
        memory: PatternMemory::new(half_period, address, 0),
        variant: Variant::Safe,
    }
}

/// One of the two looks at everything in every tick, the other passes over what rests.
fn repeats<C: Circuit>(circuit: &C) {
    let (waves, stimulus, driven) = files(circuit, &run(7, 5_000, true));
    let mut vcd =
        Vcd::new(Vec::new(), circuit, Clock::default(), &Options::default()).expect("waves");
    let mut simulator = Simulator::new(circuit).unwrap();
    let (mut ticks, mut resets) = (0, 0);
    for line in stimulus.lines() {
        let (i, rst) = parse(circuit, line);
        let seen = simulator
            .step_with_reset(rst, &i, |now| vcd.sample(now).map(drop))
            .unwrap();
        seen.expect("waves");
        ticks += 1;
        resets += u64::from(rst);
    }
    assert_eq!((ticks, resets), (5_000, driven.resets));
    assert!(resets > 0);
    assert!(vcd.finish().expect("waves") == waves, "{}", C::NAME);
}

#[test]
fn the_stimulus_file_repeats_the_run() {
    repeats(&UnitLaw {
        width: 5,
        variant: Variant::Safe,
    });
    repeats(&axis(16, 12));
    repeats(&group(3, 8, 9, 4));
    repeats(&LinearInterpolator::default());
    repeats(&ArcGenerator::default());
}

#[test]
fn the_same_drive_gives_the_same_bytes() {
    let circuit = group(2, 8, 8, 3);
    let (waves, stimulus, _) = files(&circuit, &run(7, 3_000, true));
    let again = files(&circuit, &run(7, 3_000, true));
    assert!(waves == again.0 && stimulus == again.1);
    let other = files(&circuit, &run(8, 3_000, true));
    assert!(waves != other.0 && stimulus != other.1);
}

#[test]
fn without_resets_it_is_an_ordinary_run_with_its_observers() {
    let circuit = axis(6, 3);
    let (waves, stimulus, driven) = files(&circuit, &run(2, 2_000, false));
    assert_eq!(driven.resets, 0);
    let mut lines = stimulus.lines();
    let mut vcd =
        Vcd::new(Vec::new(), &circuit, Clock::default(), &Options::default()).expect("waves");
    let mut file = StimulusFile::new(Vec::new(), &circuit);
    let observers = (&mut vcd, &mut file);
    let mut i = || parse(&circuit, lines.next().expect("a line a tick")).0;
    Simulator::new(&circuit)
        .unwrap()
        .run(2_000, |_, _| i(), observers)
        .expect("waves");
    assert!(vcd.finish().expect("waves") == waves);
    assert_eq!(file.finish().expect("a file"), stimulus.as_bytes());
}

/// A run of long periods waits for the whole run.
#[test]
fn bounded_words_end_counters_early() {
    let circuit = EnableCounter { width: 24 };
    let is_short = |seed: u64, bounded: bool| {
        let drive = Drive {
            bounded,
            ..run(seed, 1000, false)
        };
        let (_, stimulus, _) = files(&circuit, &drive);
        let mut inputs = stimulus.lines().map(|line| parse(&circuit, line).0);
        inputs.all(|i| i.period < 1 << 12)
    };
    let short = |bounded| (0..20).filter(|&seed| is_short(seed, bounded)).count();
    assert!(short(true) > 4 * short(false));
}

/// A line left out would shift all that follow.
#[test]
fn a_stimulus_file_refuses_a_run_that_goes_over_ticks() {
    let circuit = group(2, 8, 8, 3);
    let mut file = StimulusFile::new(Vec::new(), &circuit);
    let error = Simulator::new(&circuit)
        .unwrap()
        .fast_forward(2_000, |_| Ok(u64::MAX), &mut file)
        .expect_err("a gap");
    assert!(
        error.to_string().contains("does not follow tick 0"),
        "{error}"
    );
}

/// The signals of a circuit.
fn signals(model: &dyn AnyModel) -> HashSet<(String, Shape)> {
    let leaves = model.outline().leaves;
    let leaves = leaves.iter().map(|leaf| (leaf.path(), leaf.shape));
    leaves.collect()
}

#[test]
fn every_circuit_is_made_at_its_widths() {
    for entry in CATALOGUE {
        let name = entry.name;
        let full = entry.full();
        assert_eq!((full.name(), full.about()), (name, entry.about));
        full.layout().expect(name);
        // The machine's circuits are made one by one.
        if name == "machine" {
            continue;
        }
        let made = |bits| entry.scaled(bits);
        assert!(
            made(8).is_some() && (made(3).is_some() || made(4).is_some()),
            "{name}"
        );
        for model in [2, 3, 4, 8, 13, 16].into_iter().filter_map(made) {
            assert_eq!(model.name(), name);
            model.layout().expect(name);
        }
        if entry.proved {
            let circuit = entry.proof(&[]).expect(name);
            assert_eq!(signals(&*circuit), signals(&*entry.small()), "{name}");
        }
    }
}

/// Drives a circuit, and keeps no file.
fn driven(circuit: &dyn AnyModel, run: &Drive) -> Driven {
    let [waves, stimulus, expected] = &mut [io::sink(), io::sink(), io::sink()];
    let driven = circuit.drive(run, waves, stimulus, expected);
    driven.unwrap_or_else(|error| panic!("{}: {error}", circuit.name()))
}

#[test]
#[ignore = "takes long"]
fn every_bit_that_can_move_moves() {
    // The large ones first, so that the last ones are short.
    let entries = CATALOGUE.par_iter().rev().with_max_len(1);
    let left = entries.map(|entry| {
        let mut left = Vec::new();
        let full = ("full", entry.full(), FAR);
        // One without a width is the same at all.
        let narrow = (!entry.widths(Base::Full, &[]).is_empty() && entry.name != "machine")
            .then(|| entry.scaled(8).expect(entry.name));
        let narrow = narrow.map(|model| ("8", model, NEVER));
        for (size, model, allowed) in [full].into_iter().chain(narrow) {
            let driven = driven(&*model, &run(3, 100_000, true));
            let Driven { coverage, resets } = driven;
            let (covered, all) = coverage.bits();
            let name = entry.name;
            println!("{name}, {size}: {covered} of {all} bits, {resets} resets");
            if JOBS.contains(&name) {
                continue;
            }
            for still in coverage.untoggled() {
                let known = allowed.iter().chain(ZEROS);
                let mut allowed = known.filter(|(path, _)| *path == still.path);
                if !allowed.any(|(_, first)| still.bits.trailing_zeros() >= *first) {
                    left.push(format!("{size}: {still}"));
                }
            }
        }
        left
    });
    let left: Vec<_> = left.flatten().collect();
    assert!(left.is_empty(), "\n{}\n", left.join("\n"));
}

/// Signals of which none changes in 20,000 ticks of seed 1, at most, of what has records, targets or
/// steps to play. Most that are left have one value in any run: ports that are tied, terms that are 0.
const STILL: &[(&str, usize)] = &[
    ("pulse_interpolator", 0),
    ("pulse_interpolator_groups", 0),
    ("linear_interpolator", 5),
    ("conventional_interpolator", 6),
    ("controller", 5),
    ("conventional_controller", 15),
    ("compensator", 12),
    ("ram_compensator", 12),
    ("conventional_compensator", 9),
    ("arc_generator", 12),
    ("conventional_generator", 19),
    ("trajectory_controller", 33),
    ("machine", 149),
];

#[test]
fn what_takes_records_moves() {
    let left = STILL.par_iter().with_max_len(1).rev().map(|(name, most)| {
        let circuit = motion_rtl::registry::find(name).expect(name).full();
        let driven = driven(&*circuit, &run(1, 20_000, true));
        let coverage = driven.coverage;
        let still: Vec<_> = coverage.still().map(|signal| signal.path).collect();
        println!("{name}: {} of {}", still.len(), coverage.signals());
        let told = || format!("{name}: {} still, {most} allowed: {still:?}", still.len());
        (still.len() > *most).then(told)
    });
    let left: Vec<_> = left.flatten().collect();
    assert!(left.is_empty(), "\n{}\n", left.join("\n"));
}

/// The words of a record come in order, its last one with `push`, and the path starts behind them.
#[test]
fn records_are_written_whole_and_started() {
    let circuit = ArcGenerator::default();
    let (_, stimulus, _) = files(&circuit, &run(7, 20_000, false));
    let ticks: Vec<_> = stimulus
        .lines()
        .map(|line| parse(&circuit, line).0)
        .collect();
    let is_record = |ticks: &[motion_rtl::circuits::arc_generator::generator::In<Value>]| {
        ticks.iter().enumerate().all(|(word, i)| {
            let record = &i.segments.record;
            record.write && record.write_word == word as u64 && record.push == (word == 31)
        })
    };
    let starts = ticks.iter().enumerate().filter(|(tick, i)| {
        let begun = tick.checked_sub(33);
        i.segments.start && begun.is_some_and(|begun| is_record(&ticks[begun..begun + 32]))
    });
    let starts = starts.count();
    assert!(starts >= 3, "{starts}");
}
