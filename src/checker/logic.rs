//! Edges whose ports are values of `std_logic`.

use super::{Checker, CheckerError, Place};

/// Values of `std_ulogic` in the order of their declaration.
const VALUES: &[u8; 9] = b"UX01ZWLH-";

/// Ports of a tick side by side, as values of `std_logic`.
#[derive(Debug)]
pub(super) struct LogicPorts {
    /// Input ports, then output ports, those that are left out too.
    ports: Vec<LogicPort>,
    /// Number of values, with that of the reset.
    values: usize,
    /// Words of a tick.
    words: Vec<u64>,
}

#[derive(Debug)]
struct LogicPort {
    width: usize,
    /// Index of the port in the checker and its place in the words; `None` if it is left out.
    place: Option<(usize, Place)>,
}

impl LogicPorts {
    /// Lays out ports with their widths; the second part is the place of a port that is not left
    /// out.
    pub(super) fn of(ports: impl Iterator<Item = (usize, Option<Place>)>, words: usize) -> Self {
        let mut index = 0;
        let ports = ports.map(|(width, place)| {
            let place = place.map(|place| (index, place));
            index += usize::from(place.is_some());
            LogicPort { width, place }
        });
        let ports: Vec<_> = ports.collect();
        LogicPorts {
            values: 1 + ports.iter().map(|port| port.width).sum::<usize>(),
            words: vec![0; words],
            ports,
        }
    }
}

/// Returns the bit of a value; `None` if it is neither low nor high.
fn bit(value: u8) -> Option<u64> {
    match VALUES.get(usize::from(value)) {
        Some(b'0' | b'L') => Some(0),
        Some(b'1' | b'H') => Some(1),
        _ => None,
    }
}

/// Returns the bits of a port, the highest first; unknown ones are 0. The second part is true if
/// there are unknown ones.
fn bits(values: &[u8]) -> (u64, bool) {
    values.iter().fold((0, false), |(bits, unknown), &value| {
        let bit = bit(value);
        (bits << 1 | bit.unwrap_or(0), unknown || bit.is_none())
    })
}

/// Returns values as the literals of VHDL.
fn letters(values: &[u8]) -> String {
    let letter = |value: &u8| {
        VALUES
            .get(usize::from(*value))
            .map_or('?', |&letter| letter.into())
    };
    values.iter().map(letter).collect()
}

impl Checker {
    /// Passes a rising edge, as [`edge`](Self::edge) does, with values of `std_logic` in place of
    /// words: that of the reset, then those of all input ports and of all output ports. Ports that
    /// are left out have values too. The highest bit of a port comes first. A value is a position in
    /// the type `std_ulogic`: 2 and 6 are low, 3 and 7 are high, and the others make their port
    /// [unknown](Self::unknown).
    ///
    /// ```
    /// use motion_rtl::Model;
    /// use motion_rtl::checker::{Checker, Options};
    ///
    /// let counter = Model::new("enable_counter", &["width=2".parse()?])?;
    /// let options = Options { from_power_on: true, ..Options::default() };
    /// let mut checker = Checker::new(counter, &options)?;
    /// // rst is '0', period is "10", enable is '0', then 'X'.
    /// assert!(!checker.logic_edge(&[2, 3, 2, 2])?);
    /// assert!(checker.logic_edge(&[2, 3, 2, 1])?);
    /// assert!(checker.take_text().contains("enable: design X (binary, unknown), model 1"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the number of values is not that of the ports.
    pub fn logic_edge(&mut self, values: &[u8]) -> Result<bool, CheckerError> {
        let (given, needed) = (values.len(), self.logic.values);
        let (rst, mut rest) = match values.split_at_checked(1) {
            Some(parts) if given == needed => parts,
            _ => {
                return Err(CheckerError::Values {
                    given,
                    values: needed,
                });
            }
        };
        let mut words = std::mem::take(&mut self.logic.words);
        words.fill(0);
        let (reset, unknown) = bits(rst);
        if unknown {
            self.unknown(None, &letters(rst));
        }
        for at in 0..self.logic.ports.len() {
            let port = &self.logic.ports[at];
            let (own, after) = rest.split_at(port.width);
            rest = after;
            if let Some((index, place)) = port.place {
                let (bits, unknown) = bits(own);
                words[place.word] |= bits << place.low;
                if unknown {
                    self.unknown(Some(index), &letters(own));
                }
            }
        }
        let says = self.edge(reset != 0, &words);
        self.logic.words = words;
        says
    }
}
