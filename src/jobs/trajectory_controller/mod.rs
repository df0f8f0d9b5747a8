//! A path on the trajectory controller: planned, written as segments and records, played with
//! motors and loads, and measured.
//!
//! [`segments`] and [`splines`] (pieces of a path by their length), [`axis_limits`],
//! [`speed_limits`] and [`planner`] (speed along the path, by [`ramp`]s, as a
//! [`profile`](mod@profile)), [`profile_record`] (the profile as words), [`servo_gains`],
//! [`program`] (all of these together), [`job`] (a path on the circuit, with motors),
//! [`mod@load_torque`] (external torques on the loads), [`measure`] (measures of the results),
//! [`closed`] (closed forms for a circle), [`settings`], in which [`each_axis`] is one number or
//! one for each axis.

pub mod axis_limits;
pub mod closed;
pub mod each_axis;
mod extent;
mod fourth;
mod host;
pub mod job;
pub mod load_torque;
pub mod measure;
pub(crate) mod path_writer;
pub mod planner;
pub mod profile;
pub mod profile_record;
pub mod program;
pub mod ramp;
pub mod segments;
pub mod servo_gains;
pub mod settings;
pub mod speed_limits;
pub mod splines;
