//! Signals of a model, by handle or name.

use super::{Model, ModelError};

/// Signal of a [`Model`], found once: it is read and set without a search for its name.
///
/// A handle belongs to all models of the same circuit with the same keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Handle {
    pub(super) leaf: u32,
    /// Mark of the circuit.
    pub(super) circuit: u32,
}

impl Handle {
    /// Returns the index of the signal in [`Model::signals`].
    pub fn index(self) -> usize {
        self.leaf as usize
    }
}

/// Reference to a signal of a [`Model`]: a [`Handle`], or a name as [`Model::find`] takes it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no signal of a model",
    note = "a `Handle` or a name (`&str`) is wanted"
)]
pub trait SignalRef {
    /// Returns the handle.
    ///
    /// # Errors
    /// Returns an error if there is no signal of that name.
    fn handle(&self, model: &Model) -> Result<Handle, ModelError>;
}

impl SignalRef for Handle {
    #[inline]
    fn handle(&self, _: &Model) -> Result<Handle, ModelError> {
        Ok(*self)
    }
}

impl SignalRef for str {
    fn handle(&self, model: &Model) -> Result<Handle, ModelError> {
        model.find(self)
    }
}

impl SignalRef for String {
    fn handle(&self, model: &Model) -> Result<Handle, ModelError> {
        model.find(self)
    }
}

impl<S: SignalRef + ?Sized> SignalRef for &S {
    #[inline]
    fn handle(&self, model: &Model) -> Result<Handle, ModelError> {
        (**self).handle(model)
    }
}
