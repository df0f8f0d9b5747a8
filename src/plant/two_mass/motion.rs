//! Motion between two events: linear, and therefore given exactly by the matrix exponential, or by
//! the Taylor series of its path when an event is searched.

use super::TwoMassParameters;

/// Number of terms of the Taylor series; half a radian of the fastest motion leaves 2⁻¹⁷/17!.
const TERMS: usize = 17;
/// Greatest time for which the series is used, times the fastest rate.
pub(super) const REACH: f64 = 0.5;

/// Motor angle, load angle (both from the angle at which the shaft has no torque, in rad), motor
/// speed, load speed.
pub(super) type State = [f64; 4];

/// Returns a state plus its change.
#[inline]
pub(super) fn sum(x: &State, gained: &State) -> State {
    [
        x[0] + gained[0],
        x[1] + gained[1],
        x[2] + gained[2],
        x[3] + gained[3],
    ]
}

/// Forces that act until the next event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Regime {
    /// True if the shaft has torque: a flank touches.
    pub touches: bool,
    /// True if friction holds motor or load.
    pub stuck: [bool; 2],
}

/// Linear equations of motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Equations {
    pub inertia: [f64; 2],
    pub viscous: [f64; 2],
    pub stiffness: f64,
    pub damping: f64,
}

impl Equations {
    pub fn new(parameters: &TwoMassParameters) -> Self {
        Equations {
            inertia: [
                parameters.motor_inertia_kg_m2,
                parameters.load_inertia_kg_m2,
            ],
            viscous: [
                parameters.motor_viscous_nm_s_per_rad,
                parameters.load_viscous_nm_s_per_rad,
            ],
            stiffness: parameters.stiffness_nm_per_rad,
            damping: parameters.damping_nm_s_per_rad,
        }
    }

    /// Returns the rates of the state under torques on motor and load.
    #[inline]
    pub fn rates(&self, regime: Regime, x: &State, torques: [f64; 2]) -> State {
        let shaft = match regime.touches {
            true => self.stiffness * (x[0] - x[1]) + self.damping * (x[2] - x[3]),
            false => 0.0,
        };
        let sums = [
            torques[0] - shaft - self.viscous[0] * x[2],
            torques[1] + shaft - self.viscous[1] * x[3],
        ];
        let gained = |body: usize| match regime.stuck[body] {
            true => 0.0,
            false => sums[body] / self.inertia[body],
        };
        [x[2], x[3], gained(0), gained(1)]
    }

    /// Returns the path from `start` on.
    pub fn path(&self, regime: Regime, start: &State, torques: [f64; 2]) -> Path {
        let mut terms = [[0.0; 4]; TERMS];
        terms[0] = *start;
        let mut torques = torques;
        for k in 1..TERMS {
            terms[k] = self
                .rates(regime, &terms[k - 1], torques)
                .map(|rate| rate / k as f64);
            torques = [0.0; 2];
        }
        Path { terms }
    }
}

/// Path as its Taylor series, for times up to [`REACH`].
#[derive(Debug)]
pub(super) struct Path {
    terms: [State; TERMS],
}

impl Path {
    /// Returns the change of the state at a time.
    pub fn gained(&self, time_s: f64) -> State {
        let mut sum = [0.0; 4];
        for term in self.terms[1..].iter().rev() {
            for (sum, term) in sum.iter_mut().zip(term) {
                *sum = (*sum + term) * time_s;
            }
        }
        sum
    }

    /// Returns the series coefficients of a linear function of the state.
    pub fn series(&self, of: impl Fn(&State) -> f64) -> [f64; TERMS] {
        self.terms.each_ref().map(of)
    }
}

/// Change of the state in a fixed time: the matrix exponential minus one, for a shaft whose torque
/// acts between `state[0]` and `state[1]`.
///
/// Columns belong to twist, motor speed, load speed, torque on the motor, torque on the load.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    columns: [State; 5],
}

impl Step {
    /// Creates the step of `time_s` · 2^`doublings` seconds; `time_s` is within [`REACH`].
    pub fn new(equations: &Equations, regime: Regime, time_s: f64, doublings: u32) -> Self {
        let column = |index: usize| {
            let mut unit = [0.0; 5];
            unit[index] = 1.0;
            let [twist, motor, load, on_motor, on_load] = unit;
            let start = [twist, 0.0, motor, load];
            equations
                .path(regime, &start, [on_motor, on_load])
                .gained(time_s)
        };
        let mut step = Step {
            columns: std::array::from_fn(column),
        };
        for _ in 0..doublings {
            step = step.doubled();
        }
        step
    }

    fn doubled(&self) -> Self {
        let column = |index: usize| {
            let first = self.columns[index];
            let mut unit = [0.0; 5];
            unit[index] = 1.0;
            let [twist, motor, load, on_motor, on_load] = unit;
            let twist = twist + (first[0] - first[1]);
            let middle = [twist, 0.0, motor + first[2], load + first[3]];
            let second = self.gained(&middle, [on_motor, on_load]);
            sum(&first, &second)
        };
        Step {
            columns: std::array::from_fn(column),
        }
    }

    /// Returns the change of the state.
    #[inline]
    pub fn gained(&self, x: &State, torques: [f64; 2]) -> State {
        let [twist, motor, load, on_motor, on_load] = &self.columns;
        let by = x[0] - x[1];
        let row = |row: usize| {
            by * twist[row]
                + x[2] * motor[row]
                + x[3] * load[row]
                + torques[0] * on_motor[row]
                + torques[1] * on_load[row]
        };
        [row(0), row(1), row(2), row(3)]
    }
}

/// Returns the first time up to `end_s` at which a series falls below 0. A negative value at the
/// start counts as 0: the event before has left it there, except for rounding.
pub(super) fn falls_below_zero(series: &[f64; TERMS], end_s: f64) -> Option<f64> {
    let mut series = *series;
    series[0] = series[0].max(0.0);
    let value = |time: f64| series.iter().rev().fold(0.0, |sum, term| sum * time + term);
    let falls = |time: f64| {
        let terms = series.iter().enumerate().skip(1).rev();
        terms.fold(0.0, |sum, (k, term)| sum * time + k as f64 * term) < 0.0
    };
    let at_end = value(end_s);
    if at_end < 0.0 {
        return Some(first(end_s, |time| value(time) < 0.0));
    }
    // The function may have fallen and risen again.
    if !falls(0.0) || falls(end_s) {
        return None;
    }
    let lowest = first(end_s, |time| !falls(time));
    // Rounding at the start is not a fall.
    (value(lowest) < -1e-12 * at_end).then(|| first(lowest, |time| value(time) < 0.0))
}

/// Returns the first time up to `end_s` at which a condition holds that holds at `end_s` and, once
/// true, stays true.
fn first(end_s: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut before, mut after) = (0.0, end_s);
    for _ in 0..60 {
        let middle = 0.5 * (before + after);
        match holds(middle) {
            true => after = middle,
            false => before = middle,
        }
    }
    after
}
