//! States of models.

use motion_rtl::sim;
use pyo3::prelude::*;

/// State of a model in a tick: input ports, registers and memories.
///
/// ``Model.snapshot()`` makes it.
#[pyclass(frozen, module = "motion_rtl")]
pub struct Snapshot {
    circuit: &'static str,
    state: sim::Snapshot,
}

impl Snapshot {
    pub fn new(circuit: &'static str, state: sim::Snapshot) -> Self {
        Snapshot { circuit, state }
    }

    pub fn state(&self) -> &sim::Snapshot {
        &self.state
    }
}

#[pymethods]
impl Snapshot {
    /// Number of the tick.
    #[getter]
    fn tick(&self) -> u64 {
        self.state.tick()
    }

    fn __repr__(&self) -> String {
        format!("<Snapshot of {}, tick {}>", self.circuit, self.state.tick())
    }
}
