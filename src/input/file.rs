//! Reading of files in general, and of drawings.

use std::fmt;
use std::fs::{File, Metadata};
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};
use std::str::Utf8Error;

use crate::files;

use super::{Drawing, Fault, Point, gcode, hpgl};

/// Greatest size of an input file in bytes. A larger file is more likely a mistake than a drawing,
/// and the moves take several times the memory of their text.
pub const LARGEST_FILE: u64 = 256 << 20;

/// Allowed formats of a drawing or part program, for messages.
pub const DRAWINGS: &str = "HPGL as .hpgl, .hpg, .plt or .hgl; G-code as .ngc, .gcode, .nc, .tap, \
                            .gc or .cnc";

/// Allowed format of a position log, for messages.
pub const POSITION_LOGS: &str = "a position log as .csv";

/// Kind of an input file, by its extension in either case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A scenario in TOML.
    Scenario,
    /// A drawing in HPGL, or a part program in G-code.
    Drawing,
    /// A position log in CSV.
    PositionLog,
}

impl Kind {
    /// Returns the kind of a file.
    ///
    /// # Errors
    ///
    /// Returns an error for a path without a known extension.
    pub fn of(path: &Path) -> Result<Self, Fault> {
        let extension = path.extension().and_then(|text| text.to_str());
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("toml") => return Ok(Kind::Scenario),
            Some("csv") => return Ok(Kind::PositionLog),
            _ => {}
        }
        let name = path.display().to_string();
        let known = reader(&name, path).map(|_| Kind::Drawing);
        known.map_err(|fault| Fault {
            allowed: format!("a scenario as .toml; {DRAWINGS}; {POSITION_LOGS}"),
            ..fault
        })
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Kind::Scenario => "a scenario",
            Kind::Drawing => "a drawing or part program",
            Kind::PositionLog => "a position log",
        })
    }
}

/// Language of a drawing or a part program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// HPGL.
    Hpgl,
    /// G-code.
    Gcode,
}

impl Language {
    /// Returns the language of a file by its extension in either case; `None` if it is of another
    /// kind.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        match extension.to_ascii_lowercase().as_str() {
            "hpgl" | "hpg" | "plt" | "hgl" => Some(Language::Hpgl),
            "ngc" | "gcode" | "nc" | "tap" | "gc" | "cnc" => Some(Language::Gcode),
            _ => None,
        }
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Language::Hpgl => "an HPGL drawing",
            Language::Gcode => "a G-code program",
        })
    }
}

/// Function that reads a text; its first argument is the name of the file.
type Reader = fn(&str, &[u8], &Options) -> Result<Drawing, Fault>;

/// Zeros and reference points, from the machine's zero, in millimetres.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Zeros {
    /// Zeros of G54 to G59 and G59.1 to G59.3.
    pub systems: [Point; 9],
    /// Reference points of G28 and G30.
    pub references: [Point; 2],
}

/// Options of the readers of moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// HPGL: true to skip, with a warning, instructions that are unknown or incomplete and may
    /// move the pen; otherwise they are refused.
    pub lenient: bool,
    /// G-code: true to refuse words without effect on the path; otherwise they are skipped with a
    /// warning.
    pub strict: bool,
    /// G-code: greatest number of executed lines; lines in loops and calls count each time.
    pub most_lines: u64,
    /// G-code: zeros in force until the program sets its own.
    pub zeros: Zeros,
    /// G-code: true to make G5 and G5.1 moves on splines; otherwise, and for NURBS always, they
    /// become chords.
    pub splines: bool,
    /// G-code: directories with files of subroutines that a program calls, in search order.
    pub subroutines: Vec<PathBuf>,
    /// G-code: true if W is an axis, which moves linearly with the length of each move.
    pub fourth: bool,
}

impl Options {
    /// Default limit of executed lines.
    pub const MOST_LINES: u64 = 10_000_000;

