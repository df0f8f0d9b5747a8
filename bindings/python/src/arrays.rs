//! Inputs and outputs of a run as arrays.

use crate::errors::exception;
use crate::key::{Key, number};
use motion_rtl::Model;
use motion_rtl::engine::InputError;
use motion_rtl::netlist::{Kind, Shape};
use motion_rtl::sim::{Handle, ModelError, SignalRef};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyInt};

/// Values of one input port in a run.
pub enum Values {
    /// One number for all ticks.
    Constant(i128),
    /// A number per tick.
    Signed(Vec<i64>),
    /// A number per tick.
    Unsigned(Vec<u64>),
}

/// Input of a run.
pub struct Input {
    pub key: Key<'static>,
    /// Name for messages.
    pub name: String,
    pub values: Values,
}

impl Input {
    pub fn of(key: &Bound<'_, PyAny>, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let name = match Key::of(key)? {
            Key::Name(name) => name.into_owned(),
            Key::Handle(_) => key.getattr("path")?.extract()?,
        };
        Ok(Input {
            values: Values::of(&name, value)?,
            key: Key::of(key)?.owned(),
            name,
        })
    }
}

impl Values {
    /// Reads a number, or one number per tick.
    fn of(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        if value.is_instance_of::<PyInt>() {
            return number(value).map(Values::Constant);
        }
        let numpy = value.py().import("numpy")?;
        let is_masked = numpy
            .getattr("ma")?
            .call_method1("isMaskedArray", (value,))?;
        if is_masked.is_truthy()? {
            let text = format!("{name}: is a masked array; allowed: an array without a mask");
            return Err(PyTypeError::new_err(text));
        }
        let array = numpy.call_method1("asarray", (value,))?;
        let dtype = array.getattr("dtype")?;
        let kind: String = dtype.getattr("kind")?.extract()?;
        let dimensions: usize = array.getattr("ndim")?.extract()?;
        let length: usize = array.getattr("size")?.extract()?;
        if dimensions > 1 {
            let text = format!(
                "{name}: has {dimensions} dimensions; \
                 allowed: a number, or an array with one value per tick"
            );
            return Err(PyValueError::new_err(text));
        }
        // NumPy makes an empty list float64.
        if !matches!(kind.as_str(), "b" | "i" | "u") && (dimensions == 0 || length > 0) {
            let text = format!("{name}: has dtype {dtype}; allowed: bool and integers");
            return Err(PyTypeError::new_err(text));
        }
        if dimensions == 0 {
            return number(&array.call_method0("item")?).map(Values::Constant);
        }
        let whole = |dtype: &str| {
            let options = [("copy", false)].into_py_dict(value.py())?;
            array.call_method("astype", (dtype,), Some(&options))
        };
        Ok(match kind.as_str() {
            "u" => Values::Unsigned(numbers::<u64>(&whole("uint64")?)?),
            _ => Values::Signed(numbers::<i64>(&whole("int64")?)?),
        })
    }

    /// Returns the number of ticks, if there is one value per tick.
    pub fn ticks(&self) -> Option<usize> {
        match self {
            Values::Constant(_) => None,
            Values::Signed(values) => Some(values.len()),
            Values::Unsigned(values) => Some(values.len()),
        }
    }

    /// Returns the first value that is not in a range, with its index.
    fn beyond(&self, shape: Shape) -> Option<(usize, i128)> {
        let (least, greatest) = shape.range();
        match self {
            Values::Constant(value) => {
                let fits = (least..=greatest).contains(value);
                (!fits).then_some((0, *value))
            }
            Values::Signed(values) => {
                // Within 64 bits, so that the search is short.
                let least = least.max(i64::MIN.into()) as i64;
                let greatest = greatest.min(i64::MAX.into()) as i64;
                let fits = |value: &i64| (least..=greatest).contains(value);
                let index = values.iter().position(|value| !fits(value))?;
                Some((index, values[index].into()))
            }
            Values::Unsigned(values) => {
                let greatest = greatest as u64;
                let index = values.iter().position(|value| *value > greatest)?;
                Some((index, values[index].into()))
            }
        }
    }
}

fn numbers<T: numpy::Element + Copy>(array: &Bound<'_, PyAny>) -> PyResult<Vec<T>> {
    let array = array.cast::<PyArray1<T>>()?.readonly();
    Ok(array.as_array().iter().copied().collect())
}

