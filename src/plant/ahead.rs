//! Plants that are simulated ahead of the circuit while the circuit does not change their inputs.

/// Greatest number of ticks that plants run ahead.
const MOST: u64 = 256;

/// Plant whose state can be saved and restored.
pub trait Plant {
    /// State of the plant.
    type State;

    fn state(&self) -> Self::State;

    /// Restores a state.
    fn set_state(&mut self, state: &Self::State);
}

/// Plants that run ahead together.
pub trait Plants {
    /// State of one plant, or of all.
    type State;

    /// Appends the states; their number is always the same.
    fn save(&self, states: &mut Vec<Self::State>);

    /// Restores states that [`save`](Self::save) has written.
    fn restore(&mut self, states: &[Self::State]);
}

impl<P: Plant, const N: usize> Plants for [P; N] {
    type State = P::State;

    #[inline]
    fn save(&self, states: &mut Vec<P::State>) {
        for plant in self {
            states.push(plant.state());
        }
    }

    #[inline]
    fn restore(&mut self, states: &[P::State]) {
        for (plant, state) in self.iter_mut().zip(states) {
            plant.set_state(state);
        }
    }
}

/// Plants, stepped once per tick, with their outputs: the levels of their encoders' channels.
#[derive(Debug, Clone)]
pub struct Ahead<P: Plants, S> {
    /// Plants in the tick to which they were stepped last.
    pub plants: P,
    given: Option<S>,
    /// States from that tick on, as far as the plants ran ahead.
    states: Vec<P::State>,
}

impl<P: Plants, S: Copy + PartialEq> Ahead<P, S> {
    /// Creates the plants before their first tick.
    pub fn new(plants: P) -> Self {
        Ahead {
            plants,
            given: None,
            states: Vec::new(),
        }
    }

    /// Returns the outputs in the next tick, to which `step` steps the plants.
    #[inline]
    pub fn step(&mut self, step: impl FnOnce(&mut P) -> S) -> S {
        let given = step(&mut self.plants);
        self.given = Some(given);
        given
    }

    /// Advances together with the circuit by at most `most` ticks, while the plants' outputs stay
    /// the same and the circuit drives them as before. `step` steps the plants; `circuit` advances
    /// by at most the given number of ticks and returns the number. The plants are then in the
    /// tick before the one that the circuit has reached.
    #[inline]
    pub fn go_on(
        &mut self,
        most: u64,
        mut step: impl FnMut(&mut P) -> S,
        circuit: impl FnOnce(u64) -> u64,
    ) {
        self.states.clear();
        self.plants.save(&mut self.states);
        let each = self.states.len();
        let most = most.clamp(1, MOST);
        let mut tried = 1;
        // In the tick in which the outputs change, the circuit may drive the plants differently.
        while tried < most && self.given == Some(step(&mut self.plants)) {
            self.plants.save(&mut self.states);
            tried += 1;
        }
        let gone = circuit(tried);
        let before = gone.saturating_sub(1);
        if before < tried {
            let first = before as usize * each;
            self.plants.restore(&self.states[first..first + each]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Outputs a third of the number of steps.
    struct Thirds(u64);

    impl Plants for Thirds {
        type State = u64;

        fn save(&self, states: &mut Vec<u64>) {
            states.push(self.0);
        }

        fn restore(&mut self, states: &[u64]) {
            self.0 = states[0];
        }
    }

    fn step(plant: &mut Thirds) -> u64 {
        plant.0 += 1;
        plant.0 / 3
    }

    #[test]
    fn what_is_stepped_ahead_is_given_in_its_tick() {
        // Greatest number of ticks, and number of ticks after which the circuit stops.
        let cases = [
            (1, 9),
            (5, 9),
            (1, 9),
            (2, 9),
            (9, 9),
            (9, 2),
            (9, 1),
            (0, 9),
            (4, 9),
            (9, 1),
            (9, 9),
        ];
        let mut plant = Ahead::new(Thirds(0));
        let mut tick = 0;
        for (most, stops) in cases {
            assert_eq!(plant.step(step), (tick + 1) / 3, "tick {tick}");
            // Its visible state belongs to this tick.
            assert_eq!(plant.plants.0, tick + 1, "tick {tick}");
            let mut gone = 0;
            plant.go_on(most, step, |ticks| {
                let stays = 3 - (tick + 1) % 3;
                assert_eq!(ticks, stays.min(most.max(1)), "tick {tick}");
                gone = ticks.min(stops);
                gone
            });
            assert_eq!(plant.plants.0, tick + gone, "tick {tick}");
            tick += gone;
        }
    }

    #[test]
    fn what_drives_it_in_the_tick_in_which_it_gives_something_else_is_that_of_the_tick() {
        let mut plant = Ahead::new(Thirds(0));
        plant.step(step);
        plant.go_on(9, step, |ticks| ticks);
        // The circuit drives it differently from this tick on.
        let given = plant.step(|plant| {
            plant.0 += 10;
            plant.0
        });
        assert_eq!(given, 12);
    }
}
