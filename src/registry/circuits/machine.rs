//! The machine of all circuits, and what it has besides them.

use crate::circuits::lead_angle::Memory;
use crate::circuits::machine::{CommandJoin, Enables, Machine};
use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::hdl::Image;
use crate::registry::Entry;
use crate::registry::circuits::make::only;
use crate::registry::entry::entry;

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
        full: || machine(Memory::ShiftRegister),
        widths: [],
        from: "0 for the pen lift's positions in a shift register or 1 in a RAM", chosen,
        with: |_, given| chosen(given),
        proved: none,
    ),
];

/// The memories of the pen lift's positions.
const MEMORIES: &[Memory] = &[Memory::ShiftRegister, Memory::Ram];

/// The machine with the memory of this number.
fn chosen(given: &[u64]) -> Option<Machine> {
    only(given, MEMORIES).map(machine)
}

/// The machine of its default settings, with this history of the pen lift.
fn machine(history: Memory) -> Machine {
    let lead_times = Image::of(4, 11, LEAD_TIMES);
    Machine::new(Correction::default(), history, lead_times)
}
