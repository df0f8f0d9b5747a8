//! Path errors of both machines, with their reasons: runs written by hand, of known distances.

use motion_rtl::input::{Drawing, read_text};
use motion_rtl::jobs::machine::job::{Frame, Played, Timed};
use motion_rtl::jobs::machine::measure::{Farthest, Measured, Reason, Servos};
use motion_rtl::jobs::machine::{Program, Settings};
use motion_rtl::plan::Plan;

/// Guard units of a count.
const COUNT: i64 = 1 << 16;

/// Steps of 1/40 mm in x and 1/80 mm in y, counts of 1 um.
fn settings() -> Settings {
    Settings {
        steps_per_mm: [40.0, 80.0],
        ..Settings::default()
    }
}

/// A job, and a run in which nothing has moved.
struct Case {
    drawing: Drawing,
    settings: Settings,
    program: Program,
    played: Played,
}

impl Case {
    fn new(text: &str, settings: Settings) -> Self {
        let drawing = read_text("p.ngc", text.as_bytes()).unwrap();
        let program = Program::of(&drawing, &settings).unwrap();
        Case {
            drawing,
            settings,
            program,
            played: Played::default(),
        }
    }

    fn measured(&self) -> Measured {
        Measured::of(&self.drawing, &self.program, &self.settings, &self.played).unwrap()
    }

    /// Steppers on the step nearest to the plan at the end of every unit time.
    fn step_as_planned(&mut self) {
        let plan = Plan::new(&self.drawing, &self.settings.motion).unwrap();
        let mut sampler = plan.sampler();
        let unit_ticks = u64::from(self.settings.unit_ticks);
        for unit in 1..=self.program.table.units() as u64 {
            let seconds = (unit * unit_ticks) as f64 / self.settings.clock_hz as f64;
            let at = sampler.at(seconds).position;
            let per_mm = self.settings.steps_per_mm;
            let steps = [0, 1].map(|k: usize| (at[k] * per_mm[k]).round() as i64);
            self.played.steps.push(steps);
            self.played.step_ticks.push(7 + unit * unit_ticks);
        }
    }

    /// A move of the servos with one sampling time, at these offsets from `at`, in counts.
    fn servos(&mut self, index: usize, at: [i64; 2], offsets: [[i64; 2]; 4]) -> Servos {
        let begun = 10_000 * (index as u64 + 1);
        self.played.moves = (0..=index as u64)
            .map(|index| Timed {
                begun: 10_000 * (index + 1),
                ended: 10_000 * (index + 1) + 5000,
            })
            .collect();
        let [command, model, motor, load] = offsets.map(|off| [at[0] + off[0], at[1] + off[1]]);
        let frame = |tick, moving| Frame {
            tick,
            index,
            moving,
            command,
            corrected: [0; 2],
            model: model.map(|counts| counts * COUNT),
            motor,
            load: load.map(|counts| counts as f64),
            lift: 0,
        };
        self.played.frames = vec![
            frame(begun + 400, true),
            frame(begun + 3000, true),
            frame(begun + 3400, false),
        ];
        let measured = self.measured();
        measured.pieces[index].servos.clone().unwrap()
    }
}

#[track_caller]
fn near(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-9, "{value}, not {expected}");
}

#[track_caller]
fn is(found: Farthest, um: f64, reason: Reason, share_um: f64) {
    assert_eq!(found.reason, Some(reason), "{found:?}");
    near(found.um, um);
    near(found.share_um, share_um);
}

#[test]
fn of_the_servos_the_largest_share_is_named() {
    // Across a way along (4, 3) is (-3, 4).
    let mut case = Case::new("G1 X8 Y6 F1200\n", settings());
    let mut on = |offsets| case.servos(0, [4000, 3000], offsets);
    let far = on([[0, 0], [-6, 8], [-9, 12], [-24, 32]]);
    near(far.command_um, 0.0);
    near(far.model_um, 10.0);
    near(far.motor_um, 15.0);
    is(far.load, 40.0, Reason::Shaft, 25.0);
    assert_eq!(far.ticks, 10_000..=15_000);
    assert_eq!(far.load.tick, 13_400);
    let far = on([[0, 0], [-24, 32], [-9, 12], [-12, 16]]);
    is(far.load, 20.0, Reason::Lag, 40.0);
    let far = on([[0, 0], [3, -4], [-12, 16], [-9, 12]]);
    is(far.load, 15.0, Reason::Motor, 25.0);
    // (-1, 1) is 1.4 across.
    let far = on([[-1, 1], [-1, 1], [-1, 1], [-1, 1]]);
    is(far.load, 1.4, Reason::WholeCounts, 1.4);
    // Beyond the end.
    let far = case.servos(0, [8000, 6000], [[0, 0], [0, 0], [0, 0], [4, 3]]);
    is(far.load, 5.0, Reason::Shaft, 5.0);
}

