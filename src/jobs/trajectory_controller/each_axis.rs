//! Setting that is one number for all axes, or a list with one for each.

use crate::circuits::trajectory_controller::path_point::AXIS_NAMES;
use crate::settings::{Place, SettingError, Shape, Value};
use serde::Serialize;
use serde::de::{Deserializer, SeqAccess, Visitor};
use std::fmt;

/// Number for all axes, or one for each.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum EachAxis {
    /// Number for all axes.
    All(f64),
    /// Number for each axis.
    Each(Vec<f64>),
}

impl From<f64> for EachAxis {
    fn from(value: f64) -> Self {
        EachAxis::All(value)
    }
}

impl fmt::Display for EachAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EachAxis::All(value) => write!(f, "{value}"),
            EachAxis::Each(list) => {
                let list: Vec<_> = list.iter().map(f64::to_string).collect();
                write!(f, "{}", list.join(", "))
            }
        }
    }
}

impl EachAxis {
    /// Returns the value of an axis; NaN if it is not in the list.
    #[must_use]
    pub fn of(&self, axis: usize) -> f64 {
        match self {
            EachAxis::All(value) => *value,
            EachAxis::Each(list) => list.get(axis).copied().unwrap_or(f64::NAN),
        }
    }

    /// Returns the number of axes in the list; `None` for a single number.
    #[must_use]
    pub fn told(&self) -> Option<usize> {
        match self {
            EachAxis::All(_) => None,
            EachAxis::Each(list) => Some(list.len()),
        }
    }

    /// Adds the axis as the place of a fault, if each has its own value.
    #[must_use]
    pub fn fault(&self, axis: usize, error: SettingError) -> SettingError {
        match self {
            EachAxis::All(_) => error,
            EachAxis::Each(_) => error.at(Place::Element(AXIS_NAMES[axis])),
        }
    }

    /// Checks that there is a value for each of `axes` axes.
    ///
    /// # Errors
    /// Returns an error if there are fewer or more.
    pub fn check(&self, field: &'static str, axes: usize) -> Result<(), SettingError> {
        match self.told() {
            Some(given) if given != axes => {
                let problem = format!("is a list of {given}");
                let allowed = format!("a number for all axes, or a list of {axes}");
                Err(SettingError::new(field, problem, allowed))
            }
            _ => Ok(()),
        }
    }
}

impl Value for EachAxis {
    const SHAPE: Shape = Shape::PerAxis;

    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(NumberOrList)
    }
}

struct NumberOrList;

impl<'de> Visitor<'de> for NumberOrList {
    type Value = EachAxis;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a number for all axes, or a list of one for each")
    }

    fn visit_f64<E>(self, value: f64) -> Result<EachAxis, E> {
        Ok(EachAxis::All(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<EachAxis, E> {
        Ok(EachAxis::All(value as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<EachAxis, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = list.next_element()? {
            values.push(value);
        }
        Ok(EachAxis::Each(values))
    }
}
