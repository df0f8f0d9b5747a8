//! Response of models to a circle at constant speed, in closed form.
//!
//! A circle of radius r with speed v = ω·r is e^(jωt). The response of a model to it is G = G(jω)
//! times as large, so it runs r(1 − |G|) inside. The corrected command is 1 + e^(−jωτ) − G times
//! as large; τ is the lag of the tangential response. For the widened circle the factor is 1 +
//! c·ω². With the feedback it is u: across the path Re u = 1 + N(1 − Re Xu), along it Im u = −T·Im
//! Xu; X is the motor as observed.
//!
//! | | continuous | sampled, z = e^(jωΔt) |
//! |---|---|---|
//! | G | K1·K2 / (s² + K2·s + K1·K2) | z·K1·K2 / ((z − 1)² + K2·(z − 1) + K1·K2) |
//! | τ | 1/K1 | (1/K1 − 1)·Δt |
//! | X | G | G(1 − d(1 − 1/z)), observed d periods before the end of the model's step |

use super::job::{Program, controller};
use super::segments::Segment;
use super::settings::Correction;
use crate::circuits::trajectory_controller::{Rounding, Widths};
use crate::input::COORDINATES;
use serde::Serialize;
use std::ops::Range;

/// Number of times of its slowest decay after which a model has forgotten its past.
const FORGOTTEN: f64 = 20.0;

type Complex = [f64; 2];

/// Contour errors on a circle in mm, inwards positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosedForms {
    /// Radius r in mm.
    pub radius_mm: f64,
    /// Speed v in mm/s.
    pub speed_mm_per_s: f64,
    /// Errors of continuous models, by correction.
    pub continuous: Variants,
    /// Errors of the sampled models, by correction.
    pub sampled: Variants,
}

/// Value for each correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variants {
    /// Error without correction: r(1 − |G|).
    pub none: f64,
    /// Error with the correction vector: r(1 − |G(1 + e^(−jωτ) − G)|).
    pub vector: f64,
    /// Error on the widened circle: r(1 − (1 + c·ω²)|G|).
    pub steady: f64,
    /// Error with feedback of the motors' errors: r(1 − |G·u|).
    pub feedback: f64,
}

impl Variants {
    /// Returns the value of a correction.
    #[must_use]
    pub fn of(&self, correction: Correction) -> f64 {
        match correction {
            Correction::None => self.none,
            Correction::Vector => self.vector,
            Correction::Steady => self.steady,
            Correction::Feedback => self.feedback,
        }
    }
}

impl ClosedForms {
    /// Computes the errors on a circle from gains in 1/s, the period in s, c in s², and the
    /// feedback.
    #[must_use]
    pub fn of(
        radius_mm: f64,
        speed_mm_per_s: f64,
        gains: [f64; 2],
        period: f64,
        c: f64,
        fed: Fed,
    ) -> Self {
        let omega = speed_mm_per_s / radius_mm;
        let [k1, k2] = gains;
        let widened = 1.0 + c * omega * omega;
        let continuous = over(k1 * k2, [k1 * k2 - omega * omega, k2 * omega]);
        let [k1, k2] = gains.map(|gain| gain * period);
        let turn = omega * period;
        let z = [turn.cos(), turn.sin()];
        let step = [z[0] - 1.0, z[1]];
        let square = times(step, step);
        let sampled = over(
            k1 * k2,
            [square[0] + k2 * step[0] + k1 * k2, square[1] + k2 * step[1]],
        );
        let sampled = times(z, sampled);
        let back = [1.0 - z[0], z[1]].map(|part| fed.lead * part);
        let seen = times(sampled, [1.0 - back[0], -back[1]]);
        let forms = |response: Complex, lag: f64, seen: Complex| {
            let sum = [1.0 + lag.cos() - response[0], -lag.sin() - response[1]];
            let inside = |times: f64| radius_mm * (1.0 - times);
            Variants {
                none: inside(size(response)),
                vector: inside(size(times(response, sum))),
                steady: inside(widened * size(response)),
                feedback: inside(size(times(response, fed.command(seen)))),
            }
        };
        ClosedForms {
            radius_mm,
            speed_mm_per_s,
            continuous: forms(continuous, omega / gains[0], continuous),
            sampled: forms(sampled, turn * (1.0 / k1 - 1.0), seen),
        }
    }
}

