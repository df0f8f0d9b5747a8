//! Inputs of a circuit from waves of another simulator.

use super::hold::Samples;
use super::map::{Entry, Map, Partner};
use super::mapped::by_name;
use super::names::listed;
use super::pair::{self, Pair};
use super::ports::Ports;
use super::runs::Run;
use super::wave::Wave;
use super::{Settings, scope, ticks};
use crate::engine::Watch;
use crate::input::Fault;
use crate::input::stimulus::PortInputs;
use crate::netlist::Role;
use crate::sim::{Elaborated, LeafView};
use crate::trace::{Clock, Dump, Layout, Options, VcdFile};
use std::collections::HashSet;
use std::ops::Range;
use std::path::Path;

/// Greatest number of words that are taken from a file: ticks times ports.
const WORDS: u64 = 1 << 27;

/// Clock of this crate's waves.
const CLK: &str = "clk";

/// Reset that is looked for by default.
const RST: &str = "rst";

/// Inputs of a circuit that a simulation had.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DumpInputs {
    /// The inputs, tick by tick.
    pub inputs: PortInputs,
    /// Path of the clock in the file.
    pub clock: String,
    /// Reset in the file, `!` before an active-low one; `None` if there is none.
    pub reset: Option<String>,
    /// Signal beside the inputs that has the name of a reset, if none was named and none is taken.
    pub possible_reset: Option<String>,
    /// Scope of the file that corresponds to the circuit, if one was needed.
    pub scope: Option<String>,
}

/// Reset of a design.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum Reset {
    /// The signal `rst` of the circuit's scope, if there is one.
    #[default]
    Found,
    /// There is none.
    None,
    /// A signal by its path or the end of its path, `!` before an active-low one.
    Named(String),
}

/// Takes the inputs that a simulation gave a design from its waves: a VCD, FST or GHW.
///
/// Pairs the input ports of the circuit with signals of the file as [`compare`](super::compare)
/// pairs all signals. Of the settings it takes `other_clock` (or `clock`), `scope`, `ignore_case`,
/// `map`, `skip` and `ticks`. Tick 0 of the inputs is tick [`Settings::skip`] of the file; a tick
/// has the values just before a rising edge. A port that the map ignores stays low.
///
/// # Errors
/// Returns an error if the file cannot be read, the clock, the reset or a port is not found or has
/// another width, a value is x or z, the file is switched off in between, or there are fewer than 2
/// or too many ticks.
pub fn inputs(
    model: &Elaborated,
    dump: &Path,
    settings: &Settings,
    reset: &Reset,
) -> Result<DumpInputs, Fault> {
    of_waves(model, Wave::read(dump)?, settings, reset)
}

/// Returns the waves of a circuit's first tick, which name all signals.
fn names(model: &Elaborated) -> Result<Wave, Fault> {
    let fault = |problem: String| Fault::new(model.name(), 0, "waves", problem, "other names");
    let layout = Layout::of(model, None).map_err(|error| fault(error.to_string()))?;
    let clock = Clock::default();
    let vcd = VcdFile::new(Vec::new(), &layout, clock);
    let mut waves = Dump::new(&layout, clock, &Options::default(), vcd);
    let mut engine = model.engine(Watch::All);
    engine.settle();
    let written = waves.tick(0, LeafView::of(&engine));
    let bytes = written.and_then(|()| waves.finish());
    let bytes = bytes.map_err(|error| fault(error.to_string()))?;
    Wave::parse(model.name(), bytes)
}

