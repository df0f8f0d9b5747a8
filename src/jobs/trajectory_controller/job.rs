//! Run of a path on the trajectory controller, with a motor and its load on each axis: the control
//! computer that feeds it, and the results, period by period.

use super::host::Host;
use super::load_torque::LoadStep;
pub use super::program::{Program, ProgramError};
use super::settings::Correction;
use crate::circuits::trajectory_controller::path_point::AXES;
use crate::circuits::trajectory_controller::{Rounding, TrajectoryController, Widths};
use crate::hdl::At;
use crate::jobs::JobError;
use crate::plant::waves::{Machine, MachineSignals};
use crate::plant::{Ahead, Plant, Plants, TwoMassAxis};
use crate::settings::SettingError;
use crate::sim::{Observer, Sample, Simulator, Watcher};
use std::array::from_fn;

/// Returns the controller for a job on `axes` axes.
#[must_use]
pub const fn controller(
    axes: usize,
    correction: Correction,
    rounding: Rounding,
) -> TrajectoryController {
    TrajectoryController::new(Widths::FULL, axes, correction, rounding)
}

/// Number of consecutive periods in which models and motors must be in place to count as settled.
const CALM: u32 = 10;
/// Greatest distance of a settled motor from its model, in counts.
const NEAR_COUNTS: f64 = 2.0;

/// Interpolation period. Positions are relative to the start of the path, in guard units unless
/// stated otherwise; 0 for an axis that does not exist.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Period {
    /// Tick in which the servo's models have moved, and the motors are compared with them.
    pub tick: u64,
    /// Commanded length q_c.
    pub length: i64,
    /// Length q_s of the tangential response.
    pub answered: i64,
    /// Command P_c.
    pub command: [i64; AXES],
    /// Reference P_r.
    pub reference: [i64; AXES],
    /// Response P_s.
    pub response: [i64; AXES],
    /// Corrected command P_d.
    pub corrected: [i64; AXES],
    /// Position of the servo's own model.
    pub model: [i64; AXES],
    /// Position of the motor in encoder counts.
    pub motor: [i64; AXES],
    /// Position of the load in encoder counts.
    pub load: [f64; AXES],
    /// Torque from this period on, in words of the amplifier.
    pub torque: [i64; AXES],
    /// True if the torque is limited.
    pub saturated: [bool; AXES],
}

/// Result of a path.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Played {
    /// Number of axes.
    pub axes: usize,
    /// Periods from the path's start on, the first with length 0; empty for [`play_each`].
    pub periods: Vec<Period>,
    /// Positions of the motors in the last tick, in encoder counts.
    pub motor: [i64; AXES],
    /// Tick in which the path was started; it was written before.
    pub start: u64,
    /// Number of ticks of the run.
    pub ticks: u64,
    /// True if a period began before the one before had ended.
    pub late: bool,
    /// True if the profile ended in motion.
    pub starved: bool,
    /// True if an encoder was too fast.
    pub lost: bool,
    /// True if models and motors came to rest at the path's end.
    pub settled: bool,
}

/// Observed signals. Registers that are read only in ticks with a strobe are not watched: a run
/// does not stop at every edge of an encoder.
struct See {
    ready: At<bool>,
    busy: At<bool>,
    late: [At<bool>; 2],
    starved: At<bool>,
    waiting: At<bool>,
    fresh: At<bool>,
    driven: At<bool>,
    length: At<i64>,
    answered: At<i64>,
    axes: Vec<SeeAxis>,
}

/// Observed signals of an axis.
struct SeeAxis {
    command: At<i64>,
    reference: At<i64>,
    response: At<i64>,
    corrected: At<i64>,
    model: At<i64>,
    motor: At<i64>,
    /// Current torque of the motor.
    drive: At<i64>,
    torque: At<i64>,
    saturated: At<bool>,
    lost: At<bool>,
}

