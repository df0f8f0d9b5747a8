//! Texts of a comparison.

use super::recent::{Past, Recent};
use super::{CheckedPort, Checker, State, Verdict};
use crate::netlist::Kind;
use std::fmt::Write as _;

/// Number of ticks that are shown up to a difference.
const SHOWN: usize = 8;

/// Returns bits as a number of the port's kind.
fn number(port: &CheckedPort, bits: u64) -> String {
    match port.shape.kind {
        Kind::Signed => {
            let above = 64 - port.shape.width;
            ((bits << above) as i64 >> above).to_string()
        }
        Kind::Bit | Kind::Unsigned => bits.to_string(),
    }
}

/// Returns bits as hexadecimal digits.
fn hexadecimal(port: &CheckedPort, bits: u64) -> String {
    format!("{bits:0digits$x}", digits = port.shape.width.div_ceil(4))
}

fn counted(number: u64, one: &str) -> String {
    match number {
        1 => format!("1 {one}"),
        _ => format!("{number} {one}s"),
    }
}

impl Checker {
    /// Says which ports differ in this tick, for the first time; `values` are the model's.
    pub(super) fn first_difference(
        &self,
        rst: bool,
        words: &[u64],
        recent: &Recent,
        values: &[(usize, u64)],
    ) -> String {
        let tick = self.model.tick();
        let mut text = format!("first difference in tick {tick}:\n");
        for &(index, model) in values {
            let port = &self.ports[index];
            let model = number(port, model);
            let design = match self.unknown_bits(index) {
                Some(bits) => format!("{bits} (binary, unknown)"),
                None => number(port, port.place.bits(words[port.place.word])),
            };
            // Writing to a string does not fail.
            let _ = writeln!(text, "  {}: design {design}, model {model}", port.name);
        }
        let last = Past { tick, rst, words };
        let mut ticks: Vec<Past<'_>> = recent.ticks().chain([last]).collect();
        ticks.drain(..ticks.len().saturating_sub(SHOWN));
        text + &self.table(&ticks, values)
    }

    /// Returns ticks as a table; in the last one, `values` of the model differ.
    fn table(&self, ticks: &[Past<'_>], values: &[(usize, u64)]) -> String {
        let row = |name: &str, cell: &dyn Fn(&Past<'_>) -> String| {
            let cells = ticks.iter().map(cell);
            std::iter::once(name.to_owned()).chain(cells).collect()
        };
        let mut rows: Vec<Vec<String>> = vec![
            row("tick", &|past| past.tick.to_string()),
            row("rst", &|past| u8::from(past.rst).to_string()),
        ];
        for (index, port) in self.ports.iter().enumerate() {
            let bits = |past: &Past<'_>| port.place.bits(past.words[port.place.word]);
            let mut cells: Vec<String> = row(&port.name, &|past| hexadecimal(port, bits(past)));
            if let Some(last) = cells.last_mut() {
                if let Some(bits) = self.unknown_bits(index) {
                    *last = bits.to_owned();
                }
                if let Some((_, model)) = values.iter().find(|(other, _)| *other == index) {
                    *last = format!("{}!{last}", hexadecimal(port, *model));
                }
            }
            rows.push(cells);
        }
        let width = |column: usize| rows.iter().map(|row| row[column].len()).max();
        let widths: Vec<usize> = (0..=ticks.len()).filter_map(width).collect();
        let mut text = String::new();
        for row in &rows {
            let cells = row.iter().zip(&widths);
            let line = cells.map(|(cell, &width)| format!("{cell:<width$}"));
            let line = line.collect::<Vec<_>>().join("  ");
            text += line.trim_end();
            text.push('\n');
        }
        text + "(hexadecimal, model!design where they differ)\n"
    }

    fn unknown_bits(&self, index: usize) -> Option<&str> {
        let mut unknown = self.unknown.iter();
        let found = unknown.find(|unknown| unknown.port == Some(index));
        found.map(|unknown| unknown.bits.as_str())
    }

    /// Says that an unknown input ends the comparison in this tick.
    pub(super) fn stopped(&self, name: &str, bits: &str) -> String {
        let tick = self.model.tick();
        format!(
            "tick {tick}: input {name} is {bits} (binary, unknown); the comparison stops here\n"
        )
    }

    pub(super) fn verdict(&self) -> Verdict {
        let outputs = &self.ports[self.layout.inputs.len()..];
        let vacuous = self.ticks == 0 || outputs.iter().all(|port| port.moves == 0);
        match self.differing_ticks > 0 || self.state == State::Stopped {
            true => Verdict::Fail,
            false if vacuous => Verdict::Vacuous,
            false => Verdict::Pass,
        }
    }

    /// Returns the report at the end, the verdict in its first line.
    pub(super) fn report(&self, verdict: Verdict) -> String {
        let outputs = &self.ports[self.layout.inputs.len()..];
        let values = self.ticks * outputs.len() as u64;
        let ticks = counted(self.ticks, "tick");
        let differences: u64 = outputs.iter().map(|port| port.differences).sum();
        let mut text = match verdict {
            Verdict::Pass => format!("PASS: {} equal in {ticks}", counted(values, "value")),
            Verdict::Fail if differences == 0 => {
                format!("FAIL: an unknown input has stopped the comparison after {ticks}")
            }
            Verdict::Fail => {
                let differing = self.differing_ticks;
                format!("FAIL: {differences} of {values} values differ, in {differing} of {ticks}")
            }
            Verdict::Vacuous => format!("VACUOUS: {}", self.why_vacuous()),
        };
        text.push('\n');
        for port in outputs.iter().filter(|port| port.differences > 0) {
            let CheckedPort { name, first, .. } = port;
            let differences = counted(port.differences, "difference");
            // Writing to a string does not fail.
            let _ = writeln!(text, "  {name}: {differences}, the first in tick {first}");
        }
        let (moved, still): (Vec<_>, Vec<_>) = self.ports.iter().partition(|port| port.moves > 0);
        let moved = moved
            .iter()
            .map(|port| format!("{} {}", port.name, port.moves));
        let still = still.iter().map(|port| port.name.clone());
        for (head, names) in [
            ("moved, how often", moved.collect::<Vec<_>>()),
            ("never moved", still.collect()),
            ("left out", self.left.clone()),
        ] {
            if !names.is_empty() {
                let _ = writeln!(text, "{head}: {}", names.join(", "));
            }
        }
        text
    }

    fn why_vacuous(&self) -> String {
        let edges = counted(self.edges, "edge");
        match (self.ticks, self.edges) {
            (0, 0) => "there was no clock edge".to_owned(),
            (0, _) if self.state == State::Waiting => format!(
                "rst was 1 in none of {edges}, so nothing was compared; FROM_POWER_ON \
                 (from_power_on in Python) compares from the first edge"
            ),
            (0, _) => format!("the reset lasted for all of {edges}, so nothing was compared"),
            _ if self.ports.len() == self.layout.inputs.len() => {
                "no output port is compared".to_owned()
            }
            _ => format!("no output port moved in {}", counted(self.ticks, "tick")),
        }
    }
}
