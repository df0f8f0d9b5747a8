//! Axes of each circuit.

use super::super::support::{Bench, LINE, SHORT, list, near, number, whole, words};
use super::{DIAGONAL, FINE, agree, series};

#[test]
fn commands_and_motors_of_the_linear_interpolator_stand_in_its_series() {
    let bench = Bench::with("d.hpgl", DIAGONAL);
    let run = [
        "d.hpgl",
        "--set",
        "circuit=linear_interpolator",
        "--to",
        "100000",
    ];
    let series = agree(
        &bench,
        &run,
        "controller.scan",
        &[
            ("x_commanded_counts", "controller.command_x", 1.0),
            ("x_actual_counts", "controller.plant.x.position", FINE),
            ("y_commanded_counts", "controller.command_y", 1.0),
            ("y_actual_counts", "controller.plant.y.position", FINE),
        ],
    );
    assert!(series.largest_error(&["x", "y"], "counts") > 10.0);
}

#[test]
fn points_and_motors_of_the_trajectory_controller_stand_in_its_series() {
    let bench = Bench::with("d.hpgl", DIAGONAL);
    let run = [
        "d.hpgl",
        "--set",
        "circuit=trajectory_controller",
        "--set",
        "feed_mm_per_min=1200",
        "--to",
        "60000",
    ];
    let guard = 1.0 / 65_536.0;
    agree(
        &bench,
        &run,
        "trajectory_controller.x.servo.model.fresh",
        &[
            (
                "x_commanded_counts",
                "trajectory_controller.distribution.x.point",
                guard,
            ),
            (
                "x_actual_counts",
                "trajectory_controller.plant.x.position",
                FINE,
            ),
            (
                "y_commanded_counts",
                "trajectory_controller.distribution.y.point",
                guard,
            ),
            (
                "y_actual_counts",
                "trajectory_controller.plant.y.position",
                FINE,
            ),
        ],
    );
    // The summary's error is by the encoders, in whole counts.
    let (series, summary) = series(&bench, &[&run[..5], &["--no-vcd"]].concat());
    let rows = list(&summary, "corrections").iter();
    let own = rows.clone().find(|row| row["in_waves"] == true).unwrap();
    let counts_per_mm = number(&summary, "/settings/counts_per_mm");
    let largest = number(own, "/motor/following_max_mm") * counts_per_mm;
    near(series.largest_error(&["x", "y"], "counts"), largest, 2.0);
}

#[test]
fn target_and_body_of_the_lead_angle_compensator_stand_in_its_series() {
    let bench = Bench::new();
    let run = [
        "waves/turntable.toml",
        "--set",
        "beside=false",
        "--to",
        "60000",
    ];
    let series = agree(
        &bench,
        &run,
        "compensator.ck",
        &[
            ("body_commanded_counts", "compensator.target", 1.0),
            ("body_actual_counts", "compensator.plant.position", FINE),
        ],
    );
    assert!(series.column("body_actual_counts").last().unwrap() > &10.0);
}

#[test]
fn exact_points_and_commands_of_the_arc_generator_stand_in_its_series() {
    let bench = Bench::with("d.hpgl", "PD401,303;");
    let run = [
        "d.hpgl",
        "--set",
        "circuit=arc_generator",
        "--set",
        "feed_mm_per_min=1200",
    ];
    agree(
        &bench,
        &run,
        "arc_generator.sampled",
        &["x", "y", "z"].map(|axis| match axis {
            "x" => ("x_actual_counts", "arc_generator.x", 1.0),
            "y" => ("y_actual_counts", "arc_generator.y", 1.0),
            _ => ("z_actual_counts", "arc_generator.z", 1.0),
        }),
    );
    // Every sample is a row: the summary's error is that of a row.
    let (series, summary) = series(&bench, &run);
    let counts_per_mm = number(&summary, "/settings/counts_per_mm");
    let error_um = series.largest_error(&["x", "y", "z"], "counts") / counts_per_mm * 1e3;
    let due = number(&summary, "/error_max_um");
    assert!(due > 0.01);
    near(error_um, due, 1e-6);
    // A window does not move the plan.
    let (part, _) = self::series(&bench, &[&run[..], &["--from", "3000"]].concat());
    let skipped = series.rows.len() - part.rows.len();
    assert!(skipped > 0 && part.rows == series.rows[skipped..]);
}

/// Before the first sample the words are zero, wherever the path begins.
#[test]
fn rows_of_the_arc_generator_begin_with_the_first_sample() {
    let text = "circuit = \"arc_generator\"\nfeed_mm_per_min = 600\nstart_mm = [10, 5, 2]\n[[piece]]\nto_mm = [11, 5, 3]\n";
    let bench = Bench::with("s.toml", text);
    let (series, _) = series(&bench, &["s.toml", "--no-vcd", "--series-every", "7"]);
    let ticks = series.ticks();
    assert!(ticks.len() > 50 && ticks[0] > 7, "{ticks:?}");
    assert!(ticks.iter().all(|tick| tick % 7 == 0), "{ticks:?}");
    assert!(series.largest_error(&["x", "y", "z"], "counts") < 2.0);
    assert!(series.column("x_actual_counts")[0] > 1000.0);
}

