//! Run of a drawing's cycles with a motor on each axis, on the linear interpolator and on the
//! conventional system.

use super::measure::{Cycle, Played, ScanRecord, Seen};
use super::profile::Profile;
use super::settings::{AxisSettings, Settings};
use super::targets::Target;
use crate::circuits::linear_interpolator::command_source::Orders;
use crate::circuits::linear_interpolator::{
    CommandSource, Controller, Conventional, LinearInterpolator, MasterAxis, Widths, controller,
};
use crate::hdl::{At, Value, zero};
use crate::jobs::JobError;
use crate::plant::{Ahead, ServoAxis, ServoParameters, waves};
use crate::sim::{Observer, Sample, Simulator, Watcher};
use fixed::types::U8F8;

/// Full scale of the 16-bit D/A converters.
const FULL_SCALE: i64 = (1 << 15) - 1;
/// Number of scans without a new command after which an axis that is not in position is given up.
const PATIENCE: u64 = 20_000;

/// Returns the plotter with the linear interpolator, with rule and master axis from the settings.
pub fn plotter(settings: &Settings) -> Controller {
    Controller::new(CommandSource::Linear(LinearInterpolator {
        widths: Widths::FULL,
        rule: settings.rule,
        master: settings.master,
    }))
}

/// Returns the plotter with the conventional system of Fig. 3.
pub fn conventional() -> Controller {
    Controller::new(CommandSource::Conventional(Conventional::default()))
}

impl AxisSettings {
    /// Returns driver, motor and encoder of this axis.
    fn servo(&self) -> ServoParameters {
        ServoParameters {
            velocity_loop_s: self.velocity_loop_ms / 1e3,
            inertia_kg_m2: self.inertia_kg_m2,
            max_torque_nm: self.max_torque_nm,
            friction_nm: self.friction_nm,
            rated_speed_rad_per_s: self.rated_speed_rev_per_min / 60.0 * std::f64::consts::TAU,
            counts_per_rev: f64::from(self.counts_per_rev),
        }
    }

    /// Returns Kp in LSB of the D/A converter per count.
    pub fn gain(&self) -> U8F8 {
        let lsb_per_count =
            self.position_gain_per_s * FULL_SCALE as f64 / self.rated_counts_per_s();
        U8F8::saturating_from_num(lsb_per_count)
    }
}

/// Observed signals.
struct See {
    reference: [At<i64>; 2],
    scan: At<bool>,
    start: At<bool>,
    load: At<bool>,
    ready: At<bool>,
    busy: At<bool>,
    late: At<bool>,
    refused: At<bool>,
    lost: [At<bool>; 2],
    saturated: [At<bool>; 2],
    command: [At<i64>; 2],
}

impl See {
    fn of(watch: &Watcher<'_, Controller>) -> Self {
        let w = &watch.w;
        let loops = [&watch.p.loop_x, &watch.p.loop_y];
        See {
            reference: loops.map(|axis| watch.at(axis.p.control.q.speed_ref)),
            scan: watch.at(w.scan),
            start: watch.at(w.start),
            load: watch.at(w.load),
            ready: watch.at(w.ready),
            busy: watch.at(w.busy),
            late: watch.at(w.late),
            refused: watch.at(w.refused),
            lost: [w.lost_x, w.lost_y].map(|lost| watch.at(lost)),
            saturated: loops.map(|axis| watch.at(axis.w.saturated)),
            command: [w.command_x, w.command_y].map(|command| watch.at(command)),
        }
    }
}

/// Control computer: gives targets and records the results.
struct Bench<'a, const N: usize> {
    targets: &'a [Target<N>],
    /// Number of scans so far, and receiver of each.
    scans: usize,
    each: &'a mut dyn FnMut(&Seen<'_>),
    master: MasterAxis,
    pushed: usize,
    /// True if a push was given in the tick before.
    pushing: bool,
    ready: bool,
    played: Played,
    /// Cycle whose command came with the tick before, to be recorded by the next scan.
    loaded: Option<usize>,
    fresh: Option<usize>,
    /// Number of scans since the last new command.
    idle: u64,
    /// True if the tick equals the one before in all observed signals.
    quiet: bool,
}