#[test]
fn axes_are_told_apart() {
    let mut case = Case::new("G1 X8 F1200\n", settings());
    let far = case.servos(0, [4000, 0], [[0, 0], [7, 0], [9, 0], [9, 30]]);
    is(far.load, 30.0, Reason::Shaft, 30.0);
    let far = case.servos(0, [4000, 0], [[0, 0], [0, 0], [0, 0], [30, 0]]);
    let on_path = (far.load.reason, far.load.share_um);
    assert_eq!(on_path, (None, 0.0), "{far:?}");
    near(far.load.um, 0.0);
}

#[test]
fn the_lag_is_measured_against_the_command_of_the_same_place() {
    let mut case = Case::new("G1 X8 F1200\n", settings());
    case.servos(0, [4000, 0], [[0, 0], [0, 2], [0, 2], [0, 2]]);
    // The model is where the command was before, which was as far off.
    case.played.frames[0].command = [4000, 2];
    case.played.frames[1].command = [6000, 0];
    case.played.frames[2].command = [8000, 0];
    case.played.frames[1].load = [4000.0, 2.5];
    let measured = case.measured();
    let far = measured.pieces[0].servos.clone().unwrap();
    is(far.load, 2.5, Reason::WholeCounts, 2.0);
    near(far.command_um, 2.0);
}

#[test]
fn an_arc_is_left_by_its_blends() {
    // A quarter around (0, 5); at its end inwards is (-1, 0).
    let mut case = Case::new("G3 X5 Y5 I0 J5 F600\n", settings());
    let far = case.servos(0, [5000, 5000], [[-20, 0], [-21, 0], [-21, 0], [-21, 0]]);
    is(far.load, 21.0, Reason::Blend, 20.0);
    near(far.command_um, 20.0);
    let far = case.servos(0, [5000, 5000], [[-1, 0], [-1, 0], [-1, 0], [-1, 0]]);
    is(far.load, 1.0, Reason::WholeCounts, 1.0);
}

#[test]
fn steppers_stand_on_whole_steps() {
    // 0.4 of a step in y.
    let mut case = Case::new("G0 Y0.005\nG1 X8 F1200\n", settings());
    case.step_as_planned();
    let measured = case.measured();
    is(
        measured.pieces[1].steppers.farthest.unwrap(),
        5.0,
        Reason::WholeSteps,
        5.0,
    );
    let ticks = &measured.pieces[1].steppers.ticks;
    // The table begins in tick 7; 8 mm at 20 mm/s and a ramp of 40 ms.
    let (begin, end) = (*ticks.start(), *ticks.end());
    let seconds = (end - begin) as f64 / 400_000.0;
    assert!((seconds - 0.44).abs() < 0.011, "{begin} to {end}");
    assert_eq!(
        measured.times.steppers,
        2000 * case.program.table.units() as u64
    );

    // A step of y is 12.5 um; three are made up for later.
    let middle = case.played.steps.len() / 2;
    case.played.steps[middle][1] += 3;
    let found = case.measured().pieces[1].steppers.farthest.unwrap();
    // The line is 5 um above the step.
    is(found, 32.5, Reason::Table, 37.5);
    assert_eq!(found.tick, 7 + 2000 * (middle as u64 + 1));
    // One of x is along the way.
    case.played.steps[middle] = [case.played.steps[middle][0] + 3, 0];
    let found = case.measured().pieces[1].steppers.farthest.unwrap();
    is(found, 5.0, Reason::WholeSteps, 5.0);
}

#[test]
fn between_unit_times_steppers_go_straight_on() {
    let mut fine = settings();
    (fine.steps_per_mm, fine.unit_ticks) = ([1000.0; 2], 8000);
    let mut case = Case::new("G3 X0 Y0 I2 J0 F1500\n", fine);
    case.step_as_planned();
    let found = case.measured().pieces[0].steppers.farthest.unwrap();
    assert_eq!(found.reason, Some(Reason::Chord));
    // v = 25 mm/s, T = 20 ms, R = 2 mm.
    let sagitta = (25.0f64 * 0.02).powi(2) / (8.0 * 2.0);
    assert!((found.share_um / 1e3 - sagitta).abs() < 0.0005, "{found:?}");
}

