//! Every circuit of the catalogue driven with random inputs: the run can be repeated from its
//! stimulus file, and it moves every bit that can move.

use motion_rtl::check::{Drive, Driven, drive};
use motion_rtl::circuits::arc_generator::ArcGenerator;
use motion_rtl::circuits::linear_interpolator::LinearInterpolator;
use motion_rtl::circuits::pulse_interpolator::{
    Axis, Group, PatternMemory, UnitLaw, Variant, Widths,
};
use motion_rtl::hdl::{Circuit, Observer, Shape, Simulator, Value, inputs};
use motion_rtl::registry::{AnyModel, CATALOGUE, Request};
use motion_rtl::trace::{Clock, Options, StimulusFile, Vcd};
use rayon::prelude::*;
use std::collections::HashSet;
use std::io;

fn run(seed: u64, ticks: u64, resets: bool) -> Drive {
    Drive {
        seed,
        ticks,
        resets,
        clock: Clock::default(),
    }
}

/// The waves and the stimulus of a run.
fn files<C: Circuit>(circuit: &C, run: &Drive) -> (Vec<u8>, String, Driven) {
    let (mut waves, mut stimulus) = (Vec::new(), Vec::new());
    let driven = drive(circuit, run, &mut waves, &mut stimulus).expect("it is driven");
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
        let seen = simulator.step_with_reset(rst, &i, |now| vcd.sample(now).map(drop));
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

/// A line left out would shift all that follow.
#[test]
fn a_stimulus_file_refuses_a_run_that_goes_over_ticks() {
    let circuit = group(2, 8, 8, 3);
    let mut file = StimulusFile::new(Vec::new(), &circuit);
    let error = Simulator::new(&circuit)
        .unwrap()
        .fast_forward(2_000, |_| u64::MAX, &mut file)
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
        let widths = entry.widths();
        if widths.is_empty() {
            assert!(entry.model(&[]).is_some(), "{name}");
            continue;
        }
        // Every width has its name.
        let named = widths.iter();
        let named = named.map(|(name, width)| (name.to_string(), *width as u64));
        let request = Request {
            named: named.collect(),
            ..Request::default()
        };
        let requested = entry.requested(&request).expect(name);
        assert_eq!(signals(&*requested), signals(&*full), "{name}");

        let made = |width: &u64| {
            let model = entry.model(&[*width]);
            model.is_some_and(|model| model.model().is_ok())
        };
        assert!(made(&8) && (made(&3) || made(&4)), "{name}");
        for width in [2, 3, 4, 8, 13, 16].into_iter().filter(made) {
            let model = entry.model(&[width]).expect("it was made");
            assert_eq!(model.name(), name);
            model.layout().expect(name);
            if let Some(circuit) = entry.make(&[width]) {
                assert_eq!(signals(&*circuit), signals(&*model), "{name}[{width}]");
            }
        }
    }
}

