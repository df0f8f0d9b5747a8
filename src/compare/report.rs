use serde::Serialize;

/// Result of comparing two files.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Report {
    /// Golden file.
    pub golden: Side,
    /// Other file.
    pub other: Side,
    /// Scope of the other file that corresponds to golden's outermost scope; `None` if a map pairs
    /// all signals.
    pub scope: Option<String>,
    /// First tick compared, in golden's count.
    pub from_tick: u64,
    /// Number of ticks compared.
    pub ticks: u64,
    /// Number of ticks skipped at the beginning of the other file.
    pub skip: i64,
    /// Number of signals compared in at least one tick.
    pub signals: usize,
    /// Number of values compared: ticks times signals, without values that are unknown in the
    /// golden file.
    pub values: u64,
    /// Number of values with an x or z in the golden file; they are not compared.
    pub unknown_values: u64,
    /// Number of compared signals with more than one golden value in these ticks.
    pub moved: usize,
    /// Compared signals with a single golden value in these ticks.
    pub never_changed: Vec<String>,
    /// Output ports of the golden file.
    pub ports_out: Vec<String>,
    /// Output ports of which no value was compared.
    pub ports_out_not_compared: Vec<String>,
    /// Output ports that the settings or the map leave out.
    pub ports_out_left: Vec<String>,
    /// Input ports of golden's outermost scope without a partner.
    pub ports_in_without_partner: Vec<String>,
    /// Golden signals without a partner.
    pub without_partner: Vec<String>,
    /// Signals of the other file that are not a partner.
    pub other_without_partner: Vec<String>,
    /// Golden signals that the map leaves out.
    pub ignored: Vec<String>,
    /// Golden signals with a partner of which no value was compared: the golden values are
    /// unknown, or the map's delay leaves no common tick.
    pub without_values: Vec<String>,
    /// Signals of more than 64 bits; they are not compared.
    pub too_wide: Vec<String>,
    /// Signals whose partner has another width; they are not compared, and the files differ.
    pub different_widths: Vec<WidthDifference>,
    /// Signals that differ, ordered by the first tick of the difference.
    pub differences: Vec<Difference>,
    /// First mismatch.
    pub first: Option<Mismatch>,
}

/// Report on one of the two files.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Side {
    /// Name as given.
    pub file: String,
    /// Clock.
    pub clock: String,
    /// Number of the first tick; not 0 in a window of one of this crate's dumps.
    pub first_tick: u64,
    /// Number of ticks.
    pub ticks: u64,
    /// Number of ticks that the other file does not have.
    pub alone: u64,
    /// Number of ticks after the other file's last one.
    pub longer: u64,
    /// Number of common ticks in which the dump was switched off; they are not compared.
    pub switched_off: u64,
    /// Number of variables without bits, such as strings and reals; they are not compared.
    pub without_bits: usize,
}

/// Signal with another width in the other file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct WidthDifference {
    /// Golden signal.
    pub golden: String,
    /// Its width in bits.
    pub golden_bits: u32,
    /// Partner.
    pub other: String,
    /// Width of the partner in bits.
    pub other_bits: u32,
}

/// Signal that differs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Difference {
    /// Golden signal.
    pub golden: String,
    /// Partner.
    pub other: String,
    /// First tick of the difference.
    pub tick: u64,
    /// Number of ticks in which the signals differ.
    pub ticks: u64,
}

/// First mismatch and its surroundings.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Mismatch {
    /// Tick, in golden's count.
    pub tick: u64,
    /// Start of the tick in the golden file.
    pub golden_time: String,
    /// Start of the corresponding tick in the other file.
    pub other_time: String,
    /// Number of signals that differ in the tick.
    pub signals: usize,
    /// Golden signal.
    pub golden: String,
    /// Partner.
    pub other: String,
    /// Golden value.
    pub golden_value: String,
    /// Other value.
    pub other_value: String,
    /// Ticks shown.
    pub shown_ticks: Vec<u64>,
    /// Signals that differ, then others of the scope of the first, then registers and inputs of
    /// the scopes around it.
    pub rows: Vec<Row>,
}

/// Signal in the table around the first mismatch.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Row {
    /// Golden signal.
    pub signal: String,
    /// One cell per tick shown.
    pub cells: Vec<Cell>,
}

/// Values in a tick: hexadecimal, or binary with x and z.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Cell {
    /// Golden value.
    pub golden: String,
    /// Other value, if it differs.
    pub other: Option<String>,
}

impl Report {
    /// True if nothing differs and every output port was compared or left out by name. The lists
    /// name everything else that was not compared.
    pub fn is_equal(&self) -> bool {
        !self.differs() && self.ports_out_not_compared.is_empty()
    }

    /// True if a compared signal differs or a partner has another width.
    pub fn differs(&self) -> bool {
        !self.differences.is_empty() || !self.different_widths.is_empty()
    }

    /// True if neither file has ticks after the other's last one. A file that is cut off after a
    /// time differs from a complete one in nothing else.
    pub fn same_length(&self) -> bool {
        self.golden.longer == 0 && self.other.longer == 0
    }

    /// True if less than a tenth of the golden signals have a partner, so that the designs may be
    /// unrelated.
    pub fn hardly_pairs(&self) -> bool {
        10 * self.paired() < self.paired() + self.without_partner.len()
    }

    /// Returns the number of golden signals with a partner, compared or not.
    pub(super) fn paired(&self) -> usize {
        let not_compared = [
            self.without_values.len(),
            self.different_widths.len(),
            self.too_wide.len(),
        ];
        self.signals + not_compared.iter().sum::<usize>()
    }
}
