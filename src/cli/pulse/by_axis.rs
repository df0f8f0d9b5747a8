//! Rows of a summary for each axis, in the order of the axes.

use motion_rtl::circuits::pulse_interpolator::AXIS_NAMES;
use serde::{Serialize, Serializer};

/// A row for each axis; in JSON an object with their names.
#[derive(Debug)]
pub struct ByAxis<T>(Vec<(&'static str, T)>);

impl<T> ByAxis<T> {
    /// Names and rows.
    pub fn iter(&self) -> impl Iterator<Item = &(&'static str, T)> {
        self.0.iter()
    }
}

impl<T> FromIterator<T> for ByAxis<T> {
    /// The rows of the axes from X on.
    fn from_iter<I: IntoIterator<Item = T>>(rows: I) -> Self {
        Self(AXIS_NAMES.into_iter().zip(rows).collect())
    }
}

#[cfg(feature = "schema")]
impl<T: schemars::JsonSchema> schemars::JsonSchema for ByAxis<T> {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        format!("{}ByAxis", T::schema_name()).into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        std::collections::BTreeMap::<String, T>::json_schema(generator)
    }
}

impl<T: Serialize> Serialize for ByAxis<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, row)| (name, row)))
    }
}
