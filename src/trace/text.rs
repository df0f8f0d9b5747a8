//! Recorded signals drawn as text.

use super::Recorder;
use super::layout::is_word;
use super::value::show;
use crate::hdl::Declaration;
use std::ops::Range;

/// Draws recorded signals as text, one line per signal and one column per tick.
///
/// Bits are levels (`_` low, `#` high). Words show their value where it changes; states have
/// names. Signals are named by their path below the circuit's name. Memory words that do not
/// change in these ticks are left out, and so are ticks that were not recorded.
///
/// ```text
/// tick     0   1   2   3
/// period   3
/// count    1   2   0   1
/// last          ____####________
/// ```
pub fn waves(recorder: &Recorder, ticks: Range<u64>) -> String {
    let recorded = recorder.ticks();
    let start = ticks.start.max(recorded.start);
    let end = ticks.end.min(recorded.end).max(start);
    let place = |tick: u64| usize::try_from(tick - recorded.start).unwrap_or(usize::MAX);

    let mut rows = Vec::new();
    for (index, leaf) in recorder.leaves().iter().enumerate() {
        let column = recorder.column_at(index);
        let shown = column.get(place(start)..place(end)).unwrap_or(&[]);
        if !(is_word(leaf) && shown.windows(2).all(|pair| pair[0] == pair[1])) {
            rows.push(Row::new(leaf, shown));
        }
    }
    draw(&rows, start..end)
}

struct Row {
    name: String,
    cells: Cells,
}

enum Cells {
    Levels(Vec<bool>),
    /// Text of each value that differs from the one before.
    Words(Vec<Option<String>>),
}

impl Row {
    fn new(leaf: &Declaration, values: &[u64]) -> Self {
        let path = leaf.path();
        let name = path
            .split_once('.')
            .map_or(path.as_str(), |(_, below)| below);
        let cells = if leaf.shape.width == 1 {
            Cells::Levels(values.iter().map(|&bits| bits == 1).collect())
        } else {
            let mut before = None;
            let mut text = |&bits: &u64| {
                let changed = before.replace(bits) != Some(bits);
                changed.then(|| show(leaf.shape, leaf.field.format, bits))
            };
            Cells::Words(values.iter().map(&mut text).collect())
        };
        Row {
            name: name.to_owned(),
            cells,
        }
    }
}

fn draw(rows: &[Row], ticks: Range<u64>) -> String {
    let names = rows
        .iter()
        .map(|row| row.name.len())
        .chain([4])
        .max()
        .unwrap_or(4);
    let widest = rows.iter().flat_map(|row| match &row.cells {
        Cells::Levels(_) => &[][..],
        Cells::Words(words) => words,
    });
    let cell = widest.flatten().map(String::len).max().unwrap_or(1).max(1) + 1;
    let label = ticks.end.saturating_sub(1).to_string().len() + 1;
    let step = label.div_ceil(cell) as u64;

    let mut text = format!("{:names$}  ", "tick");
    for tick in ticks.clone().step_by(step as usize) {
        let width = cell * step.min(ticks.end - tick) as usize;
        text.push_str(&format!("{tick:<width$}"));
    }
    end_line(&mut text);
    for row in rows {
        text.push_str(&format!("{:names$}  ", row.name));
        match &row.cells {
            Cells::Levels(levels) => {
                for &high in levels {
                    text.extend(std::iter::repeat_n(if high { '#' } else { '_' }, cell));
                }
            }
            Cells::Words(words) => {
                for word in words {
                    text.push_str(&format!("{:cell$}", word.as_deref().unwrap_or("")));
                }
            }
        }
        end_line(&mut text);
    }
    text
}

fn end_line(text: &mut String) {
    text.truncate(text.trim_end_matches(' ').len());
    text.push('\n');
}
