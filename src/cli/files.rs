//! The files of a run: they get their names together, when all of them are complete.

use super::export::Export;
use super::written::Written;
use super::{Failure, warn};
use motion_rtl::files::{self, AtomicFile, Claim, Directory, commit_all};
use motion_rtl::input::MORE_FILES;
use motion_rtl::trace::surfer::{FOLDER, Mapping};
use serde::Serialize;
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fmt;
use std::fs;
use std::io;
use std::mem;
use std::path::{Path, PathBuf};

/// Stem of the claim on all exports of a directory: no circuit is called so.
const ALL: &str = ".v";

/// Files that are complete but not yet named; dropped, they leave nothing.
#[derive(Debug)]
pub struct Files {
    stem: PathBuf,
    complete: Vec<AtomicFile>,
    exports: Vec<Export>,
    notes: Vec<String>,
    /// Another run into these files is refused.
    _claim: Option<Claim>,
    // Last, as they can go only when the files are gone.
    directories: Vec<Directory>,
}

/// A file that a command has written.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Named {
    /// Path of the file, as the command was given it.
    pub path: String,
    /// Size of the file.
    bytes: u64,
}

impl Named {
    pub fn new(path: &Path) -> Self {
        Named {
            path: path.display().to_string(),
            bytes: path.metadata().map_or(0, |there| there.len()),
        }
    }
}

/// Writes the path in one line, with the size.
impl fmt::Display for Named {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.replace('\n', "\\n");
        write!(f, "{path} ({})", size(self.bytes))
    }
}

/// Returns a size for people, in decimal units.
pub fn size(bytes: u64) -> String {
    let units = [("GB", 1e9), ("MB", 1e6), ("kB", 1e3)];
    let unit = units.iter().find(|(_, unit)| bytes as f64 >= 0.9995 * unit);
    match unit {
        None => format!("{bytes} B"),
        Some((name, unit)) => {
            let value = bytes as f64 / unit;
            let digits = match value {
                ..9.995 => 2,
                ..99.95 => 1,
                _ => 0,
            };
            format!("{value:.digits$} {name}")
        }
    }
}

/// A file that an option names, when it is refused.
const A_FILE: &str = "a file that can be written";

fn refuse(error: &io::Error) -> Failure {
    refused("--out", error, "a directory that can be written")
}

/// Refusal of a file that `field` names.
pub fn refuse_file(field: &'static str, error: &io::Error) -> Failure {
    refused(field, error, A_FILE)
}

/// Refusal of an option, whose value should be what is `allowed`.
pub fn refused(field: &'static str, error: &io::Error, allowed: &str) -> Failure {
    let allowed = match files::too_many_open(error) {
        true => MORE_FILES,
        false => allowed,
    };
    Failure::Argument {
        field,
        problem: error.to_string(),
        allowed: allowed.into(),
    }
}

/// Removes what runs have left in a directory that something ended at once, and says so.
pub fn clear(directory: &Path) {
    let removed = files::clear(directory);
    let names = removed.iter().map(|path| path.display().to_string());
    let names: Vec<_> = names.collect();
    if !names.is_empty() {
        let names = names.join(", ");
        warn(&format!(
            "removed what a run that did not end by itself has left: {names}"
        ));
    }
}

/// Returns the directory of a file.
pub fn parent(path: &Path) -> &Path {
    let parent = path.parent();
    let parent = parent.filter(|parent| !parent.as_os_str().is_empty());
    parent.unwrap_or(Path::new("."))
}

/// Refuses an output that would replace an input; `field` is the option that names the output, and
/// `allowed` what it may name instead.
pub fn spare<'p>(
    field: &'static str,
    output: &Path,
    inputs: impl IntoIterator<Item = &'p Path>,
    allowed: &str,
) -> Result<(), Failure> {
    let Ok(output) = output.canonicalize() else {
        // The file does not exist yet.
        return Ok(());
    };
    let mut inputs = inputs.into_iter().flat_map(Path::canonicalize);
    match inputs.any(|input| input == output) {
        true => Err(Failure::Argument {
            field,
            problem: format!("{} is the input", output.display()),
            allowed: allowed.into(),
        }),
        false => Ok(()),
    }
}

impl Files {
    /// Files called `stem` in `directory`.
    pub fn begin(directory: &Path, stem: &str) -> Result<Self, Failure> {
        let created = Directory::create(directory).map_err(|error| refuse(&error))?;
        let claim = Claim::new(directory, stem).map_err(|error| Failure::Argument {
            field: "--out",
            problem: error.to_string(),
            allowed: match error.kind() {
                io::ErrorKind::InvalidInput => "another directory, or to remove it",
                _ => "another directory, or to wait until that run is over",
            }
            .into(),
        })?;
        clear(directory);
        Ok(Files {
            stem: directory.join(stem),
            complete: Vec::new(),
            exports: Vec::new(),
            notes: Vec::new(),
            _claim: claim,
            directories: vec![created],
        })
    }

    /// Begins the one with this extension.
    pub fn create(&self, extension: &str) -> Result<AtomicFile, Failure> {
        let mut path = OsString::from(&self.stem);
        path.push(".");
        path.push(extension);
        AtomicFile::create(path).map_err(|error| refuse(&error))
    }

    /// Begins one with a name of its own.
    pub fn create_as(&self, name: &str) -> Result<AtomicFile, Failure> {
        AtomicFile::create(self.stem.with_file_name(name)).map_err(|error| refuse(&error))
    }

