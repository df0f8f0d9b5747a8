//! Models.

use crate::arrays::{Column, Driven, Input, length};
use crate::errors::exception;
use crate::key::{Key, number, ticks};
use crate::settings;
use crate::shared::Shared;
use crate::signal::{Signal, value};
use crate::snapshot::Snapshot;
use motion_rtl::Model as Rtl;
use motion_rtl::registry::Pair;
use motion_rtl::sim::{self, Handle, ModelError, PortDirection, SignalInfo};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyList, PyMapping, PyMappingProxy, PyString};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// A running circuit of the catalogue, cycle by cycle.
///
/// ``Model("linear_interpolator", {"widths.position": 20}, rule="truncating")`` makes it at
/// power-on, before tick 0, with all input ports low. Names and keys are those of the program
/// ``motion-rtl``: ``motion-rtl list`` and ``motion-rtl keys NAME`` print them. Settings are a
/// dict with dotted keys or with dicts inside, or keywords, or both.
///
/// In a tick, input ports are set with ``m["port"] = value`` and any signal is read with
/// ``m["signal"]``; ``m.step()`` makes the clock edge. Signals are named by their path below the
/// circuit or by their name in Verilog; a word of a memory is ``m["memory[3]"]``. A bit is a
/// ``bool``; other signals are ``int``, negative where the signal is signed.
///
/// Threads use a model one at a time: a call waits for that of another thread.
///
/// Raises
/// ------
/// KeyError
///     The catalogue has no such circuit; the text has the nearest name.
/// ValueError
///     The circuit does not take a key or a value; the text has the allowed ones.
#[pyclass(frozen, module = "motion_rtl")]
pub struct Model {
    shared: Shared,
    name: &'static str,
    settings: Vec<Pair>,
    infos: OnceLock<Arc<Vec<SignalInfo>>>,
    signals: PyOnceLock<Py<PyMappingProxy>>,
}

impl Model {
    fn new(model: Rtl, settings: Vec<Pair>) -> Self {
        Model {
            name: model.name(),
            shared: Shared::new(model),
            settings,
            infos: OnceLock::new(),
            signals: PyOnceLock::new(),
        }
    }

    /// Returns a copy of the running circuit.
    pub fn copied(&self, py: Python<'_>) -> PyResult<Rtl> {
        Ok(self.shared.lock(py)?.clone())
    }

    fn infos(&self, py: Python<'_>) -> PyResult<&Arc<Vec<SignalInfo>>> {
        if let Some(infos) = self.infos.get() {
            return Ok(infos);
        }
        let infos = self.shared.detached(py, |model| Ok(model.signals()))?;
        Ok(self.infos.get_or_init(|| Arc::new(infos)))
    }

    /// Returns the watched signals with the names under which their values are returned.
    fn watched(
        &self,
        py: Python<'_>,
        watch: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<(String, Key<'static>)>> {
        let Some(watch) = watch else {
            let out = |info: &&SignalInfo| info.port == Some(PortDirection::Out);
            let infos = self.infos(py)?.iter().filter(out);
            let named = infos.map(|info| (info.path.clone(), Key::Handle(info.handle)));
            return Ok(named.collect());
        };
        let named = |signal: &Bound<'_, PyAny>| {
            let key = Key::of(signal)?.owned();
            Ok(match &key {
                Key::Name(name) => (name.clone().into_owned(), key),
                Key::Handle(_) => (signal.getattr("path")?.extract()?, key),
            })
        };
        match watch.is_instance_of::<PyString>() || watch.is_instance_of::<Signal>() {
            true => Ok(vec![named(watch)?]),
            false => watch.try_iter()?.map(|signal| named(&signal?)).collect(),
        }
    }
}

#[pymethods]
impl Model {
    #[new]
    #[pyo3(signature = (name, settings=None, /, **keywords))]
    fn py_new(
        py: Python<'_>,
        name: &str,
        settings: Option<&Bound<'_, PyAny>>,
        keywords: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let settings = settings::read(settings, keywords)?;
        let model = py.detach(|| Rtl::new(name, &settings));
        Ok(Model::new(model.map_err(exception)?, settings))
    }

