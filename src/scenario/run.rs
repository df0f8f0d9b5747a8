//! Keys that the scenarios of all circuits share.

use super::{Program, Runnable};
use crate::settings::{Key, Table, read_keys, settings, unknown};
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;
use std::path::PathBuf;

settings! {
    /// Circuit, input and waves of a scenario.
    pub struct Run {
        /// Circuit that runs; it decides which other keys there are.
        pub circuit [required]: Runnable = Runnable::PulseInterpolator;
        /// Drawing, part program or position log; in a scenario file relative to that file.
        pub input: Option<PathBuf> = None;
        /// Zeros and reference points of a part program, and its subroutines.
        pub program: Program = Program::default();
        /// Also runs the systems with which the circuit is compared, as `run --beside` does.
        pub beside: bool = false;
        /// Most ticks in the waves, unless `--from` and `--to` ask for others.
        pub vcd_ticks: u64 = 1_000_000, in 1..=i64::MAX as u64;
    }
}

/// Settings of one circuit.
pub trait Settings: Table {
    /// The circuit.
    const CIRCUIT: Runnable;
    /// Keys of [`Run`] that do not apply to it.
    const WITHOUT: &'static [&'static str];
}

/// A scenario of a circuit: the keys that all have, and its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Keys<S> {
    /// Keys that all circuits share.
    pub run: Run,
    /// Settings of the circuit.
    pub settings: S,
}

impl<S: Settings> Keys<S> {
    /// All keys, in the order of the documentation.
    #[must_use]
    pub fn all() -> Vec<&'static Key> {
        let applies = |key: &&Key| !S::WITHOUT.contains(&key.name);
        let run = Run::KEYS.iter().copied().flatten().filter(applies);
        run.chain(S::KEYS.iter().copied().flatten()).collect()
    }
}

impl<'de, S: Settings> Deserialize<'de> for Keys<S> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_map(Root(PhantomData))
    }
}

/// Joins names: `a, b and c`.
fn list(names: &[&str]) -> String {
    match names {
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        names => names.concat(),
    }
}

struct Root<S>(PhantomData<S>);

impl<'de, S: Settings> Visitor<'de> for Root<S> {
    type Value = Keys<S>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a table of keys and values")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Keys<S>, A::Error> {
        let mut scenario = Keys {
            run: Run::initial(),
            settings: S::initial(),
        };
        let keys = Keys::<S>::all();
        let unknown = |key: &str| {
            let name = S::CIRCUIT.name();
            let problem = match &S::CIRCUIT.others_with(key)[..] {
                [] => "unknown key".to_owned(),
                others => format!("is not a key of {name}, but of {}", list(others)),
            };
            let names = keys.iter().map(|key| key.name);
            unknown(
                key,
                names,
                &problem,
                &format!("`motion-rtl keys {name}` lists all"),
            )
        };
        read_keys(&mut map, &keys, &unknown, |key, map| {
            match S::KEYS.iter().copied().flatten().any(|own| own.name == key) {
                true => scenario.settings.set(key, map),
                false => scenario.run.set(key, map),
            }
        })?;
        Ok(scenario)
    }
}
