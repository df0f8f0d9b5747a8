//! Settings of the machine: clock and rates, steppers, servos, pen lift.

use crate::jobs::arc_generator::settings::{self as arcs, ShortPieces};
use crate::jobs::lead_angle::settings as lift;
pub use crate::jobs::lead_angle::settings::History;
use crate::jobs::linear_interpolator::targets::{LATENCY_TICKS, LONGEST_RAMP};
use crate::jobs::pulse_interpolator::{self as pulse, StepTiming};
use crate::jobs::trajectory_controller::servo_gains::{INTEGRAL_RANGE_MS, RATE_RANGE};
use crate::jobs::trajectory_controller::settings as trajectory;
pub use crate::jobs::trajectory_controller::settings::Correction;
use crate::plan::MotionLimits;
use crate::plant::{BodyParameters, TwoMassParameters};
use crate::settings::{
    CLOCK_RANGE_HZ, COUNTS_PER_MM_RANGE, IN_POSITION_RANGE, Place, STEPS_PER_MM_RANGE,
    SettingError, WholeTime, settings, within,
};
use std::ops::RangeInclusive;

/// Ticks of a period that the counters hold.
const PERIOD: RangeInclusive<u32> = 1..=(1 << 24) - 1;
/// Times to speed at any clock, in milliseconds.
const RAMP_RANGE_MS: RangeInclusive<f64> = 0.0..=LONGEST_RAMP as f64 * *PERIOD.end() as f64 * 1e3;
/// Shortest sampling time in ticks: arc generator and trajectory controller are done within it.
pub const LEAST_SAMPLE_TICKS: u64 = {
    let (arcs, trajectory) = (arcs::LEAST_SAMPLE_TICKS, trajectory::LEAST_PERIOD_TICKS);
    if arcs > trajectory { arcs } else { trajectory }
};

