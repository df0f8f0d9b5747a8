//! Comparison of two waveforms, tick by tick.
//!
//! Compares an implementation in Verilog or VHDL with a dump of this crate: the *golden* file is
//! the dump, the *other* file is written by a simulator. Both are VCD, FST or GHW.
//!
//! ```no_run
//! use motion_rtl::compare::{Settings, compare};
//!
//! let report = compare("golden.vcd".as_ref(), "tb.vcd".as_ref(), &Settings::default())?;
//! assert!(report.is_equal(), "{report}");
//! # Ok::<(), motion_rtl::input::Fault>(())
//! ```
//!
//! **Ticks.** A tick has the values that a flip-flop samples: those just before a rising edge of
//! the clock. A rising edge is a change from 0 to 1, or from an initial x or z of the file; the
//! first value in a file is none. Tick 0 lasts to the first edge, tick 1 to the second. A change
//! at the time of an edge belongs to the tick that begins with it; within a tick the last value
//! counts. After the last edge there is one more tick if the clock falls again. A window of one of
//! this crate's dumps counts its ticks as the run did; its times give the number. From its first 0
//! or 1 on the clock must be 0 or 1, except while the dump is switched off.
//!
//! **Dumps that are switched off** (`$dumpoff`) and on again have ticks in between. Their number
//! follows from the period of the clock, of which the gap must be a whole multiple. They are
//! counted but not compared. There are no ticks before a dump is switched on for the first time.
//!
//! **Pairs.** A golden signal is paired with the signal of the same path below the scope that
//! corresponds to golden's outermost one. That is the scope with the most partners, unless
//! [`Settings::scope`] names it; there is none if the map names scopes. `mem.word5` and
//! `mem.stage5` are the same as `mem[5]`; if the other file has a memory of single bits as a
//! vector, they are its bits. A [`Map`] pairs signals with other names; in the other file the end
//! of a path is enough, if it is unique. Clocks, and variables without bits, are not compared.
//! Signals of a clock's name with the same edges are one clock.
//!
//! **Values.** A known golden value equals the same bits without x or z. A golden value with an x
//! or z, or before the first value of a signal, is not compared. Signals of more than 64 bits are
//! not compared. A partner of another width is a difference. Values that are not compared are
//! counted, and pairs without any compared value are named: no difference there proves nothing. If
//! no value of any pair was compared, that is an error.
//!
//! **Output ports.** Two files are equal only if every output port of golden's outermost circuit
//! was compared. Waves of this crate name them, an FST or GHW by the directions of its variables;
//! for other golden files [`Settings::ports_out`] names them. [`Settings::leave`] and `leave` in a
//! [`Map`] leave some out by name.
//!
//! **Common ticks.** Tick n of the golden file is compared with tick n + [`Settings::skip`] of the
//! other. Ticks that only one file has are counted; those after the other's last tick have a count
//! of their own, since that file may be cut off ([`Report::same_length`]).
//!
//! **Truncated files** are refused if that can be detected: a dump of this crate must end with a
//! time in a complete line.

mod around;
mod bound;
mod ends;
mod gap;
mod ghw;
mod hold;
mod inputs;
mod map;
mod mapped;
mod names;
mod pair;
mod ports;
mod quiet;
mod render;
mod report;
mod runs;
mod scan;
mod scope;
mod sections;
mod template;
mod ticks;
mod times;
mod value;
mod wave;

pub use bound::{BoundPorts, is_identifier};
pub use inputs::{DumpInputs, Reset, inputs};
pub use map::{Entry, Map, Partner};
pub use names::brackets;
pub use report::{Cell, Difference, Mismatch, Report, Row, Side, WidthDifference};
pub use value::WIDEST;

use crate::input::{Fault, size};
use ports::Ports;
use runs::{Run, Runs, span};
use std::ops::Range;
use std::panic::resume_unwind;
use std::path::Path;
use std::thread::Builder;
use wave::Wave;

/// Settings of a comparison.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Settings {
    /// Clock, by its path or the end of its path.
    pub clock: String,
    /// Clock of the other file, if it has another name.
    pub other_clock: Option<String>,
    /// Scope of the other file that corresponds to golden's outermost scope, by its path or the
    /// end of its path. By default the one with the most partners, or none if the map names
    /// scopes.
    pub scope: Option<String>,
    /// True to pair names that differ in case only, if no other name is equal.
    pub ignore_case: bool,
    /// Pairs of different names, and signals to leave out.
    pub map: Map,
    /// Output ports of a golden file that does not name them, by their paths or the ends of them.
    pub ports_out: Vec<String>,
    /// Output ports that are not compared, by their paths or the ends of them.
    pub leave: Vec<String>,
    /// Tick of the other file that is compared with golden's tick 0; negative if the other file
    /// begins later.
    pub skip: i64,
    /// Golden ticks to compare.
    pub ticks: Range<u64>,
    /// Number of ticks shown before the first mismatch.
    pub around: u64,
}

impl Default for Settings {
    /// Compares all ticks by the clock `clk` and shows 4 ticks before a mismatch.
    fn default() -> Self {
        Settings {
            clock: "clk".to_owned(),
            other_clock: None,
            scope: None,
            ignore_case: false,
            map: Map::default(),
            ports_out: Vec::new(),
            leave: Vec::new(),
            skip: 0,
            ticks: 0..u64::MAX,
            around: 4,
        }
    }
}