impl See {
    fn of(watch: &Watcher<'_, TrajectoryController>) -> Self {
        let (w, p) = (&watch.w, &watch.p);
        let axes = p.axes.iter().zip(&p.distribution.p.axes);
        let axes = axes.zip(&p.reference_point.p.axes);
        let axes = axes.map(|((axis, placed), referred)| {
            let (servo, nets) = (&axis.p.servo.p, &axis.w);
            SeeAxis {
                command: placed.q.point,
                reference: referred.q.point,
                response: axis.p.response.p.integrators.q.position,
                corrected: axis.p.corrector.q.corrected,
                model: servo.model.p.integrators.q.position,
                motor: servo.detector.q.position,
                drive: watch.at(servo.arithmetic.q.torque),
                torque: watch.at(nets.torque),
                saturated: watch.at(nets.saturated),
                lost: watch.at(nets.lost),
            }
        });
        See {
            ready: watch.at(w.ready),
            busy: watch.at(w.busy),
            late: [w.late, w.profile_late].map(|late| watch.at(late)),
            starved: watch.at(p.sequencer.q.starved),
            waiting: watch.at(p.progress.q.waiting),
            fresh: watch.at(p.axes[0].p.servo.p.model.w.fresh),
            driven: watch.at(p.axes[0].w.driven),
            length: p.progress.q.length,
            answered: p.tangential.p.integrators.q.position,
            axes: axes.collect(),
        }
    }

    /// Returns the value at a place of every axis; the default for an axis that does not exist.
    fn each<T: Default>(&self, mut of: impl FnMut(&SeeAxis) -> T) -> [T; AXES] {
        from_fn(|k| self.axes.get(k).map(&mut of).unwrap_or_default())
    }

    /// Returns the period in which the motors are compared with their models; complete except for
    /// loads and torques.
    fn period(&self, now: &Sample<'_, TrajectoryController>) -> Option<Period> {
        // Without a path the servo controls hold the machine: a period that began before the
        // start.
        if !now.get(self.fresh) || now.get(self.waiting) {
            return None;
        }
        let words = |of: fn(&SeeAxis) -> At<i64>| self.each(|axis| now.get(of(axis)));
        Some(Period {
            tick: now.tick,
            length: now.get(self.length),
            answered: now.get(self.answered),
            command: words(|axis| axis.command),
            reference: words(|axis| axis.reference),
            response: words(|axis| axis.response),
            corrected: words(|axis| axis.corrected),
            model: words(|axis| axis.model),
            motor: words(|axis| axis.motor),
            load: [0.0; AXES],
            torque: [0; AXES],
            saturated: [false; AXES],
        })
    }
}

/// Motors with their loads, one for each axis, and external torques on the loads.
struct Motors<'a> {
    axes: Vec<TwoMassAxis>,
    loads: &'a [LoadStep],
    now: Since,
}

/// Progress of the external torques.
#[derive(Debug, Clone, Copy, Default)]
struct Since {
    /// Ticks since the path's start; `None` before it.
    start: Option<u64>,
    /// Index of the next step.
    next: usize,
}

impl Motors<'_> {
    /// Sets the external torques for the next tick.
    fn load(&mut self) {
        let Some(tick) = self.now.start else {
            return;
        };
        while let Some(step) = self.loads.get(self.now.next)
            && step.tick <= tick
        {
            self.axes[step.axis].set_load_torque_nm(step.torque_nm);
            self.now.next += 1;
        }
        self.now.start = Some(tick + 1);
    }

    /// Steps the motors under these torques; returns the channels of their encoders.
    #[inline]
    fn step(&mut self, torques: [i64; AXES]) -> [(bool, bool); AXES] {
        self.load();
        let mut channels = [(false, false); AXES];
        let motors = self.axes.iter_mut().zip(torques);
        for ((motor, torque), channels) in motors.zip(&mut channels) {
            *channels = motor.step(torque);
        }
        channels
    }
}

impl Plants for Motors<'_> {
    type State = (<TwoMassAxis as Plant>::State, Since);

    #[inline]
    fn save(&self, states: &mut Vec<Self::State>) {
        for axis in &self.axes {
            states.push((axis.state(), self.now));
        }
    }

    #[inline]
    fn restore(&mut self, states: &[Self::State]) {
        for (axis, (state, now)) in self.axes.iter_mut().zip(states) {
            axis.set_state(state);
            self.now = *now;
        }
    }
}

/// Returns the greatest settling time of models and motors in periods: 20 times their slowest
/// decay, and a second.
pub(crate) fn patience(program: &Program) -> usize {
    let [k1, k2] = program.tangential.parts(&Widths::FULL);
    let slowest = 1.0 / k1 + 1.0 / k2;
    (20.0 * slowest + 1.0 / program.motion.period) as usize
}

