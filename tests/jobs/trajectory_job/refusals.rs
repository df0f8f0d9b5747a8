//! Refused settings, with the reasons.

use super::*;
use motion_rtl::jobs::trajectory_controller::each_axis::EachAxis;
use motion_rtl::jobs::trajectory_controller::job::ProgramError;
use motion_rtl::jobs::trajectory_controller::load_torque::{AxisName, LoadTorque};
use motion_rtl::settings::Place;

fn program(
    pieces: &[Piece],
    settings: &Settings,
    machine: &[TwoMassParameters],
) -> Result<Program, ProgramError> {
    Program::of([0.0; 3], pieces, settings, machine, &Widths::FULL)
}

#[test]
fn an_axis_that_does_not_fit_is_named() {
    type Change = fn(&mut Settings, &mut TwoMassParameters);
    let changes: [(&str, Change); 12] = [
        ("position_gain_per_s", |s, _| s.position_gain_per_s = 0.0),
        ("position_gain_per_s", |s, _| s.position_gain_per_s = 1e4),
        ("position_gain_per_s", |s, _| {
            s.position_gain_per_s = f64::NAN
        }),
        ("speed_hz", |s, _| s.speed_hz = -1.0),
        ("speed_hz", |s, _| s.speed_hz = 1e6),
        ("speed_hz", |_, axis| {
            axis.load_inertia_kg_m2 = 1e-9;
            axis.motor_inertia_kg_m2 = 1e-9;
            axis.max_torque_nm = 1000.0;
        }),
        ("integral_ms", |s, _| s.integral_ms = -1.0),
        ("integral_ms", |s, _| s.integral_ms = 1e8),
        ("integral_ms", |s, _| s.integral_ms = 1e-3),
        ("max_torque_nm", |_, axis| axis.max_torque_nm = 0.1),
        ("mm_per_rev", |_, axis| axis.mm_per_rev = 5.0),
        ("stiffness_nm_per_rad", |_, axis| {
            axis.stiffness_nm_per_rad = 0.0
        }),
    ];
    let pieces = [line([1.0, 0.0, 0.0], 10.0)];
    for (index, (field, change)) in changes.into_iter().enumerate() {
        let (mut settings, mut bad) = (settings(), TwoMassParameters::default());
        change(&mut settings, &mut bad);
        let error = program(&pieces, &settings, &[TwoMassParameters::default(), bad]).unwrap_err();
        let ProgramError::Setting(error) = error else {
            panic!("{error}")
        };
        assert_eq!(error.field, field, "{index}");
        let of_axis = ["max_torque_nm", "mm_per_rev", "stiffness_nm_per_rad"].contains(&field);
        assert_eq!(error.place, of_axis.then_some(Place::Row("axis", 1)));
        assert!(!error.to_string().contains("NaN to"), "{error}");
    }
    let weak = TwoMassParameters {
        max_torque_nm: 0.1,
        ..TwoMassParameters::default()
    };
    let text = program(&pieces, &settings(), &[weak; 2])
        .unwrap_err()
        .to_string();
    assert_eq!(
        text,
        "axis 0: max_torque_nm: is 0.1: its gain word is 19760000, above 16777215; allowed: 0.1179 to 1974000"
    );
    // The limits named in the messages are allowed.
    for max_torque_nm in [0.1179, 3000.0] {
        let axis = TwoMassParameters {
            max_torque_nm,
            ..weak
        };
        assert!(program(&pieces, &settings(), &[axis; 2]).is_ok());
    }
    let fast = Settings {
        speed_hz: 1e6,
        ..settings()
    };
    let good = [TwoMassParameters::default(); 2];
    assert_eq!(
        program(&pieces, &fast, &good).unwrap_err().to_string(),
        "speed_hz: is 1000000: its gain word is 1242000000, above 16777215; allowed: 0.0008061 to 13500"
    );
    let none = Settings {
        integral_ms: 0.0,
        ..settings()
    };
    assert_eq!(program(&pieces, &none, &good).unwrap().servo[0].integral, 0);
}

