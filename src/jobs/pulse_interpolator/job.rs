//! A drawing through the whole interpolator: planned, compiled to a table, played by the control
//! computer, and counted at the motor drivers.

use super::motors::{MotorReport, Motors, StepMotors};
use super::positions::{Counted, Positions};
use super::spread::Paced;
use super::step_dir::TimingMinima;
use super::{ControlComputer, Table};
use crate::circuits::pulse_interpolator::group::In;
use crate::circuits::pulse_interpolator::{Group, Variant, Widths};
use crate::hdl::{At, Observer, RunError, Sample, Simulator, State, Value, Watcher, zero};
use crate::settings::{JobError, SettingError, within};
use std::ops::ControlFlow;

/// What was seen at the drivers of a group that played a table.
#[derive(Debug, Clone, PartialEq)]
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
    /// Positions at the end of every unit time of the table.
    pub positions: Positions,
    /// What became of the motors, if there were some.
    pub motors: Vec<MotorReport>,
}

/// One axis of [`Played`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlayedAxis {
    /// Steps up.
    pub pulses_up: u64,
    /// Steps down.
    pub pulses_down: u64,
    /// The shortest times on the step and direction lines.
    pub minima: TimingMinima,
    /// Largest distance of a pulse from where an even motion through its unit time has it, in ticks.
    pub jitter: f64,
}

impl PlayedAxis {
    /// Steps up less steps down.
    pub fn position(&self) -> i64 {
        self.pulses_up as i64 - self.pulses_down as i64
    }
}

/// What is looked at.
struct See {
    pending: At<bool>,
    step: Vec<At<bool>>,
    dir: Vec<At<bool>>,
    unit_rst: At<bool>,
    busy: At<bool>,
}

/// Drivers on all axes of a group, and where they are when a unit time ends.
pub(super) struct Drivers<'o> {
    counted: Counted<'o>,
    axes: Vec<Paced>,
    /// The first tick of the unit time under way.
    unit_begun: u64,
    units: usize,
    begun: Option<u64>,
    first_step: Option<u64>,
    idle_units: u64,
    last_tick: u64,
}

/// A group that plays a table.
struct Bench<'o> {
    drivers: Drivers<'o>,
    see: See,
    observer: &'o mut dyn Observer<Group>,
    /// The run ends in pieces: with every tick in which a command can be taken.
    pieces: bool,
    /// The table is played, or the observer has stopped.
    over: bool,
}

impl Observer<Group> for Bench<'_> {
    fn needs_all(&self) -> bool {
        self.observer.needs_all()
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
    /// Drivers that see `table` played.
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

    /// Sees a tick; true once the table is played.
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

    /// What they saw in a run of so many ticks.
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

    /// The unit time of the table that is under way.
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

/// What gives a group its ports in, where a command waits at its port or not; none where all stay
/// low until one is taken.
pub type Computer<'c> = dyn FnMut(bool) -> Option<In<Value>> + 'c;

/// Plays `table` on a group, seen by `observer` too.
///
/// # Errors
/// The group has not the axes of the table, or what `observer` objects to.
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

/// The same with another computer, that has the group play what stands in `table`.
///
/// # Errors
/// As [`play`].
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

/// The same with step motors on the drivers, which stand in the waves beside the group
/// ([`StepMotors`]).
///
/// # Errors
/// As [`play`].
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
                // What the bench says of going on is in it.
                let ((), _) = simulator.step_watched(i, &mut *bench, |_| ())?;
                let positions = bench.drivers.axes.iter().map(|axis| axis.driver.position());
                motors.step(bench.drivers.unit(), positions);
            }
            Ok(motors.report())
        },
    )
}

/// Does what [`play`] does, but goes over idle ticks: for an `observer` that need not see
/// them.
///
/// # Errors
/// As [`play`].
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

/// The same with another computer, as [`play_by`].
///
/// # Errors
/// As [`play`].
pub fn fast_forward_by(
    group: &Group,
    table: &Table,
    computer: &mut Computer<'_>,
    observer: &mut dyn Observer<Group>,
) -> Result<Played, JobError> {
    // With T = 1 RST stands, and a unit time ends without an edge to stop at.
    if table.patterns().iter().any(|pattern| pattern.period == 1) {
        return play_by(group, table, computer, observer);
    }
    played(group, table, (observer, None), |simulator, bench| {
        let (pending, quiet) = (bench.see.pending, zero(group));
        bench.pieces = true;
        while !bench.over {
            // All that the computer looks at is whether a command waits: no counter.
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

/// Whether the words of a table have room in the group.
fn fits(group: &Group, table: &Table) -> Result<(), SettingError> {
    let (axes, bits) = (table.axes(), table.half_period_bits());
    if axes != group.axes {
        return Err(SettingError::value("axes", axes, group.axes.to_string()));
    }
    // A unit time that is a few of these at most has room then.
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

/// What the drivers see of a group that is run to the end of `table`, and what `run` says of motors.
fn played(
    group: &Group,
    table: &Table,
    (observer, beside): (&mut dyn Observer<Group>, Option<StepMotors>),
    run: impl FnOnce(&mut Simulator<Group>, &mut Bench<'_>) -> Result<Vec<MotorReport>, RunError>,
) -> Result<Played, JobError> {
    fits(group, table)?;
    let all = observer.needs_all();
    let (mut simulator, see) = match beside {
        None => Simulator::watching(group, all, See::of),
        Some(motors) => Simulator::watching_beside(group, &motors, all, See::of),
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

/// The group for a table: its axes, the default word lengths, the unit time of the first pattern at
/// power-on.
pub fn group(table: &Table, variant: Variant) -> Group {
    let period = table.patterns().first().map_or(1, |pattern| pattern.period);
    Group::new(table.axes(), Widths::default(), variant, period.into())
}