/// Returns the number of ticks of a run.
pub fn length(inputs: &[Input], ticks: Option<u64>) -> PyResult<usize> {
    let arrays = inputs.iter().filter_map(|input| {
        let ticks = input.values.ticks()?;
        Some((input.name.as_str(), ticks))
    });
    let mut length = match ticks {
        Some(ticks) => Some(("ticks", usize::try_from(ticks)?)),
        None => None,
    };
    for (name, ticks) in arrays {
        match length {
            Some((first, length)) if length != ticks => {
                let given = match first {
                    "ticks" => format!("ticks is {length}"),
                    first => format!("{first} has {length}"),
                };
                let text = format!("{name}: has {ticks} values, but {given}; allowed: as many");
                return Err(PyValueError::new_err(text));
            }
            _ => length = Some((name, ticks)),
        }
    }
    match length {
        Some((_, length)) => Ok(length),
        None => {
            let text = "ticks: not given; allowed: a number of ticks, or an array of inputs";
            Err(PyValueError::new_err(text))
        }
    }
}

/// Inputs of a run, found and checked.
pub struct Driven {
    /// Ports with one word per tick.
    pub arrays: Vec<(Handle, Vec<u64>)>,
}

impl Driven {
    /// Finds the ports, checks all values, and sets the ports with one value.
    ///
    /// # Errors
    /// Returns the first error of a port or value. Nothing is set then.
    pub fn begin(model: &mut Model, inputs: Vec<Input>) -> PyResult<Self> {
        let (mut arrays, mut constants) = (Vec::new(), Vec::new());
        let mut known = Vec::new();
        for input in inputs {
            let handle = port(model, &input.key).map_err(exception)?;
            if known.contains(&handle) {
                let text = format!("{}: given twice; allowed: once", input.name);
                return Err(PyValueError::new_err(text));
            }
            known.push(handle);
            let shape = model.shape(handle).map_err(exception)?;
            if let Some((index, value)) = input.values.beyond(shape) {
                let (least, greatest) = shape.range();
                return Err(exception(ModelError::Input {
                    tick: model.tick() + index as u64,
                    error: InputError::Range {
                        port: input.name,
                        value,
                        least,
                        greatest,
                    },
                }));
            }
            match input.values {
                Values::Constant(value) => constants.push((handle, value)),
                Values::Signed(values) => {
                    arrays.push((
                        handle,
                        values.into_iter().map(|value| value as u64).collect(),
                    ));
                }
                Values::Unsigned(values) => arrays.push((handle, values)),
            }
        }
        for (handle, value) in constants {
            model.set(handle, value).map_err(exception)?;
        }
        Ok(Driven { arrays })
    }
}

/// Finds an input port.
fn port(model: &mut Model, key: &Key<'_>) -> Result<Handle, ModelError> {
    let handle = key.handle(model)?;
    // Refuses a signal that is no input port.
    model.play(0, &[(handle, &[])], &[])?;
    Ok(handle)
}

/// Values of a watched signal, tick by tick.
pub enum Column {
    Bits(Vec<bool>),
    Signed(Vec<i64>),
    Unsigned(Vec<u64>),
}

impl Column {
    /// Returns an empty column with room for some ticks.
    pub fn new(kind: Kind, ticks: usize) -> PyResult<Self> {
        Ok(match kind {
            Kind::Bit => Column::Bits(room(ticks)?),
            Kind::Signed => Column::Signed(room(ticks)?),
            Kind::Unsigned => Column::Unsigned(room(ticks)?),
        })
    }

    /// Appends words, which a signed signal has as two's complement.
    pub fn extend(&mut self, words: &[u64]) {
        match self {
            Column::Bits(bits) => bits.extend(words.iter().map(|word| *word != 0)),
            Column::Signed(numbers) => numbers.extend(words.iter().map(|word| *word as i64)),
            Column::Unsigned(numbers) => numbers.extend_from_slice(words),
        }
    }

    /// Returns the column as an array: `bool`, `int64` or `uint64`.
    pub fn array(self, py: Python<'_>) -> Bound<'_, PyAny> {
        match self {
            Column::Bits(bits) => PyArray1::from_vec(py, bits).into_any(),
            Column::Signed(numbers) => PyArray1::from_vec(py, numbers).into_any(),
            Column::Unsigned(numbers) => PyArray1::from_vec(py, numbers).into_any(),
        }
    }
}

fn room<T>(ticks: usize) -> PyResult<Vec<T>> {
    let mut values = Vec::new();
    match values.try_reserve_exact(ticks) {
        Ok(()) => Ok(values),
        Err(error) => Err(PyMemoryError::new_err(error.to_string())),
    }
}
