//! A path on the trajectory controller, with a motor and its load on each axis: the control computer
//! that feeds it, and what comes out, period by period.

use super::host::Host;
pub use super::program::{Program, ProgramError};
use crate::kernel::{At, Observer, Sample, Simulator, Watcher};
use crate::logic::Sim;
use crate::plant::{Ahead, TwoMassAxis};
use crate::settings::{JobError, SettingError};
use crate::trajectory_controller::{TrajectoryController, Widths, controller};
use std::array::from_fn;

const P: usize = 47;
const D: usize = 55;
const K: usize = 16;
const G: usize = 24;
const T: usize = 16;
const U: usize = 24;

/// The controller that plays a job, on paths of up to 2^`A` segments; `E` = `A` + 4.
pub type Controller<const AXES: usize, const A: usize = 12, const E: usize = 16> =
    TrajectoryController<AXES, A, 31, P, 55, 42, 57, 44, 52, D, E, 41, 20, K, 64, G, 58, T, U>;
/// Its ports in.
pub(super) type Ports<const AXES: usize, const A: usize, const E: usize> =
    controller::In<Sim, AXES, A, P, D, E, K, G, T, U>;

/// Periods in a row in which models and motors are where they belong: then they have settled.
const CALM: u32 = 10;
/// How far a settled motor is from its model, in counts.
const NEAR_COUNTS: f64 = 2.0;

/// An interpolation period. Positions are from where the path begins, in guard units where nothing
/// else is said.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Period<const AXES: usize> {
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
pub struct Played<const AXES: usize> {
    /// The periods from the path's start on, its first length 0.
    pub periods: Vec<Period<AXES>>,
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
struct See<const AXES: usize> {
    ready: At<bool>,
    busy: At<bool>,
    late: [At<bool>; 2],
    starved: At<bool>,
    waiting: At<bool>,
    fresh: At<bool>,
    driven: At<bool>,
    length: At<i64>,
    answered: At<i64>,
    axes: [SeeAxis; AXES],
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

impl<const AXES: usize> See<AXES> {
    fn of<const A: usize, const E: usize>(watch: &Watcher<Controller<AXES, A, E>>) -> Self {
        let (q, w) = (&watch.q, &watch.w);
        See {
            ready: watch.at(w.ready),
            busy: watch.at(w.busy),
            late: [w.late, w.profile_late].map(|late| watch.at(late)),
            starved: watch.at(q.sequencer.starved),
            waiting: watch.at(q.progress.waiting),
            fresh: watch.at(w.axes[0].w.servo.w.model.w.fresh),
            driven: watch.at(w.axes[0].w.driven),
            length: watch.at(q.progress.length),
            answered: watch.at(q.tangential.integrators.position),
            axes: from_fn(|k| {
                let (axis, nets) = (&q.axes[k], &w.axes[k].w);
                SeeAxis {
                    command: watch.at(q.distribution.axes[k].point),
                    reference: watch.at(q.reference_point.axes[k].point),
                    response: watch.at(axis.response.integrators.position),
                    corrected: watch.at(axis.corrector.corrected),
                    model: watch.at(axis.servo.model.integrators.position),
                    motor: watch.at(nets.position),
                    drive: watch.at(axis.servo.arithmetic.torque),
                    torque: watch.at(nets.torque),
                    saturated: watch.at(nets.saturated),
                    lost: watch.at(nets.lost),
                }
            }),
        }
    }

    /// The period in which the motors are compared with their models: all of it stands, but for the
    /// loads and the torques.
    fn period<const A: usize, const E: usize>(
        &self,
        now: &Sample<'_, Controller<AXES, A, E>>,
    ) -> Option<Period<AXES>> {
        // Without a path the servo controls hold the machine: a period that began before the start.
        if !now.get(self.fresh) || now.get(self.waiting) {
            return None;
        }
        let words = |of: fn(&SeeAxis) -> At<i64>| from_fn(|k| now.get(of(&self.axes[k])));
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

/// How long models and motors may take to settle, in periods: 20 times their slowest decay, and a
/// second.
pub(crate) fn patience(program: &Program) -> usize {
    let [k1, k2] = program.gains.parts(&Widths::FULL);
    let slowest = 1.0 / k1 + 1.0 / k2;
    (20.0 * slowest + 1.0 / program.motion.period) as usize
}

/// Plays a program of up to 2^`A` segments on `circuit`, with `plants` on its axes, seen by
/// `observer` too, until the path is over and models and motors have settled, for a bounded time.
///
/// The path is written to the circuit before it begins, a word a tick, and the profile's records as
/// they find room. The plants are stepped once a tick, with the torques of the tick before.
///
/// # Errors
/// The path has more segments, or what `observer` objects to.
pub fn play<const AXES: usize, const A: usize, const E: usize>(
    circuit: &Controller<AXES, A, E>,
    program: &Program,
    plants: [TwoMassAxis; AXES],
    mut observer: impl Observer<Controller<AXES, A, E>>,
) -> Result<Played<AXES>, JobError> {
    let segments = program.path.stretches.len();
    if segments > 1 << A {
        let allowed = format!("up to {}", 1u64 << A);
        return Err(SettingError::value("segments", segments, allowed).into());
    }
    let mut host = Host::new(program);
    let mut i = host.standing();
    let mut played = Played::default();
    let (mut simulator, see) = Simulator::watching(circuit, observer.needs_all(), See::of)?;
    let mut compared = None;
    let (mut rests, mut calm, patience) = (0, 0, patience(program));
    let unit = f64::from(Widths::FULL.guard()).exp2();
    let mut motors = Ahead::new(plants);
    loop {
        let drives: [i64; AXES] = from_fn(|axis| simulator.get(see.axes[axis].drive));
        let step = |plants: &mut [TwoMassAxis; AXES]| {
            from_fn::<_, AXES, _>(|axis| plants[axis].step(drives[axis]))
        };
        host.drive(&mut i, motors.step(step));
        let (starts, pushed) = (i.start.get(), i.push.get());
        if starts {
            played.start = played.ticks;
        }
        let plants = &motors.plants;
        let (mut quiet, mut ended) = (true, false);
        let take = |now: &Sample<'_, _>| {
            host.records.free = now.get(see.ready) && !pushed;
            quiet = !now.get(see.fresh) && !now.get(see.driven);
            if let Some(period) = see.period(now) {
                compared = Some(Period {
                    load: from_fn(|axis| plants[axis].load_position_counts()),
                    ..period
                });
            }
            played.ticks = now.tick + 1;
            played.late |= see.late.iter().any(|late| now.get(*late));
            played.lost |= see.axes.iter().any(|axis| now.get(axis.lost));
            if now.get(see.driven)
                && let Some(mut period) = compared.take()
            {
                period.torque = from_fn(|k| now.get(see.axes[k].torque));
                period.saturated = from_fn(|k| now.get(see.axes[k].saturated));
                played.periods.push(period);
                ended = !now.get(see.busy);
            }
        };
        let ((), flow) = simulator.look(&i, &mut observer, take)?;
        if let Some(period) = played.periods.last()
            && ended
            && !starts
        {
            rests += 1;
            let near = (0..AXES).all(|axis| {
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
