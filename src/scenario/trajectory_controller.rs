//! The keys of the trajectory controller.

use super::arc_generator::{PieceKeys, taught};
use super::{Place, Program, Runnable};
use crate::circuits::trajectory_controller::Rounding;
use crate::jobs::trajectory_controller::each_axis::EachAxis;
use crate::jobs::trajectory_controller::load_torque::LoadTorque;
use crate::jobs::trajectory_controller::segments::FourthAxis;
use crate::jobs::trajectory_controller::settings::{Correction, Settings};
use crate::path::pieces::Taught;
use crate::plant::TwoMassParameters;
use crate::settings::{self, SettingError};
use serde::Deserialize;
use std::ops::RangeInclusive;
use std::path::PathBuf;

/// Axes that the controller is made for.
const AXES: RangeInclusive<u32> = 2..=4;

/// A scenario of the trajectory controller. Every key but `circuit` has a default; the path is a
/// drawing or part program, or the tables `[[piece]]`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// The circuit that runs.
    pub circuit: Runnable,
    /// The drawing or part program; in a file relative to that file.
    pub input: Option<PathBuf>,
    /// Where the zeros of a part program are.
    #[serde(default)]
    pub program: Program,
    /// Where the first piece begins; at 0 without it.
    pub start_mm: Option<Place<true>>,
    /// The pieces.
    #[serde(default)]
    pub piece: Vec<PieceKeys<true>>,
    /// Axes: 2, 3, or 4 with W. Without it 3 where the path moves in Z.
    pub axes: Option<u32>,
    /// Reference clock in Hz.
    #[serde(default = "default::clock_hz")]
    pub clock_hz: u64,
    /// Δt: interpolation period.
    #[serde(default = "default::period_ms")]
    pub period_ms: f64,
    /// Counts per millimetre, of every axis.
    #[serde(default = "default::counts_per_mm")]
    pub counts_per_mm: f64,
    /// F: speed of the pieces that have none of their own.
    pub feed_mm_per_s: Option<f64>,
    /// Speed of pen-up and G0 moves.
    #[serde(default = "default::rapid_mm_per_s")]
    pub rapid_mm_per_s: f64,
    /// Largest acceleration along the path.
    pub acceleration_mm_per_s2: Option<f64>,
    /// In its place the time from rest to the feed.
    pub acceleration_time_ms: Option<f64>,
    /// Largest acceleration of the axes: of all, or a list.
    pub axis_acceleration_mm_per_s2: Option<EachAxis>,
    /// Largest acceleration across it, on arcs.
    #[serde(default = "default::normal_acceleration_mm_per_s2")]
    pub normal_acceleration_mm_per_s2: f64,
    /// Contour error that the feed is limited to.
    pub contour_tolerance_mm: Option<f64>,
    /// Time in which the acceleration along the path comes and goes; 0 for a trapezoid of speed.
    #[serde(default = "default::jerk_time_ms")]
    pub jerk_time_ms: f64,
    /// Largest step of the velocity between two segments; 0 stops at every corner.
    #[serde(default = "default::corner_mm_per_s")]
    pub corner_mm_per_s: f64,
    /// K1 of the models: of all axes, or a list.
    #[serde(default = "default::k1_per_s")]
    pub k1_per_s: EachAxis,
    /// K2 likewise.
    #[serde(default = "default::k2_per_s")]
    pub k2_per_s: EachAxis,
    /// Gains with which the model goes beyond its target are allowed.
    #[serde(default)]
    pub allow_overshoot: bool,
    /// How the models round.
    #[serde(default)]
    pub rounding: Rounding,
    /// What is added to the path's point in the run whose waves are written.
    #[serde(default)]
    pub correction: Correction,
    /// Gain of the error along the path, where errors are fed back.
    #[serde(default = "default::tangential_gain")]
    pub tangential_gain: f64,
    /// Gain of the error across it.
    #[serde(default = "default::normal_gain")]
    pub normal_gain: f64,
    /// Gain of the position controls.
    #[serde(default = "default::position_gain_per_s")]
    pub position_gain_per_s: f64,
    /// Bandwidth of the speed controls.
    #[serde(default = "default::speed_hz")]
    pub speed_hz: f64,
    /// Integral time of the speed controls; 0 for no integral.
    #[serde(default = "default::integral_ms")]
    pub integral_ms: f64,
    /// What the feed-forward is told of the inertia, as a part of it: of all axes, or a list.
    #[serde(default = "default::inertia_factor")]
    pub inertia_factor: EachAxis,
    /// Torques on the loads from outside.
    #[serde(default)]
    pub load_torque: Vec<LoadTorque>,
    /// Amplifier, motor, load and encoder of every axis.
    #[serde(default)]
    pub machine: TwoMassParameters,
    /// The same of each axis by itself.
    #[serde(default)]
    pub axis: Vec<TwoMassParameters>,
    /// Plays what the circuit is compared with too: the other corrections.
    #[serde(default)]
    pub beside: bool,
    /// The most ticks that go into the VCD unless a window is asked for.
    #[serde(default = "default::vcd_ticks")]
    pub vcd_ticks: u64,
}

