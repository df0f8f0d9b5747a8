//! Which columns of a position log are taken, and how the output says so.

use crate::support::Bench;

/// A log whose first column numbers its lines.
fn log(header: &str) -> String {
    let mut text = header.to_owned();
    for n in 0..200 {
        text += &format!("{n},{},{}.5,{}\n", 7000 + 5 * n, n * n, 20 * n);
    }
    text
}

#[test]
#[ignore = "takes long"]
fn an_index_and_fractions_are_not_taken_for_counts() {
    for (header, time, counts) in [
        (",time,mm,left\n", "time", "left"),
        ("n,ms,mm,left\n", "ms", "left"),
        ("", "time (column 2)", "counts (column 4)"),
    ] {
        let bench = Bench::with("l.csv", log(header));
        let run = ["run", "l.csv", "--no-vcd"];
        let summary = bench.json(&run);
        assert_eq!(summary["time_column"], time);
        assert_eq!(summary["counts_column"], counts);
        // 199 steps of 5 ms at 4000 counts/s: 1000 is met at 0.25 s.
        let signal = &summary["signals"][0];
        assert!(
            (signal["position_after"].as_f64().unwrap() - 1000.0).abs() < 2.0,
            "{signal}"
        );
        assert_eq!(summary["time_unit"], "ms");
        let from = if time == "ms" {
            "header"
        } else {
            "median step"
        };
        assert_eq!(summary["time_unit_from"], from);
        let text = bench.succeed(&run);
        let said = format!(
            "\ntimes from {time} in ms, by {from}; counts from {counts}, the first that fits; --set \
             log_column=NAME takes another\n"
        );
        assert!(text.contains(&said), "{text}");
    }
}

#[test]
fn a_column_that_is_asked_for_is_taken_or_refused_by_name() {
    let bench = Bench::with("l.csv", log("n,time,mm,counts\n"));
    let text = bench.succeed(&["run", "l.csv", "--no-vcd"]);
    assert!(
        text.contains("\ntimes from time in ms, by median step; counts from counts\n"),
        "{text}"
    );
    let run = |column: &'static str| ["run", "l.csv", "--no-vcd", "--set", column];
    let text = bench.succeed(&run("log_column=n"));
    assert!(
        text.contains("\ntimes from time in ms, by median step; counts from n\n"),
        "{text}"
    );
    bench.refuse(
        &run("log_column=mm"),
        "l.csv:2: mm: is '0.5'; allowed: a whole number, -2147483648 to 2147483648",
    );
    bench.refuse(
        &run("log_column=none"),
        "l.csv:1: none: no such column; allowed: n, time, mm, counts",
    );
    // By its number; what jumps too far for the clock is refused by its name.
    let bench = Bench::with("l.csv", "0,5,0\n5,5,9000\n10,6,9001\n15,6,9002\n");
    let run = |column: &'static str| ["run", "l.csv", "--no-vcd", "--set", column];
    let json = bench.json(&run("log_column=\"2\""));
    assert_eq!(json["counts_column"], "counts (column 2)");
    bench.refuse(
        &run("log_column=\"3\""),
        "l.csv:2: counts (column 3): 1800000 counts/s since the sample before, with times in ms \
         (log_time_unit_ms); allowed: up to \
         1000000, one count per tick",
    );
}
