//! Settings of the lead-angle compensator: clock and CK, steps, learning, body and load.

mod detector;
mod lead;
mod passing;

use super::job::WIDTHS;
use crate::circuits::lead_angle::Memory;
use crate::circuits::lead_angle::codes::LARGEST;
pub use crate::circuits::lead_angle::{Comparing, Detector, Function, LeadForm, Placement, Sign};
use crate::input::position_log::Columns;
use crate::plant::{BodyParameters, Load, MOST_TORQUE_NM, ResolverParameters};
use crate::settings::{CLOCK_RANGE_HZ, Place, SettingError, choices, settings, within};
pub use detector::{CONVERSION_TICKS, PITCH_RANGE_COUNTS, SAMPLING_RANGE_PPM, TURN_RANGE_COUNTS};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Counts a second in a unit of the speed word.
pub const SPEED_UNIT_COUNTS_PER_S: u32 = 10;

/// Ticks of a CK that are accepted.
pub const CK_RANGE_TICKS: RangeInclusive<u32> = 4..=(1 << WIDTHS.ck_period) - 1;
/// Targets that are accepted, in counts: no way between two of them is half of what wraps.
pub const TARGET_RANGE_COUNTS: RangeInclusive<i64> =
    -(1 << (WIDTHS.position - 3))..=1 << (WIDTHS.position - 3);
/// Greatest distance of a switch from its target, in counts: less than any way.
const SWITCH_MOST_COUNTS: u32 =
    (*TARGET_RANGE_COUNTS.end() - *TARGET_RANGE_COUNTS.start()) as u32 - 1;
/// Allowed count of steps.
pub const STEPS_RANGE: RangeInclusive<usize> = 1..=1 << WIDTHS.step;
/// Allowed count of positionings in a run.
pub const POSITIONINGS_RANGE: RangeInclusive<u32> = 1..=10_000;
/// CKs at any clock, in milliseconds.
const CK_RANGE_MS: [f64; 2] = [
    *CK_RANGE_TICKS.start() as f64 * 1e3 / *CLOCK_RANGE_HZ.end() as f64,
    *CK_RANGE_TICKS.end() as f64 * 1e3 / *CLOCK_RANGE_HZ.start() as f64,
];
/// Lead times at any clock, in milliseconds.
pub const LEAD_RANGE_MS: RangeInclusive<f64> = 0.0..=LARGEST as f64 * CK_RANGE_MS[1];
/// Times other than lead times at any clock, in milliseconds.
pub const TIME_RANGE_MS: RangeInclusive<f64> =
    CK_RANGE_MS[0]..=*TIME_RANGE_CKS.end() as f64 * CK_RANGE_MS[1];
/// Speeds that the speed word holds, in counts a second.
pub const SPEED_RANGE_COUNTS_PER_S: RangeInclusive<u32> =
    SPEED_UNIT_COUNTS_PER_S..=((1 << WIDTHS.speed) - 1) * SPEED_UNIT_COUNTS_PER_S;
/// Times other than lead times that are accepted, in CKs.
pub const TIME_RANGE_CKS: RangeInclusive<u16> = 1..=((1u32 << WIDTHS.cks) - 1) as u16;

/// Memory of the past positions (11).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum History {
    /// A shift register with taps.
    #[default]
    ShiftRegister,
    /// A RAM with a moving address.
    Ram,
}

impl History {
    /// The memory that it is.
    #[must_use]
    pub fn memory(self) -> Memory {
        match self {
            History::ShiftRegister => Memory::ShiftRegister,
            History::Ram => Memory::Ram,
        }
    }
}

/// Source of the lead of the scenario's own system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeadBy {
    /// The way of the last Δt.
    #[default]
    Time,
    /// The measured speed times a parameter, as in Fig. 7.
    Speed,
    /// The measured speed by a memory of the leads that the machine's numbers ask for, as in Fig. 7.
    Table,
}

/// Purpose of the control signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// Stops the body at the target.
    #[default]
    Stop,
    /// Starts an operation that takes effect at the target while the body goes on; a sensor reports
    /// the effect.
    Operate,
}

