//! Two groups that play patterns of their memories, each with its own unit times (¶0032).

use super::Stored;
use super::job::{Drivers, Played};
use crate::circuits::pulse_interpolator::Groups;
use crate::circuits::pulse_interpolator::groups::In;
use crate::hdl::{At, zero};
use crate::sim::{Needs, Observer, RunError, Sample, Simulator, State, Watcher};
use std::ops::ControlFlow;

/// Patterns and commands of a group.
#[derive(Debug, Clone)]
pub struct Member {
    /// Memory, and commands of its control computer.
    pub stored: Stored,
    /// Tick of its first command, from 0; its pattern begins two ticks later.
    pub command_tick: u64,
}

impl Member {
    /// Returns the ticks until it is done, if there is no silent unit time between two patterns.
    #[must_use]
    pub fn ticks(&self) -> u64 {
        let played = self.stored.played.iter();
        let length: u64 = played.map(|(period, _)| u64::from(period)).sum();
        self.command_tick.saturating_add(length)
    }
}

/// Returns the circuit with the patterns of both groups in its memories.
#[must_use]
pub fn circuit(members: &[Member; 2]) -> Groups {
    let [first, second] = members.each_ref().map(|member| &member.stored.group);
    Groups {
        first_axes: first.axes,
        second_axes: second.axes,
        widths: first.widths,
        variant: first.variant,
        periods: [first.period, second.period],
        memories: [first.memories.clone(), second.memories.clone()],
    }
}

/// Watched signals of a group.
struct See {
    pending: At<bool>,
    step: Vec<At<bool>>,
    dir: Vec<At<bool>>,
    unit_rst: At<bool>,
    busy: At<bool>,
}

impl See {
    fn of(watch: &Watcher<'_, Groups>, group: usize) -> Self {
        let lines = &watch.w.lines[group];
        See {
            pending: watch.at(watch.p.groups[group].p.port.q.pending),
            step: watch.each(&lines.step),
            dir: watch.each(&lines.dir),
            unit_rst: watch.at(lines.unit_rst),
            busy: watch.at(lines.busy),
        }
    }
}

/// Drivers of both groups.
struct Bench<'o> {
    see: &'o [See; 2],
    drivers: [Drivers<'o>; 2],
    observer: &'o mut dyn Observer<Groups>,
}

impl Observer<Groups> for Bench<'_> {
    fn needs(&self) -> Needs {
        self.observer.needs()
    }

    fn sample(&mut self, now: &Sample<'_, Groups>) -> Result<ControlFlow<()>, RunError> {
        let mut over = true;
        for (see, drivers) in self.see.iter().zip(&mut self.drivers) {
            let unit = (now.get(see.unit_rst), now.get(see.busy));
            let lines = |axis: usize| (now.get(see.step[axis]), now.get(see.dir[axis]));
            over &= drivers.sample(now.tick, unit, lines);
        }
        over |= self.observer.sample(now)?.is_break();
        Ok(match over {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        })
    }
}

/// Plays both groups until the last is done; `observer` sees every tick.
///
/// # Errors
/// Returns the error of `observer`.
pub fn play(
    circuit: &Groups,
    members: &[Member; 2],
    observer: &mut dyn Observer<Groups>,
) -> Result<[Played; 2], RunError> {
    let needs = observer.needs();
    let see = |watch: &Watcher<'_, Groups>| [0, 1].map(|group| See::of(watch, group));
    let (mut simulator, see) = Simulator::watching(circuit, needs, see)?;
    let mut bench = Bench {
        see: &see,
        drivers: members
            .each_ref()
            .map(|member| Drivers::new(&member.stored.played)),
        observer,
    };
    let quiet = zero(circuit);
    let mut computers = members.each_ref().map(|member| member.stored.computer());
    let drive = |tick: u64, q: &State<'_, Groups>| {
        let given = (0..2).map(|group| {
            let due = tick >= members[group].command_tick;
            let pending = q.get(see[group].pending);
            let given = due.then(|| computers[group](pending)).flatten();
            given.unwrap_or_else(|| quiet.control[group].clone())
        });
        In {
            control: given.collect(),
        }
    };
    simulator.run(u64::MAX, drive, &mut bench)?;
    let ticks = simulator.tick();
    Ok(bench
        .drivers
        .map(|drivers| drivers.played(ticks, Vec::new())))
}
