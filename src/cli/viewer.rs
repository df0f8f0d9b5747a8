//! `--open`: shows the waves of a run in a viewer.

use super::files::Named;
use super::{Failure, warn};
use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Viewers, the first that is there is taken; and the extensions of what they open, the best first.
const VIEWERS: [(&str, &[&str]); 2] = [
    ("gtkwave", &["gtkw", "vcd", "fst"]),
    ("surfer", &["vcd", "fst"]),
];

/// A viewer of waves.
#[derive(Debug)]
pub struct Viewer {
    program: PathBuf,
    opens: &'static [&'static str],
}

impl Viewer {
    /// Finds a viewer.
    ///
    /// # Errors
    /// There is no display, or no viewer in PATH.
    pub fn find() -> Result<Self, Failure> {
        let display = ["DISPLAY", "WAYLAND_DISPLAY"];
        if cfg!(target_os = "linux") && display.iter().all(|name| env::var_os(name).is_none()) {
            return Err(Failure::Argument {
                field: "--open",
                problem: "there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set".into(),
                allowed: "a graphical session, or a run without --open".into(),
            });
        }
        let path = env::var_os("PATH").unwrap_or_default();
        let directories: Vec<_> = env::split_paths(&path).collect();
        let found = VIEWERS.iter().find_map(|(name, opens)| {
            let name = format!("{name}{}", env::consts::EXE_SUFFIX);
            let mut programs = directories.iter().map(|directory| directory.join(&name));
            let program = programs.find(|program| program.is_file())?;
            Some(Viewer { program, opens })
        });
        found.ok_or_else(|| {
            let names: Vec<_> = VIEWERS.iter().map(|(name, _)| *name).collect();
            Failure::Argument {
                field: "--open",
                problem: "no viewer of waves in PATH".into(),
                allowed: names.join(" or "),
            }
        })
    }

    /// Starts the viewer with the waves among some files, and does not wait for it.
    pub fn open(&self, files: &[Named]) {
        let has = |extension: &&&str| {
            let mut paths = files.iter().map(|file| Path::new(&file.path));
            paths.find(|path| path.extension().is_some_and(|of| of == **extension))
        };
        let Some(file) = self.opens.iter().find_map(|extension| has(&extension)) else {
            return;
        };
        let started = Command::new(&self.program)
            .arg(file)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        if let Err(error) = started {
            warn(&format!(
                "{} does not start: {error}",
                self.program.display()
            ));
        }
    }
}
