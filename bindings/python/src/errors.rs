//! Errors of the library as exceptions.

use motion_rtl::sim::ModelError;
use pyo3::PyErr;
use pyo3::exceptions::{PyKeyError, PyRuntimeError, PyValueError};
use std::io;

/// Returns the exception for an error: `KeyError` for an unknown name, `OSError` for a file,
/// `RuntimeError` for a call at the wrong time, `ValueError` for everything else.
pub fn exception(error: ModelError) -> PyErr {
    match error {
        ModelError::UnknownCircuit { .. } | ModelError::UnknownSignal { .. } => {
            PyKeyError::new_err(error.to_string())
        }
        ModelError::WavesOn { .. } => PyRuntimeError::new_err(error.to_string()),
        // The wrong extension.
        ModelError::Waves(error) if error.kind() == io::ErrorKind::InvalidInput => {
            PyValueError::new_err(error.to_string())
        }
        ModelError::Waves(error) => error.into(),
        error => PyValueError::new_err(error.to_string()),
    }
}
