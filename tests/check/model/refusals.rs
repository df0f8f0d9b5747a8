//! Errors of models: each says what is wrong, and nothing happens.

use motion_rtl::Model;
use motion_rtl::registry::Pair;
use motion_rtl::sim::{InputChange, ModelError};

fn pair(text: &str) -> Pair {
    text.parse().unwrap()
}

fn interpolator() -> Model {
    Model::new("linear_interpolator", &[pair("widths.position=20")]).unwrap()
}

fn text<T>(result: Result<T, ModelError>) -> String {
    result.err().expect("an error").to_string()
}

#[test]
fn circuits_and_keys() {
    assert_eq!(
        text(Model::new("linear_interpolatr", &[])),
        "no circuit is called linear_interpolatr; did you mean linear_interpolator?"
    );
    assert_eq!(text(Model::new("robot", &[])), "no circuit is called robot");
    let keys = [pair("widths.positon=20"), pair("rule=flor")];
    let refused = text(Model::new("linear_interpolator", &keys));
    assert!(
        refused.starts_with("linear_interpolator: widths.positon: no key"),
        "{refused}"
    );
    assert!(
        refused.contains("did you mean widths.position?"),
        "{refused}"
    );
    assert!(
        refused.contains("rule: unknown variant `flor`"),
        "{refused}"
    );
    let zero = Model::new("enable_counter", &[pair("width=0")]);
    assert!(matches!(zero, Err(ModelError::Settings { .. })), "{zero:?}");
}

#[test]
fn signals() {
    let mut model = interpolator();
    let unknown = text(model.find("target_X"));
    assert_eq!(
        unknown,
        "linear_interpolator has no signal target_X; near it: target_x, target_y, \
         targets.target_x"
    );
    for name in [
        "",
        ".",
        "x.",
        "[0]",
        "x[0]",
        "targets",
        "linear_interpolator.",
        "x ",
    ] {
        let error = model.get(name).unwrap_err();
        assert!(
            matches!(error, ModelError::UnknownSignal { .. }),
            "{name}: {error}"
        );
    }
    let signals = model.signals();
    let word = signals.iter().find(|signal| signal.path.ends_with("[0]"));
    let memory = word.unwrap().path.strip_suffix("[0]").unwrap().to_owned();
    let words = signals
        .iter()
        .filter(|signal| signal.path.starts_with(&format!("{memory}[")));
    let words = words.count();
    for bad in [
        format!("{memory}[{words}]"),
        format!("{memory}[01]"),
        memory.clone(),
    ] {
        let near = format!("; near it: {memory}[0]");
        assert!(
            text(model.find(&bad)).contains(&near),
            "{bad}: {}",
            text(model.find(&bad))
        );
    }
    assert!(model.find(&format!("{memory}[{}]", words - 1)).is_ok());
}

#[test]
fn only_input_ports_are_set() {
    let mut model = interpolator();
    let signals = model.signals();
    let word = signals.iter().find(|signal| signal.path.ends_with("[0]"));
    let word = word.unwrap().path.as_str();
    for (name, kind, near) in [
        ("x", "a net", ""),
        ("sequencer.state", "a register", ""),
        (
            "sequencer.scan",
            "an input port of a part",
            "; near it: scan",
        ),
        (word, "a word of a memory", ""),
    ] {
        let error = model.set(name, 0).unwrap_err();
        assert!(matches!(error, ModelError::NoInput { .. }), "{error}");
        let said = format!("{name} is {kind}; only input ports can be set{near}");
        assert_eq!(error.to_string(), said);
        let handle = model.find(name).unwrap();
        assert!(model.set_bits(handle, 0).is_err(), "{name}");
    }
}

#[test]
fn numbers_that_do_not_fit() {
    let mut model = interpolator();
    model.run(4);
    let least = -(1i64 << 19);
    model.set("target_x", least).unwrap();
    assert_eq!(model.get_signed("target_x").unwrap(), least);
    assert_eq!(
        text(model.set("target_x", least - 1)),
        "tick 4: port in target_x: -524289 does not fit; allowed are -524288 to 524287"
    );
    assert_eq!(
        text(model.set("target_x", u64::MAX)),
        "tick 4: port in target_x: 18446744073709551615 does not fit; allowed are -524288 to \
         524287"
    );
    assert_eq!(
        text(model.set("speed", -1)),
        "tick 4: port in speed: -1 does not fit; allowed are 0 to 1048575"
    );
    assert_eq!(
        text(model.set("scan", i128::MAX)),
        format!(
            "tick 4: port in scan: {} does not fit; allowed are 0 to 1",
            i128::MAX
        )
    );
    assert_eq!(
        text(model.set_bits("target_x", 1 << 20)),
        "tick 4: port in target_x: 1048576 does not fit; allowed are 0 to 1048575"
    );
    // 2^64 + 1 has the low bits of 1.
    assert!(model.set("scan", (1i128 << 64) + 1).is_err());
    assert_eq!(model.get_signed("target_x").unwrap(), least);
    assert_eq!(
        (model.get("speed").unwrap(), model.get("scan").unwrap()),
        (0, 0)
    );
    model.set_bits("target_x", 0xf_ffff).unwrap();
    assert_eq!(model.get_signed("target_x").unwrap(), -1);
    assert_eq!(model.get("target_x").unwrap(), 0xf_ffff);
    model.set("scan", true).unwrap();
    assert_eq!(model.get("scan").unwrap(), 1);
}

