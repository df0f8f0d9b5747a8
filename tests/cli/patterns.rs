//! Patterns that stand in the memory: tables in CSV, played by command or alone.

use super::support::{Bench, LINE, list, whole, words};
use serde_json::json;
use std::fmt::Write as _;

/// A scenario of one table.
const ONE: &str =
    "circuit = \"pulse_interpolator\"\n[[pattern]]\nname = \"a\"\ntable = \"t.csv\"\n";

const HEADER: &str = "unit,period_ticks,x_half_period_ticks,x_down\n";

/// So many unit times of 100 ticks with five pulses up.
fn rows(units: usize) -> String {
    (0..units).fold(HEADER.to_owned(), |mut text, unit| {
        let _ = writeln!(text, "{unit},100,10,0");
        text
    })
}

#[test]
fn stored_patterns_are_chosen_by_command_and_never_rewritten() {
    let bench = Bench::new();
    let run = ["run", "waves/patterns.toml", "--no-vcd"];
    let summary = bench.json(&run);
    assert_eq!(summary["exact"], true);
    assert_eq!(
        (whole(&summary, "/commands"), whole(&summary, "/idle_units")),
        (4, 0)
    );
    assert_eq!(summary["memory_words"], json!([585, 4096]));
    let places: Vec<_> = list(&summary, "patterns")
        .iter()
        .map(|p| p["addresses"].clone())
        .collect();
    assert_eq!(
        places,
        [json!([0, 257]), json!([258, 326]), json!([327, 584])]
    );
    // A ring closes, and does no more when its data are multiplied: what that is said to do is what
    // the drivers counted.
    let [ring, stroke, small] = list(&summary, "patterns") else {
        panic!("{summary}");
    };
    assert_eq!(
        (&ring["closed"], &ring["end_steps"]),
        (&json!(true), &json!([0, 0]))
    );
    assert_eq!(
        (&stroke["closed"], &stroke["end_steps"]),
        (&json!(false), &json!([480, 200]))
    );
    assert_eq!(
        (&small["closed"], &small["end_steps"]),
        (&json!(true), &json!([2, -1]))
    );
    let drift = |axis: usize| &small["scaling"][axis]["drift_steps"];
    assert_eq!((drift(0), drift(1)), (&json!(2.0), &json!(-1.0)));
    assert_eq!(ring["scaling"], json!(null));
    let ends = ["x", "y"].map(|axis| whole(&summary, &format!("/axes/{axis}/end_position")));
    assert_eq!(ends, [482, 199]);
    // The silent unit time at power-on, and all unit times without a gap.
    assert_eq!(whole(&summary, "/units"), 3 * 258 + 69);
    let ticks = 500 + 3 * 129_000 + 55_200;
    assert!(
        (ticks..=ticks + 1).contains(&whole(&summary, "/ticks")),
        "{summary}"
    );
    let text = bench.succeed(&run);
    for line in [
        "585 of 4096 words of the memory, none rewritten; 4 commands",
        "small_ring: data times 3/2",
        "  x: the closed path ends +2.000 steps off, at most 0.333 pulses in a unit time",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}\n{text}");
    }
}

#[test]
fn a_scaled_ring_closes_where_its_counts_do() {
    let bench = Bench::new();
    let waves = concat!(env!("CARGO_MANIFEST_DIR"), "/waves/");
    let text = std::fs::read_to_string(format!("{waves}patterns.toml")).unwrap();
    let text = text.replace("table = \"", &format!("table = \"{waves}"));
    for (scale, ends) in [("1/2", [0, 0]), ("3/2", [2, -1]), ("2", [0, 2])] {
        let text = text.replace("\"3/2\"", &format!("\"{scale}\""));
        bench.write("scaled.toml", text);
        let summary = bench.json(&["run", "scaled.toml", "--no-vcd"]);
        assert_eq!(summary["patterns"][2]["end_steps"], json!(ends), "{scale}");
    }
}

