//! Two waveforms held against each other, tick by tick.
//!
//! This is for holding an implementation in Verilog or VHDL against a dump of this crate: the
//! *golden* file is ours, the *other* is what a simulator wrote. Both are VCD, FST or GHW.
//!
//! ```no_run
//! use motion_rtl::compare::{Settings, compare};
//!
//! let report = compare("golden.vcd".as_ref(), "tb.vcd".as_ref(), &Settings::default())?;
//! assert!(report.is_equal(), "{report}");
//! # Ok::<(), motion_rtl::input::Fault>(())
//! ```
//!
//! **Ticks.** A tick has the values that a flip-flop samples: those that stand just before a
//! rising edge of the clock. A rising edge is a change from 0 to 1, or from an x or z that the file
//! begins with; the first value in a file is none. Tick 0 lasts to the first edge, tick 1 to the
//! second. What changes at the time of an edge belongs to the tick that begins with it; within a
//! tick the last value counts. Behind the last edge there is one more tick if the clock falls
//! again. A window of one of this crate's dumps counts its ticks as the run did: its times tell.
//! From its first 0 or 1 on the clock must be one of both, except where the dump is switched off.
//!
//! **Dumps that are switched off** (`$dumpoff`) and on again have ticks in between, by the period of
//! the clock, which must then be a whole part of that time. They are not compared, and counted.
//! Ticks before a dump is switched on for the first time are none.
//!
//! **Pairs.** A golden signal is paired with the signal of the same path below the scope that
//! stands for golden's outermost one. That is the scope with the most partners, unless
//! [`Settings::scope`] names it, and none where the map names scopes. `mem.word5` and `mem.stage5`
//! are the same as `mem[5]`; where the
//! other file has a memory of single bits as a vector, they are its bits. A [`Map`] pairs what has
//! other names; the end of a path will do for the other file's, where it is the only one. Clocks,
//! and variables without bits, are not compared. Signals of a clock's name with the same edges
//! are one clock.
//!
//! **Values.** A known golden value equals the same bits and no x or z. A golden value with an x or
//! z, or before the first value of a signal, is not compared. Signals of more than 64 bits are not
//! compared. A partner of another width is a difference. What is not compared is counted, and pairs
//! of which no value was compared are named: that nothing of them differs says nothing. Where no
//! value of any pair was compared, that is an error.
//!
//! **Ports out.** Two files are equal only if every port out of golden's outermost circuit was compared.
//! Waves of this crate tell which they are, an FST or GHW by the directions of its variables; for other
//! golden files [`Settings::ports_out`] names them. [`Settings::leave`] and `leave` in a [`Map`] leave
//! some out by name.
//!
//! **Ticks of both.** Tick n of the golden file is held against tick n + [`Settings::skip`] of the
//! other. What only one of them has is counted, by itself what one has behind the other's last tick:
//! a file may be cut off there ([`Report::same_length`]).
//!
//! **Files that are cut off** are refused where that shows: one of ours that does not end with a time
//! in a whole line.

mod around;
mod ends;
mod gap;
mod ghw;
mod hold;
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

pub use map::Map;
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

/// How two files are compared.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Settings {
    /// The clock, by its path or the end of its path.
    pub clock: String,
    /// The other file's clock, where it has another name.
    pub other_clock: Option<String>,
    /// The scope of the other file that stands for golden's outermost scope, by its path or the
    /// end of its path; without it the one with the most partners, or none where the map names
    /// scopes.
    pub scope: Option<String>,
    /// Pairs names that differ in upper and lower case only, where no other name is equal.
    pub ignore_case: bool,
    /// Names that differ, and signals to leave out.
    pub map: Map,
    /// The ports out of a golden file that does not tell them, by their paths or the ends of them.
    pub ports_out: Vec<String>,
    /// Ports out that are not compared, by their paths or the ends of them.
    pub leave: Vec<String>,
    /// The tick of the other file that is held against golden's tick 0. Below 0 where the other
    /// file begins later.
    pub skip: i64,
    /// The golden ticks to compare.
    pub ticks: Range<u64>,
    /// Ticks that are shown before the first mismatch.
    pub around: u64,
}

impl Default for Settings {
    /// All ticks by the clock `clk`; 4 are shown before a mismatch.
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
/// The reader of waveforms panics at some files that are malformed. That is caught and becomes an
/// error, where panics unwind; so that nothing is printed, the first call of this or of
/// [`template`] in a process installs a panic hook that is silent meanwhile and otherwise calls the
/// one before it.
///
/// # Errors
/// A file that cannot be read or is no complete VCD, FST or GHW, a clock that is none or is not to be
/// found, a golden file without ports out, no scope or more than one that stands for golden's, a map
/// that does not fit the files, nothing to compare.
pub fn compare(golden: &Path, other: &Path, settings: &Settings) -> Result<Report, Fault> {
    let (golden, other) = read(golden, other)?;
    compare_waves(golden, other, settings)
}

/// A map to fill in: the golden signals that have no partner, and the other file's names that are
/// left. [`Settings::map`] may pair some already.
///
/// # Errors
/// A file, a clock or a map as [`compare`] refuses them.
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
    // Both before either is read.
    for path in [golden, other] {
        size(path, wave::LARGEST)?;
    }
    std::thread::scope(|scope| {
        let reading = Builder::new().spawn_scoped(scope, || Wave::read(golden));
        let other = Wave::read(other);
        let golden = match reading {
            Ok(reading) => reading.join().unwrap_or_else(|panic| resume_unwind(panic)),
            // No thread to be had: one after the other.
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
