//! The keys of the lead-angle compensator.

use super::Runnable;
use crate::input::position_log::Columns;
use crate::jobs::lead_angle::settings::{
    Action, Comparing, Completion, Detector, Function, History, LeadBy, LeadForm, Placement,
    Settings, Sign, Step, Targets, TimeSource,
};
use crate::plant::{BodyParameters, Load, ResolverParameters};
use serde::Deserialize;
use std::path::PathBuf;

/// A scenario of the lead-angle compensator. Every key but `circuit` and `step` has a default.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// The circuit that runs.
    pub circuit: Runnable,
    /// A position log in CSV that stands in for body and encoder; in a file relative to that file.
    pub input: Option<PathBuf>,
    /// Column of the log that has the counts.
    pub log_column: Option<String>,
    /// Column of the log that has the times.
    pub log_time_column: Option<String>,
    /// Unit of the log's times; without it the log says the unit.
    pub log_time_unit_ms: Option<f64>,
    /// Reference clock in Hz.
    #[serde(default = "default::clock_hz")]
    pub clock_hz: u64,
    /// Ticks of a CK.
    #[serde(default = "default::ck_ticks")]
    pub ck_ticks: u32,
    /// The steps, run over and over.
    pub step: Vec<StepKeys>,
    /// What their targets count from.
    #[serde(default)]
    pub targets: Targets,
    /// What the control signal is for.
    #[serde(default)]
    pub action: Action,
    /// Time from the control signal until an operation takes effect.
    #[serde(default = "default::operation_delay")]
    pub operation_delay_s: f64,
    /// The factor of that time from the load change on.
    #[serde(default = "default::load_factor")]
    pub load_delay_factor: f64,
    /// What the position comes from.
    #[serde(default)]
    pub detector: Detector,
    /// How much faster than CK an absolute encoder's sampling clock is.
    #[serde(default)]
    pub sampling_clock_ppm: f64,
    /// Pitches of a resolver's turn.
    #[serde(default = "default::pole_pairs")]
    pub pole_pairs: u32,
    /// What a resolver's sine channel has at an angle of 0, as a part of the amplitude.
    #[serde(default)]
    pub sine_offset: f64,
    /// How much greater its sine winding is than the other, as a part of it.
    #[serde(default)]
    pub gain_mismatch: f64,
    /// Where the lead comes from.
    #[serde(default)]
    pub lead: LeadBy,
    /// Which of the equal forms the lead of a time has.
    #[serde(default)]
    pub form: LeadForm,
    /// Where the lead is placed.
    #[serde(default)]
    pub placement: Placement,
    /// When the control signal is given.
    #[serde(default)]
    pub comparing: Comparing,
    /// The sign of the stop error that corrects the time data.
    #[serde(default)]
    pub sign: Sign,
    /// What is made of error and overrun.
    #[serde(default)]
    pub function: Function,
    /// What keeps the positions of the past.
    #[serde(default)]
    pub history: History,
    /// The time data are corrected after each positioning.
    #[serde(default = "default::learn")]
    pub learn: bool,
    /// All steps share the time data of step 0.
    #[serde(default = "default::common_time")]
    pub common_time: bool,
    /// Where the first time data come from.
    #[serde(default)]
    pub time_source: TimeSource,
    /// What a step without time data begins to learn with.
    #[serde(default = "default::seed")]
    pub seed_ms: f64,
    /// When a positioning is complete.
    #[serde(default)]
    pub completion: Completion,
    /// How long the position must stay for a positioning to be complete.
    #[serde(default = "default::standstill")]
    pub standstill_ms: f64,
    /// How long a positioning may take after the control signal.
    #[serde(default = "default::time_out")]
    pub time_out_ms: f64,
    /// Pause between positionings.
    #[serde(default = "default::rest")]
    pub rest_ms: f64,
    /// Time over which the conventional compensator measures the speed.
    #[serde(default = "default::speed_gate")]
    pub speed_gate_ms: f64,
    /// What the conventional compensator multiplies the speed with.
    #[serde(default = "default::speed_lead")]
    pub speed_lead_ms: f64,
    /// How far before its target a displaced switch stands; without it as its step wants.
    pub switch_counts: Option<u32>,
    /// How many positionings there are in all.
    #[serde(default = "default::positionings")]
    pub positionings: u32,
    /// How many there are before the load changes; without it the load stays.
    pub load_change_after: Option<u32>,
    /// The inertia's factor from then on.
    #[serde(default = "default::load_factor")]
    pub load_inertia_factor: f64,
    /// The factor of the bearings' friction from then on.
    #[serde(default = "default::load_factor")]
    pub load_friction_factor: f64,
    /// The factor of the brake's torque from then on.
    #[serde(default = "default::load_factor")]
    pub load_brake_factor: f64,
    /// Encoder counts a turn.
    #[serde(default = "default::counts_per_rev")]
    pub counts_per_rev: f64,
    /// The drive's acceleration.
    #[serde(default = "default::acceleration")]
    pub acceleration_counts_per_s2: f64,
    /// Inertia of motor and body.
    #[serde(default = "default::inertia")]
    pub inertia_kg_m2: f64,
    /// Friction of the bearings.
    #[serde(default = "default::friction")]
    pub friction_nm: f64,
    /// Time from the control signal until the brake bites.
    #[serde(default = "default::brake_dead_time")]
    pub brake_dead_time_s: f64,
    /// Friction torque of the new brake.
    #[serde(default = "default::brake_torque")]
    pub brake_torque_nm: f64,
    /// Part of its torque that the brake loses with each braking.
    #[serde(default = "default::brake_fade")]
    pub brake_fade: f64,
    /// Plays what the circuit is compared with too: the same steps by other leads.
    #[serde(default)]
    pub beside: bool,
    /// The most ticks that go into the VCD unless a window is asked for.
    #[serde(default = "default::vcd_ticks")]
    pub vcd_ticks: u64,
}

