//! `clean`: removes the files that commands have written into a directory.

use super::files::size;
use super::written::Written;
use super::{Failure, print, to_standard_output, voice, warn};
use clap::Args;
use std::fmt::Write as _;
use std::fs;
use std::io::{self, BufRead as _, IsTerminal as _, stdin};
use std::path::PathBuf;

/// Arguments of `clean`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Directory with the files.
    #[arg(value_name = "DIR", default_value = "waves")]
    directory: PathBuf,
    /// Names the files, and removes none.
    #[arg(long, conflicts_with = "yes")]
    dry_run: bool,
    /// Removes the files without asking.
    #[arg(long, short)]
    yes: bool,
}

/// Lists the unchanged files of earlier commands and removes them.
pub fn clean(arguments: &Arguments) -> Result<(), Failure> {
    let directory = &arguments.directory;
    if !directory.is_dir() {
        return Err(Failure::Argument {
            field: "DIR",
            problem: format!("{} is not a directory", directory.display()),
            allowed: "the --out of a command".into(),
        });
    }
    let written = Written::read(directory);
    let (files, changed) = written.split();
    for path in &changed {
        warn(&format!(
            "{} has changed since it was written, and stays",
            path.display()
        ));
    }
    if files.is_empty() {
        return print(&format!(
            "{} has no files of this program\n",
            directory.display()
        ));
    }
    let mut text = String::new();
    for path in &files {
        let bytes = path.symlink_metadata().map_or(0, |there| there.len());
        // Writing to a string does not fail.
        let _ = writeln!(text, "{} ({})", path.display(), size(bytes));
    }
    match arguments.dry_run {
        true => to_standard_output(&text)?,
        false => print(&text)?,
    }
    if arguments.dry_run || !(arguments.yes || agreed(files.len())?) {
        return Ok(());
    }
    for path in &files {
        fs::remove_file(path).map_err(|error| {
            io::Error::new(error.kind(), format!("{}: {error}", path.display()))
        })?;
    }
    if changed.is_empty() {
        // Without it, nothing is known to be a run's.
        let _ = fs::remove_file(written.list());
    }
    let count = files.len();
    print(&format!(
        "removed {count} file{}\n",
        if count == 1 { "" } else { "s" }
    ))
}

/// Asks for consent to remove `count` files.
fn agreed(count: usize) -> Result<bool, Failure> {
    if !stdin().is_terminal() || voice::is_quiet() {
        return Err(Failure::Argument {
            field: "clean",
            problem: "cannot ask: standard input is not a terminal, or --quiet is given".into(),
            allowed: "--yes to remove them, --dry-run to name them".into(),
        });
    }
    print(&format!("remove these {count} files? [y/N] "))?;
    let mut answer = String::new();
    stdin().lock().read_line(&mut answer)?;
    Ok(matches!(answer.trim(), "y" | "Y" | "yes"))
}