/// Reference point of a target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Targets {
    /// The start: steps come to the same places over and over.
    #[default]
    Absolute,
    /// The target before it: the body turns, or feeds, on and on. No stop error goes into the next.
    Relative,
}

/// When a positioning is complete (26).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Completion {
    /// The body has stood still for `standstill_ms`, or its time is over.
    #[default]
    Standstill,
    /// `time_out_ms` after the control signal, whether the body stands or turns.
    FixedTime,
}

/// Source of the first time data (25).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TimeSource {
    /// A ROM: they are there at power-on.
    #[default]
    Rom,
    /// A setter: the control computer writes them before the first step.
    Setter,
}

choices!(
    Action, Comparing, Completion, Detector, Function, History, LeadBy, LeadForm, Placement, Sign,
    Targets, TimeSource,
);

settings! {
    /// One step of the sequence.
    #[derive(Copy)]
    pub struct Step {
        /// Sx: position to stop at, counted from where `targets` says.
        pub target [required]: i64 = 0, in TARGET_RANGE_COUNTS;
        /// Speed of the positioning.
        pub speed_counts_per_s [required]: u32 = SPEED_UNIT_COUNTS_PER_S,
            within SPEED_RANGE_COUNTS_PER_S, "a multiple of 10 that the detector follows";
        /// Δt: lead time to begin with; 0 for none.
        pub lead_ms: f64 = 0.0, within LEAD_RANGE_MS, "whole CKs that a code has";
        /// Lead time that is set when the load changes, before the next positioning; without it the
        /// step keeps its lead time.
        pub load_lead_ms: Option<f64> = None, within LEAD_RANGE_MS, "whole CKs that a code has";
    }
}

