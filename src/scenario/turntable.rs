//! The shipped scenario of the lead-angle compensator covers what it is to show.

use super::{Loaded, Scenario};
use crate::circuits::lead_angle::codes::{STAGES, code, neighbours};
use crate::jobs::lead_angle::settings::{Settings, Step};
use crate::plant::BrakedBody;

/// The scenario that ships.
fn turntable() -> Settings {
    let text = include_str!("../../waves/turntable.toml");
    let loaded = Loaded::parse("turntable.toml", text, &[]).expect("it ships");
    let Scenario::LeadAngle(scenario) = &loaded.scenario else {
        panic!("another circuit");
    };
    scenario.settings.clone()
}

/// A positioning with an ideal lead: the lead time it took in milliseconds, and how long the speed
/// had been constant before the control signal.
fn position(body: &mut BrakedBody, step: &Step, tick_s: f64) -> [f64; 2] {
    let speed = f64::from(step.speed_counts_per_s);
    let target = step.target as f64;
    let sign = (target - body.position_counts()).signum();
    for _ in 0..(1.0 / tick_s) as usize {
        body.step(true, sign < 0.0, speed, false);
        if body.speed_counts_per_s() == sign * speed {
            break;
        }
    }
    assert_eq!(body.speed_counts_per_s(), sign * speed);
    // The stop from a speed that stays is always the same.
    let stop = |body: &mut BrakedBody| {
        let from = body.position_counts();
        while body.speed_counts_per_s() != 0.0 {
            body.step(false, false, 0.0, true);
        }
        (body.position_counts() - from).abs()
    };
    let way = stop(&mut body.clone());
    let mut ticks = 0;
    while (target - body.position_counts()) * sign > way {
        body.step(true, sign < 0.0, speed, false);
        ticks += 1;
    }
    stop(body);
    assert!((body.position_counts() - target).abs() <= speed * tick_s);
    // The brake is released.
    body.step(false, false, 0.0, false);
    [way / speed * 1e3, f64::from(ticks) * tick_s * 1e3]
}

#[test]
fn the_scenario_that_ships_spans_the_codes() {
    let settings = turntable();
    assert_eq!(settings.validate(), Ok(()));
    let tick_s = 1.0 / settings.clock_hz as f64;
    let mut body = BrakedBody::new(&settings.body, tick_s).expect("they are in range");
    let change = settings.load_change_after.expect("it has a change");
    let steps = settings.steps.len() as u32;
    // Each step six times before the load changes, and six times after.
    assert!(change >= 6 * steps && settings.positionings - change >= 6 * steps);
    assert_eq!(change % steps, 0);
    let mut ratios = Vec::new();
    let mut fixed = Vec::new();
    for number in 0..settings.positionings {
        if number == change {
            body.set_load(settings.load).expect("it is in range");
        }
        let step = &settings.steps[(number % steps) as usize];
        let [lead_ms, constant_ms] = position(&mut body, step, tick_s);
        // The history has 199 CKs.
        assert!(constant_ms > 199.0 * settings.ck_ms(), "{number}");
        let nearest = neighbours(STAGES, lead_ms / settings.ck_ms());
        ratios.push([
            number / change,
            code(STAGES, nearest.0).unwrap().ratio as u32,
        ]);
        fixed.push(step.lead_ms / lead_ms);
        // From twice the true time on a correction does not come nearer.
        assert!((0.2..1.8).contains(&(step.lead_ms / lead_ms)), "{number}");
    }
    for load in [0, 1] {
        assert!([2, 5].iter().all(|&n| ratios.contains(&[load, n])));
    }
    assert!(ratios.contains(&[0, 1]));
    // Too long for some, too short for others.
    assert!(fixed.iter().any(|&r| r > 1.2) && fixed.iter().any(|&r| r < 0.8));
}
