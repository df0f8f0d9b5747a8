//! Judges a table by playing it tick by tick, with nothing of the compiler's own accounts.

use motion_rtl::circuits::pulse_interpolator::counts;
use motion_rtl::input::{Course, Drawing, Move, Point};
use motion_rtl::jobs::pulse_interpolator::{Report, Settings, StepTiming, Table, compile};
use motion_rtl::plan::Plan;

pub fn line(x: f64, y: f64) -> Move {
    Move {
        to: [x, y, 0.0],
        course: Course::Line,
        rapid: false,
        feed_mm_per_min: None,
        line: 1,
    }
}

pub fn arc(x: f64, y: f64, centre: [f64; 2], clockwise: bool) -> Move {
    Move {
        course: Course::Arc { centre, clockwise },
        ..line(x, y)
    }
}

pub fn drawing(start: Point, mut moves: Vec<Move>) -> Drawing {
    for (k, step) in moves.iter_mut().enumerate() {
        step.line = k + 1;
    }
    Drawing {
        file: "test".into(),
        fourth: Vec::new(),
        zero_length: 0,
        start,
        moves: moves.into_iter().collect(),
        warnings: Vec::new(),
    }
}

/// Step and direction signals of an axis over a whole table.
#[derive(Debug, Default, Clone, Copy)]
pub struct Played {
    pub forward: u64,
    pub backward: u64,
    pub min_high: Option<u64>,
    pub min_low: Option<u64>,
    pub min_setup: Option<u64>,
    pub min_hold: Option<u64>,
    pub idle_turns: usize,
}

/// Plays one axis with a counter and a toggle, as the circuit's description has it.
pub fn play(table: &Table, axis: usize) -> Played {
    let mut out = Played::default();
    let (mut direction, mut turned_at, mut rise, mut fall) = (false, None, None, None);
    let shorter = |a: &mut Option<u64>, b: u64| *a = Some(a.map_or(b, |a| a.min(b)));
    let mut now = 0_u64;
    for (period, words) in table.iter() {
        let word = words[axis];
        if word.negative() != direction {
            direction = word.negative();
            turned_at = Some(now);
            if let Some(rise) = rise {
                shorter(&mut out.min_hold, now - rise);
            }
            out.idle_turns += usize::from(word.half_period() == 0);
        }
        let (mut counter, mut level) = (0, false);
        for tick in 1..=period {
            now += 1;
            counter += 1;
            let equal = counter == word.half_period();
            if equal {
                counter = 0;
            }
            if equal && !level && tick < period {
                level = true;
                if let Some(fall) = fall {
                    shorter(&mut out.min_low, now - fall);
                }
                if let Some(turn) = turned_at.take() {
                    shorter(&mut out.min_setup, now - turn);
                }
                rise = Some(now);
                if direction {
                    out.backward += 1;
                } else {
                    out.forward += 1;
                }
            } else if level && (equal || tick == period) {
                level = false;
                fall = Some(now);
                if let Some(rise) = rise {
                    shorter(&mut out.min_high, now - rise);
                }
            }
        }
    }
    out
}

/// The nearest step, worked out without the crate's fixed-point numbers.
fn rounded(mm: f64, steps_per_mm: f64) -> i64 {
    let sixteenths = (mm * steps_per_mm * 65_536.0).round_ties_even() / 65_536.0;
    sixteenths.round() as i64
}

/// Everything a table must keep, whatever it was made from.
fn judge(path: &Drawing, settings: &Settings, table: &Table, report: &Report) {
    let end = path.moves.last().map_or(path.start, |m| m.to);
    assert_eq!(report.units, table.units());
    assert_eq!(report.total_ticks, table.total_ticks());
    for (k, &scale) in settings.steps_per_mm.iter().enumerate() {
        let (from, to) = (rounded(path.start[k], scale), rounded(end[k], scale));
        let axis = report.axes[k];
        let played = play(table, k);
        let net = played.forward as i64 - played.backward as i64;
        assert_eq!(net, to - from, "axis {k} must end on the demand");
        assert_eq!(axis.steps_demanded, to - from);
        assert_eq!(
            (axis.pulses_forward, axis.pulses_backward),
            (played.forward, played.backward)
        );
        assert_eq!(axis.pulses_emitted(), played.forward + played.backward);
        assert_eq!(i64::from(axis.start_position), from);
        assert_eq!(i64::from(axis.end_position), to);
        let StepTiming {
            step_high_ticks: min_high,
            step_low_ticks: min_low,
            dir_setup_ticks: dir_setup,
            dir_hold_ticks: dir_hold,
        } = settings.timing;
        assert!(
            played.min_high.is_none_or(|t| t >= u64::from(min_high)),
            "{played:?}"
        );
        assert!(
            played.min_low.is_none_or(|t| t >= u64::from(min_low)),
            "{played:?}"
        );
        assert!(
            played.min_setup.is_none_or(|t| t >= u64::from(dir_setup)),
            "{played:?}"
        );
        assert!(
            played.min_hold.is_none_or(|t| t >= u64::from(dir_hold)),
            "{played:?}"
        );
        assert_eq!(
            played.idle_turns, 0,
            "the direction changes only with pulses"
        );
    }
}

