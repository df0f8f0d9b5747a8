//! Run of a drawing through the whole interpolator: planned, compiled to a table, played by the
//! control computer, and counted at the motor drivers.

use super::motors::{MotorReport, Motors, StepMotors};
use super::positions::{Counted, Positions};
use super::spread::Paced;
use super::step_dir::TimingMinima;
use super::{ControlComputer, Table};
use crate::circuits::pulse_interpolator::group::In;
use crate::circuits::pulse_interpolator::{Group, Variant, Widths};
use crate::hdl::{At, Value, zero};
use crate::jobs::JobError;
use crate::settings::{SettingError, within};
use crate::sim::{Needs, Observer, RunError, Sample, Simulator, State, Watcher};
use std::ops::ControlFlow;

/// Result at the drivers of a group that played a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Played {
    /// Ticks of the run, from power-on until the end of the last pulse.
    pub ticks: u64,
    /// Tick in which the first unit time of the table began.
    pub begun: u64,
    /// Tick of the first step on any axis.
    pub first_step: Option<u64>,
    /// Number of unit times without pulses between two patterns, because the next one was not
    /// ready.
    pub idle_units: u64,
    /// Results of the axes, X first.
    pub axes: Vec<PlayedAxis>,
    /// Positions at the end of every unit time of the table.
    pub positions: Positions,
    /// Reports of the motors, if there were any.
    pub motors: Vec<MotorReport>,
}

/// Result of one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlayedAxis {
    /// Number of steps up.
    pub pulses_up: u64,
    /// Number of steps down.
    pub pulses_down: u64,
    /// Least times on the step and direction lines.
    pub minima: TimingMinima,
    /// Greatest distance in ticks of a pulse from its time in uniform motion through its unit
    /// time.
    pub jitter: f64,
}

impl PlayedAxis {
    /// Returns the steps up minus the steps down.
    pub fn position(&self) -> i64 {
        self.pulses_up as i64 - self.pulses_down as i64
    }
}

/// Observed signals.
struct See {
    pending: At<bool>,
    step: Vec<At<bool>>,
    dir: Vec<At<bool>>,
    unit_rst: At<bool>,
    busy: At<bool>,
}

/// Drivers on all axes of a group, and their positions at the end of each unit time.
pub(super) struct Drivers<'o> {
    counted: Counted<'o>,
    axes: Vec<Paced>,
    /// First tick of the current unit time.
    unit_begun: u64,
    units: usize,
    begun: Option<u64>,
    first_step: Option<u64>,
    idle_units: u64,
    last_tick: u64,
}

/// Group that plays a table.
struct Bench<'o> {
    drivers: Drivers<'o>,
    see: See,
    observer: &'o mut dyn Observer<Group>,
    /// True if the run ends in pieces: in every tick in which a command can be taken.
    pieces: bool,
    /// True if the table has been played, or the observer has stopped.
    over: bool,
}

impl Observer<Group> for Bench<'_> {
    fn needs(&self) -> Needs {
        self.observer.needs()
    }

    fn sample(&mut self, now: &Sample<'_, Group>) -> Result<ControlFlow<()>, RunError> {
        let see = &self.see;
        let (rst, busy) = (now.get(see.unit_rst), now.get(see.busy));
        let taken = rst && self.pieces && now.get(see.pending);
        let lines = |axis: usize| (now.get(see.step[axis]), now.get(see.dir[axis]));
        self.over = self.drivers.sample(now.tick, (rst, busy), lines);
        self.over |= self.observer.sample(now)?.is_break();
        Ok(if self.over || taken {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        })
    }
}

impl<'o> Drivers<'o> {
    /// Creates drivers that observe `table` being played.
    pub(super) fn new(table: &'o Table) -> Self {
        Drivers {
            axes: vec![Paced::default(); table.axes()],
            unit_begun: 0,
            counted: Counted::new(table),
            units: table.units(),
            begun: None,
            first_step: None,
            idle_units: 0,
            last_tick: 0,
        }
    }