/// Plays a program on `circuit`, with `plants` on its axes, which are beside it in the waves
/// ([`Machine`]); `observer` sees it too. Runs until the path has ended and models and motors have
/// settled, for a bounded time.
///
/// The path is written to the circuit before it begins, one word per tick, and the profile's
/// records as space allows. The plants are stepped once per tick, with the torques of the tick
/// before.
///
/// # Errors
/// Returns an error if the path has more segments than the circuit holds or there is not a plant
/// for each axis, or the error of `observer`.
pub fn play(
    circuit: &TrajectoryController,
    program: &Program,
    plants: Vec<TwoMassAxis>,
    observer: &mut dyn Observer<TrajectoryController>,
) -> Result<Played, JobError> {
    let mut periods = Vec::new();
    let each = &mut |period: &Period| periods.push(*period);
    let played = play_each(circuit, program, plants, observer, each)?;
    Ok(Played { periods, ..played })
}

/// Plays as [`play`] does, but passes every period to `each` and keeps none.
///
/// # Errors
/// Returns the errors of [`play`].
pub fn play_each(
    circuit: &TrajectoryController,
    program: &Program,
    plants: Vec<TwoMassAxis>,
    observer: &mut dyn Observer<TrajectoryController>,
    each: &mut dyn FnMut(&Period),
) -> Result<Played, JobError> {
    let (segments, most) = (program.path.stretches.len(), circuit.widths.most_segments());
    if segments > most {
        let allowed = format!("up to {most}");
        return Err(SettingError::value("segments", segments, allowed).into());
    }
    let axes = circuit.axes;
    if plants.len() != axes {
        return Err(SettingError::value("axes", plants.len(), axes.to_string()).into());
    }
    let mut host = Host::new(program, circuit.correction);
    let mut i = host.standing(circuit);
    let mut played = Played {
        axes,
        ..Played::default()
    };
    let (needs, beside) = (observer.needs(), Machine { axes });
    let (mut simulator, see) = Simulator::watching_beside(circuit, &beside, needs, See::of)?;
    let (mut compared, mut last) = (None, None);
    let (mut rests, mut calm, patience) = (0, 0, patience(program));
    let unit = (Widths::FULL.guard() as f64).exp2();
    let mut motors = Ahead::new(Motors {
        axes: plants,
        loads: &program.load_steps,
        now: Since::default(),
    });
    loop {
        let drives = see.each(|axis| simulator.get(axis.drive));
        let step = |motors: &mut Motors<'_>| motors.step(drives);
        host.drive(&mut i, motors.step(step));
        let (starts, pushed) = (i.start, i.record.push);
        if starts {
            played.start = played.ticks;
            motors.plants.now.start = Some(0);
        }
        let plants = &motors.plants.axes;
        simulator.watch_for(&observer);
        if observer.looks(simulator.tick()) {
            simulator.show::<Machine>(&MachineSignals::of(plants))?;
        }
        let (mut quiet, mut ended) = (true, false);
        let take = |now: &Sample<'_, _>| {
            host.records.free = now.get(see.ready) && !pushed;
            quiet = !now.get(see.fresh) && !now.get(see.driven);
            if let Some(period) = see.period(now) {
                let load = |plant: &TwoMassAxis| plant.load_position_counts();
                compared = Some(Period {
                    load: from_fn(|axis| plants.get(axis).map_or(0.0, load)),
                    ..period
                });
            }
            played.ticks = now.tick + 1;
            played.late |= see.late.iter().any(|late| now.get(*late));
            played.lost |= see.axes.iter().any(|axis| now.get(axis.lost));
            if now.get(see.driven)
                && let Some(mut period) = compared.take()
            {
                period.torque = see.each(|axis| now.get(axis.torque));
                period.saturated = see.each(|axis| now.get(axis.saturated));
                played.motor = see.each(|axis| now.get(axis.motor));
                each(&period);
                last = Some(period);
                ended = !now.get(see.busy);
            }
        };
        let ((), flow) = simulator.look(&i, &mut *observer, take)?;
        if let Some(period) = &last
            && ended
            && !starts
        {
            rests += 1;
            let near = (0..axes).all(|axis| {
                let model = period.model[axis] as f64 / unit;
                let target = period.corrected[axis] as f64 / unit;
                let motor = period.motor[axis] as f64;
                (model - target).abs() < 0.5 && (motor - model).abs() <= NEAR_COUNTS
            });
            calm = if near { calm + 1 } else { 0 };
        }
        played.settled = calm >= CALM;
        let ends = played.settled || rests > patience || flow.is_break();
        let most = match quiet && host.stands() && !ends {
            true => simulator.unseen(&observer),
            false => 1,
        };
        motors.go_on(most, step, |ticks| simulator.go_on(ticks));
        if ends {
            break;
        }
    }
    played.starved = simulator.get(see.starved);
    Ok(played)
}
