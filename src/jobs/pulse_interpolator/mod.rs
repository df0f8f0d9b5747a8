//! A drawing on the pulse interpolator: compiled to a table, played by a control computer, counted by
//! drivers.

pub mod beside;
pub mod control_computer;
pub mod groups;
pub mod job;
pub mod motors;
pub mod moves;
pub mod positions;
pub mod rates;
pub mod spread;
pub mod step_dir;
pub mod stored;
pub mod table;

pub use control_computer::ControlComputer;
pub use stored::{Rewrite, Stored, StoredError};
pub use table::{
    AxisReport, AxisScaling, CountTable, FollowingError, PathSteps, PulseLimits, Ratio, Remedy,
    Report, Scaled, Settings, StepTiming, Table, TableError, UNIT_RANGE_TICKS, UnitDemand,
    UnitErrors, Word, compile, compile_unfollowed, demanded, follow,
};