    /// Name of the circuit.
    #[getter]
    fn name(&self) -> &'static str {
        self.name
    }

    /// Number of this tick, from 0.
    #[getter]
    fn tick(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.shared.lock(py)?.tick())
    }

    /// Descriptions of all signals by path, in the order of the waves: input ports, registers with
    /// memories, nets. Every word of a memory is a signal.
    #[getter]
    fn signals(&self, py: Python<'_>) -> PyResult<Py<PyMappingProxy>> {
        let infos = self.infos(py)?;
        let signals = self.signals.get_or_try_init(py, || {
            let dict = PyDict::new(py);
            for (index, info) in infos.iter().enumerate() {
                dict.set_item(&info.path, Signal::new(infos, index).into_pyobject(py)?)?;
            }
            let dict = dict.into_any();
            let signals = PyMappingProxy::new(py, dict.cast::<PyMapping>()?);
            Ok::<_, PyErr>(signals.unbind())
        })?;
        Ok(signals.clone_ref(py))
    }

    fn __getitem__<'py>(
        &self,
        py: Python<'py>,
        signal: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let key = Key::of(signal)?;
        let mut model = self.shared.lock(py)?;
        let read = |model: &mut Rtl| -> Result<_, ModelError> {
            let handle = sim::SignalRef::handle(&key, model)?;
            Ok((model.shape(handle)?, model.get(handle)?))
        };
        let read = read(&mut model).map_err(exception);
        drop(model);
        let (shape, bits) = read?;
        value(py, shape.kind, shape.width, bits)
    }

    fn __setitem__(
        &self,
        py: Python<'_>,
        signal: &Bound<'_, PyAny>,
        value: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let (key, value) = (Key::of(signal)?, number(value)?);
        let set = self.shared.lock(py)?.set(key, value);
        set.map_err(exception)
    }

    fn __contains__(&self, py: Python<'_>, signal: &Bound<'_, PyAny>) -> PyResult<bool> {
        let key = Key::of(signal)?;
        let model = self.shared.lock(py)?;
        let found = sim::SignalRef::handle(&key, &model).and_then(|handle| model.shape(handle));
        Ok(found.is_ok())
    }

    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.infos(py)?.len())
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(self.keys(py)?.try_iter()?.into_any())
    }

    /// Returns the paths of all signals.
    ///
    /// Returns
    /// -------
    /// list of str
    fn keys<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let paths = self.infos(py)?.iter().map(|info| info.path.as_str());
        PyList::new(py, paths.collect::<Vec<_>>())
    }

    fn _ipython_key_completions_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        self.keys(py)
    }

    /// Advances by clock edges with constant input ports.
    ///
    /// Other threads run meanwhile; Ctrl-C ends it within 16,384 ticks.
    ///
    /// Parameters
    /// ----------
    /// n : int
    ///     Number of ticks, from 0.
    #[pyo3(signature = (n=None, /), text_signature = "($self, n=1, /)")]
    fn step(&self, py: Python<'_>, n: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let ticks = n.map_or(Ok(1), ticks)?;
        self.shared.step(py, ticks)
    }

    /// Runs ticks with arrays of inputs and returns arrays of outputs.
    ///
    /// Parameters
    /// ----------
    /// inputs : dict, optional
    ///     For each input port an array of shape (ticks,) of bool or integers, one value per tick,
    ///     or one number for all ticks. Ports that are not in it stay as they are.
    /// watch : iterable of str or Signal, optional
    ///     Signals to return; the output ports if it is left out.
    /// ticks : int, optional
    ///     Number of ticks; needed if no input is an array.
    ///
    /// Returns
    /// -------
    /// dict of str to numpy.ndarray
    ///     For each watched signal an array of shape (ticks,): the settled values before the edge of
    ///     each tick. A bit is ``bool``, an unsigned signal ``uint64``, a signed one ``int64``.
    ///
    /// Raises
    /// ------
    /// KeyError
    ///     There is no such signal. No tick happens then.
    /// ValueError
    ///     A signal is no input port, a value does not fit, or lengths differ. No tick happens
    ///     then.
    /// KeyboardInterrupt
    ///     Ctrl-C was pressed. The ticks before it have happened; their values are lost.
    #[pyo3(signature = (inputs=None, watch=None, ticks=None))]
    fn run<'py>(
        &self,
        py: Python<'py>,
        inputs: Option<&Bound<'py, PyMapping>>,
        watch: Option<&Bound<'py, PyAny>>,
        ticks: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let mut driven = Vec::new();
        if let Some(inputs) = inputs {
            for item in inputs.items()?.iter() {
                let (key, value) = item.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()?;
                driven.push(Input::of(&key, &value)?);
            }
        }
        let ticks = ticks.map(crate::key::ticks).transpose()?;
        let ticks = length(&driven, ticks)?;
        let (names, keys): (Vec<_>, Vec<_>) = self.watched(py, watch)?.into_iter().unzip();
        struct Running {
            driven: Driven,
            watched: Vec<Handle>,
            columns: Vec<Column>,
        }
        let begin = |model: &mut Rtl| {
            let watched = keys.iter().map(|key| sim::SignalRef::handle(key, model));
            let watched: Vec<_> = watched.collect::<Result<_, _>>().map_err(exception)?;
            let column = |&handle| {
                let shape = model.shape(handle).map_err(exception)?;
                Column::new(shape.kind, ticks)
            };
            Ok(Running {
                columns: watched.iter().map(column).collect::<PyResult<_>>()?,
                driven: Driven::begin(model, driven)?,
                watched,
            })
        };
        let piece = |model: &mut Rtl, running: &mut Running, piece: Range<u64>| {
            let piece = piece.start as usize..piece.end as usize;
            let arrays = running.driven.arrays.iter();
            let inputs: Vec<_> = arrays
                .map(|(port, words)| (*port, &words[piece.clone()]))
                .collect();
            let parts = model.play(piece.len(), &inputs, &running.watched)?;
            for (column, part) in running.columns.iter_mut().zip(&parts) {
                column.extend(part);
            }
            Ok(())
        };
        let run = self.shared.run(py, ticks as u64, begin, piece)?;

        let arrays = PyDict::new(py);
        for (name, column) in names.into_iter().zip(run.columns) {
            arrays.set_item(name, column.array(py))?;
        }
        Ok(arrays)
    }

    /// Advances by one tick with a synchronous reset.
    ///
    /// After that edge every flip-flop has its power-on value. Memories and shift registers have no
    /// reset.
    fn reset(&self, py: Python<'_>) -> PyResult<()> {
        self.shared.lock(py)?.reset();
        Ok(())
    }

    /// Returns the state of this tick.
    fn snapshot(&self, py: Python<'_>) -> PyResult<Snapshot> {
        let state = self.shared.lock(py)?.snapshot();
        Ok(Snapshot::new(self.name, state))
    }

    /// Continues from a snapshot of this model, or of another model of an equal circuit.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     The snapshot is of another circuit.
    /// RuntimeError
    ///     Waves are being written.
    #[pyo3(signature = (snapshot, /))]
    fn restore(&self, py: Python<'_>, snapshot: &Bound<'_, Snapshot>) -> PyResult<()> {
        let restored = self.shared.lock(py)?.restore(snapshot.get().state());
        restored.map_err(exception)
    }

    /// Returns an independent copy in the same tick, without the waves.
    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        Ok(Model::new(self.copied(py)?, self.settings.clone()))
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        self.copy(py)
    }

    fn __deepcopy__(&self, py: Python<'_>, _memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.copy(py)
    }

    /// Begins waves of all signals from this tick on: a VCD or an FST, by the extension of `path`.
    ///
    /// The clock is one of 1 MHz. The directory is created if necessary. The files appear when
    /// ``finish_waves()`` is called; without it there are none.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     The extension is neither .vcd nor .fst.
    /// OSError
    ///     The file cannot be written.
    /// RuntimeError
    ///     Waves are being written already.
    #[pyo3(signature = (path, /))]
    fn waves(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.shared.detached(py, |model| model.waves_to(path))
    }

    /// Ends the waves with the tick before this one.
    ///
    /// Returns
    /// -------
    /// list of pathlib.Path
    ///     The waveform and a GTKWave save file beside it; empty if no waves were begun.
    ///
    /// Raises
    /// ------
    /// OSError
    ///     A file could not be written. No new file is left then.
    fn finish_waves(&self, py: Python<'_>) -> PyResult<Vec<PathBuf>> {
        self.shared.detached(py, Rtl::finish_waves)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let tick = self.shared.lock(py)?.tick();
        let settings = self.settings.iter().map(|pair| format!(" {pair}"));
        let settings: String = settings.collect();
        Ok(format!("<Model {}{settings}, tick {tick}>", self.name))
    }
}
