//! Reader of tables in CSV, as written by the command `table` or by other programs that fill the
//! memory (¶0013).
//!
//! ```text
//! unit,period_ticks,x_half_period_ticks,x_down,y_half_period_ticks,y_down
//! 0,800,200,0,0,0                       for every unit time its T, and a word of each axis
//! 1,800,133,0,400,1
//! ```
//!
//! Blank lines and lines that begin with `#` are skipped.

use super::words::{MAX_UNITS, Table, Word};
use crate::circuits::pulse_interpolator::{AXES_MAX, AXIS_NAMES, Widths};
use crate::input::{Fault, counted, read_string};
use std::ops::RangeInclusive;
use std::path::Path;

/// Returns the column names of a table with `axes` axes.
#[must_use]
pub fn columns(axes: usize) -> Vec<String> {
    let words = AXIS_NAMES
        .iter()
        .take(axes)
        .flat_map(|name| [format!("{name}_half_period_ticks"), format!("{name}_down")]);
    ["unit".to_owned(), "period_ticks".to_owned()]
        .into_iter()
        .chain(words)
        .collect()
}

/// Reads a table from disk, for a reference clock of `clock_hz`.
///
/// # Errors
/// Returns an error if the file cannot be read, and the errors of [`read`].
pub fn read_path(path: &Path, clock_hz: u64) -> Result<Table, Fault> {
    let text = read_string(path, "a table in CSV")?;
    read(&path.display().to_string(), &text, clock_hz)
}

/// Returns the names of the columns, and the axes that they are for.
fn names(header: &str) -> (Vec<&str>, usize) {
    let names = header.split(',').map(str::trim);
    let names: Vec<_> = names.take(3 + 2 * AXES_MAX).collect();
    let axes = names.len().saturating_sub(2) / 2;
    (names, axes)
}

/// Returns true for the header of a table.
#[must_use]
pub fn is_header(line: &str) -> bool {
    let (names, axes) = names(line.trim_start_matches('\u{feff}'));
    (1..=AXES_MAX).contains(&axes) && names == columns(axes)
}

/// Parses a table; faults name the file `file`.
///
/// # Errors
/// Returns an error for a header with other columns, a row with more or fewer fields, a unit out
/// of order, an invalid number or one that does not fit its word, no rows or too many.
pub fn read(file: &str, text: &str, clock_hz: u64) -> Result<Table, Fault> {
    let widths = Widths::default();
    let greatest = |bits: usize| (1u64 << bits) - 1;
    let lines = text.trim_start_matches('\u{feff}').lines().zip(1..);
    let mut lines = lines.filter(|(line, _)| !line.trim().is_empty() && !line.starts_with('#'));
    let Some((header, number)) = lines.next() else {
        return Err(Fault::new(file, 0, "header", "missing", header_allowed()));
    };
    let (names, axes) = names(header);
    if !is_header(header) {
        let problem = format!("is {header}");
        return Err(Fault::new(
            file,
            number,
            "header",
            problem,
            header_allowed(),
        ));
    }
    let mut table = Table::new(clock_hz, axes, widths.half_period as u32);
    for (line, number) in lines {
        let fields: Vec<_> = line.split(',').map(str::trim).collect();
        if fields.len() != names.len() {
            let problem = format!("has {}", counted(fields.len(), "field"));
            let allowed = format!("{}, as the header", names.len());
            return Err(Fault::new(file, number, "row", problem, allowed));
        }
        let field = |column: usize, allowed: RangeInclusive<u64>| {
            let value = fields[column].parse::<u64>().ok();
            value
                .filter(|value| allowed.contains(value))
                .ok_or_else(|| {
                    let problem = format!("is {}", fields[column]);
                    let (least, most) = allowed.into_inner();
                    let allowed = match least == most {
                        true => format!("{least}: the unit times in order"),
                        false => format!("{least} to {most}"),
                    };
                    Fault::new(file, number, names[column], problem, allowed)
                })
        };
        let unit = table.units() as u64;
        field(0, unit..=unit)?;
        let period = field(1, 1..=greatest(widths.period))?;
        let mut words = [Word::new(0, false); AXES_MAX];
        for (axis, word) in words.iter_mut().enumerate().take(axes) {
            let half_period = field(2 + 2 * axis, 0..=greatest(widths.half_period))?;
            let down = field(3 + 2 * axis, 0..=1)?;
            *word = Word::new(half_period as u32, down == 1);
        }
        let room = table.open_unit(period as u32).is_ok();
        if !room {
            let problem = format!("more than {MAX_UNITS} unit times");
            let allowed = format!("at most {MAX_UNITS}");
            return Err(Fault::new(file, number, "unit", problem, allowed));
        }
        words[..axes].iter().for_each(|word| table.push(*word));
    }
    if table.units() == 0 {
        let allowed = "one for each unit time";
        return Err(Fault::new(file, number, "row", "none", allowed));
    }
    Ok(table)
}

