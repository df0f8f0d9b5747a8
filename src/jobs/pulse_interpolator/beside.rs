//! Program of a table on the conventional device of Fig. 5, for comparison with the interpolator.
//!
//! Its computer 7 gives a move for every unit time, since their amounts differ: the rounded
//! distance that the path moves in it. A unit time is limited to the number of steps that the
//! driver's shortest pulse allows; the rest comes with the next. Alternatively it gives each line
//! and arc as one [move](super::moves).

use super::job::{fast_forward, group};
use super::motors::{Motors, StepMotors};
use super::spread::Paced;
use super::step_dir::TimingMinima;
use super::table::{StepTiming, Table, UnitDemand};
use crate::circuits::pulse_interpolator::circular_interpolator::ArcMove;
use crate::circuits::pulse_interpolator::motor_controller::{ConventionalWidths, Move};
use crate::circuits::pulse_interpolator::{Conventional, Variant, conventional};
use crate::hdl::{At, Value, zero};
use crate::input::COORDINATES;
use crate::jobs::JobError;
use crate::sim::{Observer, RunError, Sample, Simulator, Watcher};

/// Move of the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Order {
    /// Steps of each axis, X first; 0 for axes that are not driven, and on an arc.
    pub delta: [i64; COORDINATES],
    /// Number of unit times.
    pub units: u32,
    /// Unit time T in ticks.
    pub period: u32,
    /// Parameters of an arc in X and Y; `None` for a line.
    pub arc: Option<Arc>,
}

/// Parameters of an arc, as words of [`ArcMove`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Arc {
    pub radius: u64,
    /// Start angle.
    pub angle: u64,
    /// Rotation per unit time.
    pub turn: u64,
}

/// Returns the moves that bring the axes to a path's positions at the end of every unit time, for
/// a driver with `timing`.
#[must_use]
pub fn orders(demands: &[UnitDemand], timing: &StepTiming) -> Vec<Order> {
    let greatest = (1 << ConventionalWidths::default().distance) - 1;
    let pulse = 2 * i64::from(timing.step_high_ticks.max(timing.step_low_ticks).max(1));
    let Some(last) = demands.last() else {
        return Vec::new();
    };
    let mut given = [0; COORDINATES];
    let mut orders = Vec::with_capacity(demands.len());
    let mut demands = demands.iter();
    loop {
        let demand = match demands.next() {
            Some(demand) => demand,
            None if given == last.rounded => return orders,
            None => last,
        };
        let most = (i64::from(demand.period) / pulse).clamp(1, greatest);
        let mut delta = [0; COORDINATES];
        for ((delta, given), to) in delta.iter_mut().zip(&mut given).zip(demand.rounded) {
            *delta = (to - *given).clamp(-most, most);
            *given += *delta;
        }
        orders.push(Order {
            delta,
            units: 1,
            period: demand.period,
            arc: None,
        });
    }
}

/// Returns the conventional device for `axes` axes, with arcs if a move has one; T of the first
/// move is in force at power-on.
#[must_use]
pub fn device(axes: usize, orders: &[Order]) -> Conventional {
    Conventional {
        axes,
        widths: ConventionalWidths::default(),
        period: orders.first().map_or(1, |first| first.period.into()),
        arcs: orders.iter().any(|order| order.arc.is_some()),
    }
}

/// Result at the drivers of the conventional device.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Beside {
    /// Number of ticks of the run.
    pub ticks: u64,
    /// Tick of the first step on any axis.
    pub first_step: Option<u64>,
    /// Number of unit times without pulses, because the next one of a move was not prepared.
    pub late_units: u64,
    /// Greatest number of ticks from an RST until the next unit time is prepared: the least
    /// possible T.
    pub needed: u64,
    /// Positions at the end of every unit time of a move, in steps from the axes' start, X first,
    /// unit after unit.
    pub positions: Vec<i32>,
    /// Jitter of each axis: greatest distance in ticks of a pulse from its time in uniform motion
    /// through its unit time.
    pub jitter: Vec<f64>,
    /// Least times on the step and direction lines of each axis.
    pub minima: Vec<TimingMinima>,
}

/// Observed signals.
struct See {
    step: Vec<At<bool>>,
    dir: Vec<At<bool>>,
    unit_rst: At<bool>,
    busy: At<bool>,
    late: At<bool>,
    ready: At<bool>,
    prepared: At<bool>,
}

