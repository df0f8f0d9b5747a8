//! Times of a log, read to the last digit, and their unit.

use std::fmt;

/// Range of a log's median step, in seconds.
const STEP_S: (f64, f64) = (1e-5, 1.0);

/// Tolerance at the ends of that range.
const ROUNDING: f64 = 1e-6;

/// Units that a step may determine, with their number per second.
const UNITS: [(&str, f64); 4] = [("s", 1.0), ("ms", 1e3), ("us", 1e6), ("ns", 1e9)];

/// Time as written: large epoch offsets keep their digits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Time {
    whole: i128,
    part: f64,
}

impl Time {
    /// Parses a number; `None` if it is not finite.
    pub(super) fn read(text: &str) -> Option<Self> {
        let number = text
            .parse()
            .ok()
            .filter(|number: &f64| number.is_finite())?;
        let (digits, part) = text.split_once('.').unwrap_or((text, ""));
        let part = format!("0.{part}").parse().ok();
        // With an exponent, or more digits than a whole number holds.
        let rough = Time {
            whole: number as i128,
            part: number.fract(),
        };
        let exact = digits
            .parse()
            .ok()
            .zip(part)
            .map(|(whole, part): (_, f64)| Time {
                whole,
                part: part.copysign(number),
            });
        Some(
            exact
                .filter(|_| !text.contains(['e', 'E']))
                .unwrap_or(rough),
        )
    }

    /// Returns the time since another, in their common unit.
    pub(super) fn since(self, other: Self) -> f64 {
        self.whole.saturating_sub(other.whole) as f64 + (self.part - other.part)
    }
}

/// Source of the time unit of a log.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitFrom {
    /// [`Columns::time_unit_s`](super::Columns::time_unit_s).
    Given,
    Header,
    /// The median step between two times.
    Step,
}

/// Unit of a log's times.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// Length of the unit in seconds.
    pub seconds: f64,
    /// Source of the unit.
    pub from: UnitFrom,
}

impl Unit {
    /// Returns the name of the unit, and its number per second.
    fn named(&self) -> Option<&'static (&'static str, f64)> {
        let is = |(_, each): &&(&str, f64)| (self.seconds * each - 1.0).abs() < 1e-12;
        UNITS.iter().find(is)
    }

    /// Converts a time of this unit to seconds.
    pub(super) fn seconds_of(&self, time: f64) -> f64 {
        match self.named() {
            Some((_, each)) => time / each,
            None => time * self.seconds,
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.named() {
            Some((name, _)) => f.write_str(name),
            None => write!(f, "units of {} s", self.seconds),
        }
    }
}

/// Returns the unit in the name of a column: in brackets at its end, or as its last word, as in
/// `Time [s]`, `time_ms` and `TimeUS`.
///
/// # Errors
///
/// Returns the text in brackets if it is not a unit.
pub(super) fn unit_of(name: &str) -> Result<Option<Unit>, &str> {
    let name = name.trim();
    let unit = |word: &str| {
        let word = word.trim().to_lowercase();
        let seconds = match word.as_str() {
            "s" | "sec" | "secs" | "second" | "seconds" => 1.0,
            "ms" | "msec" | "msecs" | "milli" | "millis" => 1.0 / 1e3,
            "millisecond" | "milliseconds" => 1.0 / 1e3,
            "us" | "\u{b5}s" | "\u{3bc}s" | "usec" | "usecs" | "micro" | "micros" => 1.0 / 1e6,
            "microsecond" | "microseconds" => 1.0 / 1e6,
            "ns" | "nsec" | "nsecs" | "nano" | "nanos" => 1.0 / 1e9,
            "nanosecond" | "nanoseconds" => 1.0 / 1e9,
            "min" | "minute" | "minutes" => 60.0,
            "h" | "hour" | "hours" => 3600.0,
            _ => return None,
        };
        let from = UnitFrom::Header;
        Some(Unit { seconds, from })
    };
    for (open, close) in [('[', ']'), ('(', ')'), ('{', '}')] {
        let inner = name
            .strip_suffix(close)
            .and_then(|name| name.rsplit_once(open));
        if let Some((_, inner)) = inner {
            return unit(inner).map(Some).ok_or(inner);
        }
    }
    let chars: Vec<(usize, char)> = name.char_indices().collect();
    let mut begin = 0;
    for pair in chars.windows(2) {
        let ((_, before), (at, here)) = (pair[0], pair[1]);
        if !before.is_alphanumeric() || (before.is_lowercase() && here.is_uppercase()) {
            begin = at;
        }
    }
    Ok(unit(&name[begin..]))
}