/// Compares two waveform files.
///
/// The waveform reader panics on some malformed files. Such a panic is caught and becomes an
/// error, if panics unwind. To suppress its output, the first call of this function or of
/// [`template()`] in a process installs a panic hook that is silent meanwhile and otherwise calls
/// the one before it.
///
/// # Errors
/// Returns an error if a file cannot be read or is not a complete VCD, FST or GHW, a clock is
/// unusable or missing, the golden file has no output ports, no scope or more than one corresponds
/// to golden's, the map does not fit the files, or there is nothing to compare.
pub fn compare(golden: &Path, other: &Path, settings: &Settings) -> Result<Report, Fault> {
    let (golden, other) = read(golden, other)?;
    compare_waves(golden, other, settings)
}

/// Returns a map to fill in: the golden signals without partner, and the remaining names of the
/// other file. [`Settings::map`] may pair some already.
///
/// # Errors
/// Returns the errors of [`compare`] for a file, a clock or a map.
pub fn template(golden: &Path, other: &Path, settings: &Settings) -> Result<String, Fault> {
    let (mut golden, mut other) = read(golden, other)?;
    let clocks = clocks(&mut golden, &mut other, settings)?;
    let scope = settings.scope.as_deref();
    let known = golden.ports_out.is_some() || !settings.ports_out.is_empty();
    let ports = match known {
        true => Ports::of(&golden, clocks.0, settings)?,
        false => Ports::default(),
    };
    let pairing = pair::pair(&golden, &other, clocks, &settings.map, ports, scope, true)?;
    Ok(template::skeleton(&golden, &other, clocks.1, &pairing))
}

fn read(golden: &Path, other: &Path) -> Result<(Wave, Wave), Fault> {
    // Start both before either is read.
    for path in [golden, other] {
        size(path, wave::LARGEST)?;
    }
    std::thread::scope(|scope| {
        let reading = Builder::new().spawn_scoped(scope, || Wave::read(golden));
        let other = Wave::read(other);
        let golden = match reading {
            Ok(reading) => reading.join().unwrap_or_else(|panic| resume_unwind(panic)),
            // If no thread can be started: one after the other.
            Err(_) => Wave::read(golden),
        };
        golden.and_then(|golden| Ok((golden, other?)))
    })
}

fn clocks(
    golden: &mut Wave,
    other: &mut Wave,
    settings: &Settings,
) -> Result<(usize, usize), Fault> {
    if settings.ignore_case {
        other.fold_case();
    }
    let clock = ticks::clock(golden, "--clock", &settings.clock, None)?;
    let other_clock = match &settings.other_clock {
        Some(name) => ticks::clock(other, "--other-clock", name, None)?,
        None => {
            let path = golden.variables[clock].path.as_str();
            let name = settings.clock.rsplit('.').next().unwrap_or_default();
            ticks::clock(other, "--other-clock", name, Some(path))?
        }
    };
    Ok((clock, other_clock))
}

fn compare_waves(mut golden: Wave, mut other: Wave, settings: &Settings) -> Result<Report, Fault> {
    let (clock, other_clock) = clocks(&mut golden, &mut other, settings)?;
    let scope = settings.scope.as_deref();
    let both = (clock, other_clock);
    let ports = Ports::of(&golden, clock, settings)?;
    let pairing = pair::pair(&golden, &other, both, &settings.map, ports, scope, false)?;
    if let Some(fault) = pair::nothing(&golden, &other, &pairing) {
        return Err(fault);
    }
    golden.load(pairing.pairs.iter().map(|pair| pair.golden).chain([clock]))?;
    other.load(
        pairing
            .pairs
            .iter()
            .map(|pair| pair.other)
            .chain([other_clock]),
    )?;
    let golden = Run::of(golden, clock)?;
    let other = Run::of(other, other_clock)?;
    let start = i128::from(other.ticks.first) - i128::from(settings.skip);
    let end = start + i128::from(other.ticks.count);
    let common = ticks::common(&golden.ticks, start..end, &settings.ticks);
    if common.is_empty() {
        let first = i128::from(golden.ticks.first);
        let mut problem = format!(
            "no common tick: {} has {}, this file {} in golden's count",
            golden.wave.file,
            span(first..first + i128::from(golden.ticks.count)),
            span(start..end)
        );
        let Range { start, end } = settings.ticks;
        if end < u64::MAX {
            problem.push_str(&format!(
                ", asked for are {}",
                span(start.into()..end.into())
            ));
        } else if start > 0 {
            problem.push_str(&format!(", asked for are ticks from {start} on"));
        }
        let allowed = "--skip, --from and --ticks that leave a tick of both";
        return Err(Fault::new(&other.wave.file, 0, "ticks", problem, allowed));
    }
    let runs = Runs {
        golden,
        other,
        start,
        common,
    };
    let report = runs.report(pairing, settings)?;
    match report.values == 0 && !report.differs() {
        false => Ok(report),
        true => Err(runs.no_value(&report)),
    }
}
