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

/// Formats a number with `decimals` decimals; a number that rounds to zero has no sign.
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

/// Formats a number with `decimals` decimals, or a dash where there is none.
pub fn fixed_or_dash(value: Option<f64>, decimals: usize) -> String {
    or_dash(value.map(|value| fixed(value, decimals)))
}
