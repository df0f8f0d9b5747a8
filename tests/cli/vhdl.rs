//! `vhdl`: its files, and its refusals.

use super::support::{Bench, without_sizes};

const TESTBENCH: [&str; 6] = ["--width", "4", "--testbench", "200", "--out", "v"];

fn vhdl<'a>(circuit: &'a str, arguments: &[&'a str]) -> Vec<&'a str> {
    [&["vhdl", circuit], arguments].concat()
}

#[test]
fn an_entity_each_is_written_and_named() {
    let bench = Bench::new();
    let said = bench.succeed(&vhdl("unit_law", &["--width", "4", "--out", "a"]));
    let files = [
        "a/unit_time_register.vhd",
        "a/enable_counter.vhd",
        "a/pulse_generator.vhd",
        "a/sync_stage.vhd",
        "a/unit_law.vhd",
        "a/unit_law_names.toml",
        "a/unit_law_vhdl.f",
    ];
    let named = without_sizes(&said);
    let named: Vec<&str> = named.lines().collect();
    let own: Vec<&str> = files
        .into_iter()
        .filter(|file| named.contains(file))
        .collect();
    assert_eq!(own, named, "in the order of analysis");
    let list = bench.read("a/unit_law_vhdl.f");
    let modules = named.iter().filter(|file| file.ends_with(".vhd"));
    let modules: String = modules.map(|file| format!("{}\n", &file[2..])).collect();
    assert_eq!(
        list,
        format!(
            "// Made by motion-rtl: vhdl unit_law --width 4\n{modules}// unit_law_names.toml\n"
        )
    );
    let map = bench.read("a/unit_law_names.toml");
    let line = "\"unit_law.generator.next\" = \"dut.generator.next_s\"\n";
    assert!(map.contains(line), "{map}");
}

#[test]
fn a_testbench_comes_with_its_stimulus_and_golden_waves() {
    let bench = Bench::new();
    let said = bench.succeed(&vhdl("enable_counter", &TESTBENCH));
    assert!(
        said.starts_with("200 ticks of seed 1, 6 of them with rst; 1 of 13 bits were 0 and 1\n"),
        "{said}"
    );
    let files: Vec<String> = [
        ".expected",
        ".still",
        ".stimulus",
        ".vcd",
        ".vhd",
        "_names.toml",
        "_tb.vhd",
        "_vhdl.f",
    ]
    .map(|end| format!("v/enable_counter{end}"))
    .into();
    let mut names = bench.names();
    names.retain(|name| name != "v/");
    names.sort();
    assert_eq!(names, files);
    assert_eq!(bench.read("v/enable_counter.stimulus").lines().count(), 200);
    let text = bench.read("v/enable_counter_tb.vhd");
    assert!(text.contains("dut : entity work.enable_counter"), "{text}");
}

/// Stimulus, expected values and waves are the same in both.
#[test]
fn both_languages_stand_in_one_directory() {
    let bench = Bench::new();
    let verilog = [
        &["verilog", "axis", "--testbench", "20"],
        &["--out", "v"][..],
    ]
    .concat();
    bench.succeed(&verilog);
    let stimulus = bench.read("v/axis.stimulus");
    bench.succeed(&vhdl("axis", &["--testbench", "20", "--out", "v"]));
    assert_eq!(bench.read("v/axis.stimulus"), stimulus);
    bench.succeed(&verilog);
    for file in [
        "axis.v",
        "axis.vhd",
        "axis.f",
        "axis_vhdl.f",
        "axis_tb.v",
        "axis_tb.vhd",
    ] {
        assert!(bench.path(&format!("v/{file}")).exists(), "{file}");
    }
}

#[test]
fn files_of_others_are_not_overwritten() {
    let bench = Bench::new();
    bench.write("v/axis.vhd", "entity axis is\n");
    bench.refuse(
        &vhdl("axis", &["--out", "v"]),
        "--out: v/axis.vhd is there, of no export of this directory; that of `vhdl axis` is \
         another; allowed: a directory for each, or to remove the file",
    );
    assert_eq!(bench.read("v/axis.vhd"), "entity axis is\n");
    assert!(!bench.path("v/axis_vhdl.f").exists());
}

#[test]
fn what_is_no_circuit_is_refused() {
    let bench = Bench::new();
    let done = bench.run(&vhdl("axes", &["--out", "v"]));
    assert_eq!(done.code, 2);
    assert!(done.stderr.contains("there is no axes"), "{}", done.stderr);
    let done = bench.run(&vhdl("axis", &["--testbench", "1", "--out", "v"]));
    assert_eq!(done.code, 2);
    assert!(!bench.path("v").exists());
}
