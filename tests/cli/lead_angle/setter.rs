//! Times that the control computer sets.

use super::refusals::{refusal, refused};
use super::*;

#[test]
fn a_setter_gives_the_same_summary_as_a_rom() {
    let bench = small();
    let run = ["run", "--beside", "s.toml", "--to", "3000"];
    let mut setter = bench.json(&[&run[..], &["--set", "time_source=setter"]].concat());
    let vcd = bench.read("waves/s.vcd");
    let mut rom = small().json(&run);
    for summary in [&mut setter, &mut rom] {
        summary["files"] = Value::Null;
        summary["settings"]["time_source"] = Value::Null;
    }
    assert_eq!(setter, rom);
    // 150 CKs, written in the second tick and read with the step.
    assert!(vcd.contains("\nb10010110 "), "no time");
}

#[test]
fn times_for_another_load_are_told_with_their_step() {
    let prepared = SMALL.replace("lead_ms = 15\n", "lead_ms = 15\nload_lead_ms = 38.8\n");
    let bench = Bench::with("s.toml", &prepared);
    let summary = bench.json(&["run", "--beside", "s.toml", "--no-vcd"]);
    let own = system(&summary, "learning");
    let rows = list(&summary, "positionings");
    assert_eq!(number(&rows[5], "/lead_ms"), 38.8);
    let error = |summary: &Value| {
        summary["positionings"][5]["error_counts"][own]
            .as_i64()
            .unwrap()
    };
    let other = small().json(&["run", "--beside", "s.toml", "--no-vcd"]);
    // On the way to speed a time is not all there is to it.
    let [set, kept] = [&summary, &other].map(|summary| error(summary).abs());
    assert!(2 * set < kept, "{set}, {kept}");

    assert_eq!(
        refused("time_source = \"file\"\n"),
        "error: s.toml:2: time_source: unknown variant `file`; allowed: `rom` or `setter`\n"
    );
    let refused = |text: &str| refusal(&Bench::with("s.toml", text), &["s.toml"]);
    assert_eq!(
        refused(&prepared.replace("38.8", "38.9")),
        "error: s.toml:11: step 0: load_lead_ms: is 38.9; allowed: 38.8 or 39\n"
    );
    assert_eq!(
        refused(&prepared.replace("load_change_after = 4\n", "")),
        "error: s.toml:10: step 0: load_lead_ms: is 38.8; allowed: it with load_change_after only\n"
    );
    let common = "common_time = true\n".to_owned() + &prepared;
    let last = common.replace(
        "speed_counts_per_s = 40000\nlead_ms = 15\n",
        "speed_counts_per_s = 40000\n",
    );
    assert_eq!(
        refused(&last),
        "error: s.toml:16: step 1: load_lead_ms: is 38.8; allowed: none: with common_time all steps \
         take that of step 0\n"
    );
}
