use super::Random;
use crate::engine::Engine;
use crate::hdl::{Circuit, Value, pack::inputs};
use crate::netlist::{self, Shape};

/// Greatest number of binary digits of the ticks in a stretch, in which a port keeps one way of
/// changing. Longer stretches move single counters further, but give fewer combinations of ports.
const STRETCH: u64 = 10;
/// Greatest number of binary digits of the gap before the first tick of reset. Each gap has one
/// more, up to `LONG_GAP`.
const SHORT_GAP: u64 = 6;
const LONG_GAP: u64 = 16;
/// Slowest pace: a port changes about once in 2^`PACE` ticks.
const PACE: u64 = 11;

/// Random inputs that exercise circuits of any width; they depend on the seed only, not on the
/// machine.
///
/// Bits that are uniformly random in every tick are a poor stimulus: a wide comparison never
/// matches, a strobe is never rare, and nothing ever holds. So every port goes through stretches
/// of random length, each with a *kind* of values (small, of any magnitude, powers of two, close
/// to the greatest, uniformly random) and a *pace* at which they change, from every tick to never.
/// A single bit has stretches of rare pulses, frequent pulses, rare gaps, and constant levels.
/// Lengths and paces are of every order of magnitude.
///
/// ```
/// use motion_rtl::check::Stimulus;
/// use motion_rtl::circuits::blocks::EnableCounter;
///
/// let mut stimulus = Stimulus::new(1);
/// let counter = EnableCounter { width: 24 };
/// let periods: Vec<u64> = (0..10_000).map(|_| stimulus.inputs(&counter).period).collect();
/// assert!(periods.iter().any(|period| *period < 8));
/// assert!(periods.iter().any(|period| *period > 1 << 20));
/// ```
#[derive(Debug, Clone)]
pub struct Stimulus {
    random: Random,
    courses: Vec<Course>,
    /// Source of the reset ticks; it is separate, so that asking for them changes no input.
    resets: Random,
    /// Ticks left before the next reset.
    gap: u64,
    /// Greatest number of binary digits of the gap after that.
    longest: u64,
}

impl Stimulus {
    /// Creates the stimulus of a seed.
    pub fn new(seed: u64) -> Self {
        let mut resets = Random::new(!seed);
        Stimulus {
            random: Random::new(seed),
            courses: Vec::new(),
            gap: magnitude(&mut resets, SHORT_GAP),
            longest: SHORT_GAP,
            resets,
        }
    }

    /// Creates the stimulus of a seed for input ports of these shapes. The words of a port stay
    /// within a number of binary digits that is random and at most its width; signed words have
    /// both signs.
    pub(super) fn bounded(seed: u64, ports: impl Iterator<Item = Shape>) -> Self {
        let mut stimulus = Self::new(seed);
        let Stimulus {
            random, courses, ..
        } = &mut stimulus;
        courses.extend(ports.map(|shape| Course {
            digits: Some(1 + random.word() as usize % shape.width),
            is_signed: shape.kind == netlist::Kind::Signed,
            ..Course::default()
        }));
        stimulus
    }

    /// Returns the inputs of the next tick. Use one stimulus for one circuit.
    pub fn inputs<C: Circuit>(&mut self, circuit: &C) -> C::In<Value> {
        let mut ports = self.ports();
        inputs(circuit, |shape| ports.port(shape.width))
    }

    /// Sets the input ports of an engine for the next tick.
    pub fn apply(&mut self, engine: &mut Engine) {
        let mut ports = self.ports();
        for port in 0..engine.flat().inputs.len() {
            let width = engine.flat().inputs[port];
            engine.drive(port, ports.port(width.into()));
        }
    }

    /// Returns the inputs of the next tick, port by port.
    pub(super) fn ports(&mut self) -> Ports<'_> {
        Ports {
            stimulus: self,
            next: 0,
        }
    }

    /// Returns true if the next tick is a reset. Some are among the first hundreds; later ones
    /// come after gaps of every order of magnitude. Call it once per tick, or never.
    pub fn reset(&mut self) -> bool {
        match self.gap.checked_sub(1) {
            Some(left) => {
                self.gap = left;
                false
            }
            None => {
                self.longest = (self.longest + 1).min(LONG_GAP);
                self.gap = magnitude(&mut self.resets, self.longest);
                true
            }
        }
    }
}