/// Feedback parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fed {
    /// Tangential gain T.
    pub tangential: f64,
    /// Normal gain N.
    pub normal: f64,
    /// Time in periods from the sampling of the motors to their comparison with the models.
    pub lead: f64,
}

impl Fed {
    /// Returns the parameters of a program.
    #[must_use]
    pub fn of(program: &Program) -> Self {
        let [tangential, normal] = program.feedback.parts(&Widths::FULL);
        let circuit = controller(COORDINATES, Correction::Feedback, Rounding::Nearest);
        Fed {
            tangential,
            normal,
            lead: circuit.feedback_lead() as f64 / f64::from(program.period_ticks),
        }
    }

    /// Returns u, if the motors are X = `seen` times the corrected command.
    fn command(self, [re, im]: Complex) -> Complex {
        let (t, n) = (self.tangential, self.normal);
        let whole = (1.0 + n * re) * (1.0 + t * re) + n * t * im * im;
        [(1.0 + t * re) / whole, -t * im / whole].map(|part| (1.0 + n) * part)
    }
}

/// Part of a run on a circle at constant speed, after the past has been forgotten.
#[derive(Debug, Clone, PartialEq)]
pub struct Steady {
    /// Number of its periods.
    pub periods: usize,
    /// Mean contour error of the models in mm.
    pub model_mm: f64,
    /// Mean contour error of the motors in mm.
    pub motor_mm: f64,
    /// Mean contour error of the loads in mm.
    pub load_mm: f64,
    /// Results of the closed forms.
    pub forms: ClosedForms,
}

/// Mean contour errors of the steady part of a run, by one correction; inwards positive where there
/// is a sign.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CircleMeasured {
    /// Radius r.
    pub radius_mm: f64,
    /// Speed v.
    pub speed_mm_per_s: f64,
    /// Periods of the steady part.
    pub periods: usize,
    /// Distance of the models from the circle.
    pub model_um: f64,
    /// Distance of the loads from the circle.
    pub load_um: f64,
    /// Distance by the closed form of continuous models.
    pub continuous_um: f64,
    /// Distance by the closed form of the sampled models.
    pub sampled_um: f64,
}

impl Steady {
    /// Returns the errors beside the closed forms of a correction.
    #[must_use]
    pub fn circle(&self, correction: Correction) -> CircleMeasured {
        CircleMeasured {
            radius_mm: self.forms.radius_mm,
            speed_mm_per_s: self.forms.speed_mm_per_s,
            periods: self.periods,
            model_um: self.model_mm * 1e3,
            load_um: self.load_mm * 1e3,
            continuous_um: self.forms.continuous.of(correction) * 1e3,
            sampled_um: self.forms.sampled.of(correction) * 1e3,
        }
    }
}

/// Range of lengths in which a circle is run at constant speed, with its observations.
#[derive(Debug)]
struct Stretch {
    from: f64,
    to: f64,
    forms: ClosedForms,
    /// Number of periods within it.
    periods: usize,
    /// Sums of the contour errors of models, motors and loads after the past has been forgotten.
    sums: [f64; 3],
}

/// Search for the longest [`Steady`] part of a run while it goes on.
#[derive(Debug)]
pub struct SteadySearch {
    /// Number of periods after which the past is forgotten.
    wait: usize,
    stretches: Vec<Stretch>,
    /// Index of the first stretch that has not ended.
    next: usize,
}

