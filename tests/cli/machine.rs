//! `run` of the machine: figures of a short drawing, files, what is complained of, refusals.

use super::support::{Bench, keys, list, number, paths, whole};
use serde_json::{Value, json};

/// 1 um a count, 1/40 mm a step; slow rates, for few ticks.
const HEAD: &str = "circuit = \"machine\"\ninput = \"p.ngc\"\nclock_hz = 160_000\n\
     unit_ticks = 800\nscan_ticks = 200\nck_ticks = 32\nsample_ticks = 400\n";

/// Servos that come to rest with that, and a short way of the pen.
const GAINS: &str = "position_gain_per_s = 16\nspeed_hz = 10\nintegral_ms = 75\n\
     pen_down_counts = 2000\n";

/// The pen goes down, draws a line and an arc, and comes back up and home.
const SHORT: &str = "G1 X1 F1500\nG3 X2 Y1 I0 J1\nG0 X0 Y0\n";

fn with(keys: &str, drawing: &str) -> Bench {
    let bench = Bench::with("s.toml", format!("{HEAD}{keys}"));
    bench.write("p.ngc", drawing);
    bench
}

#[test]
fn a_ramp_that_is_no_whole_number_of_scans_or_samples_is_told() {
    let warnings = |keys: &str| {
        let bench = with(&format!("{GAINS}{keys}"), "G1 X1 F1500\n");
        bench.json(&["run", "s.toml", "--no-vcd"])["warnings"].clone()
    };
    assert_eq!(warnings(""), json!([]));
    let rounded = [
        "acceleration_ms: 42 ms taken as 42.5 ms on lines (scan of 1.25 ms × 34)",
        "acceleration_ms: 42 ms taken as 40 ms on arcs (pair of Ts of 5 ms × 8)",
    ];
    assert_eq!(warnings("acceleration_ms = 42\n"), json!(rounded));
}

#[test]
fn both_machines_end_at_the_same_point() {
    let bench = with(GAINS, SHORT);
    let summary = bench.json(&["run", "s.toml", "--no-vcd"]);
    assert_eq!(
        keys(&summary),
        [
            "apart_um",
            "circuit",
            "clock_hz",
            "complaints",
            "end_mm",
            "ends",
            "exact",
            "files",
            "input",
            "left_by_correction",
            "lifts",
            "pieces",
            "pulses",
            "seconds",
            "settings",
            "ticks",
            "times",
            "unattainable_units",
            "vcd_window",
            "version",
            "warnings"
        ]
    );
    assert_eq!(summary["circuit"], "machine");
    assert_eq!(summary["input"], "p.ngc");
    assert_eq!(
        (&summary["exact"], &summary["complaints"]),
        (&json!(true), &json!([]))
    );
    assert_eq!(summary["vcd_window"], Value::Null);
    assert_eq!(paths(&summary), json!(["waves/s.svg"]));
    // To and fro: 2 mm of 40 steps in x, 1 mm in y.
    assert_eq!(summary["pulses"], json!([160, 80]));
    let ends = json!([
        {"what": "steppers", "mm": [0.0, 0.0], "position": [0, 0], "wanted": [0, 0], "unit": "steps"},
        {"what": "commands", "mm": [0.0, 0.0], "position": [0, 0], "wanted": [0, 0], "unit": "counts"},
        {"what": "encoders", "mm": [0.0, 0.0], "position": [0, 0], "wanted": [0, 0], "unit": "counts"},
    ]);
    assert_eq!(summary["ends"], ends);
    assert_eq!(number(&summary, "/apart_um"), 0.0);

    let pieces = list(&summary, "pieces");
    let kinds: Vec<_> = pieces
        .iter()
        .map(|row| (row["kind"].as_str(), whole(row, "/line")))
        .collect();
    assert_eq!(
        kinds,
        [(Some("line"), 1), (Some("arc"), 2), (Some("rapid"), 3)]
    );
    let lengths = [1.0, std::f64::consts::FRAC_PI_2, 5f64.sqrt()];
    for (row, length) in pieces.iter().zip(lengths) {
        assert!((number(row, "/length_mm") - length).abs() < 1e-6, "{row}");
        // Half a step of both axes, and what one unit time's table is off.
        assert!(number(row, "/steppers/um") < 40.0, "{row}");
        assert!(
            number(row, "/command_um") < 60.0 && number(row, "/load/um") < 60.0,
            "{row}"
        );
        assert!(
            number(row, "/steppers_s") < number(row, "/servos_s"),
            "{row}"
        );
        for machine in ["steppers", "load"] {
            let share = number(row, &format!("/{machine}/share_um"));
            let most = number(row, &format!("/{machine}/um"));
            assert!(share >= 0.0 && (most == 0.0 || share > most / 4.0), "{row}");
        }
    }
    // Along x everything is on the line but for the noise of the other motor: none.
    assert_eq!(number(&pieces[0], "/steppers/um"), 0.0);
    assert_eq!(pieces[0]["steppers"]["reason"], Value::Null);
    // Blends cut the arc's ends by more than rounding, less than (v ta)^2/8R at the wanted speed.
    let blend = number(&pieces[1], "/command_um");
    assert!(
        blend > 1.5 && blend < (25.0f64 * 0.02).powi(2) / 8.0 * 1e3,
        "{blend}"
    );
    let reason = pieces[1]["load"]["reason"].as_str().unwrap();
    assert!(["blend", "lag", "motor"].contains(&reason), "{reason}");

    let times = &summary["times"];
    let parts: f64 = ["moving_s", "settling_s", "waiting_s"]
        .iter()
        .map(|part| number(times, &format!("/{part}")))
        .sum();
    assert!((parts - number(times, "/servos_s")).abs() < 1e-9);
    assert!(number(times, "/servos_s") > number(times, "/steppers_s"));

    let lifts = list(&summary, "lifts");
    let steps: Vec<_> = lifts
        .iter()
        .map(|row| (row["pen"].as_str(), whole(row, "/line")))
        .collect();
    assert_eq!(steps, [(Some("down"), 1), (Some("up"), 3)]);
    for lift in lifts {
        assert!(
            whole(lift, "/completed_tick") > whole(lift, "/fired_tick"),
            "{lift}"
        );
        assert_eq!(number(lift, "/lead_ms"), 25.0);
        assert!(number(lift, "/learned_ms") > 25.0, "{lift}");
    }
}

