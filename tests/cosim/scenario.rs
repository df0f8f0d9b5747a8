//! A whole job: the inputs of a run, applied to the Verilog that the run wrote beside its waves.

use super::tools::{Simulator, complete};
use assert_cmd::Command;
use motion_rtl::circuits::pulse_interpolator::{Group, Groups, Variant, Widths};
use motion_rtl::hdl::{Circuit, Declarations};
use std::fs;
use std::path::Path;

/// Runs a shipped scenario, and its Verilog with the same inputs, in Icarus: Verilator compiles a
/// wave of each of the memory's thousands of words, and looks at them all in every tick.
fn hold(scenario: &str, sets: &[&str]) {
    let group = Group::new(2, Widths::default(), Variant::Safe, 1);
    of(&group, scenario, sets, 9);
}

/// Checks a scenario of a circuit of `count` modules.
fn of<C: Circuit>(circuit: &C, scenario: &str, sets: &[&str], count: usize) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    Command::new(env!("CARGO_BIN_EXE_motion-rtl"))
        .arg("run")
        .arg(root.join(format!("waves/{scenario}.toml")))
        .args(["--verilog", "--out"])
        .arg(path)
        .args(sets.iter().flat_map(|set| ["--set", set]))
        .assert()
        .success();
    let name = C::NAME;
    let golden = path.join(format!("{name}.vcd"));
    fs::rename(path.join(format!("{scenario}.vcd")), golden).unwrap();
    let modules: Vec<String> = fs::read_dir(path)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|file| file.ends_with(".v") && !file.ends_with("_tb.v"))
        .collect();
    assert_eq!(modules.len(), count, "{modules:?}");
    let stimulus = fs::read_to_string(path.join(format!("{name}.stimulus"))).unwrap();
    let ticks = stimulus.lines().count() as u64;
    let report = Simulator::Icarus.hold(path, name, &modules);
    complete(&report, ticks, Declarations::of(circuit).leaves.len());
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn the_bracket_is_the_same_in_icarus() {
    hold("bracket", &[]);
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn the_rosette_at_a_slower_clock_is_the_same_in_icarus() {
    hold(
        "rosette",
        &[
            "clock_hz=20000",
            "line_unit_ticks=100",
            "arc_unit_ticks=100",
            "step_high_ticks=1",
            "step_low_ticks=1",
            "dir_setup_ticks=1",
            "dir_hold_ticks=1",
        ],
    );
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn two_groups_are_the_same_in_icarus() {
    let groups = Groups {
        first_axes: 2,
        second_axes: 2,
        widths: Widths::default(),
        variant: Variant::Safe,
        periods: [1; 2],
        memories: [Vec::new(), Vec::new()],
    };
    // The ring takes three times as long.
    let short = r#"group=[{play=["stroke"]},{play=["stroke"],command_tick=1234}]"#;
    of(&groups, "groups", &[short], 10);
}
