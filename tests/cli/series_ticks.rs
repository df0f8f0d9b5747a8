//! Time series of runs that do not look at every tick: those without waves.

use super::support::Bench;

/// Runs with a series, with and without waves, which need every tick; both series must be the same.
fn is_the_same_without_waves(arguments: &[&str]) {
    let bench = Bench::new();
    let mut texts = Vec::new();
    for (waves, file) in [
        (&["--to", "200000"][..], "with.csv"),
        (&["--no-vcd"], "without.csv"),
    ] {
        let run = [&["run"], arguments, waves, &["--series", file, "-q"]].concat();
        assert_eq!(bench.run(&run).code, 0, "{run:?}");
        let text = bench.read(file);
        texts.push(text);
    }
    let [with, without] = &texts[..] else {
        unreachable!()
    };
    let lines = with.lines().count();
    assert!(lines > 20, "{arguments:?}: {lines} lines");
    let differs = with.lines().zip(without.lines()).find(|(a, b)| a != b);
    assert_eq!(differs, None, "{arguments:?}");
    assert!(without.lines().count() >= lines);
}

#[test]
#[ignore = "takes long"]
fn a_series_is_the_same_without_waves() {
    for arguments in [
        &["waves/machine.toml"][..],
        &["waves/machine.toml", "--series-every", "777"],
        &["waves/rosette.toml"],
        &["waves/rosette.toml", "--series-every", "777"],
        &["waves/patterns.toml"],
        &["waves/groups.toml"],
        &["waves/weld.toml"],
        &["waves/corner.toml"],
    ] {
        is_the_same_without_waves(arguments);
    }
}