#[test]
fn an_end_between_the_grids_is_the_nearest_of_both() {
    let bench = with(GAINS, "G1 X1.0104 F1500\n");
    let text = bench.succeed(&["run", "s.toml", "--no-vcd"]);
    let start = "p.ngc on machine: ";
    assert!(text.starts_with(start), "{text}");
    assert!(text.contains("s at 160000 Hz; unit time 800, scan 200, CK 32, Ts 400 ticks\n"));
    // 40.416 steps, 1010.4 counts.
    let end = "\
     end       x mm       y mm         x         y        
     job     1.0104     0.0000
steppers     1.0000     0.0000        40         0   steps
commands     1.0100     0.0000      1010         0  counts
encoders     1.0100     0.0000      1010         0  counts
both machines end on the step and the count nearest to the job's end, 10.000 um apart
";
    let end = end.replace("y        \n", "y\n");
    assert!(text.contains(&end), "{text}");
}

#[test]
fn the_files_of_a_run() {
    let bench = with(&format!("{GAINS}vcd_ticks = 20_000\n"), "G1 X0.5 F1500\n");
    let run = ["run", "s.toml", "--out", "o", "--verilog"];
    let summary = bench.json(&run);
    assert_eq!(summary["vcd_window"], json!([0, 20_000]));
    let names = bench.names();
    for name in [
        "o/s.vcd",
        "o/s.gtkw",
        "o/s.svg",
        "o/machine.v",
        "o/machine_tb.v",
        "o/machine.stimulus",
    ] {
        assert!(
            names.iter().any(|other| other == name),
            "no {name}: {names:?}"
        );
    }
    let svg = bench.read("o/s.svg");
    for words in [
        "s: machine",
        "steppers",
        "loads of the servos",
        "pen lift",
        "fire",
        "complete",
    ] {
        assert!(svg.contains(&format!("\n{words}\n")), "{words}");
    }
    let save = bench.read("o/s.gtkw");
    // GTKWave shows the waves over the whole width, which has 200 pixels in a unit of its zoom.
    let field = |name| {
        let mut fields = save.lines().filter_map(|line| line.strip_prefix(name));
        let field = fields.next().and_then(|rest| rest.split(' ').next());
        field
            .and_then(|number| number.parse::<f64>().ok())
            .expect(name)
    };
    let pane = 1600. - field("[sst_width] ") - field("[signals_width] ") - 100.;
    let shown_ns = 2f64.powf(-field("*")) * pane / 200.;
    assert_eq!(
        (field("[timestart] "), (shown_ns / 6250.).round()),
        (0., 20_000.)
    );
    let overview = save
        .split("-overview\n")
        .nth(1)
        .unwrap()
        .split("-ports in\n")
        .next()
        .unwrap();
    for signal in [
        "machine.enables.sample\n",
        "machine.step_x\n",
        "machine.brake\n",
        "machine.plant.lift.position[47:0]\n",
    ] {
        assert!(overview.contains(signal), "{signal}: {overview}");
    }
    let shown = overview.lines().filter(|line| line.contains("machine."));
    assert_eq!(shown.count(), 30, "{overview}");
    assert!(overview.contains("\n+{enables/sample} machine.enables.sample\n"));
    for group in [
        "enables",
        "pulse_interpolator",
        "linear_interpolator",
        "arc_generator",
        "command_join",
        "trajectory_controller",
        "lead_angle",
        "plant",
    ] {
        assert!(save.contains(&format!("\n-{group}\n")), "{group}");
    }
    let dump = bench.read("o/s.vcd");
    let scopes = [
        "machine",
        "pulse_interpolator",
        "trajectory_controller",
        "lead_angle",
        "plant",
    ];
    for scope in scopes {
        assert!(
            dump.contains(&format!("$scope module {scope} $end")),
            "{scope}"
        );
    }
}

