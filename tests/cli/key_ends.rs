//! The numbers that the schemas of scenarios allow, on the program.

use super::support::Bench;
use serde_json::Value;
use std::time::Duration;

/// Time after which a run has begun: its settings are accepted.
const BEGUN: Duration = Duration::from_millis(500);

/// Longest time until a setting is refused.
const REFUSED: Duration = Duration::from_secs(20);

/// Jobs with a scenario each, and those of the tables that have no defaults.
const JOBS: [(&str, &str, &str); 9] = [
    ("pulse_interpolator", "", "waves/bracket.toml"),
    ("pulse_interpolator", "motor.", "waves/bracket.toml"),
    ("linear_interpolator", "", "waves/plotter.toml"),
    ("lead_angle", "", "waves/turntable.toml"),
    ("arc_generator", "", "waves/weld.toml"),
    ("arc_generator", "arm.", "waves/weld.toml"),
    ("arc_generator", "mechanism.", "waves/weld.toml"),
    ("trajectory_controller", "", "waves/circle.toml"),
    ("machine", "", "waves/machine.toml"),
];

/// Tables that have no defaults.
const WITHOUT: [&str; 3] = ["motor.", "arm.", "mechanism."];

/// A key that takes a number, or a list of numbers.
struct Number {
    key: String,
    whole: bool,
    /// Least and greatest number.
    ends: [Value; 2],
    /// Numbers of the list.
    count: usize,
}

impl Number {
    fn of(key: String, schema: &Value, count: usize) -> Self {
        let end = |name| {
            let end = schema.get(name);
            end.unwrap_or_else(|| panic!("{key} has no {name}")).clone()
        };
        Number {
            ends: [end("minimum"), end("maximum")],
            whole: schema["type"] == "integer",
            count,
            key,
        }
    }

    /// The pair for a value.
    fn set(&self, value: &str) -> String {
        match self.count {
            0 => format!("{}={value}", self.key),
            count => format!("{}=[{}]", self.key, vec![value; count].join(",")),
        }
    }

    /// The ends as they are written.
    fn inside(&self) -> [String; 2] {
        self.ends.each_ref().map(|end| match self.whole {
            true => end.to_string(),
            false => format!("{:e}", end.as_f64().expect("a number")),
        })
    }

    /// The nearest numbers outside the ends.
    fn outside(&self) -> [String; 2] {
        if self.whole {
            let [least, most] = self
                .ends
                .each_ref()
                .map(|end| i128::from(end.as_i64().unwrap()));
            return [least - 1, most + 1].map(|end| end.to_string());
        }
        let [least, most] = self.ends.each_ref().map(|end| end.as_f64().unwrap());
        [least.next_down(), most.next_up()].map(|end| format!("{end:e}"))
    }
}

/// Adds the numbers of a table's schema.
fn numbers(schema: &Value, before: &str, found: &mut Vec<Number>) {
    for (name, schema) in schema["properties"].as_object().expect("keys") {
        let key = format!("{before}{name}");
        let items = &schema["items"];
        let is_number = |schema: &Value| schema["type"] == "number" || schema["type"] == "integer";
        if schema["type"] == "object" {
            numbers(schema, &format!("{key}."), found);
        } else if is_number(schema) {
            found.push(Number::of(key, schema, 0));
        } else if is_number(items) {
            // One number for all axes is enough where a list may be left out.
            let least = schema["minItems"].as_u64().unwrap_or(1) as usize;
            let count = if schema["type"] == "array" { least } else { 0 };
            found.push(Number::of(key, items, count));
        }
    }
}

/// The numbers of a job that begin with a table, or with none of those without defaults.
fn of_job(bench: &Bench, job: &str, table: &str) -> Vec<Number> {
    let text = bench.succeed(&["keys", job, "--json-schema"]);
    let mut found = Vec::new();
    numbers(&serde_json::from_str(&text).unwrap(), "", &mut found);
    found.retain(|number| match table {
        "" => !WITHOUT.iter().any(|table| number.key.starts_with(table)),
        table => number.key.starts_with(table),
    });
    assert!(!found.is_empty(), "{job} {table}");
    found
}