impl<const N: usize> Bench<'_, N> {
    /// True if the next tick's inputs and records will be the same, provided that the observed
    /// signals do not change.
    fn stands(&self) -> bool {
        let pushes = self.pushing || (self.ready && self.pushed < self.targets.len());
        self.quiet && !pushes && self.loaded.is_none()
    }

    /// Returns the target that is given in this tick.
    fn push(&mut self) -> Option<Target<N>> {
        let target = self.targets.get(self.pushed).copied();
        // The flag is that of the tick before: full or not, it changes only by a push.
        let target = target.filter(|_| self.ready && !self.pushing);
        self.pushing = target.is_some();
        self.pushed += usize::from(self.pushing);
        target
    }

    /// Records the tick; returns true if the run continues.
    fn take(&mut self, now: &Sample<'_, Controller>, see: &See, motor: [f64; 2]) -> bool {
        let played = &mut self.played;
        let command = || see.command.map(|command| now.get(command));
        played.ticks = now.tick + 1;
        self.quiet = ![see.scan, see.start, see.load]
            .map(|bit| now.get(bit))
            .contains(&true);
        self.ready = now.get(see.ready);
        if let Some(cycle) = self.loaded.take() {
            played.cycles[cycle].end = command();
            self.fresh = Some(cycle);
            self.idle = 0;
        }
        if now.get(see.scan) {
            self.idle += 1;
            let (at, fresh) = (self.scans, self.fresh.take());
            self.scans += 1;
            if let Some(cycle) = fresh {
                let scans = &mut played.cycles[cycle].scans;
                *scans = match scans.len() {
                    0 => at..at + 1,
                    _ => scans.start..at + 1,
                };
            }
            (self.each)(&Seen {
                record: ScanRecord {
                    tick: now.tick,
                    command: command(),
                    motor,
                },
                fresh,
                cycles: &played.cycles,
            });
            for axis in 0..2 {
                played.saturated_scans[axis] += u64::from(now.get(see.saturated[axis]));
            }
        }
        if now.get(see.start)
            && let Some(target) = self.targets.get(played.cycles.len())
        {
            let (from, to) = (command(), [target.x, target.y]);
            let delta = [0, 1].map(|axis| to[axis] - from[axis]);
            played.cycles.push(Cycle {
                from,
                to,
                master: self.master.of(delta),
                scans: 0..0,
                end: from,
            });
        }
        if now.get(see.load) {
            self.loaded = played.cycles.len().checked_sub(1);
        }
        played.late |= now.get(see.late);
        played.lost = see.lost.map(|lost| now.get(lost));
        played.unsettled = self.idle > PATIENCE;
        let given = self.pushed == self.targets.len() && !self.pushing;
        let over = given && !now.get(see.busy) && self.loaded.is_none() && self.fresh.is_none();
        if over && now.get(see.refused) {
            played.refused = (self.targets.len() - played.cycles.len()) as u64;
        }
        !over && !played.unsettled
    }
}

/// Gives a target, or none.
fn give<const N: usize>(orders: &mut Orders<Value>, target: Option<Target<N>>) {
    orders.push = target.is_some();
    orders.target_x = target.map_or(0, |target| target.x);
    orders.target_y = target.map_or(0, |target| target.y);
    let settings = &mut orders.settings;
    for n in 0..N {
        let word = |of: fn(Profile) -> u64| target.map_or(0, |target| of(target.profiles[n]));
        settings.speed[n] = word(|profile| profile.speed);
        settings.acceleration_time[n] = word(|profile| profile.acceleration_scans);
        settings.deceleration_time[n] = word(|profile| profile.deceleration_scans);
    }
}

/// Plays the cycles on `circuit`, whose targets have `N` settings, with motors according to
/// `settings`, which are beside it in the waves; `observer` sees it too.
///
/// # Errors
/// Returns an error if a setting is out of range, or the error of `observer`.
pub fn play<const N: usize>(
    circuit: &Controller,
    targets: &[Target<N>],
    settings: &Settings,
    observer: &mut dyn Observer<Controller>,
) -> Result<Played, JobError> {
    let mut records = Vec::new();
    let each = &mut |seen: &Seen<'_>| records.push(seen.record);
    let played = play_each(circuit, targets, settings, observer, each)?;
    Ok(Played { records, ..played })
}

/// Plays as [`play`] does, but passes every scan to `each` and keeps no records.
///
/// # Errors
/// Returns the errors of [`play`].
pub fn play_each<const N: usize>(
    circuit: &Controller,
    targets: &[Target<N>],
    settings: &Settings,
    observer: &mut dyn Observer<Controller>,
    each: &mut dyn FnMut(&Seen<'_>),
) -> Result<Played, JobError> {
    settings.validate()?;
    let tick_s = 1.0 / settings.clock_hz as f64;
    let [x, y] = [0, 1].map(|axis| settings.axis(axis));
    let servos = [
        ServoAxis::new(&x.servo(), tick_s)?,
        ServoAxis::new(&y.servo(), tick_s)?,
    ];
    let gains = [x, y].map(|axis| u64::from(axis.gain().to_bits()));
    let mut i = controller::In {
        exact_stop: settings.exact_stop,
        scan_period: u64::from(settings.scan_ticks),
        gain_x: gains[0],
        gain_y: gains[1],
        window: u64::from(settings.in_position_counts),
        ..zero(circuit)
    };
    let mut bench = Bench {
        targets,
        scans: 0,
        each,
        master: match &circuit.source {
            CommandSource::Linear(interpolator) => interpolator.master,
            CommandSource::Conventional(_) => MasterAxis::Longer,
        },
        pushed: 0,
        pushing: false,
        ready: true,
        played: Played::default(),
        loaded: None,
        fresh: None,
        idle: 0,
        quiet: false,
    };
    let (mut simulator, see) =
        Simulator::watching_beside(circuit, &waves::Axes, observer.needs(), See::of)?;
    let mut motors = Ahead::new(servos);
    loop {
        let references = simulator.state(|q| see.reference.map(|axis| q.get(axis)));
        let step = |[x, y]: &mut [ServoAxis; 2]| {
            [
                x.step(references[0], FULL_SCALE),
                y.step(references[1], FULL_SCALE),
            ]
        };
        [(i.a_x, i.b_x), (i.a_y, i.b_y)] = motors.step(step);
        give(&mut i.orders, bench.push());
        let servos = &motors.plants;
        simulator.watch_for(&observer);
        if observer.looks(simulator.tick()) {
            simulator.show::<waves::Axes>(&waves::Signals::of(servos))?;
        }
        let motor = [0, 1].map(|axis: usize| servos[axis].position_counts());
        let take = |now: &Sample<'_, _>| bench.take(now, &see, motor);
        let (goes_on, flow) = simulator.look(&i, &mut *observer, take)?;
        if !goes_on || flow.is_break() {
            return Ok(bench.played);
        }
        let most = match bench.stands() {
            true => simulator.unseen(&observer),
            false => 1,
        };
        motors.go_on(most, step, |ticks| simulator.go_on(ticks));
    }
}
