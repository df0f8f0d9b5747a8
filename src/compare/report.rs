use serde::Serialize;

/// What comparing two files came to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Report {
    /// The golden file.
    pub golden: Side,
    /// The other file.
    pub other: Side,
    /// The scope of the other file that stands for golden's outermost scope; none where a map
    /// pairs all signals.
    pub scope: Option<String>,
    /// The first tick compared, in golden's count.
    pub from_tick: u64,
    /// Ticks compared.
    pub ticks: u64,
    /// Ticks left out at the beginning of the other file.
    pub skip: i64,
    /// Signals compared, in at least one tick.
    pub signals: usize,
    /// Values compared: ticks by signals, without those that are unknown in the golden file.
    pub values: u64,
    /// Values with an x or z in the golden file. They are not compared.
    pub unknown_values: u64,
    /// Compared signals that have more than one value in the golden file in these ticks.
    pub moved: usize,
    /// Compared signals that have one value in the golden file in all of these ticks.
    pub never_changed: Vec<String>,
    /// Ports out of the golden file.
    pub ports_out: Vec<String>,
    /// Ports out of which no value was compared.
    pub ports_out_not_compared: Vec<String>,
    /// Ports out that the settings or the map leave out.
    pub ports_out_left: Vec<String>,
    /// Ports in of golden's outermost scope without a partner.
    pub ports_in_without_partner: Vec<String>,
    /// Golden signals without a partner.
    pub without_partner: Vec<String>,
    /// Signals of the other file that are no partner.
    pub other_without_partner: Vec<String>,
    /// Golden signals that the map leaves out.
    pub ignored: Vec<String>,
    /// Golden signals with a partner of which no value was compared: the golden values are unknown,
    /// or the map's delay leaves no common tick.
    pub without_values: Vec<String>,
    /// Signals of more than 64 bits. They are not compared.
    pub too_wide: Vec<String>,
    /// Signals whose partner has another width. They are not compared, and the files differ.
    pub different_widths: Vec<WidthDifference>,
    /// The signals that differ, by the first tick in which they do.
    pub differences: Vec<Difference>,
    /// Where the files differ first.
    pub first: Option<Mismatch>,
}

/// One of the two files.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Side {
    /// Its name as given.
    pub file: String,
    /// Its clock.
    pub clock: String,
    /// The number of its first tick: not 0 in a window of one of this crate's dumps.
    pub first_tick: u64,
    /// Its ticks.
    pub ticks: u64,
    /// Ticks of it that the other file does not have.
    pub alone: u64,
    /// Those of them that are behind the other file's last tick.
    pub longer: u64,
    /// Common ticks in which its dump was switched off. They are not compared.
    pub switched_off: u64,
    /// Variables without bits, such as strings and reals. They are not compared.
    pub without_bits: usize,
}

/// A signal that has another width in the other file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct WidthDifference {
    /// The golden signal.
    pub golden: String,
    /// Its width.
    pub golden_bits: u32,
    /// Its partner.
    pub other: String,
    /// The partner's width.
    pub other_bits: u32,
}

/// A signal that differs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Difference {
    /// The golden signal.
    pub golden: String,
    /// Its partner.
    pub other: String,
    /// The first tick in which it differs.
    pub tick: u64,
    /// In how many ticks it differs.
    pub ticks: u64,
}

/// The first mismatch, and what surrounds it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Mismatch {
    /// The tick, in golden's count.
    pub tick: u64,
    /// When it begins in the golden file.
    pub golden_time: String,
    /// When the tick it was held against begins in the other file.
    pub other_time: String,
    /// How many signals differ in it.
    pub signals: usize,
    /// The golden signal.
    pub golden: String,
    /// Its partner.
    pub other: String,
    /// The golden value.
    pub golden_value: String,
    /// The other value.
    pub other_value: String,
    /// The ticks shown.
    pub shown_ticks: Vec<u64>,
    /// The signals that differ, then others of the scope of the first, then registers and inputs of
    /// the scopes around it.
    pub rows: Vec<Row>,
}

/// A signal around the first mismatch.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Row {
    /// The golden signal.
    pub signal: String,
    /// A cell for each tick shown.
    pub cells: Vec<Cell>,
}

/// The values of a tick: hexadecimal, or binary with x and z.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Cell {
    /// The golden value.
    pub golden: String,
    /// The other value, where it differs.
    pub other: Option<String>,
}

impl Report {
    /// True if nothing differs and every port out was compared or left out by its name. What else
    /// was not compared stands in the lists.
    pub fn is_equal(&self) -> bool {
        !self.differs() && self.ports_out_not_compared.is_empty()
    }

    /// True if a compared signal differs or a partner has another width.
    pub fn differs(&self) -> bool {
        !self.differences.is_empty() || !self.different_widths.is_empty()
    }

    /// True if neither file has ticks behind the other's last one. A file that is cut off behind a
    /// time differs from a whole one in nothing else.
    pub fn same_length(&self) -> bool {
        self.golden.longer == 0 && self.other.longer == 0
    }

    /// True if hardly any golden signal has a partner, so that two designs may have been compared
    /// that have nothing to do with each other.
    pub fn hardly_pairs(&self) -> bool {
        10 * self.paired() < self.paired() + self.without_partner.len()
    }

    /// How many golden signals have a partner, compared or not.
    pub(super) fn paired(&self) -> usize {
        let not_compared = [
            self.without_values.len(),
            self.different_widths.len(),
            self.too_wide.len(),
        ];
        self.signals + not_compared.iter().sum::<usize>()
    }
}
