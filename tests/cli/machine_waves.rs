//! The machine's dump against its design: each register, net and word of a memory stands in it.

use super::support::{Bench, without_sizes};
use motion_rtl::circuits::machine::Machine;
use motion_rtl::jobs::machine::job::machine;
use motion_rtl::netlist::{Design, Port, Role};
use motion_rtl::scenario::{Loaded, Scenario};
use motion_rtl::sim::Elaborated;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;
use vcd::{Parser, ScopeItem, VarType};

/// The scenario of the first command of the README.
const SHIPPED: &str = include_str!("../../waves/machine.toml");

/// A signal, or a memory with so many words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Entry {
    Wire(usize),
    Register(usize),
    Memory { words: usize, width: usize },
}

/// The entries of each circuit inside another by its path; those of bundles have flat names.
type Entries = BTreeMap<String, BTreeMap<String, Entry>>;

fn below(path: &str, name: &str) -> String {
    match path {
        "" => name.to_owned(),
        _ => format!("{path}.{name}"),
    }
}

/// The entries of an elaborated design.
fn designed(design: &Design, module: usize, path: &str, all: &mut Entries) {
    let module = &design.modules[module];
    let own = module
        .signals
        .iter()
        .filter(|signal| signal.owner.is_none());
    let signals = own.map(|signal| {
        let width = signal.shape.width;
        let entry = match signal.role {
            Role::Register => Entry::Register(width),
            _ => Entry::Wire(width),
        };
        (signal.name.clone(), entry)
    });
    let written = module.memories.iter();
    let written = written.filter(|memory| !memory.inner && memory.port != Port::Rom);
    let memories = written.map(|memory| {
        let (words, width) = (memory.words, memory.width);
        (memory.name.clone(), Entry::Memory { words, width })
    });
    all.insert(path.to_owned(), signals.chain(memories).collect());
    for child in &module.instances {
        designed(design, child.module, &below(path, &child.name), all);
    }
}

/// The entries of a dump, whose circuits are those of `due`; `clk` and `plant` are no circuit's.
fn dumped(items: &[ScopeItem], (path, bundle): (&str, &str), due: &Entries, all: &mut Entries) {
    let flat = |name: &str| match bundle {
        "" => name.to_owned(),
        _ => format!("{bundle}_{name}"),
    };
    for item in items {
        match item {
            ScopeItem::Var(var) if path.is_empty() && var.reference == "clk" => {}
            // The name of a state, beside its number.
            ScopeItem::Var(var) if var.var_type == VarType::String => {}
            ScopeItem::Var(var) => {
                let width = var.size as usize;
                let entry = match var.var_type {
                    VarType::Reg => Entry::Register(width),
                    _ => Entry::Wire(width),
                };
                let own = all.entry(path.to_owned()).or_default();
                assert_eq!(own.insert(flat(&var.reference), entry), None, "{path}");
            }
            ScopeItem::Scope(scope) if path.is_empty() && scope.identifier == "plant" => {}
            ScopeItem::Scope(scope) => {
                let name = flat(&scope.identifier);
                let memory = due[path].get(&name);
                if due.contains_key(&below(path, &name)) {
                    dumped(&scope.items, (&below(path, &name), ""), due, all);
                } else if let Some(Entry::Memory { .. }) = memory {
                    let widths: Vec<usize> = words(&scope.items).collect();
                    assert!(widths.iter().all(|width| *width == widths[0]), "{name}");
                    let (words, width) = (widths.len(), widths[0]);
                    let own = all.entry(path.to_owned()).or_default();
                    own.insert(name, Entry::Memory { words, width });
                } else {
                    dumped(&scope.items, (path, &name), due, all);
                }
            }
            _ => {}
        }
    }
}

/// Widths of the words of a memory.
fn words(items: &[ScopeItem]) -> impl Iterator<Item = usize> + '_ {
    items.iter().map(|item| match item {
        ScopeItem::Var(var) if var.var_type == VarType::Reg => var.size as usize,
        other => panic!("no word: {other:?}"),
    })
}

/// The machine of a scenario's text.
fn machine_of(text: &str) -> Machine {
    let loaded = Loaded::parse("s.toml", text, &[]).unwrap();
    match loaded.scenario {
        Scenario::Machine(scenario) => machine(&scenario.settings),
        other => panic!("{other:?}"),
    }
}

/// Compares the dump of a run with the design of a scenario's machine, and returns the entries.
fn whole(bench: &Bench, dump: &str, scenario: &str) -> Entries {
    let model = Elaborated::new(&machine_of(scenario)).unwrap();
    let design = model.design();
    let mut due = Entries::new();
    designed(design, design.modules.len() - 1, "", &mut due);

    let file = BufReader::new(File::open(bench.path(dump)).unwrap());
    let header = Parser::new(file).parse_header().unwrap();
    let [whole] = header
        .items
        .iter()
        .filter_map(|item| match item {
            ScopeItem::Scope(scope) => Some(scope),
            _ => None,
        })
        .collect::<Vec<_>>()[..]
    else {
        panic!("not one scope");
    };
    assert_eq!(whole.identifier, "machine");
    let mut seen = Entries::new();
    dumped(&whole.items, ("", ""), &due, &mut seen);
    for (path, entries) in &due {
        assert_eq!(seen.get(path), Some(entries), "{path}");
    }
    assert_eq!(seen.len(), due.len());
    due
}

const HISTORY: &str = "lead_angle.lead_source.history";

/// The circuit of the first command, on a shorter way.
#[test]
fn each_register_net_and_word_of_the_machine_is_in_its_dump() {
    let bench = Bench::with("s.toml", SHIPPED);
    bench.write("bracket.ngc", "G1 X0.01 F1500\n");
    let run = ["run", "s.toml", "--out", "o", "--from", "0", "--to", "1"];
    let said = bench.succeed(&run);
    let entries = whole(&bench, "o/s.vcd", SHIPPED);
    // Figs 1 and 2: a shift register of 199 positions behind the present one, and the tap selector.
    let (words, width) = (199, 24);
    let history = &entries[HISTORY];
    assert_eq!(history["stages"], Entry::Memory { words, width });
    assert_eq!(history["tap"], Entry::Wire(8));
    assert!(entries["pulse_interpolator"].len() > 10);

    // The RAM is asked for.
    let ram = SHIPPED.replace(
        "lift_history = \"shift_register\"",
        "lift_history = \"ram\"",
    );
    assert_ne!(ram, SHIPPED);
    // It makes no difference to the job.
    let other = bench.succeed(&[&run[..], &["--set", "lift_history=ram"]].concat());
    assert_eq!(without_sizes(&other), without_sizes(&said));
    let entries = whole(&bench, "o/s.vcd", &ram);
    let words = 256;
    let history = &entries[HISTORY];
    assert_eq!(history["samples"], Entry::Memory { words, width });
    assert_eq!(history["address"], Entry::Register(8));
}

/// The first command of the README as it stands there.
#[test]
#[ignore = "takes long"]
fn each_register_net_and_word_of_the_default_job_is_in_its_dump() {
    let bench = Bench::new();
    bench.succeed(&[]);
    whole(&bench, "waves/machine.vcd", SHIPPED);
}