impl See {
    fn of(watch: &Watcher<'_, Conventional>) -> Self {
        See {
            step: watch.each(&watch.w.step),
            dir: watch.each(&watch.w.dir),
            unit_rst: watch.at(watch.w.unit_rst),
            busy: watch.at(watch.w.busy),
            late: watch.at(watch.w.late),
            ready: watch.at(watch.w.ready),
            prepared: watch.at(watch.p.controller.w.prepared),
        }
    }
}

/// Computer 7, and drivers on all axes.
struct Bench<'o> {
    orders: &'o [Order],
    /// Number of unit times of all moves.
    units: usize,
    /// Value of the arc port when no arc is given, if the device supports arcs.
    no_arc: Option<ArcMove<Value>>,
    given: usize,
    /// True if a move may be given with the next tick.
    ready: bool,
    axes: Vec<Paced>,
    /// First tick of the current unit time.
    begun: u64,
    /// RST since which the next unit time is computed.
    since: Option<u64>,
    seen: Beside,
}

impl Bench<'_> {
    fn over(&self) -> bool {
        self.unit() == self.units
    }

    /// Returns the current unit time of a move.
    fn unit(&self) -> usize {
        self.seen.positions.len() / self.axes.len()
    }

    /// Returns the inputs of the next tick, and true if they are for that tick only.
    fn ports(&mut self) -> (conventional::In<Value>, bool) {
        let order = self.orders.get(self.given).filter(|_| self.ready);
        self.given += usize::from(order.is_some());
        self.ready = false;
        let Some(order) = order else {
            let order = Move {
                command: false,
                delta: vec![0; self.axes.len()],
                units: 0,
                period: 0,
            };
            let arc = self.no_arc.clone();
            return (conventional::In { order, arc }, false);
        };
        let arc = order.arc.map(|arc| ArcMove {
            circular: true,
            radius: arc.radius,
            angle: arc.angle,
            turn: arc.turn,
        });
        let arc = arc.or_else(|| self.no_arc.clone());
        let order = Move {
            command: true,
            delta: order.delta[..self.axes.len()].to_vec(),
            units: order.units.into(),
            period: order.period.into(),
        };
        (conventional::In { order, arc }, true)
    }

    /// Records a tick; `given` is true if a move was given in it.
    fn take(&mut self, now: &Sample<'_, Conventional>, see: &See, given: bool) {
        let tick = now.tick;
        for (axis, paced) in self.axes.iter_mut().enumerate() {
            paced.sample(tick, now.get(see.step[axis]), now.get(see.dir[axis]));
        }
        if self.seen.first_step.is_none() && see.step.iter().any(|step| now.get(*step)) {
            self.seen.first_step = Some(tick);
        }
        let (rst, prepared) = (now.get(see.unit_rst), now.get(see.prepared));
        if prepared && let Some(since) = self.since.take() {
            self.seen.needed = self.seen.needed.max(tick - since);
        }
        self.ready = now.get(see.ready) && !given;
        self.seen.ticks = tick + 1;
        if !rst {
            return;
        }
        // The unit time that runs at power-on has no pulses, nor has any until the first is
        // prepared.
        let began = !self.seen.positions.is_empty() || now.get(see.busy);
        self.seen.late_units += u64::from(began && now.get(see.late));
        if now.get(see.busy) {
            let positions = self.axes.iter().map(|axis| axis.driver.position() as i32);
            self.seen.positions.extend(positions);
        }
        for axis in &mut self.axes {
            axis.spread.unit_ends(self.begun, tick + 1);
        }
        self.begun = tick + 1;
        if prepared {
            self.since = Some(tick);
        }
    }
}