/// Walk that gives each port its value.
pub(super) struct Ports<'a> {
    stimulus: &'a mut Stimulus,
    next: usize,
}

impl Ports<'_> {
    /// Returns the value of the next port, of `width` bits.
    pub(super) fn port(&mut self, width: usize) -> u64 {
        let Stimulus {
            random, courses, ..
        } = &mut *self.stimulus;
        if self.next == courses.len() {
            courses.push(Course::default());
        }
        let value = courses[self.next].tick(random, width);
        self.next += 1;
        value
    }
}

/// Current behaviour of one port.
#[derive(Debug, Clone, Copy, Default)]
struct Course {
    /// Ticks left in this stretch.
    left: u64,
    kind: Kind,
    /// Logarithm of the average number of ticks between changes.
    pace: u64,
    value: u64,
    /// Greatest number of binary digits of a word; the port's width by default.
    digits: Option<usize>,
    /// True if words have both signs.
    is_signed: bool,
}

/// Kind of values in a stretch.
#[derive(Debug, Clone, Copy, Default)]
enum Kind {
    /// Below 8.
    #[default]
    Small,
    /// Any order of magnitude.
    Magnitude,
    /// One bit high.
    Power,
    /// At most 7 below the greatest, read as unsigned or as two's complement.
    Top,
    /// Uniformly random.
    Even,
    /// This level, and the other one in single ticks: pulses or gaps of a bit.
    Pulses(u64),
}

impl Course {
    fn tick(&mut self, random: &mut Random, width: usize) -> u64 {
        match self.left.checked_sub(1) {
            Some(left) => self.left = left,
            None => self.begin(random, width),
        }
        let due = random.word() >> (64 - PACE) < 1 << (PACE - self.pace);
        match self.kind {
            Kind::Pulses(level) => self.value = level ^ u64::from(due),
            kind if due => self.value = self.word(random, kind, width),
            _ => {}
        }
        self.value
    }

    fn word(&self, random: &mut Random, kind: Kind, width: usize) -> u64 {
        let value = kind.value(random, self.digits.unwrap_or(width));
        match self.is_signed && random.word() & 1 == 1 {
            true => value.wrapping_neg() & u64::MAX >> (64 - width),
            false => value,
        }
    }

    /// Begins a new stretch. The value stays until it changes.
    fn begin(&mut self, random: &mut Random, width: usize) {
        self.left = magnitude(random, STRETCH);
        self.pace = random.word() % (PACE + 1);
        self.kind = match (width, random.word() % 16) {
            (1, 0..=3) => Kind::Even,
            (1, choice) => Kind::Pulses(choice & 1),
            (_, 0..=4) => Kind::Small,
            (_, 5..=11) => Kind::Magnitude,
            (_, 12..=13) => Kind::Power,
            (_, 14) => Kind::Top,
            _ => Kind::Even,
        };
    }
}

impl Kind {
    fn value(self, random: &mut Random, width: usize) -> u64 {
        let width = width as u64;
        let greatest = u64::MAX >> (64 - width);
        let word = random.word();
        let value = match self {
            Kind::Small => word >> 61,
            // Twice, so that small values are more frequent: a large period stops a whole circuit.
            Kind::Magnitude => {
                let most = 1 + random.word() % width;
                magnitude(random, most)
            }
            Kind::Power => 1 << (word % width),
            Kind::Top => (greatest >> (word & 1)).wrapping_sub(word >> 61),
            Kind::Even | Kind::Pulses(_) => word,
        };
        value & greatest
    }
}

