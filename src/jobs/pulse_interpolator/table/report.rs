//! What came of a compilation.

use serde::Serialize;

/// What came of a compilation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Each axis, X first.
    pub axes: Vec<AxisReport>,
    /// Coordinates in which the drawing moves though no axis drives them.
    pub undriven: Vec<&'static str>,
    /// Unit times in the table.
    pub units: usize,
    /// Of these, how many follow the end of the path, to make up for what was carried.
    pub appended_units: usize,
    /// Units in which the demand of some axis is a count the unit does not offer.
    pub unattainable_units: usize,
    /// What would make every demand attainable; `None` where every one is, and where nothing
    /// would.
    pub remedy: Option<Remedy>,
    /// Length of the table in ticks.
    pub total_ticks: u64,
}

/// A unit time for lines and arcs alike at which every demand of the path is attainable, found by
/// compiling with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Remedy {
    /// The unit time T in ticks, below the longer one set.
    pub period: u32,
    /// Whether every longer one (below that set) has been ruled out; else the search was cut short
    /// by its limit of work.
    pub largest: bool,
}

/// One axis of a [`Report`]. Positions are in steps from the drawing's origin.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AxisReport {
    /// Rounded position at the start.
    pub start_position: i32,
    /// Position after the last pulse.
    pub end_position: i32,
    /// Rounded end of the path less rounded start.
    pub steps_demanded: i64,
    /// Pulses in the positive direction.
    pub pulses_forward: u64,
    /// Pulses in the negative direction.
    pub pulses_backward: u64,
    /// Units in which this axis's demand is a count the unit does not offer.
    pub unattainable_units: usize,
    /// The largest following error.
    pub following_error: FollowingError,
}

impl AxisReport {
    /// All pulses, either way.
    #[must_use]
    pub fn pulses_emitted(&self) -> u64 {
        self.pulses_forward + self.pulses_backward
    }
}

/// The largest following error of an axis, and where: the distance between the pulses emitted and
/// the exact, unrounded demand, at whatever time, just before and after each pulse included.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct FollowingError {
    /// In steps.
    pub steps: f64,
    /// The first unit it is reached in, from 0.
    pub unit: usize,
    /// When, in seconds.
    pub time_s: f64,
    /// Line of the input under way at that time.
    pub line: usize,
}
