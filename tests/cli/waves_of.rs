//! `run --waves-of`: every system that a summary names, with its waves; and last values of waves and
//! summary.

use super::beside::{bench, runs};
use super::support::{Bench, LINE, SHORT, list, paths, whole, words};
use serde_json::{Value, json};

/// Name on the command line of a name of a summary.
fn key(name: &str) -> String {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric());
    let words: Vec<_> = words.filter(|word| !word.is_empty()).collect();
    words.join("_").to_lowercase()
}

/// The first column of a summary's table.
fn names(summary: &Value, rows: &str) -> Vec<String> {
    let names = list(summary, rows).iter().map(|row| {
        let full_feed = row["full_feed"] == true;
        let name = ["name", "circuit", "correction", "method"].map(|key| row[key].as_str());
        let name = name.into_iter().flatten().next().unwrap();
        match full_feed {
            true => "vector_full_feed".to_owned(),
            false => key(name),
        }
    });
    names.collect()
}

#[test]
#[ignore = "takes long"]
fn every_system_that_a_summary_names_can_be_had() {
    let bench = bench();
    for (arguments, rows, [_, compared]) in runs() {
        let run = [&["run"], &arguments[..], &["--out", "o"]].concat();
        let mut all = vec!["interpolator", "interpolator_master_x"]
            .into_iter()
            .chain(["conventional_same_settings", "conventional_in_proportion"])
            .map(str::to_owned)
            .collect();
        if !rows.is_empty() {
            let summary = bench.json(&[&run[..], &["--beside", "--no-vcd"]].concat());
            all = names(&summary, rows);
            assert_eq!(all.len(), compared);
            if rows == "circuits" && summary["speed_changes"].is_array() {
                all.extend(names(&summary, "speed_changes"));
            }
        }
        let stem = arguments[0].split('.').next().unwrap();
        for name in all {
            let more = ["--waves-of", &name, "--to", "3000", "--out", "w"];
            let summary = bench.json(&[&run[..run.len() - 2], &more].concat());
            let files = ["vcd", "gtkw"].map(|end| format!("w/{stem}_{name}.{end}"));
            assert_eq!(paths(&summary), json!(files), "{arguments:?} {name}");
            assert_eq!(key(summary["system"].as_str().unwrap()), name);
            let save = bench.read(&files[1]);
            let dump = format!("[dumpfile] \"{stem}_{name}.vcd\"");
            assert!(save.contains(&dump), "{save}");
            let overview = save.split("-overview\n").nth(1).unwrap();
            let overview = overview.split("-ports in\n").next().unwrap();
            assert!(overview.matches('.').count() >= 8, "{name}: {overview}");
        }
    }
}

#[test]
fn what_ships_is_listed_with_its_systems() {
    let bench = Bench::new();
    let listing = bench.json(&["list"]);
    let systems = |name: &str| {
        let file = format!("waves/{name}.toml");
        let mut all = list(&listing, "scenarios").iter();
        all.find(|one| one["file"] == file).unwrap()["systems"].clone()
    };
    assert_eq!(systems("machine"), json!(["machine"]));
    assert_eq!(systems("patterns"), json!(["pulse_interpolator"]));
    let both = ["pulse_interpolator", "conventional_pulse_interpolator"];
    assert_eq!(systems("bracket"), json!(both));
    assert_eq!(
        systems("circle"),
        json!(["none", "steady", "feedback", "vector"])
    );
    let turntable = "no_lead displaced_switch by_speed tuned by_table fixed_lead learning \
                     second_order exact_relation literal_sign";
    let turntable: Vec<_> = turntable.split(' ').collect();
    assert_eq!(systems("turntable"), json!(turntable));
    let weld = [
        "patent",
        "arc_generator",
        "conventional",
        "conventional_without_ramps",
    ];
    assert_eq!(
        systems("weld"),
        json!([&weld[..], &["conventional_generator"]].concat())
    );
    let plotter = ["interpolator", "interpolator_master_x"];
    let ways = ["conventional_same_settings", "conventional_in_proportion"];
    assert_eq!(systems("plotter"), json!([plotter, ways].concat()));
    let text = bench.succeed(&["list"]);
    assert!(
        text.contains("    waves of  none, steady, feedback, vector\n"),
        "{text}"
    );
}

