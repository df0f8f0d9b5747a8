//! Progress of a run on standard error: before a long run its expected length, during it a bar on a
//! terminal and an occasional line elsewhere.

use super::voice;
use indicatif::{ProgressBar, ProgressStyle};
use motion_rtl::hdl::Circuit;
use motion_rtl::sim::{Needs, Observer, RunError, Sample};
use std::io::{IsTerminal, Write, stderr};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{LazyLock, Mutex, PoisonError};
use std::thread::{self, sleep};
use std::time::{Duration, Instant};

/// A run that is estimated to take less is not announced.
const LONG_S: f64 = 2.0;
/// Time from one line to the next where there is no terminal, and between two looks at a bar. A page
/// shows each line.
const LINES: Duration = match cfg!(target_family = "wasm") {
    true => Duration::from_millis(200),
    false => Duration::from_secs(10),
};
const LOOKS: Duration = Duration::from_millis(200);
/// Ticks between two looks at how far a run is.
const PROGRESS: u64 = 1 << 18;
/// Nanoseconds that a tick takes longer in the waves.
const WAVES_NS: f64 = 300.0;

/// Current stage of the work.
struct Stage {
    name: &'static str,
    /// Ticks of all runs together; 0 where there are none.
    ticks: u64,
}

static STAGE: Mutex<Stage> = Mutex::new(Stage { name: "", ticks: 0 });
/// Ticks of them that are over.
static DONE: AtomicU64 = AtomicU64::new(0);
static BAR: LazyLock<ProgressBar> = LazyLock::new(ProgressBar::new_spinner);

/// True while a run is under way.
static IN_A_RUN: AtomicBool = AtomicBool::new(false);

/// Start of the program, for the times of stages.
static BEGAN: LazyLock<Instant> = LazyLock::new(Instant::now);

fn set(stage: Stage) {
    // A stage of no run, as when `list` prepares all scenarios, is not told.
    if IN_A_RUN.load(Ordering::Relaxed) && voice::is_verbose() {
        let name = match stage.ticks {
            0 => stage.name.to_owned(),
            ticks => format!("{}, about {ticks} ticks", stage.name),
        };
        tell(&name);
    }
    DONE.store(0, Ordering::Relaxed);
    let style = match stage.ticks {
        0 => ProgressStyle::with_template("{spinner} {msg}  {elapsed}"),
        ticks => {
            BAR.set_length(ticks);
            ProgressStyle::with_template(
                "{bar:40} {percent:>3} % of {human_len} ticks  {eta}  {msg}",
            )
        }
    };
    if let Ok(style) = style {
        BAR.set_style(style);
    }
    BAR.set_message(stage.name);
    BAR.set_position(0);
    *STAGE.lock().unwrap_or_else(PoisonError::into_inner) = stage;
}

/// Begins to tell, until the program ends or [`end`].
pub fn begin() {
    IN_A_RUN.store(true, Ordering::Relaxed);
    set(Stage {
        name: "reading",
        ticks: 0,
    });
    let began = *BEGAN;
    let terminal = stderr().is_terminal();
    if voice::is_quiet() {
        return;
    }
    let thread = thread::Builder::new()
        .name("progress".into())
        .spawn(move || {
            loop {
                sleep(if terminal { LOOKS } else { LINES });
                if !look(terminal, began.elapsed()) {
                    return;
                }
            }
        });
    // Without a thread it is told by the runs.
    let told = thread.is_err().then(|| began.elapsed());
    *TOLD.lock().unwrap_or_else(PoisonError::into_inner) = told;
}

/// Time of the last line, if runs write them.
static TOLD: Mutex<Option<Duration>> = Mutex::new(None);

/// Tells how far a run is, if no thread does and a line is due.
fn tell_between_ticks() {
    let mut told = TOLD.lock().unwrap_or_else(PoisonError::into_inner);
    let now = BEGAN.elapsed();
    if told.is_some_and(|told| now - told >= LINES) {
        *told = Some(now);
        look(false, now);
    }
}

