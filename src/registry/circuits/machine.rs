//! The machine of all circuits, and what it has besides them.

use crate::jobs::machine::{Settings, job};
use crate::machine::{CommandJoin, Enables, Machine};
use crate::registry::Entry;
use crate::registry::entry::{Made, alone, at_width, entry, proved_at};

/// They.
pub const CIRCUITS: &[Entry] = &[
    entry!(
        Enables,
        Enables::default(),
        Some(2),
        "system, rates",
        ["W" = 24],
        "width of the counters",
        proved_at!([2]; [4 8], |W| Enables::<W>::default())
    ),
    entry!(
        CommandJoin<32, 24>,
        CommandJoin,
        Some(3),
        "system, commands",
        ["W" = 32, "V" = 24],
        "width of the lines' way; that of the arcs is a bit less",
        proved_at!([3]; [4 8], |W| CommandJoin::<W, { W - 1 }>)
    ),
    entry!(
        Machine,
        job::machine(&Settings::default()).circuit,
        None,
        "system",
        [],
        "nothing",
        Made {
            make: |_given| None,
            model: |given| {
                let machine = job::machine(&Settings::default()).circuit;
                Some(Box::new(alone(given, machine)?))
            },
            offered: &[],
        }
    ),
];
