//! Braked body compared with the closed forms of its equations.

use super::*;
use std::f64::consts::TAU;

const TICK_S: f64 = 1e-5;
const SPEED: f64 = 40_000.0;

/// Round numbers: friction decelerates by 50,000 counts/s², friction and brake by 1,000,000.
const PARAMETERS: BodyParameters = BodyParameters {
    counts_per_rev: 1000.0 * TAU,
    acceleration_counts_per_s2: 400_000.0,
    inertia_kg_m2: 0.1,
    friction_nm: 5.0,
    brake_dead_time_s: 0.012_004,
    brake_torque_nm: 95.0,
    brake_fade: 0.01,
};

fn body() -> BrakedBody {
    BrakedBody::new(&PARAMETERS, TICK_S).expect("they are in range")
}

fn ticks(seconds: f64) -> usize {
    (seconds / TICK_S).round() as usize
}

/// Accelerates to full speed, in the direction of `sign`.
fn moving(body: &mut BrakedBody, sign: f64) {
    for _ in 0..ticks(0.2) {
        body.step(true, sign < 0.0, SPEED, false);
    }
    assert_eq!(body.speed_counts_per_s(), sign * SPEED);
}

/// Returns the counts from the control signal to rest.
fn stop(body: &mut BrakedBody) -> f64 {
    let from = body.position_counts();
    for _ in 0..ticks(0.3) {
        body.step(false, false, 0.0, true);
    }
    assert_eq!(body.speed_counts_per_s(), 0.0);
    body.position_counts() - from
}

/// Returns the stopping distance in closed form, with these decelerations.
fn stop_distance(speed: f64, coasting: f64, braked: f64) -> f64 {
    let dead = PARAMETERS.brake_dead_time_s;
    let bite = speed - coasting * dead;
    speed * dead - 0.5 * coasting * dead * dead + bite * bite / (2.0 * braked)
}

fn assert_near(seen: f64, wanted: f64) {
    assert!((seen - wanted).abs() < 1e-6, "{seen}, not {wanted}");
}

#[test]
fn the_drive_ramps_to_its_speed_and_holds_it() {
    for sign in [1.0, -1.0] {
        let mut body = body();
        for tick in 1..=ticks(0.2) {
            body.step(true, sign < 0.0, SPEED, false);
            let time = tick as f64 * TICK_S;
            let ramp = SPEED / PARAMETERS.acceleration_counts_per_s2;
            let (speed, position) = match time < ramp {
                true => (SPEED * time / ramp, 0.5 * SPEED / ramp * time * time),
                false => (SPEED, SPEED * (time - 0.5 * ramp)),
            };
            assert_near(body.speed_counts_per_s(), sign * speed);
            assert_near(body.position_counts(), sign * position);
        }
        // Back to a lower speed, and through rest to the other direction.
        for _ in 0..ticks(0.2) {
            body.step(true, sign < 0.0, SPEED / 4.0, false);
        }
        assert_eq!(body.speed_counts_per_s(), sign * SPEED / 4.0);
        for _ in 0..ticks(0.2) {
            body.step(true, sign > 0.0, SPEED, false);
        }
        assert_eq!(body.speed_counts_per_s(), -sign * SPEED);
    }
}

/// At its speed, slower, and so slowly that the bearings stop it before the brake engages.
#[test]
fn the_stopping_way_is_what_a_new_brake_takes() {
    for speed in [SPEED, 5_000.0, 500.0, 0.0] {
        let mut body = body();
        for _ in 0..ticks(0.2) {
            body.step(true, false, speed, false);
        }
        let way = stop(&mut body);
        assert_near(way, PARAMETERS.stopping_way_counts(speed));
        assert_eq!(way == 0.0, speed == 0.0);
    }
    let coasts = 500.0 * 500.0 / (2.0 * 50_000.0);
    assert_near(PARAMETERS.stopping_way_counts(500.0), coasts);
    let smooth = BodyParameters {
        friction_nm: 0.0,
        ..PARAMETERS
    };
    let (dead, braking) = (PARAMETERS.brake_dead_time_s, 950_000.0);
    let way = SPEED * dead + SPEED * SPEED / (2.0 * braking);
    assert_near(smooth.stopping_way_counts(SPEED), way);
}

#[test]
fn it_stops_after_dead_time_and_braking() {
    for sign in [1.0, -1.0] {
        let mut body = body();
        moving(&mut body, sign);
        let wanted = stop_distance(SPEED, 5e4, 1e6);
        assert_near(stop(&mut body), sign * wanted);
        // Holds for 0.3 s more, and so does the encoder.
        let channels = body.channels();
        assert_eq!(stop(&mut body), 0.0);
        assert_eq!(body.channels(), channels);
    }
}

