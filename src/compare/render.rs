use super::names::{LISTED, listed};
use super::report::{Mismatch, Report, Side};
use std::fmt::{self, Write as _};

/// Number of differing signals listed by default.
const DIFFERENCES: usize = 10;

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text(false))
    }
}

fn count(number: u64, one: &str) -> String {
    match number {
        1 => format!("1 {one}"),
        _ => format!("{number} {one}s"),
    }
}

impl Report {
    /// Formats the report. Long lists are cut unless `all` is true.
    pub fn text(&self, all: bool) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut text, all);
        text
    }

    fn write(&self, out: &mut String, all: bool) -> fmt::Result {
        let signals = count(self.signals as u64, "signal");
        let last = self.from_tick + self.ticks.saturating_sub(1);
        let ticks = format!(
            "{} ({} to {last})",
            count(self.ticks, "tick"),
            self.from_tick
        );
        let values = count(self.values, "value");
        if self.hardly_pairs() {
            let paired = self.paired();
            let all = paired + self.without_partner.len();
            write!(out, "almost nothing pairs, {paired} of {all} signals; ")?;
        }
        let ports = [
            (
                "ports out of golden not compared",
                &self.ports_out_not_compared,
            ),
            ("ports out left out", &self.ports_out_left),
            (
                "ports in of golden without partner",
                &self.ports_in_without_partner,
            ),
        ];
        for (what, ports) in ports.iter().filter(|(_, ports)| !ports.is_empty()) {
            write!(out, "{what}: {}; ", listed(ports))?;
        }
        let complete = ports.iter().all(|(_, ports)| ports.is_empty()) && !self.hardly_pairs();
        for (which, side) in [("golden", &self.golden), ("other", &self.other)] {
            if side.longer > 0 {
                write!(out, "{which} is {} longer; ", count(side.longer, "tick"))?;
            }
        }
        let verdict = match self.differs() {
            false if !complete => "what is compared is equal:".to_owned(),
            false if !self.same_length() => "what both have is equal:".to_owned(),
            false => "equal:".to_owned(),
            true => format!("different: {} of {signals}, in", self.differences.len()),
        };
        let compared = match self.differs() {
            false => format!("{ticks}, {signals}, {values}"),
            true => format!("{ticks}, {values}"),
        };
        let (moved, still) = (self.moved, self.never_changed.len());
        writeln!(
            out,
            "{verdict} {compared}; in golden {moved} moved, {still} never changed"
        )?;
        self.side(out, "golden", &self.golden, None)?;
        self.side(out, "other", &self.other, self.scope.as_deref())?;
        if let Some(first) = &self.first {
            mismatch(out, first)?;
            self.differences(out, all)?;
        }
        self.left_out(out, all)
    }

    fn side(&self, out: &mut String, which: &str, side: &Side, scope: Option<&str>) -> fmt::Result {
        write!(out, "{which:<6} {}: clock {}", side.file, side.clock)?;
        if let Some(scope) = scope {
            write!(
                out,
                ", scope {}",
                if scope.is_empty() { "(none)" } else { scope }
            )?;
        }
        write!(out, ", {}", count(side.ticks, "tick"))?;
        if side.first_tick > 0 {
            write!(out, " from {} on", side.first_tick)?;
        }
        if which == "other" && self.skip != 0 {
            write!(out, ", skip {}", self.skip)?;
        }
        if side.alone > 0 {
            write!(out, ", {} only here", side.alone)?;
        }
        if side.switched_off > 0 {
            write!(out, ", {} switched off, not compared", side.switched_off)?;
        }
        writeln!(out)
    }

    fn differences(&self, out: &mut String, all: bool) -> fmt::Result {
        writeln!(out, "\nfirst tick  ticks  signal")?;
        let shown = if all { usize::MAX } else { DIFFERENCES };
        for one in self.differences.iter().take(shown) {
            writeln!(
                out,
                "{:>10}  {:>5}  {} | {}",
                one.tick, one.ticks, one.golden, one.other
            )?;
        }
        more(out, self.differences.len(), shown)
    }

    fn left_out(&self, out: &mut String, all: bool) -> fmt::Result {
        let shown = if all { usize::MAX } else { LISTED };
        let mut list = |title: &str, names: &[String]| {
            if names.is_empty() {
                return Ok(());
            }
            writeln!(out, "\n{title}: {}", names.len())?;
            for name in names.iter().take(shown) {
                writeln!(out, "  {name}")?;
            }
            more(out, names.len(), shown)
        };
        let widths: Vec<_> = self
            .different_widths
            .iter()
            .map(|one| {
                format!(
                    "{}: {} | {}: {}",
                    one.golden, one.golden_bits, one.other, one.other_bits
                )
            })
            .collect();
        list("different width in bits, not compared", &widths)?;
        list("golden signals without partner", &self.without_partner)?;
        if all {
            list(
                "compared signals that never changed in golden",
                &self.never_changed,
            )?;
            let title = "signals of the other file without partner";
            list(title, &self.other_without_partner)?;
        }
        list("pairs without a value to compare", &self.without_values)?;
        list("ignored", &self.ignored)?;
        list("ports out left out", &self.ports_out_left)?;
        list("wider than 64 bits, not compared", &self.too_wide)?;
        let counts = [
            (
                self.without_partner.len() as u64,
                "without partner in golden",
            ),
            (
                self.other_without_partner.len() as u64,
                "without partner in other",
            ),
            (self.without_values.len() as u64, "without a value"),
            (self.ignored.len() as u64, "ignored"),
            (self.ports_out_left.len() as u64, "left out"),
            (self.different_widths.len() as u64, "of different width"),
            (self.too_wide.len() as u64, "too wide"),
            (self.golden.without_bits as u64, "without bits in golden"),
            (self.other.without_bits as u64, "without bits in other"),
        ];
        let counts = counts.iter().filter(|(number, _)| *number > 0);
        let counts: Vec<_> = counts
            .map(|(number, what)| format!("{number} {what}"))
            .collect();
        if !counts.is_empty() {
            writeln!(out, "\nsignals not compared: {}", counts.join(", "))?;
        }
        match self.unknown_values {
            0 => Ok(()),
            unknown => writeln!(out, "values not compared: {unknown} unknown in golden"),
        }
    }
}

