//! The page: one file with styles, scripts and data inside. Its program is within it, beside it, or
//! the one that serves it; without a program it shows one run.

mod command;
pub mod notes;
mod run;

pub use command::{Arguments, page};
pub use run::of_run;

use super::shipped::SHIPPED;
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use miniz_oxide::deflate::compress_to_vec_zlib;
use notes::Notes;
use serde::Serialize;
use std::fmt::Write as _;

const PAGE: &str = include_str!("page.html");

macro_rules! sources {
    ($($name:literal),* $(,)?) => {
        &[$(include_str!($name)),*]
    };
}

const STYLES: &[&str] = sources![
    "page.css",
    "form.css",
    "path.css",
    "waves.css",
    "circuit.css",
    "note.css"
];

/// Modules of the worker. Each stands after those that it imports.
const WORKER: &[&str] = sources!["files.js", "circuits.js", "wasi.js", "worker.js"];

/// Modules of the page, likewise.
const SCRIPTS: &[&str] = sources![
    "diagram.js",
    "dom.js",
    "circuit.js",
    "downloads.js",
    "column.js",
    "dump.js",
    "unpack.js",
    "fst_changes.js",
    "fst_hierarchy.js",
    "fst.js",
    "job.js",
    "law.js",
    "inlines.js",
    "notes.js",
    "markdown.js",
    "noteview.js",
    "notedialog.js",
    "series.js",
    "npy.js",
    "extremes.js",
    "layers.js",
    "palette.js",
    "quantities.js",
    "errorstrip.js",
    "linemask.js",
    "pathpicture.js",
    "pathviews.js",
    "pathscales.js",
    "reduction.js",
    "pathcanvas.js",
    "player.js",
    "path.js",
    "playhead.js",
    "problem.js",
    "runner.js",
    "savefile.js",
    "tomlvalue.js",
    "settingkeys.js",
    "settings.js",
    "start.js",
    "exactjson.js",
    "summaryparts.js",
    "summary.js",
    "tabs.js",
    "toml.js",
    "valueformat.js",
    "vcd.js",
    "rowmenu.js",
    "wavekeys.js",
    "wavebar.js",
    "waverows.js",
    "wavepaint.js",
    "waveview.js",
    "wavecanvas.js",
    "wavecursor.js",
    "wavenames.js",
    "wavetree.js",
    "waves.js",
    "app.js",
];

/// Greatest effort of the compression.
const BEST: u8 = 10;

/// The program that runs the jobs of the page.
#[derive(Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Program<'a> {
    /// WebAssembly in the page itself: base64 of a zlib stream.
    Within(String),
    /// WebAssembly at an address beside the page.
    Beside(&'a str),
    /// The program that serves the page, which takes jobs at this address.
    #[cfg(not(target_family = "wasm"))]
    Served(&'a str),
}

impl Program<'_> {
    /// WebAssembly in the page itself.
    pub fn within(wasm: &[u8]) -> Self {
        Program::Within(packed(wasm))
    }
}

/// Returns base64 of a zlib stream.
fn packed(bytes: &[u8]) -> String {
    BASE64_STANDARD.encode(compress_to_vec_zlib(bytes, BEST))
}

/// A finished run.
#[derive(Debug, Serialize)]
pub struct Run {
    /// Words of the command line.
    pub words: Vec<String>,
    /// Exit code.
    pub code: u8,
    /// Standard output: the summary as JSON.
    pub out: String,
    /// Standard error.
    pub errors: String,
    /// Names of the written files, and base64 of their contents.
    pub files: Vec<(String, String)>,
}

/// Data inside the page, with which it starts.
#[derive(Debug, Serialize)]
struct Start<'a> {
    program: Option<Program<'a>>,
    notes: Option<Notes>,
    scenarios: Vec<Scenario>,
    run: Option<Run>,
}