#[test]
fn the_summary_has_the_axes_in_the_order_of_the_ends() {
    let axes = ["x", "y", "z", "a", "b"];
    let columns = axes.map(|axis| format!(",{axis}_half_period_ticks,{axis}_down"));
    let row = axes.map(|_| ",10,0");
    let bench = Bench::with("s.toml", ONE);
    bench.write(
        "t.csv",
        format!(
            "unit,period_ticks{}\n0,100{}\n",
            columns.concat(),
            row.concat()
        ),
    );
    for run in [
        &["run", "s.toml", "--no-vcd"][..],
        &["run", "s.toml", "--no-vcd", "--json"],
    ] {
        let text = bench.succeed(run);
        let text = text
            .split_once("axis")
            .or(text.split_once("\"axes\""))
            .unwrap()
            .1;
        let place = |axis: &str| {
            let json = text.find(&format!("\"{axis}\""));
            json.or_else(|| text.find(&format!("\n{axis}    ")))
                .expect(axis)
        };
        assert!(axes.map(place).is_sorted(), "{text}");
    }
}

#[test]
fn a_table_is_played_as_the_drawing_that_it_was_made_from() {
    let bench = Bench::with("l.ngc", "G1 X10 F1200\nG3 X10 Y10 I0 J5\nG1 X0\n");
    bench.write("s.toml", ONE);
    let set = ["--set", "arc_unit_ticks=700"];
    bench.succeed(&[&["table", "l.ngc", "--out", "t.csv"], &set[..]].concat());
    let drawn = bench.json(&[&["run", "l.ngc", "--no-vcd"], &set[..]].concat());
    let stored = bench.json(&["run", "s.toml", "--no-vcd"]);
    for field in ["units", "idle_units", "exact"] {
        assert_eq!(drawn[field], stored[field], "{field}");
    }
    // Words that are written first take longer than the silent unit time at power-on.
    assert_eq!(whole(&drawn, "/ticks"), whole(&stored, "/ticks") + 1000);
    assert_eq!(whole(&stored, "/commands"), 3);
    assert_eq!(
        stored["patterns"][0]["unit_ticks"],
        json!([1000, 700, 1000])
    );
    for axis in ["x", "y"] {
        for field in [
            "pulses_up",
            "pulses_down",
            "end_position",
            "timing_min_ticks",
        ] {
            let at = |summary: &serde_json::Value| summary["axes"][axis][field].clone();
            assert_eq!(at(&drawn), at(&stored), "{axis}: {field}");
        }
    }
    // With waves, tick by tick, it is the same.
    let waves = bench.json(&["run", "s.toml"]);
    assert_eq!(waves["axes"], stored["axes"]);
}

#[test]
fn a_group_plays_by_itself_what_it_plays_by_command() {
    let bench = Bench::with("s.toml", ONE);
    bench.write("t.csv", rows(3));
    let led = bench.json(&["run", "s.toml", "--no-vcd"]);
    let run = ["run", "s.toml", "--no-vcd", "--set", "standalone=true"];
    let alone = bench.json(&run);
    assert_eq!(
        (whole(&led, "/commands"), whole(&alone, "/commands")),
        (1, 0)
    );
    assert_eq!(
        (&led["axes"], &led["ticks"]),
        (&alone["axes"], &alone["ticks"])
    );
    assert_eq!(whole(&alone, "/axes/x/end_position"), 15);
    assert!(
        bench
            .succeed(&run)
            .contains("none rewritten; no control computer\n")
    );
    bench.refuse(
        &[&run[..], &["--set", "play=[\"a\", \"a\"]"]].concat(),
        "--set: standalone: it would take 2 commands; allowed: one pattern of one T, played once",
    );
    bench.write("t.csv", rows(1) + "1,200,10,0\n");
    bench.refuse(
        &run,
        "--set: standalone: it would take 2 commands; allowed: one pattern of one T, played once",
    );
}

