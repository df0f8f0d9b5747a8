//! The count law over all states and inputs: kept by the safe variant, broken by the literal one.
//!
//! The invariants of every circuit of the catalogue are proved where the notes tell of it, in
//! `tests/cli/notes`.

use motion_rtl::check::{Outcome, Specified, reach};
use motion_rtl::circuits::pulse_interpolator::unit_law::In;
use motion_rtl::circuits::pulse_interpolator::{UnitLaw, Variant};
use motion_rtl::hdl::Value;
use motion_rtl::trace::Clock;

/// Data as the table compiler would write it: T of at least 2, half-periods within T.
fn sound(i: &In<Value>) -> bool {
    let (n, period) = (i.half_period, i.period);
    period >= 2 && n >= 1 && n < period
}

#[test]
fn the_literal_variant_breaks_the_count_law_at_once() {
    let circuit = UnitLaw {
        width: 3,
        variant: Variant::Literal,
    };
    let law = circuit.count_law();
    let found = reach(&circuit, &law)
        .inputs(sound)
        .run()
        .expect("narrow enough");
    let found = found
        .counterexample()
        .expect("the literal variant miscounts");
    let data = found.inputs.iter().map(|i| (i.half_period, i.period));
    // The counter runs on over RST.
    expect_test::expect!["[(1, 3), (1, 2), (1, 2), (1, 2), (1, 2), (1, 2)] tick 5: 0 pulses with n = 1 and T = 2, the law says 1"]
    .assert_eq(&format!(
        "{:?} tick {}: {}",
        data.collect::<Vec<_>>(),
        found.tick,
        found.message
    ));
    assert!(found.signals.iter().any(|signal| signal == "step"));

    let directory = tempfile::tempdir().expect("a temporary directory");
    let files = found
        .save(&circuit, Clock::default(), directory.path())
        .expect("waves");
    let endings: Vec<_> = files.iter().filter_map(|file| file.extension()).collect();
    assert_eq!(endings, ["vcd", "gtkw"]);
    assert!(
        files
            .iter()
            .all(|file| file.metadata().is_ok_and(|file| file.len() > 0))
    );
}

#[test]
fn the_safe_variant_keeps_the_count_law_whatever_the_data() {
    let circuit = UnitLaw {
        width: 4,
        variant: Variant::Safe,
    };
    let all = circuit.invariants();
    let outcome = reach(&circuit, &all).run().expect("narrow enough");
    assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
}