#[test]
fn the_brake_bites_when_the_dead_time_is_over_and_lets_go_with_its_signal() {
    let mut body = body();
    moving(&mut body, 1.0);
    let dead = ticks(PARAMETERS.brake_dead_time_s);
    for tick in 0..dead + 3 {
        assert_eq!(body.engaged(), tick > dead, "{tick}");
        let friction = if tick > dead { 100.0 } else { 5.0 };
        assert_near(body.friction_nm(), friction);
        body.step(false, false, 0.0, true);
    }
    let speed = body.speed_counts_per_s();
    body.step(false, false, 0.0, false);
    assert!(!body.engaged());
    assert_near(body.speed_counts_per_s(), speed - 5e4 * TICK_S);
    // The dead time starts again; until it is over the motor still drives.
    for _ in 0..dead {
        body.step(true, false, SPEED, true);
        assert!(!body.engaged());
    }
    assert_eq!(body.speed_counts_per_s(), SPEED);
    // An engaged brake overrides the motor.
    for _ in 0..ticks(0.2) {
        body.step(true, false, SPEED, true);
    }
    assert_eq!(body.speed_counts_per_s(), 0.0);
}

#[test]
fn without_motor_and_brake_it_coasts_to_rest() {
    for sign in [1.0, -1.0] {
        let mut body = body();
        moving(&mut body, sign);
        let from = body.position_counts();
        for _ in 0..ticks(1.0) {
            body.step(false, false, SPEED, false);
        }
        assert_eq!(body.speed_counts_per_s(), 0.0);
        let way = SPEED * SPEED / (2.0 * 5e4);
        assert_near(body.position_counts() - from, sign * way);
    }
    // Without friction it does not stop, and from rest it does not move.
    let free = BodyParameters {
        friction_nm: 0.0,
        ..PARAMETERS
    };
    let mut body = BrakedBody::new(&free, TICK_S).expect("friction may be 0");
    body.step(false, false, SPEED, false);
    assert_eq!(
        (body.position_counts(), body.speed_counts_per_s()),
        (0.0, 0.0)
    );
    moving(&mut body, 1.0);
    body.step(false, false, 0.0, false);
    assert_eq!(body.speed_counts_per_s(), SPEED);
}

#[test]
fn each_braking_takes_its_part_of_the_torque() {
    let mut body = body();
    for braking in 0..5 {
        assert_eq!(body.brakings(), braking);
        moving(&mut body, 1.0);
        let torque = 95.0 * [1.0, 0.99, 0.9801, 0.970_299, 0.960_596_01][braking as usize];
        assert_near(body.brake_torque_nm(), torque);
        assert_near(
            stop(&mut body),
            stop_distance(SPEED, 5e4, 1e4 * (5.0 + torque)),
        );
        body.step(false, false, 0.0, false);
    }
    // A brake that engages at rest does not slip.
    stop(&mut body);
    body.step(false, false, 0.0, false);
    assert_eq!(body.brakings(), 5);
}

#[test]
fn the_load_scales_inertia_friction_and_brake() {
    let mut body = body();
    let load = Load {
        load_inertia_factor: 2.0,
        load_friction_factor: 1.5,
        load_brake_factor: 0.9,
    };
    body.set_load(load).expect("it is in range");
    moving(&mut body, -1.0);
    let per_nm = 1000.0 / (0.1 * 2.0);
    let (coasting, braked) = (7.5 * per_nm, (7.5 + 85.5) * per_nm);
    assert_near(stop(&mut body), -stop_distance(SPEED, coasting, braked));
    body.set_load(Load::default()).expect("it is in range");
    body.step(false, false, 0.0, false);
    assert_near(body.friction_nm(), 5.0);
}

#[test]
fn the_channels_are_those_of_the_position() {
    let mut body = body();
    let mut quarters = Vec::new();
    for _ in 0..ticks(0.01) {
        let channels = body.step(true, true, SPEED, false);
        assert_eq!(channels, body.channels());
        let quarter = (body.position_counts() + 0.5).floor().rem_euclid(4.0) as usize;
        let table = [(false, false), (true, false), (true, true), (false, true)];
        assert_eq!(channels, table[quarter]);
        quarters.push(quarter);
    }
    quarters.dedup();
    // 20 counts backwards from 0.
    assert_eq!(quarters.len(), 21);
    assert!(quarters.windows(2).all(|pair| pair[1] == (pair[0] + 3) % 4));
}

#[test]
fn what_is_out_of_range_is_named() {
    type Choose = fn(&mut BodyParameters) -> &mut f64;
    let faults: [(&str, Choose); 7] = [
        ("counts_per_rev", |p| &mut p.counts_per_rev),
        ("acceleration_counts_per_s2", |p| {
            &mut p.acceleration_counts_per_s2
        }),
        ("inertia_kg_m2", |p| &mut p.inertia_kg_m2),
        ("friction_nm", |p| &mut p.friction_nm),
        ("brake_dead_time_s", |p| &mut p.brake_dead_time_s),
        ("brake_torque_nm", |p| &mut p.brake_torque_nm),
        ("brake_fade", |p| &mut p.brake_fade),
    ];
    for (field, of) in faults {
        for value in [-1.0, f64::NAN, f64::INFINITY] {
            let mut bad = PARAMETERS;
            *of(&mut bad) = value;
            assert_eq!(bad.ranges().expect_err(field).field, field);
            assert!(BrakedBody::new(&bad, TICK_S).is_err());
        }
    }
    assert!(BrakedBody::new(&PARAMETERS, 0.0).is_err());
    let load = Load {
        load_brake_factor: 0.0,
        ..Load::default()
    };
    let error = body().set_load(load).expect_err("no brake");
    assert_eq!(
        error.to_string(),
        "load_brake_factor: is 0; allowed: 0.001 to 1000"
    );
}