#[test]
fn eight_axes_fill_the_memory_to_its_last_word() {
    let mut text = String::from("unit,period_ticks");
    for axis in ["x", "y", "z", "a", "b", "c", "u", "v"] {
        let _ = write!(text, ",{axis}_half_period_ticks,{axis}_down");
    }
    for unit in 0..4096 {
        let _ = write!(text, "\n{unit},24");
        for axis in 0..8 {
            let _ = write!(text, ",{},{}", 5 - axis % 4, axis % 2);
        }
    }
    let bench = Bench::with("s.toml", ONE);
    bench.write("t.csv", &text);
    let set = ["--set", "dir_setup_ticks=2"];
    let summary = bench.json(&[&["run", "s.toml", "--no-vcd"], &set[..]].concat());
    assert_eq!(summary["memory_words"], json!([4096, 4096]));
    // n = 5, 4, 3, 2 in T = 24: they toggle 4, 5, 7, 11 times.
    for (axis, pulses) in [
        ("x", 2),
        ("y", -3),
        ("z", 4),
        ("a", -6),
        ("u", 4),
        ("v", -6),
    ] {
        let end = whole(&summary, &format!("/axes/{axis}/end_position"));
        assert_eq!(end, 4096 * pulses, "{axis}");
    }
    bench.write("t.csv", rows(4097));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:4: pattern 0: table: has 4097 unit times; allowed: 4096 of the 4096 words of the memory",
    );
}

#[test]
fn bad_patterns_are_refused() {
    let bench = Bench::with("t.csv", rows(2));
    bench.write(
        "two.csv",
        rows(1)
            .replace("x_down\n", "x_down,y_half_period_ticks,y_down\n")
            .replace(",0\n", ",0,0,0\n"),
    );
    bench.write("bad.csv", rows(1) + "1,100,70000,0\n");
    let two = format!("{ONE}[[pattern]]\nname = \"b\"\n");
    let cases = [
        (
            format!("{two}table = \"two.csv\"\n"),
            "s.toml:7: pattern 1: table: has 2 axes; allowed: 1, as the first",
        ),
        (
            format!("{two}table = \"bad.csv\"\n"),
            "bad.csv:3: x_half_period_ticks: is 70000; allowed: 0 to 65535",
        ),
        (
            format!("{two}table = \"t.csv\"\nscale = \"0\"\n"),
            "s.toml:8: pattern 1: scale: is 0; allowed: NUM/DEN, two whole numbers from 1 to 4294967295",
        ),
        (
            format!("{two}table = \"t.csv\"\n").replace("\"b\"", "\"a\""),
            "s.toml:6: pattern 1: name: is a once more; allowed: a name for each",
        ),
        (
            ONE.replace("\"a\"", "\"\""),
            "s.toml:3: pattern 0: name: is empty; allowed: a name",
        ),
        (
            format!("play = [\"a\", \"c\"]\n{ONE}"),
            "s.toml:1: play: c is no pattern; allowed: a",
        ),
        (
            format!("play = []\n{ONE}"),
            "s.toml:1: play: is empty; allowed: the name of a pattern",
        ),
        (
            format!("input = \"l.ngc\"\n{ONE}"),
            "s.toml:1: input: given beside [[pattern]]; allowed: one of both",
        ),
        (
            "circuit = \"pulse_interpolator\"\nplay = [\"a\"]\n".into(),
            "s.toml:2: play: without [[pattern]]; allowed: the command run, with [[pattern]] and no input",
        ),
        (
            "circuit = \"pulse_interpolator\"\nstandalone = true\n".into(),
            "s.toml:2: standalone: without [[pattern]]; allowed: the command run, with [[pattern]] and no input",
        ),
    ];
    for (text, expected) in &cases {
        bench.write("s.toml", text);
        bench.refuse(&["run", "s.toml"], expected);
    }
    // One that does not end beyond T has to fit its word, also scaled.
    bench.write("t.csv", HEADER.to_owned() + "0,100000,40000,0\n");
    bench.write("s.toml", format!("{ONE}scale = \"2\"\n"));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:5: pattern 0: scale: unit 0, x: scaled half-period 80000 is not from 1 to 65535; \
         allowed: a smaller ratio",
    );
    bench.write("t.csv", rows(2));
    // Half-periods beyond T are none, and no fault.
    bench.write(
        "s.toml",
        format!("{two}table = \"t.csv\"\nscale = \"1000\"\n"),
    );
    bench.succeed(&["run", "s.toml", "--no-vcd"]);
    bench.write("s.toml", ONE.replace("name = \"a\"\n", ""));
    bench.refuse_with(&["run", "s.toml"], |stderr| {
        assert!(stderr.contains("name"), "{stderr}")
    });
    bench.write("s.toml", ONE.replace("t.csv", "none.csv"));
    bench.refuse_with(&["run", "s.toml"], |stderr| {
        assert!(stderr.starts_with("error: none.csv: file: "), "{stderr}");
    });
    bench.write("s.toml", ONE);
    bench.refuse_with(&["table", "s.toml"], |stderr| {
        assert!(
            stderr.contains("a memory of patterns is not compiled"),
            "{stderr}"
        );
    });
}

