//! NURBS as in LinuxCNC: G5.2 with G5.3, and G6.2.
//!
//! The lines of a G5.2 give control points with weights P, from the tool's position, up to G5.3; L
//! of the first line is the order. The lines of a G6.2 give control points with weights R and
//! knots K; P of the first line is the order, and that number of equal knots ends the curve.

use super::block::Block;
use super::chords;
use super::machine::{Machine, Words};
use super::modal::Motion;
use super::problem::Problem;
use crate::input::Point;

/// Default order.
const USUAL_ORDER: usize = 3;

/// Greatest order.
const HIGHEST_ORDER: usize = 20;

/// Curve under construction.
#[derive(Debug)]
pub(super) struct Nurbs {
    /// Line that began the curve.
    pub(super) line: usize,
    /// True for a G6.2.
    knotted: bool,
    order: usize,
    /// Control points in the current plane, in millimetres.
    points: Vec<Weighted>,
    /// Knots, one for each line of a G6.2.
    knots: Vec<f64>,
}

/// Control point with its weight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weighted {
    pub(super) at: [f64; 2],
    pub(super) weight: f64,
}

impl Nurbs {
    pub(super) fn name(&self) -> &'static str {
        if self.knotted { "G6.2" } else { "G5.2" }
    }

    /// True if the knots of a G6.2 end: the last ones, as many as its order, are equal.
    fn ends(&self) -> bool {
        let count = self.knots.len();
        let last = self
            .knots
            .get(count.wrapping_sub(self.order)..)
            .unwrap_or_default();
        count >= 2 * self.order && last.windows(2).all(|pair| pair[0] == pair[1])
    }

    /// Returns the knots of a G5.2, which gives none: evenly spaced, with the ends repeated as
    /// often as the order.
    fn even_knots(&self) -> Vec<f64> {
        let spans = self.points.len() + 1 - self.order;
        let ends = |knot: usize| std::iter::repeat_n(knot as f64, self.order);
        let inner = (1..spans).map(|knot| knot as f64);
        ends(0).chain(inner).chain(ends(spans)).collect()
    }
}

