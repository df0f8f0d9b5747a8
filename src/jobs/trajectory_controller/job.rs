//! A path on the trajectory controller, with a motor and its load on each axis: the control computer
//! that feeds it, and what comes out, period by period.

use super::host::Host;
use super::load_torque::LoadStep;
pub use super::program::{Program, ProgramError};
use super::settings::Correction;
use crate::circuits::trajectory_controller::path_point::AXES;
use crate::circuits::trajectory_controller::{Rounding, TrajectoryController, Widths};
use crate::hdl::{At, Observer, Sample, Simulator, Watcher};
use crate::plant::waves::{Machine, MachineSignals};
use crate::plant::{Ahead, Plant, Plants, TwoMassAxis};
use crate::settings::{JobError, SettingError};
use std::array::from_fn;

/// The controller that plays a job on so many axes.
#[must_use]
pub const fn controller(
    axes: usize,
    correction: Correction,
    rounding: Rounding,
) -> TrajectoryController {
    TrajectoryController::new(Widths::FULL, axes, correction, rounding)
}

/// Periods in a row in which models and motors are where they belong: then they have settled.
const CALM: u32 = 10;
/// How far a settled motor is from its model, in counts.
const NEAR_COUNTS: f64 = 2.0;

/// An interpolation period. Positions are from where the path begins, in guard units where nothing
/// else is said; an axis that there is not stays at 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Period {
    /// The tick in which the servo's models have moved, and the motors are compared with them.
    pub tick: u64,
    /// q_c.
    pub length: i64,
    /// q_s.
    pub answered: i64,
    /// P_c.
    pub command: [i64; AXES],
    /// P_r.
    pub reference: [i64; AXES],
    /// P_s.
    pub response: [i64; AXES],
    /// P_d.
    pub corrected: [i64; AXES],
    /// Of the servo's own model.
    pub model: [i64; AXES],
    /// Of the motor, in encoder counts.
    pub motor: [i64; AXES],
    /// Of the load, in encoder counts.
    pub load: [f64; AXES],
    /// Torque from this period on, in words of the amplifier.
    pub torque: [i64; AXES],
    /// It is limited.
    pub saturated: [bool; AXES],
}

/// What came out of a path.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Played {
    /// How many axes there are.
    pub axes: usize,
    /// The periods from the path's start on, its first length 0; none of [`play_each`].
    pub periods: Vec<Period>,
    /// Of the motors in the last tick, in encoder counts.
    pub motor: [i64; AXES],
    /// The tick in which the path was started: before it, it was written.
    pub start: u64,
    /// The ticks of the run.
    pub ticks: u64,
    /// A period began before the one before was over.
    pub late: bool,
    /// The profile ended in motion.
    pub starved: bool,
    /// An encoder was too fast.
    pub lost: bool,
    /// Models and motors came to rest at the path's end.
    pub settled: bool,
}

/// What is looked at.
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

/// What is looked at of an axis.
struct SeeAxis {
    command: At<i64>,
    reference: At<i64>,
    response: At<i64>,
    corrected: At<i64>,
    model: At<i64>,
    motor: At<i64>,
    /// The torque that the motor has.
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
                command: watch.at(placed.q.point),
                reference: watch.at(referred.q.point),
                response: watch.at(axis.p.response.p.integrators.q.position),
                corrected: watch.at(axis.p.corrector.q.corrected),
                model: watch.at(servo.model.p.integrators.q.position),
                motor: watch.at(nets.position),
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
            length: watch.at(p.progress.q.length),
            answered: watch.at(p.tangential.p.integrators.q.position),
            axes: axes.collect(),
        }
    }

    /// What is at a place of every axis; of one that there is not, what nothing is.
    fn each<T: Default>(&self, mut of: impl FnMut(&SeeAxis) -> T) -> [T; AXES] {
        from_fn(|k| self.axes.get(k).map(&mut of).unwrap_or_default())
    }

    /// The period in which the motors are compared with their models: all of it stands, but for the
    /// loads and the torques.
    fn period(&self, now: &Sample<'_, TrajectoryController>) -> Option<Period> {
        // Without a path the servo controls hold the machine: a period that began before the start.
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

/// Motors with their loads, one for each axis, and what acts on these from outside.
struct Motors<'a> {
    axes: Vec<TwoMassAxis>,
    loads: &'a [LoadStep],
    now: Since,
}

/// How far the torques from outside are.
#[derive(Debug, Clone, Copy, Default)]
struct Since {
    /// Ticks since the path's start; none before it.
    start: Option<u64>,
    /// The step that comes next.
    next: usize,
}

impl Motors<'_> {
    /// What acts on the loads in the tick to come.
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

    /// Steps them under these torques; gives the channels of their encoders.
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

/// How long models and motors may take to settle, in periods: 20 times their slowest decay, and a
/// second.
pub(crate) fn patience(program: &Program) -> usize {
    let [k1, k2] = program.tangential.parts(&Widths::FULL);
    let slowest = 1.0 / k1 + 1.0 / k2;
    (20.0 * slowest + 1.0 / program.motion.period) as usize
}

/// Plays a program on `circuit`, with `plants` on its axes, which stand in the waves beside it
/// ([`Machine`]); seen by `observer` too, until the path is over and models and motors have settled,
/// for a bounded time.
///
/// The path is written to the circuit before it begins, a word a tick, and the profile's records as
/// they find room. The plants are stepped once a tick, with the torques of the tick before.
///
/// # Errors
/// The path has more segments than the circuit holds, there is not a plant for each axis, or what
/// `observer` objects to.
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

/// Does what [`play`] does, but gives every period to `each` as it comes and keeps none.
///
/// # Errors
/// Errors of [`play`].
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
    let (all, beside) = (observer.needs_all(), Machine { axes });
    let (mut simulator, see) = Simulator::watching_beside(circuit, &beside, all, See::of)?;
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