#[test]
fn unit_times_of_a_tick_are_played_to_their_end() {
    let bench = Bench::with("s.toml", ONE);
    bench.write("t.csv", rows(2).replace(",100,10,0", ",1,0,0"));
    for run in [&["run", "s.toml"][..], &["run", "s.toml", "--no-vcd"]] {
        let summary = bench.json(run);
        assert_eq!(
            (whole(&summary, "/units"), whole(&summary, "/idle_units")),
            (2, 0)
        );
        // The command comes, waits, is played for two ticks, and a tick for the last edge.
        assert_eq!(whole(&summary, "/ticks"), 5);
    }
}

#[test]
fn data_that_break_the_limits_of_the_driver_are_complained_of() {
    let bench = Bench::with("s.toml", ONE);
    bench.write("t.csv", rows(2).replace(",10,0", ",4,0"));
    assert_eq!(bench.run(&["run", "s.toml", "--no-vcd"]).code, 0);
    let done = bench.run(&["run", "s.toml", "--no-vcd", "--set", "step_low_ticks=5"]);
    assert_eq!(done.code, 1);
    assert!(
        done.stderr
            .contains("x: step low time of 4 ticks where the driver asks for 5"),
        "{}",
        done.stderr
    );
}

/// Pulses of half-period `n` in `period` ticks, by the text's own counting.
fn pulses(n: u64, period: u64) -> i64 {
    match n {
        0 => 0,
        n => ((period - 1) / n).div_ceil(2) as i64,
    }
}

#[test]
fn t_is_rewritten_while_a_pattern_is_played() {
    let bench = Bench::new();
    let summary = bench.json(&["run", "waves/rewrite.toml"]);
    assert_eq!(
        (&summary["exact"], whole(&summary, "/rewrites")),
        (&json!(true), 2)
    );
    assert_eq!(whole(&summary, "/commands"), 1);
    // In force from the unit time behind the one in which it is written.
    let period = |unit: usize| match unit {
        0..=20 => 800,
        21..=45 => 1200,
        _ => 400,
    };
    let stroke = include_str!("../../waves/stroke.csv");
    let mut ends = [0; 2];
    let mut periods = vec![800];
    for row in stroke.lines().skip(1) {
        let cells: Vec<u64> = row.split(',').map(|cell| cell.parse().unwrap()).collect();
        let period = period(cells[0] as usize);
        periods.push(period as i64);
        for (axis, end) in ends.iter_mut().enumerate() {
            let way = pulses(cells[2 + 2 * axis], period);
            *end += if cells[3 + 2 * axis] == 1 { -way } else { way };
        }
    }
    let found = ["x", "y"].map(|axis| whole(&summary, &format!("/axes/{axis}/end_position")));
    assert_eq!(found, ends);
    assert_ne!(found, [480, 200]);
    let paths = [
        "pulse_interpolator.unit_rst",
        "pulse_interpolator.write_period",
    ];
    let ticks = words(&bench.read("waves/rewrite.vcd"), &paths);
    let at = |signal: usize| {
        let high = ticks
            .iter()
            .enumerate()
            .filter(move |(_, row)| row[signal] == 1);
        high.map(|(tick, _)| tick as i64 + 1).collect::<Vec<_>>()
    };
    let resets = at(0);
    let lengths = resets.iter().scan(0, |before, end| {
        let length = end - *before;
        *before = *end;
        Some(length)
    });
    assert_eq!(lengths.collect::<Vec<_>>()[..periods.len()], periods);
    assert_eq!(at(1).len(), 2);
    // Without waves idle ticks are not gone over, and the result is the same.
    let without = bench.json(&["run", "waves/rewrite.toml", "--no-vcd"]);
    assert_eq!(
        (&without["axes"], &without["ticks"]),
        (&summary["axes"], &summary["ticks"])
    );
    let text = bench.succeed(&["run", "waves/rewrite.toml", "--no-vcd"]);
    assert!(
        text.contains("none rewritten; 1 command, T rewritten 2 times\n"),
        "{text}"
    );
}