/// Returns a number of up to `digits` binary digits; every number of digits is equally likely.
pub(super) fn magnitude(random: &mut Random, digits: u64) -> u64 {
    let digits = 1 + random.word() % digits;
    random.word() >> (64 - digits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    const TICKS: usize = 100_000;

    fn words(width: usize, seed: u64) -> Vec<u64> {
        let mut stimulus = Stimulus::new(seed);
        (0..TICKS).map(|_| stimulus.ports().port(width)).collect()
    }

    #[test]
    fn the_same_seed_gives_the_same_inputs() {
        assert_eq!(words(24, 1), words(24, 1));
        assert_ne!(words(24, 1), words(24, 2));
    }

    #[test]
    fn wide_words_are_small_and_large_and_hold() {
        for width in [words(24, 5), words(64, 5), words(2, 5)] {
            let holds = width.windows(2).filter(|pair| pair[0] == pair[1]).count();
            assert!(holds > TICKS / 4 && holds < TICKS, "{holds} holds");
        }
        let words = words(24, 5);
        let small = words.iter().filter(|&&word| word < 8).count();
        let large = words.iter().filter(|&&word| word >= 1 << 20).count();
        assert!(small > TICKS / 10 && large > TICKS / 10, "{small} {large}");
        let powers = words.iter().filter(|word| word.is_power_of_two()).count();
        assert!(powers > TICKS / 20, "{powers}");
        assert!(words.contains(&0xff_ffff));
    }

    #[test]
    fn a_bit_has_rare_and_frequent_pulses_and_rare_gaps() {
        let bits = words(1, 11);
        let mut lengths = [[0; 2]; 18];
        for run in bits.chunk_by(|a, b| a == b) {
            lengths[run.len().ilog2() as usize][run[0] as usize] += 1;
        }
        for level in [0, 1] {
            for (digits, length) in lengths.iter().enumerate().take(10) {
                assert!(length[level] > 3, "{lengths:?}: {digits}");
            }
        }
    }

    #[test]
    fn signed_words_are_of_both_signs() {
        let words = words(12, 5);
        for end in [-2048i64, 2047, -1, 0] {
            assert!(words.contains(&(end as u64 & 0xfff)), "{end}");
        }
    }

    fn bounded(seed: u64, kind: netlist::Kind) -> Vec<u64> {
        let shape = Shape { kind, width: 24 };
        let mut stimulus = Stimulus::bounded(seed, [shape].into_iter());
        let words = (0..1000).map(|_| stimulus.ports().port(shape.width));
        words.collect()
    }

    #[test]
    fn bounds_are_of_every_magnitude() {
        let greatest = |seed| {
            let words = bounded(seed, netlist::Kind::Unsigned);
            words.into_iter().max().unwrap_or(0)
        };
        let digits: BTreeSet<_> = (0..200)
            .filter_map(|seed| greatest(seed).checked_ilog2())
            .collect();
        assert_eq!(digits, (0..24).collect());
        // Each run has a bound of its own.
        let short = (0..200).filter(|seed| greatest(*seed) < 1 << 8).count();
        assert!((50..150).contains(&short), "{short}");
    }

    #[test]
    fn bounded_words_have_both_signs_if_they_are_signed() {
        let count = |words: &[u64]| words.iter().filter(|word| **word >> 23 == 1).count();
        let runs = (0..40).map(|seed| bounded(seed, netlist::Kind::Signed));
        let runs: Vec<_> = runs
            .filter(|words| (100..900).contains(&count(words)))
            .collect();
        assert!(runs.len() > 20, "{}", runs.len());
        let is_short = |word: &u64| (*word).min((1 << 24) - word) < 1 << 8;
        let short = runs.iter().filter(|words| words.iter().all(is_short));
        assert!(short.count() > 5);
        let unsigned = (0..40).flat_map(|seed| bounded(seed, netlist::Kind::Unsigned));
        let short: Vec<u64> = unsigned.filter(|word| *word < 1 << 23).collect();
        assert!(short.len() > 35_000);
    }

    #[test]
    fn resets_are_rare_and_at_times_close() {
        let mut stimulus = Stimulus::new(4);
        let resets: Vec<_> = (0..1_000_000).filter(|_| stimulus.reset()).collect();
        assert!((50..1000).contains(&resets.len()), "{}", resets.len());
        assert!(resets.windows(2).any(|pair| pair[1] - pair[0] < 8));
        assert!(resets.windows(2).any(|pair| pair[1] - pair[0] > 50_000));
    }
}