    /// Begins one at a path of its own, which the option `field` names.
    pub fn create_at(&mut self, field: &'static str, path: &Path) -> Result<AtomicFile, Failure> {
        let refuse = |error| refuse_file(field, &error);
        let directory = Directory::create(parent(path)).map_err(refuse)?;
        self.directories.push(directory);
        AtomicFile::create(path).map_err(refuse)
    }

    /// Takes one that is complete.
    pub fn push(&mut self, file: AtomicFile) {
        self.complete.push(file);
    }

    /// Writes a whole one.
    pub fn write(&mut self, extension: &str, text: &str) -> Result<(), Failure> {
        let file = self.create(extension)?;
        self.fill(file, text)
    }

    /// Writes a whole one with a name of its own.
    pub fn write_as(&mut self, name: &str, text: &str) -> Result<(), Failure> {
        let file = self.create_as(name)?;
        self.fill(file, text)
    }

    /// Writes the save file of the waves. A file of its name that no run wrote, or that was changed
    /// since, stays if it has another text: somebody arranged these signals. The save file then
    /// gets a number.
    pub fn write_save(&mut self, text: &str) -> Result<(), Failure> {
        let list = Written::read(self.directory());
        let stem = self.stem.file_name().unwrap_or_default();
        let stem = stem.to_string_lossy().into_owned();
        let mut taken = Vec::new();
        loop {
            let name = match taken.len() {
                0 => format!("{stem}.gtkw"),
                count => format!("{stem}.{}.gtkw", count + 1),
            };
            // A save file has its own name.
            let text = text.replacen(&format!("\"{stem}.gtkw\""), &format!("\"{name}\""), 1);
            let path = self.stem.with_file_name(&name);
            let is_free = !path.is_file() || list.is_unchanged(&path);
            if !is_free && fs::read(&path).ok().as_deref() != Some(text.as_bytes()) {
                taken.push(path.display().to_string());
                continue;
            }
            if !taken.is_empty() {
                self.notes.push(format!(
                    "{} stays, as no run wrote it or it was changed since: the save file of this \
                     run is {}",
                    taken.join(", "),
                    path.display()
                ));
            }
            return self.write_as(&name, &text);
        }
    }

    /// Writes mapping files for Surfer, in the folder of the directory where it finds them.
    pub fn write_mappings(&mut self, mappings: &[Mapping]) -> Result<(), Failure> {
        let folder = self.directory().join(FOLDER);
        for Mapping { file, text } in mappings {
            let file = self.create_at("--surfer", &folder.join(file))?;
            self.fill(file, text)?;
        }
        Ok(())
    }

    /// Takes the remarks on the files.
    pub fn take_notes(&mut self) -> Vec<String> {
        mem::take(&mut self.notes)
    }

    fn fill(&mut self, mut file: AtomicFile, text: &str) -> Result<(), Failure> {
        io::Write::write_all(&mut file, text.as_bytes())?;
        self.push(file);
        Ok(())
    }

    /// Writes a circuit's Verilog, unless files of others are in its way.
    pub fn export(&mut self, export: Export) -> Result<(), Failure> {
        export.check(self.directory())?;
        for source in export.files() {
            self.write_as(&source.name, &source.text)?;
        }
        self.exports.push(export);
        Ok(())
    }

    fn directory(&self) -> &Path {
        parent(&self.stem)
    }

    /// Gives all files their final names; returns names and sizes. If one fails, none remains.
    pub fn commit(self) -> Result<Vec<Named>, Failure> {
        // One run at a time, so that what is checked is what is replaced.
        let _turn = match self.exports.is_empty() {
            true => None,
            false => Claim::wait(self.directory(), ALL)?,
        };
        for export in &self.exports {
            export.check(self.directory())?;
        }
        // Each directory has a list of its own files.
        let paths = self.complete.iter().map(|file| file.path().to_owned());
        let paths: Vec<_> = paths.collect();
        let directories: BTreeSet<_> = paths.iter().map(|path| parent(path)).collect();
        let lists: Vec<_> = directories.into_iter().map(Written::read).collect();
        let named = commit_all(self.complete)?;
        for list in lists {
            let paths = paths.iter().map(PathBuf::as_path);
            list.add(paths.filter(|path| parent(path) == list.directory()));
        }
        Ok(named.iter().map(|path| Named::new(path)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_three_digits() {
        let sizes = [
            0,
            999,
            1000,
            12_345,
            99_949,
            999_949,
            1_000_000,
            2_345_678_901,
        ];
        let texts = [
            "0 B", "999 B", "1.00 kB", "12.3 kB", "99.9 kB", "1.00 MB", "1.00 MB", "2.35 GB",
        ];
        assert_eq!(sizes.map(size), texts);
    }

    #[test]
    fn where_one_cannot_be_named_none_is_there() {
        let directory = tempfile::tempdir().unwrap();
        let mut files = Files::begin(directory.path(), "a").unwrap();
        files.write("one", "1").unwrap();
        files.write_as("two", "2").unwrap();
        // In the way only after the file was begun.
        std::fs::create_dir_all(directory.path().join("two/inside")).unwrap();
        files.commit().unwrap_err();
        let left = std::fs::read_dir(directory.path()).unwrap();
        let left: Vec<_> = left.map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(left, ["two"]);
    }
}
