//! Dumps of catalogued circuits name the output ports that Verilog has.

use super::{CATALOGUE, find};
use crate::trace::Layout;

/// The ports named in a dump are the output ports in Verilog.
#[test]
fn ports_out_are_those_of_the_outermost_circuit() {
    let mut bundles = 0;
    for entry in CATALOGUE {
        let circuit = entry.small();
        let model = circuit.model().unwrap();
        let layout = Layout::of(&model, None).unwrap();
        assert_eq!(layout.ports_out, model.ports_out(), "{}", entry.name);
        assert!(!layout.ports_out.is_empty(), "{}", entry.name);
        let deep = |leaf: &&usize| layout.leaves[**leaf].scopes.len() > 1;
        bundles += layout.ports_out.iter().filter(deep).count();
    }
    assert!(bundles > 0, "no circuit has a bundle of ports out");
}

/// For a part alone in a dump, they are its own ports.
#[test]
fn of_a_selection_the_outermost_circuit_counts() {
    let entry = find("unit_law").unwrap();
    let model = entry.full().model().unwrap();
    let ports = |only: &[&str]| -> Vec<String> {
        let only: Vec<String> = only.iter().map(|&path| path.to_owned()).collect();
        let layout = Layout::of(&model, Some(&only)).unwrap();
        let leaves = layout
            .ports_out
            .iter()
            .map(|&leaf| layout.leaves[leaf].path());
        leaves.collect()
    };
    assert_eq!(ports(&["unit_law"]), ["unit_law.step"]);
    assert_eq!(
        ports(&["unit_law.step", "unit_law.counter"]),
        ["unit_law.step"]
    );
    let inner = ports(&["unit_law.counter", "unit_law.sync"]);
    assert!(
        inner.contains(&"unit_law.counter.enable".to_owned()),
        "{inner:?}"
    );
    assert!(
        inner.contains(&"unit_law.sync.step".to_owned()),
        "{inner:?}"
    );
    assert_eq!(ports(&["unit_law.period", "unit_law.held_period"]), [""; 0]);
}
