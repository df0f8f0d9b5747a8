//! `--open`: shows the waves of a run in a viewer.

use super::files::Named;
use super::{Failure, warn};
use std::env;
use std::fs::File;
use std::io::{self, BufRead as _, BufReader, Read as _, Seek as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// Viewers, the first that is there is taken; and the extensions of what they open, the best first.
const VIEWERS: [(&str, &[&str]); 2] = [
    ("gtkwave", &["gtkw", "vcd", "fst"]),
    ("surfer", &["vcd", "fst"]),
];

/// Time in which a viewer that cannot show its window ends.
const AT_ONCE: Duration = Duration::from_secs(1);

/// Most bytes that are read of what a viewer says.
const LONGEST: u64 = 1 << 12;

/// Time between looks at a viewer that has been started.
const PAUSE: Duration = Duration::from_millis(20);

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
            let program = programs.find(|program| is_program(program))?;
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

    /// Starts the viewer with the waves among some files. Warns if it ends within its first second,
    /// as it does where the display refuses it; otherwise it goes on by itself.
    pub fn open(&self, files: &[Named]) {
        let has = |extension: &&&str| {
            let mut paths = files.iter().map(|file| Path::new(&file.path));
            paths.find(|path| path.extension().is_some_and(|of| of == **extension))
        };
        let Some(file) = self.opens.iter().find_map(|extension| has(&extension)) else {
            return;
        };
        let program = self.program.display();
        match self.first_second(file) {
            Ok(None) => {}
            Ok(Some((status, said))) => warn(&format!("{program} ended at once, {status}{said}")),
            Err(error) => warn(&format!("{program} does not start: {error}")),
        }
    }

    /// Starts the viewer. If it ends within its first second, returns how, and what it said.
    fn first_second(&self, file: &Path) -> io::Result<Option<(ExitStatus, String)>> {
        // A file, as a viewer that writes to a pipe without a reader is ended.
        let mut said = tempfile::tempfile()?;
        let mut child = Command::new(&self.program)
            .arg(file)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(said.try_clone()?)
            .spawn()?;
        let Some(status) = ended(&mut child)? else {
            return Ok(None);
        };
        said.rewind()?;
        let first = first_line(said).map_or(String::new(), |line| format!(": {line}"));
        Ok(Some((status, first)))
    }
}

/// Waits for the end of a process, but not longer than a second.
fn ended(child: &mut Child) -> io::Result<Option<ExitStatus>> {
    let started = Instant::now();
    loop {
        let status = child.try_wait()?;
        if status.is_some() || started.elapsed() >= AT_ONCE {
            return Ok(status);
        }
        thread::sleep(PAUSE);
    }
}

fn first_line(file: File) -> Option<String> {
    let lines = BufReader::new(file.take(LONGEST)).lines();
    let lines = lines.map_while(Result::ok);
    let mut lines = lines.map(|line| line.trim().to_owned());
    lines.find(|line| !line.is_empty())
}

/// True if the path is a file that can be executed.
fn is_program(path: &Path) -> bool {
    let Ok(there) = path.metadata() else {
        return false;
    };
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        there.is_file() && there.permissions().mode() & 0o111 != 0
    }
    #[cfg(not(unix))]
    there.is_file()
}
