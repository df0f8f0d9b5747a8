//! What the lead-angle compensator is run with: clock and CK, steps, learning, body and load.

mod detector;
mod lead;
mod passing;

use super::job::WIDTHS;
use crate::circuits::lead_angle::Memory;
use crate::circuits::lead_angle::codes::LARGEST;
pub use crate::circuits::lead_angle::{Comparing, Detector, Function, LeadForm, Placement, Sign};
use crate::plant::{BodyParameters, Load, ResolverParameters};
use crate::settings::{CLOCK_RANGE_HZ, Place, SettingError, within};
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
/// How many steps there may be.
pub const STEPS_RANGE: RangeInclusive<usize> = 1..=1 << WIDTHS.step;
/// How many positionings a run may have.
pub const POSITIONINGS_RANGE: RangeInclusive<u32> = 1..=10_000;
/// Times other than lead times that are accepted, in CKs.
pub const TIME_RANGE_CKS: RangeInclusive<u16> = 1..=((1u32 << WIDTHS.cks) - 1) as u16;

/// What keeps the positions of the past (11).
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

/// Where the lead of the scenario's own system comes from.
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

/// What the control signal is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// To stop the body at the target.
    #[default]
    Stop,
    /// An operation that is to take effect at the target while the body goes on; a sensor says when
    /// it does.
    Operate,
}

/// What a target counts from.
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

/// Where the first time data come from (25).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TimeSource {
    /// A ROM: they are there at power-on.
    #[default]
    Rom,
    /// A setter: the control computer writes them before the first step.
    Setter,
}

/// One step of the sequence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Sx: where to stop, in counts from where [`Targets`] says.
    pub target: i64,
    /// Speed on the way, in counts a second.
    pub speed_counts_per_s: u32,
    /// Δt to begin with; 0 for none.
    pub lead_ms: f64,
}

/// Settings of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Reference clock in Hz.
    pub clock_hz: u64,
    /// Ticks of a CK.
    pub ck_ticks: u32,
    /// The steps, run over and over from a rest at position 0.
    pub steps: Vec<Step>,
    /// What their targets count from.
    pub targets: Targets,
    /// What the control signal is for.
    pub action: Action,
    /// Time from the control signal until an operation takes effect.
    pub operation_delay_s: f64,
    /// The factor of that time from the load change on.
    pub load_delay_factor: f64,
    /// What the position comes from (10).
    pub detector: Detector,
    /// How much faster than a CK of `ck_ticks` an absolute encoder's sampling clock is, in parts per
    /// million.
    pub sampling_clock_ppm: f64,
    /// The resolver, where it is the detector.
    pub resolver: ResolverParameters,
    /// Where the lead comes from.
    pub lead: LeadBy,
    /// Which of the equal forms the lead of a time has.
    pub form: LeadForm,
    /// Where the lead is placed.
    pub placement: Placement,
    /// When the comparator gives the control signal.
    pub comparing: Comparing,
    /// The sign of the stop error.
    pub sign: Sign,
    /// What is made of error and overrun.
    pub function: Function,
    /// What keeps the positions of the past.
    pub history: History,
    /// The time data are corrected after each positioning.
    pub learn: bool,
    /// All steps share the time data of step 0.
    pub common_time: bool,
    /// Where the first time data come from (25).
    pub time_source: TimeSource,
    /// Δt by step that is set when the load changes, before the next positioning; empty for none.
    pub load_leads_ms: Vec<Option<f64>>,
    /// What a step without time data begins to learn with; 0 for nothing.
    pub seed_ms: f64,
    /// When a positioning is complete.
    pub completion: Completion,
    /// How long the position must stay for a positioning to be complete.
    pub standstill_ms: f64,
    /// How long a positioning may take after the control signal.
    pub time_out_ms: f64,
    /// Pause between positionings.
    pub rest_ms: f64,
    /// Time over which the conventional compensator (Fig. 7) measures the speed.
    pub speed_gate_ms: f64,
    /// What it multiplies the speed with (a).
    pub speed_lead_ms: f64,
    /// The same for each step, which the control computer sets; empty where it is the same for all.
    pub speed_leads_ms: Vec<f64>,
    /// How far before its target each switch of the simplest conventional system stands, in counts;
    /// without it, as far as the first stop of its step wants.
    pub switch_counts: Option<u32>,
    /// How far before the target of a step its control signal comes, whatever else the lead does;
    /// empty for none.
    pub switches_counts: Vec<u32>,
    /// How many positionings there are in all.
    pub positionings: u32,
    /// How many there are before the load changes; without it the load stays.
    pub load_change_after: Option<u32>,
    /// The load from then on.
    pub load: Load,
    /// Drive, body, brake and encoder.
    pub body: BodyParameters,
}