/// Plays moves on the conventional device; `observer` sees it too. Step motors on its drivers
/// are beside it in the waves ([`StepMotors`]).
///
/// # Errors
/// Returns the error of `observer`.
pub fn play(
    circuit: &Conventional,
    orders: &[Order],
    mut motors: Option<Motors>,
    observer: &mut dyn Observer<Conventional>,
) -> Result<Beside, RunError> {
    let (needs, beside) = (observer.needs(), StepMotors { axes: circuit.axes });
    let (mut simulator, see) = match motors {
        None => Simulator::watching(circuit, needs, See::of),
        Some(_) => Simulator::watching_beside(circuit, &beside, needs, See::of),
    }?;
    let mut bench = Bench {
        orders,
        units: orders.iter().map(|order| order.units as usize).sum(),
        no_arc: zero::<Conventional>(circuit).arc,
        given: 0,
        ready: true,
        axes: vec![Paced::default(); circuit.axes],
        begun: 0,
        since: None,
        seen: Beside::default(),
    };
    let mut stopped = false;
    while !bench.over() && !stopped {
        let (i, given) = bench.ports();
        simulator.watch_for(&observer);
        if let Some(motors) = &motors
            && observer.looks(simulator.tick())
        {
            simulator.show::<StepMotors>(&motors.signals())?;
        }
        let take = |now: &Sample<'_, _>| bench.take(now, &see, given);
        let ((), flow) = simulator.look(&i, &mut *observer, take)?;
        stopped = flow.is_break();
        if let Some(motors) = &mut motors {
            let positions = bench.axes.iter().map(|axis| axis.driver.position());
            motors.step(bench.unit(), positions);
        }
        let more = bench.ready && bench.given < orders.len();
        let most = match given || more || stopped || motors.is_some() {
            true => 1,
            false => simulator.unseen(&observer),
        };
        simulator.go_on(most);
    }
    let axes = &bench.axes;
    Ok(Beside {
        jitter: axes.iter().map(|axis| axis.spread.jitter()).collect(),
        minima: axes.iter().map(|axis| axis.driver.minima()).collect(),
        ..bench.seen
    })
}

/// Returns the least unit time for which the interpolator has the words of `table` in time while
/// its control computer writes them; found by playing it at 1, 2, … ticks.
///
/// # Errors
/// Returns the errors of [`fast_forward`].
pub fn least_period(table: &Table, variant: Variant) -> Result<u32, JobError> {
    let mut period = 1;
    loop {
        let table = table.at_period(period);
        if fast_forward(&group(&table, variant), &table, &mut ())?.idle_units == 0 {
            return Ok(period);
        }
        period += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn demands(period: u32, ends: &[[i64; COORDINATES]]) -> Vec<UnitDemand> {
        let demand = |&rounded: &[i64; COORDINATES]| UnitDemand {
            period,
            exact: rounded.map(|steps| steps as f64),
            rounded,
        };
        ends.iter().map(demand).collect()
    }

    fn run(axes: usize, orders: &[Order]) -> Beside {
        play(&device(axes, orders), orders, None, &mut ()).unwrap()
    }

    #[test]
    fn what_does_not_fit_into_a_unit_time_comes_with_the_next() {
        let timing = StepTiming {
            step_high_ticks: 2,
            step_low_ticks: 5,
            ..StepTiming::NONE
        };
        let deltas = |ends: &[[i64; COORDINATES]]| {
            let found = orders(&demands(129, ends), &timing);
            found.iter().map(|order| order.delta).collect::<Vec<_>>()
        };
        assert_eq!(
            deltas(&[[3, -12, 0], [20, -30, 0], [20, -31, 0]]),
            [[3, -12, 0], [12, -12, 0], [5, -7, 0]]
        );
        assert!(deltas(&[]).is_empty());
        // The path has ended, and the axis has not arrived yet.
        let found = orders(&demands(129, &[[0, 25, 0]]), &timing);
        let seen = run(2, &found);
        assert_eq!(seen.positions, [0, 12, 0, 24, 0, 25]);
        assert_eq!((seen.late_units, seen.minima[1].high), (0, Some(5)));
        // n = 5 for half a pulse per 5 3/8 ticks: the last one is early by 23 times the
        // difference.
        assert_eq!(seen.jitter, [0.0, 23.0 * 3.0 / 8.0]);
    }

    #[test]
    fn the_ticks_that_are_needed_are_those_below_which_it_comes_late() {
        for axes in 1..=COORDINATES {
            let ends = [1, 2, 3, 4].map(|unit| [unit; COORDINATES]);
            let at = |period| {
                let orders = orders(&demands(period, &ends), &StepTiming::NONE);
                run(axes, &orders)
            };
            let seen = at(2000);
            assert_eq!((seen.needed, seen.late_units), (3 + 54 * axes as u64, 0));
            let least = at(seen.needed as u32);
            assert_eq!((least.needed, least.late_units), (seen.needed, 0));
            let short = at(seen.needed as u32 - 1);
            assert_eq!((short.needed, short.late_units), (seen.needed, 3));
            assert_eq!(short.positions, least.positions);
            assert_eq!(short.positions.len(), 4 * axes);
        }
    }
}
