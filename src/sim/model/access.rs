//! Signals of a model, found, set and read.

use super::names;
use super::{Handle, Model, ModelError, SignalInfo, SignalRef};
use crate::netlist::Shape;
use crate::sim::RunError;

impl Model {
    /// Returns the handle of a signal.
    ///
    /// # Errors
    /// Returns an error with the nearest names if there is no such signal.
    pub fn find(&self, name: &str) -> Result<Handle, ModelError> {
        match self.circuit.names().find(name, self.name()) {
            Some(leaf) => Ok(self.handle(leaf)),
            None => Err(names::unknown(name, &self.circuit.elaborated)),
        }
    }

    /// Returns the handle of a signal by its [index](Handle::index).
    #[inline]
    pub fn at(&self, index: usize) -> Option<Handle> {
        (index < self.engine.leaves()).then(|| self.handle(index))
    }

    /// Returns a description of each signal, in the order of the waves: input ports, registers
    /// with memories, nets. Every word of a memory is a signal.
    pub fn signals(&self) -> Vec<SignalInfo> {
        let mut power_on = self.engine.at_power_on();
        power_on.settle();
        names::all(self, &power_on)
    }

    /// Returns kind and width of a signal.
    ///
    /// ```
    /// use motion_rtl::Model;
    /// use motion_rtl::netlist::unsigned;
    ///
    /// let counter = Model::new("enable_counter", &["width=8".parse()?])?;
    /// assert_eq!(counter.shape("count")?, unsigned(8));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if there is no such signal.
    pub fn shape(&self, signal: impl SignalRef) -> Result<Shape, ModelError> {
        let leaf = self.leaf(signal)?;
        Ok(self.shape_of(leaf))
    }

    #[inline]
    pub(super) fn shape_of(&self, leaf: usize) -> Shape {
        self.circuit.elaborated.outline().leaves[leaf].shape
    }

    #[inline]
    pub(super) fn handle(&self, leaf: usize) -> Handle {
        Handle {
            leaf: leaf as u32,
            circuit: self.circuit.mark,
        }
    }

    /// Returns the leaf of a signal.
    #[inline]
    pub(super) fn leaf(&self, signal: impl SignalRef) -> Result<usize, ModelError> {
        let handle = signal.handle(self)?;
        match handle.circuit == self.circuit.mark {
            true => Ok(handle.leaf as usize),
            false => Err(self.of_another("handle")),
        }
    }

    #[cold]
    pub(super) fn of_another(&self, what: &'static str) -> ModelError {
        let circuit = self.name();
        ModelError::OtherCircuit { what, circuit }
    }

    /// Returns the number of an input port.
    #[inline]
    pub(super) fn port(&self, signal: impl SignalRef) -> Result<usize, ModelError> {
        let leaf = self.leaf(signal)?;
        match leaf < self.ports().count() {
            true => Ok(leaf),
            false => Err(names::no_input(leaf, &self.circuit.elaborated)),
        }
    }

    /// Sets an input port to a number, from this tick on: any integer or `bool`.
    ///
    /// # Errors
    /// Returns an error if there is no such signal, it is not an input port, or the number does not
    /// fit it. Nothing is set then.
    #[inline]
    pub fn set(
        &mut self,
        signal: impl SignalRef,
        number: impl Into<i128>,
    ) -> Result<(), ModelError> {
        let port = self.port(signal)?;
        match self.circuit.ports.bits_of(port, number.into()) {
            Ok(bits) => self.drive(port, bits),
            Err(error) => return Err(ModelError::at(self.tick)(error)),
        }
        Ok(())
    }

    /// Sets an input port to the bits of a word, from this tick on; a signed port takes its two's
    /// complement.
    ///
    /// # Errors
    /// Returns the errors of [`set`](Self::set); a word does not fit if it is wider than the port.
    #[inline]
    pub fn set_bits(&mut self, signal: impl SignalRef, bits: u64) -> Result<(), ModelError> {
        let port = self.port(signal)?;
        match self.circuit.ports.check_word(port, bits) {
            Ok(()) => self.drive(port, bits),
            Err(error) => return Err(ModelError::at(self.tick)(error)),
        }
        Ok(())
    }

    /// Sets an input port to a number of 64 bits; see [`Ports::bits`].
    #[inline]
    pub(in crate::sim) fn put(&mut self, port: usize, number: u64) -> Result<(), RunError> {
        let bits = self.circuit.ports.bits(port, number);
        let bits = bits.map_err(RunError::at(self.tick))?;
        self.drive(port, bits);
        Ok(())
    }

    /// Sets an input port to a word that fits it.
    #[inline]
    pub(crate) fn drive(&mut self, port: usize, bits: u64) {
        self.engine.drive(port, bits);
        self.settled = false;
    }

    /// Sets the first input ports to words that fit them.
    #[inline]
    pub(in crate::sim) fn drive_all(&mut self, bits: &[u64]) {
        self.engine.drive_all(bits);
        self.settled = false;
    }

    /// Returns the bits of a signal in this tick, settled; zeros are above its width.
    ///
    /// # Errors
    /// Returns an error if there is no such signal.
    #[inline]
    pub fn get(&mut self, signal: impl SignalRef) -> Result<u64, ModelError> {
        let leaf = self.leaf(signal)?;
        Ok(self.word(leaf))
    }

    /// Returns a signal in this tick, settled, as a two's complement number of its width.
    ///
    /// # Errors
    /// Returns an error if there is no such signal.
    #[inline]
    pub fn get_signed(&mut self, signal: impl SignalRef) -> Result<i64, ModelError> {
        let leaf = self.leaf(signal)?;
        let above = 64 - u32::from(self.engine.flat().width(leaf));
        Ok((self.word(leaf) << above) as i64 >> above)
    }

    /// Returns the bits of a leaf in this tick, settled.
    #[inline]
    pub(crate) fn word(&mut self, leaf: usize) -> u64 {
        self.settle();
        if self.engine.is_costly(leaf) {
            self.count_costly(leaf);
        }
        self.engine.word(leaf)
    }
}