/// The widened arc begins and ends beside the path, and the job goes on to its end.
#[test]
fn what_the_steady_correction_leaves_is_told() {
    let bench = with(&format!("{GAINS}correction = \"steady\"\n"), SHORT);
    let summary = bench.json(&["run", "s.toml", "--no-vcd"]);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(summary["left_by_correction"], json!([0, 0]));
    // A line up to an arc of 1 mm to the left of it, which is widened to the right.
    let pieces = list(&summary, "pieces");
    let left = |piece: usize| pieces[piece]["left_by_correction"].clone();
    let [x, y] = [0, 1].map(|axis| left(0)[axis].as_i64().unwrap());
    assert!(x == 0 && (-60..=-10).contains(&y), "{x} {y}");
    // At a joint the segment that begins is in force: the arc ends where the line home begins.
    assert_eq!((left(1), left(2)), (json!([0, 0]), json!([0, 0])));
    let text = bench.succeed(&["run", "s.toml", "--no-vcd"]);
    let said = format!(
        "\nleft by the correction: 0 and {y} counts at the end of piece 0, line 1, the most\n"
    );
    assert!(text.contains(&said), "{text}");

    // A job that ends on the arc ends beside it.
    let short = "G1 X1 F1500\nG3 X2 Y1 I0 J1\n";
    bench.write("p.ngc", short);
    let summary = bench.json(&["run", "s.toml", "--no-vcd"]);
    assert_eq!(
        (&summary["complaints"], &summary["exact"]),
        (&json!([]), &json!(true))
    );
    assert_eq!(summary["left_by_correction"], json!([-y, 0]));
    let encoders = list(&summary, "ends")[2].clone();
    assert_eq!(encoders["wanted"], json!([2000, 1000]));
    for (axis, wanted) in [(0, 2000 - y), (1, 1000)] {
        let position = encoders["position"][axis].as_i64().unwrap();
        assert!((position - wanted).abs() <= 1, "{encoders}");
    }
    let text = bench.succeed(&["run", "s.toml", "--no-vcd"]);
    let said = format!(
        "steppers and commands end on the step and the count nearest to the job's end; left by the \
         correction: {} and 0 counts\n",
        -y
    );
    assert!(text.contains(&said), "{text}");

    // The other corrections leave nothing.
    for correction in ["none", "vector"] {
        let set = format!("correction={correction}");
        let summary = bench.json(&["run", "s.toml", "--no-vcd", "--set", &set]);
        assert_eq!(summary["exact"], true);
        assert_eq!(summary["left_by_correction"], json!([0, 0]));
        for piece in list(&summary, "pieces") {
            assert_eq!(piece["left_by_correction"], json!([0, 0]));
        }
    }
}

