//! Replays: runs with a table of input changes, which show the changes of chosen signals.

use super::run::Receiver;
use super::{Handle, Model, ModelError};
use crate::engine::{InputChange, Replay, ReplayTick};

/// Least number of ticks for which shown signals are watched.
pub(super) const LONG: u64 = 16;

impl Model {
    /// Replays `ticks` ticks with recorded changes of input ports, and shows the ticks in which one
    /// of the signals in `shown` has changed. Compiled code reads the changes and finds these ticks,
    /// without a call in each tick.
    ///
    /// The first tick is shown with all signals. After that, signals hold their values from one
    /// shown tick to the next.
    ///
    /// Changes are sorted by tick, and change a port at most once in a tick. Their ticks are those of
    /// the model. Changes before its current tick are left out, so that a replay can be cut into
    /// pieces with the same table.
    ///
    /// ```
    /// use motion_rtl::Model;
    /// use motion_rtl::sim::InputChange;
    ///
    /// let mut counter = Model::new("enable_counter", &["width=8".parse()?])?;
    /// let [period, enable] = [counter.find("period")?, counter.find("enable")?];
    /// let change = |tick, word| InputChange { tick, port: period.index(), word };
    /// let mut rises = Vec::new();
    /// counter.replay(100, &[change(0, 10), change(50, 25)], &[enable], |now| {
    ///     rises.extend(now.changes().filter(|(_, word)| *word == 1).map(|_| now.tick));
    /// })?;
    /// assert_eq!(rises, [9, 19, 29, 39, 49, 74, 99]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// A replay that shows a word of a memory, or that writes waves, is slower: it goes tick by tick
    /// and compares all shown signals.
    ///
    /// # Errors
    /// Returns an error if a handle is of another circuit, or if a change is not in order, has no
    /// port, does not fit it, or is the second of its port in a tick. No tick happens then.
    pub fn replay(
        &mut self,
        ticks: u64,
        changes: &[InputChange],
        shown: &[Handle],
        see: impl FnMut(ReplayTick<'_>),
    ) -> Result<(), ModelError> {
        self.replay_of(ticks, changes, shown, false, see)
    }

    /// Replays like [`replay`](Self::replay), but jumps over idle ticks: those in which registers
    /// do nothing but count. Every change of an output port is shown. Of other signals, values
    /// within idle ticks are left out. While waves are written, no tick is left out.
    ///
    /// ```
    /// use motion_rtl::Model;
    /// use motion_rtl::sim::InputChange;
    ///
    /// let mut counter = Model::new("enable_counter", &["width=48".parse()?])?;
    /// let [period, enable] = [counter.find("period")?, counter.find("enable")?];
    /// let change = InputChange { tick: 0, port: period.index(), word: 1 << 40 };
    /// let mut shown = Vec::new();
    /// counter.fast_replay(1 << 41, &[change], &[enable], |now| shown.push(now.tick))?;
    /// assert_eq!(shown, [0, (1 << 40) - 1, 1 << 40, (1 << 41) - 1]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`replay`](Self::replay).
    pub fn fast_replay(
        &mut self,
        ticks: u64,
        changes: &[InputChange],
        shown: &[Handle],
        see: impl FnMut(ReplayTick<'_>),
    ) -> Result<(), ModelError> {
        self.replay_of(ticks, changes, shown, true, see)
    }

    fn replay_of(
        &mut self,
        ticks: u64,
        changes: &[InputChange],
        shown: &[Handle],
        jumps: bool,
        see: impl FnMut(ReplayTick<'_>),
    ) -> Result<(), ModelError> {
        let leaves = shown.iter().map(|&handle| self.leaf(handle));
        let leaves = leaves.collect::<Result<Vec<_>, _>>()?;
        let checked = self.circuit.ports.check_changes(changes);
        checked.map_err(|(tick, error)| ModelError::at(tick)(error))?;
        if ticks >= LONG {
            self.watch(shown)?;
        }
        self.replay_tapped(ticks, changes, &leaves, jumps, see);
        Ok(())
    }

    /// Replays checked changes, and passes each tick to the tap, if there is one.
    pub(super) fn replay_tapped(
        &mut self,
        ticks: u64,
        changes: &[InputChange],
        leaves: &[usize],
        jumps: bool,
        see: impl FnMut(ReplayTick<'_>),
    ) {
        match self.tap.take() {
            None => self.replay_leaves(ticks, changes, leaves, jumps, None, see),
            Some(mut tap) => {
                let receive: Receiver<'_> = &mut |tick, engine| tap.tick(tick, engine);
                self.replay_leaves(ticks, changes, leaves, jumps, Some(receive), see);
                self.tap = Some(tap);
            }
        }
    }

    /// Replays checked changes; jumps over idle ticks if `jumps` is true and nothing receives the
    /// ticks.
    pub(in crate::sim) fn replay_leaves(
        &mut self,
        ticks: u64,
        changes: &[InputChange],
        leaves: &[usize],
        jumps: bool,
        receive: Option<Receiver<'_>>,
        see: impl FnMut(ReplayTick<'_>),
    ) {
        let end = self.tick.saturating_add(ticks);
        let first = changes.partition_point(|change| change.tick < self.tick);
        let changes = &changes[first..];
        match Replay::new(&self.engine, changes, self.tick..end, leaves) {
            // A receiver needs the change marks, which rows clear.
            Some(replay) if receive.is_none() => self.replay_rows(replay, leaves, jumps, see),
            _ => self.replay_ticks(changes, end, leaves, jumps, receive, see),
        }
    }

    /// Replays many ticks at a time.
    fn replay_rows(
        &mut self,
        mut replay: Replay<'_>,
        leaves: &[usize],
        jumps: bool,
        mut see: impl FnMut(ReplayTick<'_>),
    ) {
        if replay.is_over() {
            return;
        }
        // The first tick shows all leaves, whatever has changed.
        self.continue_replay(&mut replay, self.tick, |_| {});
        let words = leaves.iter().map(|&leaf| self.engine.leaf(leaf));
        let known = words
            .enumerate()
            .filter_map(|(index, word)| Some([index as u64, word?]));
        let pairs: Vec<u64> = known.flatten().collect();
        see(ReplayTick::new(self.tick, &pairs));
        while !replay.is_over() {
            // This tick is settled.
            let stop = match jumps {
                true => {
                    self.engine.replay_forward(&mut replay);
                    self.engine.search_after(replay.tick())
                }
                false => u64::MAX,
            };
            self.continue_replay(&mut replay, stop, &mut see);
        }
    }

    /// Continues a replay until `stop` is settled, or to the end.
    fn continue_replay(
        &mut self,
        replay: &mut Replay<'_>,
        stop: u64,
        see: impl FnMut(ReplayTick<'_>),
    ) {
        self.engine.replay(replay, stop, see);
        (self.tick, self.settled) = (replay.tick(), replay.is_settled());
    }

    /// Replays tick by tick, and compares all leaves in each.
    fn replay_ticks(
        &mut self,
        mut changes: &[InputChange],
        end: u64,
        leaves: &[usize],
        jumps: bool,
        mut receive: Option<Receiver<'_>>,
        mut see: impl FnMut(ReplayTick<'_>),
    ) {
        let first = self.tick;
        let mut words = vec![None; leaves.len()];
        let mut pairs = Vec::new();
        while self.tick < end {
            while let Some((change, rest)) = changes.split_first()
                && change.tick <= self.tick
            {
                self.drive(change.port, change.word);
                changes = rest;
            }
            self.settle();
            pairs.clear();
            for (index, (&leaf, old)) in leaves.iter().zip(&mut words).enumerate() {
                let new = self.engine.leaf(leaf);
                if let Some(word) = new
                    && std::mem::replace(old, new) != new
                {
                    pairs.extend([index as u64, word]);
                }
            }
            if !pairs.is_empty() || self.tick == first {
                see(ReplayTick::new(self.tick, &pairs));
            }
            let held = changes.first().map_or(end, |change| change.tick.min(end));
            let gone = match &mut receive {
                Some(receive) => {
                    receive(self.tick, &self.engine);
                    0
                }
                None if jumps => self.engine.forward(held - self.tick),
                None => 0,
            };
            match gone {
                0 => self.edge(),
                gone => {
                    self.tick += gone;
                    self.settled = false;
                }
            }
        }
    }
}
