//! Times that the control computer sets: the first ones, and those for another load.

use super::*;
use motion_rtl::jobs::lead_angle::settings::{LeadForm, TimeSource};

/// A setter gives what a ROM holds, in every form of the time data.
#[test]
fn a_setter_is_as_good_as_a_rom() {
    let settings = Settings {
        positionings: 12,
        load_change_after: None,
        history: History::Ram,
        ..turntable()
    };
    for form in [
        LeadForm::Embodiment,
        LeadForm::DividedTime,
        LeadForm::FixedRatio,
    ] {
        let of = |time_source| {
            with_lead(&Settings {
                form,
                time_source,
                ..settings.clone()
            })
        };
        let [rom, setter] = [TimeSource::Rom, TimeSource::Setter].map(of);
        assert_eq!(setter.positionings, rom.positionings, "{form:?}");
        let codes: Vec<u64> = rom.positionings.iter().map(|one| one.code).collect();
        assert_eq!(codes[..4], [250; 4]);
    }
}

/// Times that were prepared for the other load are in force from its first positioning on; a step that
/// has none goes on with what it learned.
#[test]
#[ignore = "takes long"]
fn times_for_another_load_are_set_before_its_first_positioning() {
    let mut settings = turntable();
    for (step, ms) in [(0, 22.8), (2, 62.5), (3, 51.0)] {
        settings.steps[step].load_lead_ms = Some(ms);
    }
    settings.validate().expect("they are right");
    let [prepared, learned] = [&settings, &turntable()].map(with_lead);
    let change = settings.load_change_after.expect("there is one") as usize;
    assert_eq!(
        prepared.positionings[..change],
        learned.positionings[..change]
    );
    for step in 0..settings.steps.len() {
        let [before, after] = phases(&settings, &prepared, step);
        let [_, unprepared] = phases(&settings, &learned, step);
        let first = after[0];
        match settings.steps[step].load_lead_ms {
            Some(ms) => {
                assert_eq!(Some(first.code), settings.code(ms));
                assert!(off(first) <= 30.0 && off(unprepared[0]) > 80.0, "{first:?}");
            }
            None => {
                assert_eq!(Some(first.code), before[5].learned);
                assert!(off(first) > 100.0, "{first:?}");
            }
        }
        assert!(off(after[5]) <= code_travel(&settings, after[5]), "{step}");
    }
    // Kept as they are set, too.
    settings.learn = false;
    let fixed = with_lead(&settings);
    for (number, one) in fixed.positionings.iter().enumerate() {
        let ms = match number < change {
            true => Some(25.0),
            false => settings.steps[one.step].load_lead_ms.or(Some(25.0)),
        };
        assert_eq!(
            Some(one.code),
            ms.and_then(|ms| settings.code(ms)),
            "{number}"
        );
    }
}

/// An operation in passing waits for its times too, and for no more than these.
#[test]
fn operations_take_times_for_another_delay() {
    let mut settings = operating();
    for step in &mut settings.steps {
        step.load_lead_ms = Some(30.0);
    }
    let played = with_lead(&settings);
    let change = settings.load_change_after.expect("there is one") as usize;
    for one in &played.positionings[change..] {
        assert!(off(one) <= 2.0 * code_travel(&settings, one), "{one:?}");
    }
}
