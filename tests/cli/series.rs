//! Time series of runs, against their waves and summaries.

use super::support::{Bench, LINE, SHORT, list, near, number, paths, whole, words};
use serde_json::{Value, json};

/// A diagonal, with the pen down.
const DIAGONAL: &str = "PD400,300;";
/// Unit of a plant's position in the waves.
const FINE: f64 = 1.0 / 256.0;

/// A series by the names of its columns.
#[derive(Debug, PartialEq)]
struct Series {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Series {
    fn csv(text: &str) -> Self {
        let mut lines = text.lines();
        let names = lines.next().unwrap().split(',').map(str::to_owned);
        let rows = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect());
        Series {
            names: names.collect(),
            rows: rows.collect(),
        }
    }

    /// Reads what `numpy.load` reads: format 1.0, little endian, one dimension.
    fn npy(bytes: &[u8]) -> Self {
        assert_eq!(bytes[..8], *b"\x93NUMPY\x01\x00");
        let length = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        assert_eq!(length % 64, 0);
        let header = std::str::from_utf8(&bytes[10..length]).unwrap();
        let header = header.strip_suffix('\n').unwrap().trim_end();
        let fields = header.strip_prefix("{'descr': [('").unwrap();
        let (fields, shape) = fields
            .split_once("')], 'fortran_order': False, 'shape': (")
            .unwrap();
        let count: usize = shape.strip_suffix(",), }").unwrap().parse().unwrap();
        let fields = fields
            .split("'), ('")
            .map(|field| field.split_once("', '").unwrap());
        let (names, kinds): (Vec<_>, Vec<_>) = fields.unzip();
        assert_eq!(kinds[0], "<u8");
        assert!(kinds[1..].iter().all(|kind| *kind == "<f8"), "{kinds:?}");
        let words: Vec<[u8; 8]> = bytes[length..].as_chunks().0.to_vec();
        assert_eq!(bytes.len(), length + 8 * names.len() * count);
        let rows = words.chunks(names.len()).map(|row| {
            let tick = u64::from_le_bytes(row[0]) as f64;
            let numbers = row[1..].iter().map(|word| f64::from_le_bytes(*word));
            [tick].into_iter().chain(numbers).collect()
        });
        Series {
            names: names.into_iter().map(str::to_owned).collect(),
            rows: rows.collect(),
        }
    }

    #[track_caller]
    fn column(&self, name: &str) -> Vec<f64> {
        let place = self.names.iter().position(|other| other == name);
        let place = place.unwrap_or_else(|| panic!("no {name} in {:?}", self.names));
        self.rows.iter().map(|row| row[place]).collect()
    }

    fn ticks(&self) -> Vec<u64> {
        self.column("tick")
            .into_iter()
            .map(|tick| tick as u64)
            .collect()
    }

    /// The largest error in a row, over axes of these names.
    fn largest_error(&self, axes: &[&str], unit: &str) -> f64 {
        let columns = axes
            .iter()
            .map(|axis| self.column(&format!("{axis}_error_{unit}")));
        let columns: Vec<_> = columns.collect();
        let error = |row: usize| {
            columns
                .iter()
                .map(|all| all[row].powi(2))
                .sum::<f64>()
                .sqrt()
        };
        (0..self.rows.len()).map(error).fold(0.0, f64::max)
    }
}

/// Runs with a series, and gives it with the summary.
fn series(bench: &Bench, arguments: &[&str]) -> (Series, Value) {
    let summary = bench.json(&[&["run"], arguments, &["--series", "out/s.csv"]].concat());
    (Series::csv(&bench.read("out/s.csv")), summary)
}

/// A column, the signal that it is of, and the signal's unit.
type Column<'a> = (&'a str, &'a str, f64);