#[derive(Debug, Serialize)]
struct Scenario {
    file: &'static str,
    about: &'static str,
    text: &'static str,
}

/// Returns the page with a program, a run, or both.
pub fn with(program: Option<Program<'_>>, run: Option<Run>) -> String {
    let scenarios = SHIPPED.iter().map(|shipped| Scenario {
        file: shipped.file,
        about: shipped.about,
        text: shipped.text,
    });
    let start = Start {
        notes: program.as_ref().and_then(Notes::beside),
        program,
        scenarios: scenarios.collect(),
        run,
    };
    // A `<` in a text would end or begin an element.
    let start = serde_json::to_string(&start).map_or_else(
        |error| format!("{{\"error\": \"{error}\"}}"),
        |text| text.replace('<', "\\u003c"),
    );
    let mut page = String::with_capacity(PAGE.len() + start.len() + (1 << 18));
    let mut rest = PAGE;
    let parts: [(&str, String); 4] = [
        ("/* styles */", STYLES.concat()),
        ("/* start */", start),
        ("/* worker */", joined(WORKER)),
        ("/* page */", joined(SCRIPTS)),
    ];
    for (mark, text) in parts {
        if let Some((before, after)) = rest.split_once(mark) {
            page.push_str(before);
            page.push_str(&text);
            rest = after;
        }
    }
    page + rest
}

/// Joins modules into one script with one scope.
fn joined(modules: &[&str]) -> String {
    let mut script = String::new();
    for line in modules.iter().flat_map(|module| module.lines()) {
        if !line.starts_with("import ") {
            // Writing to a string does not fail.
            let _ = writeln!(script, "{}", line.strip_prefix("export ").unwrap_or(line));
        }
    }
    script
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [&[&str]; 2] = [WORKER, SCRIPTS];

    #[test]
    fn every_import_is_of_a_module_before() {
        for modules in ALL {
            let mut exported = Vec::new();
            for module in modules {
                for line in module.lines() {
                    if let Some(names) = line.strip_prefix("import { ") {
                        let (names, _) = names.split_once(" } from \"./").expect(line);
                        for name in names.split(", ") {
                            assert!(exported.contains(&name), "{name} in {line}");
                        }
                    }
                    assert!(!line.trim_end().ends_with("import {"), "an import in lines");
                }
                let names = module.lines().filter_map(|line| {
                    let rest = line.strip_prefix("export ")?;
                    let rest = rest.strip_prefix("async ").unwrap_or(rest);
                    let (_, name) = rest.split_once([' ', '*'])?;
                    name.trim_start()
                        .split(|c: char| !c.is_alphanumeric() && c != '_' && c != '$')
                        .next()
                });
                exported.extend(names);
            }
        }
    }

    #[test]
    fn no_name_of_the_outermost_scope_stands_twice() {
        for modules in ALL {
            let mut names = Vec::new();
            for line in joined(modules).lines() {
                let rest = line.strip_prefix("async ").unwrap_or(line);
                let kinds = ["const ", "let ", "function* ", "function ", "class "];
                let Some(rest) = kinds.iter().find_map(|kind| rest.strip_prefix(kind)) else {
                    continue;
                };
                let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_' && c != '$');
                let name = rest[..end.unwrap_or(rest.len())].to_owned();
                assert!(!names.contains(&name), "{name} stands twice");
                names.push(name);
            }
            assert!(names.len() > 10);
        }
    }

    #[test]
    fn texts_end_no_script() {
        let run = Run {
            words: vec!["run".to_owned(), "</script><b>".to_owned()],
            code: 0,
            out: String::new(),
            errors: String::new(),
            files: Vec::new(),
        };
        let page = with(None, Some(run));
        assert!(!page.contains("</script><b>") && page.contains("\\u003c/script>\\u003cb>"));
        assert_eq!(page.matches("</script>").count(), 3);
        assert!(!page.contains("/* page */") && !page.contains("\nimport "));
    }
}
