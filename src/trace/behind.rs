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
/// The number of sections is fixed: the run waits for the thread.
#[derive(Debug)]
pub(crate) struct Behind<S> {
    section: Section,
    /// Numbers of changes and of ticks at which it is full.
    at: (usize, usize),
    /// Channel to the thread; `None` once the thread is to end.
    full: Option<SyncSender<Section>>,
    spare: Receiver<Section>,
    /// Handle of the thread; `None` once it has ended.
    thread: Option<JoinHandle<io::Result<S>>>,
}

impl<S: Sink> Behind<S> {
    /// Starts the thread.
    pub fn new(mut sink: S) -> io::Result<Self> {
        let (full, work) = sync_channel::<Section>(SECTIONS);
        let (back, spare) = sync_channel(SECTIONS);
        for _ in 1..SECTIONS {
            // The channel has room for all sections, and its other end exists.
            let _ = back.send(Section::default());
        }
        let at = sink.full();
        let thread = Builder::new().name("waves".into());
        let thread = thread.spawn(move || {
            for mut section in work {
                sink.write(&section)?;
                section.clear();
                // Fails if the run is over.
                let _ = back.send(section);
            }
            Ok(sink)
        });
        let thread = thread.map_err(|error| {
            let text = format!("a thread for the waves could not be started: {error}");
            io::Error::new(error.kind(), text)
        })?;
        Ok(Behind {
            section: Section::default(),
            at,
            full: Some(full),
            spare,
            thread: Some(thread),
        })
    }

    /// Sends the section to the thread and continues with an empty one.
    ///
    /// # Errors
    /// Returns the error of the sink for an earlier section.
    fn hand_over(&mut self) -> io::Result<()> {
        let full = mem::take(&mut self.section);
        let sent = self.full.as_ref().is_some_and(|to| to.send(full).is_ok());
        match (sent, self.spare.recv()) {
            (true, Ok(empty)) => {
                self.section = empty;
                Ok(())
            }
            // The thread ends early only on an error.
            _ => self.join().and(Err(ended())),
        }
    }

    /// Waits until all sections sent are written.
    fn join(&mut self) -> io::Result<S> {
        self.full = None;
        match self.thread.take().map(JoinHandle::join) {
            Some(Ok(result)) => result,
            Some(Err(_)) | None => Err(ended()),
        }
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
        self.full = None;
        if let Some(thread) = self.thread.take() {
            // Without `finish`, nobody wants the result.
            let _ = thread.join();
        }
    }
}

fn ended() -> io::Error {
    io::Error::other("the writing thread has ended")
}