settings! {
    /// Settings of a run. Default: a rotary table with a CK of 0.1 ms at 1 MHz.
    pub struct Settings {
        /// Column of the log that has the counts, by name or number; without it the column `counts`,
        /// or else the one of whole numbers that is no index. The summary names it.
        pub log_column: Option<String> = None;
        /// Column of the log that has the times; without it the column `time`, or else the one of
        /// numbers that do not fall.
        pub log_time_column: Option<String> = None;
        /// Unit of the log's times. Without it that of the header, as in `Time [s]` or `time_ms`, or
        /// else of s, ms, us and ns the one with which the median step is 10 us to 1 s.
        pub log_time_unit_ms: Option<f64> = None, in 1e-9..=1e7;
        /// Reference clock.
        pub clock_hz: u64 = 1_000_000, in CLOCK_RANGE_HZ;
        /// Period of CK.
        pub ck_ticks: u32 = 100, in CK_RANGE_TICKS;
        /// Steps, run over and over from a rest at position 0.
        pub steps as "step" [required]: Vec<Step> = vec![step(15_000, 40_000), step(0, 40_000)],
            "1 to 16; 1 only with relative targets or for one positioning";
        /// Origin of targets: the start, or with `relative` the target before.
        pub targets: Targets = Targets::default();
        /// Purpose of the control signal: to stop the body, or an operation in passing.
        pub action: Action = Action::default();
        /// Time from the control signal until an operation takes effect.
        pub operation_delay_s: f64 = 0.02, in 0.0..=10.0;
        /// Factor of that time from the load change on.
        pub load_delay_factor: f64 = 1.0, in 1e-3..=1e3;
        /// Source of the position (10): an incremental encoder; an absolute one of a turn of
        /// `counts_per_rev`, an even number up to 131,072, with CK as its sampling clock; a
        /// phase-shift transducer with CK as its carrier, whose turn has whole pitches of `ck_ticks`
        /// counts, 16 to 131,072; or a resolver with CK as its conversions, of 19 ticks at least.
        pub detector: Detector = Detector::default();
        /// Excess of an absolute encoder's sampling clock over CK.
        pub sampling_clock_ppm: f64 = 0.0, in SAMPLING_RANGE_PPM,
            "with detector = \"absolute\" alone";
        /// Source of the lead: the distance of the last Δt; or, as in Fig. 7, the measured speed
        /// times a parameter, or a memory addressed by the speed. A log is predicted with `time` or
        /// `speed`.
        pub lead: LeadBy = LeadBy::default();
        /// Form in which the lead is computed from the lead time; all forms give the same lead.
        pub form: LeadForm = LeadForm::default();
        /// Place of the lead: on the position, on the target, or half on each.
        pub placement: Placement = Placement::default();
        /// Condition of the control signal: the prediction crosses the target, or equals it, as the
        /// text has it.
        pub comparing: Comparing = Comparing::default();
        /// Sign of the stop error; `literal` is the text's.
        pub sign: Sign = Sign::default();
        /// Next lead time as a function of lead time, error and overrun.
        pub function: Function = Function::default();
        /// Memory of past positions (11).
        pub history: History = History::default();
        /// True if lead times are corrected after each positioning.
        pub learn: bool = true;
        /// True if all steps share the lead time of step 0.
        pub common_time: bool = false;
        /// Source of the first lead times (25): there at power-on, or written by the control computer.
        pub time_source: TimeSource = TimeSource::default();
        /// Lead time with which a step without one begins to learn; 0 for none.
        pub seed_ms: f64 = 20.0, within LEAD_RANGE_MS, "whole CKs that a code has";
        /// End of a positioning (26): the body has stood still, or `time_out_ms` after the control
        /// signal at the latest; with `fixed_time` always then.
        pub completion: Completion = Completion::default();
        /// Time that the position must stay for a positioning to be complete.
        pub standstill_ms: f64 = 5.0, within TIME_RANGE_MS, "1 to 65535 CKs";
        /// Time that a positioning may take after the control signal.
        pub time_out_ms: f64 = 1000.0, within TIME_RANGE_MS, "1 to 65535 CKs";
        /// Pause between positionings.
        pub rest_ms: f64 = 20.0, within TIME_RANGE_MS, "1 to 65535 CKs";
        /// Time over which the conventional compensator of Fig. 7 measures the speed.
        pub speed_gate_ms: f64 = 5.0, within TIME_RANGE_MS, "1 to 65535 CKs";
        /// Parameter by which it multiplies the speed (a).
        pub speed_lead_ms: f64 = 25.0, within LEAD_RANGE_MS, "0 to 1990 CKs";
        /// Distance of each displaced switch from its target; without it as far as the first stop of
        /// its step is off.
        pub switch_counts: Option<u32> = None, within 0..=SWITCH_MOST_COUNTS, "less than any way";
        /// Number of positionings.
        pub positionings: u32 = 24, in POSITIONINGS_RANGE;
        /// Number of positionings before the load changes; without it the load stays.
        pub load_change_after: Option<u32> = None, within POSITIONINGS_RANGE, "1 to positionings";
    }
    flat {
        /// Resolver, if it is the detector.
        pub resolver: ResolverParameters = ResolverParameters::default();
        /// Load from the load change on.
        pub load: Load = Load::default();
        /// Drive, body, brake and encoder.
        pub body: BodyParameters = BodyParameters::default();
    }
    beside {
        /// Parameter of the conventional compensator for each step, which the control computer sets;
        /// empty where all have `speed_lead_ms`.
        pub speed_leads_ms: Vec<f64> = Vec::new();
        /// Distance of each step's control signal from its target, in counts, whatever else the lead
        /// does; empty for none.
        pub switches_counts: Vec<u32> = Vec::new();
    }
}

/// A step without a lead.
fn step(target: i64, speed_counts_per_s: u32) -> Step {
    Step {
        target,
        speed_counts_per_s,
        ..Step::default()
    }
}

impl Settings {
    /// Duration of a CK.
    #[must_use]
    pub fn ck_ms(&self) -> f64 {
        1e3 * f64::from(self.ck_ticks) / self.clock_hz as f64
    }

    /// Returns the columns to take from a position log.
    #[must_use]
    pub fn columns(&self) -> Columns {
        Columns {
            time: self.log_time_column.clone(),
            counts: self.log_column.clone(),
            time_unit_s: self.log_time_unit_ms.map(|ms| ms / 1e3),
        }
    }

    /// True if some step has a lead time for the load from the load change on.
    #[must_use]
    pub fn has_load_leads(&self) -> bool {
        self.steps.iter().any(|step| step.load_lead_ms.is_some())
    }

