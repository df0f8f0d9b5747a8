use super::gap::Gap;
use super::names::listed;
use super::value::Value;
use super::wave::Wave;
use crate::input::Fault;
use std::ops::Range;

/// Ticks of a file, counted from its start.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Ticks {
    rises: Vec<Rise>,
    pub count: u64,
    /// Number of the file's first tick in its run.
    pub first: u64,
    /// Ticks whose end is not in the dump, since it was switched off.
    pub off: Vec<Range<u64>>,
}

/// Rising edge of the clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Rise {
    /// Index of its time.
    at: u32,
    /// Tick that begins with it.
    tick: u64,
}

/// Reason why a clock is unusable.
#[derive(Debug, PartialEq, Eq)]
enum Unusable {
    /// The clock is x or z from the time with this index on.
    Unknown(u32),
    Constant,
    /// The number of edges between these indices is unknown: the dump is off in between.
    Uncounted(u32, u32),
}

impl Ticks {
    /// Returns the ticks by the clock in this variable, which must be loaded.
    pub fn of(wave: &Wave, clock: usize) -> Result<Self, Fault> {
        let changes = wave.changes(clock, 0, 1)?;
        let levels = levels(&changes);
        let fault = |problem: String| {
            let allowed = "a clock that is 0 or 1 at all times and changes";
            Fault::new(&wave.file, 0, &wave.variables[clock].path, problem, allowed)
        };
        let time = |at: u32| wave.time(wave.times.get(at as usize).copied().unwrap_or(0));
        let mut ticks =
            Ticks::by(&levels, &wave.times, &wave.gaps).map_err(|unusable| match unusable {
                Unusable::Constant => fault("the clock never changes".to_owned()),
                Unusable::Unknown(at) => fault(format!("the clock is x or z at {}", time(at))),
                Unusable::Uncounted(from, to) => {
                    let (from, to) = (time(from), time(to));
                    let allowed = "a clock of which a whole number of periods fits in between";
                    Fault {
                        allowed: allowed.to_owned(),
                        ..fault(format!(
                            "its edges between {from} and {to} cannot be counted: the dump is switched off"
                        ))
                    }
                }
            })?;
        if wave.ours {
            ticks.first = first(wave, &levels);
        }
        Ok(ticks)
    }

    fn by(levels: &[(u32, Option<bool>)], times: &[u64], gaps: &[Gap]) -> Result<Self, Unusable> {
        let time = |at: u32| times.get(at as usize).copied().unwrap_or(0);
        // Edges between two gaps.
        let mut runs: Vec<Vec<u32>> = vec![Vec::new()];
        let mut before = None;
        let mut changed = false;
        // True while the file has begun with an x or z.
        let mut unset = false;
        let mut gaps = gaps.iter().peekable();
        for (place, &(at, level)) in levels.iter().enumerate() {
            // Within a time the last value counts.
            if levels.get(place + 1).is_some_and(|next| next.0 == at) {
                continue;
            }
            // After a gap the level is a first one again.
            while gaps
                .next_if(|gap| gap.to.is_some_and(|to| to <= time(at)))
                .is_some()
            {
                runs.push(Vec::new());
                (before, unset) = (None, false);
            }
            let off = gaps.peek().is_some_and(|gap| gap.contains(time(at)));
            let Some(level) = level else {
                if before.is_some() && !off {
                    return Err(Unusable::Unknown(at));
                }
                unset = !off;
                continue;
            };
            let rises = level && (before == Some(false) || unset);
            changed |= before == Some(!level) || rises;
            if rises && let Some(run) = runs.last_mut() {
                run.push(at);
            }
            (before, unset) = (Some(level), false);
        }
        if !changed {
            return Err(Unusable::Constant);
        }
        let ends_off = gaps.peek().is_some();
        let mut ticks = Ticks::join(&runs, time)?;
        // The interval after the last edge is a tick once the clock has fallen again.
        let whole = before == Some(false)
            && !ends_off
            && runs
                .last()
                .is_some_and(|run| !run.is_empty() || runs.len() == 1);
        ticks.count += u64::from(whole);
        Ok(ticks)
    }

    /// Numbers the edges; the number between two runs follows from the period of either.
    fn join(runs: &[Vec<u32>], time: impl Fn(u32) -> u64) -> Result<Self, Unusable> {
        let mut ticks = Ticks {
            rises: Vec::new(),
            count: 0,
            first: 0,
            off: Vec::new(),
        };
        let mut earlier: &[u32] = &[];
        for run in runs.iter().filter(|run| !run.is_empty()) {
            if let ([.., last], [first, ..]) = (earlier, &run[..]) {
                let period = match (earlier, &run[..]) {
                    ([.., one, two], _) | (_, [one, two, ..]) => time(*two) - time(*one),
                    _ => 0,
                };
                let between = time(*first) - time(*last);
                if period == 0 || !between.is_multiple_of(period) {
                    return Err(Unusable::Uncounted(*last, *first));
                }
                // The end of the tick that the first edge ends is in the dump.
                let end = ticks.count + between / period - 1;
                if end > ticks.count {
                    ticks.off.push(ticks.count..end);
                }
                ticks.count = end;
            }
            for &at in run {
                ticks.count += 1;
                let tick = ticks.count;
                ticks.rises.push(Rise { at, tick });
            }
            earlier = run;
        }
        Ok(ticks)
    }

    /// Returns the start time of a tick of the file.
    pub fn time(&self, wave: &Wave, tick: u64) -> u64 {
        let after = self.rises.partition_point(|rise| rise.tick <= tick);
        let rise = after.checked_sub(1).and_then(|place| self.rises.get(place));
        let index = rise.map_or(0, |rise| rise.at as usize);
        wave.times.get(index).copied().unwrap_or(0)
    }

