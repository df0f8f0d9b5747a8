//! Several files take their names together.

use super::{AtomicFile, named, unfinished};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Gives all of them their names, or none: where one cannot be named, those before it go again, and
/// what they have replaced is there again.
///
/// # Errors
/// A rename failed; the files were [abandoned](super::abandon). The error names the path.
pub fn commit_all(files: impl IntoIterator<Item = AtomicFile>) -> io::Result<Vec<PathBuf>> {
    let mut entries = Vec::new();
    let (mut open, mut paths) = (Vec::new(), Vec::new());
    for AtomicFile {
        file,
        _unfinished,
        path,
        target,
    } in files
    {
        // They stay on the list until all have their names, as it is held meanwhile.
        entries.push(_unfinished);
        open.push((file, target));
        paths.push(path);
    }
    unfinished(|all| {
        if all.is_none() {
            let error = io::ErrorKind::Interrupted.into();
            let path = paths.first().map_or(Path::new(""), PathBuf::as_path);
            return Err(named(path, &error));
        }
        // One file replaces another in one step; of several the first ones have to go back.
        let several = open.len() > 1;
        let mut done: Vec<(PathBuf, Option<Older>)> = Vec::new();
        for ((file, target), path) in open.into_iter().zip(&paths) {
            let older = several.then(|| Older::keep(&target)).flatten();
            let replaced = file.persist(&target);
            // What was there is put back with the others.
            done.push((target, older));
            if let Err(failed) = replaced {
                let last = done.len() - 1;
                for (place, (target, older)) in done.into_iter().enumerate().rev() {
                    match older {
                        Some(older) => older.put_back(&target),
                        // The first error is the one to report. The last one was not named.
                        None if place < last => drop(fs::remove_file(target)),
                        None => {}
                    }
                }
                return Err(named(path, &failed.error));
            }
        }
        for older in done.into_iter().filter_map(|(_, older)| older) {
            older.remove();
        }
        Ok(())
    })?;
    drop(entries);
    Ok(paths)
}

/// What a file has replaced, by another name.
struct Older {
    path: PathBuf,
    /// Locked, so that it is not taken for one that was left.
    _held: Option<File>,
}

impl Older {
    /// Gives an older file a second name, or where that is not to be had another one; nothing where
    /// there is none.
    fn keep(target: &Path) -> Option<Self> {
        let there = target.symlink_metadata().ok()?;
        if !there.is_file() {
            return None;
        }
        let directory = target.parent().filter(|path| !path.as_os_str().is_empty());
        let held = File::open(target).ok();
        let held = held.filter(|file| file.try_lock().is_ok());
        let mut builder = tempfile::Builder::new();
        builder.prefix(super::PREFIX).suffix(super::SUFFIX);
        let made = builder.make_in(directory.unwrap_or(Path::new(".")), |path| {
            fs::hard_link(target, path).or_else(|error| match error.kind() {
                io::ErrorKind::AlreadyExists => Err(error),
                _ => fs::rename(target, path),
            })
        });
        let path = made.ok()?.into_temp_path().keep().ok()?;
        Some(Older { path, _held: held })
    }

    fn put_back(self, target: &Path) {
        let _ = fs::rename(&self.path, target);
        // Two names of one file stay as they are when one is to become the other.
        let _ = fs::remove_file(&self.path);
    }

    fn remove(self) {
        let _ = fs::remove_file(self.path);
    }
}
