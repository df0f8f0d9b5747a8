//! The lead-angle compensator on a body with a brake: whole runs of the scenario that ships, and
//! position logs.

mod detector;
mod forms;
mod logs;
mod passing;
mod setter;

use motion_rtl::circuits::lead_angle::codes::LARGEST;
use motion_rtl::input::position_log::{Columns, PositionLog, read};
use motion_rtl::jobs::lead_angle::job::{Played, Positioning, play, positioner};
use motion_rtl::jobs::lead_angle::replay::{replay, settings_for};
use motion_rtl::jobs::lead_angle::settings::{
    Action, Comparing, Detector, Function, History, LeadBy, Placement, Settings, Sign, Step,
    Targets,
};
use motion_rtl::scenario::{Loaded, Scenario};
use std::fmt::Write;
use std::path::Path;

/// The scenario that ships with the crate.
fn turntable() -> Settings {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("waves/turntable.toml");
    let loaded = Loaded::read(&path, &[]).expect("a scenario");
    let Scenario::LeadAngle(scenario) = &loaded.scenario else {
        panic!("another circuit");
    };
    scenario.settings.clone()
}

fn with_lead(settings: &Settings) -> Played {
    let played = play(&positioner(settings), settings, &mut ()).expect("it runs");
    assert!(!played.lost && !played.unsettled);
    assert_eq!(played.positionings.len(), settings.positionings as usize);
    played
}

/// Counts that one code is worth at the speed of a positioning.
fn code_travel(settings: &Settings, one: &Positioning) -> f64 {
    let ratio = settings.ratio(one.code) as f64;
    one.speed_counts_per_s.abs() * settings.ck_ms() / 1e3 * ratio + 1e-6
}

fn off(one: &Positioning) -> f64 {
    one.error.unsigned_abs() as f64
}

/// The positionings of a step before the load change, and after it.
fn phases<'a>(settings: &Settings, played: &'a Played, step: usize) -> [Vec<&'a Positioning>; 2] {
    let change = settings.load_change_after.expect("there is one") as usize;
    let (before, after) = played.positionings.split_at(change);
    [before, after].map(|phase| phase.iter().filter(|one| one.step == step).collect())
}

#[test]
fn learning_is_within_a_codes_travel_after_six_positionings_and_after_the_load_change() {
    let settings = turntable();
    let played = with_lead(&settings);
    for step in 0..settings.steps.len() {
        for phase in phases(&settings, &played, step) {
            assert!(phase.len() >= 6, "step {step} comes {} times", phase.len());
            for (number, one) in phase.iter().enumerate().skip(5) {
                let travel = code_travel(&settings, one);
                assert!(
                    off(one) <= travel,
                    "step {step}, {number}: {one:?}, {travel}"
                );
            }
        }
        // The change is felt, and the codes follow it.
        let [before, after] = phases(&settings, &played, step);
        let (last, first) = (before[before.len() - 1], after[0]);
        assert!(
            off(first) > 3.0 * code_travel(&settings, first),
            "{first:?}"
        );
        assert!(after[after.len() - 1].code > last.code);
    }
    let all = &played.positionings;
    assert!(all.iter().all(|one| !one.missed && !one.timed_out));
    // Δt2 of a positioning is Δt1 of the next of its step.
    for (number, one) in all.iter().enumerate() {
        let next = all[number + 1..].iter().find(|next| next.step == one.step);
        if let Some(next) = next {
            assert_eq!(Some(next.code), one.learned, "{number}");
        }
    }
}

