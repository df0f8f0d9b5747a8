//! Torque limit, friction, and how long a period is at least.

use super::*;
use motion_rtl::circuits::trajectory_controller::TrajectoryController;
use motion_rtl::sim::{Observer, RunError, Sample};
use std::collections::BTreeSet;
use std::ops::ControlFlow;

/// A line that asks for 3.8 N·m at 2000 mm/s².
fn line_with(torque: f64) -> Run {
    let weak = TwoMassParameters {
        max_torque_nm: torque,
        ..TwoMassParameters::default()
    };
    let machine = [weak, TwoMassParameters::default()];
    let pieces = [line([40.0, 0.0, 0.0], 150.0)];
    run([0.0; 3], &pieces, &settings(), &machine, Correction::Vector)
}

#[test]
fn a_motor_that_is_too_weak_is_late_and_comes_back() {
    // Largest overshoot of the load in counts: a weak motor cannot stop sooner.
    for (torque, beyond) in [(10.0, 30.0), (3.0, 750.0), (2.0, 3800.0)] {
        let run = line_with(torque);
        let measured = run.measured();
        let [x, y] = [measured.axes[0], measured.axes[1]];
        assert_eq!(x.saturated_periods > 0, torque < 3.8);
        assert_eq!(x.torque_max_nm == torque, torque < 3.8);
        assert_eq!(y.saturated_periods, 0);
        assert_eq!([x.end_position, y.end_position], [run.played.motor[0], 0]);
        let over = run
            .played
            .periods
            .iter()
            .map(|period| period.load[0] - 40_000.0);
        let over = over.fold(0.0, f64::max);
        assert!(over < beyond, "{torque}: {over}");
        assert!(run.played.settled, "{torque}");
        assert!(measured.load.end_um < 4.0, "{}", measured.load.end_um);
        for period in &run.played.periods {
            assert_eq!(period.motor[1], 0);
            let limited = period.torque[0].abs() == 32_767;
            assert!(limited || !period.saturated[0], "{period:?}");
        }
    }
}

#[test]
fn a_motor_that_cannot_follow_is_given_up() {
    let run = line_with(0.2);
    assert!(!run.played.settled);
    assert!(run.played.periods.len() < 4000);
}

#[test]
fn friction_is_what_the_integral_is_for() {
    let dry = TwoMassParameters {
        motor_friction_nm: 0.3,
        load_friction_nm: 0.3,
        ..TwoMassParameters::default()
    };
    let pieces = [line([30.0, 20.0, 0.0], 100.0)];
    let run = run(
        [0.0; 3],
        &pieces,
        &settings(),
        &[dry; 2],
        Correction::Vector,
    );
    let measured = run.measured();
    assert!(run.played.settled);
    let (peak, last) = (measured.motor.contour_max_um, measured.motor.end_um);
    println!("{peak} {last} {:?}", run.off_model());
    assert!(last < 4.0, "{last}");
}

/// Ticks from a period's beginning to its torques.
#[derive(Default)]
struct Latency {
    began: Option<u64>,
    seen: BTreeSet<u64>,
}

impl Observer<TrajectoryController> for Latency {
    fn sample(
        &mut self,
        now: &Sample<'_, TrajectoryController>,
    ) -> Result<ControlFlow<()>, RunError> {
        if now.see(|s| s.p.period_counter.w.enable) {
            self.began = Some(now.tick);
        }
        if let (true, Some(began)) = (now.see(|s| s.p.axes[0].w.driven), self.began) {
            self.seen.insert(now.tick - began);
        }
        Ok(ControlFlow::Continue(()))
    }
}

fn latency(axes: usize, pieces: &[Piece], correction: Correction) -> BTreeSet<u64> {
    // Twice as long as needed, for what is late to be seen as late.
    let settings = Settings {
        clock_hz: 2000 * LEAST_PERIOD_TICKS,
        ..settings()
    };
    let machine = vec![TwoMassParameters::default(); axes];
    let program = Program::of([0.0; 3], pieces, &settings, &machine, &Widths::FULL).unwrap();
    let mut latency = Latency::default();
    let circuit = controller(axes, correction, settings.rounding);
    play(&circuit, &program, plants(&machine, 1e-6), &mut latency).unwrap();
    latency.seen
}

/// On lines and on arcs of any size alike: the motors are looked at as often as there are periods.
#[test]
#[ignore = "takes long"]
fn torques_come_at_the_same_tick_of_every_period() {
    for correction in ALL {
        let [small, large] = [1e-4, 1.0].map(|radius| [arc(radius, 3.0, 100.0)]);
        let straight = [line([3.0, 4.0, 0.0], 100.0)];
        let due = |axes| {
            let circuit = controller(axes, correction, settings().rounding);
            BTreeSet::from([circuit.latency()])
        };
        for pieces in [&small, &large, &straight] {
            assert_eq!(latency(2, pieces, correction), due(2));
        }
        assert_eq!(latency(3, &large, correction), due(3));
        assert_eq!(due(3), BTreeSet::from([LEAST_PERIOD_TICKS + 1]));
    }
}
