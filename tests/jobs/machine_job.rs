//! Jobs on the machine of all five circuits.

use motion_rtl::circuits::machine::Machine;
use motion_rtl::circuits::pulse_interpolator::{Group, Variant};
use motion_rtl::hdl::{At, Signals};
use motion_rtl::input::gcode;
use motion_rtl::jobs::machine::job::{Played, machine, play};
use motion_rtl::jobs::machine::{Program, Settings};
use motion_rtl::jobs::pulse_interpolator::job;
use motion_rtl::sim::{Observer, RunError, Sample};
use std::ops::ControlFlow;

/// A line, an arc, rapid moves, pen down and up twice.
const JOB: &str = "G21 G90\nG0 X0.3\nG1 X0.8 Y0.5 F600\nG3 X0.3 Y1 I-0.5 J0\nG0 X0.1 Y0.2\nG1 Y0.6 F600\nG0 X0 Y0\n";

/// Quick servos with next to no load and a quick lift: a move takes some fiftieths of a second.
fn settings() -> Settings {
    let mut settings = Settings {
        acceleration_ms: 10.0,
        k1_per_s: 150.0,
        k2_per_s: 600.0,
        position_gain_per_s: 70.0,
        speed_hz: 50.0,
        integral_ms: 15.0,
        pen_down_counts: 600,
        lift_lead_ms: 10.0,
        ..Settings::default()
    };
    settings.machine.load_inertia_kg_m2 = 1e-5;
    settings.lift.acceleration_counts_per_s2 = 4e6;
    settings.lift.brake_torque_nm = 40.0;
    settings.lift.brake_dead_time_s = 0.004;
    settings
}

fn run(text: &str, settings: &Settings, observer: &mut dyn Observer<Machine>) -> (Program, Played) {
    let drawing = gcode::read("job", text.as_bytes()).expect("a part program");
    let program = Program::of(&drawing, settings).expect("a program");
    let played = play(&machine(settings), &program, settings, observer).expect("a run");
    (program, played)
}

/// The end of a job, to the step and to the count.
fn ends_at(played: &Played, settings: &Settings, mm: [f64; 2]) {
    let counts = mm.map(|mm| (mm * settings.counts_per_mm).round() as i64);
    let steps = [0, 1].map(|k: usize| (mm[k] * settings.steps_per_mm[k]).round() as i64);
    let last = &played.frames[played.frames.len().saturating_sub(3)..];
    let (settled, fault) = (played.settled, played.fault);
    assert!(
        settled && !fault,
        "settled {settled}, fault {fault}, {last:?}"
    );
    assert_eq!(played.command, counts, "commands");
    assert_eq!(played.motor, counts, "encoders");
    assert_eq!(played.stepper, steps, "steppers");
}

/// Invariants of every tick of a run, and the pulses of the step motors.
#[derive(Default)]
struct Watch {
    pulses: Vec<(u64, usize, bool)>,
    before: [bool; 2],
    enables: [u64; 4],
}

/// Where a bit is.
type Bit = fn(&Signals<Machine>) -> At<bool>;

/// An enable, and the one that it leads in a circuit.
const LED: [[Bit; 2]; 5] = [
    [
        |s| s.p.enables.w.unit,
        |s| s.p.pulse_interpolator.w.unit_rst,
    ],
    [|s| s.p.enables.w.scan, |s| s.p.enables.w.scan],
    [|s| s.p.enables.w.ck, |s| s.p.lead_angle.w.ck],
    [
        |s| s.p.enables.w.sample,
        |s| s.p.trajectory_controller.p.period_counter.w.enable,
    ],
    [
        |s| s.p.enables.w.sample,
        |s| s.p.arc_generator.p.sample_counter.w.enable,
    ],
];

/// Step and direction of X and Y.
const LINES: [[Bit; 2]; 2] = [
    [|s| s.w.step_x, |s| s.w.dir_x],
    [|s| s.w.step_y, |s| s.w.dir_y],
];

impl Observer<Machine> for Watch {
    fn sample(&mut self, now: &Sample<'_, Machine>) -> Result<ControlFlow<()>, RunError> {
        for (led, bits) in LED.into_iter().enumerate() {
            let [leads, follows] = bits.map(|bit| now.see(bit));
            assert_eq!(leads, follows, "tick {}", now.tick);
            if let Some(count) = self.enables.get_mut(led) {
                *count += u64::from(leads);
            }
        }
        for (axis, line) in LINES.into_iter().enumerate() {
            let [step, dir] = line.map(|bit| now.see(bit));
            if step && !self.before[axis] {
                self.pulses.push((now.tick, axis, dir));
            }
            self.before[axis] = step;
        }
        Ok(ControlFlow::Continue(()))
    }
}

