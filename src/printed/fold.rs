//! Long expressions in several lines.

use super::text::LINE;

/// Room that every line has, however deep its brackets are.
const SHORTEST: usize = 40;

/// Breaks the lines of an expression that are too long, behind operators that are in as few brackets
/// as possible. Lines after the first are indented by `indent`, and by one more for each bracket
/// that a break is in. `operators` are those of the language, the weakest first.
pub(crate) fn folded(expression: &str, indent: usize, operators: &[&[&str]]) -> String {
    let mut lines = Vec::new();
    for line in expression.lines() {
        let text = line.trim_start();
        let start = indent.max(line.len() - text.len());
        fold(text, start, operators, &mut lines);
    }
    lines.join("\n").trim_start().to_owned()
}

fn fold(mut text: &str, start: usize, operators: &[&[&str]], lines: &mut Vec<String>) {
    let mut depth = 0;
    loop {
        let indent = start + depth;
        let room = LINE.saturating_sub(indent).max(SHORTEST);
        let end = match text.len() <= room {
            true => None,
            false => last_break(text, (depth, room), operators),
        };
        let Some((end, inside)) = end else {
            lines.push(format!("{:indent$}{text}", ""));
            return;
        };
        lines.push(format!("{:indent$}{}", "", &text[..end]));
        text = &text[end + 1..];
        depth = inside;
    }
}

/// Returns the best space to break a text at that begins in `depth` brackets, and the brackets that
/// it is in.
fn last_break(
    text: &str,
    (mut depth, room): (usize, usize),
    operators: &[&[&str]],
) -> Option<(usize, usize)> {
    let mut best = None;
    for (at, letter) in text.bytes().enumerate() {
        match letter {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if at > room && best.is_some() {
            break;
        }
        if letter == b' '
            && let Some(rank) = operators.iter().position(|same| ends(&text[..at], same))
            && best.is_none_or(|(_, least)| (depth, rank) <= least)
        {
            best = Some((at, (depth, rank)));
        }
    }
    best.map(|(at, (depth, _))| (at, depth))
}

/// True if a text ends with one of these operators.
fn ends(text: &str, operators: &[&str]) -> bool {
    operators.iter().any(|operator| text.ends_with(operator))
}

#[cfg(test)]
mod tests {
    use super::folded;

    const OPERATORS: &[&[&str]] = &[&[":"], &["?"], &["||"], &["&&"], &["=="]];

    #[test]
    fn short_lines_stay() {
        let text = "a && b &&\n    (c ||\n     d)";
        assert_eq!(folded(text, 4, OPERATORS), text);
    }

    #[test]
    fn a_long_line_breaks_behind_operators() {
        let long = "a".repeat(40);
        let text = format!("b == ({long} ? {long} : {long} && {long} && c) || d == 4'd1");
        let lines = [
            "b ==".to_owned(),
            format!("        ({long} ? {long} :"),
            format!("         {long} && {long} &&"),
            "         c) || d == 4'd1".to_owned(),
        ];
        assert_eq!(folded(&text, 8, OPERATORS), lines.join("\n"));
    }
}
