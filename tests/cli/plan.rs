//! `plan`, and `run --plan`.

use super::support::{Bench, LINE, SHORT};

const COUNTER: &str = "\
enable_counter, 10000 ticks: blocks: 2, of which 1 make the edge; steps: 4; registers: 1; memories: 0; words of state: 16

block  part     does       steps     ran  woken by
    0  (whole)  settles 3      3  84.0 %  period, count
    1  (whole)  edge of 1      1  83.8 %  block 0
";

#[test]
fn a_plan_names_blocks_and_what_wakes_them() {
    let bench = Bench::new();
    assert_eq!(bench.succeed(&["plan", "enable_counter"]), COUNTER);
    let narrow = bench.succeed(&["plan", "enable_counter", "--width", "4", "--ticks", "0"]);
    assert!(narrow.starts_with("enable_counter, 0 ticks: "), "{narrow}");
    assert!(
        narrow.contains("settles 3      3    -  period, count\n"),
        "{narrow}"
    );
    // Another stimulus, other shares.
    let other = bench.succeed(&["plan", "enable_counter", "--seed", "2"]);
    assert_ne!(other, COUNTER);
    assert!(bench.names().is_empty());
}

#[test]
fn a_job_has_its_plan_beside_its_picture() {
    let bench = Bench::with("line.hpgl", LINE);
    let run = ["run", "line.hpgl", "--no-vcd", "--plan", "--out", "o"];
    let said = bench.succeed(&[&run[..], &SHORT].concat());
    assert!(said.contains("o/line.plan.txt ("), "{said}");
    let plan = bench.read("o/line.plan.txt");
    let counter = plan
        .lines()
        .find(|line| line.contains("  counter  "))
        .expect("a block of it");
    assert!(
        counter.contains(" 100.0 % "),
        "it counts in every tick: {counter}"
    );
    assert!(plan.contains("sequencer.address"), "{plan}");
}

#[test]
fn what_is_no_circuit_or_number_is_refused() {
    let bench = Bench::new();
    for arguments in [
        &["plan", "nobody"][..],
        &["plan", "enable_counter", "--width", "0"],
        &["plan", "enable_counter", "--ticks", "-1"],
    ] {
        let done = bench.run(arguments);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{arguments:?}");
        assert!(done.stderr.starts_with("error: "), "{}", done.stderr);
    }
}