#[test]
fn a_rewritten_t_without_effect_is_refused() {
    let rows = rows(5);
    let refused = |keys: &str, text: &str| {
        let bench = Bench::with("t.csv", &rows);
        bench.write("s.toml", format!("{ONE}{keys}"));
        bench.refuse(&["run", "s.toml"], text);
    };
    let allowed = "allowed: unit times in order, each of 4 ticks or more and not the last of its \
                   pattern; unit_ticks 1 to 16777215";
    let rewrite =
        |unit: usize, ticks: u32| format!("[[rewrite]]\nunit = {unit}\nunit_ticks = {ticks}\n");
    for (keys, line, place, unit) in [
        (rewrite(4, 50), 6, 0, 4),
        (rewrite(9, 50), 6, 0, 9),
        (rewrite(0, 0), 6, 0, 0),
        (rewrite(0, 1 << 24), 6, 0, 0),
        (rewrite(2, 50) + &rewrite(2, 60), 9, 1, 2),
        (rewrite(1, 3) + &rewrite(2, 60), 9, 1, 2),
    ] {
        refused(
            &keys,
            &format!("s.toml:{line}: rewrite {place}: unit: is {unit}; {allowed}"),
        );
    }
    let bench = Bench::with("l.hpgl", LINE);
    let run = ["run", "l.hpgl", "--set", "rewrite=[{unit=1,unit_ticks=9}]"];
    let text = "--set: rewrite: without [[pattern]]; allowed: the command run, with [[pattern]] and no input";
    bench.refuse(&run, text);
}

#[test]
fn two_groups_play_at_unit_times_of_their_own() {
    let bench = Bench::new();
    let summary = bench.json(&["run", "waves/groups.toml"]);
    assert_eq!(summary["exact"], json!(true), "{summary}");
    let [first, second] = list(&summary, "groups") else {
        panic!("{summary}");
    };
    let ends = |group: &serde_json::Value| {
        ["x", "y"].map(|axis| whole(group, &format!("/axes/{axis}/end_position")))
    };
    assert_eq!((ends(first), ends(second)), ([0, 0], [960, 400]));
    assert_eq!(
        (whole(first, "/units"), whole(second, "/units")),
        (258, 138)
    );
    for group in [first, second] {
        assert_eq!(whole(group, "/idle_units"), 0);
    }
    let paths = ["of_first", "of_second"].map(|group| {
        ["busy", "unit_rst"].map(|line| format!("pulse_interpolator_groups.{group}.{line}"))
    });
    let paths: Vec<_> = paths.iter().flatten().map(String::as_str).collect();
    let ticks = words(&bench.read("waves/groups.vcd"), &paths);
    for (group, summary, begun, period, units) in
        [(0, first, 2, 500, 258), (1, second, 1236, 800, 138)]
    {
        let high = |line: usize| {
            let ticks = ticks.iter().enumerate();
            ticks.filter(move |(_, row)| row[2 * group + line] == 1)
        };
        let busy: Vec<_> = high(0).map(|(tick, _)| tick).collect();
        assert!(
            busy.iter().copied().eq(begun..begun + units * period),
            "{group}"
        );
        assert_eq!(whole(summary, "/begun_tick"), begun as i64);
        let ends = high(1)
            .map(|(tick, _)| tick + 1)
            .filter(|end| busy.contains(&(end - 1)));
        assert!(
            ends.eq((1..=units).map(|unit| begun + unit * period)),
            "{group}"
        );
    }
    // Commands in the same tick start them together.
    let set = "group=[{play=[\"ring\"]},{play=[\"stroke\"]}]";
    let together = bench.json(&["run", "waves/groups.toml", "--no-vcd", "--set", set]);
    let begun = list(&together, "groups")
        .iter()
        .map(|group| whole(group, "/begun_tick"));
    assert_eq!(begun.collect::<Vec<_>>(), [2, 2]);
}