/// Result of each function from the first stop of each step, and the state of learning before the
/// load changes.
#[test]
fn the_exact_relation_knows_the_lead_after_a_stop_of_each_step() {
    let settings = turntable();
    let played = |function| {
        let settings = Settings {
            function,
            ..settings.clone()
        };
        with_lead(&settings).positionings
    };
    let first = played(Function::FirstOrder);
    let ways =
        |one: &Positioning| [one.trigger_position, one.target].map(|from| one.stopped - from);
    let stops: Vec<_> = first[..4].iter().map(|one| (one.code, ways(one))).collect();
    let measured = [
        (250, [366, -134]),
        (250, [1209, 86]),
        (250, [3795, 1549]),
        (250, [-2477, -731]),
    ];
    assert_eq!(stops, measured);
    let codes = |all: &[Positioning]| all.iter().map(|one| one.code).collect::<Vec<_>>();
    for (function, after_one, after_two) in [
        (
            Function::FirstOrder,
            [158, 268, 352, 324],
            [180, 270, 410, 352],
        ),
        (
            Function::SecondOrder,
            [192, 270, 394, 346],
            [184, 270, 425, 356],
        ),
        (Function::Exact, [183, 270, 420, 356], [184, 270, 425, 354]),
    ] {
        let all = played(function);
        assert_eq!(
            all[..4].iter().map(ways).collect::<Vec<_>>(),
            measured.map(|(_, ways)| ways)
        );
        assert_eq!(codes(&all[4..8]), after_one, "{function:?}");
        assert_eq!(codes(&all[8..12]), after_two, "{function:?}");
    }
    assert_eq!(codes(&first[20..24]), [184, 270, 425, 356]);
}

/// The other systems stay as far off as their lead is wrong.
#[test]
#[ignore = "takes long"]
fn without_learning_the_load_change_stays_in_the_errors() {
    let settings = turntable();
    let learned = with_lead(&settings);
    let fixed = Settings {
        learn: false,
        ..settings.clone()
    };
    let mut none = fixed.clone();
    for step in &mut none.steps {
        step.lead_ms = 0.0;
    }
    let by_speed = with_lead(&Settings {
        lead: LeadBy::Speed,
        ..fixed.clone()
    });
    let last = |played: &Played| -> Vec<f64> {
        let all = &played.positionings;
        all[all.len() - settings.steps.len()..]
            .iter()
            .map(off)
            .collect()
    };
    let learned = last(&learned);
    for (name, played, times) in [
        ("no lead", &with_lead(&none), 20.0),
        ("fixed lead", &with_lead(&fixed), 4.0),
        ("by speed", &by_speed, 4.0),
    ] {
        let worst = last(played).into_iter().fold(0.0, f64::max);
        let ours = learned.iter().copied().fold(0.0, f64::max);
        assert!(worst > times * ours, "{name}: {worst} against {ours}");
        assert!(played.positionings.iter().all(|one| one.learned.is_none()));
    }
    // Without a lead the overrun is the error.
    for one in &with_lead(&none).positionings {
        assert_eq!(one.code, 0);
        let overrun = (one.stopped - one.trigger_position).unsigned_abs() as f64;
        let per_ck = one.speed_counts_per_s.abs() * settings.ck_ms() / 1e3;
        assert!((off(one) - overrun).abs() <= per_ck + 1.0, "{one:?}");
    }
}

/// With the text's sign the times run away from the true one, to the ends of the codes.
#[test]
fn the_literal_sign_diverges() {
    let settings = Settings {
        sign: Sign::Literal,
        ..turntable()
    };
    let played = with_lead(&settings);
    for step in 0..settings.steps.len() {
        let [before, _] = phases(&settings, &played, step);
        let errors: Vec<f64> = before.iter().map(|one| off(one)).collect();
        assert!(
            errors.windows(2).all(|pair| pair[1] >= pair[0] - 10.0),
            "{errors:?}"
        );
        let last = before[before.len() - 1];
        assert!(
            off(last) > 4.0 * errors[0].min(500.0),
            "step {step}: {errors:?}"
        );
        let [_, after] = phases(&settings, &played, step);
        let end = after[after.len() - 1].code;
        assert!([1, LARGEST].contains(&end), "step {step} ends at {end}");
    }
}

#[test]
#[ignore = "takes long"]
fn forms_and_placements_give_the_same_positionings() {
    let settings = turntable();
    let played = with_lead(&settings);
    let ram = with_lead(&Settings {
        history: History::Ram,
        ..settings.clone()
    });
    assert_eq!(ram.positionings, played.positionings);
    for placement in [Placement::Target, Placement::Halves] {
        let settings = Settings {
            placement,
            ..settings.clone()
        };
        assert_eq!(with_lead(&settings).positionings, played.positionings);
    }
}

