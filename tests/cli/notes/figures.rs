//! Numbers that somebody wrote into README and notes by hand: each stands in a list, which only
//! gets shorter. A number comes from a generated mark, or is a word, or is not there.
//!
//! A number is a row of digits outside of code, links, headings, references to a patent's text and
//! what stands between marks. Digits behind a letter belong to a name.

use super::expect_none;
use super::links::{documents, prose};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

const LIST: &str = "tests/cli/notes/figures.txt";

/// Words behind which a number is a place in a patent's text.
const REFERENCES: [&str; 8] = [
    "¶",
    "Fig. ",
    "Figs ",
    "Figs. ",
    "claim ",
    "claims ",
    "equation ",
    "equations ",
];

/// The text without what stands between two marks, which stay.
fn without(text: &str, open: &str, close: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once(open) {
        let Some((_, after)) = behind.split_once(close) else {
            break;
        };
        kept.extend([before, open, "…", close]);
        rest = after;
    }
    kept + rest
}

/// The text without the numbers, lists and ranges of them that refer to a patent's text.
fn without_references(text: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    let next = |rest: &str| {
        let found = REFERENCES.iter().filter_map(|word| {
            let at = rest.find(word)?;
            Some((at, at + word.len()))
        });
        found.min()
    };
    while let Some((_, end)) = next(rest) {
        kept += &rest[..end];
        rest = &rest[end..];
        loop {
            rest = rest.trim_start_matches(|letter: char| letter.is_ascii_digit());
            let joint = [", ", " and ", " to ", "–"];
            let digits = |rest: &str| rest.starts_with(|letter: char| letter.is_ascii_digit());
            let mut joined = joint.iter().filter_map(|joint| rest.strip_prefix(joint));
            match joined.find(|rest| digits(rest)) {
                Some(more) => rest = more,
                None => break,
            }
        }
    }
    kept + rest
}

/// True if there is a digit that does not belong to a name.
fn has_number(text: &str) -> bool {
    let (mut before, mut name) = (' ', false);
    text.chars().any(|letter| {
        let number = letter.is_ascii_digit() && !name && before != '_';
        // A hyphen behind a letter goes on with a name, as in Verilog-2001.
        name = letter.is_alphanumeric() || letter == '-' && before.is_alphabetic();
        before = letter;
        number
    })
}

/// The sentences of a document that have a number, code and links shortened; a row of a table is
/// one.
fn figures(text: &str) -> BTreeSet<String> {
    let mut figures = BTreeSet::new();
    let (mut marked, mut numerals) = (false, false);
    for (_, line) in prose(text) {
        marked = (marked || line.starts_with("<!-- begin ")) && !line.starts_with("<!-- end ");
        // The parts of a patent's figures, with their paragraphs.
        numerals = (numerals || line.starts_with("| numeral |")) && line.starts_with('|');
        if marked || numerals || line.starts_with('#') {
            continue;
        }
        let line = without(&without(line, "`", "`"), "](", ")");
        let line = without_references(&line);
        let sentences: Vec<_> = match line.starts_with('|') {
            true => vec![&line[..]],
            false => line.split_inclusive(['.', '?', '!']).collect(),
        };
        let mut whole = String::new();
        for (index, part) in sentences.iter().enumerate() {
            whole += part;
            // A point within a number or a name ends nothing.
            let ends = |next: &&str| next.starts_with(' ');
            if sentences.get(index + 1).is_none_or(ends) {
                if has_number(&whole) {
                    figures.insert(whole.trim().to_owned());
                }
                whole.clear();
            }
        }
    }
    figures
}

#[test]
fn every_number_of_a_document_is_generated_or_on_the_list() {
    let found: BTreeSet<_> = documents()
        .iter()
        .flat_map(|(name, text)| {
            let figures = figures(text).into_iter();
            figures.map(move |sentence| format!("{name}: {sentence}"))
        })
        .collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(LIST);
    let text = fs::read_to_string(&path).expect("the list is there");
    let listed: BTreeSet<_> = text.lines().map(str::to_owned).collect();
    let mut wrong: Vec<_> = found
        .difference(&listed)
        .map(|new| format!("{new}\n  is a number by hand: generate it, or leave it out"))
        .collect();
    let kept: Vec<_> = listed.intersection(&found).cloned().collect();
    if std::env::var_os("UPDATE_NOTES").is_some_and(|value| value == "1") {
        fs::write(&path, kept.join("\n") + "\n").expect("the list can be written");
    } else {
        let gone = listed.difference(&found).map(|gone| {
            format!(
                "{LIST}: {gone}\n  is no more: UPDATE_NOTES=1 cargo test --release --test cli \
                 notes removes it"
            )
        });
        wrong.extend(gone);
    }
    expect_none(&wrong);
}

#[test]
fn numbers_by_hand_are_told_from_names_code_and_references() {
    let text = "\
# 1 heading
It has 3 bits. Its half has `4`, Verilog-2001 and K1, [x](6.md) and ¶0012–0014, 0020 and Fig. 7.
<!-- begin generated: x -->
| 8 |
<!-- end generated -->
| a | 9.5 |

| numeral | what |
| 12 | counter |

```text
10
```
claims 1 to 3 of JP3640909B2; -2.5 µm are left. No number
";
    let found: Vec<_> = figures(text).into_iter().collect();
    let expected = [
        "It has 3 bits.",
        "claims  of JP3640909B2; -2.5 µm are left.",
        "| a | 9.5 |",
    ];
    assert_eq!(found, expected);
}