impl Machine<'_> {
    /// Executes a line within a NURBS, or one that begins or ends it; `to` is the end of its axis
    /// words.
    pub(super) fn nurbs(
        &mut self,
        line: usize,
        block: &mut Block,
        to: Point,
        motion: Motion,
    ) -> Result<(), Problem> {
        let name = motion.name();
        let axes @ [a, b, c] = self.modal.plane.axes();
        let knotted = motion == Motion::KnottedNurbs;
        if motion == Motion::NurbsEnd {
            self.modal.motion = None;
            return match self.nurbs.take() {
                Some(curve) if !curve.knotted => {
                    let knots = (curve.points.len() >= curve.order).then(|| curve.even_knots());
                    self.curve(line, &curve, knots.unwrap_or_default(), axes)
                }
                _ => Err(Problem::new(name, "without G5.2 before", "G5.2 first").following()),
            };
        }
        let given = |axis: usize| block.axes().get(axis).copied().flatten().is_some();
        if given(c) || given(a) != given(b) {
            let problem = "control points have both coordinates of the plane, and no other";
            return Err(Problem::new(name, problem, "X and Y in G17"));
        }
        let here = given(a);
        let pick = |point: &Point| [a, b].map(|axis| point.get(axis).copied().unwrap_or(0.0));
        let (weight_letter, order_letter) = if knotted { (b'R', b'P') } else { (b'P', b'L') };
        let weight = block.take(weight_letter);
        if weight.is_some_and(|weight| weight <= 0.0) {
            let problem = "a weight that is not above 0";
            return Err(Problem::new(
                char::from(weight_letter),
                problem,
                "weights above 0",
            ));
        }
        let order = block.take(order_letter);
        let (knot, _) = (
            knotted.then(|| block.take(b'K')).flatten(),
            block.take(b'Q'),
        );
        let start = pick(&self.at);
        let first = self.nurbs.is_none();
        let curve = self.nurbs.get_or_insert(Nurbs {
            line,
            knotted,
            order: USUAL_ORDER,
            points: Vec::new(),
            knots: Vec::new(),
        });
        if let Some(order) = order {
            if order.fract() != 0.0 || !(2.0..=HIGHEST_ORDER as f64).contains(&order) {
                let problem = format!("an order of {order}");
                let allowed = format!("whole numbers from 2 to {HIGHEST_ORDER}");
                return Err(Problem::new(char::from(order_letter), problem, allowed));
            }
            curve.order = order as usize;
        }
        let mut push = |at: [f64; 2], weight: Option<f64>| {
            let weight = weight.unwrap_or(1.0);
            curve.points.push(Weighted { at, weight });
        };
        if !knotted {
            if first {
                push(start, weight.filter(|_| !here));
            }
            if here {
                push(pick(&to), weight);
            } else if !first && weight.is_some() {
                let problem = "a weight without its control point";
                return Err(Problem::new("P", problem, "P alone in the first line only"));
            }
            return Ok(());
        }
        let lacks = |field, problem| Problem::new(field, problem, "G6.2 X10 Y20 R1 K0 P4");
        if first && order.is_none() {
            return Err(lacks("P", "a G6.2 begins without its order"));
        }
        let knot = knot.ok_or_else(|| lacks("K", "a line of a G6.2 without its knot"))?;
        if curve.knots.last().is_some_and(|last| knot < *last) {
            let problem = format!("knot {knot} is less than the one before");
            return Err(Problem::new("K", problem, "knots that do not fall"));
        }
        // Lines after the last control point have knots only.
        let at = if here { pick(&to) } else { start };
        push(at, weight);
        curve.knots.push(knot);
        if !curve.ends() {
            return Ok(());
        }
        let Some(mut curve) = self.nurbs.take() else {
            return Ok(());
        };
        let knots = std::mem::take(&mut curve.knots);
        curve.points.truncate(knots.len() - curve.order);
        self.modal.motion = None;
        self.curve(line, &curve, knots, axes)
    }

    /// Returns an error for other motions within a NURBS.
    pub(super) fn not_within_nurbs(&self, words: &Words) -> Result<(), Problem> {
        let Some(curve) = &self.nurbs else {
            return Ok(());
        };
        let motion = words.motion.map(|(_, motion)| motion);
        let goes_on = match motion {
            None => words.own.is_none(),
            Some(Motion::KnottedNurbs) => curve.knotted,
            Some(Motion::Nurbs | Motion::NurbsEnd) => !curve.knotted,
            Some(_) => false,
        };
        if goes_on {
            return Ok(());
        }
        let field = motion.map_or_else(|| curve.name().to_owned(), Motion::name);
        let problem = format!(
            "within the NURBS that {} began in line {}",
            curve.name(),
            curve.line
        );
        let allowed = match curve.knotted {
            true => "control points, to as many equal knots as the order",
            false => "control points, and G5.3 behind them",
        };
        Err(Problem::new(field, problem, allowed).following())
    }

    /// Adds the chords of a curve.
    fn curve(
        &mut self,
        line: usize,
        curve: &Nurbs,
        knots: Vec<f64>,
        axes: [usize; 3],
    ) -> Result<(), Problem> {
        if curve.points.len() < curve.order {
            let problem = format!("{} control points, the first included", curve.points.len());
            let allowed = format!("as many as the order, {}, or more", curve.order);
            return Err(Problem::new(curve.name(), problem, allowed));
        }
        self.say_chords(line);
        let mut ends = Vec::new();
        chords::nurbs(&curve.points, &knots, curve.order, |end| ends.push(end));
        for end in ends {
            let mut to = self.at;
            for (axis, value) in axes.into_iter().zip(end) {
                if let Some(place) = to.get_mut(axis) {
                    *place = value;
                }
            }
            self.straight(to, false);
            self.not_too_many()?;
        }
        Ok(())
    }
}
