//! Running circuits of the catalogue by name.

use super::{Base, CATALOGUE, Pair, find, keys};
use crate::nearest::nearest;
use crate::sim::{Model, ModelError};

impl Model {
    /// Creates a circuit of the catalogue in its full size, with some keys changed, at power-on,
    /// before tick 0, with all input ports low. Names and keys are those of the command line.
    ///
    /// ```
    /// use motion_rtl::Model;
    /// use motion_rtl::registry::Pair;
    ///
    /// let keys = [Pair::new("widths.position", 20), "rule=truncating".parse()?];
    /// let mut interpolator = Model::new("linear_interpolator", &keys)?;
    /// interpolator.set("target_x", -1000)?;
    /// interpolator.step();
    ///
    /// let error = Model::new("linear_interpolater", &[]).unwrap_err().to_string();
    /// let text = "no circuit is called linear_interpolater; did you mean linear_interpolator?";
    /// assert_eq!(error, text);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error with the nearest name if the catalogue has no such circuit, or an error
    /// with every key and value that the circuit does not take.
    pub fn new(name: &str, keys: &[Pair]) -> Result<Self, ModelError> {
        let Some(entry) = find(name) else {
            let names = CATALOGUE.iter().map(|entry| entry.name);
            return Err(ModelError::UnknownCircuit {
                name: name.to_owned(),
                near: nearest(name, names),
            });
        };
        let elaborated = keys::elaborated(entry, Base::Full, keys);
        let elaborated = elaborated.map_err(|refused| ModelError::Settings {
            circuit: entry.name,
            problem: refused.to_string(),
        })?;
        Ok(Model::ports_watched(&elaborated))
    }
}