/// A comparison for equality misses most targets at these speeds; what it misses is stopped by
/// hand, and nothing is learned from it.
#[test]
#[ignore = "takes long"]
fn equality_misses_and_what_is_missed_teaches_nothing() {
    let settings = Settings {
        comparing: Comparing::Equal,
        ..turntable()
    };
    let played = with_lead(&settings);
    let missed = played.positionings.iter().filter(|one| one.missed);
    assert!(missed.clone().count() > 20, "{}", missed.count());
    assert!(missed.clone().all(|one| one.learned.is_none()));
}

/// A step without a time begins with the seed, and learns from there.
#[test]
fn steps_without_a_time_begin_with_the_seed() {
    let mut settings = turntable();
    for step in &mut settings.steps {
        step.lead_ms = 0.0;
    }
    let played = with_lead(&settings);
    let seed = settings.code(settings.seed_ms);
    for step in 0..settings.steps.len() {
        let [before, _] = phases(&settings, &played, step);
        assert_eq!((before[0].code, before[0].learned), (0, seed));
        let last = before[before.len() - 1];
        assert!(off(last) <= code_travel(&settings, last), "{last:?}");
    }
}

/// One time for all steps serves none of them: their true times differ.
#[test]
fn a_common_time_is_one_for_all_steps() {
    let mut settings = turntable();
    settings.common_time = true;
    for step in &mut settings.steps[1..] {
        step.lead_ms = 0.0;
    }
    settings.validate().expect("they are right");
    let played = with_lead(&settings);
    for pair in played.positionings.windows(2) {
        assert_eq!(Some(pair[1].code), pair[0].learned);
    }
}

/// One step, run over and over on a body that turns on and on.
fn one_step(way: i64, speed_counts_per_s: u32, positionings: u32) -> Settings {
    Settings {
        targets: Targets::Relative,
        steps: vec![Step {
            target: way,
            speed_counts_per_s,
            lead_ms: 20.0,
            ..Step::default()
        }],
        positionings,
        load_change_after: None,
        ..turntable()
    }
}

/// A stop a turn: it is learned as any other, and what one stop is off is not in the next.
#[test]
fn a_single_step_stops_once_a_turn() {
    for way in [90_000, -90_000] {
        let settings = one_step(way, 90_000, 10);
        let played = with_lead(&settings);
        for (number, one) in (1..).zip(&played.positionings) {
            assert_eq!((one.step, one.target), (0, number * way));
            assert_eq!(one.upward, way > 0);
            let past = (one.stopped - one.target) * way.signum();
            assert_eq!(one.error, past);
        }
        let errors: Vec<f64> = played.positionings.iter().map(off).collect();
        assert!(errors[0] > 1000.0, "{errors:?}");
        for one in &played.positionings[5..] {
            assert!(off(one) <= code_travel(&settings, one), "{errors:?}");
        }
    }
}

/// Positions are a ring of 2^24 counts: a body that turns on and on goes over its seam, and the
/// control signal comes a lead before the target as anywhere.
#[test]
#[ignore = "takes long"]
fn a_body_that_turns_on_goes_over_the_seam_of_the_positions() {
    let mut settings = one_step(2_000_000, 655_350, 6);
    (settings.clock_hz, settings.ck_ticks) = (700_000, 70);
    let last = with_lead(&settings).positionings[5];
    assert_eq!(last.target, 12_000_000);
    assert!(last.trigger_position > 1 << 23);
    assert!(last.upward && !last.missed);
    assert_eq!(last.error, last.stopped - last.target);
    // So fast a body takes longer to stop than the greatest lead time.
    assert_eq!(last.code, LARGEST);
    let lead = (last.target - last.trigger_position) as f64;
    let way = last.speed_counts_per_s * LARGEST as f64 * settings.ck_ms() / 1e3;
    assert!((lead - way).abs() <= 80.0, "{last:?}");
    assert!((20_000..26_000).contains(&last.error), "{last:?}");
}

/// Operations in passing, whose delay grows by half when the load changes.
fn operating() -> Settings {
    Settings {
        action: Action::Operate,
        load_delay_factor: 1.5,
        ..turntable()
    }
}

