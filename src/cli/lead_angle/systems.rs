//! Systems that a run is compared with, on the same steps:
//!
//! - without a lead, and with switches at a distance before their targets;
//! - with a lead by speed: one parameter, one parameter per step tuned to the nominal load, and a
//!   memory of the leads that this load needs;
//! - with a fixed lead;
//! - with a learned lead: first order, second order, by the exact relation, and with the text's
//!   sign.
//!
//! A scenario whose positionings are complete after a fixed time is also learned at standstills. A
//! scenario with another detector is also run with an incremental one, and one with another form of
//! the lead in the form of the figures.

use motion_rtl::jobs::lead_angle::job::{Played, Positioning};
use motion_rtl::jobs::lead_angle::settings::{
    Completion, Detector, Function, LeadBy, LeadForm, Settings, Sign,
};

/// Name of the system that learns with the sign that converges, to first order.
pub const LEARNING: &str = "learning";
/// Name of the system that learns with the sign that converges, to second order.
pub const SECOND_ORDER: &str = "second order";
/// Name of the system that learns with the sign that converges, by the exact relation.
pub const EXACT: &str = "exact relation";
/// Name of the system that learns with the text's sign.
pub const LITERAL: &str = "literal sign";
/// Name of the system that learns where the body has stopped, though the scenario has a fixed time.
const STANDSTILL: &str = "at standstill";
/// Name of the system that is the scenario's own but for an incremental encoder.
const INCREMENTAL: &str = "incremental";
/// Name of the system that is the scenario's own but for the form of its lead.
const EMBODIMENT: &str = "embodiment";
/// Name of the system without a lead.
pub const NONE: &str = "no lead";
/// Name of the system whose signals come at a distance from the targets.
const SWITCH: &str = "displaced switch";
/// Name of the system by speed with the scenario's parameter.
pub const BY_SPEED: &str = "by speed";
/// Name of the system by speed whose parameters are tuned.
const TUNED: &str = "tuned";
/// Name of the system by speed whose leads are in a memory.
const BY_TABLE: &str = "by table";
/// Name of the system that keeps its lead times.
const FIXED: &str = "fixed lead";

/// One of the systems that play the positionings.
#[derive(Debug, Clone)]
pub struct System {
    /// Its name.
    pub name: &'static str,
    /// Its settings.
    pub settings: Settings,
    /// True if the scenario selects this system.
    pub own: bool,
}

/// The name of the system that learns so.
pub fn learner(sign: Sign, function: Function) -> &'static str {
    match (sign, function) {
        (Sign::Converging, Function::FirstOrder) => LEARNING,
        (Sign::Converging, Function::SecondOrder) => SECOND_ORDER,
        (Sign::Converging, Function::Exact) => EXACT,
        (Sign::Literal, _) => LITERAL,
    }
}

