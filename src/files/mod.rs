//! Atomic files: they appear complete or not at all, however the program ends. Files are not
//! synchronised to disk, so the result of a power loss depends on the file system.

mod hidden;
mod left;
mod naming;

pub use left::{Claim, clear};
pub use naming::commit_all;

pub use hidden::open;
use hidden::{NOT_REGULAR, temporary};
use std::fs;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tempfile::NamedTempFile;

/// Prefix of the names of temporary files, by which left-over ones are recognised.
const PREFIX: &str = ".motion-rtl-";
/// Suffix of the names of temporary files.
const SUFFIX: &str = ".part";

/// File that takes its name only when it is complete.
///
/// Output goes to a temporary file in the same directory; [`commit`](AtomicFile::commit) renames
/// it, which replaces an older file in one step. If the name is a symbolic link, the file at its
/// end is replaced, and the temporary file is beside that one. If it is dropped before it is
/// committed, nothing is left. Writes are not buffered.
#[derive(Debug)]
#[must_use = "a file has its name only when it is committed"]
pub struct AtomicFile {
    file: NamedTempFile,
    _unfinished: Unfinished,
    path: PathBuf,
    /// Path after following symbolic links.
    target: PathBuf,
}

impl AtomicFile {
    /// Creates the file that will have the name `path`.
    ///
    /// # Errors
    /// Returns an error if the directory does not exist or cannot be written, the name belongs to
    /// anything but a regular file, or the files were [abandoned](abandon). The error names the
    /// path.
    pub fn create(path: impl Into<PathBuf>) -> io::Result<Self> {
        let path = path.into();
        let target = target(&path).map_err(|error| named(&path, &error))?;
        let directory = match target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        // Made while the list is locked: a signal in between would leave it behind.
        let made = unfinished(|all| {
            let all = all.as_mut().ok_or(io::ErrorKind::Interrupted)?;
            let file = temporary(directory)?;
            all.push(file.path().to_owned());
            Ok(file)
        });
        let file = made.map_err(|error: io::Error| named(&path, &error))?;
        Ok(AtomicFile {
            _unfinished: Unfinished(vec![file.path().to_owned()]),
            file,
            path,
            target,
        })
    }

    /// Returns the name that the file will have.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// Returns an error if the rename failed, after which nothing is left, or the files were
    /// [abandoned](abandon). The error names the path.
    pub fn commit(self) -> io::Result<PathBuf> {
        let path = self.path.clone();
        commit_all([self]).map(|_| path)
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.as_file_mut().write(bytes);
        written.map_err(|error| named(&self.path, &error))
    }
    fn flush(&mut self) -> io::Result<()> {
        self.file.as_file_mut().flush()
    }
}

impl Seek for AtomicFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let sought = self.file.as_file_mut().seek(to);
        sought.map_err(|error| named(&self.path, &error))
    }
}

/// Existing temporary files, and directories made for files that do not exist yet, each directory
/// before its contents. `None` once they were abandoned.
static UNFINISHED: Mutex<Option<Vec<PathBuf>>> = Mutex::new(Some(Vec::new()));

/// Entries in that list.
#[derive(Debug)]
struct Unfinished(Vec<PathBuf>);

impl Drop for Unfinished {
    fn drop(&mut self) {
        unfinished(|all| {
            if let Some(all) = all {
                all.retain(|path| !self.0.contains(path));
            }
        });
    }
}

