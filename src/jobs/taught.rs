//! Paths that a scenario teaches by points: its tables `[[piece]]`.

use crate::input::Point;
use crate::jobs::arc_generator::settings::SPEED_RANGE_MM_PER_MIN;
use crate::path::pieces::Taught;
use crate::plan::CENTRE_REACH_MM;
use crate::settings::{Place, SettingError, Shape, Value, Within, settings};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use serde::{Serialize, Serializer};
use std::fmt;
use std::ops::RangeInclusive;
use std::path::PathBuf;

/// Coordinates of taught points that are accepted, in mm.
pub const REACH_RANGE_MM: RangeInclusive<f64> = -CENTRE_REACH_MM..=CENTRE_REACH_MM;

/// X, Y and Z of a point in mm, and W where there is a fourth axis.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Coordinates {
    /// X, Y and Z.
    pub point: Point,
    /// W; none in a list of three.
    pub w: Option<f64>,
}

impl Coordinates {
    /// Checks that there is W where there are four axes, and no W elsewhere.
    ///
    /// # Errors
    /// There is one too few or too many; `field` is its key.
    pub fn check(&self, field: &'static str, fourth: bool) -> Result<(), SettingError> {
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

impl Within<f64> for Coordinates {
    fn check(
        &self,
        field: &'static str,
        allowed: &RangeInclusive<f64>,
    ) -> Result<(), SettingError> {
        let [x, y, z] = self.point;
        match self.w {
            Some(w) => [x, y, z, w].check(field, allowed),
            None => self.point.check(field, allowed),
        }
    }
}

impl Within<f64> for Option<Coordinates> {
    fn check(
        &self,
        field: &'static str,
        allowed: &RangeInclusive<f64>,
    ) -> Result<(), SettingError> {
        self.map_or(Ok(()), |point| Within::check(&point, field, allowed))
    }
}

impl Serialize for Coordinates {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let w = self.w.as_ref();
        to.collect_seq(self.point.iter().chain(w))
    }
}

impl Value for Coordinates {
    const SHAPE: Shape = Shape::Point;

    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(OfAxes)
    }
}

impl<'de> Deserialize<'de> for Coordinates {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Self::read(from)
    }
}

struct OfAxes;

impl<'de> Visitor<'de> for OfAxes {
    type Value = Coordinates;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of length 3 or 4")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = list.next_element()? {
            values.push(value);
        }
        let (point, w) = match *values {
            [x, y, z] => ([x, y, z], None),
            [x, y, z, w] => ([x, y, z], Some(w)),
            _ => return Err(A::Error::invalid_length(values.len(), &self)),
        };
        Ok(Coordinates { point, w })
    }
}

settings! {
    /// A piece of a path: a table `[[piece]]`.
    #[derive(Copy)]
    pub struct TaughtPiece {
        /// End of the piece; with W where there are four axes.
        pub to_mm [required]: Coordinates = Coordinates::default(), in REACH_RANGE_MM;
        /// Point of the arc; without it the piece is a line or a spline.
        pub via_mm: Option<Point> = None, in REACH_RANGE_MM;
        /// True for a spline: one curve through the ends of all such pieces in a row.
        pub spline: bool = false;
        /// Speed of the piece; without it that of the scenario.
        pub feed_mm_per_min: Option<f64> = None, in SPEED_RANGE_MM_PER_MIN;
    }
}

/// Returns the pieces as they are taught, in X, Y and Z; none if the path is a drawing.
///
/// # Errors
/// There are pieces, and a drawing too; an end without W where there are four axes, or with it where
/// there are not; a spline through a point via; a number out of its range.
pub fn taught(
    input: Option<&PathBuf>,
    pieces: &[TaughtPiece],
    fourth: bool,
) -> Result<Vec<Taught>, SettingError> {
    if input.is_some() && !pieces.is_empty() {
        return Err(SettingError::new(
            "input",
            "given beside tables [[piece]]",
            "a drawing or pieces, not both",
        ));
    }
    let taught = |(row, piece): (usize, &TaughtPiece)| {
        let at = |error: SettingError| error.at(Place::Row("piece", row));
        piece.ranges().map_err(|mut error| {
            if let Some(Place::Element(axis)) = error.place {
                error.problem += &format!(" for {axis}");
            }
            at(error)
        })?;
        piece.to_mm.check("to_mm", fourth).map_err(at)?;
        if piece.spline && piece.via_mm.is_some() {
            let error = SettingError::new("spline", "given beside via_mm", "an arc or a spline");
            return Err(at(error));
        }
        Ok(Taught {
            to: piece.to_mm.point,
            via: piece.via_mm,
            spline: piece.spline,
            speed: piece.feed_mm_per_min.map(|feed| feed / 60.0),
        })
    };
    pieces.iter().enumerate().map(taught).collect()
}