/// Follows the table along the plan: no step against the axis's own
/// motion while the path lasts, and no overshoot in the units appended to it.
fn follow(path: &Drawing, settings: &Settings, table: &Table, report: &Report) {
    let plan = Plan::new(path, &settings.motion).unwrap();
    let mut sampler = plan.sampler();
    let mut at = |ticks: u64, k: usize| {
        let time = ticks as f64 / settings.clock_hz as f64;
        sampler.at(time).position[k] * settings.steps_per_mm[k]
    };
    for (k, axis) in report.axes.iter().enumerate() {
        let (mut ticks, mut position, mut from) = (0, i64::from(axis.start_position), at(0, k));
        for (unit, (period, words)) in table.iter().enumerate() {
            ticks += u64::from(period);
            let to = at(ticks, k);
            let pulses = i64::from(counts::pulses(words[k].half_period(), period));
            let step = if words[k].negative() { -pulses } else { pulses };
            position += step;
            assert!(i32::try_from(position).is_ok(), "unit {unit}, axis {k}");
            if unit < report.units - report.appended_units {
                let against = (to - from) * step as f64;
                assert!(
                    against >= 0.0 || (to - from).abs() < 1e-4,
                    "unit {unit}, axis {k}"
                );
            } else {
                let left = i64::from(axis.end_position) - position;
                assert!(left * step >= 0, "overshoot in unit {unit}, axis {k}");
            }
            from = to;
        }
    }
}

/// Ticks of a table that is looked at tick by tick.
const TICK_BY_TICK: u64 = 400_000;

/// The largest distance between steps and demand, tick by tick, against what is reported: between
/// two ticks the demand moves on by `slack` at most.
fn largest_errors(path: &Drawing, settings: &Settings, table: &Table, report: &Report) {
    if table.total_ticks() > TICK_BY_TICK {
        return;
    }
    let plan = Plan::new(path, &settings.motion).unwrap();
    let mut sampler = plan.sampler();
    for (k, axis) in report.axes.iter().enumerate() {
        let mut at = |ticks: u64| {
            let time = ticks as f64 / settings.clock_hz as f64;
            sampler.at(time).position[k] * settings.steps_per_mm[k]
        };
        let (mut now, mut position) = (0, axis.start_position as f64);
        let (mut worst, mut slack, mut demand) = (0.0_f64, 0.0_f64, at(0));
        for (period, words) in table.iter() {
            let half = u64::from(words[k].half_period());
            let step = if words[k].negative() { -1.0 } else { 1.0 };
            for tick in 1..=u64::from(period) {
                now += 1;
                let next = at(now);
                slack = slack.max((next - demand).abs());
                demand = next;
                worst = worst.max((demand - position).abs());
                // The reset at T has priority.
                if half > 0 && tick < u64::from(period) && tick % (2 * half) == half {
                    position += step;
                    worst = worst.max((demand - position).abs());
                }
            }
        }
        let told = axis.following_error.steps;
        let right = told >= worst - 1e-4 && told <= worst + slack + 1e-4;
        assert!(right, "{worst} within {slack}, {axis:?}");
    }
}

pub fn run(path: &Drawing, settings: &Settings) -> (Table, Report) {
    let (table, report) = compile(path, settings).unwrap();
    judge(path, settings, &table, &report);
    follow(path, settings, &table, &report);
    largest_errors(path, settings, &table, &report);
    (table, report)
}