/// A table `[[step]]`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepKeys {
    /// Where to stop, in counts.
    pub target: i64,
    /// Speed on the way.
    pub speed_counts_per_s: u32,
    /// Lead time to begin with; 0 for none.
    #[serde(default)]
    pub lead_ms: f64,
    /// Lead time that is set when the load changes.
    pub load_lead_ms: Option<f64>,
}

impl Scenario {
    /// The settings it stands for.
    #[must_use]
    pub fn settings(&self) -> Settings {
        let step = |keys: &StepKeys| Step {
            target: keys.target,
            speed_counts_per_s: keys.speed_counts_per_s,
            lead_ms: keys.lead_ms,
        };
        let load_leads = self.step.iter().map(|keys| keys.load_lead_ms);
        let load_leads_ms = match load_leads.clone().any(|lead| lead.is_some()) {
            true => load_leads.collect(),
            false => Vec::new(),
        };
        Settings {
            clock_hz: self.clock_hz,
            ck_ticks: self.ck_ticks,
            steps: self.step.iter().map(step).collect(),
            targets: self.targets,
            action: self.action,
            operation_delay_s: self.operation_delay_s,
            load_delay_factor: self.load_delay_factor,
            detector: self.detector,
            sampling_clock_ppm: self.sampling_clock_ppm,
            resolver: ResolverParameters {
                pole_pairs: self.pole_pairs,
                sine_offset: self.sine_offset,
                gain_mismatch: self.gain_mismatch,
            },
            lead: self.lead,
            form: self.form,
            placement: self.placement,
            comparing: self.comparing,
            completion: self.completion,
            sign: self.sign,
            function: self.function,
            history: self.history,
            learn: self.learn,
            common_time: self.common_time,
            time_source: self.time_source,
            load_leads_ms,
            seed_ms: self.seed_ms,
            standstill_ms: self.standstill_ms,
            time_out_ms: self.time_out_ms,
            rest_ms: self.rest_ms,
            speed_gate_ms: self.speed_gate_ms,
            speed_lead_ms: self.speed_lead_ms,
            speed_leads_ms: Vec::new(),
            switch_counts: self.switch_counts,
            switches_counts: Vec::new(),
            positionings: self.positionings,
            load_change_after: self.load_change_after,
            load: Load {
                load_inertia_factor: self.load_inertia_factor,
                load_friction_factor: self.load_friction_factor,
                load_brake_factor: self.load_brake_factor,
            },
            body: BodyParameters {
                counts_per_rev: self.counts_per_rev,
                acceleration_counts_per_s2: self.acceleration_counts_per_s2,
                inertia_kg_m2: self.inertia_kg_m2,
                friction_nm: self.friction_nm,
                brake_dead_time_s: self.brake_dead_time_s,
                brake_torque_nm: self.brake_torque_nm,
                brake_fade: self.brake_fade,
            },
        }
    }

    /// What to take from a position log.
    #[must_use]
    pub fn columns(&self) -> Columns {
        Columns {
            time: self.log_time_column.clone(),
            counts: self.log_column.clone(),
            time_unit_s: self.log_time_unit_ms.map(|ms| ms / 1e3),
        }
    }
}

/// What a key is worth that is not given: what the settings are by default.
mod default {
    use super::{BodyParameters, Settings};

    fn settings() -> Settings {
        Settings::default()
    }
    fn body() -> BodyParameters {
        BodyParameters::default()
    }
    pub(super) fn load_factor() -> f64 {
        1.0
    }
    pub(super) fn vcd_ticks() -> u64 {
        super::super::VCD_TICKS
    }
    pub(super) fn clock_hz() -> u64 {
        settings().clock_hz
    }
    pub(super) fn ck_ticks() -> u32 {
        settings().ck_ticks
    }
    pub(super) fn pole_pairs() -> u32 {
        settings().resolver.pole_pairs
    }
    pub(super) fn learn() -> bool {
        settings().learn
    }
    pub(super) fn common_time() -> bool {
        settings().common_time
    }
    pub(super) fn seed() -> f64 {
        settings().seed_ms
    }
    pub(super) fn standstill() -> f64 {
        settings().standstill_ms
    }
    pub(super) fn time_out() -> f64 {
        settings().time_out_ms
    }
    pub(super) fn operation_delay() -> f64 {
        settings().operation_delay_s
    }
    pub(super) fn rest() -> f64 {
        settings().rest_ms
    }
    pub(super) fn speed_gate() -> f64 {
        settings().speed_gate_ms
    }
    pub(super) fn speed_lead() -> f64 {
        settings().speed_lead_ms
    }
    pub(super) fn positionings() -> u32 {
        settings().positionings
    }
    pub(super) fn counts_per_rev() -> f64 {
        body().counts_per_rev
    }
    pub(super) fn acceleration() -> f64 {
        body().acceleration_counts_per_s2
    }
    pub(super) fn inertia() -> f64 {
        body().inertia_kg_m2
    }
    pub(super) fn friction() -> f64 {
        body().friction_nm
    }
    pub(super) fn brake_dead_time() -> f64 {
        body().brake_dead_time_s
    }
    pub(super) fn brake_torque() -> f64 {
        body().brake_torque_nm
    }
    pub(super) fn brake_fade() -> f64 {
        body().brake_fade
    }
}
