//! Jobs of the page: this program, run in a temporary directory.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::path::{Component, Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Commands that a page may run.
const COMMANDS: [&str; 5] = ["run", "check", "mutate", "list", "keys"];

/// Time after which a job is ended at which nobody has looked: its page is closed.
const FORGOTTEN: Duration = Duration::from_secs(30);

/// Beginning of a series in CSV.
const SERIES_HEAD: &[u8] = b"tick,";

/// Most bytes of a series in one answer.
const MOST_SERIES: u64 = 4 << 20;

/// A job as the page posts it.
#[derive(Debug, Deserialize)]
pub struct Asked {
    /// Words of the command line.
    words: Vec<String>,
    /// Paths of input files, and base64 of their contents.
    files: Vec<(String, String)>,
    /// Base64 of standard input.
    #[serde(default)]
    input: Option<String>,
}

/// Bytes of a job that a page has seen.
#[derive(Debug, Clone, Copy, Default)]
pub struct Seen {
    /// Of standard error.
    pub said: u64,
    /// Of the series that the job is writing; `None` if the page does not want it.
    pub series: Option<u64>,
}

/// State of a job: what is new and, once it has ended, its result.
#[derive(Debug, Serialize)]
pub struct State {
    /// Text on standard error that was not seen.
    said: String,
    /// Byte of standard error from which to go on.
    next: u64,
    /// Whole lines of the series that were not seen.
    series: String,
    /// The end, once it has come.
    ended: Option<Ended>,
}

#[derive(Debug, Serialize)]
struct Ended {
    code: i32,
    out: String,
    /// Paths of the files that it has written.
    files: Vec<String>,
}

/// Runs jobs.
pub struct Jobs {
    program: PathBuf,
}

/// All jobs, by number, and the number of the last one.
static ALL: Mutex<(BTreeMap<u64, Job>, u64)> = Mutex::new((BTreeMap::new(), 0));

/// A job: the program as it runs, and its directory. Dropped, both are gone.
struct Job {
    child: Child,
    directory: TempDir,
    given: BTreeSet<PathBuf>,
    looked: Instant,
}

impl Drop for Job {
    fn drop(&mut self) {
        // It may have ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Job {
    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }
}

/// Names in the directory of a job.
const WORK: &str = "work";
const INPUT: &str = "input";
const OUTPUT: &str = "output";
const ERRORS: &str = "errors";

impl Jobs {
    /// # Errors
    /// Returns an error if the program does not know its own path.
    pub fn new() -> io::Result<Self> {
        thread::Builder::new().name("jobs".into()).spawn(|| {
            loop {
                thread::sleep(FORGOTTEN / 10);
                let looked_at = |job: &mut Job| job.looked.elapsed() < FORGOTTEN;
                all().0.retain(|_, job| looked_at(job));
            }
        })?;
        let program = std::env::current_exe()?;
        Ok(Jobs { program })
    }

    /// Begins a job; returns its number.
    ///
    /// # Errors
    /// Returns what is wrong with it.
    pub fn begin(&self, asked: Asked) -> Result<u64, String> {
        let command = asked.words.first().map_or("", String::as_str);
        if !COMMANDS.contains(&command) {
            return Err(format!("{command} is none of: {}", COMMANDS.join(", ")));
        }
        let told = |error: io::Error| error.to_string();
        // Locked until the job is in the list: a signal in between would leave it behind.
        let mut all = all();
        let directory = tempfile::Builder::new()
            .prefix("motion-rtl-")
            .tempdir()
            .map_err(told)?;
        let at = |name: &str| directory.path().join(name);
        fs::create_dir(at(WORK)).map_err(told)?;
        let mut given = BTreeSet::new();
        for (path, text) in &asked.files {
            let path =
                within(path).ok_or_else(|| format!("{path} is no path within a directory"))?;
            let whole = at(WORK).join(&path);
            fs::create_dir_all(whole.parent().unwrap_or(&whole)).map_err(told)?;
            fs::write(&whole, decoded(text)?).map_err(told)?;
            given.insert(path);
        }
        fs::write(
            at(INPUT),
            decoded(asked.input.as_deref().unwrap_or_default())?,
        )
        .map_err(told)?;
        let file = |name: &str| File::create(at(name)).map_err(told);
        let child = Command::new(&self.program)
            .args(&asked.words)
            .current_dir(at(WORK))
            .stdin(File::open(at(INPUT)).map_err(told)?)
            .stdout(file(OUTPUT)?)
            .stderr(Stdio::from(file(ERRORS)?))
            .spawn()
            .map_err(told)?;
        let (jobs, last) = &mut *all;
        *last += 1;
        let job = Job {
            child,
            directory,
            given,
            looked: Instant::now(),
        };
        jobs.insert(*last, job);
        Ok(*last)
    }