#[test]
fn torques_from_outside_and_parts_of_the_inertia_are_checked() {
    let pieces = [line([1.0, 0.0, 0.0], 10.0)];
    let good = [TwoMassParameters::default(); 2];
    let torque = LoadTorque {
        axis: AxisName::X,
        torque_nm: 1.0,
        from_s: 0.5,
        to_s: None,
    };
    type Change = fn(&mut LoadTorque);
    let changes: [(Change, &str); 7] = [
        (|t| t.axis = AxisName::Z, "axis: is z; allowed: one of x, y"),
        (
            |t| t.torque_nm = f64::NAN,
            "torque_nm: is NaN; allowed: -1000000000 to 1000000000",
        ),
        (
            |t| t.torque_nm = -1.1e9,
            "torque_nm: is -1100000000; allowed: -1000000000 to 1000000000",
        ),
        (
            |t| t.from_s = -0.1,
            "from_s: is -0.1; allowed: 0 to 1000000",
        ),
        (
            |t| t.to_s = Some(0.5),
            "to_s: is 0.5; allowed: above from_s, 0.5, to 1000000",
        ),
        (
            |t| t.to_s = Some(f64::NAN),
            "to_s: is NaN; allowed: above from_s, 0.5, to 1000000",
        ),
        (
            |t| t.to_s = Some(1.1e6),
            "to_s: is 1100000; allowed: above from_s, 0.5, to 1000000",
        ),
    ];
    for (change, text) in changes {
        let mut bad = torque;
        change(&mut bad);
        let settings = Settings {
            load_torque: vec![torque, bad],
            ..settings()
        };
        let error = program(&pieces, &settings, &good).unwrap_err();
        assert_eq!(error.to_string(), format!("load_torque 1: {text}"));
    }
    let told = |inertia_factor: EachAxis| {
        let settings = Settings {
            inertia_factor,
            ..settings()
        };
        program(&pieces, &settings, &good)
    };
    for (factor, text) in [
        (EachAxis::All(-0.1), "is -0.1; allowed: 0 to 100"),
        (
            EachAxis::Each(vec![1.0, 101.0]),
            "is 101 for y; allowed: 0 to 100",
        ),
        (
            EachAxis::Each(vec![1.0; 3]),
            "is a list of 3; allowed: a number for all axes, or a list of 2",
        ),
        (
            EachAxis::Each(vec![]),
            "is a list of 0; allowed: a number for all axes, or a list of 2",
        ),
    ] {
        let error = told(factor).unwrap_err();
        assert_eq!(error.to_string(), format!("inertia_factor: {text}"));
    }
    let words = told(EachAxis::Each(vec![0.5, 0.0])).unwrap().servo;
    let whole = program(&pieces, &settings(), &good).unwrap().servo;
    assert_eq!(
        (words[0].inertia, words[1].inertia),
        (whole[0].inertia.div_ceil(2), 0)
    );
    assert_eq!(
        (words[0].speed, words[1].integral),
        (whole[0].speed, whole[1].integral)
    );
}

#[test]
fn two_or_three_axes() {
    let pieces = [line([1.0, 0.0, 0.0], 10.0)];
    for count in [0, 1, 4] {
        let machine = vec![TwoMassParameters::default(); count];
        let text = program(&pieces, &settings(), &machine)
            .unwrap_err()
            .to_string();
        assert_eq!(text, format!("axes: is {count}; allowed: 2 or 3"));
    }
    let lifted = [line([1.0, 0.0, 0.0], 10.0), line([1.0, 0.0, 2.0], 10.0)];
    let good = [TwoMassParameters::default(); 3];
    assert!(program(&lifted, &settings(), &good).is_ok());
    assert_eq!(
        program(&lifted, &settings(), &good[..2])
            .unwrap_err()
            .to_string(),
        "piece 1: leaves the plane of x and y by 2 mm; \
         allowed: the height of the start, or three axes"
    );
    let over = Circle::through([0.0; 3], [5.0, 0.0, 1.0], [10.0, 0.0, 0.0]).unwrap();
    let over = Piece {
        course: Course::Arc(over),
        ..line([10.0, 0.0, 0.0], 10.0)
    };
    assert!(program(&[over], &settings(), &good[..2]).is_err());
    assert!(program(&[over], &settings(), &good).is_ok());
}

#[test]
fn settings_and_paths_are_checked_too() {
    let good = [TwoMassParameters::default(); 2];
    let pieces = [line([1.0, 0.0, 0.0], 10.0)];
    let short = Settings {
        period_ms: 0.1,
        ..settings()
    };
    let text = program(&pieces, &short, &good).unwrap_err().to_string();
    assert!(text.starts_with("period_ms: "), "{text}");
    assert!(matches!(
        program(&[], &settings(), &good),
        Err(ProgramError::Path(_))
    ));
    // Half of W's range is for the corrected command.
    let far = |mm: f64| [line([mm, 0.0, 0.0], 1e5)];
    assert!(program(&far(536_870.0), &settings(), &good).is_ok());
    assert_eq!(
        program(&far(-536_871.0), &settings(), &good)
            .unwrap_err()
            .to_string(),
        "piece 0: x from the start reaches -536871000.0 counts, which needs W = 32; \
         allowed: -536870911 to 536870911 counts at W = 31: fewer counts per mm"
    );
    let path = Program::of(
        [500_000.0, 0.0, 0.0],
        &[line([1_036_000.0, 0.0, 0.0], 1e5)],
        &settings(),
        &good,
        &Widths::FULL,
    );
    assert!(path.is_ok());
}

#[test]
fn the_gains_are_those_of_the_axis() {
    let pieces = [line([1.0, 0.0, 0.0], 10.0)];
    let good = [TwoMassParameters::default(); 2];
    let program = program(&pieces, &settings(), &good).unwrap();
    let [x, y, others @ ..] = program.servo;
    assert_eq!(x, y);
    assert_eq!(others, [Default::default(); 2]);
    // 30/s in a millisecond; 3·10^-3 kg·m²; 10 N·m are 32,767.
    assert_eq!(x.position, (0.03 * f64::from(1 << 23)).round() as u64);
    assert_eq!(x.limit, 32_767);
    let torque = |word: u64| word as f64 / f64::from(1 << 21) / 32_767.0 * 10.0;
    // Torque for a count a millisecond and a count a millisecond squared, in rad/s.
    let rad_per_s = std::f64::consts::TAU / 10_000.0 * 1e3;
    let speed = torque(x.speed) * COUNT / rad_per_s;
    let inertia = torque(x.inertia) * COUNT / (rad_per_s * 1e3);
    let integral = torque(x.integral) * COUNT / rad_per_s / 1e-3;
    let close = |seen: f64, exact: f64| assert!((seen / exact - 1.0).abs() < 1e-3, "{seen}");
    close(inertia, 3e-3);
    close(speed, 3e-3 * std::f64::consts::TAU * 17.0);
    close(integral, speed / 0.04);
}
