//! Operations in passing at the least distances that are allowed.

use super::*;
use motion_rtl::settings::{Place, SettingError};
use proptest::prelude::*;

/// Raises each target that is too near to the one that its refusal names, and gives the last step
/// that was refused; none where no step was.
fn at_least_distances(settings: &mut Settings) -> Option<usize> {
    let mut last = None;
    while let Err(SettingError {
        field,
        place,
        allowed,
        ..
    }) = settings.validate()
    {
        assert_eq!(field, "target", "{allowed}");
        let Some(Place::Row("step", index)) = place else {
            panic!("no step: {place:?}");
        };
        let (_, named) = allowed.split_once("as target = ").expect("a target");
        let named: String = named.chars().take_while(|c| !", ".contains(*c)).collect();
        settings.steps[index].target = named.parse().expect("a number");
        last = Some(index);
    }
    last
}

/// Plays at the least distances; one count less is refused.
fn runs_at_its_border(mut settings: Settings) {
    let Some(last) = at_least_distances(&mut settings) else {
        panic!("nothing is refused: {settings:?}");
    };
    let played = with_lead(&settings);
    for (number, one) in played.positionings.iter().enumerate() {
        let told = format!("{number}: {one:?}, {:?}", settings.steps);
        assert!(!one.missed && !one.timed_out, "{told}");
        assert_eq!(one.upward, settings.way(number) > 0, "{told}");
    }
    let again = last + settings.steps.len();
    let way = settings.way(if again < settings.positionings as usize {
        again
    } else {
        last
    });
    let way = way.signum();
    settings.steps[last].target -= way;
    let error = settings.validate().expect_err("one count less");
    assert_eq!(error.place, Some(Place::Row("step", last)));
}

fn step(target: i64, speed_counts_per_s: u32, lead_ms: f64) -> Step {
    Step {
        target,
        speed_counts_per_s,
        lead_ms,
        ..Step::default()
    }
}

/// A knife on a web, as the crate's own table would turn.
fn knife(targets: Targets, steps: Vec<Step>) -> Settings {
    Settings {
        targets,
        steps,
        positionings: 24,
        load_change_after: None,
        ..operating()
    }
}

#[test]
fn operations_at_the_least_distance_run_and_one_count_less_is_refused() {
    let (relative, absolute) = (Targets::Relative, Targets::Absolute);
    // One step over and over, either way; the lead that begins is right, too long, none.
    for way in [100, -100] {
        for lead_ms in [20.0, 40.0, 0.0] {
            runs_at_its_border(knife(relative, vec![step(way, 90_000, lead_ms)]));
        }
    }
    // Steps of several speeds, with a turn back to the first.
    let places = vec![
        step(30_000, 90_000, 20.0),
        step(30_100, 20_000, 20.0),
        step(30_200, 90_000, 20.0),
        step(100, 50_000, 20.0),
    ];
    runs_at_its_border(knife(absolute, places.clone()));
    // Without learning, by speed, by the memory.
    for lead in [LeadBy::Time, LeadBy::Speed, LeadBy::Table] {
        runs_at_its_border(Settings {
            learn: false,
            lead,
            ..knife(absolute, places.clone())
        });
    }
    // A delay that grows with the load.
    let longer = |load_delay_factor| {
        let mut settings = Settings {
            load_change_after: Some(12),
            load_delay_factor,
            ..knife(relative, vec![step(100, 50_000, 20.0)])
        };
        at_least_distances(&mut settings);
        runs_at_its_border(Settings {
            steps: vec![step(100, 50_000, 20.0)],
            ..settings.clone()
        });
        settings.steps[0].target
    };
    // 10 ms at 50,000 counts/s, and by how much the leads differ.
    let [before, after] = [1.0, 1.5].map(longer);
    assert!((500..=1000).contains(&(after - before)), "{before} {after}");
}

/// A body that is at speed turns to a target as near as one likes; so does one that stops.
#[test]
fn turns_and_stops_have_no_least_distance() {
    let to_and_fro = |lead_ms| vec![step(30_000, 90_000, lead_ms), step(29_999, 90_000, lead_ms)];
    let mut settings = knife(Targets::Absolute, to_and_fro(20.0));
    settings.positionings = 2;
    assert_eq!(settings.validate(), Ok(()));
    let played = with_lead(&settings);
    let directions: Vec<_> = played.positionings.iter().map(|one| one.upward).collect();
    assert_eq!(directions, [true, false]);
    // Unless its operation comes before it is there: by 40 ms, less 20 ms of delay and 10 of rest.
    settings.steps = to_and_fro(40.0);
    runs_at_its_border(settings.clone());
    settings.action = Action::Stop;
    assert_eq!(settings.validate(), Ok(()));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    #[ignore = "takes long"]
    fn random_operations_run_at_the_least_distance(
        speeds in prop::collection::vec(100u32..9_000, 1..4),
        leads in prop::collection::vec(0u32..60, 4),
        delay_ms in 0.0f64..60.0,
        rest_ms in 0.1f64..30.0,
        acceleration in 50_000.0f64..2e6,
        ck_ticks in 4u32..40,
        learn: bool,
        ways in prop::collection::vec(prop::bool::weighted(0.7), 4),
    ) {
        let steps = speeds.iter().zip(leads).zip(ways);
        // Tens of CKs are codes.
        let ck_ms = f64::from(ck_ticks) / 200.0;
        let steps = steps.map(|((speed, lead), up)| step(if up { 1 } else { -1 }, 10 * speed, ck_ms * f64::from(10 * lead)));
        let mut settings = knife(Targets::Relative, steps.collect());
        settings.operation_delay_s = delay_ms / 1e3;
        settings.rest_ms = rest_ms.max(ck_ms);
        settings.body.acceleration_counts_per_s2 = acceleration;
        settings.ck_ticks = ck_ticks;
        settings.standstill_ms = 5.0;
        settings.speed_gate_ms = 5.0;
        settings.seed_ms = 0.0;
        // Where speeds differ, what is learned at one of them may be too long at the other.
        let speeds = settings.steps.iter().map(|one| one.speed_counts_per_s);
        settings.learn = learn && speeds.clone().min() == speeds.max();
        prop_assume!(settings.steps.iter().all(|one| settings.code(one.lead_ms).is_some()));
        runs_at_its_border(settings);
    }
}