#[test]
fn servos_steppers_and_lift_of_the_machine_stand_in_its_series() {
    let bench = Bench::with("l.hpgl", LINE);
    let run = ["l.hpgl", "--set", "circuit=machine"];
    let window = ["--from", "0", "--to", "30000"];
    let series = agree(
        &bench,
        &[&run[..], &window].concat(),
        "machine.trajectory_controller.x.driven",
        &[
            ("x_commanded_counts", "machine.command_join.x", 1.0),
            ("x_actual_counts", "machine.plant.servo_x.position", FINE),
            ("y_commanded_counts", "machine.command_join.y", 1.0),
            ("y_actual_counts", "machine.plant.servo_y.position", FINE),
            ("stepper_x_actual_steps", "machine.plant.stepper_x", 1.0),
            ("stepper_y_actual_steps", "machine.plant.stepper_y", 1.0),
            ("lift_commanded_counts", "machine.lead_angle.target", 1.0),
            ("lift_actual_counts", "machine.plant.lift.position", FINE),
        ],
    );
    // A pattern is half a step off its path at the end of a unit time, and less than two within.
    let off = series.largest_error(&["stepper_x"], "steps");
    assert!(off > 0.0 && off < 2.0, "{off}");
    assert!(series.column("stepper_x_commanded_steps").last().unwrap() > &5.0);
}

/// Positions by the step and direction lines of a dump, tick by tick.
fn counted(dump: &str, scope: &str, axis: &str) -> Vec<f64> {
    let lines = ["step", "dir"].map(|line| format!("{scope}.{line}_{axis}"));
    let lines = words(dump, &lines.each_ref().map(String::as_str));
    let (mut position, mut before) = (0.0, 0);
    let steps = lines.iter().map(|now| {
        if now[0] == 1 && before == 0 {
            position += if now[1] == 1 { -1.0 } else { 1.0 };
        }
        before = now[0];
        position
    });
    steps.collect()
}

#[test]
fn the_drawing_and_the_steps_of_the_pulse_interpolator_stand_in_its_series() {
    let bench = Bench::with("d.hpgl", "PD400,300;PD100,350;");
    let run = [&["d.hpgl"], &SHORT[..]].concat();
    let series = agree(&bench, &run, "pulse_interpolator.unit_rst", &[]);
    let dump = bench.read("waves/d.vcd");
    for axis in ["x", "y"] {
        let steps = counted(&dump, "pulse_interpolator", axis);
        let due = series.ticks().into_iter().map(|tick| steps[tick as usize]);
        let name = format!("{axis}_actual_steps");
        assert_eq!(series.column(&name), due.collect::<Vec<_>>());
        assert!(series.column(&name).iter().any(|at| *at > 100.0));
        // Half a step at the ends of unit times, as the table is made.
        assert!(series.largest_error(&[axis], "steps") <= 0.5 + 1e-4);
    }
    let ends = series.rows.last().unwrap();
    assert_eq!(ends[2..], [200.0, 200.0, 0.0, 700.0, 700.0, 0.0]);
    // In each tick the error is that of the summary, but for the way in one tick.
    let (series, summary) = self::series(&bench, &[&run[..], &["--series-every", "1"]].concat());
    assert_eq!(series.rows.len() as i64, whole(&summary, "/ticks"));
    for axis in ["x", "y"] {
        let due = number(&summary, &format!("/axes/{axis}/following_error_max/steps"));
        near(series.largest_error(&[axis], "steps"), due, 0.03);
    }
}

#[test]
fn motors_stand_in_the_series_where_there_are_some() {
    let bench = Bench::with(
        "s.toml",
        "circuit = \"pulse_interpolator\"\nclock_hz = 100_000\n\
         [[pattern]]\nname = \"a\"\ntable = \"t.csv\"\n\
         [motor]\nholding_torque_nm = 1\ninertia_kg_m2 = 5e-5\ndamping_nm_s = 0.01\n",
    );
    let units = (0..20).map(|unit| format!("{unit},500,50,0\n"));
    let header = "unit,period_ticks,x_half_period_ticks,x_down\n";
    bench.write("t.csv", header.to_owned() + &units.collect::<String>());
    let series = agree(
        &bench,
        &["s.toml"],
        "pulse_interpolator.unit_rst",
        &[(
            "x_actual_steps",
            "pulse_interpolator.plant.x.position",
            FINE,
        )],
    );
    // Five steps in each unit time.
    let commanded = series.column("x_commanded_steps");
    assert_eq!(commanded.last(), Some(&100.0));
    assert!(
        commanded
            .windows(2)
            .all(|pair| [0.0, 5.0].contains(&(pair[1] - pair[0])))
    );
}

#[test]
fn both_groups_stand_in_one_series() {
    let bench = Bench::new();
    let run = ["waves/groups.toml", "--set", "vcd_ticks=1000000"];
    let strobe = "pulse_interpolator_groups.of_first.unit_rst";
    let series = agree(&bench, &run, strobe, &[]);
    let dump = bench.read("waves/groups.vcd");
    for (group, axis) in [
        ("first", "x"),
        ("first", "y"),
        ("second", "x"),
        ("second", "y"),
    ] {
        let scope = format!("pulse_interpolator_groups.of_{group}");
        let steps = counted(&dump, &scope, axis);
        let due = series.ticks().into_iter().map(|tick| steps[tick as usize]);
        let name = format!("{group}_{axis}");
        assert_eq!(
            series.column(&format!("{name}_actual_steps")),
            due.collect::<Vec<_>>()
        );
        assert!(series.largest_error(&[&name], "steps") < 1.5, "{name}");
    }
    // A row is at the end of each unit time of the first group, whose words are exact there.
    assert_eq!(series.largest_error(&["first_x", "first_y"], "steps"), 0.0);
    assert!(series.largest_error(&["second_x"], "steps") > 0.0);
}