#[test]
fn bad_groups_are_refused() {
    let group = "[[group]]\nplay = [\"a\"]\n";
    let second = |keys: &str| format!("{group}{}", group.replace("play = [\"a\"]", keys));
    for (keys, text) in [
        (
            group.to_owned(),
            "s.toml: group: is given once; allowed: twice",
        ),
        (
            group.repeat(3),
            "s.toml: group: is given 3 times; allowed: twice",
        ),
        (
            second("play = []"),
            "s.toml:8: group 1: play: is empty; allowed: the name of a pattern",
        ),
        (
            second("play = [\"b\"]"),
            "s.toml:8: group 1: play: b is no pattern; allowed: a",
        ),
        (
            second("play = [\"a\"]\ncommand_tick = 1000000000001"),
            "s.toml:9: group 1: command_tick: is 1000000000001; allowed: 0 to 1000000000000",
        ),
        (
            second("play = [\"a\"]\ncommand_tick = -1"),
            "s.toml:9: command_tick: is -1; \
             allowed: a whole number from 0 to 1000000000000",
        ),
        (
            second("play = [\"a\"]\ntick = 1"),
            "s.toml:9: tick: unknown key; did you mean command_tick?; allowed: one of `play`, `command_tick`",
        ),
        (
            second("command_tick = 1"),
            "s.toml:7: play: missing, and has no default; allowed: a list of names of patterns",
        ),
    ] {
        let bench = Bench::with("t.csv", rows(2));
        bench.write("s.toml", format!("{ONE}{keys}"));
        bench.refuse(&["run", "s.toml"], text);
    }
    let bench = Bench::with("t.csv", rows(2));
    bench.write("s.toml", format!("{ONE}{group}{group}"));
    for (key, value) in [
        ("play", "[\"a\"]"),
        ("rewrite", "[{unit=0,unit_ticks=90}]"),
        ("standalone", "true"),
        ("motor", "{holding_torque_nm=1,inertia_kg_m2=5e-5}"),
    ] {
        let text = format!("--set: {key}: given beside [[group]]; allowed: one of both");
        bench.refuse(
            &["run", "s.toml", "--set", &format!("{key}={value}")],
            &text,
        );
    }
    let bench = Bench::with("l.hpgl", LINE);
    bench.refuse(
        &["run", "l.hpgl", "--set", "group=[{play=[\"a\"]}]"],
        "--set: group: without [[pattern]]; allowed: the command run, with [[pattern]] and no input",
    );
}

/// Each group has a memory of its own, with the patterns that it plays: what does not fit there is
/// told by the number that the pattern has in the scenario.
#[test]
fn a_pattern_that_a_group_cannot_hold_is_refused_by_its_own_number() {
    let bench = Bench::with("t.csv", rows(2));
    bench.write("l.csv", rows(4096));
    let of_y = HEADER.trim_end().to_owned() + ",y_half_period_ticks,y_down\n0,100,10,0,10,0\n";
    bench.write("xy.csv", of_y);
    let pattern = |name: &str| format!("[[pattern]]\nname = \"{name}\"\ntable = \"{name}.csv\"\n");
    let scenario = |first: &str, second: &str| {
        let circuit = "circuit = \"pulse_interpolator\"\n";
        let patterns = ["t", "l", "xy"].map(pattern).concat();
        format!("{circuit}{patterns}[[group]]\nplay = [{first}]\n[[group]]\nplay = [{second}]\n")
    };
    // Both fit, where each has the memory to itself.
    bench.write("s.toml", scenario("\"l\"", "\"xy\""));
    assert_eq!(bench.json(&["run", "s.toml", "--no-vcd"])["exact"], true);
    bench.write("s.toml", scenario("\"t\"", "\"t\", \"l\""));
    let full = "s.toml:7: pattern 1: table: has 4096 unit times; allowed: 4094 of the 4096 words of the memory";
    bench.refuse(&["run", "s.toml"], full);
    bench.write("s.toml", scenario("\"l\"", "\"l\", \"xy\""));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:10: pattern 2: table: has 2 axes; allowed: 1, as the first",
    );
}
