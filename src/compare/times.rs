//! Times of a file with their units.

use super::wave::Wave;

/// Units from the coarsest, and their size in femtoseconds.
const UNITS: [(&str, u128); 6] = [
    ("s", 1_000_000_000_000_000),
    ("ms", 1_000_000_000_000),
    ("us", 1_000_000_000),
    ("ns", 1_000_000),
    ("ps", 1_000),
    ("fs", 1),
];

/// Formats times of two files in the coarsest unit in which both are whole.
pub(super) fn times(one: (&Wave, u64), two: (&Wave, u64)) -> (String, String) {
    let both = one.0.femtoseconds(one.1).zip(two.0.femtoseconds(two.1));
    let Some((a, b)) = both else {
        return (one.0.time(one.1), two.0.time(two.1));
    };
    let whole = |unit: &(&str, u128)| a % unit.1 == 0 && b % unit.1 == 0;
    let (unit, size) = UNITS.into_iter().find(whole).unwrap_or(("fs", 1));
    (
        format!("{} {unit}", a / size),
        format!("{} {unit}", b / size),
    )
}

impl Wave {
    /// Returns a time of the file in femtoseconds.
    fn femtoseconds(&self, time: u64) -> Option<u128> {
        let (factor, unit) = self.unit?;
        let (_, size) = UNITS.into_iter().find(|one| one.0 == unit)?;
        Some(u128::from(time) * u128::from(factor) * size)
    }

    /// Formats a time of the file with its unit.
    pub fn time(&self, time: u64) -> String {
        match self.unit {
            Some((factor, unit)) => format!("{} {unit}", u128::from(time) * u128::from(factor)),
            None => time.to_string(),
        }
    }
}

pub(super) fn unit(scale: wellen::Timescale) -> Option<(u32, &'static str)> {
    use wellen::TimescaleUnit as Unit;
    let name = match scale.unit {
        Unit::Seconds => "s",
        Unit::MilliSeconds => "ms",
        Unit::MicroSeconds => "us",
        Unit::NanoSeconds => "ns",
        Unit::PicoSeconds => "ps",
        Unit::FemtoSeconds => "fs",
        _ => return None,
    };
    Some((scale.factor, name))
}
