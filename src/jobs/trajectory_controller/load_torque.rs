//! Torques on the loads from outside: cutting forces, weights.

use crate::circuits::trajectory_controller::path_point::AXIS_NAMES;
use crate::settings::{Place, SettingError, within};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Torques that are accepted, in N·m.
pub const LOAD_TORQUE_RANGE_NM: RangeInclusive<f64> = -1e9..=1e9;

/// Times from the path's start that are accepted, in s.
pub const LOAD_TIME_RANGE_S: RangeInclusive<f64> = 0.0..=1e6;

/// An axis by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AxisName {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
    /// The fourth.
    W,
}

impl AxisName {
    /// Its number.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }
}

/// A torque on the load of an axis, for a time. Those of one axis add.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadTorque {
    /// The axis.
    pub axis: AxisName,
    /// The torque at the motor's shaft, in N·m: with a plus it pushes forwards.
    pub torque_nm: f64,
    /// From when on, in s from the tick of the path's start.
    #[serde(default)]
    pub from_s: f64,
    /// Until when; without it until the run is over.
    pub to_s: Option<f64>,
}

/// From this tick behind the path's start on, the load of an axis has this torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadStep {
    /// The tick.
    pub tick: u64,
    /// The axis.
    pub axis: usize,
    /// All torques from outside together, in N·m.
    pub torque_nm: f64,
}

/// The steps of some torques on so many axes, in the order of their ticks.
///
/// # Errors
/// The first torque at fault: of an axis that there is not, out of range, or that ends before it
/// begins.
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
    within("torque_nm", torque.torque_nm, &LOAD_TORQUE_RANGE_NM)?;
    within("from_s", torque.from_s, &LOAD_TIME_RANGE_S)?;
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