/// Learning uses the position at which the operation took effect; the body moves on.
#[test]
#[ignore = "takes long"]
fn an_operation_in_passing_is_learned_from_where_it_took_effect() {
    let settings = operating();
    let played = with_lead(&settings);
    for step in 0..settings.steps.len() {
        let [before, after] = phases(&settings, &played, step);
        for (phase, delay_ms) in [(before, 20.0), (after, 30.0)] {
            for one in &phase[5..] {
                assert!(off(one) <= code_travel(&settings, one), "{one:?}");
                // Ticks from the sample to the operation are learned with it, and a CK may be lost.
                let lead_ms = one.code as f64 * settings.ck_ms();
                assert!((lead_ms - delay_ms).abs() <= 0.5, "{one:?}");
                let speed = f64::from(settings.steps[step].speed_counts_per_s);
                assert_eq!(one.end_speed_counts_per_s.abs(), speed);
            }
        }
    }
    let all = &played.positionings;
    assert!(all.iter().all(|one| !one.missed && !one.timed_out));
    // Kept as it is, the lead leaves the way of ten milliseconds.
    let fixed = Settings {
        learn: false,
        ..settings.clone()
    };
    for (number, one) in with_lead(&fixed).positionings.iter().enumerate() {
        let loaded = settings
            .load_change_after
            .is_some_and(|after| number >= after as usize);
        let late_ms = if loaded { 5.0 } else { -5.0 };
        let expected = one.speed_counts_per_s.abs() * late_ms / 1e3;
        let travel = 2.0 * code_travel(&settings, one);
        assert!(
            (one.error as f64 - expected).abs() <= travel,
            "{one:?}, {expected}"
        );
    }
}

/// Without an effect in its time there is nothing to learn from.
#[test]
fn an_operation_without_effect_teaches_nothing() {
    let settings = Settings {
        time_out_ms: 10.0,
        ..operating()
    };
    let played = with_lead(&settings);
    for one in &played.positionings {
        assert!(one.timed_out && one.learned.is_none(), "{one:?}");
    }
}

/// Leads by speed from one memory, for all steps: right until the load changes, and off by what the
/// way to stop has changed from then on. Nothing of it was tried before.
#[test]
#[ignore = "takes long"]
fn a_memory_of_leads_serves_all_steps_until_the_load_changes() {
    let settings = Settings {
        lead: LeadBy::Table,
        learn: false,
        ..turntable()
    };
    let by_table = with_lead(&settings);
    let mut without = turntable();
    without.learn = false;
    for step in &mut without.steps {
        step.lead_ms = 0.0;
    }
    let none = with_lead(&without);
    for step in 0..settings.steps.len() {
        let [before, after] = phases(&settings, &by_table, step);
        let [none_before, none_after] = phases(&settings, &none, step);
        // Half a CK of way, and what the brake has faded.
        assert!(before.iter().all(|one| off(one) <= 30.0), "{before:?}");
        assert!(off(before[0]) <= 6.0, "{before:?}");
        let changed = none_after[0].error - none_before[5].error;
        let error = after[0].error - before[5].error;
        assert!(
            changed > 80 && (error - changed).abs() <= 12,
            "{error}, {changed}"
        );
    }
}

/// Switches a distance before their targets, on the way there from either side.
#[test]
#[ignore = "takes long"]
fn a_displaced_switch_is_a_distance_before_its_target() {
    let mut settings = turntable();
    settings.learn = false;
    for step in &mut settings.steps {
        step.lead_ms = 0.0;
    }
    let none = with_lead(&settings);
    settings.switches_counts = vec![100, 1000, 2000, 3000];
    let displaced = with_lead(&settings);
    let pairs = none.positionings.iter().zip(&displaced.positionings);
    for (without, with) in pairs {
        assert_eq!(with.target, settings.steps[with.step].target);
        let per_ck = with.speed_counts_per_s.abs() * settings.ck_ms() / 1e3;
        let moved = (without.error - with.error) as f64;
        let distance = f64::from(settings.switches_counts[with.step]);
        assert!(
            (moved - distance).abs() <= per_ck + 2.0,
            "{without:?} {with:?}"
        );
    }
}
