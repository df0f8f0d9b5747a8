//! Random inputs for the design, before the solver: they reach differences that come late.

use super::check::{Check, Paired, Work};
use super::pairs::{Pair, Pairs, Part};
use super::tool::End;
use super::trace::Trace;
use super::{Failure, replay};
use motion_rtl::check::Drive;
use motion_rtl::sim::SignalInfo;
use motion_rtl::trace::Clock;
use std::cmp::Reverse;
use std::collections::BTreeSet;
use std::fs::File;
use std::io;
use std::ops::RangeInclusive;
use std::time::{Duration, Instant};

/// Least and most ticks of a run, and work in ticks times cells: a design of few cells runs longer.
const LEAST: u64 = 2000;
const TICKS: u64 = 4000;
const WORK: u64 = 400_000;

/// Part of the time limit for a run.
const SHARE: u32 = 4;

/// Seeds of runs without resets, and the number of those that are held against the design.
const SEEDS: RangeInclusive<u64> = 2..=65;
const BEST: usize = 3;

/// Time for an earlier difference.
const EARLIER: Duration = Duration::from_secs(10);

/// Runs the model and the design with the same random inputs; returns the run of the design, without
/// ticks if it takes too long.
pub fn run(
    check: &Check<'_>,
    work: &Work,
    paired: &Paired,
    until: Instant,
) -> Result<Trace, Failure> {
    let drive = Drive {
        seed: 1,
        ticks: ticks(paired),
        resets: check.design.reset.is_some(),
        bounded: false,
        clock: Clock::default(),
    };
    of(check, work, paired, drive, until.min(share(check)))
}

/// Returns the ticks of a run.
fn ticks(paired: &Paired) -> u64 {
    (WORK / (paired.design.cells as u64).max(1)).clamp(LEAST, TICKS)
}

/// Returns the end of the time for runs that begin now.
fn share(check: &Check<'_>) -> Instant {
    Instant::now() + Duration::from_secs(check.arguments.limit_seconds) / SHARE
}

fn of(
    check: &Check<'_>,
    work: &Work,
    paired: &Paired,
    drive: Drive,
    until: Instant,
) -> Result<Trace, Failure> {
    let (stem, ticks) = (check.entry.name, drive.ticks);
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
    let ran = work.run(check, &script, until)?;
    match ran.end {
        End::Success => {
            let mut trace = Trace::simulated(&work.read(&format!("{stem}.trace.vcd"))?);
            trace.cut(ticks as usize);
            for pair in &paired.pairs.held {
                trace.add(&pair.part.net, &paired.design);
            }
            Ok(trace)
        }
        End::Failure | End::Late => Ok(Trace::default()),
    }
}

/// Runs without resets, in which counts go further; returns the run to the first difference, at
/// paired signals or else at `ports`, with its pairs. Of many seeds, those are held against the
/// design that move most signals of the model, and give its output ports most different values.
pub fn without_resets(
    check: &Check<'_>,
    work: &Work,
    paired: &Paired,
    ports: &[(String, Part)],
) -> Result<Option<(Pairs, Trace)>, Failure> {
    let until = share(check);
    let half = Instant::now() + (until - Instant::now()) / 2;
    let mut ranked = Vec::new();
    for seed in SEEDS {
        let drive = Drive {
            seed,
            ticks: ticks(paired),
            resets: false,
            // Long periods let a circuit wait for most of a run, but some faults need wide words.
            bounded: seed % 2 == 0,
            clock: Clock::default(),
        };
        let [mut waves, mut stimulus] = [io::sink(), io::sink()];
        let mut expected = Vec::new();
        let elaborated = check.model.elaborated();
        let driven = drive.run(elaborated, &mut waves, &mut stimulus, &mut expected)?;
        let outputs: BTreeSet<&[u8]> = expected.split(|byte| *byte == b'\n').collect();
        let rank = (
            driven.coverage.still().count(),
            Reverse(outputs.len()),
            Reverse(driven.coverage.bits()),
        );
        ranked.push((rank, drive));
        if Instant::now() > half {
            break;
        }
    }
    ranked.sort_by_key(|(rank, _)| *rank);
    for (_, drive) in ranked.into_iter().take(BEST) {
        let mut run = of(check, work, paired, drive, until)?;
        let found = match difference(check, work, paired, &run)? {
            Some(ticks) => Some((paired.pairs.clone(), ticks)),
            None => at_ports(check, work, paired, ports, &mut run)?,
        };
        if let Some((pairs, ticks)) = found {
            run.cut(ticks);
            return Ok(Some((pairs, run)));
        }
    }
    Ok(None)
}

/// Compares a random run also at ports of parts that are connected in another way; returns the pairs
/// with that of the first port that differs, and the ticks to the difference.
pub fn at_ports(
    check: &Check<'_>,
    work: &Work,
    paired: &Paired,
    ports: &[(String, Part)],
    run: &mut Trace,
) -> Result<Option<(Pairs, usize)>, Failure> {
    for (port, part) in ports {
        let bits = |net: &str| paired.golden.nets.get(net).map(|net| &net.bits);
        // The signal of the circuit that drives the port.
        let drives =
            |signal: &SignalInfo| bits(port).is_some() && bits(&signal.verilog) == bits(port);
        let Some(signal) = check.signals.iter().position(drives) else {
            continue;
        };
        run.add(&part.net, &paired.design);
        let mut pairs = paired.pairs.clone();
        pairs.inputs.retain(|pair| pair.signal != signal);
        pairs.held.retain(|pair| pair.signal != signal);
        pairs.held.push(Pair {
            signal,
            part: part.clone(),
        });
        let paired = Paired {
            golden: paired.golden.clone(),
            design: paired.design.clone(),
            pairs,
        };
        if let Some(ticks) = difference(check, work, &paired, run)? {
            return Ok(Some((paired.pairs, ticks)));
        }
    }
    Ok(None)
}

/// Compares the last random run of the design with that of the model; returns the ticks to the first
/// difference, if there is one.
pub fn difference(
    check: &Check<'_>,
    work: &Work,
    paired: &Paired,
    run: &Trace,
) -> Result<Option<usize>, Failure> {
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
    let report = replay::compared(check, paired, waves, run)?;
    match report.first {
        // An undefined value may be the right one.
        Some(first) if !first.other_value.trim_start_matches("0x").contains('x') => {
            Ok(Some(first.tick as usize + 1))
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