    /// Returns options that skip whatever can be skipped, with a warning.
    #[must_use]
    pub fn lenient() -> Self {
        Options {
            lenient: true,
            ..Self::default()
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Options {
            lenient: false,
            strict: false,
            most_lines: Self::MOST_LINES,
            zeros: Zeros::default(),
            splines: false,
            subroutines: Vec::new(),
            fourth: false,
        }
    }
}

/// Reads an HPGL drawing or a G-code program, depending on the extension in either case.
///
/// # Errors
///
/// Returns an error for a path without a known extension, that is neither a regular file nor a
/// pipe, cannot be read or is larger than [`LARGEST_FILE`]; and the errors of [`hpgl::read`] and
/// [`gcode::read`].
pub fn read_path(path: &Path) -> Result<Drawing, Fault> {
    read_path_with(path, &Options::default())
}

/// Reads a drawing or a program as [`read_path`] does, with options.
///
/// # Errors
///
/// Returns the errors of [`read_path`].
pub fn read_path_with(path: &Path, options: &Options) -> Result<Drawing, Fault> {
    let name = path.display().to_string();
    let read = reader(&name, path)?;
    read(&name, &read_bytes(path, LARGEST_FILE)?, options)
}

/// Reads the contents of a file called `name`, as [`read_path`] does.
///
/// # Errors
///
/// Returns an error for a name without a known extension, and the errors of [`hpgl::read`] and
/// [`gcode::read`].
pub fn read_text(name: &str, text: &[u8]) -> Result<Drawing, Fault> {
    read_text_with(name, text, &Options::default())
}

/// Reads the contents of a file as [`read_text`] does, with options.
///
/// # Errors
///
/// Returns the errors of [`read_text`].
pub fn read_text_with(name: &str, text: &[u8], options: &Options) -> Result<Drawing, Fault> {
    reader(name, Path::new(name))?(name, text, options)
}

fn reader(name: &str, path: &Path) -> Result<Reader, Fault> {
    match Language::of(path) {
        Some(Language::Hpgl) => return Ok(hpgl::read_with),
        Some(Language::Gcode) => return Ok(gcode::read_with),
        None => {}
    }
    let extension = path.extension().and_then(|text| text.to_str());
    let problem = match extension.map(str::to_ascii_lowercase) {
        Some(other) => format!("unknown extension .{other}"),
        None => "no extension".to_owned(),
    };
    Err(Fault::new(name, 0, "file", problem, DRAWINGS))
}

/// Reads a file or a pipe once.
///
/// # Errors
///
/// Returns an error for a path that is neither a regular file nor a pipe, cannot be read or is
/// larger than `most` bytes.
pub fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, Fault> {
    let room = size(path, most)?;
    let unreadable = |error| unreadable(path, &error);
    let mut bytes = Vec::new();
    let reserved = bytes.try_reserve_exact(room);
    reserved.map_err(|error| unreadable(error.into()))?;
    let file = File::open(path).map_err(unreadable)?;
    // The limit holds also for a file that grows meanwhile.
    let mut reader = file.take(most.saturating_add(1));
    let length = reader.read_to_end(&mut bytes).map_err(unreadable)?;
    if length as u64 > most {
        return Err(too_large(path, most));
    }
    Ok(bytes)
}

/// Returns the size of a file before it is read; 0 for a pipe.
///
/// # Errors
///
/// Returns the errors of [`read_bytes`], without reading.
pub(crate) fn size(path: &Path, most: u64) -> Result<usize, Fault> {
    // Checked before opening, which may affect a device.
    let metadata = path.metadata().map_err(|error| unreadable(path, &error))?;
    if !(metadata.is_file() || is_pipe(&metadata)) {
        return Err(fault(
            path,
            "not a regular file".to_owned(),
            "a readable file",
        ));
    }
    match usize::try_from(metadata.len()) {
        Ok(size) if metadata.len() <= most => Ok(size),
        _ => Err(too_large(path, most)),
    }
}

fn fault(path: &Path, problem: String, allowed: impl Into<String>) -> Fault {
    Fault::new(&path.display().to_string(), 0, "file", problem, allowed)
}

fn too_large(path: &Path, most: u64) -> Fault {
    fault(
        path,
        "too large".to_owned(),
        format!("at most {most} bytes"),
    )
}

fn unreadable(path: &Path, error: &io::Error) -> Fault {
    let dangles = error.kind() == io::ErrorKind::NotFound && path.is_symlink();
    match path.read_link() {
        Ok(target) if dangles => {
            let problem = format!("is a link to {}, which is not there", target.display());
            fault(path, problem, "a readable file")
        }
        _ => {
            let allowed = or_more_files(error, "a readable file");
            fault(path, format!("cannot be read: {error}"), allowed)
        }
    }
}

/// Advice if the process has too many open files.
pub const MORE_FILES: &str = "a higher limit on open files (ulimit -n)";

/// Returns the advice for a file error: [`MORE_FILES`] if there are too many open files, else
/// `allowed`.
pub fn or_more_files<'a>(error: &io::Error, allowed: &'a str) -> &'a str {
    match files::too_many_open(error) {
        true => MORE_FILES,
        false => allowed,
    }
}

