//! `run` of the lead-angle compensator: its systems and its summary.

mod completion;
mod detector;
mod files;
mod forms;
mod log;
mod operation;
mod refusals;
mod setter;

use super::support::{Bench, DRAWINGS, keys, list, number, paths, whole, without_sizes};
use expect_test::expect;
use serde_json::{Value, json};
use std::sync::LazyLock;

const STEPS: &str = "[[step]]\ntarget = 9000\nspeed_counts_per_s = 20000\n\
                     [[step]]\ntarget = 0\nspeed_counts_per_s = 40000\nlead_ms = 39.9\n";

/// A short job: six positionings to and fro, whose load changes after four.
const SMALL: &str = "\
circuit = \"lead_angle\"
clock_hz = 200_000
ck_ticks = 20
positionings = 6
load_change_after = 4
load_inertia_factor = 2
[[step]]
target = 3000
speed_counts_per_s = 20000
lead_ms = 15
[[step]]
target = 0
speed_counts_per_s = 40000
lead_ms = 15
";

/// Two steps that a log of 10 counts a millisecond comes by.
const LOG: &str = "\
circuit = \"lead_angle\"
input = \"log.csv\"
log_column = \"right\"
[[step]]
target = 1000
speed_counts_per_s = 10
lead_ms = 10
[[step]]
target = 3000
speed_counts_per_s = 10
lead_ms = 40
";

/// The turntable's summary.
static TURNTABLE: LazyLock<Value> =
    LazyLock::new(|| Bench::new().json(&["run", "waves/turntable.toml", "--no-vcd"]));

/// A bench with the short job in it.
fn small() -> Bench {
    Bench::with("s.toml", SMALL)
}

/// A bench with a scenario of a log, and the log: half a second at 10 counts a millisecond.
fn log() -> Bench {
    let bench = Bench::with("s.toml", LOG);
    let rows = (0..=500).map(|ms| format!("{},0,{}\n", 7000 + ms, 10 * ms));
    bench.write(
        "log.csv",
        "time, left, right\n".to_owned() + &rows.collect::<String>(),
    );
    bench
}

/// Where a system is in the lists of errors.
fn system(summary: &Value, name: &str) -> usize {
    let place = list(summary, "systems")
        .iter()
        .position(|system| system["name"] == name);
    place.unwrap_or_else(|| panic!("no {name}"))
}

#[test]
#[ignore = "takes long"]
fn the_turntable_shows_what_the_circuit_is_for() {
    let summary = &*TURNTABLE;
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(summary["warnings"], json!([]));
    assert_eq!(list(summary, "positionings").len(), 48);
    let learning = system(summary, "learning");
    let phases = list(summary, "phases");
    assert_eq!(phases.len(), 2);
    let mut functions = Vec::new();
    for (phase, loaded) in phases.iter().zip([false, true]) {
        assert_eq!(phase["loaded"], loaded);
        assert_eq!(list(phase, "steps").len(), 4);
        for step in list(phase, "steps") {
            let rows = list(summary, "positionings").iter();
            let rows = rows.filter(|row| row["loaded"] == loaded && row["step"] == step["step"]);
            let within = |row: &Value| {
                let error = row["error_counts"][learning].as_f64().unwrap();
                error.abs() <= number(row, "/code_travel_counts") + 1e-6
            };
            let within: Vec<bool> = rows.map(within).collect();
            assert_eq!(within.len(), 6);
            let after = (0..6).find(|&from| within[from..].iter().all(|&one| one));
            assert_eq!(step["settled_after"], json!(after), "{within:?}");
            assert!(after.is_some_and(|after| after > 0), "{step}");
            let by = &step["settled_by_function"];
            assert_eq!(by["first_order"], step["settled_after"]);
            functions.push(json!([by["first_order"], by["second_order"], by["exact"]]));
        }
    }
    // To first order, to second order and by the exact relation, step by step, with either load.
    assert_eq!(
        json!(functions),
        json!([
            [3, 2, 1],
            [1, 1, 1],
            [3, 2, 1],
            [3, 2, 1],
            [2, 1, 1],
            [2, 2, 1],
            [3, 2, 1],
            [3, 2, 1]
        ])
    );
    // The last of each step, by a limit that does not come from the summary: a code at 90000
    // counts/s is 5 CKs of 0.1 ms, 45 counts.
    for row in &list(summary, "positionings")[44..] {
        let error = |system: usize| row["error_counts"][system].as_i64().unwrap().abs();
        assert!(error(learning) <= 45, "{row}");
    }
    let rms = |name: &str| {
        number(
            &summary["systems"][system(summary, name)],
            "/error_rms_counts",
        )
    };
    for other in ["no lead", "by speed", "fixed lead", "literal sign"] {
        assert!(rms(other) > 2.5 * rms("learning"), "{other}");
    }
    for name in ["no lead", "literal sign"] {
        let largest = &summary["systems"][system(summary, name)]["error_max_counts"];
        assert!(largest.as_u64().unwrap() > 5000, "{name}");
    }
    assert_eq!(summary["systems"][learning]["own"], true);
    assert_eq!(summary["lead_times_of"], "learning");
}