#[test]
fn a_corner_within_a_unit_time_is_cut() {
    let mut fast = settings();
    fast.steps_per_mm = [1000.0; 2];
    fast.motion.corner_mm_per_min = 6000.0;
    fast.unit_ticks = 8000;
    let mut case = Case::new("G1 X8.2 F1500\nG1 Y8\n", fast);
    case.step_as_planned();
    let measured = case.measured();
    let far = [0, 1].map(|piece: usize| measured.pieces[piece].steppers.farthest.unwrap());
    let cut = if far[0].um > far[1].um {
        far[0]
    } else {
        far[1]
    };
    assert_eq!(cut.reason, Some(Reason::Chord));
    // At most a quarter of the way of a unit time from either.
    assert!(cut.um > 5.0 && cut.um <= 250.0 * 25.0 * 0.02, "{cut:?}");
}

/// Frames of a long move are not all kept: those around the farthest load are.
#[test]
fn a_long_move_is_measured_around_its_farthest_load() {
    const FRAMES: i64 = 100_000;
    let mut case = Case::new("G1 X8 F1200\n", settings());
    let frame = |number: i64, load: f64| {
        let x = 8000 * number / FRAMES;
        let aside = if load > 0.0 { 3 } else { 0 };
        Frame {
            tick: 10_000 + number as u64,
            index: 0,
            moving: number < 99_000,
            command: [x, 0],
            corrected: [0; 2],
            model: [x * COUNT, aside * COUNT],
            motor: [x, aside],
            load: [x as f64, load],
            lift: 0,
        }
    };
    let mut far = |farthest: i64, load: f64| {
        let of = |number: i64| match number.abs_diff(farthest) {
            0 => load,
            1..30 => 3.5,
            _ if number == 30_000 => 4.0,
            _ => 0.0,
        };
        case.played.frames = (0..FRAMES).map(|k| frame(k, of(k))).collect();
        case.played.moves = vec![Timed {
            begun: 10_000,
            ended: 120_000,
        }];
        let measured = case.measured();
        assert_eq!(
            (measured.times.moving, measured.times.settling),
            (98_999, 11_001)
        );
        measured.pieces[0].servos.clone().unwrap().load
    };
    for (farthest, load) in [(10, 9.0), (20_000, 6.0), (30_500, 5.0), (99_990, 8.0)] {
        let found = far(farthest, load);
        assert_eq!(found.tick, 10_000 + farthest as u64);
        let reason = if load > 6.0 {
            Reason::Shaft
        } else {
            Reason::Lag
        };
        is(found, load, reason, (load - 3.0).max(3.0));
    }
}

#[test]
fn times_are_split() {
    let mut case = Case::new("G1 X8 F1200\nG1 Y8\n", settings());
    case.servos(1, [8000, 0], [[0; 2]; 4]);
    let times = case.measured().times;
    // Without frames the first move stood at once.
    assert_eq!(
        (times.moving, times.settling, times.servos),
        (3000, 5000 + 2000, 25_000)
    );
}

#[test]
fn both_ends_are_judged_by_the_nearest_step_and_count() {
    let mut case = Case::new("G1 X8 Y0.005 F1200\n", settings());
    (case.played.stepper, case.played.command, case.played.motor) =
        ([320, 0], [8000, 5], [8000, 5]);
    let ends = case.measured().ends;
    assert!(ends.exact);
    assert_eq!(ends.end_mm, [8.0, 0.005]);
    let servo = ([8.0, 0.005], [8000, 5], [8000, 5], "counts");
    let seen = ends
        .ends
        .map(|end| (end.mm, end.position, end.wanted, end.unit));
    assert_eq!(
        seen,
        [([8.0, 0.0], [320, 0], [320, 0], "steps"), servo, servo]
    );
    assert_eq!(
        ends.ends.map(|end| end.what),
        ["steppers", "commands", "encoders"]
    );
    near(ends.apart_um, 5.0);
    let wrong: [fn(&mut Played); 5] = [
        |played| played.stepper = [0, 320],
        |played| played.stepper[1] += 1,
        |played| played.command[0] -= 1,
        |played| played.motor[1] += 1,
        |played| played.motor = [5, 8000],
    ];
    for wrong in wrong {
        let good = case.played.clone();
        wrong(&mut case.played);
        assert!(!case.measured().ends.exact);
        case.played = good;
    }
}
