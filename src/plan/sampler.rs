//! Position at a time.

use super::geometry::Curve;
use super::profile::{Phases, Plan, Segment};
use crate::input::Point;

/// State of the tool at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Position in millimetres.
    pub position: Point,
    /// Speed along the path in mm/s.
    pub speed: f64,
    /// Distance travelled along the path, in millimetres.
    pub travelled_mm: f64,
    /// True if the current move is an arc; at a junction the move that begins counts.
    pub arc: bool,
    /// True if the current move is a rapid one.
    pub rapid: bool,
    /// Line of the current move in the input; 0 if the path has no length.
    pub line: usize,
    /// Index of the current move in the drawing.
    pub index: usize,
}

/// Sampler of a [`Plan`]'s position over time.
///
/// Times that do not decrease cost amortised O(1) each; an earlier time costs a binary search.
#[derive(Debug, Clone)]
pub struct Sampler<'p, 'd> {
    plan: &'p Plan<'d>,
    current: Option<Current>,
}

/// Current segment with its curve and phases.
#[derive(Debug, Clone, Copy)]
struct Current {
    /// Index into the plan's segments.
    number: usize,
    segment: Segment,
    phases: Phases,
    curve: Curve,
    rapid: bool,
    line: usize,
}

impl<'p, 'd> Sampler<'p, 'd> {
    pub(super) fn new(plan: &'p Plan<'d>) -> Self {
        let current = (plan.count() > 0).then(|| Current::enter(plan, 0));
        Self { plan, current }
    }

    /// Returns the sample at `time_s` seconds: the start before 0, and exactly the end from the
    /// plan's duration on.
    pub fn at(&mut self, time_s: f64) -> Sample {
        let Some(current) = &mut self.current else {
            return Sample {
                position: self.plan.end(),
                speed: 0.0,
                travelled_mm: 0.0,
                arc: false,
                rapid: false,
                line: 0,
                index: 0,
            };
        };
        let mut number = current.number;
        if time_s < current.segment.start_s {
            number = self.plan.under_way(time_s);
        }
        while number + 1 < self.plan.count() && time_s >= self.plan.end_s(number) {
            number += 1;
        }
        if number != current.number {
            *current = Current::enter(self.plan, number);
        }
        let ended = time_s >= self.plan.end_s(number);
        current.sample(time_s, ended, self.plan.acceleration)
    }
}

impl Sampler<'_, '_> {
    /// Stores in `turns` the times within a span at which a coordinate may stop or reverse:
    /// between them every coordinate is monotonic. They are the junctions of the moves and, on
    /// arcs, the points at multiples of a right angle.
    pub(crate) fn turns(&mut self, [from_s, to_s]: [f64; 2], turns: &mut Vec<f64>) {
        turns.clear();
        self.at(from_s);
        let Some(mut current) = self.current else {
            return;
        };
        loop {
            let Segment { start_s, .. } = current.segment;
            let quarters = current.curve.quarters();
            let own =
                quarters.map(|along| start_s + current.time_at(along, self.plan.acceleration));
            turns.extend(
                [start_s]
                    .into_iter()
                    .chain(own)
                    .filter(|t| (from_s..to_s).contains(t)),
            );
            let next = current.number + 1;
            if next >= self.plan.count() || self.plan.end_s(current.number) >= to_s {
                break;
            }
            current = Current::enter(self.plan, next);
        }
        turns.extend(Some(self.plan.duration_s()).filter(|t| (from_s..to_s).contains(t)));
    }
}

impl Current {
    /// Returns the seconds into the segment at which it has advanced by a length in millimetres.
    fn time_at(&self, along: f64, acceleration: f64) -> f64 {
        let Segment {
            length_mm,
            entry,
            peak,
            exit,
            ..
        } = self.segment;
        let phases = &self.phases;
        let ramp = |from: f64, mm: f64| {
            let root = (from * from + 2.0 * acceleration * mm).sqrt();
            if mm > 0.0 {
                2.0 * mm / (from + root)
            } else {
                0.0
            }
        };
        let to_go = length_mm - along;
        if along <= phases.rising_mm {
            ramp(entry, along)
        } else if to_go >= phases.falling_mm {
            phases.rising_s + (along - phases.rising_mm) / peak
        } else {
            phases.rising_s + phases.steady_s + phases.falling_s - ramp(exit, to_go)
        }
    }

    fn enter(plan: &Plan<'_>, number: usize) -> Self {
        let (segment, curve) = plan.segment(number);
        let step = plan.drawing.moves.get(segment.index);
        Self {
            number,
            segment,
            phases: segment.phases(plan.acceleration),
            curve,
            rapid: step.is_some_and(|step| step.rapid),
            line: step.map_or(0, |step| step.line),
        }
    }

    fn sample(&self, time_s: f64, ended: bool, acceleration: f64) -> Sample {
        let (along, speed) = if ended {
            (self.segment.length_mm, self.segment.exit)
        } else {
            self.advance((time_s - self.segment.start_s).max(0.0), acceleration)
        };
        Sample {
            position: self.curve.at(along),
            speed,
            travelled_mm: self.segment.start_mm + along,
            arc: self.curve.is_arc(),
            rapid: self.rapid,
            line: self.line,
            index: self.segment.index,
        }
    }

    /// Returns length and speed `time` seconds into the segment. Each phase is limited to its own
    /// length, so that rounding cannot reverse the path.
    fn advance(&self, time: f64, acceleration: f64) -> (f64, f64) {
        let Segment {
            length_mm,
            entry,
            peak,
            exit,
            ..
        } = self.segment;
        let Phases {
            rising_mm,
            rising_s,
            steady_s,
            falling_mm,
            falling_s,
        } = self.phases;
        let braking_mm = length_mm - falling_mm;
        if time < rising_s {
            let along = (entry + 0.5 * acceleration * time) * time;
            return (
                along.min(rising_mm),
                (entry + acceleration * time).min(peak),
            );
        }
        let time = time - rising_s;
        if time < steady_s {
            return ((rising_mm + peak * time).min(braking_mm), peak);
        }
        let left = (falling_s - (time - steady_s)).max(0.0);
        let to_go = (exit + 0.5 * acceleration * left) * left;
        (
            (length_mm - to_go).clamp(braking_mm, length_mm),
            (exit + acceleration * left).min(peak),
        )
    }
}
