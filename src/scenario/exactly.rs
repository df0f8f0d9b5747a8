//! Lists of a certain length. An array by itself would drop what is behind its last element.

use crate::input::Point;
use crate::settings::SettingError;
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// A list of exactly `N` values.
pub(super) fn exactly<'de, D, T, const N: usize>(from: D) -> Result<[T; N], D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    from.deserialize_seq(Exactly(PhantomData))
}

/// X, Y and Z of a point in mm, and W, which may be left out, where there may be `FOURTH`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Place<const FOURTH: bool> {
    /// X, Y and Z.
    pub point: Point,
    /// W; none in a list of three.
    pub w: Option<f64>,
}

impl Place<true> {
    /// Checks that it has W, or has none.
    ///
    /// # Errors
    /// It is otherwise; `field` is its key.
    pub(super) fn check(&self, field: &'static str, fourth: bool) -> Result<(), SettingError> {
        let (given, allowed) = match (self.w.is_some(), fourth) {
            (false, true) => (3, "four numbers, of X, Y, Z and W"),
            (true, false) => (
                4,
                "three numbers, of X, Y and Z; four where there are four axes",
            ),
            _ => return Ok(()),
        };
        let problem = format!("is a list of {given}");
        Err(SettingError::new(field, problem, allowed))
    }
}

impl<'de, const FOURTH: bool> Deserialize<'de> for Place<FOURTH> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(OfAxes)
    }
}

struct OfAxes<const FOURTH: bool>;

impl<'de, const FOURTH: bool> Visitor<'de> for OfAxes<FOURTH> {
    type Value = Place<FOURTH>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "an array of length 3{}",
            if FOURTH { " or 4" } else { "" }
        )
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = list.next_element()? {
            values.push(value);
        }
        let (point, w) = match *values {
            [x, y, z] => ([x, y, z], None),
            [x, y, z, w] if FOURTH => ([x, y, z], Some(w)),
            _ => return Err(A::Error::invalid_length(values.len(), &self)),
        };
        Ok(Place { point, w })
    }
}

struct Exactly<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Exactly<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of length {N}")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<[T; N], A::Error> {
        let mut values = Vec::with_capacity(N);
        while let Some(value) = list.next_element()? {
            values.push(value);
        }
        let given = values.len();
        let values = values.try_into();
        values.map_err(|_| A::Error::invalid_length(given, &self))
    }
}