/// Returns the unit in which the median of some steps, each above 0, is in the usual range.
///
/// # Errors
///
/// Returns the median if no unit matches or two do, and its value in each matching unit.
pub(super) fn unit_by_steps(steps: &mut [f64]) -> Result<Unit, (f64, Vec<String>)> {
    steps.sort_unstable_by(f64::total_cmp);
    let median = steps.get(steps.len() / 2).copied().unwrap_or(0.0);
    let (least, most) = STEP_S;
    let fits = |edge: f64| {
        let lies = move |(_, each): &&(&str, f64)| {
            median / each > least * (1.0 + edge) && median / each < most * (1.0 - edge)
        };
        UNITS.iter().filter(lies).collect::<Vec<_>>()
    };
    // A step at an end of the range, if no other unit has it inside.
    let mut found = fits(ROUNDING);
    if found.is_empty() {
        found = fits(-ROUNDING);
    }
    match found[..] {
        [(_, each)] => Ok(Unit {
            seconds: 1.0 / each,
            from: UnitFrom::Step,
        }),
        _ => {
            let each = |(name, _): &&(&str, f64)| format!("{median} {name}");
            Err((median, found.iter().map(each).collect()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_keep_their_digits() {
        let since = |a: &str, b: &str| Time::read(b).unwrap().since(Time::read(a).unwrap());
        assert_eq!(since("1600000000010000000", "1600000000010000001"), 1.0);
        let small = since("1600000000.010000001", "1600000000.010000002");
        assert!((small - 1e-9).abs() < 1e-17, "{small}");
        assert_eq!(since("-1.5", "-0.25"), 1.25);
        assert_eq!(since("-.5", "+.5"), 1.0);
        assert_eq!(since("1e3", "2.5E3"), 1500.0);
        for none in ["", "a", "nan", "inf", "1.2.3", "1 2"] {
            assert_eq!(Time::read(none), None, "{none}");
        }
    }

    #[test]
    fn a_header_names_its_unit() {
        for (name, seconds) in [
            ("Time [s]", 1.0),
            ("time_ms", 1e-3),
            ("t (us)", 1e-6),
            ("t [\u{b5}s]", 1e-6),
            ("timestamp_ns", 1e-9),
            ("TimeUS", 1e-6),
            ("timeMs", 1e-3),
            ("millis", 1e-3),
            ("elapsed seconds", 1.0),
            ("Time[min]", 60.0),
        ] {
            let unit = unit_of(name).unwrap().expect(name);
            assert_eq!(unit.seconds, seconds, "{name}");
        }
        for name in ["time", "t", "Status", "pos", "", "ms_since_start"] {
            assert_eq!(unit_of(name), Ok(None), "{name}");
        }
        assert_eq!(unit_of("Time [ticks]"), Err("ticks"));
    }

    #[test]
    fn the_median_step_chooses_the_unit() {
        let of = |steps: &[f64]| unit_by_steps(&mut steps.to_vec()).map(|unit| unit.to_string());
        for (step, unit) in [
            (0.005, "s"),
            (0.01, "s"),
            (1.0, "ms"),
            (5.0, "ms"),
            (10.0, "ms"),
            (1000.0, "us"),
            (5000.0, "us"),
            (1e4, "us"),
            (1e6, "ns"),
            (1e7, "ns"),
            (1e9, "ns"),
            (1e-5, "s"),
        ] {
            assert_eq!(of(&[step]).as_deref(), Ok(unit), "{step}");
        }
        let both = |a: &str, b: &str| vec![a.to_owned(), b.to_owned()];
        assert_eq!(of(&[20.0, 1e9, 1.0]), Err((20.0, both("20 ms", "20 us"))));
        assert_eq!(of(&[0.5]), Err((0.5, both("0.5 s", "0.5 ms"))));
        assert_eq!(of(&[2e4]), Err((2e4, both("20000 us", "20000 ns"))));
        assert_eq!(of(&[1e10]), Err((1e10, vec![])));
        assert_eq!(of(&[1e-6]), Err((1e-6, vec![])));
    }
}
