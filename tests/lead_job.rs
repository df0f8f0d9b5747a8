//! The lead-angle compensator on a body with a brake: whole runs of the scenario that ships.

use motion_rtl::input::scenario::{Loaded, Scenario};
use motion_rtl::lead_angle::job::{Conventional, Played, RamLead, ShiftLead, play, positioner};
use motion_rtl::lead_angle::settings::{Settings, Sign};
use std::path::Path;

/// The scenario that ships with the crate.
fn turntable() -> Settings {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("waves/turntable.toml");
    let loaded = Loaded::read(&path, &[]).expect("a scenario");
    let Scenario::LeadAngle(scenario) = &loaded.scenario else {
        panic!("another circuit");
    };
    scenario.settings()
}

fn learning(settings: &Settings) -> Played {
    play(&positioner::<ShiftLead>(settings), settings, ()).expect("it runs")
}

#[test]
fn show() {
    let settings = turntable();
    let show = |name: &str, played: &Played| {
        println!("{name}: {} ticks", played.ticks);
        for one in &played.positionings {
            println!("{one:?}");
        }
    };
    show("learning", &learning(&settings));
    let fixed = Settings {
        learn: false,
        ..settings.clone()
    };
    show("fixed", &learning(&fixed));
    show(
        "speed",
        &play(&positioner::<Conventional>(&fixed), &fixed, ()).unwrap(),
    );
    let mut none = fixed.clone();
    for step in &mut none.steps {
        step.lead_ms = 0.0;
    }
    show("none", &learning(&none));
    let literal = Settings {
        sign: Sign::Literal,
        ..settings.clone()
    };
    show("literal", &learning(&literal));
    let ram = play(&positioner::<RamLead>(&settings), &settings, ()).unwrap();
    assert_eq!(ram.positionings, learning(&settings).positionings);
}