#[test]
fn a_system_that_there_is_not_is_refused_with_those_that_there_are() {
    let bench = bench();
    let run = ["run", "path.toml", "--waves-of", "best"];
    let allowed = "none, steady, feedback, vector, vector_full_feed";
    let text = format!("--waves-of: path has no system best; allowed: {allowed}");
    bench.refuse(&run, &text);
    // Without a tolerance there is no other feed.
    bench.write(
        "free.toml",
        "circuit = \"trajectory_controller\"\nfeed_mm_per_min = 600\n[[piece]]\nto_mm = [1, 0, 0]\n",
    );
    let run = ["run", "free.toml", "--waves-of", "vector_full_feed"];
    let text = "--waves-of: free has no system vector_full_feed; allowed: none, steady, feedback, \
                vector";
    bench.refuse(&run, text);
    for other in ["--no-vcd", "--beside", "--segments"] {
        let run = ["run", "path.toml", "--waves-of", "none", other];
        bench.refuse_with(&run, |stderr| {
            let text = "error: the argument '--waves-of <NAME>' cannot be used with";
            assert!(stderr.starts_with(text), "{stderr}");
        });
    }
    bench.refuse_with(
        &[
            "run",
            "path.toml",
            "--waves-of",
            "none",
            "--from",
            "9999999",
        ],
        |stderr| {
            assert!(
                stderr.starts_with("error: --from: is 9999999; "),
                "{stderr}"
            );
        },
    );
}

#[test]
fn it_is_played_though_nothing_is_compared_and_its_files_stand_beside_the_others() {
    let bench = bench();
    let run = ["run", "path.toml", "--out", "o"];
    bench.succeed(&[&run[..], &["--to", "900"]].concat());
    let others = bench.names();
    let more = [
        "--waves-of",
        "steady",
        "--format",
        "fst",
        "--verilog",
        "--plan",
    ];
    let window = [
        "--from",
        "100",
        "--to",
        "900",
        "--only",
        "trajectory_controller.x",
    ];
    let summary = bench.json(&[&run[..], &more, &window].concat());
    assert_eq!(summary["vcd_window"], json!([100, 900]));
    let mut new = bench.names();
    new.retain(|name| !others.contains(name));
    for name in [
        "path_steady.fst",
        "path_steady.gtkw",
        "path_steady.plan.txt",
    ] {
        assert!(new.contains(&format!("o/{name}")), "{new:?}");
    }
    for name in ["trajectory_controller.v", "trajectory_controller.stimulus"] {
        assert!(new.contains(&format!("o/{name}")), "{new:?}");
    }
}

/// Last value of each of some signals in a dump, without the circuit's name.
fn last(bench: &Bench, file: &str, circuit: &str, signals: &[&str]) -> Vec<i64> {
    let paths: Vec<_> = signals
        .iter()
        .map(|signal| format!("{circuit}.{signal}"))
        .collect();
    let paths: Vec<_> = paths.iter().map(String::as_str).collect();
    words(&bench.read(file), &paths).pop().unwrap()
}

/// Steps of X and Y that a driver counts in a dump.
fn steps(bench: &Bench, file: &str, circuit: &str) -> [i64; 2] {
    let names = ["step_x", "dir_x", "step_y", "dir_y"];
    let paths = names.map(|name| format!("{circuit}.{name}"));
    let ticks = words(&bench.read(file), &paths.each_ref().map(String::as_str));
    [0, 2].map(|axis| {
        let rises = ticks
            .windows(2)
            .filter(|pair| pair[0][axis] < pair[1][axis]);
        rises.map(|pair| 1 - 2 * pair[1][axis + 1]).sum()
    })
}

/// The end of a system by its own summary.
fn end(summary: &Value, axes: &[&str]) -> Vec<i64> {
    axes.iter()
        .map(|axis| whole(summary, &format!("/end_position/{axis}")))
        .collect()
}