impl Scenario {
    /// The settings it stands for.
    #[must_use]
    pub fn settings(&self) -> Settings {
        Settings {
            clock_hz: self.clock_hz,
            period_ms: self.period_ms,
            counts_per_mm: self.counts_per_mm,
            feed_mm_per_s: self.feed_mm_per_s,
            rapid_mm_per_s: self.rapid_mm_per_s,
            acceleration_mm_per_s2: self.acceleration_mm_per_s2,
            acceleration_time_ms: self.acceleration_time_ms,
            axis_acceleration_mm_per_s2: self.axis_acceleration_mm_per_s2.clone(),
            normal_acceleration_mm_per_s2: self.normal_acceleration_mm_per_s2,
            contour_tolerance_mm: self.contour_tolerance_mm,
            jerk_time_ms: self.jerk_time_ms,
            corner_mm_per_s: self.corner_mm_per_s,
            k1_per_s: self.k1_per_s.clone(),
            k2_per_s: self.k2_per_s.clone(),
            allow_overshoot: self.allow_overshoot,
            rounding: self.rounding,
            correction: self.correction,
            tangential_gain: self.tangential_gain,
            normal_gain: self.normal_gain,
            position_gain_per_s: self.position_gain_per_s,
            speed_hz: self.speed_hz,
            integral_ms: self.integral_ms,
            inertia_factor: self.inertia_factor.clone(),
            load_torque: self.load_torque.clone(),
        }
    }

    /// Whether there is W beside X, Y and Z.
    #[must_use]
    pub fn has_fourth(&self) -> bool {
        self.axes == Some(4)
    }

    /// The taught pieces, from [`Scenario::start_mm`] on; empty if the path is a drawing.
    ///
    /// # Errors
    /// There are pieces, and a drawing too; a point without W where there are four axes, or with it
    /// where there are not.
    pub fn taught(&self) -> Result<Vec<Taught>, SettingError> {
        let fourth = self.has_fourth();
        if let Some(start) = &self.start_mm {
            start.check("start_mm", fourth)?;
        }
        for (row, piece) in self.piece.iter().enumerate() {
            let checked = piece.to_mm.check("to_mm", fourth);
            checked.map_err(|error| error.at(settings::Place::Row("piece", row)))?;
        }
        taught(self.input.as_ref(), &self.piece)
    }

    /// W of the taught pieces.
    #[must_use]
    pub fn taught_w(&self) -> FourthAxis {
        let w = |place: &Place<true>| place.w.unwrap_or(0.0);
        FourthAxis {
            from_mm: self.start_mm.as_ref().map_or(0.0, w),
            to_mm: self.piece.iter().map(|piece| w(&piece.to_mm)).collect(),
        }
    }

    /// How many axes there are, of a path that moves in Z or not.
    ///
    /// # Errors
    /// Neither 2 nor 3 nor 4.
    pub fn axes(&self, moves_in_z: bool) -> Result<usize, SettingError> {
        let axes = self.axes.unwrap_or(if moves_in_z { 3 } else { 2 });
        match AXES.contains(&axes) {
            true => Ok(axes as usize),
            false => Err(SettingError::value("axes", axes, "2, 3 or 4")),
        }
    }

    /// Motor and load of each of so many axes.
    ///
    /// # Errors
    /// There are tables `[[axis]]`, and not one for each axis.
    pub fn machines(&self, axes: usize) -> Result<Vec<TwoMassParameters>, SettingError> {
        match self.axis.len() {
            0 => Ok(vec![self.machine; axes]),
            given if given == axes => Ok(self.axis.clone()),
            given => {
                let allowed = format!("{axes} tables [[axis]], or one table [machine] for all");
                let problem = format!("given {given} times");
                Err(SettingError::new("axis", problem, allowed))
            }
        }
    }
}

/// What a key is worth that is not given: what the settings are by default.
mod default {
    use super::Settings;

    fn settings() -> Settings {
        Settings::default()
    }
    pub(super) fn clock_hz() -> u64 {
        settings().clock_hz
    }
    pub(super) fn period_ms() -> f64 {
        settings().period_ms
    }
    pub(super) fn counts_per_mm() -> f64 {
        settings().counts_per_mm
    }
    pub(super) fn rapid_mm_per_s() -> f64 {
        settings().rapid_mm_per_s
    }
    pub(super) fn normal_acceleration_mm_per_s2() -> f64 {
        settings().normal_acceleration_mm_per_s2
    }
    pub(super) fn jerk_time_ms() -> f64 {
        settings().jerk_time_ms
    }
    pub(super) fn corner_mm_per_s() -> f64 {
        settings().corner_mm_per_s
    }
    pub(super) fn k1_per_s() -> super::EachAxis {
        settings().k1_per_s
    }
    pub(super) fn k2_per_s() -> super::EachAxis {
        settings().k2_per_s
    }
    pub(super) fn tangential_gain() -> f64 {
        settings().tangential_gain
    }
    pub(super) fn normal_gain() -> f64 {
        settings().normal_gain
    }
    pub(super) fn position_gain_per_s() -> f64 {
        settings().position_gain_per_s
    }
    pub(super) fn speed_hz() -> f64 {
        settings().speed_hz
    }
    pub(super) fn integral_ms() -> f64 {
        settings().integral_ms
    }
    pub(super) fn inertia_factor() -> super::EachAxis {
        settings().inertia_factor
    }
    pub(super) fn vcd_ticks() -> u64 {
        super::super::VCD_TICKS
    }
}