    /// Returns the value that a flip-flop samples in each tick: the last one before the edge that
    /// ends it. Contains only ticks with a change.
    pub fn sample(&self, changes: &[(u32, Value)]) -> Vec<(u64, Value)> {
        let mut samples: Vec<(u64, Value)> = Vec::new();
        let mut tick = 0;
        let mut rises = self.rises.iter().peekable();
        for &(at, value) in changes {
            // A change at the edge belongs to the tick that begins with it.
            while let Some(rise) = rises.next_if(|rise| rise.at <= at) {
                tick = rise.tick;
            }
            match samples.last_mut() {
                Some(last) if last.0 == tick => last.1 = value,
                _ if tick >= self.count => break,
                _ => samples.push((tick, value)),
            }
        }
        samples
    }
}

/// Returns the first tick of a dump of this crate: tick n begins at n periods, with the clock high
/// for half a period.
fn first(wave: &Wave, levels: &[(u32, Option<bool>)]) -> u64 {
    let time = |at: u32| wave.times.get(at as usize).copied();
    let (Some((high, Some(true))), Some((low, Some(false)))) = (levels.first(), levels.get(1))
    else {
        return 0;
    };
    let (Some(start), Some(fall)) = (time(*high), time(*low)) else {
        return 0;
    };
    let period = 2 * fall.saturating_sub(start);
    match start.checked_div(period) {
        Some(tick) if tick * period == start => tick,
        _ => 0,
    }
}

/// Returns the one-bit variable named `name`, by its path or the end of its path. Clocks with the
/// same edges count as one.
pub(super) fn clock(
    wave: &mut Wave,
    argument: &str,
    name: &str,
    others: Option<&str>,
) -> Result<usize, Fault> {
    let found = candidates(wave, argument, name, others)?;
    let [first, more @ ..] = &found[..] else {
        return Ok(0);
    };
    if !more.is_empty() {
        wave.load(found.iter().copied())?;
        let edges = |wave: &Wave, clock| -> Result<_, Fault> {
            let changes = wave.changes(clock, 0, 1)?;
            Ok(Ticks::by(&levels(&changes), &wave.times, &wave.gaps).ok())
        };
        let ticks = edges(wave, *first)?;
        for &other in more {
            if ticks.is_none() || edges(wave, other)? != ticks {
                let paths = found.iter().map(|&index| &wave.variables[index].path);
                let paths: Vec<_> = paths.collect();
                let problem = format!(
                    "{} signals of different edges are called {name}",
                    found.len()
                );
                let allowed = format!("one of them by its path: {}", listed(&paths));
                return Err(Fault::new(&wave.file, 0, argument, problem, allowed));
            }
        }
        for &other in more {
            wave.join(*first, other);
        }
    }
    Ok(*first)
}

fn levels(changes: &[(u32, Value)]) -> Vec<(u32, Option<bool>)> {
    let level = |&(at, value): &(u32, Value)| (at, value.is_known().then(|| value == Value::HIGH));
    changes.iter().map(level).collect()
}

/// Returns the one-bit variables that may be meant, at least one; those of the same signal count
/// as one.
fn candidates(
    wave: &Wave,
    argument: &str,
    name: &str,
    others: Option<&str>,
) -> Result<Vec<usize>, Fault> {
    let fault =
        |problem: String, allowed: String| Fault::new(&wave.file, 0, argument, problem, allowed);
    let bit = |index: &usize| wave.variables[*index].width == 1;
    if let Some(exact) = wave.find(name) {
        return match bit(&exact) {
            true => Ok(vec![exact]),
            false => Err(fault(
                format!("{name} has {} bits", wave.variables[exact].width),
                "a signal of 1 bit".into(),
            )),
        };
    }
    let ending = format!(".{name}");
    let mut found: Vec<usize> = Vec::new();
    for index in (0..wave.variables.len()).filter(bit) {
        let variable = &wave.variables[index];
        let alias = |&other: &usize| wave.variables[other].signal == variable.signal;
        let ends = match wave.folds() {
            true => ends_in_any_case(&variable.path, &ending),
            false => variable.path.ends_with(&ending),
        };
        if ends && !found.iter().any(alias) {
            found.push(index);
        }
    }
    let path = |&index: &usize| wave.variables[index].path.as_str();
    match found.is_empty() {
        false => Ok(found),
        true => {
            let bits: Vec<_> = (0..wave.variables.len()).filter(bit).collect();
            let bits = listed(&bits.iter().map(path).collect::<Vec<_>>());
            let problem = match others {
                Some(other) => format!(
                    "no common clock: there is {other} in the golden file and no {name} here"
                ),
                None => format!("there is no {name} of 1 bit"),
            };
            Err(fault(problem, format!("a signal of 1 bit: {bits}")))
        }
    }
}

fn ends_in_any_case(path: &str, ending: &str) -> bool {
    let start = path.len().checked_sub(ending.len());
    let end = start.and_then(|start| path.get(start..));
    end.is_some_and(|end| end.eq_ignore_ascii_case(ending))
}

/// Returns the part of `window` that both files have, in ticks of the golden run.
pub(super) fn common(golden: &Ticks, other: Range<i128>, window: &Range<u64>) -> Range<i128> {
    let first = i128::from(golden.first);
    let start = first.max(other.start).max(window.start.into());
    let end = (first + i128::from(golden.count))
        .min(other.end)
        .min(window.end.into());
    start..end.max(start)
}

#[cfg(test)]
mod tests;
