//! Files that appear whole or not at all, whatever ends the program. What a loss of power leaves is
//! up to the file system: they are not synchronised.

use std::fs;
use std::io::{self, Seek, SeekFrom, Write};
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tempfile::NamedTempFile;

/// A file that takes its name only when it is complete.
///
/// What is written goes to a temporary file in the same directory; [`commit`](AtomicFile::commit)
/// renames it, which replaces an older file in one step. Where the name is a symbolic link, it is
/// the file that it leads to which is replaced, and the temporary file stands beside that one.
/// Dropped before it is committed, it leaves nothing. It does not buffer.
#[derive(Debug)]
#[must_use = "a file has its name only when it is committed"]
pub struct AtomicFile {
    file: NamedTempFile,
    _unfinished: Unfinished,
    path: PathBuf,
    /// Where the path leads.
    target: PathBuf,
}

impl AtomicFile {
    /// Begins the file that will be called `path`.
    ///
    /// # Errors
    /// The directory does not exist or cannot be written; what has this name is a directory, a
    /// pipe, a device, anything but a regular file; the files were [abandoned](abandon). The error
    /// names the path.
    pub fn create(path: impl Into<PathBuf>) -> io::Result<Self> {
        let path = path.into();
        let target = target(&path).map_err(|error| named(&path, &error))?;
        let directory = match target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".").suffix(".part");
        // A temporary file is private; this one is to become an ordinary file.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        // Made while the list is held: a signal in between would leave it.
        let made = unfinished(|all| {
            let all = all.as_mut().ok_or(io::ErrorKind::Interrupted)?;
            let file = builder.tempfile_in(directory)?;
            all.push(file.path().to_owned());
            Ok(file)
        });
        // The kind alone: the rest would name the temporary file.
        let file = made.map_err(|error: io::Error| named(&path, &error.kind().into()))?;
        Ok(AtomicFile {
            _unfinished: Unfinished(vec![file.path().to_owned()]),
            file,
            path,
            target,
        })
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// The rename failed; nothing stays behind. The error names the path.
    pub fn commit(self) -> io::Result<PathBuf> {
        let AtomicFile {
            file, path, target, ..
        } = self;
        match file.persist(&target) {
            Ok(_) => Ok(path),
            Err(failed) => Err(named(&path, &failed.error)),
        }
    }
}

