//! Look-ahead: speed along the path (¶0033).
//!
//! ```text
//!  limits ‾‾‾|____|‾‾‾‾‾‾|  |‾‾‾‾‾       A stretch between two known speeds is given the highest
//!           __    :  __  |__|            speed to which it can be ramped up, held, and ramped down.
//!          /  \___:_/  \_:  :            Where a limit keeps it from a higher one, that place has
//!         /       :      :  :            its speed, and what is before and behind it is done the
//!                                        same way.
//! ```
//!
//! All ramps begin and end without acceleration, so a ramp may pass any number of segments, and
//! any number of ramps fit together. With t_j = 0 the result equals that of a backward and a
//! forward pass, the fastest possible.

use super::profile::Profile;
use super::ramp::{Ramp, Slope};
use super::speed_limits::{Span, SpeedLimits};

/// Relative gain of speed below which a peak is left out.
const GAIN: f64 = 1e-3;

/// Relative precision of a speed.
const NEAR: f64 = 1e-13;

/// Position with its speed, without acceleration.
#[derive(Debug, Clone, Copy)]
struct Node {
    at: f64,
    speed: f64,
}

/// Task of planning, or of writing a planned part.
enum Task {
    Between(Node, Node),
    Ramp(Node, f64),
    Cruise(Node, f64),
}

/// Constraint that limits a speed.
enum Bound {
    /// Available length.
    Room,
    /// Limit on the ramp up.
    Up,
    /// Limit on the ramp down.
    Down,
}

/// Plans the profile over all spans, at rest at both ends and at every stop.
#[must_use]
pub fn plan(spans: &[Span], slope: Slope) -> Profile {
    let limits = SpeedLimits::new(spans);
    let mut planner = Planner {
        fastest: limits.on_span.iter().copied().fold(0.0, f64::max),
        limits: &limits,
        slope,
        tasks: Vec::new(),
        profile: Profile::default(),
    };
    let rest = |at: f64| Node { at, speed: 0.0 };
    let stops = limits.joints.iter().zip(&limits.at_joint);
    let stops = stops.filter(|(_, limit)| **limit <= 0.0);
    let stops: Vec<Node> = stops.map(|(at, _)| rest(*at)).collect();
    for pair in stops.windows(2).rev() {
        planner.tasks.push(Task::Between(pair[0], pair[1]));
    }
    while let Some(task) = planner.tasks.pop() {
        match task {
            Task::Between(from, to) => planner.between(from, to),
            Task::Ramp(from, speed) => planner.ramp(from, speed),
            Task::Cruise(from, to) => planner.cruise(from, to),
        }
    }
    planner.profile.length = limits.joints.last().copied().unwrap_or(0.0);
    planner.profile
}

struct Planner<'a> {
    limits: &'a SpeedLimits,
    slope: Slope,
    fastest: f64,
    tasks: Vec<Task>,
    profile: Profile,
}

