//! Python module of motion-rtl; the package around it is in `python/motion_rtl`.

mod arrays;
mod checker;
mod compare;
mod errors;
mod key;
mod model;
mod program;
mod settings;
mod shared;
mod signal;
mod snapshot;

use pyo3::prelude::*;

#[pymodule]
fn _motion_rtl(module: &Bound<'_, PyModule>) -> PyResult<()> {
    // The crate `numpy` panics if Ctrl-C comes while it looks for NumPy at its first array.
    module.py().import("numpy")?;
    numpy::dtype::<u64>(module.py());
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<model::Model>()?;
    module.add_class::<snapshot::Snapshot>()?;
    module.add_class::<signal::Signal>()?;
    module.add_class::<compare::Report>()?;
    module.add_class::<checker::Checker>()?;
    module.add_function(wrap_pyfunction!(compare::compare, module)?)?;
    module.add_function(wrap_pyfunction!(settings::pairs, module)?)?;
    module.add_function(wrap_pyfunction!(program::main, module)?)?;
    module.add_function(wrap_pyfunction!(checker::bound_ports, module)?)?;
    Ok(())
}
