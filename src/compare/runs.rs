use super::Settings;
use super::hold::{Samples, Tally, hold, without};
use super::pair::{Pair, Pairing};
use super::report::{Difference, Report, Side};
use super::ticks::Ticks;
use super::wave::Wave;
use crate::input::Fault;
use std::collections::HashSet;
use std::ops::Range;

/// File with its ticks.
#[derive(Debug)]
pub(super) struct Run {
    pub wave: Wave,
    pub clock: usize,
    pub ticks: Ticks,
}

/// Two files with common ticks.
#[derive(Debug)]
pub(super) struct Runs {
    pub golden: Run,
    pub other: Run,
    /// Golden tick of the other file's first tick.
    pub start: i128,
    pub common: Range<i128>,
}

pub(super) fn span(ticks: Range<i128>) -> String {
    match ticks.is_empty() {
        true => "no tick".to_owned(),
        false => format!("ticks {} to {}", ticks.start, ticks.end - 1),
    }
}

pub(super) fn number(tick: i128) -> u64 {
    u64::try_from(tick).unwrap_or(0)
}

/// Returns the ticks in which a dump was switched off; its first tick has the number `zero`.
fn off(ticks: &Ticks, zero: i128) -> impl Iterator<Item = Range<i128>> {
    let shifted = move |off: &Range<u64>| zero + i128::from(off.start)..zero + i128::from(off.end);
    ticks.off.iter().map(shifted)
}

impl Run {
    pub fn of(wave: Wave, clock: usize) -> Result<Self, Fault> {
        let ticks = Ticks::of(&wave, clock)?;
        Ok(Run { wave, clock, ticks })
    }

    /// Returns the samples of a golden signal's partner in this file, whose first tick is `start`.
    pub fn partner(&self, pair: &Pair, start: i128) -> Result<Samples, Fault> {
        let width = pair.width;
        let mut changes = self.wave.changes(pair.other, pair.low, width)?;
        if pair.invert {
            for (_, value) in &mut changes {
                *value = value.inverted(width);
            }
        }
        Ok(Samples {
            changes: self.ticks.sample(&changes),
            zero: start - i128::from(pair.delay),
            width,
        })
    }

    fn side(&self, alone: i128, longer: i128, off: i128) -> Side {
        Side {
            file: self.wave.file.clone(),
            clock: self.wave.variables[self.clock].path.clone(),
            first_tick: self.ticks.first,
            ticks: self.ticks.count,
            alone: number(alone),
            longer: number(longer),
            switched_off: number(off),
            without_bits: self.wave.without_bits,
        }
    }
}

impl Runs {
    pub fn samples(&self, pair: &Pair) -> Result<(Samples, Samples), Fault> {
        let width = pair.width;
        let golden = self.golden.wave.changes(pair.golden, 0, width)?;
        let golden = Samples {
            changes: self.golden.ticks.sample(&golden),
            zero: self.golden.ticks.first.into(),
            width,
        };
        Ok((golden, self.other.partner(pair, self.start)?))
    }

    fn tally(&self, pair: &Pair) -> Result<Tally, Fault> {
        let (golden, other) = self.samples(pair)?;
        let mut tally = Tally::default();
        for ticks in self.held(&other) {
            tally.add(hold(&golden, &other, ticks));
        }
        Ok(tally)
    }

    /// Returns the ticks in which a signal is compared with golden's.
    pub fn held(&self, other: &Samples) -> Vec<Range<i128>> {
        // The last ticks of a delayed signal are after the end of the file.
        let end = self
            .common
            .end
            .min(other.zero + i128::from(self.other.ticks.count));
        let golden = off(&self.golden.ticks, self.golden.ticks.first.into());
        let mut off: Vec<_> = golden.chain(off(&self.other.ticks, other.zero)).collect();
        off.sort_by_key(|ticks| ticks.start);
        without(self.common.start..end, off.into_iter())
    }

