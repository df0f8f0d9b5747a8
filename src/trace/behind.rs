//! Formatting and writing on a thread of its own.

use super::dump::Format;
use super::section::{Section, Tick};
use super::walk::Change;
use std::io;
use std::mem;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{Builder, JoinHandle};

/// Sections under way: one is gathered, one is written, one lies ready for whoever is first.
const SECTIONS: usize = 3;

/// What a thread makes of a run.
pub(crate) trait Sink: Send + 'static {
    /// Changes from which on a section is full. It is longer where a tick has more.
    const CHANGES: usize;
    /// Ticks from which on it is full.
    const TICKS: usize;
    /// What is left when everything is written.
    type Out;
    /// Writes a section.
    fn write(&mut self, section: &Section) -> io::Result<()>;
    /// Writes what is left.
    fn finish(self) -> io::Result<Self::Out>;
}

/// Gathers what changes in sections, for a thread that takes full ones and gives empty ones back.
///
/// There are no more sections than those it began with: the run waits for the thread.
#[derive(Debug)]
pub(crate) struct Behind<S> {
    section: Section,
    /// Gone once the thread is to end.
    full: Option<SyncSender<Section>>,
    spare: Receiver<Section>,
    /// Gone once it has ended.
    thread: Option<JoinHandle<io::Result<S>>>,
}

impl<S: Sink> Behind<S> {
    /// Starts the thread.
    pub fn new(mut sink: S) -> io::Result<Self> {
        let (full, work) = sync_channel::<Section>(SECTIONS);
        let (back, spare) = sync_channel(SECTIONS);
        for _ in 1..SECTIONS {
            // The channel has room for all of them, and its other end is here.
            let _ = back.send(Section::default());
        }
        let thread = Builder::new().name("waves".into());
        let thread = thread.spawn(move || {
            for mut section in work {
                sink.write(&section)?;
                section.clear();
                // Fails when nobody gathers any more.
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
            full: Some(full),
            spare,
            thread: Some(thread),
        })
    }

    /// Hands the section over and puts an empty one in its place.
    ///
    /// # Errors
    /// That of the sink, with an earlier section.
    fn hand_over(&mut self) -> io::Result<()> {
        let full = mem::take(&mut self.section);
        let sent = self.full.as_ref().is_some_and(|to| to.send(full).is_ok());
        match (sent, self.spare.recv()) {
            (true, Ok(empty)) => {
                self.section = empty;
                Ok(())
            }
            // It ends early only with an error.
            _ => self.join().and(Err(ended())),
        }
    }

    /// Waits until everything that was handed over is written.
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
        if section.changes.len() >= S::CHANGES || section.ticks.len() >= S::TICKS {
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
    /// Waits for the thread, so that the sink is gone too.
    fn drop(&mut self) {
        self.full = None;
        if let Some(thread) = self.thread.take() {
            // Who drops it unfinished wants no result.
            let _ = thread.join();
        }
    }
}

fn ended() -> io::Error {
    io::Error::other("the writing thread has ended")
}
