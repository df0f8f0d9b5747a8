//! Who writes: a temporary file is locked while somebody does, and one that is not was left by a
//! program that something ended at once.

use super::hidden::{FRESH, NOT_REGULAR, STALE, is_there, open};
use super::{PREFIX, SUFFIX, Unfinished, named, unfinished};
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

/// Bytes of a stem that the name of a claim has at most.
const STEM: usize = 200;

/// What the names of claims end with.
const CLAIM: &str = ".lock";

/// Stem of the claim by which one run at a time clears a directory: no file is called so.
const CLEARING: &str = "";

/// Wait before a claim is tried again.
const WAIT: Duration = Duration::from_millis(1);

/// Longest wait for others that name their files.
const PATIENCE: Duration = Duration::from_secs(10);

/// The files of a stem in a directory, for one writer at a time.
///
/// It is a lock on a hidden file beside them, which goes when this is dropped.
#[derive(Debug)]
#[must_use = "dropped, it lets others write"]
pub struct Claim {
    path: PathBuf,
    /// Gone once it is to be removed.
    file: Option<File>,
    _unfinished: Unfinished,
}

impl Claim {
    /// Claims the files called `stem` in `directory`. Where files cannot be made or locked there is
    /// no claim, and no error.
    ///
    /// # Errors
    /// Somebody else has claimed them; something that is no regular file has the name of the hidden
    /// file; the files were [abandoned](super::abandon). The error names the path.
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
                // Outside of the list, for which a signal waits.
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
    /// As [`new`](Claim::new), the claim of somebody else only after ten seconds.
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
        // While it is locked: who finds it then waits for no file that is gone.
        let _ = fs::remove_file(&self.path);
        drop(self.file.take());
    }
}

/// Result of one attempt to claim.
enum Attempt {
    Locked(File),
    /// The file is going, or somebody looks whether it was left.
    Again,
    /// Files cannot be made or locked here.
    Impossible,
}

/// Makes a file and locks it. A writer's lock is exclusive, that of who clears away is shared.
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

/// Removes what runs have left in a directory that something ended at once: hidden files that nobody
/// has locked. Returns the paths of temporary files, in order; claims hold nothing. Does nothing
/// where somebody else does it at the same time.
pub fn clear(directory: &Path) -> Vec<PathBuf> {
    let mut removed = Vec::new();
    // One at a time: a claim that was removed may be there again for the next one.
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

/// True if a file is older than one that somebody has only just made.
fn is_stale(path: &Path) -> bool {
    let made = path.symlink_metadata().and_then(|found| found.modified());
    let age = made.ok().and_then(|made| made.elapsed().ok());
    age.is_some_and(|age| age >= STALE)
}

/// Removes a regular file that nobody has locked; true if it did.
fn remove(path: &Path, lock: fn(&File) -> Result<(), TryLockError>) -> bool {
    let Ok(file) = open(File::options().read(true), path) else {
        return false;
    };
    // The lock is held until the file is gone.
    lock(&file).is_ok() && is_there(&file, path) && fs::remove_file(path).is_ok()
}