fn of_waves(
    model: &Elaborated,
    mut other: Wave,
    settings: &Settings,
    reset: &Reset,
) -> Result<DumpInputs, Fault> {
    let mut golden = names(model)?;
    if settings.ignore_case {
        other.fold_case();
    }
    let clock = settings.other_clock.as_ref().unwrap_or(&settings.clock);
    let clock = ticks::clock(&mut other, "--clock", clock, None)?;
    let both = (ticks::clock(&mut golden, "--clock", CLK, None)?, clock);
    let wanted = settings.scope.as_deref();
    let ports = Ports::default();
    let pairing = pair::pair(&golden, &other, both, &settings.map, ports, wanted, false)?;

    let leaves = &model.declarations().leaves;
    let inputs = leaves.iter().take_while(|leaf| leaf.role == Role::Input);
    let inputs: Vec<String> = inputs
        .map(|leaf| leaf.names().collect::<Vec<_>>().join("."))
        .collect();
    let mut pairs = Vec::new();
    let (mut low, mut missing) = (Vec::new(), Vec::new());
    for path in &inputs {
        let index = golden.find(path);
        let mut known = pairing.pairs.iter();
        let pair = known.find(|pair| Some(pair.golden) == index);
        if let Some(width) = pairing.widths.iter().find(|it| it.golden == *path) {
            let problem = format!("{} has {} bits", width.other, width.other_bits);
            let allowed = format!(
                "{} bits, or a part of the signal in a map",
                width.golden_bits
            );
            return Err(Fault::new(&other.file, 0, path, problem, allowed));
        }
        match (pair, index) {
            (Some(pair), _) => pairs.push(Some(pair.clone())),
            (None, Some(index)) if pairing.ignored.contains(&index) => {
                let below = path.split_once('.').map_or(&path[..], |(_, below)| below);
                low.push(below.to_owned());
                pairs.push(None);
            }
            (None, _) => missing.push(path),
        }
    }
    if !missing.is_empty() {
        let problem = format!("no signal for {}", listed(&missing));
        let allowed = "a map that pairs each input port, or ignores it: it is low then";
        return Err(Fault::new(&other.file, 0, "names", problem, allowed));
    }
    let named = reset;
    let reset = found(&other, named, pairing.scope.as_deref())?;
    let possible_reset = match (named, &reset) {
        (Reset::Found, None) => possible(&other, &pairs, pairing.scope.as_deref()),
        _ => None,
    };
    // The reset comes last.
    pairs.push(reset.clone());
    let partners = pairs.iter().flatten();
    other.load(partners.map(|pair| pair.other).chain([clock]))?;
    let run = Run::of(other, clock)?;
    let ticks = taken(&run, settings, &pairs)?;
    let columns = pairs.iter().map(|pair| match pair {
        Some(pair) => Ok(Some((&pair.name, run.partner(pair, 0)?))),
        None => Ok(None),
    });
    let columns = columns.collect::<Result<Vec<_>, Fault>>()?;
    are_known(&run, columns.iter().flatten(), &ticks)?;
    let mut played = PortInputs::new(inputs.len(), low);
    let mut words = vec![0; pairs.len()];
    for tick in ticks {
        for (word, column) in words.iter_mut().zip(&columns) {
            if let Some((_, samples)) = column {
                *word = samples.at(tick).known().unwrap_or_default();
            }
        }
        played.push(&words[..inputs.len()], words[inputs.len()] == 1);
    }
    Ok(DumpInputs {
        inputs: played,
        clock: run.wave.variables[clock].path.clone(),
        reset: reset.map(|pair| pair.name),
        possible_reset,
        scope: pairing.scope,
    })
}

/// Returns the partner of the reset.
fn found(other: &Wave, reset: &Reset, scope: Option<&str>) -> Result<Option<Pair>, Fault> {
    let name = match reset {
        Reset::None => return Ok(None),
        Reset::Named(name) => name.clone(),
        Reset::Found => {
            let path = scope::below(scope.unwrap_or_default(), RST);
            match other.find(&path) {
                Some(index) if other.variables[index].width == 1 => path,
                _ => return Ok(None),
            }
        }
    };
    let invert = name.starts_with('!');
    let entry = Entry {
        line: 0,
        golden: "--reset".to_owned(),
        other: Partner {
            name: name.trim_start_matches('!').to_owned(),
            invert,
            delay: 0,
        },
    };
    let map = Map {
        file: other.file.clone(),
        ..Map::default()
    };
    let pair = by_name(other, &map, &entry, 0)?;
    match pair.width {
        1 => Ok(Some(pair)),
        width => {
            let problem = format!("{} has {width} bits", pair.name);
            Err(map.fault(
                0,
                "--reset",
                problem,
                "a signal of 1 bit, or one of its bits",
            ))
        }
    }
}

