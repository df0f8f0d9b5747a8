//! Drawings as positioning cycles: positions, speeds, times, and what is refused.

mod cycles;
mod refusals;

use motion_rtl::input::{Course, Drawing, Move};
use motion_rtl::jobs::linear_interpolator::settings::Settings;
use motion_rtl::jobs::linear_interpolator::targets::{Targets, compile};

fn move_to(x: f64, y: f64) -> Move {
    Move {
        to: [x, y, 0.0],
        course: Course::Line,
        rapid: false,
        feed_mm_per_min: None,
        line: 1,
    }
}

fn drawing(moves: Vec<Move>) -> Drawing {
    Drawing {
        file: "d".into(),
        start: [0.0; 3],
        moves: moves.into_iter().collect(),
        fourth: Vec::new(),
        zero_length: 0,
        warnings: Vec::new(),
    }
}

/// Changes one move.
fn change(drawing: &mut Drawing, index: usize, change: impl FnOnce(&mut Move)) {
    let mut moves: Vec<Move> = drawing.moves.iter().collect();
    change(&mut moves[index]);
    drawing.moves = moves.into_iter().collect();
}

fn lines(points: &[[f64; 2]]) -> Drawing {
    let moves = points.iter().enumerate().map(|(k, [x, y])| Move {
        line: k + 1,
        ..move_to(*x, *y)
    });
    drawing(moves.collect())
}

fn compiled(drawing: &Drawing, change: impl FnOnce(&mut Settings)) -> Targets {
    let mut settings = Settings::default();
    change(&mut settings);
    compile(drawing, &settings).unwrap()
}

fn circle(radius: f64, sweep_to: [f64; 2], clockwise: bool) -> Drawing {
    let mut arc = move_to(sweep_to[0], sweep_to[1]);
    arc.course = Course::Arc {
        centre: [radius, 0.0],
        clockwise,
    };
    drawing(vec![arc])
}