#[test]
#[ignore = "takes long"]
fn the_literal_sign_drives_the_lead_times_to_their_ends() {
    let run = [
        "run",
        "waves/turntable.toml",
        "--no-vcd",
        "--set",
        "sign=literal",
    ];
    let fewer = ["--set", "positionings=32", "--set", "load_change_after=16"];
    let summary = Bench::new().json(&[&run[..], &fewer].concat());
    assert_eq!(summary["lead_times_of"], "literal sign");
    assert_eq!(
        summary["systems"][system(&summary, "literal sign")]["own"],
        true
    );
    let last = &list(&summary, "positionings")[28..];
    let leads: Vec<f64> = last.iter().map(|row| number(row, "/lead_ms")).collect();
    // The shortest code, and the longest where the first lead was too long.
    assert_eq!(leads, [199.0, 0.1, 0.1, 0.1]);
    for phase in list(&summary, "phases") {
        for step in list(phase, "steps") {
            assert_eq!(step["settled_after"], Value::Null);
        }
    }
}

#[test]
fn each_function_is_a_system_and_can_be_the_own_one() {
    let bench = small();
    let first = bench.json(&["run", "--beside", "s.toml", "--no-vcd"]);
    let [second, exact] = ["second_order", "exact"].map(|function| {
        let set = format!("function={function}");
        bench.json(&["run", "--beside", "s.toml", "--no-vcd", "--set", &set])
    });
    for (summary, function, own) in [
        (&first, "first_order", "learning"),
        (&second, "second_order", "second order"),
        (&exact, "exact", "exact relation"),
    ] {
        assert_eq!(summary["settings"]["function"], function);
        assert_eq!(summary["lead_times_of"], own);
        let systems = list(summary, "systems");
        let of = |name: &str| &systems[system(summary, name)]["own"];
        assert_eq!((of(own) == true, systems.len()), (true, 10));
        let owns = systems.iter().filter(|system| system["own"] == true);
        assert_eq!(owns.count(), 1);
    }
    // What the systems come to does not depend on which of them is in the waves; the last, with the
    // literal sign, is of the scenario's function.
    let errors = |summary: &Value| {
        let rows = list(summary, "positionings").iter();
        let errors = rows.map(|row| list(row, "error_counts")[..9].to_vec());
        errors.collect::<Vec<_>>()
    };
    assert_eq!(errors(&first), errors(&second));
    assert_eq!(errors(&first), errors(&exact));
    let leads = |summary: &Value| {
        let rows = list(summary, "positionings").iter();
        rows.map(|row| number(row, "/lead_ms")).collect::<Vec<_>>()
    };
    // The third positioning is the first that can have learned.
    assert_eq!(leads(&first)[..2], leads(&second)[..2]);
    assert!(leads(&first)[2] < leads(&second)[2]);
    assert!(leads(&second)[2] < leads(&exact)[2]);
    // How each learns is said.
    let text = bench.succeed(&["run", "s.toml", "--no-vcd", "--set", "function=exact"]);
    let said = "complete by standstill, learning by the exact relation, sign converging\n";
    assert!(text.contains(said), "{text}");
}

