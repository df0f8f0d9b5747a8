//! Ticks of a model.

use super::Model;
use crate::engine::Engine;

/// Receiver of a settled tick.
pub(in crate::sim) type Receiver<'r> = &'r mut dyn FnMut(u64, &Engine);

impl Model {
    #[inline]
    pub(in crate::sim) fn settle(&mut self) {
        if !self.settled {
            self.engine.settle();
            self.settled = true;
        }
    }

    /// Makes the edge of a settled tick.
    #[inline]
    pub(in crate::sim) fn edge(&mut self) {
        self.engine.edge();
        self.tick += 1;
        self.settled = false;
    }

    /// Makes the edge of a settled tick with a reset.
    pub(in crate::sim) fn reset_edge(&mut self) {
        self.engine.reset();
        self.tick += 1;
        self.settled = false;
    }

    /// Advances to the next tick.
    #[inline]
    pub fn step(&mut self) {
        self.settle();
        self.receive();
        self.edge();
    }

    /// Advances to the next tick by a synchronous reset.
    ///
    /// After that edge every flip-flop has its power-on value. Memories and shift registers have
    /// no reset, like block RAM: they take the edge as usual, and a write in the tick of the reset
    /// takes effect.
    pub fn reset(&mut self) {
        self.settle();
        self.receive();
        self.reset_edge();
    }

    /// Advances by `ticks` ticks with constant input ports.
    pub fn run(&mut self, ticks: u64) {
        self.go(ticks, false);
    }

    /// Advances by `ticks` ticks with constant input ports, as [`run`](Self::run) does, but jumps
    /// over idle ticks: those in which registers do nothing but count. The state afterwards is the
    /// same. While waves are written, no tick is left out.
    ///
    /// ```
    /// use motion_rtl::Model;
    ///
    /// let mut counter = Model::new("enable_counter", &["width=48".parse()?])?;
    /// counter.set("period", 1u64 << 47)?;
    /// counter.fast_forward((1 << 47) - 1);
    /// assert_eq!(counter.get("enable")?, 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn fast_forward(&mut self, ticks: u64) {
        self.go(ticks, true);
    }

    fn go(&mut self, ticks: u64, jumps: bool) {
        let until = self.tick.saturating_add(ticks);
        let mut tap = self.tap.take();
        while self.tick < until {
            match &mut tap {
                None => self.go_to_change(until, jumps, None),
                Some(tap) => {
                    let mut receive = |tick: u64, engine: &Engine| tap.tick(tick, engine);
                    self.go_to_change(until, jumps, Some(&mut receive))
                }
            };
        }
        self.tap = tap;
    }

    /// Advances to the next tick in which something watched has changed; jumps over idle ticks if
    /// `jumps` is true and nothing receives the ticks. Returns true if there is one before `until`;
    /// its registers are set, and nothing is settled.
    pub(in crate::sim) fn go_to_change(
        &mut self,
        until: u64,
        jumps: bool,
        mut receive: Option<Receiver<'_>>,
    ) -> bool {
        self.settle();
        loop {
            let left = until - self.tick;
            if jumps && receive.is_none() {
                let gone = self.engine.forward(left);
                self.tick += gone;
                if gone > 0 {
                    self.settled = false;
                    if gone == left {
                        return false;
                    }
                    self.settle();
                    return true;
                }
            }
            let most = match &mut receive {
                Some(receive) => {
                    receive(self.tick, &self.engine);
                    1
                }
                None if jumps => self.engine.pause(),
                None => u64::MAX,
            };
            if left == 1 {
                self.edge();
                return false;
            }
            // Stops at a settled tick.
            self.tick += self.engine.advance(most.min(left - 1));
            if self.engine.has_changed() {
                return true;
            }
        }
    }

    /// Passes this settled tick to the tap.
    #[inline]
    pub(super) fn receive(&mut self) {
        if self.tap.is_some() {
            self.pass_on();
        }
    }

    #[cold]
    #[inline(never)]
    fn pass_on(&mut self) {
        if let Some(tap) = &mut self.tap {
            tap.tick(self.tick, &self.engine);
        }
    }
}