/// Shows how far the work is; returns false if it has ended.
fn look(terminal: bool, after: Duration) -> bool {
    let line = {
        let stage = STAGE.lock().unwrap_or_else(PoisonError::into_inner);
        if stage.name.is_empty() {
            return false;
        }
        // A run may take some ticks more than it was thought to.
        let most = stage.ticks - stage.ticks / 100;
        BAR.set_position(DONE.load(Ordering::Relaxed).min(most));
        line(&stage, DONE.load(Ordering::Relaxed), after)
    };
    match terminal {
        true => BAR.tick(),
        // Standard error may be closed.
        false => drop(writeln!(stderr(), "{line}")),
    }
    true
}

fn line(stage: &Stage, done: u64, after: Duration) -> String {
    let (name, seconds) = (stage.name, after.as_secs());
    match stage.ticks {
        0 => format!("{seconds} s: {name}"),
        ticks => {
            // A run may take some ticks more than it was thought to.
            let percent = (100.0 * done as f64 / ticks as f64).min(99.0).floor();
            format!("{seconds} s: {name}, {percent} % of {ticks} ticks")
        }
    }
}

/// Prints a stage with its time on standard error, if `--verbose` is set.
pub fn tell(text: &str) {
    if voice::is_verbose() {
        let seconds = BEGAN.elapsed().as_secs_f64();
        // Standard error may be closed.
        let _ = writeln!(stderr(), "{seconds:.3} s: {}", super::plain(text));
    }
}

/// Says what is done from now on, where that is no run.
pub fn stage(name: &'static str) {
    set(Stage { name, ticks: 0 });
}

/// Expected ticks and seconds of runs.
#[derive(Debug, Clone, Copy)]
pub struct Work {
    /// Ticks of one run.
    pub ticks: u64,
    /// Count of runs, each of about that many ticks.
    pub runs: u64,
    /// Approximate duration of all runs without waves, in s.
    pub seconds: f64,
}

/// Announces runs, and the ticks and approximate duration of long ones; `in_waves` ticks go into
/// the waves.
pub fn run(subject: &str, work: Work, in_waves: u64) {
    let Work {
        ticks,
        runs,
        seconds,
    } = work;
    let seconds = seconds + in_waves as f64 * WAVES_NS * 1e-9;
    if seconds >= LONG_S && !voice::is_quiet() {
        let all = match runs {
            1 => String::new(),
            runs => format!(" in each of {runs} runs"),
        };
        let about = about(seconds);
        // Standard error may be closed.
        let subject = super::plain(subject);
        let _ = writeln!(stderr(), "{subject}: {ticks} ticks{all}, about {about}");
    }
    set(Stage {
        name: "running",
        ticks: ticks.saturating_mul(runs).max(1),
    });
}

/// A time for people.
fn about(seconds: f64) -> String {
    match seconds {
        ..120.0 => format!("{seconds:.0} s"),
        ..7200.0 => format!("{:.0} min", seconds / 60.0),
        _ => format!("{:.0} h", seconds / 3600.0),
    }
}

/// Ends the progress report.
pub fn end() {
    STAGE.lock().unwrap_or_else(PoisonError::into_inner).name = "";
    BAR.finish_and_clear();
}

/// One of the runs.
#[derive(Debug, Default)]
pub struct Part {
    /// The tick up to which it is counted.
    counted: u64,
    /// The tick at which it is looked at again.
    due: u64,
}

impl<C: Circuit> Observer<C> for Part {
    fn next_look(&self, tick: u64) -> u64 {
        tick.max(self.due)
    }

    fn needs(&self) -> Needs {
        Needs::NONE
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        if now.tick >= self.due {
            DONE.fetch_add(now.tick - self.counted, Ordering::Relaxed);
            self.counted = now.tick;
            self.due = now.tick + PROGRESS;
            tell_between_ticks();
        }
        Ok(ControlFlow::Continue(()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_what_is_done_and_how_far_it_is() {
        let at = |ticks, done| {
            let name = "running";
            line(&Stage { name, ticks }, done, Duration::from_secs(30))
        };
        assert_eq!(at(0, 0), "30 s: running");
        assert_eq!(at(1000, 0), "30 s: running, 0 % of 1000 ticks");
        assert_eq!(at(1000, 519), "30 s: running, 51 % of 1000 ticks");
        assert_eq!(at(1000, 1200), "30 s: running, 99 % of 1000 ticks");
        let times = [2.0, 119.4, 120.0, 7199.0, 7200.0].map(about);
        assert_eq!(times, ["2 s", "119 s", "2 min", "120 min", "2 h"]);
    }
}
