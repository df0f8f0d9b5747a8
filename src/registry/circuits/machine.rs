//! The machine of all circuits, and what it has besides them.

use crate::circuits::machine::{CommandJoin, Enables, Machine};
use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::hdl::Image;
use crate::registry::Entry;
use crate::registry::entry::{entry, nothing};

/// Lead time of the pen lift's brake, down and up, in CKs of 0.1 ms.
const LEAD_TIMES: [u64; 2] = [250; 2];

/// They.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        Enables, "system, rates",
        full: Enables::default,
        widths: [width],
        by: "width of the counters", |width| Enables { width },
        proved: 2,
    ),
    entry!(
        CommandJoin, "system, commands",
        full: || CommandJoin { line: 32, arc: 24 },
        widths: [line, arc],
        by: "width of the lines' way; that of the arcs is a bit less",
        |line| CommandJoin { line, arc: line.saturating_sub(1) },
        proved: 3,
    ),
    entry!(
        Machine, "system",
        full: machine,
        widths: [],
        from: "nothing", |given| nothing(machine(), given),
        with: nothing,
        proved: none,
    ),
];

/// The machine as its default settings have it.
fn machine() -> Machine {
    Machine::new(Correction::default(), Image::of(4, 11, LEAD_TIMES))
}