fn header_allowed() -> String {
    let names = columns(1).join(",");
    format!("{names} and so on for y, z, a, b, c, u, v")
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "unit,period_ticks,x_half_period_ticks,x_down\n";

    #[test]
    fn a_table_is_what_its_rows_say() {
        let text = "\u{feff}# by hand\r\n\
            unit, period_ticks, x_half_period_ticks, x_down, y_half_period_ticks, y_down\r\n\
            0, 10, 3, 1, 0, 0\r\n\n1, 10, 65535, 0, 1, 1\n2, 16777215, 7, 0, 0, 1\n";
        let table = read("t.csv", text, 1000).unwrap();
        let words: Vec<_> = table
            .words()
            .map(|w| (w.half_period(), w.negative()))
            .collect();
        let expected = [
            (3, true),
            (0, false),
            (65535, false),
            (1, true),
            (7, false),
            (0, true),
        ];
        assert_eq!(words, expected);
        let patterns: Vec<_> = table
            .patterns()
            .iter()
            .map(|p| (p.period, p.length))
            .collect();
        assert_eq!(patterns, [(10, 2), (16_777_215, 1)]);
        assert_eq!((table.axes(), table.clock_hz()), (2, 1000));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line_and_field() {
        let rows = |rows: &str| format!("{HEADER}{rows}");
        for (text, expected) in [
            (
                String::new(),
                "t.csv: header: missing; allowed: unit,period_ticks,x_half",
            ),
            (
                "t,x\n0,0\n".into(),
                "t.csv:1: header: is t,x; allowed: unit,period_ticks,x_half",
            ),
            (
                HEADER.replace("x_down", "y_down"),
                "t.csv:1: header: is unit,",
            ),
            (
                rows(""),
                "t.csv:1: row: none; allowed: one for each unit time",
            ),
            (
                rows("0,10,3\n"),
                "t.csv:2: row: has 3 fields; allowed: 4, as the header",
            ),
            (
                rows("0\n"),
                "t.csv:2: row: has 1 field; allowed: 4, as the header",
            ),
            (
                rows("1,10,3,0\n"),
                "t.csv:2: unit: is 1; allowed: 0: the unit times in order",
            ),
            (
                rows("0,10,3,0\n\n0,1,1,1\n"),
                "t.csv:4: unit: is 0; allowed: 1: the",
            ),
            (
                rows("0,0,3,0\n"),
                "t.csv:2: period_ticks: is 0; allowed: 1 to 16777215",
            ),
            (
                rows("0,16777216,3,0\n"),
                "t.csv:2: period_ticks: is 16777216; allowed: 1 to",
            ),
            (
                rows("0,9,65536,0\n"),
                "t.csv:2: x_half_period_ticks: is 65536; allowed: 0 to 65535",
            ),
            (
                rows("0,9,-1,0\n"),
                "t.csv:2: x_half_period_ticks: is -1; allowed: 0 to 65535",
            ),
            (
                rows("0,9,1.5,0\n"),
                "t.csv:2: x_half_period_ticks: is 1.5; allowed: 0 to 65535",
            ),
            (rows("0,9,1,2\n"), "t.csv:2: x_down: is 2; allowed: 0 to 1"),
        ] {
            let fault = read("t.csv", &text, 1000).unwrap_err().to_string();
            assert!(fault.starts_with(expected), "{fault}");
        }
    }
}
