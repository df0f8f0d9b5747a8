//! Subroutines in files of their own.

use std::fs;
use std::path::Path;

use motion_rtl::input::gcode::read_with;
use motion_rtl::input::{Drawing, Fault, Options};
use tempfile::TempDir;

use crate::input::common::{moves, warnings};

/// Directories with files.
struct Shelf {
    directory: TempDir,
}

impl Shelf {
    fn with(files: &[(&str, &str)]) -> Self {
        let directory = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = directory.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        Self { directory }
    }

    fn path(&self) -> &Path {
        self.directory.path()
    }

    fn read(&self, text: &str) -> Result<Drawing, Fault> {
        let options = Options {
            subroutines: ["a", "b"].map(|name| self.path().join(name)).to_vec(),
            ..Options::default()
        };
        read_with("t", text.as_bytes(), &options)
    }

    /// The X coordinates that a program goes to.
    fn ends(&self, text: &str) -> Vec<f64> {
        let drawing = self.read(text);
        let drawing = drawing.unwrap_or_else(|fault| panic!("{text:?}: {fault}"));
        drawing.moves.iter().map(|step| step.to[0]).collect()
    }

    fn refuse(&self, text: &str) -> String {
        let refused = self.read(text).map(|drawing| moves(&drawing)).unwrap_err();
        let place = self.path().display().to_string();
        refused.to_string().replace(&place, "SHELF")
    }
}

/// A subroutine that goes one on.
fn one(name: &str) -> String {
    format!("o<{name}> sub\nG91 G0 X1\no<{name}> endsub\nM2\n")
}

#[test]
fn a_subroutine_is_found_by_its_name() {
    let shelf = Shelf::with(&[
        (
            "a/go.ngc",
            "(far)\no<go> sub\nG0 X[#1*2]\no<go> endsub [7]\n%\n",
        ),
        ("b/go.ngc", "o<go> sub\nG0 X99\no<go> endsub\n"),
        ("b/17.ngc", "o17 sub\nG0 X17\no17 endsub\n"),
        ("b/Over-x.1.NC", &one("over-x.1")),
        (
            "b/deep.ngc",
            "o<deep> sub\no<go> call [#1]\nG0 X50\no<deep> endsub\n",
        ),
    ]);
    // The first directory that has it; arguments and values as of any subroutine.
    assert_eq!(shelf.ends("o<Go> call [3]\nG0 X#<_value>"), [6.0, 7.0]);
    assert_eq!(shelf.ends("o17 call\no017 call\nG0 X1"), [17.0, 1.0]);
    assert_eq!(shelf.ends("#1=17\no#1 call"), [17.0]);
    // A name in letters of another case, and one file that calls the other.
    assert_eq!(shelf.ends("o<over-X.1> call\no<OVER-x.1> call"), [1.0, 2.0]);
    assert_eq!(
        shelf.ends("o<deep> call [2]\no<deep> call [4]"),
        [4.0, 50.0, 8.0, 50.0]
    );
    // A loop of the caller goes on behind the call.
    let looped = "o1 repeat [2]\no<over-x.1> call\no1 endrepeat\nG0 X5";
    assert_eq!(shelf.ends(looped), [1.0, 2.0, 7.0]);
    // The file's own goes before that of another, and the file keeps its labels to itself.
    let own = "o<go> sub\nG0 X1\no<go> endsub\no<go> call";
    assert_eq!(shelf.ends(own), [1.0]);
    // A subroutine of the program is at hand in the file.
    let given = "o<17th> sub\nG0 X3\no<17th> endsub\n";
    let back = Shelf::with(&[
        ("a/back.ngc", "o<back> sub\no<17th> call\no<back> endsub"),
        ("b/x", ""),
    ]);
    assert_eq!(back.ends(&format!("{given}o<back> call")), [3.0]);
}

#[test]
fn a_program_is_found_by_its_number() {
    let shelf = Shelf::with(&[
        ("a/2.ngc", "%\nO2\nG91 G0 X1\nM99\n%\n"),
        ("a/O0003.nc", "%\n:0003 (a)\nG91 G0 X3\nM98 P2\nM99\n%\n"),
        ("b/O4.TAP", "O0004\nG91 G0 X4\nM99\n"),
    ]);
    assert_eq!(shelf.ends("M98 P2 L2\nM98 P0003"), [1.0, 2.0, 5.0, 6.0]);
    assert_eq!(shelf.ends("M98 P30002\nM98 P4"), [1.0, 2.0, 3.0, 7.0]);
}

