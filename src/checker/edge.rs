//! Edges of a comparison.

use super::{Checker, State, Unknown};

impl Checker {
    /// Passes an edge while nothing runs, or with unknown ports.
    #[cold]
    #[inline(never)]
    pub(super) fn rare_edge(&mut self, rst: bool, words: &[u64]) -> bool {
        let inputs = self.layout.inputs.len();
        let unknown_rst = self.unknown.iter().any(|unknown| unknown.port.is_none());
        let rst = rst && !unknown_rst;
        if self.state == State::Waiting {
            if self.from_power_on {
                self.state = State::Running;
            } else if rst {
                self.state = State::Beginning;
                self.drive(words);
                self.pass(rst, words);
            }
        } else if self.state == State::Beginning {
            let is_input = |unknown: &Unknown| unknown.port.is_some_and(|port| port < inputs);
            match rst && self.unknown.iter().any(is_input) {
                // The reset of the design still hides its unknown inputs.
                true => {
                    self.drive(words);
                    self.pass(rst, words);
                }
                false => self.state = State::Running,
            }
        }
        if self.state == State::Running {
            let input = |unknown: &&Unknown| unknown.port.is_none_or(|port| port < inputs);
            if let Some(unknown) = self.unknown.iter().find(input) {
                let name = unknown.port.map_or("rst", |port| &self.ports[port].name);
                self.text += &self.stopped(name, &unknown.bits);
                self.state = State::Stopped;
            } else {
                self.drive(words);
                if self.differs(words) || !self.unknown.is_empty() {
                    self.difference(rst, words);
                }
                self.pass(rst, words);
            }
        }
        self.unknown.clear();
        !self.text.is_empty()
    }

    /// Sets the model's input ports whose words differ from the last ones.
    #[inline]
    pub(super) fn drive(&mut self, words: &[u64]) {
        let known = self.layout.input_words;
        for ((word, last), ports) in words[..known].iter().zip(&self.last).zip(&self.of_word) {
            if word != last {
                for port in &self.ports[ports.clone()] {
                    self.model.drive(port.leaf, port.place.bits(*word));
                }
            }
        }
    }

    /// True if an output port of the design differs from the model's in this tick.
    #[inline]
    pub(super) fn differs(&mut self, words: &[u64]) -> bool {
        self.ticks += 1;
        let known = self.layout.input_words;
        let mut differing = 0;
        for (word, ports) in words[known..].iter().zip(&self.of_word[known..]) {
            for port in &self.ports[ports.clone()] {
                differing |= self.model.word(port.leaf) ^ port.place.bits(*word);
            }
        }
        differing != 0
    }

    /// Counts and reports the differences of this tick.
    #[cold]
    #[inline(never)]
    pub(super) fn difference(&mut self, rst: bool, words: &[u64]) {
        let (inputs, tick) = (self.layout.inputs.len(), self.model.tick());
        let mut values = Vec::new();
        for index in inputs..self.ports.len() {
            let port = &mut self.ports[index];
            let model = self.model.word(port.leaf);
            let unknown = self.unknown.iter().any(|other| other.port == Some(index));
            if model != port.place.bits(words[port.place.word]) || unknown {
                if port.differences == 0 {
                    port.first = tick;
                }
                port.differences += 1;
                values.push((index, model));
            }
        }
        self.differing_ticks += 1;
        let Some(recent) = self.recent.take() else {
            return;
        };
        self.text += &self.first_difference(rst, words, &recent, &values);
        if let Some(mut waves) = self.waves.take() {
            match waves.begin(&mut self.model, &recent, |model, words| {
                for port in &self.ports[..inputs] {
                    model.drive(port.leaf, port.place.bits(words[port.place.word]));
                }
            }) {
                Ok(()) => self.waves = Some(waves),
                Err(error) => self.text += &waves.failed(&error),
            }
            for port in &self.ports[..inputs] {
                let bits = port.place.bits(words[port.place.word]);
                self.model.drive(port.leaf, bits);
            }
        }
    }

    /// Records a tick and makes its edge.
    #[inline]
    pub(super) fn pass(&mut self, rst: bool, words: &[u64]) {
        let tick = self.model.tick();
        if tick > 0 {
            // An output port moves between ticks that are compared.
            let counted = match self.ticks {
                ..2 => self.layout.input_words,
                _ => words.len(),
            };
            let pairs = words.iter().zip(&self.last).take(counted);
            for (word, (new, last)) in pairs.enumerate() {
                let mut moved = (new ^ last) & self.used[word];
                while moved != 0 {
                    let bit = moved.trailing_zeros() as usize;
                    let port = &mut self.ports[usize::from(self.of_bit[64 * word + bit])];
                    port.moves += 1;
                    moved &= !port.place.mask();
                }
            }
        }
        self.last.copy_from_slice(words);
        if let Some(recent) = &mut self.recent {
            if recent.wants_state(tick) {
                let state = self.waves.is_some().then(|| self.model.snapshot());
                recent.keep(tick, state);
            }
            recent.push(rst, words);
        }
        match rst {
            true => self.model.reset(),
            false => self.model.step(),
        }
        if self.recent.is_none() && self.waves.is_some() {
            self.end_waves(false);
        }
    }

    /// Ends the waves if they are long enough, or at once.
    #[cold]
    pub(super) fn end_waves(&mut self, at_once: bool) {
        if let Some(waves) = self
            .waves
            .take_if(|waves| at_once || waves.is_over(&self.model))
        {
            self.text += &waves.end(&mut self.model);
        }
    }
}