/// The top bits of counters, from the given one up, that a run of 100,000 ticks at full width
/// does not reach: a counter has to be left alone for as many ticks as it counts.
const FAR: &[(&str, u32)] = &[
    ("enable_counter.count", 11),
    ("enable_counter.next", 11),
    ("enables.unit_counter.count", 11),
    ("enables.unit_counter.next", 11),
    ("enables.scan_counter.count", 11),
    ("enables.scan_counter.next", 11),
    ("enables.ck_counter.count", 11),
    ("enables.ck_counter.next", 11),
    ("enables.sample_counter.count", 11),
    ("enables.sample_counter.next", 11),
    ("pulse_generator.count", 9),
    ("pulse_generator.next", 9),
    ("pulse_train.count", 9),
    ("pulse_train.next", 9),
    ("axis.generator.count", 8),
    ("axis.generator.next", 8),
    ("unit_law.counter.count", 15),
    ("unit_law.counter.next", 15),
    ("unit_law.generator.count", 13),
    ("unit_law.generator.next", 13),
    ("unit_law.pulses", 13),
    ("unit_law.counted", 13),
    ("pulse_interpolator.counter.count", 10),
    ("pulse_interpolator.counter.next", 10),
    ("pulse_interpolator.x.generator.count", 9),
    ("pulse_interpolator.x.generator.next", 10),
    ("pulse_interpolator.y.generator.count", 10),
    ("pulse_interpolator.y.generator.next", 10),
    // Never: the floor rule has no use for them, and the divider is twice as wide as a position.
    ("accumulator.lent", 0),
    ("accumulator.multiplicand", 32),
    ("accumulator.addend", 32),
    ("accumulator.divisor", 32),
    ("accumulator.first", 0),
    // Never: the greatest distance by the greatest gain is less, and so is the limit.
    ("position_control.product", 47),
    ("position_control.amount", 15),
    ("position_loop.control.product", 47),
    ("position_loop.control.amount", 15),
    // Of the words that the multiplier-divider shares, most steps use the lower part only; W and 2V
    // are even, always; long times are rarely prepared, and more rarely gone through.
    ("trapezoid.level", 17),
    ("trapezoid.steady_scans", 31),
    ("trapezoid.left", 31),
    ("trapezoid.multiplicand", 32),
    ("trapezoid.excess", 34),
    ("trapezoid.times", 13),
    ("trapezoid.length_twice", 0),
    ("trapezoid.speed_twice", 0),
    ("trapezoid.next_level", 18),
    ("trapezoid.weight", 19),
    ("pattern_generator.trapezoid.steady_scans", 31),
    ("pattern_generator.trapezoid.peak", 12),
    ("pattern_generator.trapezoid.total", 0),
    ("pattern_generator.trapezoid.level", 10),
    ("pattern_generator.trapezoid.remainder", 36),
    ("pattern_generator.trapezoid.multiplicand", 32),
    ("pattern_generator.trapezoid.multiplier", 13),
    ("pattern_generator.trapezoid.addend", 36),
    ("pattern_generator.trapezoid.divisor", 0),
    ("pattern_generator.trapezoid.excess", 34),
    ("pattern_generator.trapezoid.times", 13),
    ("pattern_generator.trapezoid.length_twice", 0),
    ("pattern_generator.trapezoid.speed_twice", 0),
    // Never in a hundred thousand ticks: a distance of the whole word.
    ("sequencer.way_x", 31),
    ("sequencer.way_y", 31),
    ("pattern_generator.trapezoid.next_level", 12),
    ("pattern_generator.trapezoid.weight", 12),
    ("pattern_generator.trapezoid.left", 31),
    ("pattern_generator.mul_div.shifted", 57),
    ("pattern_generator.mul_div.factor", 13),
    ("pattern_generator.mul_div.by", 0),
    ("pattern_generator.mul_div.remainder", 36),
    ("pattern_generator.mul_div.multiplicand", 32),
    ("pattern_generator.mul_div.multiplier", 13),
    ("pattern_generator.mul_div.addend", 36),
    ("pattern_generator.mul_div.divisor", 0),
    ("pattern_generator.mul_div.partial", 37),
    // Never: they have room for the largest sum of any width, and for any position.
    ("ratio_logic.wide", 11),
    ("ratio_logic.rounded", 12),
    ("ratio_logic.halved", 11),
    ("ratio_logic.product", 25),
    ("ratio_logic.fifth", 8),
    ("ratio_logic.quotient", 8),
    ("correction_arithmetic.multiplicand", 24),
    ("correction_arithmetic.divisor", 24),
    ("correction_arithmetic.addend", 23),
    ("refinement.addend", 23),
    ("lead_arithmetic.factor", 4),
    ("speed_lead.factor", 14),
    // Times in CKs.
    ("speed_detector.count", 9),
    ("speed_detector.next_count", 9),
    ("speed_lead.detector.count", 9),
    ("speed_lead.detector.next_count", 9),
    ("table_lead.detector.count", 9),
    ("table_lead.detector.next_count", 9),
    // Bits that the words of its memory have not.
    ("table_lead.base", 0),
    ("table_lead.increment", 0),
    ("table_lead.product", 0),
    // At most half of the code is before a turn.
    ("absolute_detector.unused", 17),
    ("absolute_detector.first", 16),
    // Never negative, nor is a part of a table's spacing.
    ("absolute_detector.placed", 18),
    ("absolute_detector.whole", 18),
    ("absolute_detector.half", 17),
    ("table_lead.share", 5),
    ("completion_detector.still", 6),
    ("completion_detector.elapsed", 6),
    ("completion_detector.next_still", 6),
    ("completion_detector.next_elapsed", 6),
    ("step_sequencer.count", 9),
    // Never: the value of a record is whole, the fourth difference takes no step, and nothing is
    // below it.
    ("difference_engine.value.load_part", 0),
    ("difference_engine.d4.step", 0),
    ("difference_engine.d4.by_whole", 0),
    ("difference_engine.d4.by_part", 0),
    // One word of 32, and most words are small.
    ("axis_terms.x", 23),
    ("rotation.row_y.by_y", 31),
    ("rotation.row_y.bits_y", 41),
    // Never: a gain of 24 bits; what is shifted up, and what has room for the sum of two.
    ("scaler.bit_index", 5),
    ("model_state.motion", 0),
    ("arc_angle.factor", 0),
    ("arc_angle.product", 51),
    ("length_powers.product", 54),
    ("cordic_state.turn", 42),
    ("point_sequencer.ahead", 0),
    ("servo_arithmetic.most", 16),
    ("model_state.cut", 49),
    ("cordic_state.quarter", 0),
    ("servo_arithmetic.actual", 0),
    ("servo_arithmetic.motor_way", 0),
    ("servo_arithmetic.size", 57),
    ("servo_arithmetic.highest", 0),
    ("servo_arithmetic.lowest", 0),
    ("period_join.count", 0),
];