/// Gives all of them their names, or none: where one cannot be named, those before it go again. What
/// these have replaced is gone then too.
///
/// # Errors
/// A rename failed. The error names the path.
pub fn commit_all(files: impl IntoIterator<Item = AtomicFile>) -> io::Result<Vec<PathBuf>> {
    let (mut named, mut targets) = (Vec::new(), Vec::new());
    for file in files {
        let target = file.target.clone();
        match file.commit() {
            Ok(path) => {
                named.push(path);
                // A link stays, and what it leads to goes.
                targets.push(target);
            }
            Err(error) => {
                for target in targets {
                    // The first error is the one to report.
                    let _ = fs::remove_file(target);
                }
                return Err(error);
            }
        }
    }
    Ok(named)
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

/// The temporary files there are, and the directories made for files that are not there yet; a
/// directory before what is in it. None once they were abandoned.
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

/// Removes every temporary file, and what is empty of the directories made for them: for a program
/// that is about to end by a signal, which drops nothing. The files are still open; from then on
/// commits fail, and nothing can be begun.
pub fn abandon() {
    for path in unfinished(mem::take).into_iter().flatten().rev() {
        let _ = fs::remove_file(&path).or_else(|_| fs::remove_dir(&path));
    }
}

/// A directory that is there from now on; dropped while it is still empty, it goes again.
#[derive(Debug)]
#[must_use = "dropped, an empty directory goes again"]
pub struct Directory {
    /// What was not there before, outermost first.
    made: Unfinished,
}

impl Directory {
    /// Creates the directory and those around it where they are missing.
    ///
    /// # Errors
    /// It cannot be created; the files were [abandoned](abandon). The error names the path.
    pub fn create(path: &Path) -> io::Result<Self> {
        let missing =
            |path: &&Path| !path.as_os_str().is_empty() && path.symlink_metadata().is_err();
        let made = path.ancestors().take_while(missing).map(Path::to_owned);
        let mut made: Vec<_> = made.collect();
        made.reverse();
        // Before an error is returned, so that it clears away what that leaves.
        let directory = Directory {
            made: Unfinished(made.clone()),
        };
        let created = unfinished(|all| {
            let all = all.as_mut().ok_or(io::ErrorKind::Interrupted)?;
            all.extend(made);
            fs::create_dir_all(path)
        });
        created.map_err(|error| named(path, &error))?;
        Ok(directory)
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        for directory in self.made.0.iter().rev() {
            // Fails where there is something in it, which is then to stay.
            let _ = fs::remove_dir(directory);
        }
    }
}

/// Writes a whole file in one step, creating its directory where there is none.
///
/// # Errors
/// The error names the path; an older file of that name is then untouched.
pub fn write(path: impl Into<PathBuf>, contents: impl AsRef<[u8]>) -> io::Result<PathBuf> {
    let path = path.into();
    let _directory = path.parent().map(Directory::create).transpose()?;
    let mut file = AtomicFile::create(path)?;
    file.write_all(contents.as_ref())?;
    file.commit()
}

/// The links that are followed from a name; as many as Linux follows.
const LINKS: usize = 40;

/// The regular file that a path leads to, which need not be there yet.
fn target(path: &Path) -> io::Result<PathBuf> {
    if let Ok(there) = path.metadata() {
        if there.is_dir() {
            return Err(io::Error::new(
                io::ErrorKind::IsADirectory,
                "is a directory",
            ));
        }
        // The rename would put a file in the place of the pipe or the device.
        if !there.is_file() {
            let problem = "is not a regular file, and only such a file is replaced";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
        }
    }
    let mut target = path.to_owned();
    for _ in 0..LINKS {
        match target.read_link() {
            // A link is relative to where it stands.
            Ok(link) => target = target.parent().unwrap_or(Path::new("")).join(link),
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

fn named(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(directory)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_has_its_name_only_when_committed() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(b"new").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(file.commit().unwrap(), path);
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
        assert_eq!(names(directory.path()), ["a.txt"]);
    }

    #[test]
    fn a_dropped_file_leaves_nothing() {
        let directory = tempfile::tempdir().unwrap();
        let mut file = AtomicFile::create(directory.path().join("a.txt")).unwrap();
        file.write_all(b"half").unwrap();
        assert_eq!(names(directory.path()).len(), 1);
        drop(file);
        assert!(names(directory.path()).is_empty());
    }

    #[test]
    fn a_failed_rename_leaves_nothing_and_names_the_path() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("taken");
        fs::create_dir_all(path.join("full")).unwrap();
        let error = write(&path, "text").unwrap_err();
        assert!(error.to_string().contains("taken"), "{error}");
        assert_eq!(names(directory.path()), ["taken"]);
    }

    #[test]
    fn whole_files_may_bring_their_directory() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("new/a.txt");
        write(&path, "text").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "text");
    }

    #[test]
    fn a_directory_goes_again_where_it_stays_empty() {
        let outer = tempfile::tempdir().unwrap();
        let deep = outer.path().join("a/b/c");
        let directory = Directory::create(&deep).unwrap();
        assert!(deep.is_dir());
        drop(directory);
        assert!(names(outer.path()).is_empty());

        let directory = Directory::create(&deep).unwrap();
        fs::write(outer.path().join("a/x"), "").unwrap();
        drop(directory);
        assert_eq!(names(&outer.path().join("a")), ["x"]);

        let file = outer.path().join("a/x");
        let error = Directory::create(&file.join("y/z")).unwrap_err();
        assert!(error.to_string().contains("a/x/y/z: "), "{error}");
        let before = fs::read_dir(outer.path()).unwrap().count();
        drop(Directory::create(outer.path()).unwrap());
        assert_eq!(fs::read_dir(outer.path()).unwrap().count(), before);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_and_what_it_leads_to_is_written() {
        use std::os::unix::fs::symlink;
        let directory = tempfile::tempdir().unwrap();
        let at = |name: &str| directory.path().join(name);
        fs::create_dir(at("far")).unwrap();
        fs::write(at("far/old"), "old").unwrap();
        symlink("far/old", at("there")).unwrap();
        symlink(at("there"), at("by_two")).unwrap();
        symlink("far/new", at("not_yet")).unwrap();
        for (link, target) in [
            ("there", "far/old"),
            ("by_two", "far/old"),
            ("not_yet", "far/new"),
        ] {
            assert_eq!(write(at(link), link).unwrap(), at(link));
            assert!(at(link).is_symlink(), "{link}");
            assert!(!at(target).is_symlink(), "{link}");
            assert_eq!(fs::read_to_string(at(target)).unwrap(), link);
        }
        // The temporary file stands where the rename is one step.
        let file = AtomicFile::create(at("there")).unwrap();
        assert_eq!(names(&at("far")).len(), 3);
        drop(file);
        symlink("circle", at("circle")).unwrap();
        let error = write(at("circle"), "").unwrap_err().to_string();
        assert!(
            error.ends_with("circle: too many symbolic links"),
            "{error}"
        );
        let left = ["by_two", "circle", "far", "not_yet", "there"];
        assert_eq!(names(directory.path()), left);
    }

    #[cfg(unix)]
    #[test]
    fn what_is_no_regular_file_stays() {
        use std::os::unix::fs::{FileTypeExt, symlink};
        let directory = tempfile::tempdir().unwrap();
        let socket = directory.path().join("socket");
        let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        let link = directory.path().join("link");
        symlink("socket", &link).unwrap();
        for path in [&socket, &link] {
            let error = write(path, "text").unwrap_err();
            let text = "is not a regular file, and only such a file is replaced";
            assert_eq!(error.to_string(), format!("{}: {text}", path.display()));
        }
        let kind = socket.symlink_metadata().unwrap().file_type();
        assert!(kind.is_socket());
        assert!(link.is_symlink());
        assert_eq!(names(directory.path()), ["link", "socket"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_file_is_as_readable_as_any_other() {
        use std::os::unix::fs::PermissionsExt;
        let directory = tempfile::tempdir().unwrap();
        let ours = directory.path().join("ours");
        let plain = directory.path().join("plain");
        write(&ours, "").unwrap();
        fs::write(&plain, "").unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&plain));
    }
}
