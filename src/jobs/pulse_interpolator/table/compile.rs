//! Compiler from a drawing to a table.

use super::count_table::{CountTable, PulseLimits, choose_half_period};
use super::demand::{AXES, Demand, Demands};
use super::error::TableError;
use super::following;
use super::remedy;
use super::report::{AxisReport, FollowingError, Report};
use super::settings::Settings;
use super::words::{MAX_UNITS, Table, Word};
use crate::input::{COORDINATES, Drawing};
use crate::plan::Plan;

/// Compiles a drawing into the words of the interpolator's memory, with a report.
///
/// The demand of a unit time is the rounded position at its end minus the steps emitted so far.
/// The unit takes the nearest count that it offers, and the rest is carried. An axis never steps
/// against its own motion in a unit: if it is ahead, it waits. The remainder at the end of the
/// path goes into appended units, so that the pulses always add up to the rounded end.
///
/// A unit has the unit time of the kind of move, line or arc, in which it begins. A direction
/// changes only with pulses, at the start of their unit. If the pulses of the unit before come too
/// late for the driver's hold time, they are moved forward; if that is impossible, the axis idles
/// for one unit. The direction before the first unit is positive.
///
/// # Errors
///
/// Returns a [`TableError`] if a setting or the drawing is out of range, a position does not fit
/// 32 bits, or the path is too long for a table.
pub fn compile(drawing: &Drawing, settings: &Settings) -> Result<(Table, Report), TableError> {
    let (table, mut report) = compile_unfollowed(drawing, settings)?;
    let plan = Plan::new(drawing, &settings.motion)?;
    let errors = following::of_table(&plan, settings, &table)?;
    for (axis, error) in report.axes.iter_mut().zip(errors) {
        axis.following_error = error;
    }
    Ok((table, report))
}

/// Compiles as [`compile`] does, but leaves the following errors at 0, for a table whose run is
/// [followed](super::follow).
///
/// # Errors
/// Returns the errors of [`compile`].
pub fn compile_unfollowed(
    drawing: &Drawing,
    settings: &Settings,
) -> Result<(Table, Report), TableError> {
    settings.validate()?;
    let plan = Plan::new(drawing, &settings.motion)?;
    let (table, mut report) = compile_plan(&plan, settings)?;
    report.undriven = undriven(drawing, settings.steps_per_mm.len());
    if report.unattainable_units > 0 {
        report.remedy = remedy::find(&plan, settings)?;
    }
    Ok((table, report))
}

/// Compiles as [`compile`] does from valid settings, without following errors, and without
/// searching a remedy.
pub(super) fn compile_plan(
    plan: &Plan<'_>,
    settings: &Settings,
) -> Result<(Table, Report), TableError> {
    let units = units_needed(plan, settings);
    if units > MAX_UNITS as f64 {
        return Err(TableError::TooLong {
            units,
            most: MAX_UNITS,
        });
    }
    let mut demands = Demands::new(plan, settings);
    let start = demands.at(0)?;
    let mut compiler = Compiler::new(settings, &start);
    let (line, arc) = (
        Kind::new(settings, settings.line_unit_ticks),
        Kind::new(settings, settings.arc_unit_ticks),
    );
    let mut kind = &line;
    let mut here = start;
    while !demands.ended(compiler.ticks) {
        kind = if here.arc { &arc } else { &line };
        let next = demands.at(compiler.ticks + u64::from(kind.counts.period()))?;
        compiler.unit(kind, &here, &next, false)?;
        here = next;
    }
    let path_units = compiler.table.units();
    while !compiler.arrived(&here) {
        compiler.unit(kind, &here, &here, true)?;
    }
    Ok(compiler.finish(&start, &here, path_units))
}

/// Returns about how many unit times the path takes, if all were of the shorter kind.
pub(super) fn units_needed(plan: &Plan<'_>, settings: &Settings) -> f64 {
    let period = settings.line_unit_ticks.min(settings.arc_unit_ticks);
    (plan.duration_s() * settings.clock_hz as f64 / f64::from(period)).ceil()
}

/// Returns the coordinates that change although no axis drives them.
fn undriven(drawing: &Drawing, axes: usize) -> Vec<&'static str> {
    (axes..COORDINATES)
        .filter(|&k| drawing.moves.iter().any(|m| m.to[k] != drawing.start[k]))
        .map(|k| AXES[k])
        .collect()
}

/// Counts offered by one unit time.
struct Kind {
    /// Counts if the direction stays.
    counts: CountTable,
    /// Counts if the direction changes with the unit.
    turning: CountTable,
}

impl Kind {
    fn new(settings: &Settings, period: u32) -> Self {
        let limits = settings.pulse_limits();
        let lead = settings.timing.dir_setup_ticks;
        Self {
            counts: CountTable::new(period, &limits),
            turning: CountTable::new(period, &PulseLimits { lead, ..limits }),
        }
    }
}

/// State of one axis.
struct Axis {
    position: i64,
    negative: bool,
    last_pulses: Option<LastPulses>,
    report: AxisReport,
}

/// Last unit in which an axis had pulses.
#[derive(Clone, Copy)]
struct LastPulses {
    unit: usize,
    period: u32,
    pulses: u32,
    /// Setup time that its first edge had to keep.
    lead: u32,
}

