//! Waves of the last ticks before a test fails.

use super::dump::Format;
use super::layout::Layout;
use super::walk::{Change, Walk};
use super::{Clock, FOCUS, LayoutError, VcdFile, gtkw};
use crate::files::{AtomicFile, Directory, commit_all};
use crate::hdl::Circuit;
use crate::sim::{Described, LeafView as View, RunError, Simulator};
use std::cell::Cell;
use std::collections::VecDeque;
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Keeps the last ticks of a simulator, and writes their waves if a panic drops it.
///
/// A test asks for them with one line. If it fails, standard error has the path of a VCD with the
/// last [`TICKS`](Self::TICKS) ticks, up to the one that failed, and a GTKWave save file lies
/// beside it. Time stamps are those of the whole run. A test that passes writes nothing.
///
/// Keep the simulator in a variable until the last assertion. Copies of a simulator keep no ticks.
/// In a property test use `assert!`: `prop_assert!` drops the simulator before the test fails.
///
/// ```
/// use motion_rtl::circuits::blocks::EnableCounter;
/// use motion_rtl::trace::LastTicks;
///
/// let mut counter = LastTicks::simulator(&EnableCounter { width: 8 })?;
/// counter.set(|i| i.period, 4)?;
/// for tick in 0..1000 {
///     assert_eq!(counter.see(|s| s.w.enable), tick % 4 == 3);
///     counter.step();
/// }
/// # Ok::<(), motion_rtl::sim::RunError>(())
/// ```
///
/// The files are `failed/<test>.vcd` and `.gtkw` in Cargo's target directory, with `.` for `::` in
/// the name of the test; a second simulator of the test adds `-2`. A program that Cargo did not
/// build writes to the directory for temporary files.
#[derive(Debug)]
#[must_use]
pub struct LastTicks {
    layout: Layout,
    clock: Clock,
    walk: Walk,
    /// Values in the tick before the first kept one.
    before: Vec<u64>,
    kept: VecDeque<Kept>,
    most: usize,
    directory: Option<PathBuf>,
}

/// Changes of a tick, and its times.
#[derive(Debug, Default)]
struct Kept {
    tick: u64,
    rise: u64,
    fall: u64,
    changes: Vec<Change>,
}

thread_local! {
    /// Number of waves that this thread wrote since it last made a simulator.
    static WRITTEN: Cell<usize> = const { Cell::new(0) };
}

impl LastTicks {
    /// Number of ticks that [`simulator`](Self::simulator) keeps.
    pub const TICKS: usize = 200;

    /// Creates a simulator at power-on that keeps its last [`TICKS`](Self::TICKS) ticks.
    ///
    /// # Errors
    /// Returns all mistakes of the circuit, or an error if a name cannot be written.
    pub fn simulator<C: Circuit>(circuit: &C) -> Result<Simulator<C>, RunError> {
        let mut simulator = Simulator::new(circuit)?;
        let last = LastTicks::new(circuit, Self::TICKS).map_err(io::Error::from)?;
        last.keep(&mut simulator);
        Ok(simulator)
    }

    /// Prepares to keep the last `ticks` ticks of a circuit, at least one.
    ///
    /// # Errors
    /// Returns an error if a name is duplicate in a scope or cannot be written.
    pub fn new(circuit: &impl Described, ticks: usize) -> Result<Self, LayoutError> {
        WRITTEN.set(0);
        let (layout, clock) = (Layout::of(circuit, None)?, Clock::default());
        Ok(LastTicks {
            walk: Walk::new(&layout, clock),
            before: vec![0; layout.leaves.len()],
            kept: VecDeque::new(),
            most: ticks.max(1),
            directory: None,
            layout,
            clock,
        })
    }

    /// Sets the clock of the time stamps; 1 MHz by default.
    pub fn with_clock(mut self, clock: Clock) -> Self {
        self.walk = Walk::new(&self.layout, clock);
        self.clock = clock;
        self
    }

    /// Sets the directory of the files.
    pub fn with_directory(mut self, directory: impl Into<PathBuf>) -> Self {
        self.directory = Some(directory.into());
        self
    }

    /// Keeps the ticks of a simulator from this one on.
    pub fn keep<C: Circuit>(mut self, simulator: &mut Simulator<C>) {
        simulator.each_tick(move |now| self.take(now.tick, now.view()));
    }

