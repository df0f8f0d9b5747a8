//! Events that end a linear piece of the motion: a body comes to rest or breaks loose, a flank
//! touches or parts.

use super::motion::{Equations, State};

/// Friction state of motor or load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Grip {
    /// No dry friction.
    Loose,
    /// Held at rest.
    Stuck,
    /// Coulomb friction against a motion of this sign.
    Slides(f64),
}

/// State of the flanks; the sign is that of the twist.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Flank {
    /// Between the flanks: no torque.
    Gap,
    /// The shaft is twisted against this flank.
    Touches(f64),
    /// The shaft is twisted, but untwists faster than its damping lets the flank follow: no
    /// torque, since a flank does not pull.
    Parted(f64),
}

impl Flank {
    /// Returns the side to which the shaft is twisted.
    #[inline]
    pub fn side(self) -> f64 {
        match self {
            Flank::Gap => 0.0,
            Flank::Touches(side) | Flank::Parted(side) => side,
        }
    }
}

/// Event that ends a linear piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Event {
    /// The speed of this body reaches 0.
    Rest(usize),
    /// The torque on this body exceeds the holding torque, with this sign.
    Breaks(usize, f64),
    /// The flanks change.
    Flank(Flank),
}

/// Linear function of the state that is not negative until its event.
#[derive(Debug, Clone, Copy)]
pub(super) struct Guard {
    pub event: Event,
    by_twist: f64,
    by_speed: [f64; 2],
    rest: f64,
}

impl Guard {
    /// Returns the part proportional to the state; applied to the rates of the state, this is the
    /// rate of the guard.
    #[inline]
    pub fn part(&self, x: &State) -> f64 {
        self.by_twist * (x[0] - x[1]) + self.by_speed[0] * x[2] + self.by_speed[1] * x[3]
    }

    #[inline]
    pub fn value(&self, x: &State) -> f64 {
        self.part(x) + self.rest
    }
}

/// Guards of a piece, at most two of each body and two of the flanks.
#[derive(Debug)]
pub(super) struct Guards {
    list: [Guard; 6],
    count: usize,
}

impl Guards {
    #[inline]
    pub fn new() -> Self {
        let none = Guard {
            event: Event::Rest(0),
            by_twist: 0.0,
            by_speed: [0.0; 2],
            rest: 0.0,
        };
        Guards {
            list: [none; 6],
            count: 0,
        }
    }

    #[inline]
    pub fn list(&self) -> &[Guard] {
        &self.list[..self.count]
    }

    #[inline]
    fn push(&mut self, event: Event, by_twist: f64, by_speed: [f64; 2], rest: f64) {
        self.list[self.count] = Guard {
            event,
            by_twist,
            by_speed,
            rest,
        };
        self.count += 1;
    }

    /// Adds the guards of motor (0) or load (1), held up to this torque, under a drive torque,
    /// with a shaft that touches or not.
    #[inline]
    pub fn body(
        &mut self,
        (body, grip, held): (usize, Grip, f64),
        torque: f64,
        equations: &Equations,
        touches: bool,
    ) {
        match grip {
            Grip::Loose => {}
            Grip::Slides(sign) => {
                let mut by_speed = [0.0; 2];
                by_speed[body] = sign;
                self.push(Event::Rest(body), 0.0, by_speed, 0.0);
            }
            Grip::Stuck => {
                // The shaft brakes the motor and drives the load.
                let shaft = match (touches, body) {
                    (false, _) => 0.0,
                    (true, 0) => 1.0,
                    (true, _) => -1.0,
                };
                for sign in [1.0, -1.0] {
                    let (k, c) = (
                        sign * shaft * equations.stiffness,
                        sign * shaft * equations.damping,
                    );
                    let rest = held - sign * torque;
                    self.push(Event::Breaks(body, sign), k, [c, -c], rest);
                }
            }
        }
    }

    /// Adds the guards of the flanks, with a backlash of `half` to both sides.
    #[inline]
    pub fn flank(&mut self, flank: Flank, half: f64, equations: &Equations) {
        let (k, c) = (equations.stiffness, equations.damping);
        match flank {
            Flank::Gap => {
                for side in [1.0, -1.0] {
                    self.push(Event::Flank(Flank::Touches(side)), -side, [0.0; 2], half);
                }
            }
            Flank::Touches(side) => {
                let next = match c == 0.0 {
                    true => Flank::Gap,
                    false => Flank::Parted(side),
                };
                self.push(Event::Flank(next), side * k, [side * c, -side * c], 0.0);
            }
            Flank::Parted(side) => {
                let touches = Event::Flank(Flank::Touches(side));
                self.push(touches, -side * k, [-side * c, side * c], 0.0);
                self.push(Event::Flank(Flank::Gap), side, [0.0; 2], 0.0);
            }
        }
    }
}
