//! Comparison of two waveforms.

use motion_rtl::compare::{self as waves, Map, Settings};
use motion_rtl::input::Fault;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::{Path, PathBuf};

/// Result of comparing two waveforms; true if they are equal.
#[pyclass(frozen, module = "motion_rtl")]
pub struct Report(waves::Report);

#[pymethods]
impl Report {
    /// True if nothing differs and every output port was compared or left out by name.
    #[getter]
    fn equal(&self) -> bool {
        self.0.is_equal()
    }

    /// True if neither file has ticks after the other's last one.
    #[getter]
    fn same_length(&self) -> bool {
        self.0.same_length()
    }

    /// Returns all fields of the report, by the names that ``motion-rtl compare --json`` has.
    ///
    /// Returns
    /// -------
    /// dict
    fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = serde_json::to_string(&self.0);
        let text = text.map_err(|error| PyValueError::new_err(error.to_string()))?;
        py.import("json")?.call_method1("loads", (text,))
    }

    fn __bool__(&self) -> bool {
        self.0.is_equal()
    }

    fn __str__(&self) -> String {
        self.0.to_string()
    }

    fn __repr__(&self) -> String {
        let equal = match self.0.is_equal() {
            true => "equal",
            false => "not equal",
        };
        let waves::Report { ticks, signals, .. } = self.0;
        format!("<Report {equal}, {ticks} ticks, {signals} signals>")
    }
}

/// Compares two waveform files, tick by tick: VCD, FST or GHW.
///
/// Parameters
/// ----------
/// golden : path
///     Waves of this package or of the program ``motion-rtl``.
/// other : path
///     Waves of a simulator.
/// clock : str
///     Clock, by its path or the end of its path.
/// other_clock : str, optional
///     Clock of the other file, if it has another name.
/// scope : str, optional
///     Scope of the other file that corresponds to golden's outermost scope; the one with the most
///     partners if it is left out.
/// ignore_case : bool
///     Pairs names that differ in case only.
/// map : path, optional
///     File with pairs of different names, and signals to leave out.
/// ports_out : list of str
///     Output ports of a golden file that does not name them.
/// leave : list of str
///     Output ports that are not compared.
/// skip : int
///     Tick of the other file that is compared with golden's tick 0.
/// start, stop : int
///     Golden ticks to compare; `stop` is exclusive.
/// around : int
///     Number of ticks shown before the first difference.
///
/// Returns
/// -------
/// Report
///
/// Raises
/// ------
/// OSError
///     A file cannot be read.
/// ValueError
///     A file is no complete waveform, a clock or scope is missing, or there is nothing to compare.
#[pyfunction]
#[pyo3(signature = (
    golden, other, /, *, clock="clk", other_clock=None, scope=None, ignore_case=false, map=None,
    ports_out=Vec::new(), leave=Vec::new(), skip=0, start=0, stop=None, around=4
))]
#[allow(
    clippy::too_many_arguments,
    reason = "all but two are keywords with a default"
)]
pub fn compare(
    py: Python<'_>,
    golden: PathBuf,
    other: PathBuf,
    clock: &str,
    other_clock: Option<String>,
    scope: Option<String>,
    ignore_case: bool,
    map: Option<PathBuf>,
    ports_out: Vec<String>,
    leave: Vec<String>,
    skip: i64,
    start: u64,
    stop: Option<u64>,
    around: u64,
) -> PyResult<Report> {
    for path in [Some(&golden), Some(&other), map.as_ref()]
        .into_iter()
        .flatten()
    {
        readable(py, path)?;
    }
    let wrong = |fault: Fault| PyValueError::new_err(fault.to_string());
    let map = map.as_deref().map(Map::read).transpose().map_err(wrong)?;
    let settings = Settings {
        clock: clock.to_owned(),
        other_clock,
        scope,
        ignore_case,
        map: map.unwrap_or_default(),
        ports_out,
        leave,
        skip,
        ticks: start..stop.unwrap_or(u64::MAX),
        around,
    };
    let report = py.detach(|| waves::compare(&golden, &other, &settings));
    report.map(Report).map_err(wrong)
}

/// Opens a file as Python does, whose error names the path.
fn readable(py: Python<'_>, path: &Path) -> PyResult<()> {
    let open = py.import("builtins")?.getattr("open")?;
    open.call1((path, "rb"))?.call_method0("close")?;
    Ok(())
}
