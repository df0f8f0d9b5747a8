//! Naming of several files together.

use super::hidden::{self, FRESH, is_there, open};
use super::{AtomicFile, named, unfinished};
use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

/// Number of attempts to keep an older file while other runs replace it, and the wait between.
const TRIES: usize = 100;
const WAIT: Duration = Duration::from_millis(1);

/// Gives all files their names, or none: if one cannot be named, the files named before it are
/// removed, and the files they replaced are restored.
///
/// # Errors
/// Returns an error if a rename failed, or the files were [abandoned](super::abandon). The error
/// names the path.
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
        // Entries stay on the list until all files have their names, as it is locked meanwhile.
        entries.push(_unfinished);
        open.push((file, target));
        paths.push(path);
    }
    unfinished(|all| {
        if all.is_none() {
            let error = ErrorKind::Interrupted.into();
            let path = paths.first().map_or(Path::new(""), PathBuf::as_path);
            return Err(named(path, &error));
        }
        // One file replaces another in one step; of several, the first ones may have to be undone.
        let several = open.len() > 1;
        let mut done: Vec<(PathBuf, Option<Older>)> = Vec::new();
        for ((file, target), path) in open.into_iter().zip(&paths) {
            let older = several.then(|| Older::keep(&target)).flatten();
            let replaced = file.persist(&target);
            // The older file is restored with the others.
            done.push((target, older));
            if let Err(failed) = replaced {
                let last = done.len() - 1;
                for (place, (target, older)) in done.into_iter().enumerate().rev() {
                    match older {
                        Some(older) => older.put_back(&target),
                        // The first error is reported. The last file was not named.
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

/// File that was replaced, under another name.
struct Older {
    path: PathBuf,
    /// Locked, so that it is not taken for a left-over file. The lock is shared: several runs may
    /// replace it.
    _held: Option<File>,
}

impl Older {
    /// Gives an older file a second name or, if that is not possible, another name. Returns `None`
    /// if there is no older file.
    fn keep(target: &Path) -> Option<Self> {
        for _ in 0..TRIES {
            let held = open(File::options().read(true), target);
            if let Err(error) = &held
                && matches!(error.kind(), ErrorKind::NotFound | ErrorKind::InvalidInput)
            {
                return None;
            }
            // No lock if the file may not be read.
            let held = held.ok();
            let locked = held.as_ref().map(File::try_lock_shared);
            if let Some(Err(TryLockError::WouldBlock)) = locked {
                // Another run has just named it.
                thread::sleep(WAIT);
                continue;
            }
            if let Some(path) = second(target, held.as_ref())? {
                return Some(Older { path, _held: held });
            }
        }
        None
    }

    fn put_back(self, target: &Path) {
        let _ = fs::rename(&self.path, target);
        // Two names of one file stay when one is renamed to the other.
        let _ = fs::remove_file(&self.path);
    }

    fn remove(self) {
        let _ = fs::remove_file(self.path);
    }
}

/// Creates a second name of a file. Returns `None` if `held` is not the file of this name any
/// more, and `Some(None)` if a second name is impossible.
pub(super) fn second(target: &Path, held: Option<&File>) -> Option<Option<PathBuf>> {
    let directory = target.parent().filter(|path| !path.as_os_str().is_empty());
    let mut changed = false;
    let made = hidden::builder().make_in(directory.unwrap_or(Path::new(".")), |path| {
        let fresh = path.with_extension(&FRESH[1..]);
        match fs::hard_link(target, &fresh) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => return Err(error),
            // Second names are not supported here.
            Err(_) => return hidden::rename(target, path),
            Ok(()) => {}
        }
        changed = held.is_some_and(|held| !is_there(held, &fresh));
        let named = match changed {
            true => Err(ErrorKind::NotFound.into()),
            false => hidden::rename(&fresh, path),
        };
        named.inspect_err(|_| drop(fs::remove_file(&fresh)))
    });
    match made {
        Ok(path) => path.into_temp_path().keep().ok().map(Some),
        Err(_) if changed => Some(None),
        Err(_) => None,
    }
}
