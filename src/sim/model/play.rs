//! Runs of a model with arrays of inputs and outputs.

use super::{Handle, Model, ModelError};
use crate::netlist::Kind;

/// Ticks from which on signals that are read are watched.
const LONG: usize = 16;

impl Model {
    /// Runs `ticks` ticks with an array of values, one per tick, for each of some input ports;
    /// returns an array for each signal in `seen`, settled, before the edge of each tick. Other
    /// input ports are constant.
    ///
    /// A value is a number of 64 bits. That of a signed signal is its two's complement:
    /// `value as i64` is the number.
    ///
    /// ```
    /// use motion_rtl::Model;
    ///
    /// let mut counter = Model::new("enable_counter", &["width=4".parse()?])?;
    /// let [period, enable] = [counter.find("period")?, counter.find("enable")?];
    /// let columns = counter.play(6, &[(period, &[2, 2, 2, 2, 4, 4])], &[enable])?;
    /// assert_eq!(columns, [[0, 1, 0, 1, 0, 0]]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if a handle is of another circuit, a signal to be set is not an input
    /// port, an array has not one value per tick, or a value does not fit its port. No tick
    /// happens then.
    pub fn play(
        &mut self,
        ticks: usize,
        inputs: &[(Handle, &[u64])],
        seen: &[Handle],
    ) -> Result<Vec<Vec<u64>>, ModelError> {
        let mut ports = Vec::with_capacity(inputs.len());
        for &(handle, values) in inputs {
            let port = self.port(handle)?;
            if values.len() != ticks {
                let (port, values) = (self.circuit.path(port), values.len());
                return Err(ModelError::Length {
                    port,
                    values,
                    ticks,
                });
            }
            for (tick, &value) in (self.tick..).zip(values) {
                let checked = self.circuit.ports.bits(port, value);
                checked.map_err(ModelError::at(tick))?;
            }
            ports.push((port, self.circuit.ports.mask(port), values));
        }
        let leaves = seen.iter().map(|&handle| self.leaf(handle));
        let leaves = leaves.collect::<Result<Vec<_>, _>>()?;
        if ticks >= LONG {
            self.watch(seen)?;
        }
        let mut columns = vec![Vec::with_capacity(ticks); leaves.len()];
        let leaves: Vec<(usize, u32)> = leaves.into_iter().map(|leaf| self.seen(leaf)).collect();
        for tick in 0..ticks {
            for &(port, mask, values) in &ports {
                self.engine.drive(port, values[tick] & mask);
            }
            self.settled &= ports.is_empty();
            self.settle();
            for (&(leaf, above), column) in leaves.iter().zip(&mut columns) {
                let word = self.engine.word(leaf);
                column.push(((word << above) as i64 >> above) as u64);
            }
            self.receive();
            self.edge();
        }
        Ok(columns)
    }

    /// Returns a leaf and the number of bits above its sign, 0 if it has none.
    fn seen(&self, leaf: usize) -> (usize, u32) {
        let shape = self.shape_of(leaf);
        let above = match shape.kind {
            Kind::Signed => 64 - shape.width as u32,
            Kind::Bit | Kind::Unsigned => 0,
        };
        (leaf, above)
    }
}