impl Default for Settings {
    /// A rotary table to and fro, a CK of 0.1 ms at 1 MHz.
    fn default() -> Self {
        let step = |target, speed_counts_per_s| Step {
            target,
            speed_counts_per_s,
            lead_ms: 0.0,
        };
        Self {
            clock_hz: 1_000_000,
            ck_ticks: 100,
            steps: vec![step(15_000, 40_000), step(0, 40_000)],
            targets: Targets::default(),
            action: Action::default(),
            operation_delay_s: 0.02,
            load_delay_factor: 1.0,
            detector: Detector::default(),
            sampling_clock_ppm: 0.0,
            resolver: ResolverParameters::default(),
            lead: LeadBy::default(),
            form: LeadForm::default(),
            placement: Placement::default(),
            comparing: Comparing::default(),
            completion: Completion::default(),
            sign: Sign::default(),
            function: Function::default(),
            history: History::default(),
            learn: true,
            common_time: false,
            time_source: TimeSource::default(),
            load_leads_ms: Vec::new(),
            seed_ms: 20.0,
            standstill_ms: 5.0,
            time_out_ms: 1000.0,
            rest_ms: 20.0,
            speed_gate_ms: 5.0,
            speed_lead_ms: 25.0,
            speed_leads_ms: Vec::new(),
            switch_counts: None,
            switches_counts: Vec::new(),
            positionings: 24,
            load_change_after: None,
            load: Load::NONE,
            body: BodyParameters::default(),
        }
    }
}

impl Settings {
    /// Duration of a CK.
    #[must_use]
    pub fn ck_ms(&self) -> f64 {
        1e3 * f64::from(self.ck_ticks) / self.clock_hz as f64
    }

    /// Where a positioning, by its number from 0 on, is to stop, in counts from the start.
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

    /// Where its switch stands: the target, or so much before it.
    pub(super) fn switch(&self, positioning: usize) -> i64 {
        let counts = self.switches_counts.get(positioning % self.steps.len());
        let before = counts.map_or(0, |counts| i64::from(*counts));
        self.target(positioning) - self.way(positioning).signum() * before
    }

    /// How far before its target the switch of a step can stand: less than its way.
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

    /// A time other than a lead time in whole CKs; saturates.
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

    /// Checks every field. A body that operates in passing comes to each target after its step is
    /// armed, its lead before it.
    ///
    /// # Errors
    ///
    /// Names the first field at fault, its value and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        self.validate_fields()?;
        self.validate_passing(|index| self.own_leads_s(index))
    }

    /// Checks what a run needs, whatever its leads are: in passing, a body does not turn back.
    pub(super) fn validate_driven(&self) -> Result<(), SettingError> {
        self.validate_fields()?;
        self.validate_passing(|_| [0.0; 2])
    }

    /// Checks every field by itself.
    pub(super) fn validate_fields(&self) -> Result<(), SettingError> {
        within("clock_hz", self.clock_hz, &CLOCK_RANGE_HZ)?;
        within("ck_ticks", self.ck_ticks, &CK_RANGE_TICKS)?;
        let count = self.steps.len();
        if !STEPS_RANGE.contains(&count) {
            let (least, most) = STEPS_RANGE.into_inner();
            let (value, allowed) = (format!("{count} steps"), format!("{least} to {most} steps"));
            return Err(SettingError::value("step", value, allowed));
        }
        if count == 1 && self.targets == Targets::Absolute && self.positionings > 1 {
            // From the second positioning on there would be no way to go.
            let allowed = "2 to 16, or targets = \"relative\", or positionings = 1";
            return Err(SettingError::value("step", "1 step", allowed));
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
        if let Some(counts) = self.switch_counts {
            let farthest = (0..count).map(|step| self.farthest_switch(step)).min();
            within("switch_counts", counts, &(0..=farthest.unwrap_or(0)))?;
        }
        within("positionings", self.positionings, &POSITIONINGS_RANGE)?;
        if let Some(after) = self.load_change_after {
            within("load_change_after", after, &(1..=self.positionings))?;
        }
        if self.action == Action::Operate && self.completion == Completion::FixedTime {
            let allowed = "standstill with action = \"operate\": its effect is what it waits for";
            return Err(SettingError::value("completion", "fixed_time", allowed));
        }
        within("operation_delay_s", self.operation_delay_s, &(0.0..=10.0))?;
        within("load_delay_factor", self.load_delay_factor, &(1e-3..=1e3))?;
        self.load.validate()?;
        self.body.validate()
    }

    fn validate_step(&self, index: usize) -> Result<(), SettingError> {
        let Step {
            target,
            speed_counts_per_s: speed,
            lead_ms,
        } = self.steps[index];
        within("target", target, &TARGET_RANGE_COUNTS)?;
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