/// No command jumps, and each goes from where it is.
fn moves_smoothly(played: &Played, settings: &Settings) {
    let fastest = settings.motion.rapid_mm_per_min / 60.0 * settings.counts_per_mm;
    let scans = (settings.sample_s() / settings.scan_s()).ceil();
    let most = fastest * scans * settings.scan_s() + 2.0;
    for pair in played.frames.windows(2) {
        for axis in 0..2 {
            let step = pair[1].command[axis].abs_diff(pair[0].command[axis]);
            assert!(step as f64 <= most, "{step} > {most}: {:?}", pair[1]);
        }
    }
}

#[test]
fn steppers_and_servos_end_at_the_same_point() {
    let settings = settings();
    let (program, played) = run(JOB, &settings, &mut ());
    ends_at(&played, &settings, [0.0; 2]);
    moves_smoothly(&played, &settings);
    assert_eq!(played.moves.len(), program.moves.len());
    // Between the ends both have been around: as far as the arc goes.
    let far = |at: &dyn Fn(usize) -> f64, count: usize| (0..count).map(at).fold(0.0, f64::max);
    let stepper = far(&|k| played.steps[k][1] as f64 / 40.0, played.steps.len());
    let servo = far(
        &|k| played.frames[k].motor[1] as f64 / 1e3,
        played.frames.len(),
    );
    assert!((stepper - 1.0).abs() < 0.03, "{stepper}");
    assert!((servo - 1.0).abs() < 0.01, "{servo}");
}

#[test]
fn a_job_ends_on_the_nearest_step_and_the_nearest_count() {
    let settings = settings();
    let text = "G21 G90\nG1 X0.5 F600\nG2 X0.7004 Y-0.2004 I0 J-0.2004\n";
    let (_, played) = run(text, &settings, &mut ());
    ends_at(&played, &settings, [0.7004, -0.2004]);
    moves_smoothly(&played, &settings);
}

#[test]
fn rates_without_a_common_factor() {
    let settings = Settings {
        unit_ticks: 1999,
        scan_ticks: 383,
        ck_ticks: 41,
        sample_ticks: 409,
        // On the grid of CKs of 41 ticks.
        lift_lead_ms: 10.25,
        ..settings()
    };
    let mut watch = Watch::default();
    let (_, played) = run(JOB, &settings, &mut watch);
    ends_at(&played, &settings, [0.0; 2]);
    moves_smoothly(&played, &settings);
    let due = [1999, 383, 41, 409].map(|period| played.ticks / period);
    assert_eq!(watch.enables, due);
}

#[test]
fn the_pulses_are_those_of_the_pulse_interpolator_alone() {
    let settings = settings();
    let mut watch = Watch::default();
    let (program, _) = run(JOB, &settings, &mut watch);
    struct Alone(Vec<(u64, usize, bool)>, [bool; 2]);
    impl Observer<Group> for Alone {
        fn sample(&mut self, now: &Sample<'_, Group>) -> Result<ControlFlow<()>, RunError> {
            for axis in 0..2 {
                let step = now.see(|s| s.w.step[axis]);
                if step && !self.1[axis] {
                    self.0.push((now.tick, axis, now.see(|s| s.w.dir[axis])));
                }
                self.1[axis] = step;
            }
            Ok(ControlFlow::Continue(()))
        }
    }
    let mut alone = Alone(Vec::new(), [false; 2]);
    let group = job::group(&program.table, Variant::Safe);
    job::play(&group, &program.table, &mut alone).expect("a run");
    assert!(alone.0.len() > 100);
    assert_eq!(watch.pulses, alone.0);
}

#[test]
fn the_lift_learns_its_lead() {
    let settings = settings();
    let text = "G21 G90\n".to_owned() + &"G1 X0.01 F600\nG0 X0\n".repeat(5);
    let (_, played) = run(&text, &settings, &mut ());
    ends_at(&played, &settings, [0.0; 2]);
    for down in [true, false] {
        let errors: Vec<_> = played
            .liftings
            .iter()
            .filter(|lifting| lifting.down == down)
            .map(|lifting| lifting.error.abs())
            .collect();
        assert!(errors.len() >= 4, "{errors:?}");
        assert!(errors[0] > 10, "{errors:?}");
        assert!(errors[errors.len() - 1] <= 4, "{errors:?}");
    }
}
