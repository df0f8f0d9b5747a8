//! Settings of the trajectory controller: clock and period, machine, motion, reference model.

use super::each_axis::EachAxis;
use super::job::controller;
use super::load_torque::LoadTorque;
use super::ramp::Slope;
use super::segments::FourthAxis;
use super::servo_gains::{INERTIA_FACTOR_RANGE, INTEGRAL_RANGE_MS, RATE_RANGE};
use crate::circuits::trajectory_controller::path_point::AXES;
pub use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::circuits::trajectory_controller::{Rounding, Widths};
use crate::input::COORDINATES;
use crate::jobs::arc_generator::settings::SPEED_RANGE_MM_PER_MIN;
use crate::jobs::taught::{Coordinates, REACH_RANGE_MM, TaughtPiece, taught};
use crate::path::pieces::{Speeds, Taught};
use crate::plan::ACCELERATION_RANGE;
use crate::plant::TwoMassParameters;
use crate::settings::{
    CLOCK_RANGE_HZ, COUNTS_PER_MM_RANGE, SettingError, choices, settings, whole_ticks, within,
};
use std::ops::RangeInclusive;
use std::path::PathBuf;

/// Shortest interpolation period in ticks: two points on the path, three model steps and a servo
/// step are done within it.
pub const LEAST_PERIOD_TICKS: u64 =
    controller(COORDINATES, Correction::Vector, Rounding::Nearest).least_period();

/// Periods at any clock, in milliseconds.
const PERIOD_RANGE_MS: RangeInclusive<f64> = LEAST_PERIOD_TICKS as f64 * 1e3
    / *CLOCK_RANGE_HZ.end() as f64
    ..=((1u64 << Widths::FULL.period) - 1) as f64 * 1e3;

/// K1 at any clock, in 1/s: up to 0.5 per period.
pub const K1_RANGE_PER_S: RangeInclusive<f64> = 0.0..=0.5e3 / *PERIOD_RANGE_MS.start();

/// K2 at any clock, in 1/s: below 2 per period.
pub const K2_RANGE_PER_S: RangeInclusive<f64> = 0.0..=2e3 / *PERIOD_RANGE_MS.start();

/// Returns the gains of the error feedback that their word holds.
fn feedback_range(widths: &Widths) -> RangeInclusive<f64> {
    let one = (widths.feedback().gain_fraction() as f64).exp2();
    0.0..=((1u64 << widths.gain) - 1) as f64 / one
}

/// Longest jerk time that is accepted, in ms.
pub const JERK_TIME_RANGE_MS: RangeInclusive<f64> = 0.0..=1e6;

/// Default acceleration along the path, in mm/s².
pub const ACCELERATION_MM_PER_S2: f64 = 2000.0;

/// Acceleration times that are accepted, in ms.
pub const ACCELERATION_TIME_RANGE_MS: RangeInclusive<f64> = 1e-6..=1e6;

/// Contour errors that the feed may be limited to, in mm.
pub const CONTOUR_TOLERANCE_RANGE_MM: RangeInclusive<f64> = 1e-6..=1e3;

choices!(Correction);