impl SteadySearch {
    /// Finds the stretches of a program; none if the models of the axes differ, since a circle is
    /// distorted then.
    #[must_use]
    pub fn new(program: &Program) -> Self {
        let motion = &program.motion;
        let [k1, k2] = program.tangential.parts(&Widths::FULL);
        let root = (k2 * k2 - 4.0 * k1 * k2).max(0.0).sqrt();
        let wait = (FORGOTTEN / ((k2 - root) / 2.0)).ceil() as usize;
        let mut stretches = Vec::new();
        let mut gains = program.gains.iter();
        let alike = gains.all(|gains| *gains == program.tangential);
        let circles = if alike { circles(program) } else { Vec::new() };
        let (mm, fed) = (1.0 / motion.units_per_mm, Fed::of(program));
        let gains = [k1, k2].map(|gain| gain / motion.period);
        let c = program.tangential.radial_s2(&Widths::FULL, motion.period);
        let mut first = 0;
        for (index, piece) in program.profile.pieces.iter().enumerate() {
            let next = program.profile.pieces.get(index + 1);
            let until = next.map_or(program.profile.duration, |next| next.t);
            if piece.a != 0.0 || piece.jerk != 0.0 || piece.v <= 0.0 {
                continue;
            }
            let ends = [piece.t, until].map(|t| program.profile.at(t)[0]);
            // Pieces and circles are both ordered by length.
            first += circles[first..].partition_point(|(circle, _)| (circle.end as f64) < ends[0]);
            for (circle, radius) in &circles[first..] {
                let from = (circle.start as f64).max(ends[0]);
                let to = (circle.end as f64).min(ends[1]);
                if from > to {
                    break;
                }
                let speed = piece.v * mm;
                stretches.push(Stretch {
                    from,
                    to,
                    forms: ClosedForms::of(radius * mm, speed, gains, motion.period, c, fed),
                    periods: 0,
                    sums: [0.0; 3],
                });
            }
        }
        SteadySearch {
            wait,
            stretches,
            next: 0,
        }
    }

    /// Adds the next period: its length, which never decreases, and the contour errors of models,
    /// motors and loads in mm.
    pub fn take(&mut self, length: i64, contour_mm: [f64; 3]) {
        let length = length as f64;
        let over = |stretch: &Stretch| stretch.to < length;
        self.next += self.stretches[self.next..]
            .iter()
            .take_while(|of| over(of))
            .count();
        // One stretch ends where another begins.
        let under_way = self.stretches[self.next..].iter_mut();
        for stretch in under_way.take_while(|stretch| stretch.from <= length) {
            if stretch.periods >= self.wait {
                for (sum, mm) in stretch.sums.iter_mut().zip(contour_mm) {
                    *sum += mm;
                }
            }
            stretch.periods += 1;
        }
    }

    /// Returns the longest part; `None` if no stretch has enough periods.
    #[must_use]
    pub fn finish(self) -> Option<Steady> {
        let wait = self.wait;
        let mut longest: Option<Steady> = None;
        for stretch in self.stretches {
            let periods = stretch.periods.saturating_sub(wait);
            if periods > longest.as_ref().map_or(0, |steady| steady.periods) {
                let [model_mm, motor_mm, load_mm] = stretch.sums.map(|sum| sum / periods as f64);
                longest = Some(Steady {
                    periods,
                    model_mm,
                    motor_mm,
                    load_mm,
                    forms: stretch.forms,
                });
            }
        }
        longest
    }
}

/// Returns the ranges of the path on one circle, in guard units, with the circle's radius.
fn circles(program: &Program) -> Vec<(Range<u64>, f64)> {
    let mut circles: Vec<(Range<u64>, f64)> = Vec::new();
    let mut before: Option<Segment> = None;
    for stretch in &program.path.stretches {
        let segment = stretch.segment;
        let end = stretch.begin + stretch.length;
        let flat = segment.third == [0.0; COORDINATES]
            && segment.fourth.is_none_or(|fourth| fourth.along == 0.0);
        let Some(arc) = segment.arc.filter(|_| flat) else {
            before = None;
            continue;
        };
        match (before, circles.last_mut()) {
            (Some(last), Some((circle, _))) if last.same_circle(&segment) => circle.end = end,
            _ => circles.push((stretch.begin..end, arc.radius)),
        }
        before = Some(segment);
    }
    circles
}

fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

fn over(numerator: f64, [re, im]: Complex) -> Complex {
    let square = re * re + im * im;
    [numerator * re / square, -numerator * im / square]
}

fn size([re, im]: Complex) -> f64 {
    re.hypot(im)
}
