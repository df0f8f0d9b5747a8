//! Waves of a netlist with a fault, and of the one without it on the same inputs.

use super::dump::Format;
use super::layout::Layout;
use super::value::show;
use super::walk::Change;
use super::{Clock, FOCUS, VcdFile, gtkw};
use crate::engine::{Engine, Watch};
use crate::files::{AtomicFile, Directory, commit_all};
use crate::hdl::Declaration;
use crate::sim::{Elaborated, RunError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Scope of the circuit without the fault, inside the scope of the one with it.
const WITHOUT: &str = "without_fault";

/// Greatest number of signals that the overview of the save file shows with both values.
const OVERVIEW: usize = 8;

/// Waves with and without a fault.
#[derive(Debug)]
pub(crate) struct Both {
    /// First difference of a signal: tick, signal and values; nothing if there is none.
    pub first: Option<String>,
    /// Paths of the waves and of their save file.
    pub files: Result<Vec<PathBuf>, RunError>,
}

/// Replays inputs from power-on on a netlist with a fault, and on the one without it. Writes
/// `<stem>.vcd` and `<stem>.gtkw` into `dir`: the signals with the fault, and those of the circuit
/// without it in the scope [`WITHOUT`]. The signals that differ first are the overview of the save
/// file, each with both values.
pub(crate) fn play_both(
    [faulty, good]: [&Elaborated; 2],
    inputs: &[Vec<u64>],
    clock: Clock,
    dir: &Path,
    stem: &str,
) -> Both {
    let leaves = &faulty.declarations().leaves;
    let ports = faulty.outline().inputs();
    let models = [faulty, good];
    let mut seen = Seen::new(leaves);
    // Known even if the files cannot be written.
    let _ = play(models, inputs, &mut |tick, engines| {
        seen.tick(tick, engines);
        Ok(())
    });
    // Inputs are the same: they stand in the waves once.
    let others = good.declarations().leaves.iter().skip(ports);
    let mut all = leaves.clone();
    all.extend(others.map(inner));
    Both {
        first: seen.first(leaves),
        files: dumped(models, (all, ports), inputs, clock, (dir, stem), &seen),
    }
}

/// Moves a leaf into the scope of the circuit without the fault.
fn inner(leaf: &Declaration) -> Declaration {
    let mut scopes = leaf.scopes.to_vec();
    scopes.insert(1.min(scopes.len()), WITHOUT.to_owned());
    Declaration {
        scopes: scopes.into(),
        circuit: leaf.circuit + 1,
        ..leaf.clone()
    }
}

/// Runs two netlists on the same inputs, and passes each settled tick to `see`.
fn play(
    models: [&Elaborated; 2],
    inputs: &[Vec<u64>],
    see: &mut dyn FnMut(usize, &[Engine; 2]) -> io::Result<()>,
) -> io::Result<()> {
    let mut engines = models.map(|model| model.engine(Watch::All));
    for (tick, words) in inputs.iter().enumerate() {
        for engine in &mut engines {
            engine.drive_all(words);
            engine.settle();
        }
        see(tick, &engines)?;
        engines.iter_mut().for_each(Engine::edge);
    }
    Ok(())
}

fn dumped(
    models: [&Elaborated; 2],
    (leaves, ports): (Vec<Declaration>, usize),
    inputs: &[Vec<u64>],
    clock: Clock,
    (dir, stem): (&Path, &str),
    seen: &Seen,
) -> Result<Vec<PathBuf>, RunError> {
    let name = format!("{stem}.vcd");
    let layout = Layout::new(models[0].name(), leaves, None).map_err(io::Error::from)?;
    let _directory = Directory::create(dir)?;
    let mut dump = AtomicFile::create(dir.join(&name))?;
    let mut file = VcdFile::new(&mut dump, &layout, clock);
    let mut before: Vec<Option<u64>> = vec![None; layout.leaves.len()];
    play(models, inputs, &mut |tick, engines| {
        let mut changes = Vec::new();
        for (leaf, (bits, before)) in words_of(engines, ports).zip(&mut before).enumerate() {
            if before.replace(bits) != Some(bits) {
                let leaf = leaf as u32;
                changes.push(Change { leaf, bits });
            }
        }
        let (rise, fall) = times(clock, tick)?;
        file.tick(rise, fall, &changes)
    })?;
    let end = times(clock, inputs.len())?.0;
    file.finish(Some(end))?;

    let ticks = inputs.len() as u64;
    let focus = ticks.saturating_sub(FOCUS)..ticks;
    let overview = seen.overview(&layout.leaves);
    let overview: Vec<_> = overview.iter().map(String::as_str).collect();
    let save = gtkw::save(&layout, clock, &name, focus, &overview);
    let mut save_file = AtomicFile::create(dir.join(format!("{stem}.gtkw")))?;
    save_file.write_all(save.as_bytes())?;
    Ok(commit_all([dump, save_file])?)
}

/// Returns the words of the leaves with the fault, and of those without it but its input ports.
fn words_of([faulty, good]: &[Engine; 2], ports: usize) -> impl Iterator<Item = u64> {
    let with = (0..faulty.leaves()).map(|leaf| faulty.word(leaf));
    with.chain((ports..good.leaves()).map(|leaf| good.word(leaf)))
}

fn times(clock: Clock, tick: usize) -> io::Result<(u64, u64)> {
    let times = clock.rise(tick as u64).zip(clock.fall(tick as u64));
    times.ok_or_else(|| io::Error::other("the time of this tick does not fit into 64 bits"))
}

/// First difference of a leaf.
#[derive(Debug, Clone, Copy)]
struct Difference {
    tick: usize,
    leaf: usize,
    is: u64,
    was: u64,
}

/// First differences of all leaves.
#[derive(Debug)]
struct Seen {
    differs: Vec<bool>,
    /// In the order of their ticks; of one tick, output ports come first.
    all: Vec<Difference>,
    ports_out: Vec<bool>,
}

impl Seen {
    fn new(leaves: &[Declaration]) -> Self {
        let is_port = |leaf: &Declaration| leaf.scopes.len() == 1 && leaf.is_port_out();
        Seen {
            differs: vec![false; leaves.len()],
            all: Vec::new(),
            ports_out: leaves.iter().map(is_port).collect(),
        }
    }

    fn tick(&mut self, tick: usize, [faulty, good]: &[Engine; 2]) {
        let before = self.all.len();
        for leaf in 0..self.differs.len().min(good.leaves()) {
            let (is, was) = (faulty.word(leaf), good.word(leaf));
            if is != was && !std::mem::replace(&mut self.differs[leaf], true) {
                self.all.push(Difference {
                    tick,
                    leaf,
                    is,
                    was,
                });
            }
        }
        let ports_out = &self.ports_out;
        self.all[before..].sort_by_key(|difference| !ports_out[difference.leaf]);
    }

    /// Returns the first difference in words.
    fn first(&self, leaves: &[Declaration]) -> Option<String> {
        let Difference {
            tick,
            leaf,
            is,
            was,
        } = *self.all.first()?;
        let leaf = &leaves[leaf];
        let value = |word| show(leaf.shape, leaf.field.format, word);
        Some(format!(
            "tick {tick}: {} is {}, {} without the fault",
            below(leaf),
            value(is),
            value(was)
        ))
    }

    /// Returns the paths of the signals that differ first, each with that without the fault.
    fn overview(&self, leaves: &[Declaration]) -> Vec<String> {
        let first = self.all.iter().take(OVERVIEW);
        first
            .flat_map(|difference| {
                let path = below(&leaves[difference.leaf]);
                let other = format!("{WITHOUT}.{path}");
                [path, other]
            })
            .collect()
    }
}

/// Returns the path of a leaf within the circuit.
fn below(leaf: &Declaration) -> String {
    let names: Vec<_> = leaf.names().skip(1).collect();
    names.join(".")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hdl::mutation::mutated;
    use crate::hdl::mutation::tests::{Sum, all};

    /// Plays ticks that add one on a sum with the fault whose text ends so.
    fn played(fault: &str, ticks: usize, dir: &Path) -> (Both, String, String) {
        let sum = Sum { width: 4 };
        let good = Elaborated::new(&sum).unwrap();
        let all = all(&sum);
        let mutation = all.iter().find(|it| it.to_string().ends_with(fault));
        let mutation = mutation.expect(fault);
        let faulty = mutated(mutation, || Elaborated::new(&sum))
            .unwrap()
            .unwrap();
        let inputs = vec![vec![0, 1, 1, 7]; ticks];
        let both = play_both([&faulty, &good], &inputs, Clock::default(), dir, "sum");
        let read = |end| std::fs::read_to_string(dir.join(format!("sum.{end}"))).unwrap();
        (both, read("vcd"), read("gtkw"))
    }

    #[test]
    fn waves_have_both_and_begin_where_they_differ() {
        let dir = tempfile::tempdir().unwrap();
        let (both, vcd, save) = played("sum: another operator", 3, dir.path());
        let files = both.files.unwrap();
        assert_eq!(files.len(), 2, "{files:?}");
        let first = both.first.unwrap();
        // Power-on is 2: with the fault 2 - 1 comes after it, without it 2 + 1.
        assert_eq!(first, "tick 1: sum is 1, 3 without the fault");
        assert!(
            vcd.contains(&format!("$scope module {WITHOUT} $end")),
            "{vcd}"
        );
        // Inputs once, registers and nets of both.
        let count = |name: &str| vcd.matches(&format!(" {name} ")).count();
        assert_eq!(
            [count("add"), count("sum"), count("over")],
            [1, 2, 2],
            "{vcd}"
        );
        let at = |text: &str| save.find(text).expect(text);
        assert!(
            at("adder.sum[3:0]") < at(&format!("adder.{WITHOUT}.sum[3:0]")),
            "{save}"
        );
    }

    #[test]
    fn the_window_ends_with_the_last_tick() {
        let dir = tempfile::tempdir().unwrap();
        let (_, _, save) = played("sum: another operator", 100, dir.path());
        // A period is 1 µs in units of ns.
        let start = save.lines().find(|line| line.starts_with("[timestart]"));
        let clock = Clock::default();
        let scale = u64::from(clock.timescale().0);
        let from = clock.rise(60).unwrap() * scale;
        assert_eq!(start, Some(format!("[timestart] {from}").as_str()));
    }
}