settings! {
    /// Settings of a path, its pieces and a run.
    ///
    /// Default: 1 µm a count, 1 ms at 1 MHz, K1 and K2 of the usual machine tool. Speed control of a
    /// fifth of the resonance of the usual axis, 87 Hz; position gain and integral of a quarter of
    /// that in 1/s, 27/s and 37 ms.
    pub struct Settings {
        /// Start of the first piece; at 0 without it.
        pub start_mm: Option<Coordinates> = None, in REACH_RANGE_MM;
        /// Pieces of the path, if it is not a drawing.
        pub piece: Vec<TaughtPiece> = Vec::new();
        /// Axes: 2, 3, or 4 with W. Default: 3 if the path moves in Z, otherwise 2.
        pub axes: Option<u32> = None, in 2..=4;
        /// Reference clock.
        pub clock_hz: u64 = 1_000_000, in CLOCK_RANGE_HZ;
        /// Δt: interpolation period, in whole ticks.
        pub period_ms: f64 = 1.0, within PERIOD_RANGE_MS, "as many ticks as the circuit needs, or more";
        /// Counts per millimetre, of every axis.
        pub counts_per_mm: f64 = 1000.0, in COUNTS_PER_MM_RANGE;
        /// F: speed of the pieces without an own speed.
        pub feed_mm_per_min: Option<f64> = None, in SPEED_RANGE_MM_PER_MIN;
        /// Speed with the pen up, and of G0.
        pub rapid_mm_per_min: f64 = 12_000.0, in SPEED_RANGE_MM_PER_MIN;
        /// Largest acceleration along the path; 2000 without it and without `acceleration_time_ms`.
        pub acceleration_mm_per_s2: Option<f64> = None, in ACCELERATION_RANGE;
        /// Time from rest to each feed and to the rapid speed, but for the jerk time, in place of an
        /// acceleration.
        pub acceleration_time_ms: Option<f64> = None, in ACCELERATION_TIME_RANGE_MS,
            "not beside acceleration_mm_per_s2";
        /// Largest acceleration of the axes; without it they have no limit of their own.
        pub axis_acceleration_mm_per_s2: Option<EachAxis> = None, within ACCELERATION_RANGE;
        /// Largest acceleration across the path, on arcs.
        pub normal_acceleration_mm_per_s2: f64 = 2000.0, in ACCELERATION_RANGE;
        /// Steady contour error of the models, with nothing added, to which the feed in curves is
        /// limited (¶0004); without it the feed has no such limit.
        pub contour_tolerance_mm: Option<f64> = None, in CONTOUR_TOLERANCE_RANGE_MM;
        /// Time in which the acceleration along the path comes and goes; 0 for a trapezoid of speed.
        pub jerk_time_ms: f64 = 0.0, in JERK_TIME_RANGE_MS;
        /// Largest step of the velocity between two segments; 0 stops at every corner.
        pub corner_mm_per_min: f64 = 600.0, in 0.0..=*SPEED_RANGE_MM_PER_MIN.end();
        /// K1 of the models.
        pub k1_per_s: EachAxis = EachAxis::All(50.0), within K1_RANGE_PER_S, "above 0, up to 0.5 per period";
        /// K2 of the models.
        pub k2_per_s: EachAxis = EachAxis::All(200.0), within K2_RANGE_PER_S,
            "4 times k1_per_s, or 2 times with allow_overshoot, and more, below 2 per period";
        /// Allows gains with which the models overshoot their targets: K2 from 2·K1 on.
        pub allow_overshoot: bool = false;
        /// Rounding of the models.
        pub rounding: Rounding = Rounding::default();
        /// Correction that is added to the path's point in the run whose waves are written.
        pub correction: Correction = Correction::default();
        /// Gain of the error along the path in the error feedback.
        pub tangential_gain: f64 = 1.0, within feedback_range(&Widths::FULL);
        /// Gain of the error across the path in the error feedback.
        pub normal_gain: f64 = 1.0, within feedback_range(&Widths::FULL);
        /// Gain of the position controls.
        pub position_gain_per_s: f64 = 30.0, in RATE_RANGE, "and what its word holds at the period";
        /// Bandwidth of the speed controls: their gain is 2πf times the inertia.
        pub speed_hz: f64 = 17.0, in RATE_RANGE, "and what its word holds with the axes";
        /// Integral time of the speed controls; 0 for no integral.
        pub integral_ms: f64 = 40.0, in INTEGRAL_RANGE_MS, "and what its word holds with the axes";
        /// Inertia of motor and load that the feed-forward assumes, as a part of the true one; 0 for
        /// no feed-forward.
        pub inertia_factor: EachAxis = EachAxis::All(1.0), within INERTIA_FACTOR_RANGE;
        /// Torques on the loads from outside.
        pub load_torque: Vec<LoadTorque> = Vec::new();
        /// Amplifier, motor, load and encoder of every axis.
        pub machine: TwoMassParameters = TwoMassParameters::default();
        /// Amplifier, motor, load and encoder of each axis by itself, in place of `machine`.
        pub axis: Vec<TwoMassParameters> = Vec::new();
    }
}

/// Settings that the planner needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Guard units of a millimetre.
    pub units_per_mm: f64,
    /// Δt in seconds.
    pub period: f64,
    /// Ramps, in guard units and seconds.
    pub slope: Slope,
    /// Largest acceleration across the path, in mm/s².
    pub normal_acceleration: f64,
    /// Acceleration across the path, in mm/s², at which the models' inward error equals the
    /// tolerance; infinite without a tolerance.
    pub contour_acceleration: f64,
    /// Largest acceleration of each axis, in mm/s².
    pub axis_acceleration: [f64; AXES],
    /// Largest step of the velocity, in mm/s.
    pub corner_speed: f64,
}

/// The reference model's gains as words: parts of 2^(K − 1) a period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Gains {
    /// K1·Δt.
    pub k1: u64,
    /// K2·Δt.
    pub k2: u64,
}

