//! The keys of the table `[program]`, which all circuits have whose input is a part program.

use crate::input::{Point, REACH_MM, Zeros};
use crate::settings::{Place, SettingError, settings};
use std::path::PathBuf;

settings! {
    /// Zeros and reference points of a part program, from the machine's zero, and its subroutines.
    pub struct Program {
        /// Reference point of G28.
        pub g28_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Reference point of G30.
        pub g30_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Zero of G54, which is in force at the beginning.
        pub g54_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Zero of G55.
        pub g55_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Zero of G56.
        pub g56_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Zero of G57.
        pub g57_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Zero of G58.
        pub g58_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Zero of G59.
        pub g59_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Zero of G59.1.
        pub g59_1_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Zero of G59.2.
        pub g59_2_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Zero of G59.3.
        pub g59_3_mm: Point = [0.0; 3], in -REACH_MM..=REACH_MM;
        /// Directories with the files of subroutines that the program calls; in a scenario file
        /// relative to that file.
        pub subroutine_path: Vec<PathBuf> = Vec::new();
    }
}

impl Program {
    /// Returns zeros and reference points for the reader of part programs.
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
