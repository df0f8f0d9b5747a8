//! How long a run takes, said before it starts.

use super::support::{Bench, LINE, SHORT, is_progress, whole};

#[test]
fn a_short_run_says_nothing() {
    let bench = Bench::with("l.hpgl", LINE);
    let done = bench.run(&[&["run", "l.hpgl", "--no-vcd"], &SHORT[..]].concat());
    assert_eq!((done.code, done.stderr.as_str()), (0, ""));
}

/// Most of this run is that the models come to rest, which the path's time does not tell.
#[test]
#[ignore = "takes long"]
fn a_long_run_says_its_ticks_before_it_starts() {
    let bench = Bench::with("l.hpgl", "PD200,0,200,200;");
    let settings = [
        "circuit=trajectory_controller",
        "feed_mm_per_min=3000",
        "k1_per_s=0.405",
    ];
    let settings = settings.iter().flat_map(|set| ["--set", set]);
    let run = ["run", "l.hpgl", "--no-vcd", "--json"].into_iter();
    let done = bench.run(&run.chain(settings).collect::<Vec<_>>());
    assert_eq!(done.code, 0, "{}", done.stderr);
    assert!(done.stderr.lines().all(is_progress), "{}", done.stderr);
    let first = done.stderr.lines().next().unwrap();
    let said = first.strip_prefix("l.hpgl: ").unwrap();
    let (ticks, about) = said.split_once(" ticks, about ").unwrap();
    assert!(about.ends_with(" s"), "{first}");
    let summary = serde_json::from_str(&done.stdout).unwrap();
    let (ticks, seen) = (ticks.parse::<i64>().unwrap(), whole(&summary, "/ticks"));
    // The path is 0.2 s of it.
    assert!(seen > 10_000_000, "{seen}");
    let off = (ticks - seen).abs() as f64 / seen as f64;
    assert!(off < 0.15, "{ticks} said, {seen} seen");
}

/// The servos, which stop after each move and wait for the pen, take longer than the steppers.
#[test]
fn the_ticks_of_the_machine_are_about_those_of_its_run() {
    let bench = Bench::with("l.hpgl", "PD400,0,400,200;PU0,0;PD0,200;");
    let run = [
        "run",
        "l.hpgl",
        "--set",
        "circuit=machine",
        "--no-vcd",
        "--json",
        "-v",
    ];
    let done = bench.run(&run);
    assert_eq!(done.code, 0, "{}", done.stderr);
    let said = done.stderr.lines().find_map(|line| {
        let (_, said) = line.split_once(": running, about ")?;
        said.strip_suffix(" ticks")?.parse::<f64>().ok()
    });
    let said = said.unwrap_or_else(|| panic!("{}", done.stderr));
    let summary = serde_json::from_str(&done.stdout).unwrap();
    let seen = whole(&summary, "/ticks") as f64;
    assert!((said - seen).abs() / seen < 0.1, "{said} said, {seen} seen");
}
