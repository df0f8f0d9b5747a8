//! Tables of a summary for people.

use std::fmt::{self, Write};

/// Rows of a table, unless all are asked for.
const SHOWN: usize = 6;

/// The worst few of some rows, or all in their order, and how many are left out.
pub fn worst<T>(rows: &[T], all: bool, badness: impl Fn(&T) -> f64) -> (Vec<&T>, usize) {
    let mut shown: Vec<&T> = rows.iter().collect();
    if !all && rows.len() > SHOWN {
        shown.sort_by(|a, b| badness(b).total_cmp(&badness(a)));
        shown.truncate(SHOWN);
    }
    let left = rows.len() - shown.len();
    (shown, left)
}

/// Ends a table: how many rows are left out, and why those.
pub fn more(text: &mut String, left: usize, why: &str) -> fmt::Result {
    match left {
        0 => writeln!(text),
        _ => writeln!(text, "and {left} more, {why}: --segments shows all\n"),
    }
}

/// A table with these heads, every column as wide as its head or as said, its cells to the right.
pub fn table<const N: usize>(
    text: &mut String,
    heads: [(&str, usize); N],
    rows: impl IntoIterator<Item = [String; N]>,
) -> fmt::Result {
    let widths = heads.map(|(head, least)| least.max(head.len()));
    let heads = heads.map(|(head, _)| head.to_owned());
    for cells in std::iter::once(heads).chain(rows) {
        let cells = cells.iter().zip(widths);
        let cells: Vec<_> = cells
            .map(|(cell, width)| format!("{cell:>width$}"))
            .collect();
        writeln!(text, "{}", cells.join("  ").trim_end())?;
    }
    Ok(())
}

/// A number with so many decimals, without the sign of what rounds to nothing.
pub fn fixed(value: f64, decimals: usize) -> String {
    let shown = format!("{value:.decimals$}");
    let nothing = shown.bytes().all(|byte| b"-0.".contains(&byte));
    shown
        .trim_start_matches(if nothing { "-" } else { "" })
        .to_owned()
}

/// A number that may not be there.
pub fn or_dash(value: Option<impl ToString>) -> String {
    value.map_or("-".to_owned(), |value| value.to_string())
}
