//! Whole records for the input ports of circuits that take them.

use super::Random;
use super::stimulus::magnitude;
use crate::engine::Engine;
use crate::hdl::Declarations;
use crate::netlist::Role;
use std::collections::BTreeMap;

/// Number of words in a record of a path.
const RECORD_WORDS: u64 = crate::path::record::WORDS as u64;
/// Greatest number of records in an episode, and of segments in a path.
const MOST: u64 = 4;
/// Number of records in an episode that fills the memory.
const MANY: u64 = 20;
/// Shortest episode with records in ticks, and greatest number of binary digits of the ticks
/// added.
const PLAYED: (u64, u64) = (1 << 11, 10);
/// Greatest number of binary digits of an episode without records, in ticks.
const FREE: u64 = 9;
/// Ticks from the last word of a record to the start of the path.
const START: u64 = 2;
/// Ticks from one line, or one start of the steps, to the next.
const AGAIN: u64 = 512;
/// Number of steps that are written before they are started.
const STEPS: u64 = 4;

/// Controls that end, hold or replace the current motion.
const LOW: [&str; 7] = [
    "halt", "hold", "restart", "clear", "given", "passing", "common",
];

/// Records, targets and steps that are written whole and started, in place of the random words of
/// a [`Stimulus`](super::Stimulus).
///
/// Independent random ports rarely write the 32 words of a record and then start it, so most of a
/// path generator never moves. Here two kinds of episodes alternate. In a long one, ports that
/// belong together are driven together: the words of a few records and of the path, and the start;
/// targets with a speed; steps, and an encoder that turns. Controls that stop a motion are mostly
/// low, and periods are short. Every fourth long episode gives more records than fit. In a short
/// episode every port is random. Ports are recognised by their names in a scope.
#[derive(Debug)]
pub(super) struct Records {
    random: Random,
    scopes: Vec<Scope>,
    encoders: Vec<Encoder>,
    playing: bool,
    /// Ticks left in the episode.
    left: u64,
    /// Ticks of the episode so far.
    age: u64,
    /// Number of records in this episode.
    count: u64,
    /// Number of episodes with records so far.
    episodes: u64,
    /// True if more records are given than fit, and the path has no end.
    flood: bool,
    /// Kind and modulus of the current record.
    kind: u64,
    modulus: u64,
    /// Ports with a constant word in this episode, and their words.
    held: Vec<(usize, u64)>,
}

/// Input ports of one scope, by name.
#[derive(Debug, Default)]
struct Scope {
    ports: BTreeMap<String, Port>,
}

#[derive(Debug, Clone, Copy)]
struct Port {
    /// Index among the input ports.
    place: usize,
    width: u64,
}

/// Encoder with two channels in quadrature.
#[derive(Debug)]
struct Encoder {
    channels: [usize; 2],
    position: u64,
    back: bool,
    /// Ticks left in this direction.
    left: u64,
}

impl Records {
    /// Returns the records of a circuit with parts and `inputs` input ports, or `None` if it takes
    /// none.
    pub(super) fn of(declarations: &Declarations, inputs: usize, seed: u64) -> Option<Self> {
        let (own, others) = declarations.leaves.split_at(inputs);
        let has_parts = others.iter().any(|leaf| leaf.role == Role::Input);
        let mut scopes: BTreeMap<&[String], Scope> = BTreeMap::new();
        for (place, leaf) in own.iter().enumerate() {
            let width = leaf.shape.width as u64;
            let scope = scopes.entry(&leaf.scopes).or_default();
            scope.ports.insert(leaf.name.clone(), Port { place, width });
        }
        let scopes: Vec<_> = scopes.into_values().collect();
        let takes = scopes.iter().any(|scope| {
            scope.has(&["write_word", "push", "start"])
                || scope.has(&["push", "target_x", "speed"])
                || scope.has(&["write_target", "run", "step_target"])
        });
        let encoders = scopes.iter().flat_map(Scope::encoders).collect();
        (has_parts && takes).then(|| Records {
            random: Random::new(seed.rotate_left(32)),
            scopes,
            encoders,
            playing: false,
            left: 0,
            age: 0,
            count: 0,
            episodes: 0,
            flood: false,
            kind: 0,
            modulus: 1,
            held: Vec::new(),
        })
    }