/// Holds each row of a series against the waves of the same run: a row in each tick of the strobe,
/// with these positions.
#[track_caller]
fn agree(bench: &Bench, arguments: &[&str], strobe: &str, columns: &[Column<'_>]) -> Series {
    let (series, summary) = series(bench, arguments);
    let dump = paths(&summary)[0].as_str().unwrap().to_owned();
    let signals = columns.iter().map(|(_, path, _)| *path);
    let signals: Vec<_> = [strobe].into_iter().chain(signals).collect();
    let waves = words(&bench.read(&dump), &signals);
    let strobes = waves.iter().enumerate().filter(|(_, now)| now[0] == 1);
    let strobes: Vec<_> = strobes.map(|(tick, _)| tick as u64).collect();
    assert!(strobes.len() > 5, "{strobes:?}");
    assert_eq!(series.ticks(), strobes);
    let clock_hz = number(&summary, "/clock_hz");
    let times = strobes.iter().map(|tick| *tick as f64 / clock_hz);
    assert_eq!(series.column("time_s"), times.collect::<Vec<_>>());
    for (place, (name, path, scale)) in columns.iter().enumerate() {
        let due = strobes
            .iter()
            .map(|tick| waves[*tick as usize][place + 1] as f64 * scale);
        assert_eq!(
            series.column(name),
            due.collect::<Vec<_>>(),
            "{name} of {path}"
        );
    }
    errors_are_differences(&series);
    series
}

#[track_caller]
fn errors_are_differences(series: &Series) {
    let errors: Vec<_> = series
        .names
        .iter()
        .filter(|name| name.contains("_error_"))
        .collect();
    assert!(!errors.is_empty(), "{:?}", series.names);
    for error in errors {
        let [commanded, actual] =
            ["_commanded_", "_actual_"].map(|of| series.column(&error.replace("_error_", of)));
        let due = commanded
            .iter()
            .zip(&actual)
            .map(|(commanded, actual)| commanded - actual);
        assert_eq!(series.column(error), due.collect::<Vec<_>>(), "{error}");
    }
}

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

#[test]
fn both_formats_have_the_same_numbers() {
    let bench = Bench::with("d.hpgl", DIAGONAL);
    let run = [&["run", "d.hpgl", "--no-vcd"], &SHORT[..], &["--series"]].concat();
    bench.succeed(&[&run[..], &["s.csv"]].concat());
    bench.succeed(&[&run[..], &["s.npy"]].concat());
    let csv = Series::csv(&bench.read("s.csv"));
    assert!(csv.rows.len() > 50);
    assert_eq!(
        Series::npy(&std::fs::read(bench.path("s.npy")).unwrap()),
        csv
    );
}

#[test]
fn a_window_and_a_distance_choose_the_rows() {
    let bench = Bench::with("l.hpgl", LINE);
    let run = [&["l.hpgl", "--no-vcd"], &SHORT[..]].concat();
    let rows = |more: &[&str]| series(&bench, &[&run[..], more].concat());
    let (some, _) = rows(&["--from", "1003", "--to", "1100", "--series-every", "25"]);
    assert_eq!(some.ticks(), [1003, 1028, 1053, 1078]);
    let (unit, _) = rows(&["--from", "1000", "--to", "2500"]);
    assert_eq!(unit.ticks(), [1499, 1999, 2499]);
    // Without an end all rows are there, however few ticks the waves have.
    let (all, summary) = rows(&["--set", "vcd_ticks=10", "--series-every", "1"]);
    assert_eq!(all.rows.len() as i64, whole(&summary, "/ticks"));
    let run = [
        "l.hpgl",
        "--set",
        "circuit=linear_interpolator",
        "--no-vcd",
        "--series-every",
        "7",
    ];
    let (linear, summary) = series(&bench, &run);
    let ticks: Vec<_> = (0..whole(&summary, "/ticks") as u64).step_by(7).collect();
    assert_eq!(linear.ticks(), ticks);
}

#[test]
fn the_file_is_named_with_the_others_or_not_left() {
    let bench = Bench::with("l.hpgl", LINE);
    let run = [&["run", "l.hpgl", "--no-vcd"], &SHORT[..]].concat();
    let summary = bench.json(&[&run[..], &["--series", "deep/er/s.NPY"]].concat());
    assert_eq!(paths(&summary), json!(["deep/er/s.NPY", "waves/l.svg"]));
    let bytes = std::fs::metadata(bench.path("deep/er/s.NPY"))
        .unwrap()
        .len();
    assert_eq!(whole(&summary, "/files/0/bytes"), bytes as i64);
    // Each directory knows its own files, and `clean` of another leaves them.
    bench.succeed(&[&run[..], &["--series", "waves/s.csv"]].concat());
    std::fs::copy(bench.path("deep/er/s.NPY"), bench.path("waves/s.NPY")).unwrap();
    let times = std::fs::metadata(bench.path("deep/er/s.NPY")).unwrap();
    let copy = std::fs::File::options()
        .append(true)
        .open(bench.path("waves/s.NPY"))
        .unwrap();
    copy.set_modified(times.modified().unwrap()).unwrap();
    bench.succeed(&["clean", "waves", "--yes"]);
    let left = [
        "deep/",
        "deep/er/",
        "deep/er/s.NPY",
        "l.hpgl",
        "waves/",
        "waves/s.NPY",
    ];
    assert_eq!(bench.names(), left);
    bench.succeed(&["clean", "deep/er", "--yes"]);
    let left = ["deep/", "deep/er/", "l.hpgl", "waves/", "waves/s.NPY"];
    assert_eq!(bench.names(), left);
    // However the directory of the waves is spelled.
    bench.succeed(&[&run[..], &["--series", "./waves/t.csv"]].concat());
    bench.succeed(&["clean", "waves", "--yes"]);
    assert_eq!(bench.names(), left);
}

#[test]
fn series_that_cannot_be_had_are_refused() {
    let bench = Bench::with("l.hpgl", LINE);
    bench.write("log.csv", "time,counts\n0,0\n1,1\n");
    let run = ["run", "l.hpgl", "--no-vcd"];
    let refuse = |more: &[&str], text: &str| {
        bench.refuse_with(&[&run[..], more].concat(), |stderr| {
            assert_eq!(stderr.lines().next(), Some(&*format!("error: {text}")));
        });
    };
    for name in ["s.txt", "csv", "s"] {
        let text = format!(
            "invalid value '{name}' for '--series <FILE>': allowed: a file with the extension \
             .csv or .npy"
        );
        refuse(&["--series", name], &text);
    }
    refuse(
        &["--series", "s.csv", "--series-every", "0"],
        "invalid value '0' for '--series-every <TICKS>': 0 is not in 1..18446744073709551615",
    );
    refuse(
        &["--series-every", "5"],
        "the following required arguments were not provided:",
    );
    refuse(
        &["--series", "s.csv", "--from", "100000000"],
        "--from: is 100000000; allowed: 0 to 542000, the last tick of the run",
    );
    bench.refuse_with(
        &[
            "run",
            "l.hpgl",
            "--series",
            "s.csv",
            "--waves-of",
            "pulse_interpolator",
        ],
        |stderr| {
            let text = "error: the argument '--series <FILE>' cannot be used with '--waves-of";
            assert!(stderr.starts_with(text), "{stderr}");
        },
    );
    let log = bench.path("log.csv").canonicalize().unwrap();
    bench.refuse(
        &["run", "log.csv", "--series", "./log.csv"],
        &format!(
            "--series: {} is the input; allowed: another file",
            log.display()
        ),
    );
    std::fs::copy(bench.path("l.hpgl"), bench.path("l.svg")).unwrap();
    let drawing = bench.path("l.svg").canonicalize().unwrap();
    bench.refuse(
        &[
            "run",
            "l.svg",
            "--input-format",
            "hpgl",
            "--no-vcd",
            "--out",
            ".",
        ],
        &format!(
            "--out: {} is the input; allowed: another file",
            drawing.display()
        ),
    );
    bench.refuse(
        &["run", "l.hpgl", "--no-vcd", "--series", "l.hpgl/s.csv"],
        "--series: l.hpgl: File exists (os error 17); allowed: a file that can be written",
    );
}