/// All of them, one of them the scenario's own.
pub fn systems(settings: &Settings) -> Vec<System> {
    let learning = |sign, function| Settings {
        lead: LeadBy::Time,
        learn: true,
        sign,
        function,
        ..settings.clone()
    };
    let fixed = Settings {
        lead: LeadBy::Time,
        learn: false,
        ..settings.clone()
    };
    let by_speed = Settings {
        lead: LeadBy::Speed,
        ..fixed.clone()
    };
    let by_table = Settings {
        lead: LeadBy::Table,
        ..fixed.clone()
    };
    let mut none = fixed.clone();
    for step in &mut none.steps {
        (step.lead_ms, step.load_lead_ms) = (0.0, None);
    }
    let (sign, function) = (settings.sign, settings.function);
    let own = match (settings.lead, settings.learn) {
        (LeadBy::Speed, _) => BY_SPEED,
        (LeadBy::Table, _) => BY_TABLE,
        (LeadBy::Time, false) => FIXED,
        (LeadBy::Time, true) => learner(sign, function),
    };
    let system = |name, settings| System {
        name,
        settings,
        own: name == own,
    };
    let converging = |function| learning(Sign::Converging, function);
    let mut all = vec![
        system(NONE, none.clone()),
        system(SWITCH, none),
        system(BY_SPEED, by_speed.clone()),
        system(TUNED, by_speed),
        system(BY_TABLE, by_table),
        system(FIXED, fixed),
        system(LEARNING, converging(Function::FirstOrder)),
        system(SECOND_ORDER, converging(Function::SecondOrder)),
        system(EXACT, converging(Function::Exact)),
        system(LITERAL, learning(Sign::Literal, function)),
    ];
    if settings.completion == Completion::FixedTime {
        let mut stopped = converging(function);
        stopped.completion = Completion::Standstill;
        stopped.time_out_ms = stopped.time_out_ms.max(Settings::default().time_out_ms);
        all.push(system(STANDSTILL, stopped));
    }
    let Some(own) = all.iter().find(|system| system.own) else {
        return all;
    };
    let own = own.settings.clone();
    if settings.detector != Detector::Incremental {
        let mut counted = own.clone();
        counted.detector = Detector::Incremental;
        counted.sampling_clock_ppm = 0.0;
        counted.resolver = Settings::default().resolver;
        // An absolute encoder may be faster than a count per tick.
        if counted.validate().is_ok() {
            all.push(system(INCREMENTAL, counted));
        }
    }
    if own.lead == LeadBy::Time && own.form != LeadForm::Embodiment {
        let form = LeadForm::Embodiment;
        let drawn = Settings { form, ..own };
        // With N fixed at 1 there are times between its codes.
        if drawn.validate().is_ok() {
            all.push(system(EMBODIMENT, drawn));
        }
    }
    all
}

impl System {
    /// True if [`set_up`](Self::set_up) does something to it.
    pub fn is_set_up(&self) -> bool {
        [SWITCH, TUNED].contains(&self.name)
    }

    /// Sets it up as one does who tries the machine without a lead first, at the nominal load.
    pub fn set_up(&mut self, without_lead: &Played) {
        match self.name {
            SWITCH => self.settings.switches_counts = switches(&self.settings, without_lead),
            TUNED => self.settings.speed_leads_ms = tuned(&self.settings, without_lead),
            _ => (),
        }
    }
}

/// The first stop of each step at the nominal load, where there was one.
fn first_stops<'a>(settings: &Settings, run: &'a Played) -> Vec<Option<&'a Positioning>> {
    let nominal = settings
        .load_change_after
        .map_or(usize::MAX, |after| after as usize);
    let step = |number: usize| {
        let mut own = run.positionings.iter().take(nominal);
        let first = own.find(|one| one.step == number);
        first.filter(|one| !one.timed_out && !one.missed)
    };
    (0..settings.steps.len()).map(step).collect()
}

/// Returns each switch's distance before its target: the scenario's distance, or the overrun of the
/// step without a lead, limited to the room before the target.
fn switches(settings: &Settings, without_lead: &Played) -> Vec<u32> {
    let steps = first_stops(settings, without_lead).into_iter().enumerate();
    let distance = |(step, first): (usize, Option<&Positioning>)| {
        let wanted = first.map_or(0, |one| u32::try_from(one.error).unwrap_or(0));
        let farthest = settings.farthest_switch(step);
        settings.switch_counts.unwrap_or(wanted.min(farthest))
    };
    steps.map(distance).collect()
}

/// The parameter of each step that is right for it at the nominal load: the stopping distance
/// without a lead by the speed. Where there was none, or no speed, the one that is the same for all.
fn tuned(settings: &Settings, without_lead: &Played) -> Vec<f64> {
    let steps = first_stops(settings, without_lead).into_iter();
    let parameter = |first: Option<&Positioning>| {
        let ms = first.map(|one| 1e3 * one.error as f64 / one.speed_counts_per_s.abs());
        ms.filter(|ms| ms.is_finite() && *ms >= 0.0)
            .unwrap_or(settings.speed_lead_ms)
    };
    steps.map(parameter).collect()
}