    /// Observes a tick; returns true once the table has been played.
    pub(super) fn sample(
        &mut self,
        tick: u64,
        (rst, busy): (bool, bool),
        lines: impl Fn(usize) -> (bool, bool),
    ) -> bool {
        for (axis, paced) in self.axes.iter_mut().enumerate() {
            let (step, dir) = lines(axis);
            paced.sample(tick, step, dir);
            if step && self.first_step.is_none() {
                self.first_step = Some(tick);
            }
        }
        if rst {
            self.unit_ends(busy, tick + 1);
        }
        if self.begun.is_none() && busy {
            self.begun = Some(tick);
        }
        self.last_tick = tick;
        self.counted.positions.units == self.units && !busy
    }

    /// Returns the result of a run of `ticks` ticks.
    pub(super) fn played(self, ticks: u64, motors: Vec<MotorReport>) -> Played {
        let axes = self.axes.iter().map(|Paced { driver, spread }| {
            let (pulses, position) = (driver.pulses() as i64, driver.position());
            PlayedAxis {
                pulses_up: ((pulses + position) / 2) as u64,
                pulses_down: ((pulses - position) / 2) as u64,
                minima: driver.minima(),
                jitter: spread.jitter(),
            }
        });
        Played {
            ticks,
            begun: self.begun.unwrap_or(self.last_tick),
            first_step: self.first_step,
            idle_units: self.idle_units,
            axes: axes.collect(),
            positions: self.counted.positions,
            motors,
        }
    }

    /// Returns the current unit time of the table.
    fn unit(&self) -> usize {
        let ended = self.counted.positions.units;
        ended.min(self.units.saturating_sub(1))
    }

    fn unit_ends(&mut self, busy: bool, end: u64) {
        for axis in &mut self.axes {
            axis.spread.unit_ends(self.unit_begun, end);
        }
        self.unit_begun = end;
        if busy {
            let positions = self.axes.iter().map(|axis| axis.driver.position());
            self.counted.unit(positions);
        } else if self.begun.is_some() && self.counted.positions.units < self.units {
            self.idle_units += 1;
        }
    }
}

/// Function that returns the inputs of a group, given if a command waits at its port; `None` if
/// all stay low until one is taken.
pub type Computer<'c> = dyn FnMut(bool) -> Option<In<Value>> + 'c;

/// Plays `table` on a group; `observer` sees it too.
///
/// # Errors
/// Returns an error if the group has other axes than the table, or the error of `observer`.
pub fn play(
    group: &Group,
    table: &Table,
    observer: &mut dyn Observer<Group>,
) -> Result<Played, JobError> {
    let mut computer = ControlComputer::new(group, table);
    play_by(
        group,
        table,
        &mut |pending| computer.drive(pending),
        observer,
    )
}

/// Plays as [`play`] does, with another computer that makes the group play the contents of
/// `table`.
///
/// # Errors
/// Returns the errors of [`play`].
pub fn play_by(
    group: &Group,
    table: &Table,
    computer: &mut Computer<'_>,
    observer: &mut dyn Observer<Group>,
) -> Result<Played, JobError> {
    played(group, table, (observer, None), |simulator, bench| {
        let (pending, quiet) = (bench.see.pending, zero(group));
        let drive = |_, q: &State<'_, Group>| {
            let given = computer(q.get(pending));
            given.unwrap_or_else(|| quiet.clone())
        };
        simulator.run(u64::MAX, drive, bench)?;
        Ok(Vec::new())
    })
}

/// Plays as [`play_by`] does, with step motors on the drivers, which are beside the group in
/// the waves ([`StepMotors`]).
///
/// # Errors
/// Returns the errors of [`play`].
pub fn play_motors(
    group: &Group,
    table: &Table,
    computer: &mut Computer<'_>,
    mut motors: Motors,
    observer: &mut dyn Observer<Group>,
) -> Result<Played, JobError> {
    let beside = StepMotors { axes: group.axes };
    played(
        group,
        table,
        (observer, Some(beside)),
        |simulator, bench| {
            let (pending, quiet) = (bench.see.pending, zero(group));
            while !bench.over {
                let given = computer(simulator.state(|q| q.get(pending)));
                if bench.observer.looks(simulator.tick()) {
                    simulator.show::<StepMotors>(&motors.signals())?;
                }
                let i = given.as_ref().unwrap_or(&quiet);
                // The bench's decision to continue is part of it.
                let ((), _) = simulator.step_watched(i, &mut *bench, |_| ())?;
                let positions = bench.drivers.axes.iter().map(|axis| axis.driver.position());
                motors.step(bench.drivers.unit(), positions);
            }
            Ok(motors.report())
        },
    )
}

