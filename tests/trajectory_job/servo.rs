//! Torque limit, stiction, latency.

use super::*;
use motion_rtl::kernel::{Observer, RunError, Sample};
use std::ops::ControlFlow;

#[test]
fn a_motor_that_is_too_weak_is_late_and_comes_back() {
    // 3.8 N·m are asked for at 2000 mm/s².
    for torque in [1.0, 2.0, 3.0] {
        let weak = TwoMassParameters {
            max_torque_nm: torque,
            ..TwoMassParameters::default()
        };
        let pieces = [line([40.0, 0.0, 0.0], 150.0)];
        let run = run(
            [0.0; 3],
            &pieces,
            &settings(),
            [weak, TwoMassParameters::default()],
            Correction::Vector,
        );
        let measured = run.measured();
        println!(
            "{torque}: saturated {:?} torque {:?} off {:?} final {} {}",
            measured.saturated,
            measured.torque,
            run.off_model(),
            measured.load.final_mm,
            run.played.settled
        );
        let beyond = run.played.periods.iter().map(|p| p.load[0] - 40_000.0);
        println!("beyond {}", beyond.fold(0.0, f64::max));
    }
}

/// Ticks from a period's beginning to its torques.
#[derive(Default)]
struct Latency {
    began: Option<u64>,
    longest: u64,
}

impl Observer<Controller<2>> for &mut Latency {
    fn sample(&mut self, now: &Sample<'_, Controller<2>>) -> Result<ControlFlow<()>, RunError> {
        if now.w.period_counter.w.enable.get() {
            self.began = Some(now.tick);
        }
        if let (true, Some(began)) = (now.w.axes[0].w.driven.get(), self.began) {
            self.longest = self.longest.max(now.tick - began);
        }
        Ok(ControlFlow::Continue(()))
    }
}

#[test]
fn the_shortest_period_is_what_the_arithmetic_takes() {
    let pieces = [line([0.0, 0.5, 0.0], 100.0), arc(0.5, 3.0, 100.0)];
    let _ = pieces;
    for correction in ALL {
        let settings = settings();
        let machine = [TwoMassParameters::default(); 2];
        let pieces = [arc(1.0, 3.0, 100.0)];
        let program = Program::of([0.0; 3], &pieces, &settings, &machine, &Widths::FULL).unwrap();
        let plants = machine.map(|axis| TwoMassAxis::new(&axis, 1e-6).unwrap());
        let mut latency = Latency::default();
        play(
            &Controller::<2>::new(correction, settings.rounding),
            &program,
            plants,
            &mut latency,
        )
        .unwrap();
        println!("{correction:?} {}", latency.longest);
    }
}
