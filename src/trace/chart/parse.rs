use super::{Cell, Chart, ChartError, Problem, Row};

/// Parses all charts of a note, in order. Skips other code blocks, and charts quoted inside them.
///
/// # Errors
/// Returns an error for the first chart line that cannot be read.
pub fn parse(markdown: &str) -> Result<Vec<Chart>, ChartError> {
    let mut charts = Vec::new();
    let mut lines = markdown.lines().zip(1..);
    while let Some((text, line)) = lines.next() {
        let Some((fence, info)) = fence(text) else {
            // A chart that would be skipped.
            if text.trim().starts_with("```chart ") {
                return Err(Problem::Backtick.at(line));
            }
            continue;
        };
        let mut draft = match info.split_once(char::is_whitespace).unwrap_or((info, "")) {
            ("chart", title) => Some(Draft::new(title, line)?),
            _ => None,
        };
        let mut closed = false;
        for (text, line) in lines.by_ref() {
            if closes(text, fence) {
                closed = true;
                break;
            }
            if let Some(draft) = &mut draft {
                draft.line(text.trim(), line)?;
            }
        }
        if let Some(draft) = draft {
            if !closed {
                return Err(Problem::Unclosed.at(line));
            }
            charts.push(draft.finish()?);
        }
    }
    Ok(charts)
}

/// Returns the marks of an opening fence and the text after them.
fn fence(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    let mark = text
        .chars()
        .next()
        .filter(|mark| ['`', '~'].contains(mark))?;
    let info = text.trim_start_matches(mark);
    let marks = &text[..text.len() - info.len()];
    (marks.len() >= 3 && !(mark == '`' && info.contains('`'))).then_some((marks, info.trim()))
}

/// The elements of a list up to the bracket that ends it, and the text behind that.
fn bracketed(text: &str) -> Option<(Vec<&str>, &str)> {
    let (mut elements, mut begin, mut depth, mut quoted) = (Vec::new(), 0, 0, None);
    for (at, mark) in text.char_indices() {
        match mark {
            _ if quoted == Some(mark) => quoted = None,
            _ if quoted.is_some() => {}
            '"' | '\'' => quoted = Some(mark),
            '[' | '{' => depth += 1,
            ']' if depth == 0 => {
                let last = text[begin..at].trim();
                elements.extend((begin > 0 || !last.is_empty()).then_some(last));
                return Some((elements, &text[at + 1..]));
            }
            ']' | '}' => depth -= 1,
            ',' if depth == 0 => {
                elements.push(text[begin..at].trim());
                begin = at + 1;
            }
            _ => {}
        }
    }
    None
}

fn closes(text: &str, fence: &str) -> bool {
    let text = text.trim();
    text.len() >= fence.len()
        && text.starts_with(fence)
        && text.trim_start_matches(&fence[..1]).is_empty()
}

/// Chart whose lines are being read.
struct Draft(Chart);

impl Draft {
    fn new(text: &str, line: usize) -> Result<Self, ChartError> {
        let text = text.trim();
        let name_ends = text.find(|c: char| !c.is_alphanumeric() && c != '_');
        let (circuit, rest) = text.split_at(name_ends.unwrap_or(text.len()));
        let (pairs, title) = match rest.strip_prefix('[') {
            Some(rest) => bracketed(rest).ok_or(Problem::Fence.at(line))?,
            None => (Vec::new(), rest),
        };
        let separate = title.is_empty() || title.starts_with(char::is_whitespace);
        if circuit.is_empty() || !separate {
            return Err(Problem::Fence.at(line));
        }
        let pairs = pairs.into_iter().map(str::parse).collect::<Result<_, _>>();
        let pairs = pairs.map_err(|error| Problem::Pair(error).at(line))?;
        Ok(Draft(Chart {
            circuit: circuit.to_owned(),
            pairs,
            title: title.trim().to_owned(),
            line,
            ticks: 0,
            inputs: Vec::new(),
            expected: Vec::new(),
        }))
    }

    fn line(&mut self, text: &str, line: usize) -> Result<(), ChartError> {
        let chart = &mut self.0;
        if text.is_empty() || text.starts_with("//") {
            return Ok(());
        }
        if let Some(ticks) = text.strip_prefix("tick") {
            let counted = ticks.split_whitespace().zip(0..);
            let good = chart.ticks == 0 && counted.clone().all(|(cell, n)| *cell == n.to_string());
            chart.ticks = counted.count();
            if good && chart.ticks > 0 {
                return Ok(());
            }
            return Err(Problem::Ticks.at(line));
        }
        let (rest, is_input) = match (text.strip_prefix('>'), text.strip_prefix('=')) {
            (Some(rest), _) => (rest, true),
            (_, Some(rest)) => (rest, false),
            _ => return Err(Problem::Line.at(line)),
        };
        let mut words = rest.split_whitespace();
        let Some(name) = words.next() else {
            return Err(Problem::Line.at(line));
        };
        if chart.ticks == 0 {
            return Err(Problem::Ticks.at(line));
        }
        let row = Row {
            line,
            name: name.to_owned(),
            cells: words.flat_map(cells).collect(),
        };
        row.check(is_input, chart.ticks)?;
        let rows = if is_input {
            &mut chart.inputs
        } else {
            &mut chart.expected
        };
        if rows.iter().any(|other| other.name == row.name) {
            return Err(Problem::Twice(row.name).at(line));
        }
        rows.push(row);
        Ok(())
    }

    fn finish(self) -> Result<Chart, ChartError> {
        if self.0.expected.is_empty() {
            return Err(Problem::Empty.at(self.0.line));
        }
        Ok(self.0)
    }
}

impl Row {
    fn check(&self, is_input: bool, ticks: usize) -> Result<(), ChartError> {
        let signal = self.name.clone();
        let problem = if self.cells.len() != ticks {
            Problem::Ragged {
                signal,
                cells: self.cells.len(),
                ticks,
            }
        } else if self.cells.first() == Some(&Cell::Repeat) {
            Problem::NothingToRepeat(signal)
        } else if is_input && self.cells.contains(&Cell::Any) {
            Problem::NoValue(signal)
        } else {
            return Ok(());
        };
        Err(problem.at(self.line))
    }
}

/// Returns the cells of a word in a line: one per character if all are of `_#.-`, else one.
fn cells(word: &str) -> Vec<Cell> {
    let mark = |c| match c {
        '_' => Some(Cell::Low),
        '#' => Some(Cell::High),
        '.' => Some(Cell::Repeat),
        '-' => Some(Cell::Any),
        _ => None,
    };
    word.chars()
        .map(mark)
        .collect::<Option<Vec<_>>>()
        .unwrap_or_else(|| vec![Cell::Word(word.to_owned())])
}
