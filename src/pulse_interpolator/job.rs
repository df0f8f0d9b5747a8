//! A drawing through the whole interpolator: planned, compiled to a table, played by the control
//! computer, and counted at the motor drivers.

use super::step_dir::{Driver, TimingMinima};
use super::{ControlComputer, Group, StepTiming, Table, Variant};
use crate::kernel::{Observer, RunError, Sample, Simulator};
use crate::settings::{JobError, SettingError, within};
use std::ops::ControlFlow;

/// Half-period width of the group that plays a job.
const N: usize = 16;
/// Unit-time width of the group that plays a job.
const T: usize = 24;
/// Address width of the group that plays a job.
const A: usize = 12;

/// The group that plays a job of so many axes, with the default word lengths.
pub type JobGroup<const AXES: usize> = Group<AXES, N, T, A>;

/// What was seen at the drivers of a group that played a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Played {
    /// Ticks of the run, from power-on until the last pulse is over.
    pub ticks: u64,
    /// The tick in which the first unit time of the table began.
    pub begun: u64,
    /// The tick of the first step on any axis.
    pub first_step: Option<u64>,
    /// Unit times without pulses between two patterns, because the next one was not there yet.
    pub idle_units: u64,
    /// Each axis, X first.
    pub axes: Vec<PlayedAxis>,
    /// Positions at the end of every unit time of the table in steps from where the axes began,
    /// X first, unit after unit.
    pub positions: Vec<i32>,
}

/// One axis of [`Played`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlayedAxis {
    /// Steps up.
    pub pulses_up: u64,
    /// Steps down.
    pub pulses_down: u64,
    /// The shortest times on the step and direction lines.
    pub minima: TimingMinima,
}

impl PlayedAxis {
    /// Steps up less steps down.
    pub fn position(&self) -> i64 {
        self.pulses_up as i64 - self.pulses_down as i64
    }
}

/// Drivers on all axes, and where they are when a unit time ends.
struct Bench<const AXES: usize> {
    drivers: [Driver; AXES],
    positions: Vec<i32>,
    units: usize,
    begun: Option<u64>,
    first_step: Option<u64>,
    idle_units: u64,
    last_tick: u64,
}

impl<const AXES: usize> Observer<JobGroup<AXES>> for Bench<AXES> {
    fn sample(&mut self, now: &Sample<'_, JobGroup<AXES>>) -> Result<ControlFlow<()>, RunError> {
        for (axis, driver) in self.drivers.iter_mut().enumerate() {
            // The drivers ask for nothing here, so they have nothing to complain of.
            let _ = driver.sample(now.tick, now.w.step[axis].get(), now.w.dir[axis].get());
        }
        if now.w.unit_rst.get() {
            self.unit_ends(now.w.busy.get());
        }
        if self.begun.is_none() && now.w.busy.get() {
            self.begun = Some(now.tick);
        }
        if self.first_step.is_none() && now.w.step.iter().any(|step| step.get()) {
            self.first_step = Some(now.tick);
        }
        self.last_tick = now.tick;
        let over = self.positions.len() == self.units * AXES && !now.w.busy.get();
        Ok(if over {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        })
    }
}

impl<const AXES: usize> Bench<AXES> {
    fn unit_ends(&mut self, busy: bool) {
        if busy {
            let positions = self.drivers.iter().map(|driver| driver.position() as i32);
            self.positions.extend(positions);
        } else if self.begun.is_some() {
            self.idle_units += 1;
        }
    }
}

/// Plays `table` on a group of `AXES` axes, as `table` has them, seen by `observer` too.
///
/// # Errors
/// The group is not as wide as the table, or what `observer` objects to.
pub fn play<const AXES: usize>(
    group: &JobGroup<AXES>,
    table: &Table,
    observer: impl Observer<JobGroup<AXES>>,
) -> Result<Played, JobError> {
    played(table, |computer, bench| {
        let simulator = Simulator::new(group)?;
        simulator.run(u64::MAX, |_, q| computer.drive(q), (bench, observer))
    })
}

/// Does what [`play`] does, but goes over idle ticks: for an `observer` that need not see
/// them.
///
/// # Errors
/// As [`play`].
pub fn fast_forward<const AXES: usize>(
    group: &JobGroup<AXES>,
    table: &Table,
    observer: impl Observer<JobGroup<AXES>>,
) -> Result<Played, JobError> {
    played(table, |computer, bench| {
        // All that the computer looks at is whether a command waits: no counter.
        Simulator::new(group)?.fast_forward(
            u64::MAX,
            |_, q| (computer.drive(q), u64::MAX),
            (bench, observer),
        )
    })
}

/// Whether the words of a table have room in the group.
fn fits<const AXES: usize>(table: &Table) -> Result<(), SettingError> {
    let (axes, bits) = (table.axes(), table.half_period_bits());
    if axes != AXES {
        return Err(SettingError::value("axes", axes, AXES.to_string()));
    }
    // A unit time that is a few of these at most has room then.
    within("half_period_bits", bits, &(0..=N as u32))
}

/// What the drivers see of a group that is run to the end of `table`.
fn played<const AXES: usize>(
    table: &Table,
    run: impl FnOnce(
        &mut ControlComputer<'_, A>,
        &mut Bench<AXES>,
    ) -> Result<Simulator<JobGroup<AXES>>, RunError>,
) -> Result<Played, JobError> {
    fits::<AXES>(table)?;
    let mut computer = ControlComputer::<A>::new(table);
    let mut bench = Bench {
        drivers: std::array::from_fn(|_| Driver::new(StepTiming::default())),
        positions: Vec::with_capacity(table.units() * AXES),
        units: table.units(),
        begun: None,
        first_step: None,
        idle_units: 0,
        last_tick: 0,
    };
    let simulator = run(&mut computer, &mut bench)?;
    let axes = bench.drivers.iter().map(|driver| {
        let (pulses, position) = (driver.pulses() as i64, driver.position());
        PlayedAxis {
            pulses_up: ((pulses + position) / 2) as u64,
            pulses_down: ((pulses - position) / 2) as u64,
            minima: driver.minima(),
        }
    });
    Ok(Played {
        ticks: simulator.tick(),
        begun: bench.begun.unwrap_or(bench.last_tick),
        first_step: bench.first_step,
        idle_units: bench.idle_units,
        axes: axes.collect(),
        positions: bench.positions,
    })
}

/// The group for a table: its unit time at power-on is that of the first pattern.
pub fn group<const AXES: usize>(table: &Table, variant: Variant) -> JobGroup<AXES> {
    let period = table.patterns().first().map_or(1, |pattern| pattern.period);
    Group::new(variant, period.into())
}