    pub fn report(&self, pairing: Pairing, settings: &Settings) -> Result<Report, Fault> {
        let (mut values, mut unknown, mut moved) = (0, 0, 0);
        let (mut differing, mut without_values) = (Vec::new(), Vec::new());
        let (mut compared, mut still) = (HashSet::new(), Vec::new());
        for (place, pair) in pairing.pairs.iter().enumerate() {
            let tally = self.tally(pair)?;
            match (tally.compared, tally.moved) {
                (0, _) => without_values.push(pair.golden),
                (_, true) => moved += 1,
                (_, false) => still.push(pair.golden),
            }
            if tally.compared > 0 {
                compared.insert(pair.golden);
            }
            values += tally.compared;
            unknown += tally.unknown;
            if let Some(first) = tally.first {
                differing.push((number(first), place, tally.differing));
            }
        }
        differing.sort_unstable();
        let paths = |wave: &Wave, of: &[usize]| -> Vec<String> {
            of.iter()
                .map(|&index| wave.variables[index].path.clone())
                .collect()
        };
        let (golden, other) = (&self.golden, &self.other);
        let free = pairing.free(&other.wave, other.clock);
        let differences = differing.iter().map(|&(tick, place, ticks)| Difference {
            golden: golden.wave.variables[pairing.pairs[place].golden]
                .path
                .clone(),
            other: pairing.pairs[place].name.clone(),
            tick,
            ticks,
        });
        let is_port = |index: &usize| {
            let variable = &golden.wave.variables[*index];
            let above = variable.path.matches('.').count() == 1;
            above && variable.input && !pairing.ports.out.contains(index)
        };
        let ports_in = pairing.without_partner.iter().copied().filter(is_port);
        let ports_in: Vec<usize> = ports_in.collect();
        let ports_out = &pairing.ports.out;
        let is_left = |index: &usize| pairing.ports.left.contains(index);
        let (left, held): (Vec<_>, Vec<_>) = ports_out.iter().partition(|index| is_left(index));
        let missed = held.into_iter().filter(|index| !compared.contains(index));
        let missed: Vec<usize> = missed.collect();
        let window = i128::from(settings.ticks.start)..i128::from(settings.ticks.end);
        let side = |start: i128, run: &Run| {
            let end = (start + i128::from(run.ticks.count)).min(window.end);
            let common = self.common.end - self.common.start;
            let alone = (end - start.max(window.start)).max(0) - common;
            let common = &self.common;
            let within = |off: Range<i128>| off.end.min(common.end) - off.start.max(common.start);
            let off: i128 = off(&run.ticks, start)
                .map(within)
                .filter(|&ticks| ticks > 0)
                .sum();
            run.side(alone, end - common.end, off)
        };
        Ok(Report {
            golden: side(golden.ticks.first.into(), golden),
            other: side(self.start, other),
            from_tick: number(self.common.start),
            ticks: number(self.common.end - self.common.start),
            skip: settings.skip,
            signals: pairing.pairs.len() - without_values.len(),
            values,
            unknown_values: unknown,
            moved,
            never_changed: paths(&golden.wave, &still),
            ports_out: paths(&golden.wave, ports_out),
            ports_out_not_compared: paths(&golden.wave, &missed),
            ports_out_left: paths(&golden.wave, &left),
            ports_in_without_partner: paths(&golden.wave, &ports_in),
            without_partner: paths(&golden.wave, &pairing.without_partner),
            other_without_partner: paths(&other.wave, &free),
            ignored: paths(&golden.wave, &pairing.ignored),
            without_values: paths(&golden.wave, &without_values),
            too_wide: paths(&golden.wave, &pairing.too_wide),
            differences: differences.collect(),
            first: self.first(&pairing.pairs, &differing, settings.around)?,
            scope: pairing.scope,
            different_widths: pairing.widths,
        })
    }

    /// Returns the error that no value was compared, which does not mean that the files are equal.
    pub fn no_value(&self, report: &Report) -> Fault {
        let ticks = span(self.common.clone());
        let off = report.golden.switched_off + report.other.switched_off;
        let (file, problem, allowed) = match report.unknown_values {
            0 if off > 0 => (
                &report.other.file,
                format!("nothing to compare: in {ticks} one of the two dumps is switched off"),
                "dumps that are both on in a tick",
            ),
            0 => (
                &report.other.file,
                format!(
                    "nothing to compare: by the map's delays {ticks} are behind the end of this file"
                ),
                "delays that leave a tick of both; --from and --ticks choose other ticks",
            ),
            unknown => (
                &report.golden.file,
                format!(
                    "nothing to compare: in {ticks} all {unknown} values are x, z or not yet set"
                ),
                "a golden file with known values there; --from and --ticks choose other ticks",
            ),
        };
        Fault::new(file, 0, "values", problem, allowed)
    }
}