#[test]
#[ignore = "takes long"]
fn the_last_values_of_the_waves_are_those_of_the_summary() {
    let bench = bench();
    let all =
        |arguments: &[&str]| bench.json(&[&["run"], arguments, &["--to", "9000000"]].concat());
    let [pulse, linear, ..] = &runs()[..] else {
        panic!("runs");
    };

    let summary = all(&pulse.0);
    let ends = ["x", "y"].map(|axis| whole(&summary["axes"][axis], "/end_position"));
    assert_eq!(steps(&bench, "waves/l.vcd", "pulse_interpolator"), ends);
    let device = "conventional_pulse_interpolator";
    let summary = all(&[&pulse.0[..], &["--waves-of", device]].concat());
    assert_eq!(end(&summary, &["x", "y"]), ends);
    assert_eq!(
        steps(&bench, &format!("waves/l_{device}.vcd"), device),
        ends
    );

    let commands = ["command_x", "command_y"];
    let summary = all(&linear.0);
    let ends = list(&summary["interpolator"], "end_position");
    assert_eq!(
        json!(last(&bench, "waves/l.vcd", "controller", &commands)),
        json!(ends)
    );
    let name = "conventional_same_settings";
    let summary = all(&[&linear.0[..], &["--waves-of", name]].concat());
    let file = format!("waves/l_{name}.vcd");
    let found = last(&bench, &file, "conventional_controller", &commands);
    assert_eq!(found, end(&summary, &["x", "y"]));
    assert_eq!(json!(found), json!(ends));

    let summary = all(&["arc.toml"]);
    let axes = ["x", "y", "z"];
    let found = last(&bench, "waves/arc.vcd", "arc_generator", &axes);
    assert_eq!(json!(found), summary["end_position"]);
    let summary = all(&["arc.toml", "--waves-of", "conventional_without_ramps"]);
    let file = "waves/arc_conventional_without_ramps.vcd";
    assert_eq!(
        last(&bench, file, "conventional_generator", &axes),
        end(&summary, &axes)
    );
    assert_eq!(end(&summary, &axes), found);

    let motors = ["position_x", "position_y"];
    let summary = all(&["path.toml", "--beside"]);
    let ends = |row: &Value| {
        let axes = list(row, "axes").iter();
        axes.map(|axis| whole(axis, "/end_position"))
            .collect::<Vec<_>>()
    };
    let rows = list(&summary, "corrections").iter();
    let rows: Vec<_> = rows.map(ends).collect();
    let found = last(&bench, "waves/path.vcd", "trajectory_controller", &motors);
    assert_eq!(found, rows[3]);
    for (name, row) in [("none", 0), ("steady", 1), ("vector_full_feed", 4)] {
        let summary = all(&["path.toml", "--waves-of", name]);
        let file = format!("waves/path_{name}.vcd");
        let found = last(&bench, &file, "trajectory_controller", &motors);
        assert_eq!(
            (&end(&summary, &["x", "y"]), &found),
            (&rows[row], &rows[row]),
            "{name}"
        );
    }

    let summary = all(&["steps.toml", "--beside"]);
    let row = list(&summary, "positionings").last().unwrap().clone();
    let errors = list(&row, "error_counts");
    // It has come down to 0.
    let error = |system: usize| -errors[system].as_i64().unwrap();
    let found = last(&bench, "waves/steps.vcd", "compensator", &["position"]);
    assert_eq!(found, [error(6)]);
    for (name, system) in [
        ("no_lead", 0),
        ("displaced_switch", 1),
        ("tuned", 3),
        ("by_table", 4),
    ] {
        let summary = all(&["steps.toml", "--waves-of", name]);
        let circuit = summary["circuit"].as_str().unwrap();
        let file = format!("waves/steps_{name}.vcd");
        let found = last(&bench, &file, circuit, &["position"]);
        assert_eq!(
            (found, end(&summary, &["position"])),
            (vec![error(system)], vec![error(system)])
        );
    }
}

#[test]
fn motors_and_arms_stand_beside_the_conventional_circuits_too() {
    let motor = "[motor]\nholding_torque_nm = 1\ninertia_kg_m2 = 2e-5\ndamping_nm_s = 5e-3\n";
    let bench = Bench::with(
        "m.toml",
        format!("circuit = \"pulse_interpolator\"\ninput = \"l.hpgl\"\n{motor}"),
    );
    bench.write("l.hpgl", LINE);
    let device = "conventional_pulse_interpolator";
    let run = ["run", "m.toml", "--waves-of", device];
    let summary = bench.json(&[&run[..], &SHORT].concat());
    let file = format!("waves/m_{device}.vcd");
    let position = last(&bench, &file, device, &["plant.x.position"])[0] as f64;
    // In units of 2^-8 step, and swinging by less than two steps yet.
    let off = position / 256.0 - whole(&summary, "/end_position/x") as f64;
    assert!(off.abs() < 2.0 && position > 2e5, "{position}");

    let summary = bench.json(&[
        "run",
        "waves/joint.toml",
        "--waves-of",
        "conventional",
        "--to",
        "100",
    ]);
    assert_eq!(summary["circuit"], "conventional_generator");
    let weld = [
        "run",
        "waves/weld.toml",
        "--waves-of",
        "conventional",
        "--to",
        "900",
    ];
    bench.succeed(&weld);
    let joints = ["arm.base", "arm.shoulder", "arm.elbow"];
    let found = last(
        &bench,
        "waves/weld_conventional.vcd",
        "conventional_generator",
        &joints,
    );
    let own = bench.succeed(&["run", "waves/weld.toml", "--to", "3"]);
    assert!(!own.is_empty());
    // The hand has gone by less than a millimetre from where the path begins.
    let begin = last(&bench, "waves/weld.vcd", "arc_generator", &joints);
    for (found, begin) in found.iter().zip(begin) {
        assert!(
            found.abs_diff(begin) < 20_000 && begin != 0,
            "{found} {begin}"
        );
    }
}

