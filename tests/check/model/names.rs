//! Names of a model's signals.

use motion_rtl::Model;
use motion_rtl::netlist::{Design, Module, Role};
use motion_rtl::prelude::*;
use motion_rtl::registry::CATALOGUE;
use motion_rtl::sim::{Elaborated, PortDirection};
use rayon::prelude::*;
use std::collections::HashSet;

/// Has bundles in bundles, one with a memory.
#[derive(Debug, Clone)]
struct Banks;

signals! { for Banks as c;
    /// A level and words.
    struct Bank {
        level: U(4),
        words: Ram(2, 4),
    }
    /// Both banks.
    struct Both {
        upper: Bank(c),
        lower: Bank(c),
    }
    /// Ports in.
    struct BanksIn {
        pub write: Bit,
        pub data: U(4),
    }
    /// Registers.
    struct BanksReg { both: Both(c) }
    /// Nets.
    struct BanksNet { pub read: U(4) }
}

impl Circuit for Banks {
    const NAME: &'static str = "banks";
    const ABOUT: &'static str = "has bundles in bundles";
    records!(BanksIn, BanksReg, BanksNet);

    fn tick(&self, i: BanksIn, q: BanksReg, _: Nothing) -> (BanksNet, BanksReg<Edge>) {
        let Both { upper, lower } = q.both;
        let address = i.data.slice(0, 2);
        let read = upper.words.read(address) ^ lower.words.read(address);
        let next = |bank: Bank, enable: Bit| Bank {
            level: enable.mux(i.data, bank.level),
            words: bank.words.write(enable, address, i.data),
        };
        let both = Both {
            upper: next(upper, i.write),
            lower: next(lower, !i.write),
        };
        (BanksNet { read }, BanksReg { both })
    }
}

/// Has them in a part.
#[derive(Debug, Clone)]
struct House;

signals! { for House as _c;
    /// Ports in.
    struct HouseIn {
        pub write: Bit,
        pub data: U(4),
    }
    /// The part.
    struct HouseParts { inner: Part<Banks>(Banks) }
    /// Nets.
    struct HouseNet { pub seen: U(4) }
}

impl Circuit for House {
    const NAME: &'static str = "house";
    const ABOUT: &'static str = "has a part with bundles in bundles";
    records!(HouseIn, Nothing, HouseNet, HouseParts);

    fn tick(&self, i: HouseIn, _: Nothing, p: HouseParts) -> (HouseNet, Nothing) {
        let inner = p.inner.settle(BanksIn {
            write: i.write,
            data: i.data,
        });
        (HouseNet { seen: inner.w.read }, Nothing)
    }
}

#[test]
fn bundles_in_bundles_are_joined_in_verilog() {
    assert_eq!(check(&Elaborated::new(&Banks).unwrap()), 10);
    let house = Elaborated::new(&House).unwrap();
    assert_eq!(check(&house), 10);
    let mut model = Model::of(&house).unwrap();
    model.set("write", 1).unwrap();
    model.set("data", 3).unwrap();
    model.step();
    let words = [
        "inner.both.upper.words[3]",
        "inner.both_upper_words[3]",
        "inner.both.upper.words.word3",
        "house.inner.both.upper.words.word3",
        "inner.both_upper_level",
    ];
    for name in words {
        assert_eq!(model.get(name).unwrap(), 3, "{name}");
    }
    assert_eq!(model.get("inner.both.lower.words[3]").unwrap(), 0);
}

/// The module at the end of a path of instances.
fn inside<'d>(design: &'d Design, path: &[&str]) -> Option<&'d Module> {
    let mut module = design.modules.last()?;
    for name in path {
        let mut instances = module.instances.iter();
        let child = instances.find(|child| child.name == *name)?;
        module = &design.modules[child.module];
    }
    Some(module)
}

/// True if the Verilog of a circuit has a signal or a word of a memory of that name.
fn is_in_verilog(design: &Design, name: &str) -> bool {
    let path: Vec<&str> = name.split('.').collect();
    let Some((last, instances)) = path.split_last() else {
        return false;
    };
    let Some(module) = inside(design, instances) else {
        return false;
    };
    match last.strip_suffix(']').and_then(|last| last.split_once('[')) {
        Some((memory, word)) => {
            let mut memories = module.memories.iter();
            let memory = memories.find(|own| own.name == memory && !own.inner);
            memory.is_some_and(|memory| word.parse::<usize>().unwrap() < memory.words)
        }
        None => {
            let mut signals = module.signals.iter();
            signals.any(|own| own.name == *last && own.owner.is_none())
        }
    }
}

fn check(circuit: &Elaborated) -> usize {
    let model = Model::of(circuit).unwrap();
    let signals = model.signals();
    let mut differ = 0;
    let mut paths = HashSet::new();
    for (index, signal) in signals.iter().enumerate() {
        assert_eq!(signal.handle.index(), index);
        assert!(
            paths.insert(signal.path.clone()),
            "{} is twice",
            signal.path
        );
        let whole = format!("{}.{}", circuit.name(), signal.path);
        let dumped = circuit.declarations().leaves[index].path();
        for name in [&signal.path, &signal.verilog, &whole, &dumped] {
            let found = model.find(name).map_err(|error| error.to_string());
            assert_eq!(found, Ok(signal.handle), "{name} of {}", circuit.name());
        }
        let design = circuit.design();
        assert!(is_in_verilog(design, &signal.verilog), "{}", signal.verilog);
        differ += usize::from(signal.path != signal.verilog);
    }
    let named = |direction| -> Vec<&str> {
        let ports = signals
            .iter()
            .filter(|signal| signal.port == Some(direction));
        ports.map(|signal| signal.verilog.as_str()).collect()
    };
    let top = circuit.design().modules.last().unwrap();
    let inputs: Vec<&str> = top.inputs().map(|port| port.name.as_str()).collect();
    let outputs: Vec<&str> = top.outputs().map(|port| port.name.as_str()).collect();
    assert_eq!(named(PortDirection::In), inputs);
    assert_eq!(named(PortDirection::Out), outputs);
    assert!(signals.iter().any(|signal| signal.role != Role::Input));
    differ
}

/// Every path, every name in Verilog and every name in the waves finds its signal, and Verilog has
/// what is said to be its name.
#[test]
fn every_signal_is_found_by_each_of_its_names() {
    let differ = CATALOGUE
        .par_iter()
        .map(|entry| check(&entry.small().model().unwrap()));
    assert!(differ.sum::<usize>() > 20, "bundles are named differently");
}

#[test]
fn signals_say_what_they_are() {
    let model = Model::new(
        "linear_interpolator",
        &["widths.position=20".parse().unwrap()],
    )
    .unwrap();
    let signals = model.signals();
    let of = |path: &str| signals.iter().find(|signal| signal.path == path).unwrap();
    let x = of("x");
    assert!(
        x.is_signed() && x.width() == 20 && x.port == Some(PortDirection::Out),
        "{x:?}"
    );
    assert!(!x.doc.is_empty() && !x.doc.contains('\n'), "{x:?}");
    let scan = of("scan");
    assert_eq!(
        (scan.role, scan.port, scan.width()),
        (Role::Input, Some(PortDirection::In), 1)
    );
    assert_eq!(of("sequencer.scan").port, None);
    let words = signals.iter().filter(|signal| signal.path.ends_with("[3]"));
    let words: Vec<_> = words.collect();
    assert!(!words.is_empty());
    assert!(
        words
            .iter()
            .all(|word| word.role == Role::Register && word.port.is_none())
    );
}
