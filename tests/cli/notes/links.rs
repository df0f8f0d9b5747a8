//! Links of the documents and paths in the source: each leads to a file, and to a heading of it.

use super::{expect_none, notes};
use std::collections::HashMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// A page of this many lines is read as a whole.
const MOST_LINES: usize = 600;

/// The lines of a document outside its blocks of code, with their numbers.
pub fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut fence = 0;
    text.lines().zip(1..).filter_map(move |(line, number)| {
        let marks = line.len() - line.trim_start_matches('`').len();
        let inside = fence > 0;
        if marks >= 3 && !inside {
            fence = marks;
        } else if inside && marks >= fence && marks == line.len() {
            fence = 0;
        }
        (!inside && marks < 3).then_some((number, line))
    })
}

/// The anchor of a heading, as GitHub makes it.
fn slug(heading: &str) -> String {
    heading
        .to_lowercase()
        .replace(' ', "-")
        .chars()
        .filter(|letter| letter.is_alphanumeric() || "-_".contains(*letter))
        .collect()
}

/// The anchors of a document; a heading that comes again has a number.
fn anchors(text: &str) -> Vec<String> {
    let mut seen: HashMap<String, usize> = HashMap::new();
    let headings = prose(text).filter(|(_, line)| line.starts_with('#'));
    let anchor = |(_, line): (usize, &str)| {
        let anchor = slug(line.trim_start_matches('#').trim());
        let times = seen.entry(anchor.clone()).or_default();
        *times += 1;
        match *times {
            1 => anchor,
            more => format!("{anchor}-{}", more - 1),
        }
    };
    headings.map(anchor).collect()
}

/// The targets of the links in a line, code left out.
fn targets(line: &str) -> Vec<&str> {
    // An odd number of backticks before it: within code.
    let code = |at: usize| !line[..at].matches('`').count().is_multiple_of(2);
    let links = line.match_indices("](").filter(|(at, _)| !code(*at));
    let target = |(at, _): (usize, &str)| line[at + 2..].split(')').next();
    links.filter_map(target).collect()
}

/// A path without its `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

/// The documents at the root and the notes, by path.
pub fn documents() -> Vec<(String, String)> {
    let own = ["README.md", "CHANGELOG.md"].iter().filter_map(|name| {
        let text = fs::read_to_string(Path::new(ROOT).join(name)).ok()?;
        Some(((*name).to_owned(), text))
    });
    let notes = notes().into_iter().map(|note| (note.name, note.text));
    own.chain(notes).collect()
}

/// What is wrong with a link in a document, if anything.
fn fault(documents: &HashMap<String, Vec<String>>, from: &str, target: &str) -> Option<String> {
    if target.starts_with("https://") {
        return None;
    }
    let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
    let path = match file {
        "" => PathBuf::from(from),
        _ => plain(&Path::new(from).parent().unwrap_or(Path::new("")).join(file)),
    };
    let name = path.display().to_string();
    if !documents.contains_key(&name) && !Path::new(ROOT).join(&path).exists() {
        return Some(format!("no file {name}"));
    }
    let found = |all: &Vec<String>| all.iter().any(|known| known == anchor);
    let known = anchor.is_empty() || documents.get(&name).is_some_and(found);
    (!known).then(|| format!("{name} has no heading #{anchor}"))
}

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let documents = documents();
    let anchors: HashMap<_, _> = documents
        .iter()
        .map(|(name, text)| (name.clone(), anchors(text)))
        .collect();
    let mut wrong = Vec::new();
    let mut links = 0;
    for (name, text) in &documents {
        for (number, line) in prose(text) {
            for target in targets(line) {
                links += 1;
                let fault = fault(&anchors, name, target);
                wrong.extend(fault.map(|fault| format!("{name}:{number}: {target}: {fault}")));
            }
        }
    }
    expect_none(&wrong);
    assert!(links > 400, "{links} links");
}

#[test]
fn a_link_that_leads_nowhere_is_found() {
    let text = "# A b: `c` (d)\n```sh\n# no heading\n```\n## X\n### X\n";
    let known = HashMap::from([("a/b.md".to_owned(), anchors(text))]);
    assert_eq!(known["a/b.md"], ["a-b-c-d", "x", "x-1"]);
    assert_eq!(fault(&known, "a/b.md", "#x-1"), None);
    assert_eq!(fault(&known, "a/b.md", "../README.md"), None);
    assert_eq!(
        fault(&known, "a/b.md", "#no-heading"),
        Some("a/b.md has no heading #no-heading".to_owned())
    );
    assert_eq!(
        fault(&known, "a/b.md", "README.md"),
        Some("no file a/README.md".to_owned())
    );
    assert_eq!(targets("a `[x](y)` [x](z) ![p](q.png)"), ["z", "q.png"]);
}

/// Whatever in the source begins with `rtl_notes/` is there.
#[test]
fn every_path_of_a_note_in_the_source_is_there() {
    let mut folders: Vec<_> = ["src", "tests", "benches", ".ci", "fuzz/fuzz_targets"]
        .iter()
        .map(|folder| Path::new(ROOT).join(folder))
        .filter(|folder| folder.exists())
        .collect();
    let mut files = vec![Path::new(ROOT).join("Cargo.toml")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => folders.push(path),
                false => files.push(path),
            }
        }
    }
    let mut wrong = Vec::new();
    let mut paths = 0;
    for file in files {
        let Ok(text) = fs::read_to_string(&file) else {
            continue;
        };
        for part in text.split("rtl_notes/").skip(1) {
            let letter = |letter: char| letter.is_ascii_alphanumeric() || "_./".contains(letter);
            let path = part
                .split(|other| !letter(other))
                .next()
                .unwrap_or_default();
            let path = path.trim_end_matches('.');
            // A path that a program puts together, or that a test makes for itself.
            if path.is_empty() || part[path.len()..].starts_with('{') || path == "blocks/note.md" {
                continue;
            }
            paths += 1;
            if !Path::new(ROOT).join("rtl_notes").join(path).exists() {
                wrong.push(format!("{}: no rtl_notes/{path}", file.display()));
            }
        }
    }
    expect_none(&wrong);
    assert!(paths > 60, "{paths} paths");
}

/// A reader finds every page from the contents of its folder.
#[test]
fn every_page_is_in_the_contents_of_its_folder() {
    let documents: HashMap<_, _> = documents().into_iter().collect();
    let mut wrong = Vec::new();
    for name in documents
        .keys()
        .filter(|name| name.starts_with("rtl_notes/"))
    {
        let folder = match name.strip_suffix("/README.md") {
            Some(folder) => Path::new(folder).parent(),
            None => Path::new(name).parent(),
        };
        let contents = folder.unwrap_or(Path::new("")).join("README.md");
        let contents = contents.display().to_string();
        let from = Path::new(&contents).parent().unwrap_or(Path::new(""));
        let lines = prose(&documents[&contents]);
        let mut links = lines.flat_map(|(_, line)| targets(line));
        let leads = |target: &str| {
            let file = target.split('#').next().unwrap_or_default();
            plain(&from.join(file)) == Path::new(name)
        };
        if !links.any(leads) {
            wrong.push(format!("{contents}: no link to {name}"));
        }
    }
    wrong.sort();
    expect_none(&wrong);
}

#[test]
fn no_page_is_too_long() {
    let long = documents().into_iter().filter_map(|(name, text)| {
        let lines = text.lines().count();
        (lines > MOST_LINES).then(|| format!("{name}: {lines} lines; at most {MOST_LINES}"))
    });
    expect_none(&long.collect::<Vec<_>>());
}