impl Planner<'_> {
    /// Returns the positions at which the ramps from and to a speed between two nodes end and
    /// begin.
    fn steady(&self, from: Node, to: Node, speed: f64) -> [f64; 2] {
        let way = |node: Node| self.slope.ramp(node.speed, speed).way();
        [from.at + way(from), to.at - way(to)]
    }

    /// Plans the part between two nodes; the slower of their speeds can be reached from the other.
    fn between(&mut self, from: Node, to: Node) {
        let least = from.speed.max(to.speed);
        let fits = |speed: f64| {
            let way = |node: Node| self.slope.ramp(node.speed, speed).way();
            way(from) + way(to) <= to.at - from.at
        };
        let room = highest(least, self.fastest.max(least), fits);
        if room <= least * (1.0 + GAIN) {
            return self.block(from, to, least);
        }
        let joints = self.limits.joint_behind(from.at)..self.limits.joint_from(to.at);
        let mut speed = room;
        let mut bound = Bound::Room;
        if let Some(lower) = self.under(from, speed, least, joints.clone()) {
            (speed, bound) = (lower, Bound::Up);
        }
        if let Some(lower) = self.under(to, speed, least, joints.rev()) {
            (speed, bound) = (lower, Bound::Down);
        }
        if let Some((lower, begin, end)) = self.held(from, to, speed) {
            self.push_behind(end, lower, to);
            self.tasks.push(Task::Cruise(
                Node {
                    at: begin,
                    speed: lower,
                },
                end,
            ));
            return self.push_before(from, begin, lower);
        }
        let [begin, end] = self.steady(from, to, speed);
        match bound {
            Bound::Room => self.block(from, to, speed),
            Bound::Up => {
                self.push_behind(begin, speed, to);
                self.tasks.push(Task::Ramp(from, speed));
            }
            Bound::Down => {
                self.tasks
                    .push(Task::Ramp(Node { at: end, speed }, to.speed));
                self.push_before(from, end, speed);
            }
        }
    }

    fn push_before(&mut self, from: Node, at: f64, speed: f64) {
        self.tasks.push(Task::Between(from, Node { at, speed }));
    }

    fn push_behind(&mut self, at: f64, speed: f64, to: Node) {
        self.tasks.push(Task::Between(Node { at, speed }, to));
    }

    /// Returns the greatest speed below `speed` for which the ramp at a node is below the limits
    /// of the joints, which are ordered by their distance from it; `None` if that is `speed`.
    fn under(
        &self,
        node: Node,
        speed: f64,
        least: f64,
        joints: impl Iterator<Item = usize>,
    ) -> Option<f64> {
        let (mut highest_speed, mut ramp) = (speed, self.slope.ramp(node.speed, speed));
        for joint in joints {
            let (distance, limit) = (
                (self.limits.joints[joint] - node.at).abs(),
                self.limits.at_joint[joint],
            );
            if distance >= ramp.way() {
                break;
            }
            let under = |ramp: &Ramp| ramp.high <= limit || ramp.reaches(limit) >= distance;
            if !under(&ramp) {
                let fits = |speed: f64| under(&self.slope.ramp(node.speed, speed));
                let low = least.max(limit.min(highest_speed));
                highest_speed = highest(low, highest_speed, fits);
                ramp = self.slope.ramp(node.speed, highest_speed);
            }
        }
        (highest_speed < speed).then_some(highest_speed)
    }

    /// Returns the limit that applies between the ramps from and to a speed, if there is one, and
    /// the range in which it is the speed.
    fn held(&self, from: Node, to: Node, speed: f64) -> Option<(f64, f64, f64)> {
        let limits = self.limits;
        let [begin, end] = self.steady(from, to, speed);
        let first = limits.joint_from(begin).max(limits.joint_behind(from.at));
        let behind = limits.joint_behind(end).min(limits.joint_from(to.at));
        let lowest = limits.lowest(first, behind);
        let (limit, [mut first, mut last]) = match lowest {
            Some(joint) => (limits.at_joint[joint], [limits.joints[joint]; 2]),
            None => {
                let span = limits.joint_behind(begin).min(limits.on_span.len()) - 1;
                let ends = [limits.joints[span], limits.joints[span + 1]];
                (limits.on_span[span], ends)
            }
        };
        if limit > speed {
            return None;
        }
        let [begin, end] = self.steady(from, to, limit);
        // Includes the spans at the joint that have the same limit.
        if let Some(joint) = lowest {
            if limits.on_span[joint - 1] <= limit {
                first = limits.joints[joint - 1];
            }
            let mut next = joint;
            while last < end && limits.on_span[next] <= limit {
                next += 1;
                last = limits.joints[next];
            }
        }
        Some((limit, first.max(begin), last.min(end)))
    }

    /// Writes ramp, cruise and ramp.
    fn block(&mut self, from: Node, to: Node, speed: f64) {
        let [begin, end] = self.steady(from, to, speed);
        self.ramp(from, speed);
        self.cruise(Node { at: begin, speed }, end);
        self.ramp(Node { at: end, speed }, to.speed);
    }

    fn cruise(&mut self, from: Node, to: f64) {
        if from.speed > 0.0 {
            let time = (to - from.at) / from.speed;
            self.profile.push(time, from.at, [from.speed, 0.0, 0.0]);
        }
    }

    fn ramp(&mut self, from: Node, speed: f64) {
        let ramp = self.slope.ramp(from.speed, speed);
        let sign = (speed - from.speed).signum();
        let (peak, jerk) = (sign * ramp.peak, sign * ramp.jerk());
        let bend = peak * ramp.rise / 2.0;
        let flat = from.at + (from.speed + bend / 3.0) * ramp.rise;
        let fall = from.at + ramp.way() - (speed - bend / 3.0) * ramp.rise;
        let pieces = [
            (ramp.rise, from.at, [from.speed, 0.0, jerk]),
            (ramp.flat, flat, [from.speed + bend, peak, 0.0]),
            (ramp.rise, fall, [speed - bend, peak, -jerk]),
        ];
        for (time, q, derivatives) in pieces {
            self.profile.push(time, q, derivatives);
        }
    }
}

/// Returns the greatest number that fits, between one that does and one that may.
fn highest(mut low: f64, mut high: f64, fits: impl Fn(f64) -> bool) -> f64 {
    if fits(high) {
        return high;
    }
    while high - low > NEAR * high {
        let middle = f64::midpoint(low, high);
        match fits(middle) {
            true => low = middle,
            false => high = middle,
        }
    }
    low
}
