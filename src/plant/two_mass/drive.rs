//! Simulation of a tick in pieces of at most half a radian of the fastest motion, each split at
//! its events.

use super::TwoMassAxis;
use super::events::{Event, Flank, Grip, Guards};
use super::motion::{Regime, State, falls_below_zero, sum};

/// Greatest number of events in a piece; more are a tie within rounding, and the piece continues
/// without them.
const EVENTS: usize = 40;

impl TwoMassAxis {
    /// Advances one tick under this torque.
    #[inline]
    pub(super) fn drive(&mut self, torque_nm: f64) {
        self.torque_nm = torque_nm;
        if matches!(self.grips, [Grip::Loose, Grip::Loose]) && self.flank == Flank::Touches(0.0) {
            return self.gain(
                self.whole
                    .gained(&self.state, [torque_nm, self.load_torque_nm]),
            );
        }
        self.break_loose();
        for _ in 0..self.count {
            if matches!(self.grips, [Grip::Stuck, Grip::Stuck]) {
                return;
            }
            self.piece();
        }
    }

    /// Advances a piece of a tick, split at its events.
    fn piece(&mut self) {
        let torques = self.torques();
        let guards = self.guards();
        let regime = self.regime();
        let index = usize::from(regime.stuck[0])
            + 2 * usize::from(regime.stuck[1])
            + 4 * usize::from(regime.touches);
        let start = self.untwisted();
        let gained = self.pieces[index].gained(&start, torques);
        let end = sum(&start, &gained);
        let rates = |x| self.equations.rates(regime, x, torques);
        let rates = [rates(&start), rates(&end)];
        let quiet = guards.list().iter().all(|guard| {
            let turns = guard.part(&rates[0]) < 0.0 && guard.part(&rates[1]) > 0.0;
            guard.value(&end) >= 0.0 && !turns
        });
        match quiet {
            true => self.gain(gained),
            false => self.split(self.tick_s / f64::from(self.count)),
        }
    }

    /// Advances by a time within the reach of the series, event by event.
    #[cold]
    fn split(&mut self, time_s: f64) {
        let mut left = time_s;
        for _ in 0..EVENTS {
            let start = self.untwisted();
            let path = self.equations.path(self.regime(), &start, self.torques());
            let guards = self.guards();
            let first = guards
                .list()
                .iter()
                .filter_map(|guard| {
                    let mut series = path.series(|term| guard.part(term));
                    series[0] = guard.value(&start);
                    Some((falls_below_zero(&series, left)?, guard.event))
                })
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((time, event)) = first else {
                return self.gain(path.gained(left));
            };
            self.gain(path.gained(time));
            self.happens(event);
            left -= time;
        }
        let path = self
            .equations
            .path(self.regime(), &self.untwisted(), self.torques());
        self.gain(path.gained(left));
    }

    fn happens(&mut self, event: Event) {
        match event {
            Event::Rest(body) => {
                self.state[2 + body] = 0.0;
                self.grips[body] = Grip::Stuck;
            }
            Event::Breaks(body, sign) => self.grips[body] = Grip::Slides(sign),
            Event::Flank(flank) => self.flank = flank,
        }
        self.break_loose();
    }

    /// Starts bodies at rest if the torque on them exceeds the holding torque.
    #[inline]
    fn break_loose(&mut self) {
        let shaft = self.shaft_torque_nm();
        let held = self.held();
        let torques = [self.torque_nm - shaft, self.load_torque_nm + shaft];
        for (body, torque) in torques.into_iter().enumerate() {
            if self.grips[body] == Grip::Stuck && torque.abs() > held[body] {
                self.grips[body] = Grip::Slides(torque.signum());
            }
        }
    }

    /// Returns the torque up to which motor and load are held at rest: their stiction plus a
    /// margin for rounding. So a torque equal to the stiction holds, and a greater one moves a
    /// body despite rounding.
    #[inline]
    fn held(&self) -> [f64; 2] {
        let p = &self.parameters;
        let [motor, load, ..] = self.state;
        let blur = 1e-12 * (self.torque_nm.abs() + self.load_torque_nm.abs())
            + 4.0 * f64::EPSILON * self.equations.stiffness * (motor.abs() + load.abs());
        let held = |stiction: f64| stiction * (1.0 + 1e-12) + blur;
        [
            held(p.motor_friction_nm.max(p.motor_stiction_nm)),
            held(p.load_friction_nm.max(p.load_stiction_nm)),
        ]
    }

    /// Returns the torques on motor and load that do not depend on the state.
    #[inline]
    fn torques(&self) -> [f64; 2] {
        let against = |body: usize, friction: f64| match self.grips[body] {
            Grip::Slides(sign) => sign * friction,
            _ => 0.0,
        };
        [
            self.torque_nm - against(0, self.parameters.motor_friction_nm),
            self.load_torque_nm - against(1, self.parameters.load_friction_nm),
        ]
    }

    #[inline]
    fn regime(&self) -> Regime {
        Regime {
            touches: matches!(self.flank, Flank::Touches(_)),
            stuck: [self.grips[0] == Grip::Stuck, self.grips[1] == Grip::Stuck],
        }
    }

    #[inline]
    fn guards(&self) -> Guards {
        let touches = matches!(self.flank, Flank::Touches(_));
        let mut guards = Guards::new();
        let held = self.held();
        let torques = [self.torque_nm, self.load_torque_nm];
        for (body, torque) in torques.into_iter().enumerate() {
            let grip = (body, self.grips[body], held[body]);
            guards.body(grip, torque, &self.equations, touches);
        }
        if self.parameters.backlash_rad > 0.0 {
            let half = 0.5 * self.parameters.backlash_rad;
            guards.flank(self.flank, half, &self.equations);
        }
        guards
    }

    /// Returns the state with the twist counted from the flank.
    #[inline]
    pub(super) fn untwisted(&self) -> State {
        let [motor, load, motor_speed, load_speed] = self.state;
        let flank = self.flank.side() * 0.5 * self.parameters.backlash_rad;
        [motor - load - flank, 0.0, motor_speed, load_speed]
    }

    #[inline]
    fn gain(&mut self, gained: State) {
        self.state = sum(&self.state, &gained);
    }
}
