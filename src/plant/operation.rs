//! An operation that a machine does in passing: a valve, a knife, a marker.

/// It takes effect some time after its signal begins, and for as long as the signal stands.
#[derive(Debug, Clone, Copy)]
pub struct Operation {
    delay_ticks: u64,
    /// Ticks that the signal has stood.
    stood: u64,
}

impl Operation {
    /// One that takes effect after so many ticks of its signal.
    #[must_use]
    pub fn new(delay_ticks: u64) -> Self {
        let stood = 0;
        Operation { delay_ticks, stood }
    }

    /// Changes its delay, from the next tick on.
    pub fn set_delay(&mut self, ticks: u64) {
        self.delay_ticks = ticks;
    }

    /// One tick with its signal or without; whether it has effect in it.
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
