//! The glossary: terms in order, each used elsewhere.

use super::{expect_none, notes};
use std::fs;
use std::path::Path;

const NAME: &str = "rtl_notes/glossary.md";

/// The rows of the table: term and meaning.
fn terms(text: &str) -> Vec<(String, String)> {
    let rows = text.lines().filter(|line| line.starts_with("| ")).skip(1);
    let cells = rows.map(|row| {
        let mut cells = row.trim_matches('|').split(" | ").map(str::trim);
        let mut next = || cells.next().unwrap_or_default().to_owned();
        (next(), next())
    });
    cells.collect()
}

/// The comments of documentation in the source below a folder.
fn docs(folder: &Path) -> String {
    let mut text = String::new();
    for entry in fs::read_dir(folder).expect("the source can be read") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            text += &docs(&path);
        } else if let Ok(source) = fs::read_to_string(&path) {
            let lines = source.lines().map(str::trim_start);
            let docs = lines.filter(|line| line.starts_with("///") || line.starts_with("//!"));
            text.extend(docs.flat_map(|line| [line, "\n"]));
        }
    }
    text
}

/// True if the term stands in the text, not only within longer words; it may end with an `s`.
fn is_used(term: &str, text: &str) -> bool {
    text.match_indices(term).any(|(at, _)| {
        let letter = |text: Option<char>| text.is_some_and(char::is_alphanumeric);
        let behind = &text[at + term.len()..];
        let behind = behind.strip_prefix('s').unwrap_or(behind);
        !letter(text[..at].chars().next_back()) && !letter(behind.chars().next())
    })
}

#[test]
fn terms_are_sorted_explained_and_used() {
    let (glossary, others): (Vec<_>, Vec<_>) =
        notes().into_iter().partition(|note| note.name == NAME);
    let terms = terms(&glossary[0].text);
    assert!(terms.len() > 90, "{} terms", terms.len());
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let texts = others.into_iter().map(|note| note.text);
    let text = texts.chain([docs(&source)]).collect::<Vec<_>>();
    let text = text.join("\n").to_lowercase();
    let mut wrong = Vec::new();
    for pair in terms.windows(2) {
        if pair[0].0.to_lowercase() >= pair[1].0.to_lowercase() {
            wrong.push(format!("{} stands before {}", pair[0].0, pair[1].0));
        }
    }
    for (term, meaning) in &terms {
        if meaning.len() < 10 {
            wrong.push(format!("{term}: no meaning"));
        }
        if !is_used(&term.to_lowercase(), &text) {
            wrong.push(format!("{term}: used nowhere else"));
        }
    }
    expect_none(&wrong);
}

#[test]
fn a_term_within_another_word_is_not_used() {
    assert!(is_used("lead", "the lead, leads"));
    assert!(is_used("lead", "leads"));
    assert!(!is_used("lead", "misleading pleads leader"));
}
