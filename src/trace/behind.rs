//! Writing on a thread of its own.

use std::io::{self, Write};
use std::mem;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{Builder, JoinHandle};

/// Buffers under way: one is filled, one is written, one lies ready for whoever is first.
const BUFFERS: usize = 3;
/// Bytes in a buffer of a [`WriteBehind`].
const BYTES: usize = 256 * 1024;

/// A thread that takes full buffers and gives empty ones back.
///
/// There are no more buffers than those it began with: who fills them waits for the thread.
#[derive(Debug)]
pub(super) struct Behind<B, S> {
    /// Gone once the thread is to end.
    full: Option<SyncSender<B>>,
    spare: Receiver<B>,
    /// Gone once it has ended.
    thread: Option<JoinHandle<io::Result<S>>>,
}

impl<B: Default + Send + 'static, S: Send + 'static> Behind<B, S> {
    /// Starts the thread; `take` writes a buffer to the sink and empties it.
    pub fn new(
        mut sink: S,
        mut take: impl FnMut(&mut S, &mut B) -> io::Result<()> + Send + 'static,
    ) -> io::Result<Self> {
        let (full, work) = sync_channel::<B>(BUFFERS);
        let (back, spare) = sync_channel(BUFFERS);
        for _ in 1..BUFFERS {
            // The channel has room for all of them, and its other end is here.
            let _ = back.send(B::default());
        }
        let thread = Builder::new().name("waves".into()).spawn(move || {
            for mut buffer in work {
                take(&mut sink, &mut buffer)?;
                // Fails when nobody fills any more.
                let _ = back.send(buffer);
            }
            Ok(sink)
        })?;
        Ok(Behind {
            full: Some(full),
            spare,
            thread: Some(thread),
        })
    }

    /// Hands the buffer over and puts an empty one in its place.
    ///
    /// # Errors
    /// That of the sink, with an earlier buffer.
    pub fn hand_over(&mut self, buffer: &mut B) -> io::Result<()> {
        let full = mem::take(buffer);
        let sent = self.full.as_ref().is_some_and(|to| to.send(full).is_ok());
        match (sent, self.spare.recv()) {
            (true, Ok(empty)) => {
                *buffer = empty;
                Ok(())
            }
            // It ends early only with an error.
            _ => self.join().and(Err(ended())),
        }
    }

    /// Waits until everything is written and returns the sink.
    ///
    /// # Errors
    /// That of the sink.
    pub fn finish(mut self) -> io::Result<S> {
        self.join()
    }

    fn join(&mut self) -> io::Result<S> {
        self.full = None;
        match self.thread.take().map(JoinHandle::join) {
            Some(Ok(result)) => result,
            Some(Err(_)) | None => Err(ended()),
        }
    }
}

impl<B, S> Drop for Behind<B, S> {
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

/// A writer whose bytes a thread of its own writes: [`Vcd`](super::Vcd) then formats while the
/// file is being written.
///
/// It holds three buffers of 256 KiB at most, and waits where the file is slower. Call
/// [`finish`](WriteBehind::finish) at the end: what was written last may fail only there.
#[derive(Debug)]
#[must_use]
pub struct WriteBehind<W> {
    buffer: Vec<u8>,
    behind: Behind<Vec<u8>, W>,
}

impl<W: Write + Send + 'static> WriteBehind<W> {
    /// Starts the thread that writes to `out`.
    ///
    /// # Errors
    /// There is no thread to be had.
    pub fn new(out: W) -> io::Result<Self> {
        let behind = Behind::new(out, |out: &mut W, bytes: &mut Vec<u8>| {
            out.write_all(bytes)?;
            bytes.clear();
            Ok(())
        })?;
        Ok(WriteBehind {
            buffer: Vec::new(),
            behind,
        })
    }

    /// Waits until everything is written, flushes the writer and returns it.
    ///
    /// # Errors
    /// The writer failed. It is gone then.
    pub fn finish(mut self) -> io::Result<W> {
        self.flush()?;
        let mut out = self.behind.finish()?;
        out.flush()?;
        Ok(out)
    }
}

impl<W: Write + Send + 'static> Write for WriteBehind<W> {
    /// # Errors
    /// The writer failed with earlier bytes.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.buffer.is_empty() {
            self.buffer.reserve(BYTES);
        }
        let taken = bytes.len().min(BYTES - self.buffer.len());
        self.buffer.extend_from_slice(&bytes[..taken]);
        if self.buffer.len() == BYTES {
            self.behind.hand_over(&mut self.buffer)?;
        }
        Ok(taken)
    }

    /// Hands over what there is; does not wait until it is written.
    fn flush(&mut self) -> io::Result<()> {
        match self.buffer.is_empty() {
            true => Ok(()),
            false => self.behind.hand_over(&mut self.buffer),
        }
    }
}
