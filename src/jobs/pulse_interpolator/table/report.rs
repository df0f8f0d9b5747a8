//! Report of a compilation.

use serde::Serialize;

/// Report of a compilation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Reports of the axes, X first.
    pub axes: Vec<AxisReport>,
    /// Coordinates in which the drawing moves although no axis drives them.
    pub undriven: Vec<&'static str>,
    /// Number of unit times in the table.
    pub units: usize,
    /// Number of unit times after the end of the path, which make up for carried steps.
    pub appended_units: usize,
    /// Number of units in which the demand of some axis is a count that the unit does not offer.
    pub unattainable_units: usize,
    /// Change that would make every demand attainable; `None` if every one is, or if there is no
    /// such change.
    pub remedy: Option<Remedy>,
    /// Length of the table in ticks.
    pub total_ticks: u64,
}

/// Unit time for lines and arcs alike with which every demand of the path is attainable, confirmed
/// by compiling with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Remedy {
    /// Unit time T in ticks, below the longer one set.
    pub period: u32,
    /// True if every longer one (below that set) has been ruled out; false if the search reached
    /// its limit of work.
    pub largest: bool,
}

/// Report on one axis. Positions are in steps from the drawing's origin.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AxisReport {
    /// Rounded position at the start.
    pub start_position: i32,
    /// Position after the last pulse.
    pub end_position: i32,
    /// Rounded end of the path minus rounded start.
    pub steps_demanded: i64,
    /// Number of pulses in the positive direction.
    pub pulses_forward: u64,
    /// Number of pulses in the negative direction.
    pub pulses_backward: u64,
    /// Number of units in which this axis's demand is a count that the unit does not offer.
    pub unattainable_units: usize,
    /// Greatest following error.
    pub following_error: FollowingError,
}

impl AxisReport {
    /// Returns the number of all pulses, in either direction.
    #[must_use]
    pub fn pulses_emitted(&self) -> u64 {
        self.pulses_forward + self.pulses_backward
    }
}

/// Greatest following error of an axis and its time: the distance between the emitted pulses and
/// the exact, unrounded demand, at any time, including just before and after each pulse.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FollowingError {
    /// Error in steps.
    pub steps: f64,
    /// First unit in which it is reached, from 0.
    pub unit: usize,
    /// Time in seconds.
    pub time_s: f64,
    /// Line of the input at that time.
    pub line: usize,
}
