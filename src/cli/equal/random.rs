//! Random inputs for the design, before the solver: they reach differences that come late.

use super::check::{Check, Paired, Work};
use super::tool::End;
use super::trace::Trace;
use super::{Failure, replay};
use motion_rtl::check::Drive;
use motion_rtl::trace::Clock;
use std::fs::File;
use std::io;
use std::time::{Duration, Instant};

/// Least and most ticks of a run, and work in ticks times cells: a design of few cells runs longer.
const LEAST: u64 = 2000;
const TICKS: u64 = 4000;
const WORK: u64 = 400_000;

/// Part of the time limit for a run.
const SHARE: u32 = 4;

/// Time for an earlier difference.
const EARLIER: Duration = Duration::from_secs(10);

/// Runs the model and the design with the same random inputs, and resets if there are to be some;
/// returns the run of the design, without ticks if it takes too long.
pub fn run(
    check: &Check<'_>,
    work: &Work,
    paired: &Paired,
    resets: bool,
    until: Instant,
) -> Result<Trace, Failure> {
    let stem = check.entry.name;
    let ticks = (WORK / (paired.design.cells as u64).max(1)).clamp(LEAST, TICKS);
    let drive = Drive {
        seed: 1,
        ticks,
        resets,
        clock: Clock::default(),
    };
    let words = format!("{stem}.random.stimulus");
    drive.run(
        check.model.elaborated(),
        &mut File::create(work.path(&format!("{stem}.golden.vcd")))?,
        &mut File::create(work.path(&words))?,
        &mut io::sink(),
    )?;
    let text = check.miter(paired, &[]).driven_by(&words, ticks);
    work.write(&format!("{stem}.random.v"), &text)?;
    let script = format!("{stem}.random.ys");
    work.write(&script, &check.names().random(ticks))?;
    let share = Duration::from_secs(check.arguments.limit_seconds) / SHARE;
    let ran = work.run(check, &script, until.min(Instant::now() + share))?;
    match ran.end {
        End::Success => {
            let mut trace = Trace::simulated(&work.read(&format!("{stem}.trace.vcd"))?);
            trace.cut(ticks as usize);
            Ok(trace)
        }
        End::Failure | End::Late => Ok(Trace::default()),
    }
}

/// Compares a random run of the design with that of the model; returns the run to the first
/// difference, if there is one.
pub fn difference(
    check: &Check<'_>,
    work: &Work,
    paired: &Paired,
    mut run: Trace,
) -> Result<Option<Trace>, Failure> {
    if run.ticks == 0 {
        return Ok(None);
    }
    let stem = check.entry.name;
    let name = format!("{stem}.design.vcd");
    work.write(&name, &run.waves(&[&check.design.clock]))?;
    let waves = [
        &*work.path(&format!("{stem}.golden.vcd")),
        &work.path(&name),
    ];
    let report = replay::compared(check, paired, waves, &run)?;
    match report.first {
        // An undefined value may be the right one.
        Some(first) if !first.other_value.trim_start_matches("0x").contains('x') => {
            run.cut(first.tick as usize + 1);
            Ok(Some(run))
        }
        _ => Ok(None),
    }
}

/// Returns a run to an earlier difference than that of a trace, if the solver finds one in time.
pub fn earlier(
    check: &Check<'_>,
    work: &Work,
    paired: &Paired,
    trace: &Trace,
    until: Instant,
) -> Result<Option<Trace>, Failure> {
    let ticks = trace.ticks - 1;
    if ticks == 0 {
        return Ok(None);
    }
    let stem = check.entry.name;
    let miter = check.miter(paired, &[]);
    let script = format!("{stem}.earlier.ys");
    work.write(&format!("{stem}.miter.v"), &miter.text())?;
    work.write(
        &script,
        &check.names().search(&miter.exposed(), Some(ticks)),
    )?;
    let ran = work.run(check, &script, until.min(Instant::now() + EARLIER))?;
    match ran.is_difference() {
        true => Ok(Some(Trace::read(&work.read(&format!("{stem}.trace.vcd"))?))),
        false => Ok(None),
    }
}
