//! Signals shown around the first mismatch.

use super::pair::Pair;
use super::report::{Cell, Mismatch, Row};
use super::runs::{Runs, number};
use super::times::times;
use super::wave::Variable;
use crate::input::Fault;

/// Number of rows in the table.
const ROWS: usize = 12;
/// Number of ticks after the mismatch.
const BEHIND: i128 = 2;

impl Runs {
    /// Returns the first mismatch; `differing` lists the signals by first tick, with their index
    /// among the pairs, in order.
    pub(super) fn first(
        &self,
        pairs: &[Pair],
        differing: &[(u64, usize, u64)],
        before: u64,
    ) -> Result<Option<Mismatch>, Fault> {
        let Some(&(tick, place, _)) = differing.first() else {
            return Ok(None);
        };
        let at = i128::from(tick);
        let start = self.common.start.max(at - i128::from(before));
        let end = self.common.end.min(at + BEHIND + 1);
        let mut rows = Vec::new();
        for &place in &self.shown(pairs, differing, tick) {
            rows.push(self.row(&pairs[place], start, end)?);
        }
        let pair = &pairs[place];
        let (golden, other) = self.samples(pair)?;
        let golden_tick = number(at - golden.zero);
        let other_tick = number(at - other.zero);
        let (one, two) = (&self.golden, &self.other);
        let (golden_time, other_time) = times(
            (&one.wave, one.ticks.time(&one.wave, golden_tick)),
            (&two.wave, two.ticks.time(&two.wave, other_tick)),
        );
        Ok(Some(Mismatch {
            tick,
            golden_time,
            other_time,
            signals: differing.iter().filter(|one| one.0 == tick).count(),
            golden: one.wave.variables[pair.golden].path.clone(),
            other: pair.name.clone(),
            golden_value: golden.at(at).shown(pair.width),
            other_value: other.at(at).shown(pair.width),
            shown_ticks: (start..end).map(number).collect(),
            rows,
        }))
    }

    /// Returns the signals to show: those that differ in this tick, then others in the scope of
    /// the first (registers, then the rest), then registers and inputs of the scopes around it,
    /// from the inside out, and last all other signals between it and the outermost scope.
    fn shown(&self, pairs: &[Pair], differing: &[(u64, usize, u64)], tick: u64) -> Vec<usize> {
        let variable = |place: usize| &self.golden.wave.variables[pairs[place].golden];
        let mut shown: Vec<_> = differing
            .iter()
            .filter(|one| one.0 == tick)
            .map(|one| one.1)
            .collect();
        shown.truncate(ROWS);
        let Some(&first) = shown.first() else {
            return shown;
        };
        let mut add = |wanted: Option<&str>, kind: &dyn Fn(&Variable) -> bool| {
            for place in 0..pairs.len() {
                let more = shown.len() < ROWS && !shown.contains(&place);
                let variable = variable(place);
                if more && above(&variable.path) == wanted && kind(variable) {
                    shown.push(place);
                }
            }
        };
        let own = above(&variable(first).path);
        add(own, &|variable| variable.register);
        add(own, &|_| true);
        let mut around = own.and_then(above);
        while let Some(scope) = around {
            add(around, &|variable| variable.register);
            add(around, &|variable| variable.input);
            around = above(scope);
        }
        // A VCD does not distinguish inputs from nets in the scopes between.
        let mut between = own.and_then(above);
        while let Some(scope) = between.filter(|scope| scope.contains('.')) {
            add(between, &|_| true);
            between = above(scope);
        }
        shown
    }

    fn row(&self, pair: &Pair, start: i128, end: i128) -> Result<Row, Fault> {
        let (golden, other) = self.samples(pair)?;
        let held = self.held(&other);
        let cell = |tick: i128| {
            let (expected, found) = (golden.at(tick), other.at(tick));
            let held = held.iter().any(|ticks| ticks.contains(&tick));
            let differs = expected.is_known() && expected != found && held;
            Cell {
                golden: expected.cell(pair.width),
                other: differs.then(|| found.cell(pair.width)),
            }
        };
        Ok(Row {
            signal: self.golden.wave.variables[pair.golden].path.clone(),
            cells: (start..end).map(cell).collect(),
        })
    }
}

/// Returns the scope that contains a signal or a scope.
fn above(path: &str) -> Option<&str> {
    path.rsplit_once('.').map(|(scope, _)| scope)
}