    /// Looks at a job: what is new, and how it ended.
    ///
    /// # Errors
    /// There is no such job, or its files cannot be read.
    pub fn look(&self, id: &str, seen: Seen) -> Result<State, String> {
        with(id, |job| {
            // First, as it may still write before it ends.
            let status = job.child.try_wait()?;
            let said = tail(&job.path(ERRORS), seen.said, u64::MAX, status.is_none())?;
            let series = match (seen.series, status) {
                (Some(from), None) => series(&job.path(WORK), from)?,
                _ => Vec::new(),
            };
            let ended = status.map(|status| -> io::Result<Ended> {
                Ok(Ended {
                    // A signal has no code.
                    code: status.code().unwrap_or(-1),
                    out: fs::read_to_string(job.path(OUTPUT))?,
                    files: written(&job.path(WORK), &job.given)?,
                })
            });
            Ok(State {
                next: seen.said + said.len() as u64,
                said: String::from_utf8_lossy(&said).into_owned(),
                series: String::from_utf8_lossy(&series).into_owned(),
                ended: ended.transpose()?,
            })
        })
    }

    /// Returns a file that a job has written.
    ///
    /// # Errors
    /// There is no such job or file.
    pub fn file(&self, id: &str, path: &str) -> Result<Vec<u8>, String> {
        let within = within(path).ok_or_else(|| format!("{path} is no path within a directory"))?;
        with(id, |job| fs::read(job.path(WORK).join(&within)))
    }

    /// Ends a job, if it still runs, and removes its files.
    pub fn end(&self, id: &str) {
        if let Ok(id) = id.parse() {
            drop(all().0.remove(&id));
        }
    }
}

/// Ends all jobs and removes their directories, for a program that a signal ends. No job begins
/// after that.
#[cfg(unix)]
pub fn stop() {
    let mut all = all();
    all.0.clear();
    // Threads that ask for jobs wait until the program has ended.
    std::mem::forget(all);
}

fn with<T>(id: &str, look: impl FnOnce(&mut Job) -> io::Result<T>) -> Result<T, String> {
    let mut all = all();
    let job = id.parse().ok().and_then(|id: u64| all.0.get_mut(&id));
    let job = job.ok_or_else(|| format!("there is no job {id}"))?;
    job.looked = Instant::now();
    look(job).map_err(|error| error.to_string())
}

fn all() -> MutexGuard<'static, (BTreeMap<u64, Job>, u64)> {
    ALL.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns at most `most` bytes of a file from a byte on; if it grows, whole lines only, which have
/// whole characters.
fn tail(path: &Path, from: u64, most: u64, grows: bool) -> io::Result<Vec<u8>> {
    let mut file = File::open(path)?;
    file.seek(SeekFrom::Start(from))?;
    let mut bytes = Vec::new();
    file.take(most).read_to_end(&mut bytes)?;
    if grows {
        let end = bytes.iter().rposition(|&byte| byte == b'\n');
        bytes.truncate(end.map_or(0, |at| at + 1));
    }
    Ok(bytes)
}

/// Returns lines of the series that a job is writing, from a byte on; none before there is one.
/// The name of the file begins with a dot until the file is complete.
fn series(directory: &Path, from: u64) -> io::Result<Vec<u8>> {
    let hidden = |path: &Path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with('.')
    };
    for path in below(directory)? {
        let path = directory.join(path);
        let head = tail(&path, 0, SERIES_HEAD.len() as u64, false);
        // It may have got its name since it was listed.
        if hidden(&path) && head.is_ok_and(|head| head == SERIES_HEAD) {
            return Ok(tail(&path, from, MOST_SERIES, true).unwrap_or_default());
        }
    }
    Ok(Vec::new())
}

/// A path that stays within its directory.
fn within(path: &str) -> Option<PathBuf> {
    let path = Path::new(path);
    let stays = path
        .components()
        .all(|part| matches!(part, Component::Normal(_)));
    (stays && path.file_name().is_some()).then(|| path.to_owned())
}

fn decoded(text: &str) -> Result<Vec<u8>, String> {
    BASE64_STANDARD
        .decode(text)
        .map_err(|error| error.to_string())
}

/// The files below a directory that were not given, as paths in it with `/`. Hidden ones are left
/// out.
fn written(directory: &Path, given: &BTreeSet<PathBuf>) -> io::Result<Vec<String>> {
    let hidden = |path: &PathBuf| {
        let mut parts = path.components();
        parts.any(|part| part.as_os_str().to_string_lossy().starts_with('.'))
    };
    let mut paths = below(directory)?;
    paths.retain(|path| !hidden(path) && !given.contains(path));
    let paths = paths.iter().map(|path| path.to_string_lossy());
    let mut paths: Vec<_> = paths.map(|path| path.replace('\\', "/")).collect();
    paths.sort();
    Ok(paths)
}

/// The files below a directory, as paths in it.
fn below(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(directory.join(&folder))? {
            let entry = entry?;
            let path = folder.join(entry.file_name());
            match entry.file_type()?.is_dir() {
                true => folders.push(path),
                false => paths.push(path),
            }
        }
    }
    Ok(paths)
}
