//! What a run is compared with: the same steps without a lead, by speed, with a fixed lead, with a
//! lead that is learned, and learned with the text's sign.

use motion_rtl::lead_angle::settings::{Settings, Sign};

/// One of the systems that play the positionings.
#[derive(Debug, Clone)]
pub struct System {
    /// Its name.
    pub name: &'static str,
    /// Its settings.
    pub settings: Settings,
    /// The lead comes from the speed, as in Fig. 7.
    pub conventional: bool,
    /// It is what the scenario asks for.
    pub own: bool,
}

/// All of them, one of them the scenario's own.
pub fn systems(settings: &Settings) -> Vec<System> {
    let learning = |sign| Settings {
        learn: true,
        sign,
        ..settings.clone()
    };
    let fixed = Settings {
        learn: false,
        ..settings.clone()
    };
    let mut none = fixed.clone();
    for step in &mut none.steps {
        step.lead_ms = 0.0;
    }
    let own = match (settings.learn, settings.sign) {
        (false, _) => "fixed lead",
        (true, Sign::Converging) => "learning",
        (true, Sign::Literal) => "literal sign",
    };
    let system = |name, settings, conventional| System {
        name,
        settings,
        conventional,
        own: name == own,
    };
    vec![
        system("no lead", none, false),
        system("by speed", fixed.clone(), true),
        system("fixed lead", fixed, false),
        system("learning", learning(Sign::Converging), false),
        system("literal sign", learning(Sign::Literal), false),
    ]
}
