//! What a run is compared with: the same steps without a lead, by speed with one parameter and with
//! one for each step that is tuned to the nominal load, with a fixed lead, with a lead that is
//! learned, and learned with the text's sign; where the scenario has positionings
//! complete by a fixed time, learned at standstills too.

use motion_rtl::jobs::lead_angle::job::Played;
use motion_rtl::jobs::lead_angle::settings::{Completion, Settings, Sign};

/// Name of the system that learns with the sign that converges.
pub const LEARNING: &str = "learning";
/// Name of the system that learns with the text's sign.
pub const LITERAL: &str = "literal sign";
/// Name of the system that learns where the body has stopped, though the scenario has a fixed time.
const STANDSTILL: &str = "at standstill";
/// Name of the system without a lead.
pub const NONE: &str = "no lead";
/// Name of the system by speed whose parameters are tuned.
pub const TUNED: &str = "tuned";
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
    let mut all = vec![
        system(NONE, none, false),
        system("by speed", fixed.clone(), true),
        system(TUNED, fixed.clone(), true),
        system(FIXED, fixed, false),
        system(LEARNING, learning(Sign::Converging), false),
        system(LITERAL, learning(Sign::Literal), false),
    ];
    if settings.completion == Completion::FixedTime {
        let mut stopped = learning(Sign::Converging);
        stopped.completion = Completion::Standstill;
        stopped.time_out_ms = stopped.time_out_ms.max(Settings::default().time_out_ms);
        all.push(system(STANDSTILL, stopped, false));
    }
    all
}

/// The parameter of each step that is right for it at the nominal load, as one who sets the machine up
/// finds it: the stopping distance without a lead by the speed, at the first positioning of the step.
/// Where there was none, or no speed, the one that is the same for all.
pub fn tuned(settings: &Settings, without_lead: &Played) -> Vec<f64> {
    let nominal = settings
        .load_change_after
        .map_or(usize::MAX, |after| after as usize);
    let runs = &without_lead.positionings;
    let step = |number: usize| {
        let mut first = runs.iter().take(nominal).filter(|one| one.step == number);
        let found = first.next().filter(|one| !one.timed_out && !one.missed);
        let ms = found.map(|one| 1e3 * one.error as f64 / one.speed_counts_per_s.abs());
        ms.filter(|ms| ms.is_finite() && *ms >= 0.0)
            .unwrap_or(settings.speed_lead_ms)
    };
    (0..settings.steps.len()).map(step).collect()
}