impl Gains {
    /// K1·Δt and K2·Δt as numbers.
    #[must_use]
    pub fn parts(&self, widths: &Widths) -> [f64; 2] {
        let one = ((widths.gain - 1) as f64).exp2();
        [self.k1, self.k2].map(|word| word as f64 / one)
    }

    /// c = ½(1/K1² − Δt/K1 − 2/(K1·K2)) in s²: at the speed v a circle of the radius r shrinks by
    /// c·v²/r, but for higher orders of v/r. Δt/K1 is what the steps of the model are, and is not
    /// there in a continuous one.
    #[must_use]
    pub fn radial_s2(&self, widths: &Widths, period: f64) -> f64 {
        let [k1, k2] = self.parts(widths);
        (1.0 / (k1 * k1) - 1.0 / k1 - 2.0 / (k1 * k2)) / 2.0 * period * period
    }
}

/// The gains of the error feedback as words: parts of 2^(K/2).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FeedbackGains {
    /// Gain of the tangential error.
    pub tangential: u64,
    /// Gain of the normal error.
    pub normal: u64,
}

impl FeedbackGains {
    /// Both as numbers.
    #[must_use]
    pub fn parts(&self, widths: &Widths) -> [f64; 2] {
        let one = (widths.feedback().gain_fraction() as f64).exp2();
        [self.tangential, self.normal].map(|word| word as f64 / one)
    }
}

impl From<&Settings> for Speeds {
    fn from(settings: &Settings) -> Self {
        Speeds {
            wanted: settings.feed_mm_per_min.map(|feed| feed / 60.0),
            rapid: settings.rapid_mm_per_min / 60.0,
        }
    }
}

impl Settings {
    /// True if there is W beside X, Y and Z.
    #[must_use]
    pub fn has_fourth(&self) -> bool {
        self.axes == Some(4)
    }

    /// Returns the taught pieces; none if the path is a drawing, `input`.
    ///
    /// # Errors
    /// An error of [`taught`]; a start without W on four axes, or with W on fewer.
    pub fn taught(&self, input: Option<&PathBuf>) -> Result<Vec<Taught>, SettingError> {
        let fourth = self.has_fourth();
        let start = self.start_mm.as_ref();
        start.map_or(Ok(()), |start| start.check("start_mm", fourth))?;
        taught(input, &self.piece, fourth)
    }

    /// Returns W of the taught pieces.
    #[must_use]
    pub fn taught_w(&self) -> FourthAxis {
        let w = |of: &Coordinates| of.w.unwrap_or(0.0);
        FourthAxis {
            from_mm: self.start_mm.as_ref().map_or(0.0, w),
            to_mm: self.piece.iter().map(|piece| w(&piece.to_mm)).collect(),
        }
    }

    /// Returns the number of axes, of a path that moves in Z or not.
    ///
    /// # Errors
    /// Neither 2 nor 3 nor 4.
    pub fn axes(&self, moves_in_z: bool) -> Result<usize, SettingError> {
        let axes = self.axes.unwrap_or(if moves_in_z { 3 } else { 2 });
        match (2..=4).contains(&axes) {
            true => Ok(axes as usize),
            false => Err(SettingError::value("axes", axes, "2, 3 or 4")),
        }
    }

    /// Returns motor and load of each of `axes` axes.
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

    /// Checks every field.
    ///
    /// # Errors
    /// Names the first field at fault, its value and what is allowed.
    pub fn validate(&self, widths: &Widths) -> Result<(), SettingError> {
        self.motion(widths)?;
        self.feedback_gains(widths)?;
        let told = [&self.k1_per_s, &self.k2_per_s].map(EachAxis::told);
        let axes = told.into_iter().flatten().next().unwrap_or(1);
        let axes = axes.min(AXES);
        let gains = self.gains(widths, axes)?;
        self.contour_acceleration(widths, &gains).map(drop)
    }

    /// Returns Δt in ticks of the clock.
    ///
    /// # Errors
    /// An error of [`Settings::validate`] on the clock or the period.
    pub fn period_ticks(&self, widths: &Widths) -> Result<u32, SettingError> {
        within("clock_hz", self.clock_hz, &CLOCK_RANGE_HZ)?;
        let ticks = LEAST_PERIOD_TICKS..=(1 << widths.period) - 1;
        whole_ticks("period_ms", self.period_ms, self.clock_hz, &ticks)
    }

    /// Returns Δt in seconds.
    ///
    /// # Errors
    /// An error of [`Settings::period_ticks`].
    pub fn period_s(&self, widths: &Widths) -> Result<f64, SettingError> {
        Ok(f64::from(self.period_ticks(widths)?) / self.clock_hz as f64)
    }