/// Runs a scenario with a value for a time, unless it ends before; its exit code, and the first line of what it
/// says.
fn begun(bench: &Bench, scenario: &str, set: &str, time: Duration) -> Option<(i32, String)> {
    let arguments = [
        "run", scenario, "--set", set, "--no-vcd", "--out", "o", "--quiet",
    ];
    let output = bench.command(&arguments).timeout(time).output();
    let output = output.expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr);
    let first = said.lines().find(|line| line.starts_with("error: "));
    Some((output.status.code()?, first.unwrap_or_default().to_owned()))
}

/// What a run says of a number outside of its range.
fn refused(bench: &Bench, scenario: &str, number: &Number) {
    for value in number.outside() {
        let set = number.set(&value);
        let begun = begun(bench, scenario, &set, REFUSED);
        let (code, said) = begun.unwrap_or_else(|| panic!("{scenario} {set} runs"));
        let of_key = said.starts_with(&format!("error: --set: {}: ", number.key));
        assert!(code == 2 && of_key, "{scenario} {set}: {code}: {said}");
    }
}

#[test]
fn numbers_outside_of_the_schema_are_refused() {
    let bench = Bench::new();
    for number in of_job(&bench, "lead_angle", "") {
        // Others are tried where it takes long.
        if !number.key.starts_with("program.") {
            refused(&bench, "waves/turntable.toml", &number);
        }
    }
}

#[test]
#[ignore = "takes long"]
fn numbers_outside_of_the_schema_of_all_jobs_are_refused() {
    let bench = Bench::new();
    for (job, table, scenario) in JOBS {
        let scenario = with_table(&bench, scenario, table);
        for number in of_job(&bench, job, table) {
            refused(&bench, &scenario, &number);
        }
    }
}

