//! Printed counterexamples.

use crate::circuits::*;
use expect_test::expect;
use motion_rtl::check::{Invariants, reach, require};
use motion_rtl::sim::Sample;
use motion_rtl::trace::Clock;

#[test]
fn a_counterexample_prints_its_last_ticks() {
    let circuit = Lock { code: [3, 1, 2] };
    let shut = Invariants::new().always("shut", |now: &Sample<'_, Lock>| {
        require(now.q.right < 3, ["right"], || "it is open".into())
    });
    let outcome = reach(&circuit, &shut).run().unwrap();
    expect![[r#"
        tick 3: shut: it is open (signals: right)
        tick         0    1    2     3     4
        * right   shut  one  two  open  open
          digit      3    1    2     0
          wanted     3    1    2     0
          fits       1    1    1     1
    "#]]
    .assert_eq(&outcome.to_string());
}

#[test]
fn only_the_last_ticks_are_printed() {
    let circuit = Down { flaw: 0 };
    let low = Invariants::new().always("not for long", |now: &Sample<'_, Down>| {
        require(now.w.count < 4, ["count"], || "four".into())
    });
    let outcome = reach(&circuit, &low).run().unwrap();
    expect![[r#"
        tick 4: not for long: four (signals: count)
        tick      0  1  2  3  4  5
        * count   0  1  2  3  4
          enable  1  1  1  1  0
          left    4  3  2  1  0  0
          last    0  0  0  0  1
    "#]]
    .assert_eq(&format!("{outcome:?}"));

    let circuit = Up { n: 16 };
    let low = Invariants::new().always("below 12", |now: &Sample<'_, Up>| {
        require(now.q.count < 12, ["modulo.count"], || "12".into())
    });
    let found = reach(&circuit, &low)
        .run()
        .unwrap()
        .counterexample()
        .unwrap();
    expect![[r#"
        tick 12: below 12: 12 (signals: modulo.count)
        tick      5  6  7  8  9  10  11  12  13
        * count   5  6  7  8  9  10  11  12  12
          enable  1  1  1  1  1   1   1   0
          last    0  0  0  0  0   0   0   0
          carry   0  0  0  0  0   0   0   0
    "#]]
    .assert_eq(&format!("{found:?}"));
}

#[test]
fn a_counterexample_is_saved_as_waves() {
    let circuit = Lock { code: [3, 1, 2] };
    let shut = Invariants::new().always("shut, always", |now: &Sample<'_, Lock>| {
        require(now.q.right < 3, ["right"], || "it is open".into())
    });
    let found = reach(&circuit, &shut).run().unwrap();
    let found = found.counterexample().unwrap();
    let clock = Clock::from_hz(1_000_000).unwrap();
    let dir = tempfile::tempdir().unwrap();
    let paths = found.save(&circuit, clock, dir.path()).unwrap();
    let names: Vec<_> = paths.iter().map(|path| path.file_name().unwrap()).collect();
    assert_eq!(names, ["lock_shut__always.vcd", "lock_shut__always.gtkw"]);
    let waves = std::fs::read_to_string(&paths[0]).unwrap();
    assert!(waves.contains("right"), "{waves}");
    // Saving creates the directory, but not in place of a file.
    assert!(found.save(&circuit, clock, &dir.path().join("new")).is_ok());
    assert!(found.save(&circuit, clock, &paths[0]).is_err());
}