/// Returns the path of the first signal of 1 bit with the name of a reset in a scope of an input or
/// of the circuit, without the inputs themselves.
fn possible(other: &Wave, inputs: &[Option<Pair>], scope: Option<&str>) -> Option<String> {
    let inputs = || inputs.iter().flatten();
    let above = |path: &str| {
        path.rsplit_once('.')
            .map_or("", |(scope, _)| scope)
            .to_owned()
    };
    let scopes: HashSet<String> = inputs()
        .map(|pair| above(&other.variables[pair.other].path))
        .chain(scope.map(str::to_owned))
        .collect();
    let taken: HashSet<_> = inputs()
        .map(|pair| other.variables[pair.other].signal)
        .collect();
    let mut variables = other.variables.iter();
    let found = variables.find(|variable| {
        let name = variable.path.rsplit('.').next().unwrap_or_default();
        variable.width == 1
            && is_reset(name)
            && !taken.contains(&variable.signal)
            && scopes.contains(&above(&variable.path))
    });
    found.map(|variable| variable.path.clone())
}

/// True for names such as `rst`, `rst_n`, `i_reset`, `aresetn`.
fn is_reset(name: &str) -> bool {
    let letters = name.to_ascii_lowercase().replace('_', "");
    let around = ["reset", "rst"]
        .iter()
        .find_map(|reset| letters.split_once(reset));
    // Input, asynchronous, synchronous, active low.
    let is_mark = |mark: char| "iasnb".contains(mark);
    around.is_some_and(|(before, behind)| before.chars().chain(behind.chars()).all(is_mark))
}

/// Returns the ticks of the file that are taken.
fn taken(run: &Run, settings: &Settings, pairs: &[Option<Pair>]) -> Result<Range<i128>, Fault> {
    let fault = |field: &str, problem: String, allowed: String| {
        Err(Fault::new(&run.wave.file, 0, field, problem, allowed))
    };
    let delay = pairs.iter().flatten().map(|pair| pair.delay).max();
    let delay = delay.unwrap_or_default();
    let end = run.ticks.count.saturating_sub(delay);
    let Ok(skip) = u64::try_from(settings.skip) else {
        return fault(
            "--skip",
            format!("is {}", settings.skip),
            "0 or more".to_owned(),
        );
    };
    let start = skip.saturating_add(settings.ticks.start);
    let end = end.min(skip.saturating_add(settings.ticks.end));
    let count = end.saturating_sub(start);
    if count < 2 {
        let problem = format!("{count} of its {} ticks are taken", run.ticks.count);
        return fault("ticks", problem, "2 or more".to_owned());
    }
    let most = WORDS / pairs.len() as u64;
    if count > most {
        let problem = format!("{count} ticks of {} ports", pairs.len() - 1);
        return fault(
            "ticks",
            problem,
            format!("up to {most}: --skip and --ticks choose them"),
        );
    }
    let mut off = run.ticks.off.iter();
    if let Some(off) = off.find(|off| off.start < end + delay && start < off.end) {
        let problem = format!(
            "the dump is switched off in ticks {} to {}",
            off.start,
            off.end - 1
        );
        return fault(
            "ticks",
            problem,
            "--skip and --ticks that leave them out".to_owned(),
        );
    }
    Ok(start.into()..end.into())
}

/// Refuses values that are x or z in these ticks.
fn are_known<'a>(
    run: &Run,
    columns: impl Iterator<Item = &'a (&'a String, Samples)>,
    ticks: &Range<i128>,
) -> Result<(), Fault> {
    let mut all = Vec::new();
    for (path, samples) in columns {
        let unknown = samples.unknown(ticks).into_iter();
        all.extend(unknown.map(|it| (it.start, it.end, path)));
    }
    all.sort_unstable();
    let Some(&(tick, _, path)) = all.first() else {
        return Ok(());
    };
    let mut known = ticks.start;
    for &(start, end, _) in &all {
        if start <= known {
            known = known.max(end);
        }
    }
    let allowed = match all.last() {
        Some(last) if last.0 < known && known + 1 < ticks.end => {
            format!("0 or 1: from tick {known} on all inputs are known, which --skip {known} takes")
        }
        _ => "0 or 1 at all input ports in all ticks".to_owned(),
    };
    let problem = format!("is x or z in tick {tick}");
    Err(Fault::new(&run.wave.file, 0, *path, problem, allowed))
}

#[cfg(test)]
mod tests {
    use super::is_reset;

    #[test]
    fn resets_are_known_by_their_names() {
        for name in [
            "rst", "RST_N", "reset", "reset_n", "aresetn", "i_rst", "nreset", "rst_ni",
        ] {
            assert!(is_reset(name), "{name}");
        }
        for name in ["unit_rst", "burst", "first", "preset", "reset_count", "n"] {
            assert!(!is_reset(name), "{name}");
        }
    }
}
