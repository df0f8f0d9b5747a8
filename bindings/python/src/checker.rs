//! Checkers, which simulators written in Python drive.

use crate::errors::exception;
use crate::model::Model;
use motion_rtl::checker::{self, CheckerError, Options, Place, Verdict};
use motion_rtl::compare::Map;
use motion_rtl::input::Fault;
use motion_rtl::sim::PortDirection;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyString};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// Returns the ports of a model's circuit, and the ports that a map leaves out: path, direction,
/// width, and the name in the design: the
/// expression of the map, or the name in Verilog.
///
/// A map is the path of a file, or its text with a name for messages.
#[pyfunction]
#[pyo3(name = "_bound_ports", signature = (model, map=None, text=None))]
#[allow(clippy::type_complexity, reason = "tuples are what Python takes")]
pub fn bound_ports(
    py: Python<'_>,
    model: &Model,
    map: Option<PathBuf>,
    text: Option<&str>,
) -> PyResult<(Vec<(String, &'static str, usize, String)>, Vec<String>)> {
    let wrong = |fault: Fault| PyValueError::new_err(fault.to_string());
    let map = match (map, text) {
        (Some(path), None) => Map::read(&path).map_err(wrong)?,
        (_, text) => Map::parse("map", text.unwrap_or_default()).map_err(wrong)?,
    };
    let model = model.copied(py)?;
    let bound = map.bound(&model).map_err(wrong)?;
    let ports = model.signals().into_iter().filter_map(|signal| {
        let direction = match signal.port? {
            PortDirection::In => "in",
            PortDirection::Out => "out",
        };
        let partner = bound.ports.iter().find(|(path, _)| *path == signal.path);
        let name = partner.map_or(&signal.verilog, |(_, expression)| expression);
        Some((signal.path.clone(), direction, signal.width(), name.clone()))
    });
    let ports = ports.filter(|port| !bound.left.contains(&port.0)).collect();
    Ok((ports, bound.left))
}

/// Model beside a design whose ports come as digits.
#[pyclass(frozen, module = "motion_rtl", name = "_Checker")]
pub struct Checker(Mutex<Running>);

struct Running {
    checker: checker::Checker,
    ports: Vec<Port>,
    words: Vec<u64>,
}

/// Port of the design.
struct Port {
    place: Place,
    is_inverted: bool,
    /// Digits of the signal that are the port.
    digits: Range<usize>,
    /// Digits of the last tick, whose bits are in the words; empty if some were unknown.
    last: Vec<u8>,
}

impl Port {
    /// Puts digits into the words of the tick. Returns false if some are unknown; the bits are 0
    /// then.
    #[inline]
    fn put(&mut self, digits: &[u8], words: &mut [u64]) -> bool {
        // Most ports keep their value.
        if digits == self.last {
            return true;
        }
        let bits = word(digits);
        self.last.clear();
        if bits.is_some() {
            self.last.extend_from_slice(digits);
        }
        let inverted = bits.map(|bits| if self.is_inverted { !bits } else { bits });
        let (mask, word) = (self.place.mask(), &mut words[self.place.word]);
        *word = *word & !mask | inverted.unwrap_or(0) << self.place.low & mask;
        bits.is_some()
    }
}

#[pymethods]
impl Checker {
    /// Puts a copy of a model beside a design. `ports` are inversion, first digit and last digit,
    /// exclusive, of each port that is not left out: input ports, then output ports.
    #[new]
    #[pyo3(signature = (model, ports, leave, from_power_on, waves))]
    fn new(
        py: Python<'_>,
        model: &Model,
        ports: Vec<(bool, usize, usize)>,
        leave: Vec<String>,
        from_power_on: bool,
        waves: Option<PathBuf>,
    ) -> PyResult<Self> {
        let options = Options {
            leave,
            from_power_on,
            waves,
        };
        let checker = checker::Checker::new(model.copied(py)?, &options).map_err(refused)?;
        let words = checker.words();
        let places: Vec<Place> = words.inputs.iter().chain(&words.outputs).copied().collect();
        if places.len() != ports.len() {
            let text = format!("{} ports given; allowed: {}", ports.len(), places.len());
            return Err(PyValueError::new_err(text));
        }
        let words = vec![0; words.words];
        let port = |(place, (is_inverted, first, end))| Port {
            place,
            is_inverted,
            digits: first..end,
            last: Vec::new(),
        };
        Ok(Checker(Mutex::new(Running {
            checker,
            ports: places.into_iter().zip(ports).map(port).collect(),
            words,
        })))
    }

    /// Passes a rising edge of the clock: the digits of the reset, which is inverted if `inverts`
    /// is true, and those of each port. Returns what there is to say, or `None`.
    fn edge(
        &self,
        reset: &str,
        inverts: bool,
        values: &Bound<'_, PyList>,
    ) -> PyResult<Option<String>> {
        let mut running = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let Running {
            checker,
            ports,
            words,
        } = &mut *running;
        if values.len() != ports.len() {
            let text = format!("{} values given; allowed: {}", values.len(), ports.len());
            return Err(PyValueError::new_err(text));
        }
        for (index, (port, value)) in ports.iter_mut().zip(values.iter()).enumerate() {
            let text = value.cast::<PyString>()?.to_str()?;
            let Some(digits) = text.as_bytes().get(port.digits.clone()) else {
                let text = format!("port {index}: has the digits {text}, which are too few");
                return Err(PyValueError::new_err(text));
            };
            if !port.put(digits, words) {
                checker.unknown(Some(index), &text[port.digits.clone()]);
            }
        }
        let rst = match word(reset.as_bytes()) {
            Some(bit) => (bit != 0) != inverts,
            None => {
                checker.unknown(None, reset);
                false
            }
        };
        let says = checker.edge(rst, words).map_err(refused)?;
        Ok(says.then(|| checker.take_text()))
    }

    /// Ends the comparison: returns `"PASS"`, `"FAIL"` or `"VACUOUS"`, and the report.
    fn end(&self) -> (&'static str, String) {
        let mut running = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let verdict = match running.checker.end() {
            Verdict::Pass => "PASS",
            Verdict::Fail => "FAIL",
            Verdict::Vacuous => "VACUOUS",
        };
        (verdict, running.checker.take_text())
    }
}

fn refused(error: CheckerError) -> PyErr {
    match error {
        CheckerError::Model(error) => exception(error),
        error => PyValueError::new_err(error.to_string()),
    }
}

/// Returns binary digits as a word, the highest first; `None` if one is unknown. L and H of VHDL
/// are 0 and 1.
#[inline]
fn word(digits: &[u8]) -> Option<u64> {
    let mut word = 0;
    for digit in digits {
        let bit = match digit {
            b'0' | b'L' | b'l' => 0,
            b'1' | b'H' | b'h' => 1,
            _ => return None,
        };
        word = word << 1 | bit;
    }
    Some(word)
}