/// At any width: what is shifted up has zeros below; N is no more than 10.
const ZEROS: &[(&str, u32)] = &[
    ("error_feedback.low_x", 0),
    ("error_feedback.low_y", 0),
    ("error_feedback.high_x", 0),
    ("error_feedback.high_y", 0),
    ("error_feedback.term_x", 0),
    ("error_feedback.term_y", 0),
    ("error_feedback.raised_x", 0),
    ("error_feedback.raised_y", 0),
    ("error_feedback.own_low_x", 0),
    ("error_feedback.own_low_y", 0),
    ("error_feedback.own_high_x", 0),
    ("error_feedback.own_high_y", 0),
    ("lead_products.factor", 4),
];

/// At 8 bits: the pulses of a unit time of up to 255 ticks are at most 127, and a word of 8 bits
/// is divided in 8 ticks.
const NEVER: &[(&str, u32)] = &[
    // `unit_end` comes in every other tick.
    ("pulse_interpolator.x.generator.count", 6),
    ("pulse_interpolator.x.generator.next", 7),
    ("pulse_interpolator.y.generator.count", 7),
    ("pulse_interpolator.y.generator.next", 7),
    ("unit_law.pulses", 7),
    ("unit_law.counted", 7),
    ("mul_div.count", 3),
    // As above.
    ("accumulator.lent", 0),
    ("accumulator.multiplicand", 8),
    ("accumulator.addend", 8),
    ("accumulator.divisor", 8),
    ("accumulator.first", 0),
    // As at full width.
    ("position_control.product", 15),
    ("position_control.amount", 7),
    ("position_loop.control.product", 15),
    ("position_loop.control.amount", 7),
    // As above; 18 bits are divided in 18 ticks, and Ta·Td has two bits less than the word for it.
    ("trapezoid.multiplicand", 10),
    ("trapezoid.excess", 10),
    ("trapezoid.times", 5),
    ("trapezoid.length_twice", 0),
    ("trapezoid.speed_twice", 0),
    ("trapezoid.steady_scans", 7),
    ("trapezoid.left", 7),
    ("trapezoid.multiplicand", 9),
    ("pattern_generator.trapezoid.steady_scans", 7),
    ("pattern_generator.trapezoid.peak", 7),
    ("pattern_generator.trapezoid.total", 0),
    ("pattern_generator.trapezoid.level", 7),
    ("pattern_generator.trapezoid.remainder", 12),
    ("pattern_generator.trapezoid.multiplicand", 8),
    ("pattern_generator.trapezoid.multiplier", 8),
    ("pattern_generator.trapezoid.addend", 13),
    ("pattern_generator.trapezoid.divisor", 0),
    ("pattern_generator.trapezoid.excess", 10),
    ("pattern_generator.trapezoid.times", 5),
    ("pattern_generator.trapezoid.length_twice", 0),
    ("pattern_generator.trapezoid.speed_twice", 0),
    ("sequencer.way_y", 7),
    ("pattern_generator.trapezoid.next_level", 7),
    ("pattern_generator.trapezoid.weight", 8),
    ("pattern_generator.trapezoid.left", 7),
    ("pattern_generator.mul_div.count", 5),
    ("pattern_generator.mul_div.shifted", 17),
    ("pattern_generator.mul_div.factor", 8),
    ("pattern_generator.mul_div.by", 0),
    ("pattern_generator.mul_div.remainder", 12),
    ("pattern_generator.mul_div.multiplicand", 8),
    ("pattern_generator.mul_div.multiplier", 8),
    ("pattern_generator.mul_div.addend", 13),
    ("pattern_generator.mul_div.divisor", 0),
    ("pattern_generator.mul_div.partial", 13),
    ("ratio_logic.wide", 8),
    ("ratio_logic.rounded", 9),
    ("ratio_logic.halved", 8),
    ("ratio_logic.product", 22),
    ("ratio_logic.fifth", 5),
    ("ratio_logic.quotient", 5),
    ("correction_arithmetic.multiplicand", 8),
    ("correction_arithmetic.divisor", 8),
    ("correction_arithmetic.addend", 7),
    ("refinement.addend", 7),
    ("lead_arithmetic.factor", 4),
    ("speed_lead.factor", 14),
    // As above.
    ("table_lead.base", 0),
    ("table_lead.increment", 0),
    ("table_lead.product", 0),
    ("absolute_detector.unused", 7),
    ("absolute_detector.first", 6),
    ("absolute_detector.placed", 8),
    ("absolute_detector.whole", 8),
    ("absolute_detector.half", 7),
    ("table_lead.share", 2),
    ("completion_detector.still", 5),
    ("completion_detector.elapsed", 5),
    ("completion_detector.next_still", 5),
    ("completion_detector.next_elapsed", 5),
    ("difference_engine.value.load_part", 0),
    ("difference_engine.d4.step", 0),
    ("difference_engine.d4.by_whole", 0),
    ("difference_engine.d4.by_part", 0),
    // Coefficients of 8 bits.
    ("coefficient_control.bit_index", 4),
    ("rotation.control.bit_index", 4),
    // As above.
    ("scaler.bit_index", 3),
    ("model_state.motion", 0),
    ("arc_angle.factor", 0),
    ("arc_angle.product", 12),
    ("length_powers.product", 9),
    ("cordic_state.iteration", 3),
    ("cordic_state.turn", 6),
    ("point_sequencer.ahead", 0),
    ("servo_arithmetic.most", 8),
    ("model_state.cut", 10),
    ("cordic_state.quarter", 0),
    ("servo_arithmetic.actual", 0),
    ("servo_arithmetic.motor_way", 0),
    ("servo_arithmetic.highest", 0),
    ("servo_arithmetic.lowest", 0),
    ("period_join.count", 0),
];

