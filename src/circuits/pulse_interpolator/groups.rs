//! Two groups on one reference clock, each with a unit-time counter of its own (¶0032).
//!
//! ```text
//!                    ┌────────┐
//!  for_first… ──────▶│        ├──▶ of_first.step_x, …, ready, busy, unit_rst
//!                    │ groups │
//!  for_second… ─────▶│        ├──▶ of_second.step_x, …, ready, busy, unit_rst
//!                    └────────┘
//! ```
//!
//! Departures: the text does not say when a second group begins. Here a command that an idle group
//! accepts ends that group's unit time in the next tick, so its pattern begins two ticks after the
//! command. Groups that get commands in the same tick start together; one that gets its command
//! later starts later. A group that plays continues to its own RST.

use super::group::{self, In as Control, Net as Lines};
use super::pattern_memory::Contents;
use super::{Group, Variant, Widths};
use crate::prelude::*;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

/// Names of the groups.
const GROUPS: [&str; 2] = ["first", "second"];

/// Two groups with words of the same widths.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Groups {
    /// Axes of the first group.
    pub first_axes: usize,
    /// Axes of the second group.
    pub second_axes: usize,
    /// Word widths of both groups.
    pub widths: Widths,
    /// Variant of RST.
    pub variant: Variant,
    /// Unit time of each group at power-on, in ticks.
    #[serde(deserialize_with = "both")]
    pub periods: [u64; 2],
    /// Contents of each group's pattern memories at power-on, axis by axis.
    #[serde(deserialize_with = "both")]
    pub memories: [Vec<Contents>; 2],
}

/// Reads a list of two; an array by itself would drop what is behind.
fn both<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<[T; 2], D::Error> {
    let values: Vec<T> = Vec::deserialize(from)?;
    let count = values.len();
    values
        .try_into()
        .map_err(|_| D::Error::invalid_length(count, &"a list of two"))
}

impl Groups {
    /// Returns the first group (0) or the second (1).
    #[must_use]
    pub fn group(&self, number: usize) -> Group {
        let axes = [self.first_axes, self.second_axes][number];
        let group = Group::new(axes, self.widths, self.variant, self.periods[number]);
        let memories = self.memories[number].clone();
        Group { memories, ..group }
    }
}

signals! { for Groups as c;
    /// Input ports.
    pub struct In {
        /// Ports from the control computer 2, group by group.
        pub control: [Control(&c.group(k)); k in 2] as Elements(&["for_first", "for_second"]),
    }
    /// Flip-flops.
    pub struct Reg {
        /// The idle group has accepted a command: its unit time ends in this tick.
        starting: [Bit; 2] as Elements(&["first_starting", "second_starting"]) = 0,
    }
    /// The circuits inside.
    pub struct Parts {
        /// The groups.
        pub groups: [Part<Group>(c.group(k)); k in 2] as Elements(&GROUPS),
    }
    /// Output ports.
    pub struct Net {
        /// Output ports of each group.
        pub lines: [Lines(&c.group(k)); k in 2] as Elements(&["of_first", "of_second"]),
    }
}

impl Circuit for Groups {
    const NAME: &'static str = "pulse_interpolator_groups";
    const ABOUT: &'static str = "two groups of axes, each with a unit time of its own";
    records!(In, Reg, Net, Parts);

    fn tick(&self, i: In, q: Reg, p: Parts) -> (Net, Reg<Edge>) {
        let groups = settle_each(p.groups, |k| group::In {
            unit_end: i.control[k].unit_end | q.starting[k],
            ..i.control[k].clone()
        });
        // If no command waits and no pattern runs, none is taken in this tick: the group is idle
        // in the next.
        let accepts = |k: usize| groups[k].w.ready & !groups[k].w.busy;
        let next = Reg {
            starting: (0..2).map(|k| i.control[k].command & accepts(k)).collect(),
        };
        let lines = groups.iter().map(|group| group.w.clone()).collect();
        (Net { lines }, next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::LastTicks;

    /// A word of half-period 3 in the memory of one axis.
    fn memory(widths: Widths) -> Vec<Contents> {
        let mut contents = Contents::new(widths.half_period, widths.address);
        contents.half_periods.set(0, 3);
        vec![contents]
    }

    /// Ticks of the RST of each group and the first tick in which it plays, where each gets a command at
    /// a tick for a pattern of one word that loops, of T = 10 and T = 7.
    fn begun(commands: [u64; 2]) -> [(Option<u64>, Vec<u64>); 2] {
        let widths = Widths::default();
        let circuit = Groups {
            first_axes: 1,
            second_axes: 1,
            widths,
            variant: Variant::Safe,
            periods: [9, 5],
            memories: [memory(widths), memory(widths)],
        };
        let mut simulator = LastTicks::simulator(&circuit).unwrap();
        let mut found = [(None, Vec::new()), (None, Vec::new())];
        for tick in 0..80 {
            for (k, found) in found.iter_mut().enumerate() {
                // A refused command, and one while the first plays, must not end a unit time.
                let given = [0, 1, 15].map(|later| commands[k] + later);
                let given = given.contains(&tick);
                simulator.set(|i| i.control[k].command, given).unwrap();
                simulator.set(|i| i.control[k].run, given).unwrap();
                simulator.set(|i| i.control[k].cyclic, given).unwrap();
                simulator.set(|i| i.control[k].period, [10, 7][k]).unwrap();
                if simulator.see(|s| s.w.lines[k].busy) {
                    found.0.get_or_insert(tick);
                }
                if simulator.see(|s| s.w.lines[k].unit_rst) {
                    found.1.push(tick);
                }
            }
            simulator.step();
        }
        found
    }

    #[test]
    fn an_idle_group_begins_two_ticks_after_its_command_and_keeps_its_unit_time() {
        for first in 0..20 {
            for second in 0..20 {
                let found = begun([first, second]);
                for ((begun, resets), (command, period)) in
                    found.iter().zip([(first, 10), (second, 7)])
                {
                    assert_eq!(*begun, Some(command + 2), "{first}, {second}");
                    let resets = resets.iter().filter(|reset| **reset > command + 1);
                    let due = (1..).map(|unit| command + 1 + unit * period);
                    assert!(resets.copied().eq(due.take_while(|reset| *reset < 80)));
                }
            }
        }
    }
}
