//! External torques on the loads: cutting forces, weights.

use crate::circuits::trajectory_controller::path_point::AXIS_NAMES;
use crate::settings::{Place, SettingError, choices, settings};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Allowed torques in N·m.
pub const LOAD_TORQUE_RANGE_NM: RangeInclusive<f64> = -1e9..=1e9;

/// Allowed times from the path's start in s.
pub const LOAD_TIME_RANGE_S: RangeInclusive<f64> = 0.0..=1e6;

/// Axis by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AxisName {
    /// First axis.
    X,
    /// Second axis.
    Y,
    /// Third axis.
    Z,
    /// Fourth axis.
    W,
}

impl AxisName {
    /// Returns the index of the axis.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }
}

choices!(AxisName);

settings! {
    /// A torque on the load of an axis, for a time: a table `[[load_torque]]`. Those of one axis
    /// add.
    #[derive(Copy)]
    pub struct LoadTorque {
        /// Axis.
        pub axis [required]: AxisName = AxisName::X;
        /// Torque at the motor's shaft: a positive one pushes forwards.
        pub torque_nm [required]: f64 = 0.0, in LOAD_TORQUE_RANGE_NM;
        /// Begin, from the path's start.
        pub from_s: f64 = 0.0, in LOAD_TIME_RANGE_S;
        /// End; without it the torque stays until the run is over.
        pub to_s: Option<f64> = None, within LOAD_TIME_RANGE_S, "above from_s, up to 1000000";
    }
}

/// Step of the external torque on the load of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadStep {
    /// Tick after the path's start.
    pub tick: u64,
    /// Index of the axis.
    pub axis: usize,
    /// Sum of all external torques from this tick on, in N·m.
    pub torque_nm: f64,
}

/// Returns the steps of some torques on `axes` axes, in the order of their ticks.
///
/// # Errors
/// Returns the first torque at fault: on an axis that does not exist, out of range, or with an end
/// before its start.
pub fn load_steps(
    torques: &[LoadTorque],
    axes: usize,
    clock_hz: u64,
) -> Result<Vec<LoadStep>, SettingError> {
    for (row, torque) in torques.iter().enumerate() {
        check(torque, axes).map_err(|error| error.at(Place::Row("load_torque", row)))?;
    }
    let tick = |seconds: f64| (seconds * clock_hz as f64).round() as u64;
    let end = |torque: &LoadTorque| torque.to_s.map_or(u64::MAX, tick);
    let mut ticks: Vec<u64> = torques
        .iter()
        .flat_map(|torque| [tick(torque.from_s), end(torque)])
        .filter(|&tick| tick < u64::MAX)
        .collect();
    ticks.sort_unstable();
    ticks.dedup();
    let mut steps = Vec::new();
    for at in ticks {
        for axis in 0..axes {
            let of_axis = torques.iter().filter(|torque| torque.axis.index() == axis);
            let acts = of_axis.filter(|torque| (tick(torque.from_s)..end(torque)).contains(&at));
            steps.push(LoadStep {
                tick: at,
                axis,
                torque_nm: acts.map(|torque| torque.torque_nm).sum(),
            });
        }
    }
    Ok(steps)
}

fn check(torque: &LoadTorque, axes: usize) -> Result<(), SettingError> {
    let names = &AXIS_NAMES[..axes];
    let index = torque.axis.index();
    if index >= axes {
        let allowed = format!("one of {}", names.join(", "));
        return Err(SettingError::value("axis", AXIS_NAMES[index], allowed));
    }
    torque.ranges()?;
    let Some(to_s) = torque.to_s else {
        return Ok(());
    };
    let last = *LOAD_TIME_RANGE_S.end();
    match to_s > torque.from_s && to_s <= last {
        true => Ok(()),
        false => {
            let allowed = format!("above from_s, {}, to {last}", torque.from_s);
            Err(SettingError::value("to_s", to_s, allowed))
        }
    }
}