/// Circuits that only wire blocks which are driven alone: it takes whole jobs to move their bits,
/// and those are held against their Verilog too.
const JOBS: &[&str] = &[
    "integrator",
    "line_law",
    "linear_interpolator",
    "conventional_interpolator",
    "motor_controller",
    "conventional_pulse_interpolator",
    "controller",
    "conventional_controller",
    "time_lead",
    "ram_time_lead",
    "correction",
    "second_order_correction",
    "compensator",
    "ram_compensator",
    "conventional_compensator",
    "arc_generator",
    "conventional_generator",
    "reference_model",
    "cordic",
    "path_point",
    "servo",
    "controlled_axis",
    "trajectory_controller",
    "machine",
];

#[test]
fn every_bit_that_can_move_moves() {
    // The large ones first, so that the last ones are short.
    let entries = CATALOGUE.par_iter().rev().with_max_len(1);
    let left = entries.map(|entry| {
        let mut left = Vec::new();
        let full = ("full", entry.full(), FAR);
        // One without a width is the same at all.
        let narrow = (!entry.widths().is_empty()).then(|| entry.model(&[8]).expect(entry.name));
        let narrow = narrow.map(|model| ("8", model, NEVER));
        for (size, model, allowed) in [full].into_iter().chain(narrow) {
            let driven = model.drive(&run(3, 100_000, true), &mut io::sink(), &mut io::sink());
            let Driven { coverage, resets } = driven.expect(entry.name);
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
