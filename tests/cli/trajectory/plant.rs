//! Motors and loads in the waves of a run.

use super::super::support::words;
use super::*;

const TOP: &str = "trajectory_controller";

/// A quarter of a circle with a soft shaft, from which the motor twists a count and more.
fn soft() -> Bench {
    let soft = MACHINE.replace(
        "mm_per_rev = 10",
        "mm_per_rev = 10\ndamping_nm_s_per_rad = 0.1",
    );
    let arc = "[[piece]]\nvia_mm = [3, 1, 0]\nto_mm = [4, 4, 0]\n";
    with(&format!("{arc}[machine]\n{soft}"))
}

/// Signals of an axis: encoder, counter, and what stands beside the circuit.
fn of_axis(axis: &str) -> Vec<String> {
    let own = ["a", "b", "position"].map(|name| format!("{TOP}.{name}_{axis}"));
    let plant = ["position", "load_position", "twist", "torque", "speed"];
    let plant = plant.map(|name| format!("{TOP}.plant.{axis}.{name}"));
    own.into_iter().chain(plant).collect()
}

/// Their words in the ticks that the dump has.
fn read(bench: &Bench, axis: &str) -> Vec<Vec<i64>> {
    let wanted = of_axis(axis);
    let wanted: Vec<&str> = wanted.iter().map(String::as_str).collect();
    words(&bench.read("o/s.vcd"), &wanted)
}

/// Runs it with these signals of both axes in the waves.
fn run(bench: &Bench, more: &[&str]) -> Value {
    let only: Vec<String> = ["x", "y"].into_iter().flat_map(of_axis).collect();
    let only = only.iter().flat_map(|name| ["--only", name.as_str()]);
    let all: Vec<&str> = ["run", "s.toml", "--out", "o"]
        .into_iter()
        .chain(only)
        .collect();
    bench.json(&[&all, more].concat())
}

#[test]
#[ignore = "takes long"]
fn they_move_as_the_summary_says() {
    let bench = soft();
    let summary = run(&bench, &[]);
    let row = of(&summary, "vector");
    let axes = ["x", "y"].map(|axis| read(&bench, axis));
    for (k, ticks) in axes.iter().enumerate() {
        assert_eq!(ticks.len() as i64, whole(&summary, "/ticks"));
        let (mut quarters, mut torque, mut twisted) = (0, 0, 0);
        for (tick, words) in ticks.iter().enumerate() {
            let [a, b, counted, position, load, twist, driven, _] = words[..] else {
                panic!("eight words");
            };
            // The levels of the encoder are those of the position in the same tick, but for the
            // rounding of the wave to 1/256 of a count.
            let quarter = (position + 128).div_euclid(256);
            if (position + 128).rem_euclid(256).abs_diff(128) < 126 {
                let levels = [[0, 0], [1, 0], [1, 1], [0, 1]][quarter.rem_euclid(4) as usize];
                assert_eq!([a, b], levels, "{tick}: {position}");
                quarters += 1;
            }
            assert!((counted - quarter).abs() <= 1, "{tick}: {counted}");
            // 10,000 counts a turn.
            let ahead = twist as f64 * 1e-6 * 10_000.0 / TAU * 256.0;
            near((position - load) as f64, ahead, 2.0);
            torque = torque.max(driven.abs());
            twisted = twisted.max((position - load).abs());
        }
        assert!(quarters > ticks.len() * 9 / 10, "{quarters}");
        // Two thirds of 1.5 N·m on 200 N·m/rad.
        assert!(twisted > 256, "{twisted}");
        let most = number(row, &format!("/axes/{k}/torque_max_nm"));
        near(torque as f64, most * 1e3, 0.51);
        let end = whole(row, &format!("/axes/{k}/end_position"));
        near(ticks.last().unwrap()[3] as f64 / 256.0, end as f64, 1.0);
        // Speeds are what positions change by, over a period of 400 ticks.
        let fast = ticks.len() / 2..ticks.len() - 400;
        for tick in fast.step_by(400) {
            let way = (ticks[tick + 1][3] - ticks[tick][3]) as f64 / 256.0 * 400e3;
            near(ticks[tick][7] as f64, way, 2000.0);
        }
    }
    // The largest contour error of the loads is where it is said to be: beside the circle through
    // the three points.
    let tick = whole(row, "/load/at_tick") as usize;
    let [x, y] = [0, 1].map(|axis: usize| axes[axis][tick][4] as f64 / 256.0 / 1e3);
    let off = (x - 0.5).hypot(y - 3.5) - 12.5f64.sqrt();
    near(off.abs() * 1e3, number(row, "/load/contour_max_um"), 0.01);
}

/// The ticks before a window are gone over many at once.
#[test]
#[ignore = "takes long"]
fn they_are_the_same_in_a_window() {
    let bench = soft();
    run(&bench, &[]);
    let whole = ["x", "y"].map(|axis| read(&bench, axis));
    for (from, to) in [(1, 50), (60_123, 61_777), (0, 30_001)] {
        let [first, last] = [from, to].map(|tick: usize| tick.to_string());
        run(&bench, &["--from", &first, "--to", &last]);
        for (axis, whole) in ["x", "y"].into_iter().zip(&whole) {
            assert!(read(&bench, axis) == whole[from..to], "{axis} {from} {to}");
        }
    }
    // A scope for each axis.
    let only = [
        "--only",
        "trajectory_controller.plant",
        "--out",
        "o",
        "--to",
        "9",
    ];
    bench.json(&[&["run", "s.toml", "--set", "axes=3"], &only[..]].concat());
    let dump = bench.read("o/s.vcd");
    let scopes = ["plant", "x", "y", "z"].map(|scope| format!("$scope module {scope} $end"));
    assert!(scopes.iter().all(|scope| dump.contains(scope)), "{dump}");
}

/// What stands beside the circuit is not in its Verilog, nor in what goes into it.
#[test]
#[ignore = "takes long"]
fn its_verilog_has_none_of_them() {
    let bench = with(LINE);
    let only = ["--only", "trajectory_controller.plant"];
    let verilog = ["run", "s.toml", "--verilog", "--out", "o", "--to", "9"];
    bench.json(&[&verilog[..], &only].concat());
    let [module, testbench] = ["", "_tb"].map(|end| bench.read(&format!("o/{TOP}{end}.v")));
    assert!(!module.contains("plant") && !testbench.contains("plant"));
    let alone = with(LINE);
    alone.json(&["run", "s.toml", "--verilog", "--out", "o", "--no-vcd"]);
    for name in [
        format!("o/{TOP}.v"),
        format!("o/{TOP}_tb.v"),
        format!("o/{TOP}.stimulus"),
    ] {
        assert!(alone.read(&name) == bench.read(&name), "{name}");
    }
}
