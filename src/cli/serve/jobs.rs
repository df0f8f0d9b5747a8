//! Jobs of the page: this program, run in a temporary directory.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeSet, HashMap};
use std::fs::{self, File};
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::path::{Component, Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Commands that a page may run.
const COMMANDS: [&str; 5] = ["run", "check", "mutate", "list", "keys"];

/// Time after which a job is ended at which nobody has looked: its page is closed.
const FORGOTTEN: Duration = Duration::from_secs(30);

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

/// State of a job: its messages so far and, once it has ended, its result.
#[derive(Debug, Serialize)]
pub struct State {
    /// Text on standard error from the given byte on.
    said: String,
    /// Byte from which to go on.
    next: u64,
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

/// All jobs, by number.
pub struct Jobs {
    program: PathBuf,
    all: Arc<Mutex<HashMap<u64, Job>>>,
    next: Mutex<u64>,
}

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
        let all: Arc<Mutex<HashMap<u64, Job>>> = Arc::default();
        let jobs = Jobs {
            program: std::env::current_exe()?,
            all: all.clone(),
            next: Mutex::new(0),
        };
        thread::Builder::new().name("jobs".into()).spawn(move || {
            loop {
                thread::sleep(FORGOTTEN / 10);
                lock(&all).retain(|_, job| job.looked.elapsed() < FORGOTTEN);
            }
        })?;
        Ok(jobs)
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
        let id = {
            let mut next = lock(&self.next);
            *next += 1;
            *next
        };
        let looked = Instant::now();
        lock(&self.all).insert(
            id,
            Job {
                child,
                directory,
                given,
                looked,
            },
        );
        Ok(id)
    }

    /// Looks at a job: what it has said since byte `from`, and how it ended.
    ///
    /// # Errors
    /// There is no such job, or its files cannot be read.
    pub fn look(&self, id: &str, from: u64) -> Result<State, String> {
        self.with(id, |job| {
            job.looked = Instant::now();
            // First, as it may still write before it ends.
            let status = job.child.try_wait()?;
            let mut errors = File::open(job.path(ERRORS))?;
            errors.seek(SeekFrom::Start(from))?;
            let mut said = Vec::new();
            errors.read_to_end(&mut said)?;
            // Up to a whole line, which has whole characters.
            if status.is_none() {
                let end = said
                    .iter()
                    .rposition(|&byte| byte == b'\n')
                    .map_or(0, |at| at + 1);
                said.truncate(end);
            }
            let ended = status.map(|status| -> io::Result<Ended> {
                Ok(Ended {
                    // A signal has no code.
                    code: status.code().unwrap_or(-1),
                    out: fs::read_to_string(job.path(OUTPUT))?,
                    files: written(&job.path(WORK), &job.given)?,
                })
            });
            Ok(State {
                next: from + said.len() as u64,
                said: String::from_utf8_lossy(&said).into_owned(),
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
        self.with(id, |job| {
            job.looked = Instant::now();
            fs::read(job.path(WORK).join(&within))
        })
    }

    /// Ends a job, if it still runs, and removes its files.
    pub fn end(&self, id: &str) {
        if let Ok(id) = id.parse() {
            drop(lock(&self.all).remove(&id));
        }
    }

    fn with<T>(&self, id: &str, look: impl FnOnce(&mut Job) -> io::Result<T>) -> Result<T, String> {
        let mut all = lock(&self.all);
        let job = id.parse().ok().and_then(|id: u64| all.get_mut(&id));
        let job = job.ok_or_else(|| format!("there is no job {id}"))?;
        look(job).map_err(|error| error.to_string())
    }
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
    let mut paths = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(directory.join(&folder))? {
            let entry = entry?;
            let path = folder.join(entry.file_name());
            let name = entry.file_name();
            if name.to_string_lossy().starts_with('.') || given.contains(&path) {
                continue;
            }
            match entry.file_type()?.is_dir() {
                true => folders.push(path),
                false => paths.push(path.to_string_lossy().replace('\\', "/")),
            }
        }
    }
    paths.sort();
    Ok(paths)
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