    /// Returns the planner's settings; [`Motion::contour_acceleration`] is infinite, as it depends
    /// on the gains.
    ///
    /// # Errors
    /// An error of [`Settings::validate`] on anything but the model's gains.
    pub fn motion(&self, widths: &Widths) -> Result<Motion, SettingError> {
        self.ranges()?;
        let period = self.period_s(widths)?;
        let (acceleration, time_constant) = self.acceleration()?;
        let axis_acceleration = self.axis_accelerations()?;
        let units_per_mm = self.counts_per_mm * (widths.guard() as f64).exp2();
        Ok(Motion {
            units_per_mm,
            period,
            slope: Slope {
                acceleration: acceleration * units_per_mm,
                time_constant,
                jerk_time: self.jerk_time_ms / 1e3,
            },
            normal_acceleration: self.normal_acceleration_mm_per_s2,
            contour_acceleration: f64::INFINITY,
            axis_acceleration,
            corner_speed: self.corner_mm_per_min / 60.0,
        })
    }

    /// [`Motion::contour_acceleration`] of models with these gains: c times it is the tolerance.
    ///
    /// # Errors
    /// A tolerance out of its range; of models that differ or overshoot, whose error is another.
    pub fn contour_acceleration(
        &self,
        widths: &Widths,
        gains: &[Gains],
    ) -> Result<f64, SettingError> {
        let field = "contour_tolerance_mm";
        let (Some(mm), Some(first)) = (self.contour_tolerance_mm, gains.first()) else {
            return Ok(f64::INFINITY);
        };
        within(field, mm, &CONTOUR_TOLERANCE_RANGE_MM)?;
        let refuse = |what: &str, allowed| {
            let problem = format!("is {mm} beside models that {what}");
            Err(SettingError::new(field, problem, allowed))
        };
        if gains.iter().any(|of| of != first) {
            return refuse("differ", "the same k1_per_s and k2_per_s for all axes");
        }
        if first.k2 < 4 * first.k1 {
            return refuse("overshoot", "k2_per_s of 4 times k1_per_s or more");
        }
        Ok(mm / first.radial_s2(widths, self.period_s(widths)?))
    }

    /// Largest acceleration along the path in mm/s², and the time constant in s, 0 without one.
    fn acceleration(&self) -> Result<(f64, f64), SettingError> {
        let Some(time_ms) = self.acceleration_time_ms else {
            let told = self.acceleration_mm_per_s2;
            return Ok((told.unwrap_or(ACCELERATION_MM_PER_S2), 0.0));
        };
        let field = "acceleration_time_ms";
        if self.acceleration_mm_per_s2.is_some() {
            let problem = format!("is {time_ms} beside acceleration_mm_per_s2");
            return Err(SettingError::new(field, problem, "one of both"));
        }
        let Speeds { wanted, rapid } = Speeds::from(self);
        let acceleration = self.acceleration_to(wanted.unwrap_or(0.0).max(rapid))?;
        Ok((
            acceleration.unwrap_or(ACCELERATION_MM_PER_S2),
            time_ms / 1e3,
        ))
    }

    /// Returns the acceleration that reaches a speed in [`Settings::acceleration_time_ms`], in
    /// mm/s²; `None` if the setting is not given.
    ///
    /// # Errors
    /// A time that would put the acceleration out of its range.
    pub(super) fn acceleration_to(&self, speed: f64) -> Result<Option<f64>, SettingError> {
        let Some(time_ms) = self.acceleration_time_ms else {
            return Ok(None);
        };
        let acceleration = speed / (time_ms / 1e3);
        let most = *ACCELERATION_RANGE.end();
        if acceleration > most {
            let problem = format!("is {time_ms}: {acceleration} mm/s² to {speed} mm/s");
            let allowed = format!("{} or more", speed / most * 1e3);
            return Err(SettingError::new("acceleration_time_ms", problem, allowed));
        }
        Ok(Some(acceleration))
    }

    /// Largest acceleration of each axis, in mm/s².
    fn axis_accelerations(&self) -> Result<[f64; AXES], SettingError> {
        let mut allowed = [f64::INFINITY; AXES];
        let Some(told) = &self.axis_acceleration_mm_per_s2 else {
            return Ok(allowed);
        };
        let axes = told.told().unwrap_or(AXES).min(AXES);
        for (axis, allowed) in allowed[..axes].iter_mut().enumerate() {
            *allowed = told.of(axis);
            within("axis_acceleration_mm_per_s2", *allowed, &ACCELERATION_RANGE)
                .map_err(|error| told.fault(axis, error))?;
        }
        Ok(allowed)
    }