#[test]
fn handles_and_snapshots_of_other_circuits() {
    let mut model = interpolator();
    let mut wider = Model::new("linear_interpolator", &[pair("widths.position=21")]).unwrap();
    let x = wider.find("x").unwrap();
    let wrong =
        "the handle is of another circuit than this linear_interpolator, or of other settings";
    assert_eq!(text(model.get(x)), wrong);
    assert_eq!(text(model.set(wider.find("scan").unwrap(), 1)), wrong);
    assert_eq!(text(model.play(0, &[], &[x])), wrong);
    let snapshot = wider.snapshot();
    let wrong =
        "the snapshot is of another circuit than this linear_interpolator, or of other settings";
    assert_eq!(text(model.restore(&snapshot)), wrong);
    assert_eq!(model.tick(), 0);
    // An equal circuit is the same one.
    let other = interpolator();
    let same = other.find("x").unwrap();
    assert_eq!(model.get(same).unwrap(), 0);
    model.restore(&other.snapshot()).unwrap();
    wider.restore(&snapshot).unwrap();
    assert!(model.at(model.signals().len()).is_none());
}

#[test]
fn arrays() {
    let mut model = interpolator();
    model.run(10);
    let [scan, target, x] = ["scan", "target_x", "x"].map(|name| model.find(name).unwrap());
    assert_eq!(
        text(model.play(3, &[(scan, &[1, 0])], &[])),
        "2 values of scan for 3 ticks"
    );
    assert_eq!(
        text(model.play(2, &[(scan, &[1, 2])], &[])),
        "tick 11: port in scan: 2 does not fit; allowed are 0 to 1"
    );
    let least = (-(1i64 << 19) - 1) as u64;
    assert_eq!(
        text(model.play(1, &[(target, &[least])], &[])),
        "tick 10: port in target_x: -524289 does not fit; allowed are -524288 to 524287"
    );
    assert!(text(model.play(1, &[(x, &[0])], &[])).contains("only input ports can be set"));
    assert_eq!(model.tick(), 10);
    assert_eq!(model.play(0, &[], &[x]).unwrap(), [[0; 0]]);
}

#[test]
fn tables_of_changes() {
    let mut model = interpolator();
    model.run(10);
    let ports = ["scan", "target_x"].map(|name| model.find(name).unwrap().index());
    let [scan, target] = ports;
    let change = |tick, port, word| InputChange { tick, port, word };
    let mut refused = |changes: &[InputChange]| {
        let one = text(model.replay(20, changes, &[], |_| panic!("no tick happens")));
        let other = text(model.fast_replay(20, changes, &[], |_| panic!("no tick happens")));
        assert_eq!((&one, model.tick()), (&other, 10));
        one
    };
    assert_eq!(
        refused(&[change(12, scan, 1), change(11, target, 0)]),
        "tick 11: a change stands behind one of tick 12; changes must be sorted by tick"
    );
    assert_eq!(
        refused(&[
            change(12, scan, 1),
            change(12, target, 1),
            change(12, scan, 0)
        ]),
        "tick 12: port in scan changes twice; one change of a port is allowed in a tick"
    );
    assert_eq!(
        refused(&[change(12, scan, 1), change(99, scan, 2)]),
        "tick 99: port in scan: 2 does not fit; allowed are 0 to 1"
    );
    assert_eq!(
        refused(&[change(0, target, 1 << 20)]),
        "tick 0: port in target_x: 1048576 does not fit; allowed are 0 to 1048575"
    );
    let past = text(model.replay(20, &[change(11, 1000, 0)], &[], |_| {}));
    assert!(
        past.starts_with("tick 11: port in 1000 does not exist"),
        "{past}"
    );
    let wider = Model::new("linear_interpolator", &[pair("widths.position=21")]).unwrap();
    let x = wider.find("x").unwrap();
    let wrong =
        "the handle is of another circuit than this linear_interpolator, or of other settings";
    assert_eq!(text(model.replay(20, &[], &[x], |_| {})), wrong);
    assert_eq!(model.tick(), 10);
    assert_eq!(model.get("scan").unwrap(), 0);
}
