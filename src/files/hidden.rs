//! Hidden files beside those of a run: opening, locking and naming.

use super::{PREFIX, SUFFIX};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::Path;
use std::time::Duration;
use tempfile::NamedTempFile;

/// Suffix of a temporary file that may not be locked yet.
pub(super) const FRESH: &str = ".new";

/// Age after which such a file is left over: it is locked and renamed immediately after its
/// creation.
pub(super) const STALE: Duration = Duration::from_secs(60);

/// Problem of an entry that is not a regular file.
pub(super) const NOT_REGULAR: &str = "is not a regular file";

/// Creates a temporary file in this directory that is locked while it is open.
pub(super) fn temporary(directory: &Path) -> io::Result<NamedTempFile> {
    // The builder's own error would name the temporary file.
    let mut failed = None;
    let made = builder().make_in(directory, |path| {
        begin(path).inspect_err(|error| failed = error.raw_os_error())
    });
    made.map_err(|error| failed.map_or(error, io::Error::from_raw_os_error))
}

/// Returns a builder for names of temporary files.
pub(super) fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    builder
}

/// Creates and locks a file under another name first: nobody finds it unlocked under its own.
fn begin(path: &Path) -> io::Result<File> {
    let fresh = path.with_extension(&FRESH[1..]);
    // Ordinary permissions, unlike other temporary files: it is to become an ordinary file.
    let file = File::options()
        .read(true)
        .write(true)
        .create_new(true)
        .open(&fresh)?;
    let locked = match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(io::ErrorKind::AlreadyExists.into()),
        // If files cannot be locked, left-over files are never removed.
        Ok(()) | Err(TryLockError::Error(_)) => rename(&fresh, path),
    };
    match locked {
        Ok(()) => Ok(file),
        Err(error) => {
            let _ = fs::remove_file(&fresh);
            Err(error)
        }
    }
}

/// Renames a file to a name that is free.
pub(super) fn rename(from: &Path, to: &Path) -> io::Result<()> {
    match to.symlink_metadata() {
        Ok(_) => Err(io::ErrorKind::AlreadyExists.into()),
        Err(_) => fs::rename(from, to),
    }
}

/// Opens a regular file. Follows no link, and never waits for the other end of a pipe.
///
/// # Errors
/// The name belongs to something else ([`io::ErrorKind::InvalidInput`]), or the file cannot be
/// opened.
pub fn open(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags(libc::O_NOFOLLOW | libc::O_NONBLOCK);
    }
    let opened = options.open(path);
    let metadata = match &opened {
        Ok(file) => file.metadata(),
        Err(_) => path.symlink_metadata(),
    };
    match metadata {
        Ok(metadata) if !metadata.is_file() => {
            Err(io::Error::new(io::ErrorKind::InvalidInput, NOT_REGULAR))
        }
        _ => opened,
    }
}

/// True if an open file still has this name.
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

/// True on systems on which an open file cannot be removed.
#[cfg(not(unix))]
pub(super) fn is_there(_: &File, _: &Path) -> bool {
    true
}
