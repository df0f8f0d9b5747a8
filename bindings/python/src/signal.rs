//! Descriptions of signals.

use motion_rtl::netlist::{Format, Kind, Role};
use motion_rtl::sim::{PortDirection, SignalInfo};
use pyo3::prelude::*;
use pyo3::types::PyBool;
use std::sync::Arc;

/// Description of a signal of a model.
///
/// It stands for the signal in place of its name, in any model of an equal circuit, and saves the
/// search: ``m[signal]``.
#[pyclass(frozen, module = "motion_rtl")]
pub struct Signal {
    all: Arc<Vec<SignalInfo>>,
    index: usize,
}

impl Signal {
    pub fn new(all: &Arc<Vec<SignalInfo>>, index: usize) -> Self {
        let all = all.clone();
        Signal { all, index }
    }

    pub fn info(&self) -> &SignalInfo {
        &self.all[self.index]
    }
}

/// Returns bits as a number: a `bool` for a bit, else an `int`.
pub fn value(py: Python<'_>, kind: Kind, width: usize, bits: u64) -> PyResult<Bound<'_, PyAny>> {
    Ok(match kind {
        Kind::Bit => PyBool::new(py, bits != 0).to_owned().into_any(),
        Kind::Unsigned => bits.into_pyobject(py)?.into_any(),
        Kind::Signed => {
            let above = 64 - width as u32;
            let number = (bits << above) as i64 >> above;
            number.into_pyobject(py)?.into_any()
        }
    })
}

#[pymethods]
impl Signal {
    /// Path below the circuit, with dots between scopes; a word of a memory is ``memory[3]``.
    #[getter]
    fn path(&self) -> &str {
        &self.info().path
    }

    /// Hierarchical name below the circuit's Verilog module.
    #[getter]
    fn verilog(&self) -> &str {
        &self.info().verilog
    }

    /// Role in its own circuit: ``"input"``, ``"register"`` or ``"net"``.
    #[getter]
    fn role(&self) -> &'static str {
        match self.info().role {
            Role::Input => "input",
            Role::Register => "register",
            Role::Net => "net",
        }
    }

    /// Direction if the signal is a port of the model's circuit: ``"in"`` or ``"out"``.
    #[getter]
    fn port(&self) -> Option<&'static str> {
        self.info().port.map(|port| match port {
            PortDirection::In => "in",
            PortDirection::Out => "out",
        })
    }

    /// Kind of its values: ``"bit"``, ``"unsigned"`` or ``"signed"``.
    #[getter]
    fn kind(&self) -> &'static str {
        match self.info().shape.kind {
            Kind::Bit => "bit",
            Kind::Unsigned => "unsigned",
            Kind::Signed => "signed",
        }
    }

    /// Width in bits, 1 to 64.
    #[getter]
    fn width(&self) -> usize {
        self.info().width()
    }

    /// True if the signal is a two's complement number.
    #[getter]
    fn signed(&self) -> bool {
        self.info().is_signed()
    }

    /// Least value.
    #[getter]
    fn least(&self) -> i128 {
        self.info().shape.range().0
    }

    /// Greatest value.
    #[getter]
    fn greatest(&self) -> i128 {
        self.info().shape.range().1
    }

    /// Display format: ``"decimal"``, ``"hex"``, ``"analog"`` or ``"states"``.
    #[getter]
    fn format(&self) -> &'static str {
        match self.info().format {
            Format::Hex => "hex",
            Format::Analog => "analog",
            Format::States(_) => "states",
            _ => "decimal",
        }
    }

    /// Names of the states, of which the value is an index; empty for other signals.
    #[getter]
    fn states(&self) -> Vec<&'static str> {
        match self.info().format {
            Format::States(names) => names.to_vec(),
            _ => Vec::new(),
        }
    }

    /// Documentation in one line, with the unit; may be empty.
    #[getter]
    fn doc(&self) -> &str {
        &self.info().doc
    }

    /// Value at power-on, settled with all input ports low.
    #[getter]
    fn power_on<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let info = self.info();
        value(py, info.shape.kind, info.width(), info.power_on)
    }

    fn __repr__(&self) -> String {
        let info = self.info();
        let role = match info.port {
            Some(PortDirection::In) => "port in",
            Some(PortDirection::Out) => "port out",
            None => self.role(),
        };
        let shape = match (info.shape.kind, info.width()) {
            (Kind::Bit, _) => "bit".to_owned(),
            (Kind::Unsigned, width) => format!("unsigned, {width} bits"),
            (Kind::Signed, width) => format!("signed, {width} bits"),
        };
        let doc = match info.doc.as_str() {
            "" => String::new(),
            doc => format!(": {doc}"),
        };
        format!("<Signal {}, {role}, {shape}{doc}>", info.path)
    }
}
