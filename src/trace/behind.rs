//! Formatting and writing in a separate thread.

use super::dump::Format;
use super::section::{Section, Tick};
use super::walk::Change;
use std::io;
use std::mem;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{Builder, JoinHandle};

/// Number of sections: one is being filled, one is being written, one is ready for either side.
const SECTIONS: usize = 3;

/// Receiver of the sections of a run, in its thread.
pub(crate) trait Sink: Send + 'static {
    /// Result after everything is written.
    type Out;
    /// Returns the number of changes, and of ticks, at which a section is full. A tick with more
    /// changes makes it longer.
    fn full(&self) -> (usize, usize);
    /// Writes a section.
    fn write(&mut self, section: &Section) -> io::Result<()>;
    /// Writes the rest and returns the result.
    fn finish(self) -> io::Result<Self::Out>;
}

/// Collects changes in sections; a thread takes full sections and returns empty ones.
///
/// The number of sections is fixed: the run waits for the thread. Where there are no threads, the
/// run itself writes them.
#[derive(Debug)]
pub(crate) struct Behind<S> {
    section: Section,
    /// Numbers of changes and of ticks at which it is full.
    at: (usize, usize),
    /// `None` once writing has ended.
    writer: Option<Writer<S>>,
}

#[derive(Debug)]
enum Writer<S> {
    Here(Box<S>),
    Thread {
        /// Channel to the thread, which ends when it is dropped.
        full: SyncSender<Section>,
        spare: Receiver<Section>,
        handle: JoinHandle<io::Result<S>>,
    },
}

impl<S: Sink> Writer<S> {
    fn start(mut sink: S) -> io::Result<Self> {
        if cfg!(target_family = "wasm") {
            return Ok(Writer::Here(Box::new(sink)));
        }
        let (full, work) = sync_channel::<Section>(SECTIONS);
        let (back, spare) = sync_channel(SECTIONS);
        for _ in 1..SECTIONS {
            // The channel has room for all sections, and its other end exists.
            let _ = back.send(Section::default());
        }
        let thread = Builder::new().name("waves".into());
        let handle = thread.spawn(move || {
            for mut section in work {
                sink.write(&section)?;
                section.clear();
                // Fails if the run is over.
                let _ = back.send(section);
            }
            Ok(sink)
        });
        let handle = handle.map_err(|error| {
            let text = format!("a thread for the waves could not be started: {error}");
            io::Error::new(error.kind(), text)
        })?;
        Ok(Writer::Thread {
            full,
            spare,
            handle,
        })
    }
}

impl<S> Writer<S> {
    /// Waits until all sections sent are written.
    fn join(self) -> io::Result<S> {
        match self {
            Writer::Here(sink) => Ok(*sink),
            Writer::Thread { full, handle, .. } => {
                drop(full);
                handle.join().unwrap_or_else(|_| Err(ended()))
            }
        }
    }
}

impl<S: Sink> Behind<S> {
    /// Starts the thread.
    pub fn new(sink: S) -> io::Result<Self> {
        Ok(Behind {
            section: Section::default(),
            at: sink.full(),
            writer: Some(Writer::start(sink)?),
        })
    }

    /// Sends the section to the thread and continues with an empty one.
    ///
    /// # Errors
    /// Returns the error of the sink for an earlier section.
    fn hand_over(&mut self) -> io::Result<()> {
        match &mut self.writer {
            Some(Writer::Here(sink)) => {
                sink.write(&self.section)?;
                self.section.clear();
                Ok(())
            }
            Some(Writer::Thread { full, spare, .. }) => {
                let sent = full.send(mem::take(&mut self.section)).is_ok();
                match (sent, spare.recv()) {
                    (true, Ok(empty)) => {
                        self.section = empty;
                        Ok(())
                    }
                    // The thread ends early only on an error.
                    _ => self.join().and(Err(ended())),
                }
            }
            None => Err(ended()),
        }
    }

    fn join(&mut self) -> io::Result<S> {
        self.writer
            .take()
            .map_or_else(|| Err(ended()), Writer::join)
    }
}

impl<S: Sink> Format for Behind<S> {
    type Out = S::Out;

    fn tick(&mut self, rise: u64, fall: u64, changes: &[Change]) -> io::Result<()> {
        let section = &mut self.section;
        section.changes.extend_from_slice(changes);
        section.ticks.push(Tick {
            rise,
            fall,
            changes: section.changes.len(),
        });
        let (changes, ticks) = self.at;
        if section.changes.len() >= changes || section.ticks.len() >= ticks {
            self.hand_over()?;
        }
        Ok(())
    }

    fn finish(mut self, end: Option<u64>) -> io::Result<S::Out> {
        self.section.end = end;
        self.hand_over()?;
        self.join()?.finish()
    }
}

impl<S> Drop for Behind<S> {
    /// Waits for the thread, so that the sink is dropped too.
    fn drop(&mut self) {
        if let Some(writer) = self.writer.take() {
            // Without `finish`, nobody wants the result.
            let _ = writer.join();
        }
    }
}

fn ended() -> io::Error {
    io::Error::other("the writing thread has ended")
}
