//! Paths on the trajectory controller, with motors and loads.

use motion_rtl::arc_generator::circle::Circle;
use motion_rtl::arc_generator::path::{Course, Piece};
use motion_rtl::plant::{TwoMassAxis, TwoMassParameters};
use motion_rtl::trajectory_controller::closed::Steady;
use motion_rtl::trajectory_controller::job::{Controller, Played, Program, play};
use motion_rtl::trajectory_controller::measure::Measured;
use motion_rtl::trajectory_controller::settings::{Correction, Settings};

use motion_rtl::trajectory_controller::widths::Widths;

type Point = [f64; 3];

fn circle(radius: f64, speed: f64) -> Vec<Piece> {
    let circle = Circle {
        centre: [-radius, 0.0, 0.0],
        axis: [0.0, 0.0, 1.0],
        start: [0.0; 3],
        radius,
        angle: std::f64::consts::TAU,
    };
    vec![Piece {
        course: Course::Arc(circle),
        to: [0.0; 3],
        speed,
        line: None,
    }]
}

fn run<const AXES: usize>(
    start: Point,
    pieces: &[Piece],
    settings: &Settings,
    machine: [TwoMassParameters; AXES],
    correction: Correction,
) -> (Program, Played<AXES>) {
    let program = Program::of(start, pieces, settings, &machine, &Widths::FULL).unwrap();
    let tick_s = 1.0 / settings.clock_hz as f64;
    let plants = machine.map(|axis| TwoMassAxis::new(&axis, tick_s).unwrap());
    let circuit = Controller::<AXES>::new(correction, settings.rounding);
    let played = play(&circuit, &program, plants, ()).unwrap();
    (program, played)
}

#[test]
fn look() {
    for correction in [Correction::None, Correction::Vector, Correction::Steady] {
        let started = std::time::Instant::now();
        let settings = Settings::default();
        let machine = [TwoMassParameters::default(); 2];
        let (program, played) = run(
            [0.0; 3],
            &circle(10.0, 100.0),
            &settings,
            machine,
            correction,
        );
        println!(
            "{:?} {} ticks {}",
            started.elapsed(),
            played.ticks,
            played.periods.len()
        );
        println!("{:?}", program.servo);
        let Played {
            late,
            starved,
            lost,
            settled,
            ..
        } = played;
        println!("{late} {starved} {lost} {settled}");
        let measured = Measured::of(&program, &played).unwrap();
        let steady = Steady::of(&program, &played).unwrap();
        println!("{steady:?}");
        for errors in [&measured.model, &measured.motor, &measured.load] {
            println!(
                "contour {:?} rms {} final {} steady {}",
                errors.contour,
                errors.contour_rms_mm,
                errors.final_mm,
                steady.mean_mm(errors)
            );
        }
        let mut worst = [0.0f64; 2];
        for p in &played.periods {
            for k in 0..2 {
                let model = p.model[k] as f64 / 65536.0;
                worst[0] = worst[0].max((p.motor[k] as f64 - model).abs());
                worst[1] = worst[1].max((p.load[k] - model).abs());
            }
        }
        println!(
            "motor, load off model {worst:?} counts; torque {:?} {:?}",
            measured.torque, measured.saturated
        );
        for p in played.periods.iter().step_by(20) {
            println!(
                "{:?}",
                (
                    p.length >> 16,
                    p.model.map(|m| m >> 16),
                    p.motor,
                    p.load,
                    p.torque
                )
            );
        }
    }
}
