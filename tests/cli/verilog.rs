//! `verilog`: its files, and its refusals.

use super::support::{Bench, testbench_files, without_sizes};

const TESTBENCH: [&str; 6] = ["--width", "4", "--testbench", "200", "--out", "v"];

fn verilog<'a>(circuit: &'a str, arguments: &[&'a str]) -> Vec<&'a str> {
    [&["verilog", circuit], arguments].concat()
}

#[test]
fn a_module_each_is_written_and_named() {
    let bench = Bench::new();
    let said = bench.succeed(&verilog("enable_counter", &["--out", "a/b"]));
    let files = ["a/b/enable_counter.f", "a/b/enable_counter.v"];
    assert_eq!(
        without_sizes(&said),
        format!("{}\n{}\n", files[1], files[0])
    );
    assert_eq!(bench.names(), [&["a/", "a/b/"], &files[..]].concat());
    let list = "// Made by motion-rtl: verilog enable_counter\nenable_counter.v\n";
    assert_eq!(bench.read(files[0]), list);
    let text = bench.read("a/b/enable_counter.v");
    assert!(text.contains("\nmodule enable_counter (\n"), "{text}");
}

#[test]
fn a_testbench_of_an_earlier_export_is_told() {
    let bench = Bench::new();
    bench.succeed(&verilog("enable_counter", &TESTBENCH));
    let done = bench.run(&verilog("enable_counter", &["--width", "8", "--out", "v"]));
    let text = "warning: v/enable_counter_tb.v is of an earlier export and need not fit this one\n";
    assert_eq!((done.code, done.stderr.as_str()), (0, text));
}

#[test]
fn a_testbench_comes_with_its_stimulus_and_golden_waves() {
    let bench = Bench::new();
    let said = bench.succeed(&verilog("enable_counter", &TESTBENCH));
    let files = testbench_files("v/enable_counter");
    let (stimulus, names) = said.split_at(said.find("v/").unwrap());
    assert_eq!(
        stimulus,
        "200 ticks of seed 1, 6 of them with rst; 1 of 13 bits were 0 and 1\n\
         3 of 4 signals never changed: enable_counter.count, enable_counter.next, enable_counter.enable\n\
         a word of the stimulus, from bit 0: period [3:0], rst [4]\n"
    );
    assert_eq!(without_sizes(names), files.join("\n") + "\n");
    let waves = bench.read(&files[3]);
    assert!(waves.contains("period 10 x 100 ns"), "{}", &waves[..300]);
    assert_eq!(bench.read(&files[4]).lines().count(), 200);
    assert_eq!(bench.read(&files[5]).lines().count(), 200);
    assert_eq!(bench.names().len(), 8);
}

/// A few are named, all are in a file.
#[test]
fn signals_that_never_change_are_told() {
    let bench = Bench::new();
    let said = bench.succeed(&verilog(
        "arc_generator",
        &["--testbench", "20000", "--out", "v"],
    ));
    let line = said.lines().nth(1).unwrap();
    assert_eq!(
        line,
        "12 of 438 signals never changed: arc_generator.engine_x.value.load_part, \
         arc_generator.engine_x.d4.step, arc_generator.engine_x.d4.by_whole, \
         arc_generator.engine_x.d4.by_part and 8 more, which arc_generator.still lists"
    );
    let all = bench.read("v/arc_generator.still");
    assert_eq!(all.lines().count(), 12, "{all}");
    assert!(
        all.contains("\narc_generator.engine_x.d4.by_whole [39:0]\n"),
        "{all}"
    );
    let said = bench.succeed(&verilog(
        "unit_law",
        &["--testbench", "20000", "--out", "w"],
    ));
    assert!(said.contains("\neach of 25 signals changed\n"), "{said}");
    assert_eq!(bench.read("w/unit_law.still"), "");
}

/// Ports that stand in bundles too.
#[test]
fn the_word_of_the_stimulus_is_that_of_the_testbench() {
    let bench = Bench::new();
    let said = bench.succeed(&verilog("machine", &["--testbench", "2", "--out", "v"]));
    let line = said
        .lines()
        .find(|line| line.starts_with("a word of the stimulus"));
    let (_, word) = line.unwrap().split_once(": ").unwrap();
    let testbench = bench.read("v/machine_tb.v");
    let ports: Vec<_> = word.split(", ").collect();
    assert!(ports.len() > 60, "{word}");
    for port in ports {
        let (name, bits) = port.split_once(' ').unwrap();
        let connected = format!(".{name} (stimulus{bits})");
        assert!(testbench.contains(&connected), "{connected}");
    }
}

#[test]
fn a_width_is_refused_where_there_is_none_to_choose() {
    let bench = Bench::new();
    for circuit in ["cycle_gate", "sync_stage"] {
        bench.refuse(
            &verilog(circuit, &["--width", "5", "--out", "v"]),
            &format!("--width: {circuit} has no width to choose; allowed: none"),
        );
    }
}

#[test]
fn the_golden_waves_have_the_clock_that_is_asked_for() {
    let bench = Bench::new();
    bench.succeed(&verilog(
        "enable_counter",
        &[&TESTBENCH[..], &["--clock-hz", "100000000"]].concat(),
    ));
    let waves = bench.read("v/enable_counter.vcd");
    assert!(waves.contains("period 10 x 1 ns"), "{}", &waves[..300]);
    let done = bench.run(&verilog(
        "enable_counter",
        &[&TESTBENCH[..], &["--clock-hz", "0"]].concat(),
    ));
    assert_eq!(done.code, 2);
    assert!(done.stderr.contains("--clock-hz"), "{}", done.stderr);
}

#[test]
fn two_ticks_are_the_least() {
    let bench = Bench::new();
    bench.succeed(&verilog("axis", &["--testbench", "2", "--out", "v"]));
    assert_eq!(bench.read("v/axis.stimulus").lines().count(), 2);
    let done = bench.run(&verilog("axis", &["--testbench", "1", "--out", "w"]));
    assert_eq!(done.code, 2);
    assert!(
        done.stderr.contains("'--testbench <TICKS>'"),
        "{}",
        done.stderr
    );
    assert!(!bench.path("w").exists());
}

#[test]
fn a_seed_names_its_bytes() {
    let files = |seed: &str| {
        let bench = Bench::new();
        bench.succeed(&verilog(
            "address_sequencer",
            &[&TESTBENCH[..], &["--seed", seed]].concat(),
        ));
        let names = bench
            .names()
            .into_iter()
            .filter(|name| !name.ends_with('/'));
        let files = names.map(|name| (bench.read(&name), name));
        files.collect::<Vec<_>>()
    };
    assert_eq!(files("3"), files("3"));
    assert_ne!(files("3"), files("4"));
}

/// A fourth axis has words of its own in a segment, whose numbers take a bit more.
#[test]
fn the_trajectory_controller_has_up_to_four_axes() {
    for (axes, address) in [
        ("axes=3", "[11:0] path_address"),
        ("axes=4", "[12:0] path_address"),
    ] {
        let bench = Bench::new();
        bench.succeed(&verilog(
            "trajectory_controller",
            &["--set", axes, "--out", "v"],
        ));
        let text = bench.read("v/trajectory_controller.v");
        let words: Vec<&str> = text.split_whitespace().collect();
        let text = words.join(" ");
        assert!(text.contains(address), "{axes}");
        for name in ["torque_w", "given_command_w", "gain_1_w", "a_w"] {
            assert_eq!(text.contains(name), axes == "axes=4", "{axes}: {name}");
        }
    }
    let five = ["--set", "axes=5", "--out", "v"];
    let refused = "--set axes=5: is 5; allowed: 1 to 4";
    Bench::new().refuse(&verilog("trajectory_controller", &five), refused);
}

#[test]
fn circuits_that_are_not_there_are_refused() {
    let bench = Bench::new();
    bench.refuse(
        &verilog("no_such_thing", &["--out", "v"]),
        "CIRCUIT: there is no no_such_thing; allowed: a name of a circuit; `motion-rtl list` shows all",
    );
}

#[test]
fn widths_and_numbers_that_are_not_taken_are_refused() {
    let bench = Bench::new();
    bench.refuse(
        &verilog("enable_counter", &["--width", "0", "--out", "v"]),
        "--set width=0: is 0; allowed: 1 to 64",
    );
    for (circuit, set, told) in [
        (
            "compensator",
            "widths.position=18446744073709551616",
            "is 18446744073709551616: too large; allowed: 2 to 53",
        ),
        (
            "pattern_memory",
            "axis=1_000_000_000_000_000_000_000",
            "is 1_000_000_000_000_000_000_000: too large; allowed: a whole number from 0 to \
             9223372036854775807",
        ),
        (
            "compensator",
            "widths={position=18446744073709551616}",
            "is {position=18446744073709551616}, with a number that is too large; allowed: ",
        ),
        ("compensator", "widths.step=18", "is 18; allowed: 1 to 17"),
    ] {
        bench.refuse_with(&verilog(circuit, &["--set", set, "--out", "v"]), |said| {
            let start = format!("error: --set {set}: {told}");
            assert!(said.starts_with(&start), "{said}");
        });
    }
    bench.refuse_with(
        &verilog(
            "compensator",
            &["--set", "rom=[1,2,99999999999]", "--out", "v"],
        ),
        |said| {
            assert!(
                said.contains("99999999999 does not fit 11 bits: 0 to 2047; allowed: values"),
                "{said}"
            );
            assert_eq!(said.matches("allowed").count(), 1, "{said}");
        },
    );
    // Of two values the later counts, but the earlier has to be one.
    bench.refuse(
        &verilog(
            "enable_counter",
            &["--set", "width=wide", "--set", "width=6", "--out", "v"],
        ),
        "--set width=wide: invalid type: string \"wide\"; allowed: a whole number from 0",
    );
    bench.refuse(
        &verilog("unit_law", &["--with", "1", "--out", "v"]),
        "--with: takes no numbers; allowed: values by their keys, --set variant=safe; see `list unit_law`",
    );
    bench.refuse(
        &verilog("axis", &["--width", "half_period=4", "--out", "v"]),
        "--width: half_period is a key; allowed: --set memory.half_period=4",
    );
    bench.refuse(
        &verilog("axis", &["--width", "4", "--out", "v"]),
        "--width: axis has several widths: memory.address, memory.half_period; allowed: --set \
         memory.address=4",
    );
    // All that is wrong, at once.
    const KEYS: &str = "memory.address, memory.axis, memory.contents.directions, \
                        memory.contents.half_periods, memory.half_period, variant";
    let wrong = [
        "--set",
        "half_perod=4",
        "--set",
        "variant=literel",
        "--set",
        "memory.address=x",
    ];
    let done = bench.run(&verilog("axis", &[&wrong[..], &["--out", "v"]].concat()));
    let told = format!(
        "error: --set half_perod=4: no key of axis; did you mean memory.half_period?; allowed: {KEYS}\n\
         error: --set variant=literel: unknown variant `literel`; did you mean literal?; allowed: \
         `safe` or `literal`\n\
         error: --set memory.address=x: invalid type: string \"x\"; allowed: a whole number from 0\n"
    );
    assert_eq!((done.code, done.stderr), (2, told));
    let last = ["--width", "4", "--width", "0", "--out", "v"];
    bench.refuse(
        &verilog("enable_counter", &last),
        "--set width=0: is 0; allowed: 1 to 64",
    );
    let done = bench.run(&verilog(
        "axis",
        &["--set", "memory.half_period=65", "--out", "v"],
    ));
    assert_eq!(done.code, 2);
    let problem = "--set memory.half_period=65: is 65; allowed: 1 to 64";
    assert!(done.stderr.contains(problem), "{}", done.stderr);
    assert!(bench.names().is_empty());
}

#[test]
fn widths_are_chosen_by_their_names_and_variants_with_full_widths() {
    let bench = Bench::new();
    let widths = [
        "--set",
        "memory.half_period=9",
        "--set",
        "memory.address=5",
        "--set",
        "variant=literal",
    ];
    bench.succeed(&verilog("axis", &[&widths[..], &["--out", "v"]].concat()));
    let text = bench.read("v/axis.v");
    for port in [
        "input  wire [8:0] write_half_period",
        "input  wire [4:0] address",
    ] {
        assert!(text.contains(port), "{text}");
    }
    bench.succeed(&verilog(
        "axis",
        &["--set", "variant=literal", "--out", "w"],
    ));
    let full = bench.read("w/axis.v");
    assert!(
        full.contains("input  wire [15:0] write_half_period"),
        "{full}"
    );
    bench.succeed(&verilog("axis", &["--out", "x"]));
    let generator = |of: &str| bench.read(&format!("{of}/pulse_generator.v"));
    assert_ne!(generator("w"), generator("x"));
}

#[test]
fn a_directory_that_cannot_be_written_stays_as_it_is() {
    const WRITABLE: &str = "allowed: a directory that can be written";
    let bench = Bench::with("file", "");
    bench.refuse(
        &verilog("axis", &["--out", "file"]),
        &format!("--out: file: File exists (os error 17); {WRITABLE}"),
    );
    // Of several files not even the first.
    for taken in ["enable_counter_tb.v", "enable_counter.stimulus"] {
        let bench = Bench::new();
        bench.write(&format!("v/{taken}/inside"), "");
        bench.refuse(
            &verilog("enable_counter", &TESTBENCH),
            &format!("--out: v/{taken}: is a directory; {WRITABLE}"),
        );
    }
}

/// Circuits whose parts are alike share a directory; a part is never replaced by another one.
#[test]
fn parts_of_another_export_stay() {
    let bench = Bench::new();
    let export =
        |circuit, more: &[&'static str]| verilog(circuit, &[more, &["--out", "v"]].concat());
    const APART: &str = "allowed: a directory for each, or to remove the file";
    bench.succeed(&export("cordic", &[]));
    bench.succeed(&export("correction", &[]));
    bench.refuse(
        &export("tracking_converter", &[]),
        &format!(
            "--out: v/shifter.v is of `verilog cordic`; that of `verilog tracking_converter` \
             is another; {APART}"
        ),
    );
    // An export replaces an earlier one of the same circuit that shares nothing.
    let before = bench.read("v/correction.v");
    bench.succeed(&export("correction", &["--set", "position=20"]));
    assert_ne!(bench.read("v/correction.v"), before);
    // A file of somebody's own.
    bench.write("v/axis.v", "module axis;\nendmodule\n");
    bench.refuse(
        &export("axis", &[]),
        &format!(
            "--out: v/axis.v is there, of no export of this directory; that of `verilog axis` is \
             another; {APART}"
        ),
    );
    // What a memory begins with is a file of its own.
    bench.succeed(&verilog("cordic_state", &["--out", "w"]));
    bench.refuse(
        &verilog("table_lead", &["--out", "w"]),
        &format!(
            "--out: w/rom.hex is of `verilog cordic_state`; that of `verilog table_lead` is another; \
             {APART}"
        ),
    );
    std::fs::remove_file(bench.path("v/axis.v")).unwrap();
    bench.succeed(&export("axis", &["--testbench", "10"]));
    bench.succeed(&export(
        "axis",
        &["--set", "memory.half_period=9", "--testbench", "10"],
    ));
    let list = bench.read("v/axis.f");
    assert!(
        list.starts_with("// Made by motion-rtl: verilog axis --set memory.half_period=9\n"),
        "{list}"
    );
    assert!(list.ends_with("\naxis.v\n// axis_tb.v\n"), "{list}");
}

/// The message of a name without its keys shows a value that the circuit takes.
#[test]
fn a_name_without_its_keys_is_answered_by_an_example() {
    let bench = Bench::new();
    for (circuit, set) in [
        ("conventional_compensator", "lead_from=time"),
        ("conventional_compensator", "lead_from=table"),
        ("compensator", "lead_from=table"),
        ("controller", "source=conventional"),
    ] {
        let done = bench.run(&["list", circuit, "--set", set]);
        assert_eq!(done.code, 2, "{circuit}: {}", done.stdout);
        let example = done.stderr.split('\'').nth(1);
        let example = example.unwrap_or_else(|| panic!("{circuit}: {}", done.stderr));
        assert!(example.starts_with(&format!("{}={{", set.split('=').next().unwrap())));
        bench.succeed(&["list", circuit, "--set", example]);
    }
}
