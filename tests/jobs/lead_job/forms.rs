//! The forms of the lead that the text gives as equal, in whole runs.

use super::*;
use motion_rtl::jobs::lead_angle::settings::LeadForm;

fn formed(form: LeadForm, settings: &Settings) -> Settings {
    Settings {
        form,
        ..settings.clone()
    }
}

/// Time data divided beforehand, products and an early subtractor: the same ticks, stops and times,
/// with either memory, whatever is learned.
#[test]
#[ignore = "takes long"]
fn the_forms_with_n_of_the_table_stop_in_the_same_tick() {
    let settings = turntable();
    let played = with_lead(&settings);
    for form in [
        LeadForm::DividedTime,
        LeadForm::Products,
        LeadForm::EarlyDifference,
    ] {
        let other = with_lead(&formed(form, &settings));
        assert_eq!(other.positionings, played.positionings, "{form:?}");
        assert_eq!(other.ticks, played.ticks);
    }
    let ram = Settings {
        history: History::Ram,
        ..formed(LeadForm::DividedTime, &settings)
    };
    assert_eq!(with_lead(&ram).positionings, played.positionings);
}

/// With N fixed at 1 too, as long as no time is past the codes of N = 1.
#[test]
#[ignore = "takes long"]
fn all_forms_stop_in_the_same_tick_where_n_is_one() {
    let mut settings = turntable();
    settings.action = Action::Operate;
    settings.operation_delay_s = 0.012;
    settings.load_delay_factor = 1.5;
    for step in &mut settings.steps {
        step.lead_ms = 10.0;
    }
    let played = with_lead(&settings);
    let longest = played.positionings.iter().map(|one| one.code).max();
    assert!((180..=199).contains(&longest.unwrap()), "{longest:?}");
    assert!(played.positionings.iter().all(|one| one.learned.is_some()));
    for &form in LeadForm::ALL {
        let other = with_lead(&formed(form, &settings));
        assert_eq!(other.positionings, played.positionings, "{form:?}");
    }
}

/// Beyond them its times are in steps of a CK and its prediction is of a longer ago: at constant speed
/// a count or two, and so a CK of way; nothing that learning has to make up for.
#[test]
#[ignore = "takes long"]
fn with_n_fixed_at_one_stops_are_within_a_ck_of_way() {
    let settings = turntable();
    let per_ck = |one: &Positioning| one.speed_counts_per_s.abs() * settings.ck_ms() / 1e3;
    let kept = |form| {
        with_lead(&Settings {
            learn: false,
            ..formed(form, &settings)
        })
    };
    let [drawn, long] = [LeadForm::Embodiment, LeadForm::FixedRatio].map(kept);
    let pairs = drawn.positionings.iter().zip(&long.positionings);
    let mut differ = 0;
    for (one, other) in pairs {
        let apart = one.error - other.error;
        assert!(
            (apart.abs() as f64) <= per_ck(one) + 1.0,
            "{one:?} {other:?}"
        );
        differ += usize::from(apart != 0);
    }
    assert!((10..=30).contains(&differ), "{differ}");

    let fixed = formed(LeadForm::FixedRatio, &settings);
    assert_eq!([settings.ratio(250), fixed.ratio(250)], [2, 1]);
    let played = with_lead(&fixed);
    let mut between = 0;
    for step in 0..fixed.steps.len() {
        for phase in phases(&fixed, &played, step) {
            for one in &phase[5..] {
                assert!(off(one) <= 3.0 * per_ck(one), "{one:?}");
                between += usize::from(settings.code(fixed.lead_ms(one.code)).is_none());
            }
        }
    }
    assert!(between > 0);
    // The two products of it are no other.
    let products = with_lead(&formed(LeadForm::FixedRatioProducts, &settings));
    assert_eq!(products.positionings, played.positionings);
}

/// Purpose of N: positions reached while accelerating, from where the fastest step does not come.
#[test]
#[ignore = "takes long"]
fn while_the_body_accelerates_n_fixed_at_one_stops_later() {
    let mut settings = turntable();
    settings.body.acceleration_counts_per_s2 = 60_000.0;
    settings.learn = false;
    let [drawn, long] = [LeadForm::Embodiment, LeadForm::FixedRatio]
        .map(|form| with_lead(&formed(form, &settings)));
    // Both lag by (a·Δt²/2)·(1 + 1/N): 28.1 counts with N = 2, 37.5 with N = 1.
    let pairs = drawn.positionings.iter().zip(&long.positionings);
    let later = pairs.map(|(one, other)| other.error - one.error);
    let later: Vec<i64> = later.collect();
    assert!(
        later.iter().all(|counts| (5..=15).contains(counts)),
        "{later:?}"
    );
}

/// A log is predicted by every form; those with N of the table are off by the same.
#[test]
#[ignore = "takes long"]
fn logs_are_predicted_by_all_forms() {
    let (log, steady) = logs::steady();
    let predictions = |form, placement| {
        let settings = Settings {
            placement,
            ..formed(form, &steady)
        };
        let replayed = replay(&positioner(&settings), &settings, &log, &mut ()).unwrap();
        assert!(replayed.predictions.count > 0);
        replayed.predictions
    };
    let drawn = predictions(LeadForm::Embodiment, Placement::Position);
    for placement in [Placement::Target, Placement::Halves] {
        assert_eq!(predictions(LeadForm::Embodiment, placement), drawn);
    }
    for form in [
        LeadForm::DividedTime,
        LeadForm::Products,
        LeadForm::EarlyDifference,
    ] {
        assert_eq!(predictions(form, Placement::Position), drawn, "{form:?}");
    }
    let fixed = predictions(LeadForm::FixedRatio, Placement::Position);
    assert!(fixed.largest <= 2.0, "{fixed:?}");
}