#[test]
fn motors_that_do_not_come_to_rest_are_complained_of() {
    // A speed control faster than the shaft.
    let bench = with(
        "speed_hz = 60.0\nposition_gain_per_s = 100.0\n",
        "G1 X1 F1500\n",
    );
    let done = bench.run(&["run", "s.toml", "--no-vcd", "--json"]);
    assert_eq!(done.code, 1, "{}", done.stdout);
    let summary: Value = serde_json::from_str(&done.stdout).unwrap();
    assert_eq!(summary["exact"], false);
    let complaints = list(&summary, "complaints");
    let rest = "the servos did not come to rest in move 1 of 1, of piece 0 in line 1: at Ts = 2.500 ms \
                the gains may be too high; lower position_gain_per_s = 100, speed_hz = 60 or \
                sample_ticks = 400";
    assert!(complaints.iter().any(|text| text == rest), "{complaints:?}");
    assert!(done.stderr.contains(rest), "{}", done.stderr);
}

/// What the end of the run leaves undone is no fault of the steppers.
#[test]
fn steppers_that_are_cut_off_are_not_complained_of() {
    let bench = with(
        "speed_hz = 60.0\nposition_gain_per_s = 100.0\n",
        "G1 X1 F1500\nG1 X40 F150\n",
    );
    let done = bench.run(&["run", "s.toml", "--no-vcd", "--json"]);
    assert_eq!(done.code, 1, "{}", done.stdout);
    let summary: Value = serde_json::from_str(&done.stdout).unwrap();
    assert_eq!(summary["times"]["steppers_cut_off"], true);
    assert!(!done.stderr.contains("steppers"), "{}", done.stderr);
    let done = bench.run(&["run", "s.toml", "--no-vcd"]);
    let said = "steppers cut off by the end of the run; servos do not come to rest\n";
    assert!(done.stdout.contains(said), "{}", done.stdout);
}

#[test]
fn what_the_circuits_cannot_agree_on_is_refused() {
    let bench = with("", "G1 X1 F1500\nG1 X2 Y1 F1.5\n");
    // 1000 counts/mm, scans of 1.25 ms, 45 degrees.
    bench.refuse(
        &["run", "s.toml"],
        "p.ngc:2: F: at 1.5 mm/min the axis with the longer way goes too few counts in a scan; \
         allowed: at least 1.65729 mm/min in this direction, or a longer scan",
    );
    bench.refuse(
        &["run", "s.toml", "--set", "sample_ticks=409501"],
        "--set: sample_ticks: is 409501; allowed: up to 409500 at scan_ticks = 200: an arc's two \
         sampling times within 4095 scans",
    );
}