#[test]
fn moves_and_warnings_say_where_they_are_from() {
    let shelf = Shelf::with(&[
        (
            "a/mill.ngc",
            "\n\no<mill> sub\nT1\nG1 X#1\nM8\no<mill> endsub\n",
        ),
        ("b/x", ""),
    ]);
    let drawing = shelf
        .read("G0 X1\nM8\n\no<mill> call [4]\nG0 X5 T2")
        .unwrap();
    let lines: Vec<usize> = drawing.moves.iter().map(|step| step.line).collect();
    assert_eq!(lines, [1, 4, 5]);
    let place = shelf.path().display().to_string();
    let said: Vec<String> = warnings(&drawing)
        .iter()
        .map(|text| text.replace(&place, "SHELF"))
        .collect();
    assert_eq!(
        said,
        [
            "t:2: M8: skipped (2 times)",
            "SHELF/a/mill.ngc:4: T: skipped (2 times)",
            "SHELF/a/mill.ngc:5: no feed set; the feed of the settings applies",
        ]
    );
}

#[test]
fn what_is_wrong_with_a_file_is_named() {
    let shelf = Shelf::with(&[
        ("a/other.ngc", &one("another")),
        ("a/open.ngc", "o<open> sub\nG0 X1\n"),
        ("a/5.ngc", "%\nO5\nG0 X1\n%\n"),
        ("a/twice.nc", &one("twice")),
        ("a/Twice.tap", &one("twice")),
        ("a/bad.ngc", "o<bad> sub\nG0 X1\nG0 Q1\no<bad> endsub"),
        ("a/self.ngc", "o<self> sub\no<self> call\no<self> endsub"),
        ("a/6.ngc", "G0 X1\nM99"),
        ("a/7.ngc/x", ""),
        ("a/note.txt", &one("note")),
        ("a/late.ngc", &one("late")),
        ("secret.ngc", &one("secret")),
        ("a/..secret.ngc", &one(".secret")),
        ("b/x", ""),
    ]);
    for (text, fault) in [
        (
            "o<none> call",
            "t:1: O<none> CALL: calls a subroutine, which is not in this file; allowed: subroutines \
             of the file itself, and of files in the directories of --subroutines",
        ),
        (
            "o<note> call",
            "t:1: O<note> CALL: calls a subroutine, which",
        ),
        (
            "o<other> call",
            "t:1: O<other> CALL: calls SHELF/a/other.ngc, which has no O<other> SUB; allowed: a file",
        ),
        (
            "o<open> call",
            "t:1: O<open> CALL: calls SHELF/a/open.ngc, whose O<open> SUB has no ENDSUB",
        ),
        (
            "M98 P5",
            "SHELF/a/5.ngc:4: file: ends inside a call; allowed: ENDSUB, RETURN or M99",
        ),
        (
            "M98 P6",
            "t:1: M98: calls SHELF/a/6.ngc, which has no line O6",
        ),
        (
            "o7 call",
            "t:1: O7 CALL: calls SHELF/a/7.ngc, which is not a regular file",
        ),
        (
            "o<twice> call",
            "t:1: O<twice> CALL: may be Twice.tap or twice.nc in SHELF/a; allowed: one file",
        ),
        (
            "o<bad> call",
            "SHELF/a/bad.ngc:3: Q: without a word that it belongs to",
        ),
        (
            "o<self> call",
            "SHELF/a/self.ngc:2: call: calls nest deeper than 10",
        ),
        (
            "o<late> call\nM2\no<late> sub\nG0 X1\no<late> endsub",
            "t:1: O<late> CALL: may be the one behind it, or that of SHELF/a/late.ngc",
        ),
        (
            "o<../secret> call",
            "t:1: O<../secret> CALL: no name of a file with a subroutine",
        ),
        ("o<.secret> call", "t:1: O<.secret> CALL: no name of a file"),
        (
            "o<..secret> call",
            "t:1: O<..secret> CALL: no name of a file",
        ),
        ("o</tmp/x> call", "t:1: O</tmp/x> CALL: no name of a file"),
        ("o<a\\b> call", "t:1: O<a\\b> CALL: no name of a file"),
        (
            "M98 P9",
            "t:1: M98: calls program O9, which is not in this file",
        ),
        (
            "M98 P1.5",
            "t:1: M98: calls program O1.5, which is not in this file",
        ),
    ] {
        let refused = shelf.refuse(text);
        assert!(refused.starts_with(fault), "{text:?}: {refused}");
    }
    fs::remove_dir_all(shelf.path().join("b")).unwrap();
    let gone = shelf.refuse("o<none> call");
    assert!(
        gone.starts_with("t:1: O<none> CALL: the directory SHELF/b cannot be read: "),
        "{gone}"
    );
}

#[cfg(unix)]
#[test]
fn a_pipe_is_no_file_of_subroutines() {
    let shelf = Shelf::with(&[("a/x", ""), ("b/x", "")]);
    let pipe = shelf.path().join("a/wait.ngc");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    let refused = shelf.refuse("o<wait> call");
    assert!(
        refused.contains("wait.ngc, which is not a regular file"),
        "{refused}"
    );
}