struct Compiler<'s> {
    settings: &'s Settings,
    table: Table,
    axes: Vec<Axis>,
    ticks: u64,
    unattainable_units: usize,
}

impl<'s> Compiler<'s> {
    fn new(settings: &'s Settings, start: &Demand) -> Self {
        let axes = settings.steps_per_mm.len();
        let axis = |k| Axis {
            position: start.rounded(k),
            negative: false,
            last_pulses: None,
            report: AxisReport {
                start_position: start.rounded(k) as i32,
                end_position: start.rounded(k) as i32,
                steps_demanded: 0,
                pulses_forward: 0,
                pulses_backward: 0,
                unattainable_units: 0,
                following_error: FollowingError::default(),
            },
        };
        Self {
            settings,
            table: Table::new(settings.clock_hz, axes, settings.half_period_bits),
            axes: (0..axes).map(axis).collect(),
            ticks: 0,
            unattainable_units: 0,
        }
    }

    fn arrived(&self, end: &Demand) -> bool {
        self.axes
            .iter()
            .enumerate()
            .all(|(k, axis)| axis.position == end.rounded(k))
    }

    /// Compiles one unit time, from the demand `here` to the demand `next`. Appended units never
    /// overshoot.
    fn unit(
        &mut self,
        kind: &Kind,
        here: &Demand,
        next: &Demand,
        appended: bool,
    ) -> Result<(), TableError> {
        let period = kind.counts.period();
        let unit = self.table.units();
        self.table.open_unit(period)?;
        self.ticks += u64::from(period);
        let mut attainable = true;
        for k in 0..self.axes.len() {
            let own = (next.rounded(k) - here.rounded(k)).unsigned_abs();
            if !kind.counts.contains(own as u32) {
                self.axes[k].report.unattainable_units += 1;
                attainable = false;
            }
            let wanted = next.rounded(k) - self.axes[k].position;
            let motion = (next.steps[k] - here.steps[k]).signum().to_num::<i64>();
            let word = if motion * wanted < 0 {
                self.idle(k)
            } else {
                self.step(k, unit, kind, wanted, appended)
            };
            self.table.push(word);
        }
        self.unattainable_units += usize::from(!attainable);
        Ok(())
    }

    fn idle(&self, k: usize) -> Word {
        Word::new(0, self.axes[k].negative)
    }

    /// Steps axis `k` by `wanted` steps, as far as this unit allows.
    fn step(&mut self, k: usize, unit: usize, kind: &Kind, wanted: i64, appended: bool) -> Word {
        let axis = &self.axes[k];
        let negative = if wanted == 0 {
            axis.negative
        } else {
            wanted < 0
        };
        let turning = negative != axis.negative;
        let counts = if turning { &kind.turning } else { &kind.counts };
        let demand = u32::try_from(wanted.unsigned_abs()).unwrap_or(u32::MAX);
        let from = axis.position;
        let moved = |pulses: u32| from + signed(pulses, negative);
        let mut offer = counts.nearest(demand);
        if appended || i32::try_from(moved(offer.pulses)).is_err() {
            offer = counts.at_most(demand);
        }
        if offer.pulses == 0 || (turning && !self.make_room(k, unit)) {
            return self.idle(k);
        }
        let position = moved(offer.pulses);
        let axis = &mut self.axes[k];
        axis.position = position;
        axis.negative = negative;
        axis.last_pulses = Some(LastPulses {
            unit,
            period: counts.period(),
            pulses: offer.pulses,
            lead: if turning {
                self.settings.timing.dir_setup_ticks
            } else {
                0
            },
        });
        let total = if negative {
            &mut axis.report.pulses_backward
        } else {
            &mut axis.report.pulses_forward
        };
        *total += u64::from(offer.pulses);
        Word::new(offer.half_period, negative)
    }

    /// Makes the pulses of the unit before keep the hold time, so that the direction can change
    /// with `unit`; returns true if that is possible. An idle unit between is always long enough.
    fn make_room(&mut self, k: usize, unit: usize) -> bool {
        let axis = &self.axes[k];
        let Some(last) = axis.last_pulses.filter(|last| last.unit + 1 == unit) else {
            return true;
        };
        let limits = PulseLimits {
            lead: last.lead,
            tail: self.settings.timing.dir_hold_ticks,
            ..self.settings.pulse_limits()
        };
        let Some(half_period) = choose_half_period(last.pulses, last.period, &limits) else {
            return false;
        };
        let place = last.unit * self.axes.len() + k;
        let word = Word::new(half_period, axis.negative);
        self.table.words.set(place, word);
        true
    }

    fn finish(self, start: &Demand, end: &Demand, path_units: usize) -> (Table, Report) {
        let axis = |(k, axis): (usize, Axis)| AxisReport {
            end_position: axis.position as i32,
            steps_demanded: end.rounded(k) - start.rounded(k),
            ..axis.report
        };
        let report = Report {
            axes: self.axes.into_iter().enumerate().map(axis).collect(),
            undriven: Vec::new(),
            units: self.table.units(),
            appended_units: self.table.units() - path_units,
            unattainable_units: self.unattainable_units,
            remedy: None,
            total_ticks: self.ticks,
        };
        (self.table, report)
    }
}

fn signed(pulses: u32, negative: bool) -> i64 {
    if negative {
        -i64::from(pulses)
    } else {
        i64::from(pulses)
    }
}
