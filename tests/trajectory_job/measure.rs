//! What is measured, against places that are known, and against a search of all lengths.

use super::*;
use motion_rtl::trajectory_controller::measure::Measured;

impl<const AXES: usize> Run<AXES> {
    pub fn measured(&self) -> Measured {
        Measured::of(&self.program, &self.played).unwrap()
    }
}