    fn take(&mut self, tick: u64, view: View<'_>) {
        // A tick that comes twice, or whose time does not fit into 64 bits, is left out.
        let Ok((rise, fall)) = self.walk.tick(tick, view) else {
            return;
        };
        let mut oldest = match self.kept.len() < self.most {
            true => Kept::default(),
            false => self.kept.pop_front().unwrap_or_default(),
        };
        for change in oldest.changes.drain(..) {
            self.before[change.leaf as usize] = change.bits;
        }
        oldest.changes.extend_from_slice(self.walk.changes());
        self.kept.push_back(Kept {
            tick,
            rise,
            fall,
            ..oldest
        });
    }

    /// Returns the kept ticks.
    fn ticks(&self) -> Range<u64> {
        let (first, last) = (self.kept.front(), self.kept.back());
        let tick = |kept: Option<&Kept>| kept.map_or(0, |kept| kept.tick);
        tick(first)..tick(last) + 1
    }

    /// Writes the VCD and its save file; returns their paths.
    fn write(&mut self, stem: &Path) -> io::Result<Vec<PathBuf>> {
        let _directory = stem.parent().map(Directory::create).transpose()?;
        // A name may have dots.
        let path = |suffix: &str| PathBuf::from(format!("{}.{suffix}", stem.display()));
        let mut dump = AtomicFile::create(path("vcd"))?;
        let name = dump.path().file_name().unwrap_or_default();
        let name = name.to_string_lossy().into_owned();
        let mut file = VcdFile::new(&mut dump, &self.layout, self.clock);
        for (index, kept) in self.kept.iter_mut().enumerate() {
            if index == 0 {
                for change in kept.changes.drain(..) {
                    self.before[change.leaf as usize] = change.bits;
                }
                let all = (0..).zip(&self.before);
                kept.changes
                    .extend(all.map(|(leaf, &bits)| Change { leaf, bits }));
            }
            file.tick(kept.rise, kept.fall, &kept.changes)?;
        }
        Format::finish(file, self.walk.end()?)?;

        let ticks = self.ticks();
        let focus = ticks.end.saturating_sub(FOCUS).max(ticks.start)..ticks.end;
        let save = gtkw::save(&self.layout, self.clock, &name, focus, &[]);
        let mut save_file = AtomicFile::create(path("gtkw"))?;
        save_file.write_all(save.as_bytes())?;
        commit_all([dump, save_file])
    }
}

impl Drop for LastTicks {
    fn drop(&mut self) {
        if !std::thread::panicking() || self.kept.is_empty() {
            return;
        }
        let directory = self.directory.take().unwrap_or_else(directory);
        let stem = directory.join(stem(&self.layout.top.name));
        let Range { start, end } = self.ticks();
        match self.write(&stem).as_deref() {
            Ok([waves, save]) => eprintln!(
                "waves of ticks {start} to {}: {}\nopen them with: gtkwave {}",
                end - 1,
                waves.display(),
                save.display()
            ),
            Ok(_) => (),
            Err(error) => eprintln!("the waves of the last ticks could not be written: {error}"),
        }
    }
}

/// Returns the name of the files: that of the test, which is the name of its thread, or that of
/// the circuit on the main thread.
fn stem(circuit: &str) -> String {
    let count = WRITTEN.get() + 1;
    WRITTEN.set(count);
    let thread = std::thread::current();
    let name = thread.name().filter(|name| *name != "main");
    let name = name.unwrap_or(circuit).replace("::", ".");
    let plain = |letter: char| match letter.is_alphanumeric() || "._-".contains(letter) {
        true => letter,
        false => '_',
    };
    let name: String = name.chars().map(plain).collect();
    match count {
        1 => name,
        _ => format!("{name}-{count}"),
    }
}

/// Returns the directory of the files: `failed` in the target directory of the running program.
fn directory() -> PathBuf {
    let program = std::env::current_exe().unwrap_or_default();
    let mut around = program.ancestors();
    let target = around.find(|path| path.join("CACHEDIR.TAG").is_file());
    let target = target.map_or_else(std::env::temp_dir, Path::to_owned);
    target.join("failed")
}
