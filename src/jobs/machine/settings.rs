//! What the machine is run with: clock and rates, steppers, servos, pen lift.

use crate::jobs::arc_generator::settings::{self as arcs, ShortPieces};
use crate::jobs::lead_angle::settings as lift;
pub use crate::jobs::lead_angle::settings::History;
use crate::jobs::linear_interpolator::targets::{LATENCY_TICKS, LONGEST_RAMP};
use crate::jobs::pulse_interpolator::{self as pulse, StepTiming};
use crate::jobs::trajectory_controller::settings as trajectory;
pub use crate::jobs::trajectory_controller::settings::Correction;
use crate::plan::MotionLimits;
use crate::plant::{BodyParameters, TwoMassParameters};
use crate::settings::{CLOCK_RANGE_HZ, IN_POSITION_RANGE, Place, SettingError, WholeTime, within};
use std::ops::RangeInclusive;

/// Ticks of a period that the counters hold.
const PERIOD: RangeInclusive<u32> = 1..=(1 << 24) - 1;
/// Shortest scan in ticks: the linear interpolator makes its commands within it.
pub const LEAST_SCAN_TICKS: u64 = LATENCY_TICKS as u64;
/// Shortest sampling time in ticks: arc generator and trajectory controller are done within it.
pub const LEAST_SAMPLE_TICKS: u64 = {
    let (arcs, trajectory) = (arcs::LEAST_SAMPLE_TICKS, trajectory::LEAST_PERIOD_TICKS);
    if arcs > trajectory { arcs } else { trajectory }
};

/// Settings of the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Reference clock in Hz.
    pub clock_hz: u64,
    /// T: unit time of the pulse interpolator, in ticks.
    pub unit_ticks: u32,
    /// Scan of the linear interpolator, in ticks.
    pub scan_ticks: u32,
    /// CK of the lead-angle compensator, in ticks.
    pub ck_ticks: u32,
    /// Ts: sampling time of arc generator and trajectory controller, in ticks.
    pub sample_ticks: u32,
    /// Steps of the steppers per millimetre, X and Y.
    pub steps_per_mm: [f64; 2],
    /// What the stepper drivers ask of their inputs.
    pub step_timing: StepTiming,
    /// Counts of the servos per millimetre.
    pub counts_per_mm: f64,
    /// Speed of the moves that set none, and of rapid ones; corners and acceleration of the
    /// steppers. The acceleration across arcs is that of the servos too.
    pub motion: MotionLimits,
    /// Time in which the servos come to speed, and to rest.
    pub acceleration_ms: f64,
    /// K1 in 1/s.
    pub k1_per_s: f64,
    /// K2 in 1/s.
    pub k2_per_s: f64,
    /// What the trajectory controller adds to the commands.
    pub correction: Correction,
    /// Gain of the position controls in 1/s.
    pub position_gain_per_s: f64,
    /// Bandwidth of the speed controls in Hz.
    pub speed_hz: f64,
    /// Integral time of the speed controls; 0 for no integral.
    pub integral_ms: f64,
    /// A move begins when both motors are as near to their commands.
    pub in_position_counts: u32,
    /// Amplifier, motor, load and encoder of X and Y.
    pub axis: TwoMassParameters,
    /// Where the lift has the pen down; up is 0.
    pub pen_down_counts: i64,
    /// Speed of the lift in counts a second.
    pub lift_counts_per_s: u32,
    /// Lead of the lift's brake before anything is learned.
    pub lift_lead_ms: f64,
    /// Memory of the lift's past positions.
    pub lift_history: History,
    /// Drive, body, brake and encoder of the lift.
    pub lift: BodyParameters,
}

impl Default for Settings {
    /// A plotter at 400 kHz with steppers of 40 steps and servos of 1000 counts a millimetre.
    fn default() -> Self {
        let servo = trajectory::Settings::default();
        Settings {
            clock_hz: 400_000,
            unit_ticks: 2000,
            scan_ticks: 400,
            ck_ticks: 40,
            sample_ticks: 400,
            steps_per_mm: [40.0; 2],
            step_timing: StepTiming {
                min_high: 2,
                min_low: 2,
                dir_setup: 5,
                dir_hold: 5,
            },
            counts_per_mm: servo.counts_per_mm,
            motion: MotionLimits::default(),
            acceleration_ms: 40.0,
            k1_per_s: servo.k1_per_s.of(0),
            k2_per_s: servo.k2_per_s.of(0),
            correction: servo.correction,
            position_gain_per_s: servo.position_gain_per_s,
            speed_hz: servo.speed_hz,
            integral_ms: servo.integral_ms,
            in_position_counts: 4,
            axis: TwoMassParameters::default(),
            pen_down_counts: 4000,
            lift_counts_per_s: 20_000,
            lift_lead_ms: 25.0,
            lift_history: History::default(),
            lift: lift_body(),
        }
    }
}

/// A cam of half a kilogram that turns half a revolution, stopped from full speed in 80 ms.
#[must_use]
pub fn lift_body() -> BodyParameters {
    BodyParameters {
        counts_per_rev: 8000.0,
        acceleration_counts_per_s2: 600_000.0,
        inertia_kg_m2: 0.02,
        friction_nm: 0.2,
        brake_dead_time_s: 0.012,
        brake_torque_nm: 4.0,
        brake_fade: 0.0,
    }
}

