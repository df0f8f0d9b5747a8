use super::names::listed;
use super::value::Value;
use super::wave::Wave;
use crate::input::Fault;
use std::ops::Range;

/// The ticks of a file, counted from its start.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Ticks {
    /// Indices of the times of the rising edges.
    rises: Vec<u32>,
    pub count: u64,
    /// The number of the file's first tick in its run.
    pub first: u64,
}

/// A clock that is none.
#[derive(Debug, PartialEq, Eq)]
enum Unusable {
    /// From the index of this time on it is x or z.
    Unknown(u32),
    Constant,
}

impl Ticks {
    /// The ticks by the clock of this variable, which must be loaded.
    pub fn of(wave: &Wave, clock: usize) -> Result<Self, Fault> {
        let changes = wave.changes(clock, 0, 1)?;
        let level =
            |&(at, value): &(u32, Value)| (at, value.is_known().then(|| value == Value::HIGH));
        let levels: Vec<_> = changes.iter().map(level).collect();
        let fault = |problem: String| {
            let allowed = "a clock that is 0 or 1 at all times and changes";
            Fault::new(&wave.file, 0, &wave.variables[clock].path, problem, allowed)
        };
        let mut ticks = Ticks::by(&levels).map_err(|unusable| match unusable {
            Unusable::Constant => fault("the clock never changes".to_owned()),
            Unusable::Unknown(at) => {
                let time = wave.times.get(at as usize).copied().unwrap_or(0);
                fault(format!("the clock is x or z at {}", wave.time(time)))
            }
        })?;
        if wave.ours {
            ticks.first = first(wave, &levels);
        }
        Ok(ticks)
    }

    fn by(levels: &[(u32, Option<bool>)]) -> Result<Self, Unusable> {
        let mut rises = Vec::new();
        let mut before = None;
        let mut changed = false;
        for (place, &(at, level)) in levels.iter().enumerate() {
            // Within a time the last value counts.
            if levels.get(place + 1).is_some_and(|next| next.0 == at) {
                continue;
            }
            let Some(level) = level else {
                return Err(Unusable::Unknown(at));
            };
            changed |= before == Some(!level);
            if before == Some(false) && level {
                rises.push(at);
            }
            before = Some(level);
        }
        if !changed {
            return Err(Unusable::Constant);
        }
        // The interval behind the last edge is a tick once the clock has fallen again.
        let count = rises.len() as u64 + u64::from(before == Some(false));
        Ok(Ticks {
            rises,
            count,
            first: 0,
        })
    }

    /// When a tick of the file begins.
    pub fn time(&self, wave: &Wave, tick: u64) -> u64 {
        let rise = tick
            .checked_sub(1)
            .and_then(|edge| self.rises.get(edge as usize));
        let index = rise.map_or(0, |&rise| rise as usize);
        wave.times.get(index).copied().unwrap_or(0)
    }

    /// What a flip-flop samples in each tick: the last value before the edge that ends it. Only
    /// ticks with a change are in it.
    pub fn sample(&self, changes: &[(u32, Value)]) -> Vec<(u64, Value)> {
        let mut samples: Vec<(u64, Value)> = Vec::new();
        let mut tick = 0;
        for &(at, value) in changes {
            // What changes with the edge belongs to the tick that begins with it.
            while self.rises.get(tick).is_some_and(|&rise| rise <= at) {
                tick += 1;
            }
            match samples.last_mut() {
                Some(last) if last.0 == tick as u64 => last.1 = value,
                _ if tick as u64 >= self.count => break,
                _ => samples.push((tick as u64, value)),
            }
        }
        samples
    }
}

/// The first tick of a dump of ours: tick n begins at n periods, with the clock high for half a
/// period.
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

/// The one variable of one bit that is called `name`, by its path or the end of its path.
pub(super) fn clock(
    wave: &Wave,
    argument: &str,
    name: &str,
    others: Option<&str>,
) -> Result<usize, Fault> {
    let fault =
        |problem: String, allowed: String| Fault::new(&wave.file, 0, argument, problem, allowed);
    let bit = |index: &usize| wave.variables[*index].width == 1;
    if let Some(exact) = wave.find(name) {
        return match bit(&exact) {
            true => Ok(exact),
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
        if variable.path.ends_with(&ending) && !found.iter().any(alias) {
            found.push(index);
        }
    }
    let path = |&index: &usize| wave.variables[index].path.as_str();
    match found[..] {
        [one] => Ok(one),
        [] => {
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
        _ => {
            let found: Vec<_> = found.iter().map(path).collect();
            Err(fault(
                format!("{} signals are called {name}", found.len()),
                format!("one of them by its path: {}", listed(&found)),
            ))
        }
    }
}

/// The part of `window` that both files have, in ticks of the golden run.
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
