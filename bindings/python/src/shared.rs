//! Models that threads use one at a time.

use crate::errors::exception;
use motion_rtl::Model;
use motion_rtl::sim::ModelError;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use std::ops::Range;
use std::process;
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread::{self, ThreadId};

/// Ticks between two looks for Ctrl-C.
const PIECE: u64 = 1 << 14;

/// Ticks that run without letting other threads in: too few to be worth it.
const FEW: u64 = 64;

/// A running circuit behind a lock.
pub struct Shared {
    model: Mutex<Model>,
    /// Thread in a call that lets other Python code run meanwhile.
    holder: Mutex<Option<Holder>>,
}

/// Thread and its process, of which a fork has none.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Holder {
    thread: ThreadId,
    process: u32,
}

/// A call that lets other Python code run, such as a signal handler.
struct Held<'s>(&'s Mutex<Option<Holder>>);

impl Holder {
    fn this_thread() -> Self {
        Holder {
            thread: thread::current().id(),
            process: process::id(),
        }
    }
}

impl<'s> Held<'s> {
    fn by_this_thread(holder: &'s Mutex<Option<Holder>>) -> Self {
        *holder.lock().unwrap_or_else(PoisonError::into_inner) = Some(Holder::this_thread());
        Held(holder)
    }
}

impl Drop for Held<'_> {
    fn drop(&mut self) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }
}

impl Shared {
    pub fn new(model: Model) -> Self {
        Shared {
            model: Mutex::new(model),
            holder: Mutex::new(None),
        }
    }

    /// Waits until no other thread uses the model. Nothing of Python may be called with the guard.
    ///
    /// # Errors
    /// The model is in the middle of a call of this thread, or was so of another thread when this
    /// process was forked, or one of its calls panicked.
    pub fn lock(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Model>> {
        match self.model.try_lock() {
            Ok(model) => return Ok(model),
            Err(TryLockError::Poisoned(_)) => return Err(broken()),
            Err(TryLockError::WouldBlock) => {}
        }
        let holder = *self.holder.lock().unwrap_or_else(PoisonError::into_inner);
        let this = Holder::this_thread();
        if holder.is_some_and(|holder| holder.process != this.process) {
            let text = "the process was forked while another thread was in a call of the model; \
                        a copy() made before the fork can be used";
            return Err(PyRuntimeError::new_err(text));
        }
        if holder == Some(this) {
            let text = "the model is in the middle of a call of this thread; \
                        a signal handler or finalizer cannot use it";
            return Err(PyRuntimeError::new_err(text));
        }
        self.model.lock_py_attached(py).map_err(|_| broken())
    }

    /// Makes a call in which other threads of Python run.
    pub fn detached<T: Send>(
        &self,
        py: Python<'_>,
        call: impl FnOnce(&mut Model) -> Result<T, ModelError> + Send,
    ) -> PyResult<T> {
        let mut model = self.lock(py)?;
        let _held = Held::by_this_thread(&self.holder);
        let model = &mut *model;
        py.detach(|| call(model)).map_err(exception)
    }

    /// Runs ticks in pieces; `begin` comes first. Other threads of Python run meanwhile, and Ctrl-C
    /// ends the run after a piece.
    pub fn run<T: Send>(
        &self,
        py: Python<'_>,
        ticks: u64,
        begin: impl FnOnce(&mut Model) -> PyResult<T> + Send,
        mut piece: impl FnMut(&mut Model, &mut T, Range<u64>) -> Result<(), ModelError> + Send,
    ) -> PyResult<T> {
        let mut guard = self.lock(py)?;
        let _held = Held::by_this_thread(&self.holder);
        let model = &mut *guard;
        let mut state = py.detach(|| begin(model))?;
        let mut done = 0;
        while done < ticks {
            let end = ticks.min(done + PIECE);
            let (model, state) = (&mut *guard, &mut state);
            py.detach(|| piece(model, state, done..end))
                .map_err(exception)?;
            done = end;
            if done < ticks {
                py.check_signals()?;
            }
        }
        Ok(state)
    }

    /// Advances by ticks with constant inputs.
    pub fn step(&self, py: Python<'_>, ticks: u64) -> PyResult<()> {
        if ticks <= FEW {
            let mut model = self.lock(py)?;
            match ticks {
                1 => model.step(),
                ticks => model.run(ticks),
            }
            return Ok(());
        }
        let piece = |model: &mut Model, (): &mut (), piece: Range<u64>| {
            model.run(piece.end - piece.start);
            Ok(())
        };
        self.run(py, ticks, |_| Ok(()), piece)
    }
}

fn broken() -> PyErr {
    PyRuntimeError::new_err("a call of the model panicked; its state is lost")
}