impl Settings {
    /// Checks the rates and what no part of the machine checks for itself.
    ///
    /// # Errors
    /// Names the first field at fault, its value and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        within("clock_hz", self.clock_hz, &CLOCK_RANGE_HZ)?;
        let least = [
            ("unit_ticks", self.unit_ticks, 1),
            ("scan_ticks", self.scan_ticks, LEAST_SCAN_TICKS),
            (
                "ck_ticks",
                self.ck_ticks,
                u64::from(*lift::CK_RANGE_TICKS.start()),
            ),
            ("sample_ticks", self.sample_ticks, LEAST_SAMPLE_TICKS),
        ];
        for (field, ticks, least) in least {
            within(field, u64::from(ticks), &(least..=u64::from(*PERIOD.end())))?;
        }
        within(
            "in_position_counts",
            self.in_position_counts,
            &IN_POSITION_RANGE,
        )?;
        let blend = 2.0 * self.sample_s();
        let longest = LONGEST_RAMP as f64 * self.scan_s();
        if blend > longest {
            let (ticks, scan) = (self.sample_ticks, self.scan_ticks);
            let allowed = format!(
                "up to {} at scan_ticks = {scan}: an arc's two sampling times within {LONGEST_RAMP} scans",
                LONGEST_RAMP * u64::from(scan) / 2
            );
            return Err(SettingError::value("sample_ticks", ticks, allowed));
        }
        let range = 1e3 * blend.max(self.scan_s())..=1e3 * longest;
        within("acceleration_ms", self.acceleration_ms, &range)?;
        if self.pen_down_counts == 0 {
            let allowed = "a position other than 0, where the pen is up";
            return Err(SettingError::value("pen_down_counts", 0, allowed));
        }
        if self.correction == Correction::Feedback {
            let problem = "is \"feedback\"";
            let allowed =
                "\"vector\", \"none\" or \"steady\": the machine's commands come from elsewhere";
            return Err(SettingError::new("correction", problem, allowed));
        }
        let in_table = |name| move |error: SettingError| error.at(Place::Table(name));
        self.axis.validate().map_err(in_table("machine"))?;
        self.lift.validate().map_err(in_table("lift"))
    }

    /// Ts in seconds.
    #[must_use]
    pub fn sample_s(&self) -> f64 {
        f64::from(self.sample_ticks) / self.clock_hz as f64
    }

    /// A scan in seconds.
    #[must_use]
    pub fn scan_s(&self) -> f64 {
        f64::from(self.scan_ticks) / self.clock_hz as f64
    }

    /// `acceleration_ms` as it is taken on lines, in scans, and on arcs, in pairs of samples.
    #[must_use]
    pub fn ramps(&self) -> [WholeTime; 2] {
        [self.scan_s(), 2.0 * self.sample_s()]
            .map(|period_s| WholeTime::new("acceleration_ms", self.acceleration_ms, 1e3 * period_s))
    }

    /// What the steppers' table is compiled for.
    #[must_use]
    pub fn pulse(&self) -> pulse::Settings {
        pulse::Settings {
            clock_hz: self.clock_hz,
            steps_per_mm: self.steps_per_mm.to_vec(),
            motion: self.motion,
            line_unit_ticks: self.unit_ticks,
            arc_unit_ticks: self.unit_ticks,
            timing: self.step_timing,
            ..pulse::Settings::default()
        }
    }

    /// What arcs are prepared for: an even number of samples to come to speed.
    #[must_use]
    pub fn arcs(&self) -> arcs::Settings {
        let [_, arcs] = self.ramps();
        arcs::Settings {
            clock_hz: self.clock_hz,
            sample_period_ms: 1e3 * self.sample_s(),
            acceleration_ms: arcs.ms(),
            counts_per_mm: self.counts_per_mm,
            speed_mm_per_s: Some(self.motion.feed_mm_per_min / 60.0),
            rapid_mm_per_s: self.motion.rapid_mm_per_min / 60.0,
            corner_deg: 0.0,
            rounding: arcs::Settings::default().rounding,
            blend: arcs::Settings::default().blend,
            short_pieces: ShortPieces::Slower,
        }
    }

    /// What the trajectory controller is set to.
    #[must_use]
    pub fn trajectory(&self) -> trajectory::Settings {
        trajectory::Settings {
            clock_hz: self.clock_hz,
            period_ms: 1e3 * self.sample_s(),
            counts_per_mm: self.counts_per_mm,
            feed_mm_per_s: Some(self.motion.feed_mm_per_min / 60.0),
            rapid_mm_per_s: self.motion.rapid_mm_per_min / 60.0,
            acceleration_mm_per_s2: Some(self.motion.acceleration_mm_per_s2),
            normal_acceleration_mm_per_s2: self.motion.acceleration_mm_per_s2,
            corner_mm_per_s: 0.0,
            k1_per_s: self.k1_per_s.into(),
            k2_per_s: self.k2_per_s.into(),
            correction: self.correction,
            position_gain_per_s: self.position_gain_per_s,
            speed_hz: self.speed_hz,
            integral_ms: self.integral_ms,
            ..trajectory::Settings::default()
        }
    }

    /// What the lead-angle compensator is set to: step 0 lowers the pen, step 1 lifts it.
    #[must_use]
    pub fn lift(&self) -> lift::Settings {
        let step = |target| lift::Step {
            target,
            speed_counts_per_s: self.lift_counts_per_s,
            lead_ms: self.lift_lead_ms,
        };
        lift::Settings {
            clock_hz: self.clock_hz,
            ck_ticks: self.ck_ticks,
            steps: vec![step(self.pen_down_counts), step(0)],
            seed_ms: self.lift_lead_ms,
            history: self.lift_history,
            body: self.lift,
            ..lift::Settings::default()
        }
    }
}