/// Plays as [`play`] does, but jumps over idle ticks, for an `observer` that need not see them.
///
/// # Errors
/// Returns the errors of [`play`].
pub fn fast_forward(
    group: &Group,
    table: &Table,
    observer: &mut dyn Observer<Group>,
) -> Result<Played, JobError> {
    let mut computer = ControlComputer::new(group, table);
    fast_forward_by(
        group,
        table,
        &mut |pending| computer.drive(pending),
        observer,
    )
}

/// Plays as [`fast_forward`] does, with another computer as in [`play_by`].
///
/// # Errors
/// Returns the errors of [`play`].
pub fn fast_forward_by(
    group: &Group,
    table: &Table,
    computer: &mut Computer<'_>,
    observer: &mut dyn Observer<Group>,
) -> Result<Played, JobError> {
    // With T = 1 RST is constant, and a unit time ends without an edge to stop at.
    if table.patterns().iter().any(|pattern| pattern.period == 1) {
        return play_by(group, table, computer, observer);
    }
    played(group, table, (observer, None), |simulator, bench| {
        let (pending, quiet) = (bench.see.pending, zero(group));
        bench.pieces = true;
        while !bench.over {
            // The computer depends only on a waiting command: it has no counter.
            let drive = |simulator: &mut Simulator<Group>| {
                let given = computer(simulator.state(|q| q.get(pending)));
                simulator.apply(given.as_ref().unwrap_or(&quiet))?;
                Ok(if given.is_some() { 1 } else { u64::MAX })
            };
            simulator.fast_forward(u64::MAX, drive, &mut *bench)?;
        }
        Ok(Vec::new())
    })
}

/// Returns an error if the words of a table do not fit in the group.
fn fits(group: &Group, table: &Table) -> Result<(), SettingError> {
    let (axes, bits) = (table.axes(), table.half_period_bits());
    if axes != group.axes {
        return Err(SettingError::value("axes", axes, group.axes.to_string()));
    }
    // A unit time of at most a few of these fits then.
    within(
        "half_period_bits",
        bits,
        &(0..=group.widths.half_period as u32),
    )
}

impl See {
    fn of(watch: &Watcher<'_, Group>) -> Self {
        See {
            pending: watch.at(watch.p.port.q.pending),
            step: watch.each(&watch.w.step),
            dir: watch.each(&watch.w.dir),
            unit_rst: watch.at(watch.w.unit_rst),
            busy: watch.at(watch.w.busy),
        }
    }
}

/// Returns the result of a group that runs to the end of `table`, with the motor reports of `run`.
fn played(
    group: &Group,
    table: &Table,
    (observer, beside): (&mut dyn Observer<Group>, Option<StepMotors>),
    run: impl FnOnce(&mut Simulator<Group>, &mut Bench<'_>) -> Result<Vec<MotorReport>, RunError>,
) -> Result<Played, JobError> {
    fits(group, table)?;
    let needs = observer.needs();
    let (mut simulator, see) = match beside {
        None => Simulator::watching(group, needs, See::of),
        Some(motors) => Simulator::watching_beside(group, &motors, needs, See::of),
    }?;
    let mut bench = Bench {
        drivers: Drivers::new(table),
        see,
        observer,
        pieces: false,
        over: false,
    };
    let motors = run(&mut simulator, &mut bench)?;
    Ok(bench.drivers.played(simulator.tick(), motors))
}

/// Returns the group for a table: its axes, the default word lengths, the unit time of the first
/// pattern at power-on.
pub fn group(table: &Table, variant: Variant) -> Group {
    let period = table.patterns().first().map_or(1, |pattern| pattern.period);
    Group::new(table.axes(), Widths::default(), variant, period.into())
}
