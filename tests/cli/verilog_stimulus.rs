//! `verilog --stimulus`: inputs of the user, and what is wrong with them.

use super::support::{Bench, testbench_files, without_sizes};

const COUNTER: [&str; 5] = ["verilog", "enable_counter", "--width", "4", "--stimulus"];

fn plays<'a>(file: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&COUNTER[..], &[file, "--out", "v"], more].concat()
}

#[test]
fn a_table_is_played() {
    let bench = Bench::with(
        "inputs.csv",
        "# two periods\nperiod, rst\n3, 0\n3, 0\n3, 0\n3, 1\n0x2, 0\n2, 0\n2, 0\n",
    );
    let said = bench.succeed(&plays("inputs.csv", &[]));
    let files = testbench_files("v/enable_counter");
    let (report, names) = said.split_at(said.find("v/").unwrap());
    assert_eq!(
        report,
        "7 ticks of inputs.csv, 1 of them with rst; 6 of 13 bits were 0 and 1\n\
         each of 4 signals changed\n\
         a word of the stimulus, from bit 0: period [3:0], rst [4]\n"
    );
    assert_eq!(without_sizes(names), files.join("\n") + "\n");
    let stimulus = bench.read("v/enable_counter.stimulus");
    assert_eq!(stimulus, "03\n03\n03\n13\n02\n02\n02\n");
    // Enable in the last tick of a period, which the reset begins anew.
    let expected = bench.read("v/enable_counter.expected");
    assert_eq!(expected, "0\n0\n1\n0\n0\n1\n0\n");
    let waves = bench.read("v/enable_counter.vcd");
    assert!(waves.contains("period 10 x 100 ns"), "{waves}");
}

/// The stimulus of a random run gives its waves again.
#[test]
fn a_stimulus_is_played() {
    let bench = Bench::new();
    let circuit = ["verilog", "linear_interpolator", "--clock-hz", "1000000"];
    bench.succeed(&[&circuit[..], &["--testbench", "3000", "--out", "a"]].concat());
    let stimulus = ["--stimulus", "a/linear_interpolator.stimulus", "--out", "b"];
    bench.succeed(&[&circuit[..], &stimulus].concat());
    let read = bench.path("a/linear_interpolator.stimulus");
    bench.refuse(
        &[&circuit[..], &stimulus[..3], &["a"]].concat(),
        &format!(
            "--out: {} is the input; allowed: another directory",
            read.canonicalize().unwrap().display()
        ),
    );
    for end in [".vcd", ".stimulus", ".expected", ".still", "_tb.v"] {
        let [random, played] = ["a", "b"].map(|folder| {
            let text = bench.read(&format!("{folder}/linear_interpolator{end}"));
            // The time at which it was written.
            let lines = text.lines().filter(|line| !line.starts_with("$date"));
            lines.collect::<Vec<_>>().join("\n")
        });
        assert!(random == played, "{end}");
    }
}

#[test]
fn ports_without_a_column_are_told() {
    let bench = Bench::with("inputs.csv", "scan,push,target_x\n1,1,-5\n0,0,0\n");
    let inputs = ["--stimulus", "inputs.csv", "--out", "v"];
    let said = bench.succeed(&[&["verilog", "linear_interpolator"], &inputs[..]].concat());
    let line = "\nports that stay low: hold, target_y, speed, acceleration_time, \
                deceleration_time, halt, clear\n";
    assert!(said.contains(line), "{said}");
    // Names in waves have dots, those in Verilog have not.
    for name in ["memory.write_address", "memory_write_address"] {
        let ports = bench.succeed(&["list", "axis"]);
        let dotted = ports
            .lines()
            .any(|line| line.contains(" memory.write_address"));
        if dotted {
            bench.write("axis.csv", format!("{name}\n1\n0\n"));
            bench.succeed(&["verilog", "axis", "--stimulus", "axis.csv", "--out", "w"]);
        }
    }
}

#[test]
fn inputs_that_are_wrong_are_refused_with_their_places() {
    let bench = Bench::with("inputs.csv", "period, rst\n3, 0\n16, 0\n3, 2\n");
    let numbers = "or bits as 0x1f and 0b101";
    bench.refuse_with(&plays("inputs.csv", &[]), |stderr| {
        let errors: Vec<&str> = stderr
            .lines()
            .filter(|line| line.starts_with("error: "))
            .collect();
        let first = format!(
            "error: inputs.csv:3: column 1, period: 16 does not fit; allowed: 0 to 15, {numbers}"
        );
        let second = format!(
            "error: inputs.csv:4: column 2, rst: 2 does not fit; allowed: 0 to 1, {numbers}"
        );
        assert_eq!(errors, [first, second], "{stderr}");
        assert!(stderr.contains("^^"), "{stderr}");
    });
    bench.write("inputs.csv", "perod\n3\n3\n");
    bench.refuse(
        &plays("inputs.csv", &[]),
        "inputs.csv:1: column 1, perod: no input port is called so; did you mean period?; allowed: \
         each at most once: period, rst",
    );
    bench.write("words.stimulus", "1f\n20\n");
    bench.refuse(
        &plays("words.stimulus", &[]),
        "words.stimulus:2: word: 6 bits; allowed: a hexadecimal word of 5 bits",
    );
    bench.write("inputs.txt", "1\n1\n");
    bench.refuse(
        &plays("inputs.txt", &[]),
        "inputs.txt: file: the extension names no format; allowed: a table as .csv, hexadecimal \
         words as .stimulus",
    );
    bench.refuse_with(&plays("none.csv", &[]), |stderr| {
        assert!(stderr.starts_with("error: none.csv: "), "{stderr}");
    });
}

#[test]
fn inputs_are_random_or_given() {
    let bench = Bench::with("inputs.csv", "period\n1\n1\n");
    for more in [&["--testbench", "10"][..], &["--dpi"], &["--seed", "2"]] {
        let done = bench.run(&plays("inputs.csv", more));
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{more:?}");
        assert!(done.stderr.contains(more[0]), "{}", done.stderr);
    }
    assert_eq!(bench.names(), ["inputs.csv"]);
}