#[cfg(unix)]
fn is_pipe(metadata: &Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(&metadata.file_type())
}

#[cfg(not(unix))]
fn is_pipe(_: &Metadata) -> bool {
    false
}

/// Reads the text of a file of at most [`LARGEST_FILE`] bytes; `allowed` describes what is
/// expected.
///
/// # Errors
///
/// Returns the errors of [`read_bytes`], and an error with the line for bytes that are not UTF-8.
pub fn read_string(path: &Path, allowed: &str) -> Result<String, Fault> {
    read_string_of(path, LARGEST_FILE, allowed)
}

/// Reads the text of a file of at most `most` bytes, as [`read_string`] does.
///
/// # Errors
///
/// Returns the errors of [`read_bytes`], and an error with the line for bytes that are not UTF-8.
pub fn read_string_of(path: &Path, most: u64, allowed: &str) -> Result<String, Fault> {
    let name = path.display().to_string();
    String::from_utf8(read_bytes(path, most)?)
        .map_err(|error| not_utf8(&name, error.as_bytes(), error.utf8_error(), allowed))
}

/// Returns the bytes of a file called `name` as text; `allowed` describes what is expected.
///
/// # Errors
///
/// Bytes that are not UTF-8, with their line.
pub fn as_text<'a>(name: &str, bytes: &'a [u8], allowed: &str) -> Result<&'a str, Fault> {
    str::from_utf8(bytes).map_err(|error| not_utf8(name, bytes, error, allowed))
}

fn not_utf8(name: &str, bytes: &[u8], error: Utf8Error, allowed: &str) -> Fault {
    let valid = &bytes[..error.valid_up_to()];
    let line = 1 + valid.iter().filter(|&&byte| byte == b'\n').count();
    Fault::new(name, line, "file", "not UTF-8", allowed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_over_the_limit_is_refused() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("huge.plt");
        // Sparse: takes no space on disk.
        File::create(&path)
            .unwrap()
            .set_len(LARGEST_FILE + 1)
            .unwrap();
        let fault = read_path(&path).unwrap_err();
        assert_eq!(fault.problem, "too large");
        assert_eq!(fault.allowed, "at most 268435456 bytes");
        assert_eq!(read_string(&path, "text").unwrap_err(), fault);
        assert_eq!(read_bytes(&path, 9).unwrap_err().allowed, "at most 9 bytes");
    }

    #[test]
    fn a_file_of_just_the_limit_is_read() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.txt");
        std::fs::write(&path, "a\nb").unwrap();
        assert_eq!(read_bytes(&path, 3).unwrap(), b"a\nb");
        assert_eq!(read_bytes(&path, u64::MAX).unwrap(), b"a\nb");
        assert_eq!(read_bytes(&path, 2).unwrap_err().problem, "too large");
        assert_eq!(read_string(&path, "text").unwrap(), "a\nb");
    }

    #[test]
    fn bytes_that_are_no_text_are_refused_with_their_line() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.txt");
        std::fs::write(&path, b"a\nb\xff").unwrap();
        let fault = read_string(&path, "a text").unwrap_err();
        assert_eq!((fault.line, fault.problem.as_str()), (2, "not UTF-8"));
        assert_eq!(fault.allowed, "a text");
    }
}
