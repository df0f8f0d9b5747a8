//! Drawings played on the group with the default word lengths, against the table they came from.
//! Each is played tick by tick and over idle ticks in one.

use motion_rtl::circuits::pulse_interpolator::{Group, Variant, Widths};
use motion_rtl::input::{Drawing, gcode};
use motion_rtl::jobs::pulse_interpolator::job::{Played, fast_forward, group, play};
use motion_rtl::jobs::pulse_interpolator::{Report, Settings, StepTiming, Table, compile};
use motion_rtl::plan::MotionLimits;

/// Unit times of 40 ticks for lines and 25 for arcs, at 20 kHz.
fn settings(axes: usize) -> Settings {
    Settings {
        clock_hz: 20_000,
        steps_per_mm: vec![20.0, -10.0, 40.0][..axes].to_vec(),
        motion: MotionLimits {
            feed_mm_per_min: 1200.0,
            rapid_mm_per_min: 1800.0,
            corner_mm_per_min: 120.0,
            acceleration_mm_per_s2: 400.0,
        },
        line_unit_ticks: 40,
        arc_unit_ticks: 25,
        timing: StepTiming::NONE,
        ..Settings::default()
    }
}

fn read(program: &str) -> Drawing {
    gcode::read("t.ngc", program.as_bytes()).expect("a good program")
}

fn run(axes: usize, program: &str, variant: Variant) -> (Table, Report, Played) {
    let (table, report) = compile(&read(program), &settings(axes)).expect("it compiles");
    let played = play_twice(&table, variant);
    (table, report, played)
}

fn play_twice(table: &Table, variant: Variant) -> Played {
    let group = group(table, variant);
    let played = play(&group, table, &mut ()).expect("no observer objects");
    let jumped = fast_forward(&group, table, &mut ()).expect("no observer objects");
    assert!(played == jumped, "another run without the idle ticks");
    played
}

/// Positions at the end of each unit time as they were counted, X first.
fn positions(played: &Played, table: &Table) -> Vec<i32> {
    let units = played.positions.of(table);
    units.flat_map(|at| at.to_vec()).collect()
}

/// Positions at the end of each unit time, by toggling a line tick by tick.
fn expected(table: &Table) -> Vec<i32> {
    let mut positions = vec![0; table.axes()];
    let mut all = Vec::new();
    for (period, words) in table.iter() {
        for (position, word) in positions.iter_mut().zip(words.iter()) {
            let mut level = false;
            for tick in 1..period {
                let n = word.half_period();
                if n > 0 && tick % n == 0 {
                    level = !level;
                    let step = if word.negative() { -1 } else { 1 };
                    *position += if level { step } else { 0 };
                }
            }
        }
        all.extend_from_slice(&positions);
    }
    all
}

#[test]
fn lines_and_arcs_with_their_own_unit_times() {
    let program = "F1000\nG1 X3 Y1\nG3 X5 Y3 I0 J2\nG2 X6 Y4 R1\nG1 X0\nG2 I1\nG0 Y0\n";
    let (table, report, played) = run(2, program, Variant::Safe);
    let periods: Vec<_> = table
        .patterns()
        .iter()
        .map(|pattern| pattern.period)
        .collect();
    assert_eq!(periods, [40, 25, 40, 25, 40]);
    assert_eq!(positions(&played, &table), expected(&table));
    assert_eq!(played.idle_units, 0);
    for (axis, seen) in report.axes.iter().zip(&played.axes) {
        assert_eq!(seen.position(), axis.steps_demanded);
        let pulses = (axis.pulses_forward, axis.pulses_backward);
        assert_eq!((seen.pulses_up, seen.pulses_down), pulses);
    }
    let first = expected(&table).iter().position(|position| *position != 0);
    let unit = first.expect("it moves") as u64 / 2;
    let step = played.first_step.expect("it moves") - played.begun;
    assert!(
        (unit * 40..(unit + 1) * 40).contains(&step),
        "{step} in unit {unit}"
    );
    // From the first unit time on, nothing but the table's own time, and a tick for the last edge.
    assert_eq!(played.ticks - played.begun, table.total_ticks() + 1);
}

