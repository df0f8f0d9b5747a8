//! Every circuit of the catalogue on every backend, under random inputs with resets.

use motion_rtl::check::Stimulus;
use motion_rtl::engine::{Engine, Watch};
use motion_rtl::registry::CATALOGUE;
use motion_rtl::sim::Elaborated;

/// Ticks before a compiled engine knows which blocks run often.
const COUNTED: u64 = 200;
const TICKS: u64 = 1_500;

/// An engine that is held against the interpreter, and the leaves it is asked for.
struct Held<'m> {
    what: &'static str,
    engine: Engine,
    leaves: &'m [usize],
    /// Tick at which the model is compiled.
    compiles: Option<u64>,
}

/// Runs all of them on the same inputs.
fn same(name: &str, model: &Elaborated) {
    let declared = model.declarations();
    let is_word = |leaf: usize| {
        let mut memories = declared.memories.iter();
        memories.any(|memory| (memory.first..memory.first + memory.words).contains(&leaf))
    };
    let all: Vec<usize> = (0..declared.leaves.len()).collect();
    let own: Vec<usize> = all.iter().copied().filter(|&leaf| !is_word(leaf)).collect();
    let ports = model.ports_out();

    let mut reference = model.engine(Watch::All);
    reference.interpret();
    let held = |what, watch, leaves, compiles| Held {
        what,
        engine: model.engine(watch),
        leaves,
        compiles,
    };
    let few = Watch::Leaves(&ports);
    let mut others = [
        held("compiled before it ran", Watch::All, &own[..], Some(0)),
        held("compiled when counted", Watch::All, &own[..], Some(COUNTED)),
        held("ports out alone, interpreted", few, &ports[..], None),
        held("ports out alone, compiled", few, &ports[..], Some(COUNTED)),
    ];
    let mut random = Stimulus::new(7);
    for tick in 0..TICKS {
        let reset = random.reset();
        random.apply(&mut reference);
        reference.settle();
        for other in &mut others {
            match other.compiles {
                Some(at) if at == tick => {
                    let compiled = other.engine.compile();
                    assert_eq!(compiled, cfg!(feature = "jit"), "{name}, {}", other.what);
                }
                None if tick == 0 => other.engine.interpret(),
                _ => {}
            }
            for port in 0..reference.ports() {
                let word = reference.port(port).unwrap();
                other.engine.input(port, word).unwrap();
            }
            other.engine.settle();
            for &leaf in other.leaves {
                assert_eq!(
                    other.engine.leaf(leaf),
                    reference.leaf(leaf),
                    "{name}, {}, tick {tick}: {}",
                    other.what,
                    declared.leaves[leaf].path()
                );
            }
        }
        let engines = others.iter_mut().map(|other| &mut other.engine);
        for engine in engines.chain([&mut reference]) {
            match reset {
                true => engine.reset(),
                false => engine.edge(),
            }
        }
    }
    // Memories once, and what is watched by nobody.
    reference.settle();
    for other in &mut others {
        other.engine.settle();
        for &leaf in &all {
            assert_eq!(
                other.engine.leaf(leaf),
                reference.leaf(leaf),
                "{name}, {}, at the end: {}",
                other.what,
                declared.leaves[leaf].path()
            );
        }
    }
}

#[test]
#[ignore = "takes long"]
fn every_circuit_at_its_own_widths() {
    for entry in CATALOGUE {
        same(entry.name, &entry.full().model().expect("a netlist"));
    }
}

/// Some circuits cannot be made at every width.
#[test]
fn every_circuit_at_narrow_widths() {
    for entry in CATALOGUE {
        for width in [2, 3, 4, 8] {
            let model = entry.scaled(width).map(|circuit| circuit.model());
            if let Some(Ok(model)) = model {
                same(&format!("{}[{width}]", entry.name), &model);
            }
        }
    }
}