settings! {
    /// Settings of the machine. Default: a plotter at 400 kHz with steppers of 40 steps and servos
    /// of 1000 counts per millimetre. Lists are of X and of Y.
    pub struct Settings {
        /// Reference clock.
        pub clock_hz: u64 = 400_000, in CLOCK_RANGE_HZ;
        /// T: unit time of the pulse interpolator.
        pub unit_ticks: u32 = 2000, in pulse::UNIT_RANGE_TICKS, "with room for a pulse";
        /// Scan of the linear interpolator.
        pub scan_ticks: u32 = 400, in LATENCY_TICKS..=*PERIOD.end();
        /// CK of the lead-angle compensator.
        pub ck_ticks: u32 = 40, in *lift::CK_RANGE_TICKS.start()..=*PERIOD.end();
        /// Ts: sampling time of arc generator and trajectory controller.
        pub sample_ticks: u32 = 400, in LEAST_SAMPLE_TICKS as u32..=*PERIOD.end(),
            "two within 4095 scans";
        /// Steps of the steppers per millimetre.
        pub steps_per_mm: [f64; 2] = [40.0; 2], within STEPS_PER_MM_RANGE,
            "0.000001 to 1000000000, or the negative of that";
        /// Counts of the servos' commands and encoders per millimetre.
        pub counts_per_mm: f64 = 1000.0, in COUNTS_PER_MM_RANGE;
        /// Time in which the servos come to speed, and to rest: the nearest whole number of scans on
        /// lines, of two Ts on arcs. The summary says which, where that is another time.
        pub acceleration_ms: f64 = 40.0, within RAMP_RANGE_MS, "a scan or two Ts to 4095 scans";
        /// K1 of all models.
        pub k1_per_s: f64 = 50.0, within trajectory::K1_RANGE_PER_S,
            "above 0, up to 0.5 per Ts, and at most a quarter of k2_per_s";
        /// K2 of all models.
        pub k2_per_s: f64 = 200.0, within trajectory::K2_RANGE_PER_S, "4 times k1_per_s or more, below 2 per Ts";
        /// Correction that the trajectory controller adds to the commands; not `feedback`.
        pub correction: Correction = Correction::default();
        /// Gain of the position controls.
        pub position_gain_per_s: f64 = 30.0, in RATE_RANGE, "and what its word holds at the period";
        /// Bandwidth of the speed controls.
        pub speed_hz: f64 = 17.0, in RATE_RANGE, "and what its word holds with the axes";
        /// Integral time of the speed controls; 0 for no integral.
        pub integral_ms: f64 = 40.0, in INTEGRAL_RANGE_MS, "and what its word holds with the axes";
        /// Distance of both motors from their commands, at most, at which a move begins.
        pub in_position_counts: u32 = 4, in IN_POSITION_RANGE;
        /// Amplifier, motor, load and encoder of X and Y.
        pub machine: TwoMassParameters = TwoMassParameters::default();
        /// Position of the lift with the pen down; up is 0.
        pub pen_down_counts: i64 = 4000, within lift::TARGET_RANGE_COUNTS, "not 0";
        /// Speed of the lift.
        pub lift_counts_per_s: u32 = 20_000, within lift::SPEED_RANGE_COUNTS_PER_S,
            "a multiple of 10, at most a count per tick";
        /// Lead of the lift's brake before anything is learned.
        pub lift_lead_ms: f64 = 25.0, within lift::LEAD_RANGE_MS, "0, or a whole number of CKs that a code has";
        /// Memory of the lift's past positions.
        pub lift_history: History = History::default();
        /// Drive, body, brake and encoder of the lift. Default: a cam that turns half a revolution.
        pub lift: BodyParameters = lift_body();
    }
    flat {
        /// Speed of the moves that set none, and of rapid ones; corners and acceleration of the
        /// steppers. The acceleration across arcs is that of the servos too.
        pub motion: MotionLimits = MotionLimits::default();
        /// Timing that the stepper drivers require.
        pub step_timing: StepTiming = StepTiming::default();
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
    /// Checks the rates, and everything that no part of the machine checks.
    ///
    /// # Errors
    /// Names the first field at fault, its value and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        let in_table = |name| move |error: SettingError| error.at(Place::Table(name));
        self.machine.ranges().map_err(in_table("machine"))?;
        self.lift.ranges().map_err(in_table("lift"))?;
        self.ranges()?;
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
        Ok(())
    }

    /// Ts in seconds.
    #[must_use]
    pub fn sample_s(&self) -> f64 {
        f64::from(self.sample_ticks) / self.clock_hz as f64
    }

    /// Returns the scan in seconds.
    #[must_use]
    pub fn scan_s(&self) -> f64 {
        f64::from(self.scan_ticks) / self.clock_hz as f64
    }

    /// Returns `acceleration_ms` in whole scans for lines, and in whole pairs of samples for arcs.
    #[must_use]
    pub fn ramps(&self) -> [WholeTime; 2] {
        [self.scan_s(), 2.0 * self.sample_s()]
            .map(|period_s| WholeTime::new("acceleration_ms", self.acceleration_ms, 1e3 * period_s))
    }

    /// Returns the settings for compiling the steppers' table.
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

    /// Returns the settings for preparing arcs: an even number of samples to come to speed.
    #[must_use]
    pub fn arcs(&self) -> arcs::Settings {
        let [_, arcs] = self.ramps();
        arcs::Settings {
            clock_hz: self.clock_hz,
            sample_period_ms: 1e3 * self.sample_s(),
            acceleration_ms: arcs.ms(),
            counts_per_mm: self.counts_per_mm,
            feed_mm_per_min: Some(self.motion.feed_mm_per_min),
            rapid_mm_per_min: self.motion.rapid_mm_per_min,
            corner_deg: 0.0,
            short_pieces: ShortPieces::Slower,
            ..arcs::Settings::default()
        }
    }

    /// Returns the settings of the trajectory controller.
    #[must_use]
    pub fn trajectory(&self) -> trajectory::Settings {
        trajectory::Settings {
            clock_hz: self.clock_hz,
            period_ms: 1e3 * self.sample_s(),
            counts_per_mm: self.counts_per_mm,
            feed_mm_per_min: Some(self.motion.feed_mm_per_min),
            rapid_mm_per_min: self.motion.rapid_mm_per_min,
            acceleration_mm_per_s2: Some(self.motion.acceleration_mm_per_s2),
            normal_acceleration_mm_per_s2: self.motion.acceleration_mm_per_s2,
            corner_mm_per_min: 0.0,
            k1_per_s: self.k1_per_s.into(),
            k2_per_s: self.k2_per_s.into(),
            correction: self.correction,
            position_gain_per_s: self.position_gain_per_s,
            speed_hz: self.speed_hz,
            integral_ms: self.integral_ms,
            ..trajectory::Settings::default()
        }
    }

    /// Returns the settings of the lead-angle compensator: step 0 lowers the pen, step 1 lifts it.
    #[must_use]
    pub fn lift(&self) -> lift::Settings {
        let step = |target| lift::Step {
            target,
            speed_counts_per_s: self.lift_counts_per_s,
            lead_ms: self.lift_lead_ms,
            ..lift::Step::default()
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
