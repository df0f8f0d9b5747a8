//! Operation that a machine does in passing: a valve, a knife, a marker.

/// Operation that takes effect some time after its signal begins, and ends with the signal.
#[derive(Debug, Clone, Copy)]
pub struct Operation {
    delay_ticks: u64,
    /// Number of ticks for which the signal has been high.
    stood: u64,
}

impl Operation {
    /// Creates an operation that takes effect after `delay_ticks` ticks of its signal.
    #[must_use]
    pub fn new(delay_ticks: u64) -> Self {
        let stood = 0;
        Operation { delay_ticks, stood }
    }

    /// Changes the delay, from the next tick on.
    pub fn set_delay(&mut self, ticks: u64) {
        self.delay_ticks = ticks;
    }

    /// Advances one tick; returns true if the operation has effect in it.
    pub fn step(&mut self, signal: bool) -> bool {
        let effect = signal && self.stood >= self.delay_ticks;
        self.stood = if signal { self.stood + 1 } else { 0 };
        effect
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_takes_effect_so_many_ticks_after_its_signal() {
        for delay in [0, 1, 5] {
            let mut operation = Operation::new(delay);
            for _ in 0..2 {
                let effects: Vec<bool> = (0..8).map(|tick| operation.step(tick < 7)).collect();
                let expected: Vec<bool> = (0..8).map(|tick| tick >= delay && tick < 7).collect();
                assert_eq!(effects, expected, "{delay}");
            }
        }
    }
}