#[test]
fn a_table_longer_than_the_memory_goes_through_its_halves() {
    let program = "F1200\nG1 X200 Y90\nG1 X10 Y150\n";
    let (table, _, played) = run(2, program, Variant::Safe);
    assert!(table.units() > 3 * 2048, "{} unit times", table.units());
    assert_eq!(positions(&played, &table), expected(&table));
    assert_eq!(played.idle_units, 0);
    assert_eq!(played.ticks - played.begun, table.total_ticks() + 1);
}

#[test]
fn three_axes_and_one() {
    let (table, report, played) = run(3, "F600\nG1 X4 Y-3 Z2\nG2 X4 Y-3 I2 Z5\n", Variant::Safe);
    assert_eq!(positions(&played, &table), expected(&table));
    let ends: Vec<_> = played.axes.iter().map(|axis| axis.position()).collect();
    assert_eq!(ends, [80, 30, 200]);
    assert_eq!(report.axes.len(), 3);
    let (table, _, played) = run(1, "F600\nG1 X-7.5\n", Variant::Safe);
    assert_eq!(positions(&played, &table), expected(&table));
    assert_eq!(played.axes[0].position(), -150);
    assert_eq!(played.axes[0].pulses_up, 0);
}

#[test]
fn a_pattern_that_comes_too_late_costs_time_and_no_pulse() {
    // Unit times of 2 and 3 ticks are over before the two words of the next pattern are written.
    let mut settings = settings(2);
    (settings.line_unit_ticks, settings.arc_unit_ticks) = (2, 3);
    settings.clock_hz = 100;
    let program = format!("F1200\n{}", "G1 X0.1\nG3 X0 I-0.05\n".repeat(20));
    let (table, report) = compile(&read(&program), &settings).expect("it compiles");
    let played = play_twice(&table, Variant::Safe);
    assert_eq!(positions(&played, &table), expected(&table));
    assert!(
        played.idle_units > 0,
        "the computer kept up: choose shorter unit times"
    );
    assert!(played.ticks - played.begun > table.total_ticks() + 1);
    for (axis, seen) in report.axes.iter().zip(&played.axes) {
        assert_eq!(seen.position(), axis.steps_demanded);
    }
}

#[test]
fn the_literal_variant_ends_elsewhere() {
    let (table, report, played) = run(2, "F3700\nG1 X300 Y70\n", Variant::Literal);
    assert_ne!(positions(&played, &table), expected(&table));
    let ends: Vec<_> = played.axes.iter().map(|axis| axis.position()).collect();
    let demanded: Vec<_> = report.axes.iter().map(|axis| axis.steps_demanded).collect();
    assert_ne!(ends, demanded);
}

/// Words that are cut would be other pulses.
#[test]
fn a_table_that_the_group_has_no_room_for_is_refused() {
    let drawing = read("G1 X5 Y1 F1200\n");
    let refused = |settings: &Settings| {
        let (table, _) = compile(&drawing, settings).expect("it compiles");
        let group = Group::new(2, Widths::default(), Variant::Safe, 40);
        let both = [
            play(&group, &table, &mut ()),
            fast_forward(&group, &table, &mut ()),
        ];
        let [played, jumped] = both.map(|run| run.map_err(|error| error.to_string()));
        assert_eq!(played, jumped);
        played.expect_err("it does not fit")
    };
    assert_eq!(refused(&settings(3)), "axes: is 3; allowed: 2");
    let wide = Settings {
        half_period_bits: 20,
        ..settings(2)
    };
    assert_eq!(refused(&wide), "half_period_bits: is 20; allowed: 0 to 16");
}
