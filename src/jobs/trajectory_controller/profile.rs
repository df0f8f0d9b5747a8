//! Length along the path over time (¶0033): pieces of constant jerk.

/// Piece of a profile, from its start to that of the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// Start time.
    pub t: f64,
    /// Length along the path at the start.
    pub q: f64,
    /// Speed at the start.
    pub v: f64,
    /// Acceleration at the start.
    pub a: f64,
    pub jerk: f64,
}

impl Cubic {
    /// Returns length, speed and acceleration at a time.
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; 3] {
        let Cubic { q, v, a, jerk, .. } = *self;
        let t = t - self.t;
        [
            q + t * (v + t * (a / 2.0 + t * jerk / 6.0)),
            v + t * (a + t * jerk / 2.0),
            a + t * jerk,
        ]
    }
}

/// Profile q(t) from q(0) = 0 to q(T) = L, at rest at both ends.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Profile {
    /// Pieces in order.
    pub pieces: Vec<Cubic>,
    /// Duration T.
    pub duration: f64,
    /// Length L.
    pub length: f64,
}

impl Profile {
    /// Returns the index of the piece at a time.
    #[must_use]
    pub fn index(&self, t: f64) -> usize {
        let after = self.pieces.partition_point(|piece| piece.t <= t);
        after.saturating_sub(1)
    }

    /// Returns length, speed and acceleration at a time; at rest before the start and from the end
    /// on.
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; 3] {
        match self.pieces.get(self.index(t)) {
            Some(piece) if t < self.duration => piece.at(t.max(0.0)),
            _ => [self.length, 0.0, 0.0],
        }
    }

    /// Returns the speed where a length is reached.
    #[must_use]
    pub fn speed_at(&self, length: f64) -> f64 {
        self.at(self.time(length))[1]
    }

    /// Returns the time at which a length is reached.
    fn time(&self, length: f64) -> f64 {
        let index = self.pieces.partition_point(|piece| piece.q <= length);
        let from = self.pieces[..index].last().map_or(0.0, |piece| piece.t);
        let to = self.pieces.get(index).map_or(self.duration, |next| next.t);
        // The length never falls, so bisection finds it.
        let (mut early, mut late) = (from, to);
        for _ in 0..60 {
            let middle = f64::midpoint(early, late);
            match self.at(middle)[0] < length {
                true => early = middle,
                false => late = middle,
            }
        }
        early
    }

    /// Returns the highest speed between two lengths: at one of them, or where a piece begins.
    #[must_use]
    pub fn highest_speed(&self, from: f64, to: f64) -> f64 {
        let first = self.pieces.partition_point(|piece| piece.q <= from);
        let inside = self.pieces[first..].iter().take_while(|piece| piece.q < to);
        let ends = self.speed_at(from).max(self.speed_at(to));
        inside.map(|piece| piece.v).fold(ends, f64::max)
    }

    /// Appends `time` of a piece, unless that is below the resolution of time.
    pub(super) fn push(&mut self, time: f64, q: f64, [v, a, jerk]: [f64; 3]) {
        let end = self.duration + time;
        if end <= self.duration {
            return;
        }
        let steady = |piece: &Cubic| piece.a == 0.0 && piece.jerk == 0.0 && piece.v == v;
        let joins = a == 0.0 && jerk == 0.0 && self.pieces.last().is_some_and(steady);
        if !joins {
            let t = self.duration;
            self.pieces.push(Cubic { t, q, v, a, jerk });
        }
        self.duration = end;
    }
}
