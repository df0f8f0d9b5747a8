//! Paths on the trajectory controller, with motors and loads.

mod circle;
mod disturbance;
mod feedback;
mod four;
mod measure;
mod paths;
mod refusals;
mod servo;
mod splines;
mod tolerance;
mod unequal;

use motion_rtl::circuits::trajectory_controller::Widths;
use motion_rtl::jobs::trajectory_controller::job::{Played, Program, controller, play};
use motion_rtl::jobs::trajectory_controller::settings::{Correction, LEAST_PERIOD_TICKS, Settings};
use motion_rtl::path::circle::Circle;
use motion_rtl::path::pieces::{Course, Piece};
use motion_rtl::plant::{TwoMassAxis, TwoMassParameters};

type Point = [f64; 3];

/// Guard units of a count, and of a millimetre.
const COUNT: f64 = 65_536.0;
const MM: f64 = 1000.0 * COUNT;

/// 1 ms in as few ticks as are allowed, K1 and K2 of 50 and 200/s.
fn settings() -> Settings {
    Settings {
        clock_hz: 1000 * LEAST_PERIOD_TICKS,
        ..Settings::default()
    }
}

fn line(to: Point, speed: f64) -> Piece {
    Piece {
        course: Course::Line,
        to,
        speed,
        line: None,
    }
}

/// An arc in the plane of x and y, from the origin upwards, around a centre on x.
fn arc(radius: f64, angle: f64, speed: f64) -> Piece {
    let circle = Circle {
        centre: [-radius, 0.0, 0.0],
        axis: [0.0, 0.0, 1.0],
        start: [0.0; 3],
        radius,
        angle,
    };
    Piece {
        course: Course::Arc(circle),
        ..line(circle.end(), speed)
    }
}

/// A program and its run on machines.
struct Run {
    machines: Vec<TwoMassParameters>,
    program: Program,
    played: Played,
}

/// Motors and loads at rest.
fn plants(machine: &[TwoMassParameters], tick_s: f64) -> Vec<TwoMassAxis> {
    let plants = machine.iter().map(|axis| TwoMassAxis::new(axis, tick_s));
    plants.collect::<Result<_, _>>().unwrap()
}

fn run(
    start: Point,
    pieces: &[Piece],
    settings: &Settings,
    machine: &[TwoMassParameters],
    correction: Correction,
) -> Run {
    let program = Program::of(start, pieces, settings, machine, &Widths::FULL).unwrap();
    let tick_s = 1.0 / settings.clock_hz as f64;
    let circuit = controller(machine.len(), correction, settings.rounding);
    let played = play(&circuit, &program, plants(machine, tick_s), &mut ()).unwrap();
    assert!(!played.late && !played.starved && !played.lost);
    Run {
        machines: machine.to_vec(),
        program,
        played,
    }
}

const ALL: [Correction; 3] = [Correction::None, Correction::Vector, Correction::Steady];
