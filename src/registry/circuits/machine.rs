//! The machine of all circuits, and its further blocks.

use crate::circuits::lead_angle::Memory;
use crate::circuits::machine::{CommandJoin, Enables, Machine};
use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::hdl::Image;
use crate::registry::Entry;
use crate::registry::entry::entry;

/// Lead time of the pen lift's brake, down and up, in CKs of 0.1 ms.
const LEAD_TIMES: [u64; 2] = [250; 2];

/// The machine of its default settings.
fn machine() -> Machine {
    let lead_times = Image::of(4, 11, LEAD_TIMES);
    Machine::new(Correction::default(), Memory::ShiftRegister, lead_times)
}

/// The machine, what joins its commands, and what makes its enables.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        Enables, "system, rates",
        full: Enables::default(),
        small: Enables { width: 2 }, proved: true,
    ),
    entry!(
        CommandJoin, "system, commands",
        full: CommandJoin { line: 32, arc: 24 },
        small: CommandJoin { line: 3, arc: 2 }, proved: true,
    ),
    entry!(Machine, "system", full: machine(), small: machine()),
];