/// X and Y at the end of every unit time of a dump of the conventional device, and the latest T.
fn ends_of_units(bench: &Bench, file: &str) -> Vec<[i64; 2]> {
    let names = ["step_x", "dir_x", "step_y", "dir_y", "unit_rst", "busy"];
    let paths = names.map(|name| format!("conventional_pulse_interpolator.{name}"));
    let ticks = words(&bench.read(file), &paths.each_ref().map(String::as_str));
    let (mut at, mut ends) = ([0; 2], Vec::new());
    let mut before = vec![0; names.len()];
    for row in ticks {
        for (axis, at) in at.iter_mut().enumerate() {
            if before[2 * axis] < row[2 * axis] {
                *at += 1 - 2 * row[2 * axis + 1];
            }
        }
        if row[4] == 1 && row[5] == 1 {
            ends.push(at);
        }
        before = row;
    }
    ends
}

#[test]
fn an_arc_is_one_move_of_the_conventional_device() {
    let bench = Bench::new();
    let run = [
        "run",
        "waves/arc.toml",
        "--waves-of",
        "conventional_pulse_interpolator",
    ];
    let summary = bench.json(&run);
    assert_eq!(end(&summary, &["x", "y"]), [0, 0]);
    let file = "waves/arc_conventional_pulse_interpolator.vcd";
    let ends = ends_of_units(&bench, file);
    // 30 pi mm at 30 mm/s, in unit times of 5 ms.
    assert_eq!(
        ends.len(),
        (1000.0 * std::f64::consts::PI / 5.0f64).ceil() as usize
    );
    for (unit, end) in ends.iter().enumerate() {
        let angle = (unit + 1) as f64 * std::f64::consts::TAU / ends.len() as f64;
        let exact = [600.0 * angle.cos() - 600.0, 600.0 * angle.sin()];
        let off = [0, 1].map(|axis| (end[axis] as f64 - exact[axis]).abs());
        assert!(off.iter().all(|off| *off < 0.75), "{unit}: {off:?}");
    }
    // One order, and the amounts are made by the circuit.
    let ticks = words(
        &bench.read(file),
        &["conventional_pulse_interpolator.command"],
    );
    assert_eq!(ticks.iter().filter(|row| row[0] == 1).count(), 1);
    let save = bench.read("waves/arc_conventional_pulse_interpolator.gtkw");
    assert!(save.contains("interpolator.state"), "{save}");
}

#[test]
fn lines_and_arcs_are_moves_of_the_conventional_device() {
    let bench = Bench::new();
    let summary = bench.json(&["run", "waves/link.toml", "--no-vcd"]);
    assert_eq!(summary["exact"], true);
    assert_eq!(summary["complaints"], json!([]));
    let device = &list(&summary, "circuits")[1];
    assert_eq!(whole(device, "/late_units"), 0);
    let error = device["end_error_steps_max"].as_f64().unwrap();
    assert!(error > 0.0 && error < 1.5, "{error}");
    let run = [
        "run",
        "waves/link.toml",
        "--waves-of",
        "conventional_pulse_interpolator",
    ];
    let summary = bench.json(&run);
    assert_eq!(end(&summary, &["x", "y"]), [0, 0]);
    let ends = ends_of_units(&bench, "waves/link_conventional_pulse_interpolator.vcd");
    assert_eq!(ends.len() as i64, whole(device, "/units"));
    // By hand: corners of the link, and the far side of the eye.
    for corner in [[800, 0], [800, 800], [0, 800], [0, 0], [120, 400]] {
        assert!(ends.contains(&corner), "{corner:?}");
    }
    let eye = ends
        .iter()
        .filter(|[x, y]| (x * x + (y - 400) * (y - 400) - 120 * 120).abs() < 240);
    assert!(eye.count() > 100);
}

#[test]
fn moves_that_the_conventional_device_has_not_are_refused() {
    let head =
        "circuit = \"pulse_interpolator\"\ninput = \"m.ngc\"\nconventional_moves = \"pieces\"\n";
    let device = "conventional_pulse_interpolator";
    let run = ["run", "m.toml", "--waves-of", device, "--out", "new"];
    let refused = |keys: &str, drawing: &str, text: &str| {
        let bench = Bench::with("m.toml", format!("{head}{keys}"));
        bench.write("m.ngc", drawing);
        bench.refuse_with(&run, |stderr| {
            assert!(stderr.starts_with(&format!("error: {text}")), "{stderr}");
        });
    };
    let way = "m.ngc:1: path: is a move with a way of 80000 steps; allowed: up to 65535";
    refused("", "G1 X1000 F600\n", way);
    let helix = "m.ngc:1: path: is an arc that moves in Z too; allowed: arcs in the X-Y plane";
    refused("", "G2 X2 Y0 Z1 I1 J0 F600\n", helix);
    let scales = "m.toml:4: steps_per_mm: of X and Y differ, and the conventional device is given \
                  arcs; allowed: the same of both";
    refused("steps_per_mm = [80, 40]\n", "G2 X2 Y0 I1 J0 F600\n", scales);
}
