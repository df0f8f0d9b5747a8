//! Properties of the text of every circuit.

use super::{circuits, flat};
use motion_rtl::netlist::{Kind, Shape};
use motion_rtl::trace::Clock;
use motion_rtl::verilog::{SourceFile, Verilog};
use std::collections::{BTreeSet, HashMap, HashSet};

/// A product of two words that are extended with their signs is not broken.
const LONGEST: usize = 125;

/// Declarations of a module: its names with their kind and width, and its instances with their
/// modules.
#[derive(Default)]
struct Module {
    names: HashMap<String, (bool, usize)>,
    instances: Vec<(String, String)>,
}

/// Reads the declarations of a module as they are printed, one a line.
fn read(source: &SourceFile, modules: &HashSet<&str>) -> Module {
    let mut module = Module::default();
    let mut open = None;
    let mut icarus = false;
    for line in source.text.lines() {
        // The wires of words have one name in every memory, in a scope of its own.
        icarus = line == "`ifdef __ICARUS__" || icarus && line != "`endif";
        if icarus {
            continue;
        }
        let code = line.split("//").next().unwrap_or_default();
        let mut words = code.split_whitespace().peekable();
        let first = words.next().unwrap_or_default();
        match first {
            "input" | "output" => drop(words.next()),
            "reg" | "wire" => {}
            ")" if open.is_some() => {
                let name = words.next().unwrap_or_default().to_owned();
                module.instances.push((name, open.take().unwrap()));
                continue;
            }
            _ if modules.contains(first) => {
                match words.next() {
                    Some("#(") => open = Some(first.to_owned()),
                    Some(name) => module.instances.push((name.to_owned(), first.to_owned())),
                    None => panic!("{line}"),
                }
                continue;
            }
            _ => continue,
        }
        let signed = words.next_if_eq(&"signed").is_some();
        let width = match words.next_if(|word| word.starts_with('[')) {
            Some(range) => {
                let high = range.trim_start_matches('[').split(':').next().unwrap();
                1 + high.parse::<usize>().unwrap()
            }
            None => 1,
        };
        let name = words
            .next()
            .unwrap_or_default()
            .trim_end_matches([',', ';']);
        let fresh = module.names.insert(name.to_owned(), (signed, width));
        assert_eq!(fresh, None, "{name} is declared twice in {}", source.name);
    }
    module
}

/// The declared names of a module and those inside it, joined by `_`.
fn collect(
    modules: &HashMap<String, Module>,
    module: &str,
    around: &str,
    names: &mut HashMap<String, (bool, usize)>,
) {
    for (name, shape) in &modules[module].names {
        names.insert(format!("{around}_{name}"), *shape);
    }
    for (name, inside) in &modules[module].instances {
        collect(modules, inside, &format!("{around}_{name}"), names);
    }
}

fn modules(verilog: &Verilog) -> HashMap<String, Module> {
    let sources = verilog.sources();
    let stem = |source: &SourceFile| source.name.strip_suffix(".v").map(str::to_owned);
    let stems: Vec<String> = sources.iter().filter_map(stem).collect();
    let known: HashSet<&str> = stems.iter().map(String::as_str).collect();
    let texts = sources.iter().filter(|source| source.name.ends_with(".v"));
    let modules = texts.map(|source| read(source, &known));
    stems.iter().cloned().zip(modules).collect()
}

#[test]
fn every_signal_is_declared_in_the_module_of_its_scope() {
    for circuit in circuits() {
        let modules = modules(&circuit.verilog().unwrap());
        let mut names = HashMap::new();
        collect(&modules, circuit.name(), circuit.name(), &mut names);
        let declarations = circuit.outline();
        let memories = declarations.memories.iter();
        let words: HashSet<usize> = memories
            .clone()
            .flat_map(|memory| memory.first..memory.first + memory.words)
            .collect();
        let leaves = declarations.leaves.iter().enumerate();
        let leaves = leaves.filter(|(index, _)| !words.contains(index));
        let leaves = leaves.map(|(_, leaf)| (flat(leaf), leaf.shape));
        let memories = memories.map(|memory| {
            let (kind, width) = (Kind::Unsigned, memory.width);
            let path = [&memory.scopes[..], std::slice::from_ref(&memory.name)].concat();
            (path.join("_"), Shape { kind, width })
        });
        for (name, shape) in leaves.chain(memories) {
            let declared = names.get(&name);
            let expected = (shape.kind == Kind::Signed, shape.width);
            assert_eq!(declared, Some(&expected), "{name}");
        }
    }
}

#[test]
fn lines_are_short_and_end_in_what_is_seen() {
    let mut long = BTreeSet::new();
    for circuit in circuits() {
        let verilog = circuit.verilog().unwrap();
        let texts = verilog
            .sources()
            .into_iter()
            .chain(verilog.testbench(Clock::default()));
        for source in texts.filter(|source| source.name.ends_with(".v")) {
            for line in source.text.lines() {
                if line.len() > LONGEST {
                    long.insert(format!("{}: {line}", source.name));
                }
                assert_eq!(line, line.trim_end(), "{}", source.name);
                assert!(!line.contains('\t'), "{}: {line}", source.name);
                // The number of a character stands for one that has no form in ASCII.
                let plain = line.is_ascii() && !line.contains("U+");
                assert!(plain, "{}: {line}", source.name);
            }
            assert!(!source.text.contains("\n\n\n"), "{}", source.name);
            assert!(source.text.ends_with("endmodule\n"), "{}", source.name);
        }
    }
    assert!(long.is_empty(), "{long:#?}");
}

#[test]
fn no_name_is_a_number() {
    let made = |name: &&String| {
        name.strip_prefix("net")
            .is_some_and(|rest| rest.chars().all(|c| c == '_' || c.is_ascii_digit()))
    };
    let mut numbered = BTreeSet::new();
    for circuit in circuits() {
        for (module, declared) in modules(&circuit.verilog().unwrap()) {
            let names = declared.names.keys().filter(made);
            numbered.extend(names.map(|name| format!("{module}.{name}")));
        }
    }
    assert!(numbered.is_empty(), "{numbered:?}");
}

#[test]
fn the_text_is_the_same_every_time() {
    for circuit in circuits() {
        let print = || {
            let verilog = circuit.verilog().unwrap();
            (verilog.sources(), verilog.testbench(Clock::default()))
        };
        assert_eq!(print(), print());
    }
}