/// The ends of a schema run, or are refused by a message about a setting: about another one, or about
/// the key itself where its listing says on what else it depends.
#[test]
#[ignore = "takes long"]
fn ends_of_the_schema_run_or_are_refused_as_settings() {
    let bench = Bench::new();
    let mut wrong = Vec::new();
    for (job, table, scenario) in JOBS {
        let scenario = with_table(&bench, scenario, table);
        let rows = bench.json(&["keys", job]);
        let rows = rows["scenario"].as_array().unwrap().clone();
        for number in of_job(&bench, job, table) {
            let row = rows.iter().find(|row| row["key"] == number.key.as_str());
            let range = row.expect("a row")["range"].as_str().unwrap().to_owned();
            for value in number.inside() {
                let set = number.set(&value);
                let Some((2, said)) = begun(&bench, &scenario, &set, BEGUN) else {
                    continue;
                };
                let own = said.starts_with(&format!("error: --set: {}: ", number.key));
                let plain = range.split(" to ").all(|end| end.parse::<f64>().is_ok());
                let place = said.strip_prefix("error: ").unwrap_or(&said);
                let of_setting = ["--set: ", "waves/", "s.toml"];
                if own && plain || !of_setting.iter().any(|start| place.starts_with(start)) {
                    wrong.push(format!("{scenario} {set}: {range}: {said}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A scenario that has the table: the file itself, or one of its text and the table.
fn with_table(bench: &Bench, scenario: &str, table: &str) -> String {
    let keys = match table {
        "motor." => "\n[motor]\nholding_torque_nm = 1.0\ninertia_kg_m2 = 5e-5\n",
        "arm." => "\n[arm]\nupper_mm = 500\nfore_mm = 500\n",
        "mechanism." => "\n[mechanism]\nfrequency_hz = 10\n",
        _ => return scenario.to_owned(),
    };
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(root.join(scenario)).unwrap();
    let header = format!("[{}]", table.trim_end_matches('.'));
    let more = if text.contains(&header) { "" } else { keys };
    bench.write("s.toml", format!("{text}{more}"));
    for entry in std::fs::read_dir(root.join("waves")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|end| end == "ngc") {
            let name = path.file_name().unwrap().to_str().unwrap();
            bench.write(name, std::fs::read(&path).unwrap());
        }
    }
    "s.toml".to_owned()
}

#[test]
fn torques_that_the_waves_do_not_hold_are_settings_out_of_range() {
    let bench = Bench::new();
    for (sets, said) in [
        (
            &["friction_nm=1e9"][..],
            "--set: friction_nm: is 1000000000; allowed: 0 to 2147483",
        ),
        (
            &["brake_torque_nm=2e6", "load_brake_factor=2"],
            "--set: load_brake_factor: is 2: friction and brake are 4000001.8 N·m; allowed: 1.0737406 \
             at most: 2147483 N·m together",
        ),
        (
            &["friction_nm=2e6", "brake_torque_nm=1e6"],
            "--set: friction_nm: is 2000000: friction and brake are 3000000 N·m; allowed: 1147483 at \
             most: 2147483 N·m together",
        ),
    ] {
        let sets = sets.iter().flat_map(|set| ["--set", set]);
        let arguments = ["run", "waves/turntable.toml", "--no-vcd"];
        let arguments: Vec<_> = arguments.into_iter().chain(sets).collect();
        bench.refuse_with(&arguments, |stderr| {
            assert_eq!(stderr.lines().next(), Some(&*format!("error: {said}")));
        });
    }
}

#[test]
fn limits_that_leave_nothing_say_so() {
    let bench = Bench::new();
    let said = |scenario: &str, set: &str| {
        let done = bench.run(&["run", scenario, "--no-vcd", "--set", set]);
        assert_eq!(done.code, 2, "{set}");
        done.stderr.lines().next().unwrap_or_default().to_owned()
    };
    let slow = said("waves/turntable.toml", "clock_hz=1");
    assert!(
        slow.ends_with(
            "speed_counts_per_s: is 20000, and the detector follows 1 at most; allowed: 10 or more, at \
             a faster clock or with a finer detector"
        ),
        "{slow}"
    );
    let weak = said("waves/circle.toml", "integral_ms=1e9");
    assert!(
        weak.contains("its gain word is 0.000004222, which rounds to 0; allowed: "),
        "{weak}"
    );
    let fast = said("waves/circle.toml", "position_gain_per_s=1e9");
    assert!(
        fast.contains("its gain word is 1024000000000, above 16777215; allowed: "),
        "{fast}"
    );
    let huge = said("waves/turntable.toml", "rest_ms=1e300");
    assert!(
        huge.ends_with("rest_ms: is 1e300; allowed: 0.1 to 6553.5"),
        "{huge}"
    );
}

#[test]
fn a_table_of_half_periods_is_no_position_log() {
    let bench = Bench::new();
    let table = include_bytes!("../../waves/stroke.csv");
    bench.write("stroke.csv", table);
    let said = "header: is a table of half-periods, the memory of a pulse interpolator; allowed: a \
                scenario that names it, [[pattern]] with table = FILE as in waves/patterns.toml; a \
                drawing, a part program or a position log";
    for arguments in [
        &["run", "stroke.csv"][..],
        &["stroke.csv"],
        &["run", "stroke.csv", "--input-format", "csv"],
    ] {
        bench.refuse(arguments, &format!("stroke.csv:1: {said}"));
    }
    let piped = bench
        .command(&["run", "-", "--input-format", "csv"])
        .write_stdin(&table[..])
        .output();
    let piped = String::from_utf8(piped.unwrap().stderr).unwrap();
    assert!(
        piped.starts_with(&format!("error: <stdin>:1: {said}")),
        "{piped}"
    );
}
