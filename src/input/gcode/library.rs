//! Texts that are executed: the program, and files with subroutines that it calls.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::flow::Index;
use super::problem::Problem;
use super::text;
use crate::input::{LARGEST_FILE, read_bytes};

/// Extensions of subroutine files; `.ngc` has precedence.
const ENDINGS: [&str; 6] = ["ngc", "nc", "gcode", "tap", "gc", "cnc"];

const ALLOWED: &str =
    "subroutines of the file itself, and of files in the directories of --subroutines";

/// Text with its O-words.
#[derive(Debug)]
pub(super) struct Source<'a> {
    /// Path; `None` for the program itself.
    pub(super) file: Option<String>,
    pub(super) text: Cow<'a, [u8]>,
    index: OnceCell<Index>,
}

impl<'a> Source<'a> {
    pub(super) fn program(text: &'a [u8]) -> Self {
        Self {
            file: None,
            text: Cow::Borrowed(text),
            index: OnceCell::new(),
        }
    }

    pub(super) fn is_program(&self) -> bool {
        self.file.is_none()
    }

    pub(super) fn index(&self) -> &Index {
        self.index.get_or_init(|| Index::of(&self.text))
    }

    /// Returns the O-words, if they were indexed.
    pub(super) fn known_index(&self) -> Option<&Index> {
        self.index.get()
    }
}

/// Directories of the subroutines, and the files that were read.
#[derive(Debug)]
pub(super) struct Library<'a> {
    directories: &'a [PathBuf],
    /// Files by label, including missing ones.
    files: HashMap<String, Option<Rc<Source<'a>>>>,
}

impl<'a> Library<'a> {
    pub(super) fn new(directories: &'a [PathBuf]) -> Self {
        Self {
            directories,
            files: HashMap::new(),
        }
    }

    /// Returns the file with the subroutine or program of a label, if there is one.
    ///
    /// # Errors
    ///
    /// Returns an error for a label that is not a plain name, directories or files that cannot be
    /// read, and ambiguous files.
    pub(super) fn find(
        &mut self,
        field: &str,
        label: &str,
    ) -> Result<Option<Rc<Source<'a>>>, Problem> {
        if self.directories.is_empty() {
            return Ok(None);
        }
        if let Some(known) = self.files.get(label) {
            return Ok(known.clone());
        }
        let found = self.look_for(field, label)?;
        self.files.insert(label.to_owned(), found.clone());
        Ok(found)
    }

    fn look_for(&self, field: &str, label: &str) -> Result<Option<Rc<Source<'a>>>, Problem> {
        let stems = stems(label).ok_or_else(|| {
            let problem = "no name of a file with a subroutine";
            Problem::new(field, problem, "letters, digits, _ and -, with . inside")
        })?;
        for directory in self.directories {
            if let Some(path) = in_directory(field, directory, &stems)? {
                return self.read(field, &path).map(Some);
            }
        }
        Ok(None)
    }

    fn read(&self, field: &str, path: &Path) -> Result<Rc<Source<'a>>, Problem> {
        let file = path.display().to_string();
        // A pipe would block until somebody writes into it.
        if !path.metadata().is_ok_and(|metadata| metadata.is_file()) {
            let problem = format!("calls {file}, which is not a regular file");
            return Err(Problem::new(field, problem, "a readable file"));
        }
        let bytes = read_bytes(path, LARGEST_FILE).map_err(|fault| {
            let problem = format!("calls {file}: {}", fault.problem);
            Problem::new(field, problem, fault.allowed)
        })?;
        Ok(Rc::new(Source {
            file: Some(file),
            text: Cow::Owned(text::trimmed(&bytes).to_vec()),
            index: OnceCell::new(),
        }))
    }
}

/// Returns the error of a call to a missing subroutine.
pub(super) fn not_there(field: &str, what: &str) -> Problem {
    let problem = format!("calls {what}, which is not in this file");
    Problem::new(field, problem, ALLOWED)
}

/// Returns the names, without extension and in lower case, that the file of a label may have: for
/// `<name>` that name, for 2 `2`, `o2` and `o0002`. Returns `None` if the label is not a plain
/// name.
fn stems(label: &str) -> Option<Vec<String>> {
    if label.bytes().all(|byte| byte.is_ascii_digit()) {
        return Some(vec![
            label.to_owned(),
            format!("o{label}"),
            format!("o{label:0>4}"),
        ]);
    }
    let name = label.strip_prefix('<')?.strip_suffix('>')?;
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-' | b'.');
    let whole = name.bytes().all(plain) && !name.starts_with('.') && !name.ends_with('.');
    whole.then(|| vec![name.to_owned()])
}

/// Returns the file of a directory that has one of the names, in either case. One that ends in
/// `.ngc` in lower case has precedence, as LinuxCNC uses it.
fn in_directory(
    field: &str,
    directory: &Path,
    stems: &[String],
) -> Result<Option<PathBuf>, Problem> {
    let unreadable = |error: std::io::Error| {
        let problem = format!(
            "the directory {} cannot be read: {error}",
            directory.display()
        );
        Problem::new(field, problem, "readable directories of subroutines")
    };
    let mut found: Vec<String> = Vec::new();
    for entry in directory.read_dir().map_err(unreadable)? {
        let name = entry.map_err(unreadable)?.file_name();
        let Some(name) = name.to_str() else {
            continue;
        };
        let lower = name.to_ascii_lowercase();
        let Some((stem, ending)) = lower.rsplit_once('.') else {
            continue;
        };
        if ENDINGS.contains(&ending) && stems.iter().any(|of| of == stem) {
            found.push(name.to_owned());
        }
    }
    found.sort_unstable();
    let first = stems.first().map(|stem| format!("{stem}.ngc"));
    if let Some(exact) = found.iter().find(|name| Some(*name) == first.as_ref()) {
        return Ok(Some(directory.join(exact)));
    }
    match found.as_slice() {
        [] => Ok(None),
        [one] => Ok(Some(directory.join(one))),
        [one, other, ..] => {
            let place = directory.display();
            let problem = format!("may be {one} or {other} in {place}");
            Err(Problem::new(field, problem, "one file for each name"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_nowhere_else() {
        for label in [
            "<../a>", "<a/b>", "<a\\b>", "<.a>", "<a.>", "<..>", "<~a>", "<a$b>", "<a*>", "<>", "a",
        ] {
            assert_eq!(stems(label).filter(|_| label != "<>"), None, "{label}");
        }
        assert_eq!(stems("<a-1.b_c>"), Some(vec!["a-1.b_c".to_owned()]));
        assert_eq!(stems("17").unwrap(), ["17", "o17", "o0017"]);
        assert_eq!(stems("12345").unwrap()[2], "o12345");
    }
}