#[test]
fn the_summary_has_these_keys() {
    let summary = small().json(&["run", "--beside", "s.toml", "--no-vcd"]);
    let expected = [
        "circuit",
        "clock_hz",
        "complaints",
        "files",
        "input",
        "lead_times_of",
        "phases",
        "positionings",
        "seconds",
        "settings",
        "systems",
        "ticks",
        "vcd_window",
        "version",
        "warnings",
    ];
    assert_eq!(keys(&summary), expected);
    assert_eq!(summary["input"], "s");
    assert_eq!(summary["vcd_window"], Value::Null);
    assert_eq!(paths(&summary), json!(["waves/s.svg"]));
    let row = [
        "code_travel_counts",
        "end_speed_counts_per_s",
        "error_counts",
        "lead_ms",
        "loaded",
        "position_error_counts",
        "positioning",
        "step",
        "timed_out",
    ];
    let rows = list(&summary, "positionings");
    assert_eq!(keys(&rows[0]), row);
    let of = |key: &str| rows.iter().map(|row| row[key].clone()).collect::<Vec<_>>();
    assert_eq!(json!(of("step")), json!([0, 1, 0, 1, 0, 1]));
    let loaded = json!([false, false, false, false, true, true]);
    assert_eq!(json!(of("loaded")), loaded);
    // The first two lead times are the scenario's; at 20000 counts/s one of 150 CKs has a code
    // of 1 CK up to 199: 2 counts.
    assert_eq!(number(&rows[0], "/lead_ms"), 15.0);
    assert!((number(&rows[0], "/code_travel_counts") - 2.0).abs() < 0.01);
}