    /// Restarts after a reset.
    pub(super) fn restart(&mut self) {
        self.playing = false;
        self.left = 0;
    }

    /// Sets the ports of this tick.
    pub(super) fn apply(&mut self, engine: &mut Engine) {
        if self.left == 0 {
            self.begin();
        }
        self.left -= 1;
        if self.playing {
            for (place, word) in &self.held {
                engine.drive(*place, *word);
            }
            for encoder in &mut self.encoders {
                encoder.tick(&mut self.random, engine);
            }
            for scope in 0..self.scopes.len() {
                self.write(scope, engine);
            }
        }
        self.age += 1;
    }

    /// Begins an episode of the other kind.
    fn begin(&mut self) {
        self.playing = !self.playing;
        self.age = 0;
        self.held.clear();
        if !self.playing {
            self.left = magnitude(&mut self.random, FREE).max(1);
            return;
        }
        self.left = PLAYED.0 + magnitude(&mut self.random, PLAYED.1);
        self.episodes += 1;
        self.flood = self.episodes.is_multiple_of(4);
        self.count = match self.flood {
            true => MANY,
            false => 1 + self.random.word() % MOST,
        };
        for scope in &self.scopes {
            for (name, port) in &scope.ports {
                let word = standing(name, self.count, self.flood, &mut self.random);
                self.held
                    .extend(word.map(|word| (port.place, word & port.mask())));
            }
        }
    }

    /// Writes the words of a scope that belong together.
    fn write(&mut self, scope: usize, engine: &mut Engine) {
        let scope = &self.scopes[scope];
        let (age, random) = (self.age, &mut self.random);
        let mut set = |name: &str, word: u64| {
            if let Some(port) = scope.ports.get(name) {
                engine.drive(port.place, word & port.mask());
            }
        };
        let width = |name: &str| scope.ports.get(name).map_or(1, |port| port.width);
        if scope.has(&["write_word", "push", "start"]) {
            // A motion left from the episode before is ended first.
            set("halt", u64::from(age == 0));
            let at = age
                .checked_sub(1)
                .filter(|at| *at < self.count * RECORD_WORDS);
            let word = at.map_or(0, |at| at % RECORD_WORDS);
            if at.is_some() && word == 0 {
                self.kind = random.word() % 3;
                self.modulus = 1 + magnitude(random, 12);
            }
            let is_last = !self.flood && at.is_some_and(|at| at / RECORD_WORDS + 1 == self.count);
            set("write", u64::from(at.is_some()));
            set("write_word", word);
            let bits = width("write_data");
            set(
                "write_data",
                record_word((word, is_last), (self.kind, self.modulus), bits, random),
            );
            set("push", u64::from(at.is_some() && word == RECORD_WORDS - 1));
            let start = self.count.min(MOST) * RECORD_WORDS + START;
            set("start", u64::from(age == start));
        }
        if scope.has(&["write_path", "path_address", "begin_segment"]) {
            let words = 1 << width("path_address").saturating_sub(width("begin_segment"));
            let writes = age < self.count * words;
            set("write_path", u64::from(writes));
            set("path_address", age);
            let data = match random.word() % 2 {
                0 => signed(random, width("path_data") / 2),
                _ => random.word(),
            };
            set("path_data", data);
            set("write_begin", u64::from(writes && age % words == 0));
            set("begin_segment", age / words);
            set("begin_length", (age / words) << (width("begin_length") / 2));
        }
        if scope.has(&["push", "target_x", "speed"]) {
            let again = if self.flood { START + 1 } else { AGAIN };
            set("push", u64::from(age % again == START));
            for (target, end) in [("target_x", 0), ("target_y", 1)] {
                // Greatest possible distance: from the wrong side of 0 that is refused.
                let far = (1 << (width(target) - 1)) - end;
                let near = signed(random, 9);
                let is_far = self.flood && age == START;
                set(target, if is_far { far } else { near });
            }
            // Counts per scan, with as many fraction bits as a time has.
            let speed = (1 + magnitude(random, 7)) << width("acceleration_time");
            set("speed", speed);
            set("halt", u64::from(age == 0));
            set("clear", u64::from(age == 1));
            set("acceleration_time", 1 + random.word() % 7);
            set("deceleration_time", 1 + random.word() % 7);
        }
        if scope.has(&["write_target", "run", "step_target"]) {
            set("write_target", u64::from(age < STEPS));
            set("write_step", age);
            set("step_target", signed(random, 6));
            set("step_speed", 1 + magnitude(random, 4));
            set("run", u64::from(age % AGAIN == STEPS));
        }
    }
}

