//! Settings as Python gives them.

use motion_rtl::registry::Pair;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyList, PyMapping, PyString, PyTuple};

/// Returns the pairs of a mapping with dotted keys or with mappings inside, and of keywords.
pub fn read(
    settings: Option<&Bound<'_, PyAny>>,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<Pair>> {
    let mut pairs = Vec::new();
    let tables = [settings, keywords.map(|keywords| keywords.as_any())];
    for table in tables.into_iter().flatten() {
        let Ok(table) = table.cast::<PyMapping>() else {
            let given = table.get_type().name()?;
            let text = format!("settings are a dict or keywords, not {given}");
            return Err(PyTypeError::new_err(text));
        };
        add(&mut pairs, table, "")?;
    }
    for (index, pair) in pairs.iter().enumerate() {
        if pairs[..index].iter().any(|before| before.key == pair.key) {
            let text = format!("{}: given twice; allowed: once", pair.key);
            return Err(PyValueError::new_err(text));
        }
    }
    Ok(pairs)
}

fn add(pairs: &mut Vec<Pair>, table: &Bound<'_, PyMapping>, before: &str) -> PyResult<()> {
    for item in table.items()?.iter() {
        let (key, value) = item.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()?;
        let Ok(key) = key.cast::<PyString>() else {
            let text = format!("the key {} is no str", key.repr()?);
            return Err(PyTypeError::new_err(text));
        };
        let key = format!("{before}{}", key.to_str()?);
        match value.cast::<PyMapping>() {
            Ok(inner) => add(pairs, inner, &format!("{key}."))?,
            // A word is not quoted, as on the command line.
            Err(_) => match value.cast::<PyString>() {
                Ok(word) => pairs.push(Pair::new(key, word.to_str()?)),
                Err(_) => {
                    let text = toml(&key, &value)?;
                    pairs.push(Pair::new(key, text));
                }
            },
        }
    }
    Ok(())
}

/// Returns a value as TOML.
fn toml(key: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
    if let Ok(word) = value.cast::<PyString>() {
        // A string of JSON is one of TOML.
        return Ok(serde_json::Value::from(word.to_str()?).to_string());
    }
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(flag.is_true().to_string());
    }
    if value.cast::<PyList>().is_ok() || value.cast::<PyTuple>().is_ok() {
        let items = value.try_iter()?.map(|item| toml(key, &item?));
        return Ok(format!(
            "[{}]",
            items.collect::<PyResult<Vec<_>>>()?.join(", ")
        ));
    }
    if let Ok(table) = value.cast::<PyMapping>() {
        let items = table.items()?;
        let items = items.iter().map(|item| {
            let (name, value) = item.extract::<(String, Bound<'_, PyAny>)>()?;
            let name = serde_json::Value::from(name);
            Ok(format!("{name} = {}", toml(key, &value)?))
        });
        return Ok(format!(
            "{{ {} }}",
            items.collect::<PyResult<Vec<_>>>()?.join(", ")
        ));
    }
    if value.cast::<PyFloat>().is_ok() || !value.hasattr("__index__")? {
        let Ok(number) = value.extract::<f64>() else {
            let given = value.get_type().name()?;
            let text = format!("{key}: is {given}; allowed: bool, int, float, str, list, dict");
            return Err(PyTypeError::new_err(text));
        };
        // TOML asks for a digit on both sides of the point.
        return Ok(format!("{number:?}"));
    }
    Ok(value.call_method0("__index__")?.str()?.to_string())
}

/// Returns `key=value` for each setting, as the command line takes them.
#[pyfunction]
#[pyo3(name = "_pairs", signature = (settings=None, keywords=None))]
pub fn pairs(
    settings: Option<&Bound<'_, PyAny>>,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<String>> {
    let pairs = read(settings, keywords)?;
    Ok(pairs.iter().map(Pair::to_string).collect())
}