    /// Returns the gains of the error feedback, rounded to the nearest word.
    ///
    /// # Errors
    /// A gain does not fit its word.
    pub fn feedback_gains(&self, widths: &Widths) -> Result<FeedbackGains, SettingError> {
        let one = (widths.feedback().gain_fraction() as f64).exp2();
        let range = feedback_range(widths);
        let word = |field, gain: f64| {
            within(field, gain, &range)?;
            Ok((gain * one).round() as u64)
        };
        Ok(FeedbackGains {
            tangential: word("tangential_gain", self.tangential_gain)?,
            normal: word("normal_gain", self.normal_gain)?,
        })
    }

    /// Returns the gains of the models of `axes` axes.
    ///
    /// # Errors
    /// An error of [`Settings::validate`]; a list whose length is not the count of axes.
    pub fn gains(&self, widths: &Widths, axes: usize) -> Result<Vec<Gains>, SettingError> {
        self.k1_per_s.check("k1_per_s", axes)?;
        self.k2_per_s.check("k2_per_s", axes)?;
        (0..axes).map(|axis| self.gains_of(widths, axis)).collect()
    }

    /// Returns the gains of an axis's model, rounded to the nearest word. K1 rounds down if
    /// rounding alone would make the model overshoot its target.
    ///
    /// # Errors
    /// An error of [`Settings::validate`] on clock, period and gains. With gains k1, k2 per period:
    ///
    /// - the model is stable if k1 < 1 and k2·(2 − k1) < 4, which words below 2 always fulfil;
    /// - it does not overshoot its target if also 4·k1 <= k2;
    /// - its rounding errors die out if 2·k1 <= k2;
    /// - it reaches its commanded count if k1·k2 is at least one guard unit, with
    ///   [`Rounding::Floor`] two.
    fn gains_of(&self, widths: &Widths, axis: usize) -> Result<Gains, SettingError> {
        let period = self.period_s(widths)?;
        let bits = widths.gain - 1;
        let one = 1u64 << bits;
        let word = |per_s: f64| (per_s * period * one as f64).round();
        let [k1_per_s, k2_per_s] = [self.k1_per_s.of(axis), self.k2_per_s.of(axis)];
        let [mut k1, k2] = [k1_per_s, k2_per_s].map(word);
        if 4.0 * k1_per_s <= k2_per_s {
            k1 = k1.min((k2 / 4.0).floor());
        }
        let refuse = |field, value: f64, word: f64, allowed: [u64; 2], why: &str| {
            let part = |word: f64| word / one as f64;
            let [least, most] = allowed.map(|word| part(word as f64));
            let problem = format!("is {value}: {} a period", part(word));
            let [first, last] = [least, most].map(|part| part / period);
            let allowed = format!("{first} to {last}: {least} to {most} a period; {why}");
            SettingError::new(field, problem, allowed)
        };
        // Least k1·k2 as a product of words.
        let exact = match self.rounding {
            Rounding::Nearest => 1u64 << (2 * bits - widths.guard()),
            Rounding::Floor => 2 << (2 * bits - widths.guard()),
        };
        // The K1 that some K2 goes with.
        let most_k2 = 2 * one - 1;
        let damping = match self.allow_overshoot {
            true => 2,
            false => 4,
        };
        let most_k1 = most_k2 / damping;
        let allowed = [exact.div_ceil(most_k2), most_k1];
        // Written so that NaN fails.
        if !(k1 >= allowed[0] as f64 && k1 <= allowed[1] as f64) {
            let why = "there is a k2_per_s for it";
            let error = refuse("k1_per_s", k1_per_s, k1, allowed, why);
            return Err(self.k1_per_s.fault(axis, error));
        }
        let first = k1 as u64;
        let allowed = [(damping * first).max(exact.div_ceil(first)), most_k2];
        if !(k2 >= allowed[0] as f64 && k2 <= allowed[1] as f64) {
            let why = match (damping * first >= exact.div_ceil(first), damping) {
                (true, 4) => "4 times k1_per_s or more, or 2 times with allow_overshoot",
                (true, _) => "2 times k1_per_s or more",
                (false, _) => "with less it would not come to its target",
            };
            let error = refuse("k2_per_s", k2_per_s, k2, allowed, why);
            return Err(self.k2_per_s.fault(axis, error));
        }
        Ok(Gains {
            k1: first,
            k2: k2 as u64,
        })
    }
}