fn more(out: &mut String, all: usize, shown: usize) -> fmt::Result {
    match all.checked_sub(shown) {
        Some(rest @ 1..) => writeln!(out, "  and {rest} more"),
        _ => Ok(()),
    }
}

fn mismatch(out: &mut String, first: &Mismatch) -> fmt::Result {
    let signals = match first.signals {
        1 => "1 signal differs".to_owned(),
        many => format!("{many} signals differ"),
    };
    writeln!(out, "\nfirst in tick {}, in which {signals}:", first.tick)?;
    let names = first.golden.len().max(first.other.len());
    for (which, time, name, value) in [
        (
            "golden",
            &first.golden_time,
            &first.golden,
            &first.golden_value,
        ),
        ("other", &first.other_time, &first.other, &first.other_value),
    ] {
        writeln!(out, "  {which:<6}  {name:<names$}  {value}  at {time}")?;
    }
    out.push('\n');
    table(out, first)
}

/// Writes values in hexadecimal, `golden!other` if they differ.
fn table(out: &mut String, first: &Mismatch) -> fmt::Result {
    let mut columns = vec![vec!["tick".to_owned()]];
    columns[0].extend(first.rows.iter().map(|row| row.signal.clone()));
    for (place, tick) in first.shown_ticks.iter().enumerate() {
        let mut column = vec![tick.to_string()];
        for row in &first.rows {
            let cell = row.cells.get(place);
            column.push(cell.map_or(String::new(), |cell| match &cell.other {
                Some(other) => format!("{}!{other}", cell.golden),
                None => cell.golden.clone(),
            }));
        }
        columns.push(column);
    }
    let width = |column: &Vec<String>| column.iter().map(String::len).max().unwrap_or(0);
    let widths: Vec<_> = columns.iter().map(width).collect();
    for line in 0..=first.rows.len() {
        let mut text = String::new();
        for (column, width) in columns.iter().zip(&widths) {
            write!(text, "{:<width$}  ", column[line])?;
        }
        writeln!(out, "{}", text.trim_end())?;
    }
    writeln!(out, "(hexadecimal, golden!other where they differ)")
}