fn unfinished<T>(work: impl FnOnce(&mut Option<Vec<PathBuf>>) -> T) -> T {
    work(&mut UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Removes all temporary files and the empty directories made for them, then calls `end`, which
/// ends the program. This is for programs that a signal ends, without running destructors. Waits
/// until files that are being named have their names. The files remain open; until `end` returns,
/// threads that create, name or drop a file wait, and after that no file can be created or named.
pub fn abandon<T>(end: impl FnOnce() -> T) -> T {
    unfinished(|all| {
        for path in all.take().into_iter().flatten().rev() {
            let _ = fs::remove_file(&path).or_else(|_| fs::remove_dir(&path));
        }
        end()
    })
}

/// Directory that exists from now on; it is removed again if it is dropped while still empty.
#[derive(Debug)]
#[must_use = "dropped, an empty directory goes again"]
pub struct Directory {
    /// Directories that did not exist before, outermost first.
    made: Unfinished,
}

impl Directory {
    /// Creates the directory and its missing parents.
    ///
    /// # Errors
    /// Returns an error if it cannot be created, or the files were [abandoned](abandon). The error
    /// names the path.
    pub fn create(path: &Path) -> io::Result<Self> {
        let missing =
            |path: &&Path| !path.as_os_str().is_empty() && path.symlink_metadata().is_err();
        let made = path.ancestors().take_while(missing).map(Path::to_owned);
        let mut made: Vec<_> = made.collect();
        made.reverse();
        // Made before an error is returned, so that it cleans up.
        let directory = Directory {
            made: Unfinished(made.clone()),
        };
        let created = unfinished(|all| {
            let all = all.as_mut().ok_or(io::ErrorKind::Interrupted)?;
            all.extend(made);
            fs::create_dir_all(path)
        });
        created.map_err(|error| match dangling(path) {
            Some(link) => named(&link, &io::Error::new(io::ErrorKind::NotFound, DANGLES)),
            None => named(path, &error),
        })?;
        Ok(directory)
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        for directory in self.made.0.iter().rev() {
            // Fails if the directory is not empty; it must then stay.
            let _ = fs::remove_dir(directory);
        }
    }
}

/// Writes a whole file in one step; creates its directory if necessary.
///
/// # Errors
/// Returns an error that names the path; an older file of that name is then untouched.
pub fn write(path: impl Into<PathBuf>, contents: impl AsRef<[u8]>) -> io::Result<PathBuf> {
    let path = path.into();
    let _directory = path.parent().map(Directory::create).transpose()?;
    let mut file = AtomicFile::create(path)?;
    file.write_all(contents.as_ref())?;
    file.commit()
}

/// Greatest number of symbolic links followed from a name, as in Linux.
const LINKS: usize = 40;

/// Returns the regular file that a path leads to; it may not exist yet.
fn target(path: &Path) -> io::Result<PathBuf> {
    if let Ok(there) = path.metadata() {
        if there.is_dir() {
            return Err(io::Error::new(
                io::ErrorKind::IsADirectory,
                "is a directory",
            ));
        }
        // The rename would replace the pipe or the device by a file.
        if !there.is_file() {
            let problem = format!("{NOT_REGULAR}, and only such a file is replaced");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
        }
    }
    let mut target = path.to_owned();
    for _ in 0..LINKS {
        match target.read_link() {
            // A link is relative to its own directory.
            Ok(link) => target = target.parent().unwrap_or(Path::new("")).join(link),
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

const DANGLES: &str = "is a link to what is not there";

/// Returns the dangling symbolic link on a path.
fn dangling(path: &Path) -> Option<PathBuf> {
    let dangles = |path: &&Path| path.is_symlink() && !path.exists();
    path.ancestors().find(dangles).map(Path::to_owned)
}

/// Error with the path that it is about.
#[derive(Debug, thiserror::Error)]
#[error("{text}")]
struct Named {
    text: String,
    /// Error number of the system.
    code: Option<i32>,
}

fn named(path: &Path, error: &io::Error) -> io::Error {
    let text = format!("{}: {error}", path.display());
    let code = error.raw_os_error();
    io::Error::new(error.kind(), Named { text, code })
}

/// True if an error of this module or of the system means that too many files are open.
pub fn too_many_open(error: &io::Error) -> bool {
    let named = error
        .get_ref()
        .and_then(|inner| inner.downcast_ref::<Named>());
    let code = error.raw_os_error().or(named.and_then(|named| named.code));
    code.is_some_and(|code| code == libc::EMFILE || code == libc::ENFILE)
}

#[cfg(test)]
mod tests;
