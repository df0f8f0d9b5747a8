//! The keys of the table `[program]`, which all circuits have whose input is a part program.

use super::exactly::exactly;
use crate::input::{Point, REACH_MM, Zeros};
use crate::settings::{Place, SettingError};
use serde::Deserialize;
use std::path::PathBuf;

/// Where the zeros and the reference points of a part program are, from the machine's zero, and its
/// subroutines.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Program {
    /// Reference point of G28.
    #[serde(deserialize_with = "exactly")]
    pub g28_mm: Point,
    /// Reference point of G30.
    #[serde(deserialize_with = "exactly")]
    pub g30_mm: Point,
    /// Zero of G54, which is in force at the beginning.
    #[serde(deserialize_with = "exactly")]
    pub g54_mm: Point,
    /// Zero of G55.
    #[serde(deserialize_with = "exactly")]
    pub g55_mm: Point,
    /// Zero of G56.
    #[serde(deserialize_with = "exactly")]
    pub g56_mm: Point,
    /// Zero of G57.
    #[serde(deserialize_with = "exactly")]
    pub g57_mm: Point,
    /// Zero of G58.
    #[serde(deserialize_with = "exactly")]
    pub g58_mm: Point,
    /// Zero of G59.
    #[serde(deserialize_with = "exactly")]
    pub g59_mm: Point,
    /// Zero of G59.1.
    #[serde(deserialize_with = "exactly")]
    pub g59_1_mm: Point,
    /// Zero of G59.2.
    #[serde(deserialize_with = "exactly")]
    pub g59_2_mm: Point,
    /// Zero of G59.3.
    #[serde(deserialize_with = "exactly")]
    pub g59_3_mm: Point,
    /// Directories with the files of subroutines that the program calls; in a file relative to that
    /// file.
    pub subroutine_path: Vec<PathBuf>,
}

impl Program {
    /// The same for the reader.
    ///
    /// # Errors
    ///
    /// A coordinate that is not a number, or beyond [`REACH_MM`].
    pub fn zeros(&self) -> Result<Zeros, SettingError> {
        let named = [
            ("g28_mm", self.g28_mm),
            ("g30_mm", self.g30_mm),
            ("g54_mm", self.g54_mm),
            ("g55_mm", self.g55_mm),
            ("g56_mm", self.g56_mm),
            ("g57_mm", self.g57_mm),
            ("g58_mm", self.g58_mm),
            ("g59_mm", self.g59_mm),
            ("g59_1_mm", self.g59_1_mm),
            ("g59_2_mm", self.g59_2_mm),
            ("g59_3_mm", self.g59_3_mm),
        ];
        for (field, point) in named {
            let far = |mm: &&f64| !(-REACH_MM..=REACH_MM).contains(*mm);
            if let Some(mm) = point.iter().find(far) {
                let allowed = format!("-{REACH_MM} to {REACH_MM}");
                let error = SettingError::new(field, format!("has {mm}"), allowed);
                return Err(error.at(Place::Table("program")));
            }
        }
        let [first, second, systems @ ..] = named.map(|(_, point)| point);
        Ok(Zeros {
            references: [first, second],
            systems,
        })
    }
}
