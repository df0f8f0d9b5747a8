//! Nets and registers of the machine that a job observes.

use crate::circuits::machine::Machine;
use crate::hdl::At;
use crate::sim::{Sample, Watcher};
use std::array::from_fn;

/// Returns the counters of the motors' positions. They are not watched, as the jobs read them only
/// in ticks with a strobe: a run does not stop at every edge of an encoder.
pub(super) fn motors(watch: &Watcher<'_, Machine>) -> [At<i64>; 2] {
    let axes = &watch.p.trajectory_controller.p.axes;
    from_fn(|k| axes[k].p.servo.p.detector.q.position)
}

/// Signals of the machine that a job observes. Registers that are read only in ticks with a strobe
/// are not watched.
pub(super) struct See {
    /// Step and direction of X and Y.
    pub(super) lines: [(At<bool>, At<bool>); 2],
    pub(super) pulse_busy: At<bool>,
    pub(super) unit: At<bool>,
    pub(super) fault: At<bool>,
    pub(super) scan: [At<bool>; 2],
    pub(super) sample: [At<bool>; 5],
    pub(super) servo: [At<bool>; 2],
    pub(super) lift_lost: At<bool>,
    pub(super) lift: SeeLift,
    pub(super) lift_busy: At<bool>,
    pub(super) driven: At<bool>,
    pub(super) command: [At<i64>; 2],
    pub(super) corrected: [At<i64>; 2],
    pub(super) model: [At<i64>; 2],
    pub(super) counts: [At<i64>; 2],
    pub(super) motor: [At<i64>; 2],
}

impl See {
    /// True if a tick that is equal to this one gives equal records.
    pub(super) fn is_quiet(&self, now: &Sample<'_, Machine>) -> bool {
        let lift = &self.lift;
        let strobes = [
            self.unit,
            self.driven,
            lift.fire,
            lift.complete,
            lift.learned,
        ];
        strobes.iter().all(|&strobe| !now.get(strobe))
    }
}

/// Signals of the pen lift that a job observes.
pub(super) struct SeeLift {
    pub(super) fire: At<bool>,
    pub(super) complete: At<bool>,
    pub(super) learned: At<bool>,
    pub(super) learned_time: At<u64>,
    pub(super) lead_time: At<u64>,
    pub(super) position: At<i64>,
    pub(super) target: At<i64>,
}

impl See {
    pub(super) fn of(watch: &Watcher<'_, Machine>) -> Self {
        let (p, w) = (&watch.p, &watch.w);
        let lift = &p.lead_angle.w;
        let (lines, arcs) = (&p.linear_interpolator.w, &p.arc_generator.w);
        let (trajectory, axes) = (&p.trajectory_controller.w, &p.trajectory_controller.p.axes);
        See {
            lines: [(w.step_x, w.dir_x), (w.step_y, w.dir_y)]
                .map(|(step, dir)| (watch.at(step), watch.at(dir))),
            pulse_busy: watch.at(w.pulse_busy),
            unit: watch.at(p.enables.w.unit),
            fault: watch.at(w.fault),
            scan: [lines.late, lines.refused].map(|bit| watch.at(bit)),
            sample: [
                arcs.late,
                arcs.starved,
                trajectory.late,
                trajectory.profile_late,
                trajectory.starved,
            ]
            .map(|bit| watch.at(bit)),
            servo: from_fn(|axis| watch.at(trajectory.lost[axis])),
            lift_lost: watch.at(lift.lost),
            lift: SeeLift {
                fire: watch.at(lift.fire),
                complete: watch.at(lift.complete),
                learned: watch.at(lift.learned),
                learned_time: watch.at(lift.learned_time),
                lead_time: watch.at(lift.lead_time),
                position: watch.at(lift.position),
                target: watch.at(lift.target),
            },
            lift_busy: watch.at(w.lift_busy),
            driven: watch.at(axes[0].w.driven),
            command: [p.command_join.q.x, p.command_join.q.y],
            corrected: from_fn(|k| axes[k].p.corrector.q.corrected),
            model: from_fn(|k| axes[k].p.servo.p.model.p.integrators.q.position),
            counts: [w.counts_x, w.counts_y].map(|axis| watch.at(axis)),
            motor: motors(watch),
        }
    }
}