#[test]
fn bad_input_is_refused_with_its_line() {
    // The head has seven lines.
    let cases = [
        (
            "feed = 1",
            SHORT,
            "s.toml:8: feed: unknown key; did you mean feed_mm_per_min?; allowed: `motion-rtl keys machine` lists all",
        ),
        (
            "[lift]\nmass = 1",
            SHORT,
            "s.toml:9: mass: unknown key; allowed: one of `counts_per_rev`, ",
        ),
        (
            "[lift]\nfriction_nm = 1",
            SHORT,
            "s.toml:8: counts_per_rev: missing, and has no default; allowed: a number from 0.000000001 to 1000000000",
        ),
        (
            "lift_lead_ms = 25\n[lift]\ncounts_per_rev = 8000\nacceleration_counts_per_s2 = 6e5\n\
             inertia_kg_m2 = 0.02\nfriction_nm = -1\nbrake_dead_time_s = 0.012\n\
             brake_torque_nm = 4\nbrake_fade = 0",
            SHORT,
            "s.toml:13: lift.friction_nm: is -1; allowed: 0 to 2147483",
        ),
        (
            "steps_per_mm = [40, 0]",
            SHORT,
            "s.toml:8: steps_per_mm: is 0 for y; allowed: ",
        ),
        (
            "steps_per_mm = [1]",
            SHORT,
            "s.toml:8: steps_per_mm: invalid length 1; allowed: ",
        ),
        (
            "acceleration_ms = 1",
            SHORT,
            "s.toml:8: acceleration_ms: is 1; allowed: 5 to ",
        ),
        (
            "pen_down_counts = 0",
            SHORT,
            "s.toml:8: pen_down_counts: is 0; allowed: a position other than 0, where the pen is up",
        ),
        (
            "correction = \"feedback\"",
            SHORT,
            "s.toml:8: correction: is \"feedback\"; allowed: \"vector\", \"none\" or \"steady\": the \
             machine's commands come from elsewhere",
        ),
        (
            "lift_lead_ms = 25.01",
            SHORT,
            "s.toml:8: lift_lead_ms: is 25.01; allowed: 25 or 25.2",
        ),
        (
            "lift_counts_per_s = 15",
            SHORT,
            "s.toml:8: lift_counts_per_s: is 15; allowed: 10 to ",
        ),
        ("k1_per_s = 0", SHORT, "s.toml:8: k1_per_s: is 0: "),
        ("speed_hz = 1e6", SHORT, "s.toml:8: speed_hz: is 1000000: "),
        (
            "feed_mm_per_min = nan",
            SHORT,
            "s.toml:8: feed_mm_per_min: is NaN; allowed: 0.001 to 10000000",
        ),
        (
            "in_position_counts = 0",
            SHORT,
            "s.toml:8: in_position_counts: is 0; allowed: 1 to 1000000",
        ),
        (
            "counts_per_mm = 500",
            SHORT,
            "s.toml: machine.mm_per_rev: is 10, which gives 1000 counts per mm; allowed: 20, for 500 counts per mm as in counts_per_mm",
        ),
        (
            "",
            "G1 X1 F1500\nG1 Z1\n",
            "p.ngc:2: Z: leaves the plane of x and y by 1 mm; allowed: ",
        ),
        ("", "G1 X1 F1500\nG2 X2 Y1 I1 Z1\n", "p.ngc:2: "),
        ("", "G1 X1 F1500\nG2 X18001 I9000\n", "p.ngc:2: "),
        (
            "steps_per_mm = [1e9, 40]",
            "G1 X3 F1500\n",
            "p.ngc:1: X: is ",
        ),
    ];
    for (keys, drawing, refusal) in cases {
        let bench = with(&format!("{keys}\n"), drawing);
        let before = bench.names();
        let done = bench.run(&["run", "s.toml", "--no-vcd"]);
        let start = format!("error: {refusal}");
        assert!(
            done.stderr.starts_with(&start),
            "{keys}{drawing}: {}",
            done.stderr
        );
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{keys}");
        assert_eq!(bench.names(), before, "{keys}");
    }
    let bench = with("", SHORT);
    let least = "allowed: 400 to 16777215";
    for (set, refusal) in [
        ("sample_ticks=100", format!("sample_ticks: is 100; {least}")),
        (
            "unit_ticks=0",
            "unit_ticks: is 0; allowed: 2 to 196605".to_owned(),
        ),
        (
            "unit_ticks=1",
            "unit_ticks: is 1; allowed: 2 to 196605".to_owned(),
        ),
        (
            "ck_ticks=3",
            "ck_ticks: is 3; allowed: 4 to 16777215".to_owned(),
        ),
    ] {
        bench.refuse(
            &["run", "s.toml", "--set", set],
            &format!("--set: {refusal}"),
        );
    }
    // A lead is a whole number of CKs, and a code.
    bench.refuse(
        &["run", "s.toml", "--set", "ck_ticks=33"],
        "s.toml: lift_lead_ms: is 25; allowed: 24.95625 or 25.1625",
    );
    bench.refuse(
        &["run", "s.toml", "--segments", "--from", "9", "--to", "9"],
        "--from, --to: no tick from 9 to 9; allowed: --from below --to",
    );
    bench.refuse(
        &["table", "s.toml"],
        "s.toml:1: circuit: the machine has no table; allowed: pulse_interpolator, or the command run",
    );
}

/// An unlucky setting: what is to blame is named, with its value.
#[test]
fn what_was_too_fast_or_late_names_its_keys() {
    let bench = Bench::new();
    let run = ["run", "waves/machine.toml", "--no-vcd", "--out", "o"];
    let done = bench.run(&[&run[..], &["--set", "speed_hz=400"]].concat());
    let text = "error: fault: the encoder of a servo was too fast; raise clock_hz = 160000, or lower \
                counts_per_mm = 1000, feed_mm_per_min = 1500, rapid_mm_per_min = 3000 or, where the \
                servo swings, position_gain_per_s = 16 or speed_hz = 400\n";
    assert!(done.stderr.starts_with(text), "{}", done.stderr);
    assert_eq!(done.code, 1);
}