impl Scope {
    fn has(&self, names: &[&str]) -> bool {
        names.iter().all(|name| self.ports.contains_key(*name))
    }

    /// Returns the encoders: channels `a` and `b`, or `a_x` and `b_x`.
    fn encoders(&self) -> impl Iterator<Item = Encoder> {
        let of = |name: &str| self.ports.get(name).filter(|port| port.width == 1);
        let pairs = ["", "_x", "_y", "_z"].map(|axis| {
            let channels = [
                of(&format!("a{axis}"))?.place,
                of(&format!("b{axis}"))?.place,
            ];
            Some(Encoder {
                channels,
                position: 0,
                back: false,
                left: 0,
            })
        });
        pairs.into_iter().flatten()
    }
}

impl Port {
    fn mask(self) -> u64 {
        u64::MAX >> (64 - self.width)
    }
}

impl Encoder {
    /// Turns by one count in a quarter of the ticks, at random.
    fn tick(&mut self, random: &mut Random, engine: &mut Engine) {
        if self.left == 0 {
            self.left = 64 + magnitude(random, 9);
            self.back = random.word() & 1 == 1;
        }
        self.left -= 1;
        if random.word() & 3 == 0 {
            let by = if self.back { u64::MAX } else { 1 };
            self.position = self.position.wrapping_add(by);
        }
        let gray = self.position ^ self.position >> 1;
        let [a, b] = self.channels;
        engine.drive(a, gray >> 1 & 1);
        engine.drive(b, gray & 1);
    }
}

/// Returns the constant word of a port in an episode of `count` records; with `flood` the sampling
/// times are too short too.
fn standing(name: &str, count: u64, flood: bool, random: &mut Random) -> Option<u64> {
    let is_low = LOW.contains(&name) && !random.word().is_multiple_of(8);
    Some(match name {
        _ if is_low => 0,
        "learn" => 1,
        "last" => count - 1,
        "last_step" => STEPS - 1,
        "standstill" | "rest" => 1 + random.word() % 3,
        "time_out" => 2 + magnitude(random, 6),
        "ck_period" => 2 + random.word() % 4,
        "scan_period" | "unit_period" => 72 + magnitude(random, 6),
        "period" | "sample_period" if flood => 8 + magnitude(random, 6),
        "period" | "sample_period" => 320 + magnitude(random, 8),
        _ => return None,
    })
}

/// Returns a word of a record of this kind and modulus; [`record`](crate::path::record) has the
/// format.
fn record_word(
    (word, is_last): (u64, bool),
    (kind, modulus): (u64, u64),
    width: u64,
    random: &mut Random,
) -> u64 {
    match word {
        0 => kind | u64::from(is_last) << 2 | (2 + random.word() % 8) << 3,
        1 => modulus,
        // Points, then the matrix of an arc, or integer and fractional parts of differences.
        2..8 => signed(random, width.saturating_sub(4).max(1)),
        _ if kind == 2 => random.word(),
        _ if word % 2 == 1 => random.word() % modulus,
        _ => signed(random, width.saturating_sub(6).max(1)),
    }
}

/// Returns a word of either sign with up to `digits` binary digits.
fn signed(random: &mut Random, digits: u64) -> u64 {
    let word = magnitude(random, digits);
    if random.word() & 1 == 1 {
        word.wrapping_neg()
    } else {
        word
    }
}
