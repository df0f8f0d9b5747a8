//! Who writes: a temporary file is locked while somebody does, and one that is not was left by a
//! program that something ended at once.

use super::{PREFIX, SUFFIX, Unfinished, named, unfinished};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// Bytes of a stem that the name of a claim has at most.
const STEM: usize = 200;

/// What the names of claims end with.
const CLAIM: &str = ".lock";

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
    /// Somebody else has claimed them; the files were [abandoned](super::abandon). The error names
    /// the path.
    pub fn new(directory: &Path, stem: &str) -> io::Result<Option<Self>> {
        let end = (0..=STEM.min(stem.len()))
            .rev()
            .find(|&end| stem.is_char_boundary(end));
        let stem = &stem[..end.unwrap_or(0)];
        let path = directory.join(format!("{PREFIX}{stem}{CLAIM}"));
        let made = unfinished(|all| {
            let all = all.as_mut().ok_or(io::ErrorKind::Interrupted)?;
            let file = lock(&path)?;
            if file.is_some() {
                all.push(path.clone());
            }
            Ok(file)
        });
        match made {
            Ok(file) => Ok(file.map(|file| Claim {
                _unfinished: Unfinished(vec![path.clone()]),
                path,
                file: Some(file),
            })),
            Err(error) => Err(named(&directory.join(stem), &error)),
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

/// Makes a file and locks it.
fn lock(path: &Path) -> io::Result<Option<File>> {
    loop {
        let opened = OpenOptions::new()
            .write(true)
            .create(true)
            .truncate(false)
            .open(path);
        let Ok(file) = opened else {
            return Ok(None);
        };
        match file.try_lock() {
            Ok(()) if is_there(&file, path) => return Ok(Some(file)),
            // The one before has removed it in between.
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let problem = "is being written by another run";
                return Err(io::Error::new(io::ErrorKind::ResourceBusy, problem));
            }
            Err(TryLockError::Error(_)) => {
                let _ = fs::remove_file(path);
                return Ok(None);
            }
        }
    }
}

/// Whether an open file still has this name.
#[cfg(unix)]
pub(super) fn is_there(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let number = |metadata: io::Result<fs::Metadata>| metadata.map(|one| (one.dev(), one.ino()));
    match (number(file.metadata()), number(path.symlink_metadata())) {
        (Ok(open), Ok(named)) => open == named,
        (_, Err(error)) => error.kind() != io::ErrorKind::NotFound,
        _ => true,
    }
}

/// Whether an open file still has this name: elsewhere what is open cannot be removed.
#[cfg(not(unix))]
pub(super) fn is_there(_: &File, _: &Path) -> bool {
    true
}

/// Removes what runs have left in a directory that something ended at once: temporary files that
/// nobody has locked. Returns their paths, in order.
pub fn clear(directory: &Path) -> Vec<PathBuf> {
    let mut removed = Vec::new();
    for entry in fs::read_dir(directory).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let Some(name) = name.to_str() else {
            continue;
        };
        let ours = name.starts_with(PREFIX) && (name.ends_with(SUFFIX) || name.ends_with(CLAIM));
        if !ours || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        let path = directory.join(name);
        // Held until it is removed: its writer may only just have made it.
        let file = File::open(&path)
            .ok()
            .filter(|file| file.try_lock().is_ok());
        if file.is_some_and(|file| is_there(&file, &path)) && fs::remove_file(&path).is_ok() {
            removed.push(path);
        }
    }
    removed.sort();
    removed
}
