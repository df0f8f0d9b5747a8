//! References to signals, from Python.

use crate::signal::Signal;
use motion_rtl::Model;
use motion_rtl::sim::{Handle, ModelError, SignalRef};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyString;
use std::borrow::Cow;

/// Signal by its name, or by what `Model.signals` holds.
pub enum Key<'a> {
    Name(Cow<'a, str>),
    Handle(Handle),
}

impl<'a> Key<'a> {
    pub fn of(signal: &'a Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(name) = signal.cast::<PyString>() {
            return Ok(Key::Name(Cow::Borrowed(name.to_str()?)));
        }
        match signal.cast::<Signal>() {
            Ok(signal) => Ok(Key::Handle(signal.get().info().handle)),
            Err(_) => {
                let given = signal.get_type().name()?;
                let text = format!("a signal is a str or a Signal, not {given}");
                Err(PyTypeError::new_err(text))
            }
        }
    }

    /// Returns a key that borrows nothing.
    pub fn owned(self) -> Key<'static> {
        match self {
            Key::Name(name) => Key::Name(Cow::Owned(name.into_owned())),
            Key::Handle(handle) => Key::Handle(handle),
        }
    }
}

impl SignalRef for Key<'_> {
    #[inline]
    fn handle(&self, model: &Model) -> Result<Handle, ModelError> {
        match self {
            Key::Name(name) => model.find(name),
            Key::Handle(handle) => Ok(*handle),
        }
    }
}

/// Returns a whole number: an `int`, a `bool`, or NumPy's.
pub fn number(value: &Bound<'_, PyAny>) -> PyResult<i128> {
    if let Ok(number) = value.extract::<i64>() {
        return Ok(number.into());
    }
    // A bit of NumPy is no integer.
    if let Ok(bit) = value.extract::<bool>() {
        return Ok(bit.into());
    }
    if value.hasattr("__index__")? {
        // An array of one element has the method, and refuses.
        let number = value.call_method0("__index__")?;
        return number.extract::<i128>().map_err(|_| {
            PyValueError::new_err(format!("{number} does not fit; no port has above 64 bits"))
        });
    }
    let given = value.get_type().name()?;
    let text = format!("a value is a whole number or a bool, not {given}");
    Err(PyTypeError::new_err(text))
}

/// Returns a number of ticks.
pub fn ticks(value: &Bound<'_, PyAny>) -> PyResult<u64> {
    let number = number(value)?;
    u64::try_from(number).map_err(|_| {
        let greatest = u64::MAX;
        PyValueError::new_err(format!("ticks: is {number}; allowed: 0 to {greatest}"))
    })
}
