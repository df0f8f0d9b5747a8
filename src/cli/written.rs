//! The list of files that runs have made in a directory, by which `clean` knows them.

use motion_rtl::files::open;
use std::collections::BTreeMap;
use std::fs::{Metadata, OpenOptions};
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

/// Most bytes of a list that are read.
const LARGEST: u64 = 16 << 20;

/// Name of the list.
const LIST: &str = ".motion-rtl-written";

/// Size in bytes, and time of the last change in ns since 1970.
type State = (u64, u128);

/// Files that a run made in a directory, by name, as the run left them.
#[derive(Debug)]
pub struct Written {
    directory: PathBuf,
    files: BTreeMap<String, State>,
}

impl Written {
    /// Reads the list of a directory; it is empty where there is none. Only names of files in the
    /// directory itself count: the list may come from anywhere.
    pub fn read(directory: &Path) -> Self {
        let mut text = String::new();
        // A link, a pipe or a directory of that name is no list.
        let opened = open(OpenOptions::new().read(true), &directory.join(LIST));
        let _ = opened.and_then(|file| file.take(LARGEST).read_to_string(&mut text));
        // A later line of a name replaces an earlier one.
        let lines = text.lines().filter_map(|line| {
            let mut words = line.splitn(3, ' ');
            let mut number = || words.next()?.parse().ok();
            let (size, changed) = (number()?, number()?);
            let name = words.next().filter(|name| is_plain(name))?;
            Some((name.to_owned(), (size as u64, changed)))
        });
        Written {
            directory: directory.to_owned(),
            files: lines.collect(),
        }
    }

    /// Returns the paths in the directory that no other file occupies.
    pub fn free<'a>(&self, paths: impl Iterator<Item = &'a Path>) -> Vec<PathBuf> {
        let ours = |path: &&Path| match path.symlink_metadata() {
            Err(_) => true,
            Ok(there) => there.is_file() && name(path).is_some_and(|name| self.has(name)),
        };
        paths.filter(ours).map(Path::to_owned).collect()
    }

    fn has(&self, name: &str) -> bool {
        self.files.contains_key(name)
    }

    /// Adds the files of a run. If the list cannot be written, `clean` does not know them.
    pub fn add(&self, paths: &[PathBuf]) {
        let mut lines = String::new();
        for path in paths {
            let (Some(name), Ok(there)) = (name(path), path.symlink_metadata()) else {
                continue;
            };
            // A name with a line break could be read as two.
            if !name.contains(['\n', '\r']) {
                let (size, changed) = state(&there);
                lines += &format!("{size} {changed} {name}\n");
            }
        }
        let list = self.directory.join(LIST);
        let opened = open(OpenOptions::new().append(true).create(true), &list);
        // One write, as another run may add its own meanwhile.
        let _ = opened.and_then(|mut file| file.write_all(lines.as_bytes()));
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

    /// Returns the path of the list.
    pub fn list(&self) -> PathBuf {
        self.directory.join(LIST)
    }
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
