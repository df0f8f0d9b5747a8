//! Equal forms of the lead: each beside that of the figures.

use super::refusals::{refusal, refused};
use super::*;

/// The forms with N of the table, and their own one beside them.
#[test]
#[ignore = "takes long"]
fn a_form_has_that_of_the_figures_beside_it() {
    let bench = small();
    let drawn = small().json(&["run", "--beside", "s.toml", "--no-vcd"]);
    assert_eq!(drawn["settings"]["form"], "embodiment");
    for form in ["divided_time", "products", "early_difference"] {
        let set = format!("form={form}");
        let run = ["run", "--beside", "s.toml", "--to", "3000", "--set", &set];
        let summary = bench.json(&run);
        assert_eq!(summary["settings"]["form"], form);
        let [own, other] = ["learning", "embodiment"].map(|name| system(&summary, name));
        assert_eq!((other, list(&summary, "systems").len()), (10, 11));
        assert_eq!(summary["systems"][own]["own"], true);
        for (row, before) in list(&summary, "positionings")
            .iter()
            .zip(list(&drawn, "positionings"))
        {
            assert_eq!(row["error_counts"][own], row["error_counts"][other]);
            assert_eq!(row["error_counts"][own], before["error_counts"][own]);
        }
        let vcd = bench.read("waves/s.vcd");
        assert_eq!(vcd.contains(" compared_position "), form != "products");
        assert_eq!(vcd.contains(" learned_data "), form == "divided_time");
        assert_eq!(vcd.contains(" ways0 "), form == "early_difference");
        let text = bench.succeed(&run);
        assert!(
            text.contains(&format!("\nhistory shift_register, form {form}, lead on")),
            "{text}"
        );
    }
}

/// With N fixed at 1 there are times that the figures have not: then nothing stands beside it.
#[test]
#[ignore = "takes long"]
fn a_fixed_ratio_has_every_time() {
    let bench = small();
    let run = [
        "run",
        "--beside",
        "s.toml",
        "--no-vcd",
        "--set",
        "form=fixed_ratio",
        "--set",
        "history=ram",
    ];
    let summary = bench.json(&run);
    assert_eq!(system(&summary, "embodiment"), 10);
    // 212 CKs on the way to 213; of 8 counts each at 40000 counts/s, where N = 2 has two of them.
    let row = &list(&summary, "positionings")[3];
    assert!(
        (number(row, "/code_travel_counts") - 4.0).abs() < 0.01,
        "{row}"
    );
    let odd = "step=[{target=3000,speed_counts_per_s=20000,lead_ms=20.1},{target=0,speed_counts_per_s=9000}]";
    let summary = bench.json(&[&run[..], &["--set", odd]].concat());
    assert_eq!(list(&summary, "systems").len(), 10);
    assert_eq!(
        refusal(&bench, &["s.toml", "--set", odd]),
        "error: --set: step 0: lead_ms: is 20.1; allowed: 20 or 20.2\n"
    );
}

#[test]
fn what_a_form_has_not_is_refused() {
    assert_eq!(
        refused("form = \"sum\"\n"),
        "error: s.toml:2: form: unknown variant `sum`; allowed: one of `embodiment`, `divided_time`, \
         `fixed_ratio`, `products`, `fixed_ratio_products`, `early_difference`\n"
    );
    assert_eq!(
        refused("form = \"early_difference\"\nhistory = \"ram\"\n"),
        "error: s.toml:2: form: is early_difference; allowed: another with history = \"ram\", which \
         is its own take-out, or history = \"shift_register\"\n"
    );
    for form in ["products", "fixed_ratio_products"] {
        for placement in ["target", "halves"] {
            assert_eq!(
                refused(&format!("form = \"{form}\"\nplacement = \"{placement}\"\n")),
                format!(
                    "error: s.toml:3: placement: is {placement}; allowed: position with form = \
                     \"{form}\": its products are the place itself\n"
                )
            );
        }
    }
    let long = "seed_ms = 199.1\n";
    assert_eq!(
        refused(&format!("form = \"fixed_ratio\"\n{long}")),
        "error: s.toml:3: seed_ms: is 199.1; allowed: at most 199\n"
    );
}
