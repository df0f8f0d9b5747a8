//! Reading a drawing from disk.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use super::{Drawing, Fault, gcode, hpgl};

/// The largest file read, in bytes. Beyond it a wrong file is likelier than a drawing, and the
/// moves take several times the memory of their text.
pub const LARGEST_FILE: u64 = 256 << 20;

const EXTENSIONS: &str = "HPGL as .hpgl, .hpg, .plt or .hgl; G-code as .ngc, .gcode, .nc, .tap, \
                          .gc or .cnc";

/// What reads a text, by the name of its file.
type Reader = fn(&str, &[u8]) -> Result<Drawing, Fault>;

/// Reads an HPGL drawing or a G-code program, told apart by the extension in either case.
///
/// # Errors
///
/// A path without a known extension, that is not a regular file, cannot be read or is larger
/// than [`LARGEST_FILE`]; and whatever [`hpgl::read`] and [`gcode::read`] object to.
pub fn read_path(path: &Path) -> Result<Drawing, Fault> {
    let name = path.display().to_string();
    let read = reader(&name, path)?;
    read(&name, &bytes(&name, path)?)
}

/// Reads the contents of a file called `name`, as [`read_path`] does.
///
/// # Errors
///
/// A name without a known extension; and whatever [`hpgl::read`] and [`gcode::read`] object to.
pub fn read_text(name: &str, text: &[u8]) -> Result<Drawing, Fault> {
    reader(name, Path::new(name))?(name, text)
}

fn reader(name: &str, path: &Path) -> Result<Reader, Fault> {
    let extension = path.extension().and_then(|text| text.to_str());
    let problem = match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("hpgl" | "hpg" | "plt" | "hgl") => return Ok(hpgl::read),
        Some("ngc" | "gcode" | "nc" | "tap" | "gc" | "cnc") => return Ok(gcode::read),
        Some(other) => format!("unknown extension .{other}"),
        None => "no extension".to_owned(),
    };
    Err(Fault::new(name, 0, "file", problem, EXTENSIONS))
}

pub(super) fn bytes(name: &str, path: &Path) -> Result<Vec<u8>, Fault> {
    let fault = |problem: String| Fault::new(name, 0, "file", problem, "a readable file");
    let unreadable = |error: std::io::Error| fault(format!("cannot be read: {error}"));
    // Asked before opening: opening a pipe would wait for its writer.
    let metadata = path.metadata().map_err(unreadable)?;
    if !metadata.is_file() {
        return Err(fault("not a regular file".to_owned()));
    }
    if metadata.len() > LARGEST_FILE {
        return Err(too_large(name));
    }
    let mut text = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    // The limit holds for a file that grows meanwhile, too.
    let mut reader = file.take(LARGEST_FILE + 1);
    let length = reader.read_to_end(&mut text).map_err(unreadable)?;
    if length as u64 > LARGEST_FILE {
        return Err(too_large(name));
    }
    Ok(text)
}

fn too_large(name: &str) -> Fault {
    let allowed = format!("at most {LARGEST_FILE} bytes");
    Fault::new(name, 0, "file", "too large", allowed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_over_the_limit_is_refused() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("huge.plt");
        // Sparse: takes no room on disk.
        File::create(&path)
            .unwrap()
            .set_len(LARGEST_FILE + 1)
            .unwrap();
        let fault = read_path(&path).unwrap_err();
        assert_eq!(fault.problem, "too large");
        assert_eq!(fault.allowed, "at most 268435456 bytes");
    }
}