    /// Returns the target of a positioning, numbered from 0, in counts from the start.
    #[must_use]
    pub fn target(&self, positioning: usize) -> i64 {
        let count = self.steps.len();
        let (cycle, step) = (positioning / count, positioning % count);
        let ways = |steps: &[Step]| steps.iter().map(|step| step.target).sum::<i64>();
        match self.targets {
            Targets::Absolute => self.steps[step].target,
            Targets::Relative => cycle as i64 * ways(&self.steps) + ways(&self.steps[..=step]),
        }
    }

    /// Its way from the target before.
    #[must_use]
    pub fn way(&self, positioning: usize) -> i64 {
        let before = positioning.checked_sub(1);
        self.target(positioning) - before.map_or(0, |before| self.target(before))
    }

    /// Returns the position of its switch: the target, or the configured distance before it.
    pub(super) fn switch(&self, positioning: usize) -> i64 {
        let counts = self.switches_counts.get(positioning % self.steps.len());
        let before = counts.map_or(0, |counts| i64::from(*counts));
        self.target(positioning) - self.way(positioning).signum() * before
    }

    /// Returns the largest distance of a step's switch before its target: less than the step's way.
    #[must_use]
    pub fn farthest_switch(&self, step: usize) -> u32 {
        let ways = [step, step + self.steps.len()].map(|number| self.way(number).unsigned_abs());
        let shortest = ways[0].min(ways[1]).saturating_sub(1);
        u32::try_from(shortest).unwrap_or(u32::MAX)
    }

    /// Ticks from the control signal until an operation takes effect, before the load change or
    /// after it.
    #[must_use]
    pub fn operation_delay(&self, loaded: bool) -> u64 {
        let factor = if loaded { self.load_delay_factor } else { 1.0 };
        (self.operation_delay_s * factor * self.clock_hz as f64).round() as u64
    }

    /// Returns a time other than a lead time in whole CKs; saturates.
    #[must_use]
    pub fn cks(&self, ms: f64) -> u16 {
        (ms / self.ck_ms()).round() as u16
    }

    /// The fastest speed of a step in counts a second.
    #[must_use]
    pub fn fastest_counts_per_s(&self) -> u32 {
        let word = ((1 << WIDTHS.speed) - 1) * SPEED_UNIT_COUNTS_PER_S;
        u64::from(word).min(self.followed_counts_per_s() as u64) as u32
    }

