//! Runs of Yosys and GHDL, each within a limit of time.

use std::fs::{self, File};
use std::io;
use std::path::{self, Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Interval in which a run is looked at.
const INTERVAL: Duration = Duration::from_millis(10);

/// Programs that are running.
static RUNNING: Mutex<Vec<Running>> = Mutex::new(Vec::new());

/// A program, and the temporary directory in which it runs.
struct Running {
    child: Arc<Mutex<Child>>,
    #[cfg_attr(not(unix), expect(dead_code, reason = "signals alone remove it"))]
    directory: PathBuf,
}

/// Output of a run.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Ran {
    pub log: String,
    /// Standard error, if it is apart from the log.
    pub errors: String,
    pub end: End,
}

/// End of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum End {
    #[default]
    Success,
    Failure,
    /// The time was over.
    Late,
}

impl Ran {
    /// Returns the errors that were printed, or the last line.
    pub fn errors(&self) -> String {
        let lines = self.log.lines();
        let errors: Vec<&str> = lines.filter(|line| line.contains("ERROR: ")).collect();
        match errors.is_empty() {
            true => format!(
                "ended after the line {:?}",
                self.log.lines().last().unwrap_or_default()
            ),
            false => errors.join("; ").replace("ERROR: ", ""),
        }
    }

    /// Returns the first lines of standard error.
    pub fn complaint(&self) -> String {
        let lines: Vec<&str> = self.errors.lines().take(3).collect();
        lines.join("; ")
    }

    /// Returns the signal of the first latch that was inferred.
    pub fn latch(&self) -> Option<&str> {
        let mut lines = self.log.lines();
        let rest = lines.find_map(|line| line.strip_prefix("Latch inferred for signal `\\"))?;
        let signal = rest.split_once('\'')?.0;
        Some(signal.split_once(".\\").map_or(signal, |(_, name)| name))
    }

    /// Returns the greatest number of ticks in which no difference was found.
    pub fn ticks_without_difference(&self) -> u32 {
        let ticks = self.log.lines().filter_map(|line| {
            let rest = line.strip_prefix("Base case for induction length ")?;
            rest.strip_suffix(" proven.")?.parse().ok()
        });
        ticks.max().unwrap_or(0)
    }

    /// True if induction has proved all assertions.
    pub fn is_proof(&self) -> bool {
        self.end == End::Success && self.log.contains("\nInduction step proven: SUCCESS!")
    }

    /// True if neither a proof nor a difference is found.
    pub fn is_open(&self) -> bool {
        self.end == End::Success && !self.is_proof() && !self.is_difference()
    }

    /// True if a run from power-on breaks an assertion.
    pub fn is_difference(&self) -> bool {
        let found = "SAT temporal induction proof finished - model found for base case: FAIL!";
        self.log.contains(found)
    }
}

/// Runs a script of Yosys in its directory until a point in time.
///
/// # Errors
/// Returns the error of a program that cannot be started.
pub fn yosys(program: &Path, directory: &Path, script: &str, until: Instant) -> io::Result<Ran> {
    let path = directory.join(format!("{script}.log"));
    let log = File::create(&path)?;
    let errors = log.try_clone()?;
    let words = ["-Q", "-T", script].map(str::to_owned);
    let end = run(program, &words, directory, [log, errors], until)?;
    let log = String::from_utf8_lossy(&fs::read(&path)?).into_owned();
    Ok(Ran {
        log,
        end,
        ..Ran::default()
    })
}

/// Runs GHDL in a directory until a point in time.
///
/// # Errors
/// Returns the error of a program that cannot be started.
pub fn ghdl(program: &Path, directory: &Path, words: &[String], until: Instant) -> io::Result<Ran> {
    let paths = ["ghdl.out", "ghdl.err"].map(|name| directory.join(name));
    let files = [File::create(&paths[0])?, File::create(&paths[1])?];
    let end = run(program, words, directory, files, until)?;
    let [log, errors] = paths.map(fs::read);
    Ok(Ran {
        log: String::from_utf8_lossy(&log?).into_owned(),
        errors: String::from_utf8_lossy(&errors?).into_owned(),
        end,
    })
}

/// Runs a program in a directory until a point in time.
fn run(
    program: &Path,
    words: &[String],
    directory: &Path,
    [log, errors]: [File; 2],
    until: Instant,
) -> io::Result<End> {
    // A path is that from here, not from the directory.
    let program = match program.components().count() {
        1 => program.to_owned(),
        _ => path::absolute(program)?,
    };
    let child = Command::new(program)
        .args(words)
        .current_dir(directory)
        .stdin(Stdio::null())
        .stdout(log)
        .stderr(errors)
        .spawn()?;
    let child = Arc::new(Mutex::new(child));
    lock(&RUNNING).push(Running {
        child: child.clone(),
        directory: directory.to_owned(),
    });
    let end = end(&child, until);
    lock(&RUNNING).retain(|running| !Arc::ptr_eq(&running.child, &child));
    end
}

/// Waits for the end of a program, or ends it at a point in time.
fn end(child: &Mutex<Child>, until: Instant) -> io::Result<End> {
    loop {
        let mut child = lock(child);
        match child.try_wait()? {
            Some(status) if status.success() => return Ok(End::Success),
            Some(_) => return Ok(End::Failure),
            None if Instant::now() >= until => {
                child.kill()?;
                child.wait()?;
                return Ok(End::Late);
            }
            None => {}
        }
        drop(child);
        sleep(INTERVAL);
    }
}

/// Ends all programs that are running, and removes their directories.
#[cfg(unix)]
pub fn stop() {
    for running in lock(&RUNNING).drain(..) {
        let mut child = lock(&running.child);
        // It may have ended.
        let _ = child.kill();
        let _ = child.wait();
        let _ = fs::remove_dir_all(&running.directory);
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A signal leaves neither a program nor its directory.
    #[cfg(unix)]
    #[test]
    fn a_program_that_is_stopped_ends_and_its_directory_is_removed() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().to_owned();
        let run = std::thread::spawn(move || {
            let until = Instant::now() + Duration::from_secs(60);
            ghdl(Path::new("sleep"), &path, &["60".to_owned()], until)
        });
        let begun = Instant::now();
        while !lock(&RUNNING)
            .iter()
            .any(|one| one.directory == directory.path())
        {
            assert!(begun.elapsed() < Duration::from_secs(30));
            sleep(INTERVAL);
        }
        stop();
        // Its output is gone with the directory.
        assert!(run.join().unwrap().is_err());
        assert!(!directory.path().exists());
        assert!(begun.elapsed() < Duration::from_secs(50));
    }

    #[test]
    fn the_latch_of_a_log_is_named() {
        let ran = |log: &str| Ran {
            log: log.to_owned(),
            ..Ran::default()
        };
        let none = "No latch inferred for signal `\\top.\\a' from process `\\top.$proc$1'.\n";
        let latch = "Latch inferred for signal `\\top.\\b' from process `\\top.$proc$1': $auto$2\n";
        assert_eq!(ran(none).latch(), None);
        assert_eq!(ran(&(none.to_owned() + latch)).latch(), Some("b"));
    }
}
