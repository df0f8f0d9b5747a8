//! Claims of writers: a temporary file is locked while it is written; an unlocked one was left by
//! a program that was killed.

use super::hidden::{FRESH, NOT_REGULAR, STALE, is_there, open};
use super::{PREFIX, SUFFIX, Unfinished, named, unfinished};
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

/// Greatest number of bytes of a stem in the name of a claim.
const STEM: usize = 200;

/// Suffix of the names of claims.
const CLAIM: &str = ".lock";

/// Stem of the claim for clearing a directory, which one run does at a time; no file has it.
const CLEARING: &str = "";

/// Time between attempts to claim.
const WAIT: Duration = Duration::from_millis(1);

/// Longest wait for others that name their files.
const PATIENCE: Duration = Duration::from_secs(10);

/// Claim on the files of a stem in a directory, for one writer at a time.
///
/// The claim is a lock on a hidden file beside them, which is removed when the claim is dropped.
#[derive(Debug)]
#[must_use = "dropped, it lets others write"]
pub struct Claim {
    path: PathBuf,
    /// Hidden file; `None` once it is to be removed.
    file: Option<File>,
    _unfinished: Unfinished,
}

impl Claim {
    /// Claims the files named `stem` in `directory`. If files cannot be created or locked there,
    /// returns `None` and no error.
    ///
    /// # Errors
    /// Returns an error if somebody else has claimed them, the hidden file's name belongs to
    /// anything but a regular file, or the files were [abandoned](super::abandon). The error names
    /// the path.
    pub fn new(directory: &Path, stem: &str) -> io::Result<Option<Self>> {
        let end = (0..=STEM.min(stem.len()))
            .rev()
            .find(|&end| stem.is_char_boundary(end));
        let hidden = &stem[..end.unwrap_or(0)];
        let path = directory.join(format!("{PREFIX}{hidden}{CLAIM}"));
        loop {
            let tried: io::Result<Attempt> = unfinished(|all| {
                let all = all.as_mut().ok_or(io::ErrorKind::Interrupted)?;
                let tried = attempt(&path)?;
                if let Attempt::Locked(_) = tried {
                    all.push(path.clone());
                }
                Ok(tried)
            });
            return match tried {
                // Outside of the list's lock, for which a signal waits.
                Ok(Attempt::Again) => {
                    thread::sleep(WAIT);
                    continue;
                }
                Ok(Attempt::Locked(file)) => Ok(Some(Claim {
                    _unfinished: Unfinished(vec![path.clone()]),
                    path,
                    file: Some(file),
                })),
                Ok(Attempt::Impossible) => Ok(None),
                Err(error) if error.kind() == io::ErrorKind::InvalidInput => {
                    Err(named(&path, &error))
                }
                Err(error) => Err(named(&directory.join(stem), &error)),
            };
        }
    }
}

impl Claim {
    /// Claims files as [`new`](Claim::new) does, and waits while somebody else names theirs.
    ///
    /// # Errors
    /// Returns the errors of [`new`](Claim::new); a claim of somebody else is an error after ten
    /// seconds.
    pub fn wait(directory: &Path, stem: &str) -> io::Result<Option<Self>> {
        let begun = Instant::now();
        loop {
            match Claim::new(directory, stem) {
                Err(error)
                    if error.kind() == io::ErrorKind::ResourceBusy
                        && begun.elapsed() < PATIENCE =>
                {
                    thread::sleep(WAIT);
                }
                claim => return claim,
            }
        }
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        // Removed while locked: whoever finds it then does not wait for a removed file.
        let _ = fs::remove_file(&self.path);
        drop(self.file.take());
    }
}

/// Result of one attempt to claim.
enum Attempt {
    Locked(File),
    /// The file is being removed, or somebody checks if it was left over.
    Again,
    /// Files cannot be created or locked here.
    Impossible,
}

/// Creates a file and locks it. The lock of a writer is exclusive, that of a cleaner is shared.
fn attempt(path: &Path) -> io::Result<Attempt> {
    let mut options = File::options();
    let opened = open(options.write(true).create(true).truncate(false), path);
    let file = match opened {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::InvalidInput => {
            let problem = format!("{NOT_REGULAR}, and locks need one of this name");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
        }
        Err(_) => return Ok(Attempt::Impossible),
    };
    match file.try_lock() {
        Ok(()) if is_there(&file, path) => Ok(Attempt::Locked(file)),
        Ok(()) => Ok(Attempt::Again),
        // In this order: once a writer has its lock, only the writer removes the file.
        Err(TryLockError::WouldBlock)
            if file.try_lock_shared().is_ok() || !is_there(&file, path) =>
        {
            Ok(Attempt::Again)
        }
        Err(TryLockError::WouldBlock) => {
            let problem = "is being written by another run";
            Err(io::Error::new(io::ErrorKind::ResourceBusy, problem))
        }
        Err(TryLockError::Error(_)) => {
            let _ = fs::remove_file(path);
            Ok(Attempt::Impossible)
        }
    }
}

/// Removes files that killed runs have left in a directory: hidden files without a lock. Returns
/// the paths of the temporary files, in order; claims contain nothing. Does nothing if somebody
/// else is clearing the directory.
pub fn clear(directory: &Path) -> Vec<PathBuf> {
    let mut removed = Vec::new();
    // One run at a time: a removed claim may exist again for the next one.
    let Ok(Some(_claim)) = Claim::new(directory, CLEARING) else {
        return removed;
    };
    for entry in fs::read_dir(directory).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let Some(name) = name.to_str().filter(|name| name.starts_with(PREFIX)) else {
            continue;
        };
        let path = directory.join(name);
        let left = name.ends_with(SUFFIX) || name.ends_with(FRESH) && is_stale(&path);
        if name.ends_with(CLAIM) {
            remove(&path, File::try_lock_shared);
        } else if left && remove(&path, File::try_lock) {
            removed.push(path);
        }
    }
    removed.sort();
    removed
}

/// True if a file is too old to have just been created.
fn is_stale(path: &Path) -> bool {
    let made = path.symlink_metadata().and_then(|found| found.modified());
    let age = made.ok().and_then(|made| made.elapsed().ok());
    age.is_some_and(|age| age >= STALE)
}

/// Removes a regular file that nobody has locked; returns true if it did.
fn remove(path: &Path, lock: fn(&File) -> Result<(), TryLockError>) -> bool {
    let Ok(file) = open(File::options().read(true), path) else {
        return false;
    };
    // The lock is held until the file is removed.
    lock(&file).is_ok() && is_there(&file, path) && fs::remove_file(path).is_ok()
}
