//! What a run is compared with: the same steps without a lead, by speed, with a fixed lead, with a
//! lead that is learned, and learned with the text's sign.

use motion_rtl::lead_angle::settings::{Settings, Sign};

/// Name of the system that learns with the sign that converges.
pub const LEARNING: &str = "learning";
/// Name of the system that learns with the text's sign.
pub const LITERAL: &str = "literal sign";
/// Name of the system that keeps its lead times.
const FIXED: &str = "fixed lead";

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
        (false, _) => FIXED,
        (true, Sign::Converging) => LEARNING,
        (true, Sign::Literal) => LITERAL,
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
        system(FIXED, fixed, false),
        system(LEARNING, learning(Sign::Converging), false),
        system(LITERAL, learning(Sign::Literal), false),
    ]
}