    /// Checks every field, and that a body that operates in passing reaches the lead before each
    /// target after the step is armed.
    ///
    /// # Errors
    ///
    /// Names the first field at fault, its value and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        self.validate_fields()?;
        self.validate_passing(|index| self.own_leads_s(index))
    }

    /// Checks the conditions of a run with any lead: in passing, a body does not turn back.
    pub(super) fn validate_driven(&self) -> Result<(), SettingError> {
        self.validate_fields()?;
        self.validate_passing(|_| [0.0; 2])
    }

    /// Checks every field by itself.
    pub(super) fn validate_fields(&self) -> Result<(), SettingError> {
        self.ranges()?;
        let count = self.steps.len();
        if !STEPS_RANGE.contains(&count) {
            let (least, most) = STEPS_RANGE.into_inner();
            let problem = format!("{count} tables are given");
            let allowed = format!("{least} to {most} tables [[step]]");
            return Err(SettingError::new("step", problem, allowed));
        }
        if count == 1 && self.targets == Targets::Absolute && self.positionings > 1 {
            // From the second positioning on there would be no way to go.
            let problem = "1 table is given";
            let allowed = "2 to 16 tables [[step]], or targets = \"relative\", or positionings = 1";
            return Err(SettingError::new("step", problem, allowed));
        }
        self.validate_detector()?;
        self.validate_form()?;
        for index in 0..count {
            self.validate_step(index)
                .map_err(|error| error.at(Place::Row("step", index)))?;
        }
        self.validate_load_leads()?;
        self.check_lead("seed_ms", self.seed_ms)?;
        let times = [
            ("standstill_ms", self.standstill_ms),
            ("time_out_ms", self.time_out_ms),
            ("rest_ms", self.rest_ms),
            ("speed_gate_ms", self.speed_gate_ms),
        ];
        let ck = self.ck_ms();
        let (least, most) = (*TIME_RANGE_CKS.start(), *TIME_RANGE_CKS.end());
        let allowed = f64::from(least) * ck..=f64::from(most) * ck;
        for (field, ms) in times {
            within(field, ms, &allowed)?;
        }
        let longest = LARGEST as f64 * ck;
        for ms in [self.speed_lead_ms].iter().chain(&self.speed_leads_ms) {
            within("speed_lead_ms", *ms, &(0.0..=longest))?;
        }
        self.validate_torques()?;
        if let Some(counts) = self.switch_counts {
            let farthest = (0..count).map(|step| self.farthest_switch(step)).min();
            within("switch_counts", counts, &(0..=farthest.unwrap_or(0)))?;
        }
        if let Some(after) = self.load_change_after {
            within("load_change_after", after, &(1..=self.positionings))?;
        }
        if self.action == Action::Operate && self.completion == Completion::FixedTime {
            let allowed = "standstill with action = \"operate\": its effect is what it waits for";
            return Err(SettingError::value("completion", "fixed_time", allowed));
        }
        Ok(())
    }

    /// Friction and brake together, before the load change and after it, are a torque that the waves
    /// hold.
    fn validate_torques(&self) -> Result<(), SettingError> {
        let (body, load) = (&self.body, &self.load);
        let plain = Load::default();
        for (load, fields) in [
            (&plain, ["friction_nm", "brake_torque_nm"]),
            (load, ["load_friction_factor", "load_brake_factor"]),
        ] {
            let friction = body.friction_nm * load.load_friction_factor;
            let brake = body.brake_torque_nm * load.load_brake_factor;
            let total = friction + brake;
            if total > MOST_TORQUE_NM {
                let (field, value, own) = match (friction > brake, load == &plain) {
                    (true, true) => (fields[0], body.friction_nm, friction),
                    (true, false) => (fields[0], load.load_friction_factor, friction),
                    (false, true) => (fields[1], body.brake_torque_nm, brake),
                    (false, false) => (fields[1], load.load_brake_factor, brake),
                };
                let most = (MOST_TORQUE_NM - (total - own)) / (own / value);
                let problem = format!("is {value}: friction and brake are {total} N·m");
                let allowed = format!("{most} at most: {MOST_TORQUE_NM} N·m together");
                return Err(SettingError::new(field, problem, allowed));
            }
        }
        Ok(())
    }

    fn validate_step(&self, index: usize) -> Result<(), SettingError> {
        let Step {
            target,
            speed_counts_per_s: speed,
            lead_ms,
            ..
        } = self.steps[index];
        self.steps[index].ranges()?;
        let before = (index + self.steps.len() - 1) % self.steps.len();
        if self.targets == Targets::Relative && target == 0 {
            return Err(SettingError::value("target", target, "a way other than 0"));
        }
        let absolute = self.targets == Targets::Absolute;
        let start = absolute && index == 0 && target == 0;
        let same = absolute && before != index && target == self.steps[before].target;
        if start || same {
            let place = match start {
                true => "the start".to_owned(),
                false => format!("step {before}"),
            };
            let allowed = format!("another target than that of {place}");
            return Err(SettingError::value("target", target, allowed));
        }
        let unit = SPEED_UNIT_COUNTS_PER_S;
        let fastest = self.fastest_counts_per_s();
        if fastest < unit {
            let followed = self.followed_counts_per_s();
            let problem = format!("is {speed}, and the detector follows {followed} at most");
            let allowed = format!("{unit} or more, at a faster clock or with a finer detector");
            return Err(SettingError::new("speed_counts_per_s", problem, allowed));
        }
        if !(unit..=fastest).contains(&speed) || !speed.is_multiple_of(unit) {
            let allowed = format!("{unit} to {fastest}, a multiple of {unit}");
            return Err(SettingError::value("speed_counts_per_s", speed, allowed));
        }
        if self.common_time && index > 0 && lead_ms != 0.0 {
            let allowed = "0: with common_time all steps take that of step 0";
            return Err(SettingError::value("lead_ms", lead_ms, allowed));
        }
        self.check_lead("lead_ms", lead_ms)
    }
}

#[cfg(test)]
mod tests;
