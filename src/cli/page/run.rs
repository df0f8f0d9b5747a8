//! The page of a run that has ended.

use super::{Run, with};
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use std::fs;
use std::io;
use std::path::Path;

/// Extensions of the files of a run that the page shows.
const SHOWN: [&str; 4] = ["fst", "gtkw", "csv", "npy"];

/// Returns the page of a run, with what it printed and the files that it wrote.
///
/// # Errors
/// Returns an error if a file cannot be read.
pub fn of_run<'a>(
    summary: String,
    complains: bool,
    files: impl Iterator<Item = &'a Path>,
) -> io::Result<String> {
    let mut shown = Vec::new();
    for path in files {
        let extension = path.extension().and_then(|extension| extension.to_str());
        let name = path.file_name().and_then(|name| name.to_str());
        if let (Some(extension), Some(name)) = (extension, name)
            && SHOWN.contains(&extension)
        {
            shown.push((name.to_owned(), BASE64_STANDARD.encode(fs::read(path)?)));
        }
    }
    let run = Run {
        // The first word is the path of the program, which is nobody's business.
        words: std::env::args().skip(1).collect(),
        code: complains.into(),
        out: summary,
        errors: String::new(),
        files: shown,
    };
    Ok(with(None, Some(run)))
}