#[test]
fn people_see_the_last_of_each_step_or_every_positioning() {
    let text = small().succeed(&["run", "--beside", "s.toml", "--no-vcd", "--segments"]);
    expect![[r#"
        s on lead_angle: 6 positionings, 225442 ticks, 1.127 s at 200000 Hz, CK of 20 ticks
        history shift_register, lead on position, comparing crossing, complete by standstill, learning to first order, sign converging

        stop error in counts   largest       rms  missed  timed out
        no lead                   1555     910.3       0          0
        displaced switch           549     231.1       0          0
        by speed                   555     239.5       0          0
        tuned                      549     231.1       0          0
        by table                   545     229.5       0          0
        fixed lead                 955     464.6       0          0
        learning                   569     299.4       0          0  in the waves
        second order               545     285.7       0          0
        exact relation             545     284.4       0          0
        literal sign              1429     678.8       0          0

        positionings 0 to 3: stop error of the last of each step; lead of learning
        step    target   speed   no lead  displaced switch  by speed     tuned  by table  fixed lead  learning  second order  exact relation  literal sign      lead  one code  settled after  1st, 2nd, exact
           0      3000   20000       366                 0      -134         0         0          66        12             2               0           120   17.7 ms       2.0          never      never, 1, 1
           1         0   40000      1010                 4        10         0         0         410       160            66               0           652   21.2 ms       8.0          never  never, never, 1

        positionings 4 to 5, with the other load: stop error of the last of each step; lead of learning
        step    target   speed   no lead  displaced switch  by speed     tuned  by table  fixed lead  learning  second order  exact relation  literal sign      lead  one code  settled after  1st, 2nd, exact
           0      3000   20000       504               138         4       138       138         204       138           138             138           338   18.3 ms       2.0          never  never, never, never
           1         0   40000      1555               549       555       549       545         955       569           545             545          1429   24.6 ms       8.0          never  never, never, never

        positioning  step   no lead  displaced switch  by speed     tuned  by table  fixed lead  learning  second order  exact relation  literal sign      lead  one code
                  0     0       366                 0      -134         0         0          66        66            66              66            66   15.0 ms       2.0
                  1     1      1006                 0         6         0         0         406       406           406             406           406   15.0 ms       4.0
                  2     0       366                 0      -134         0         0          66        12             2               0           120   17.7 ms       2.0
                  3     1      1010                 4        10         0         0         410       160            66               0           652   21.2 ms       8.0
                  4     0       504               138         4       138       138         204       138           138             138           338   18.3 ms       2.0
                  5     1      1555               549       555       549       545         955       569           545             545          1429   24.6 ms       8.0

        wrote waves/s.svg
    "#]].assert_eq(&without_sizes(&text));
    let short = small().succeed(&["run", "--beside", "s.toml", "--no-vcd"]);
    let (start, end) = text.split_at(text.find("positioning  step").unwrap());
    let files = &end[end.find("wrote").unwrap()..];
    assert_eq!(short, start.to_owned() + files);
}

/// The simplest conventional system: as good as its distances are, up to the load change.
#[test]
#[ignore = "takes long"]
fn displaced_switches_stand_as_far_off_as_the_first_stops_went() {
    let summary = &*TURNTABLE;
    let [none, switch] = ["no lead", "displaced switch"].map(|name| system(summary, name));
    let phases = list(summary, "phases");
    let error = |step: &Value, system: usize| step["last_error_counts"][system].as_i64().unwrap();
    for (before, after) in list(&phases[0], "steps")
        .iter()
        .zip(list(&phases[1], "steps"))
    {
        assert!(error(before, switch).abs() <= 30, "{before}");
        let more = error(after, none) - error(before, none);
        let off = error(after, switch) - error(before, switch);
        assert!(more > 80 && (more - off).abs() <= 10, "{after}: {more}");
    }
    // One distance for all is right for one speed.
    let summary = Bench::new().json(&[
        "run",
        "waves/turntable.toml",
        "--no-vcd",
        "--set",
        "switch_counts=1200",
        "--set",
        "positionings=16",
        "--set",
        "load_change_after=8",
    ]);
    for row in list(&summary, "positionings") {
        let [none, switch] = [none, switch].map(|system| row["error_counts"][system].as_i64());
        let moved = none.unwrap() - switch.unwrap();
        assert!((moved - 1200).abs() <= 20, "{row}");
    }
}

/// Fig. 7 in the waves, with what it measures on top: by its parameter, and by its memory.
#[test]
#[ignore = "takes long"]
fn the_conventional_system_can_be_in_the_waves() {
    let bench = small();
    let other = small().json(&["run", "--beside", "s.toml", "--no-vcd"]);
    for (lead, name) in [("speed", "by speed"), ("table", "by table")] {
        let set = format!("lead={lead}");
        let run = ["run", "--beside", "s.toml", "--to", "3000", "--set", &set];
        let summary = bench.json(&run);
        assert_eq!(summary["settings"]["lead"], lead);
        let systems = list(&summary, "systems").iter();
        let own: Vec<_> = systems.filter(|system| system["own"] == true).collect();
        assert_eq!((own.len(), &own[0]["name"]), (1, &json!(name)));
        assert_eq!(summary["positionings"], other["positionings"]);
        let save = bench.read("waves/s.gtkw");
        let overview = save.split("-overview\n").nth(1).unwrap();
        let overview = overview.split("-ports in\n").next().unwrap();
        assert!(
            overview.contains("conventional_compensator.lead_source.speed["),
            "{overview}"
        );
        assert_eq!(overview.matches("conventional_compensator.").count(), 13);
        let text = bench.succeed(&run);
        let said = format!("complete by standstill, lead by {lead}\n");
        assert!(text.contains(&said), "{text}");
    }
}

#[test]
fn a_ram_gives_the_same() {
    let summary = |history: &str| {
        let set = format!("history={history}");
        let mut summary = small().json(&["run", "--beside", "s.toml", "--no-vcd", "--set", &set]);
        assert_eq!(summary["settings"]["history"], history);
        summary["settings"]["history"] = Value::Null;
        summary
    };
    assert_eq!(summary("ram"), summary("shift_register"));
}

/// No step comes to its speed: leads from a measured speed are less exact.
#[test]
#[ignore = "takes long"]
fn what_is_measured_on_the_way_to_speed_is_of_a_moment_ago() {
    let bench = Bench::new();
    let run = bench.json(&[
        "run",
        "waves/turntable.toml",
        "--no-vcd",
        "--set",
        "acceleration_counts_per_s2=60000",
    ]);
    let names: Vec<&str> = run["systems"]
        .as_array()
        .unwrap()
        .iter()
        .map(|system| system["name"].as_str().unwrap())
        .collect();
    let last = |phase: usize, name: &str| {
        let system = names.iter().position(|other| *other == name).unwrap();
        let steps = run["phases"][phase]["steps"].as_array().unwrap();
        let errors = steps.iter().map(|step| {
            let error = step["last_error_counts"][system].as_i64().unwrap();
            error.unsigned_abs()
        });
        errors.collect::<Vec<_>>()
    };
    assert_eq!(last(0, "tuned"), [1, 5, 2, 46]);
    assert_eq!(last(0, "by table"), [10, 5, 14, 18]);
    assert_eq!(last(0, "learning"), [1, 1, 8, 0]);
    assert_eq!(last(1, "tuned"), [91, 170, 539, 765]);
    assert_eq!(last(1, "by table"), [91, 176, 560, 827]);
    assert_eq!(last(1, "learning"), [3, 3, 3, 6]);
}
