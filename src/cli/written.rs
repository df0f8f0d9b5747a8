//! The list of files that runs have made in a directory, by which `clean` knows them.

use motion_rtl::files::{self, Claim, open};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs::{self, Metadata, OpenOptions};
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

/// Most bytes of a list that are read.
const LARGEST: u64 = 16 << 20;

/// Name of the list.
const LIST: &str = ".motion-rtl-written";

/// Stem of the claim on the list: no job is called so.
const CLAIM: &str = ".written";

/// Size in bytes, and time of the last change in ns since 1970.
type State = (u64, u128);

/// Files of a directory: those that runs made, as they left them, and the others.
#[derive(Debug)]
pub struct Written {
    directory: PathBuf,
    files: BTreeMap<String, State>,
    /// Names that are taken by anything but files of runs.
    others: BTreeSet<String>,
}

impl Written {
    /// Reads the list of a directory, and which other files there are.
    pub fn read(directory: &Path) -> Self {
        let files = read_list(directory);
        let entries = fs::read_dir(directory).into_iter().flatten().flatten();
        let others = entries.filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
            (!is_file || !files.contains_key(&name)).then_some(name)
        });
        Written {
            directory: directory.to_owned(),
            others: others.collect(),
            files,
        }
    }

    /// Returns true if a run made the file, and nobody has changed it since.
    pub fn is_unchanged(&self, path: &Path) -> bool {
        let left = name(path).and_then(|name| self.files.get(name));
        let there = path.symlink_metadata();
        there.is_ok_and(|there| there.is_file() && left == Some(&state(&there)))
    }

    /// Lists the files of a run, except those whose names others had when this was read. If the
    /// list cannot be written, `clean` does not know them.
    pub fn add<'a>(&self, paths: impl Iterator<Item = &'a Path>) {
        let list = self.list();
        // A link, a pipe or a directory of that name stays as it is.
        let is_other = list.symlink_metadata().is_ok_and(|there| !there.is_file());
        // Another run may add its own meanwhile.
        let Ok(_turn) = Claim::wait(&self.directory, CLAIM) else {
            return;
        };
        let mut files = read_list(&self.directory);
        files.retain(|name, _| self.directory.join(name).is_file());
        for path in paths {
            let (Some(name), Ok(there)) = (name(path), path.symlink_metadata()) else {
                continue;
            };
            // A name with a line break could be read as two.
            if !name.contains(['\n', '\r']) && !self.others.contains(name) {
                files.insert(name.to_owned(), state(&there));
            }
        }
        if is_other || files.is_empty() {
            return;
        }
        let mut text = String::new();
        for (name, (size, changed)) in files {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{size} {changed} {name}");
        }
        let _ = files::write(list, text);
    }

    /// Returns the files that are unchanged since their run, and those that have changed.
    pub fn split(&self) -> (Vec<PathBuf>, Vec<PathBuf>) {
        let there = self.files.iter().filter_map(|(name, left)| {
            let path = self.directory.join(name);
            let metadata = path.symlink_metadata().ok()?;
            let same = metadata.is_file() && state(&metadata) == *left;
            Some((path, same))
        });
        let (same, changed): (Vec<_>, Vec<_>) = there.partition(|(_, same)| *same);
        let paths = |files: Vec<(PathBuf, bool)>| files.into_iter().map(|(path, _)| path);
        (paths(same).collect(), paths(changed).collect())
    }

    /// Returns the directory.
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// Returns the path of the list.
    pub fn list(&self) -> PathBuf {
        self.directory.join(LIST)
    }
}

/// Reads the list of a directory; it is empty where there is none. Only names of files in the
/// directory itself count: the list may come from anywhere.
fn read_list(directory: &Path) -> BTreeMap<String, State> {
    let mut text = String::new();
    // A link, a pipe or a directory of that name is no list.
    let opened = open(OpenOptions::new().read(true), &directory.join(LIST));
    let _ = opened.and_then(|file| file.take(LARGEST).read_to_string(&mut text));
    let lines = text.lines().filter_map(|line| {
        let mut words = line.splitn(3, ' ');
        let (size, changed) = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
        let name = words.next().filter(|name| is_plain(name))?;
        Some((name.to_owned(), (size, changed)))
    });
    lines.collect()
}

/// True if this is the name of a file in the directory itself.
fn is_plain(name: &str) -> bool {
    Path::new(name).file_name() == Some(name.as_ref())
}

fn name(path: &Path) -> Option<&str> {
    path.file_name()?.to_str()
}

fn state(metadata: &Metadata) -> State {
    let changed = metadata.modified().ok();
    let since = changed.and_then(|time| time.duration_since(UNIX_EPOCH).ok());
    (metadata.len(), since.map_or(0, |time| time.as_nanos()))
}
