//! Control computer of a compensator: writes the steps, starts them, and provides the next target
//! of each. It also acts as setter 25, for first times and for times of another load.

use super::job::{Ports, WIDTHS};
use super::settings::{
    Action, Completion, Detector, SPEED_UNIT_COUNTS_PER_S, Settings, TimeSource,
};
use crate::circuits::lead_angle::Compensator;
use crate::hdl::zero;

/// Control computer: writes one step per tick, then starts them. As soon as a step has taken its
/// target, its next target is written, if it differs.
#[derive(Debug)]
pub(super) struct ControlComputer<'a> {
    settings: &'a Settings,
    /// Number of positionings that have taken their target.
    begun: usize,
    /// True if a step was armed in the tick before.
    arming: bool,
    /// Number of steps whose time for the other load has been set.
    changed: usize,
    /// Steps whose times are set when the load changes: all or none.
    load_leads: usize,
}

impl<'a> ControlComputer<'a> {
    pub(super) fn new(settings: &'a Settings) -> Self {
        ControlComputer {
            settings,
            begun: 0,
            arming: false,
            changed: 0,
            load_leads: match settings.has_load_leads() {
                true => settings.steps.len(),
                false => 0,
            },
        }
    }

    /// Returns the inputs of `circuit` that are constant, with all others low.
    pub(super) fn standing(&self, circuit: &Compensator) -> Ports {
        let settings = self.settings;
        let cks = |ms: f64| u64::from(settings.cks(ms));
        let standstill = match (settings.action, settings.completion) {
            (Action::Stop, Completion::Standstill) => cks(settings.standstill_ms),
            // Longer than any standstill.
            _ => (1 << WIDTHS.cks) - 1,
        };
        Ports {
            passing: settings.action == Action::Operate,
            learn: settings.learn,
            common: settings.common_time,
            last_step: settings.steps.len().saturating_sub(1) as u64,
            ck_period: u64::from(settings.ck_ticks),
            turn: self.turn(),
            standstill,
            time_out: cks(settings.time_out_ms),
            rest: cks(settings.rest_ms),
            seed: settings.code(settings.seed_ms).unwrap_or(0),
            lead_parameter: self.parameter(settings.speed_lead_ms),
            gate: cks(settings.speed_gate_ms),
            ..zero(circuit)
        }
    }

    /// Returns the counts of a turn or a pitch for the port.
    fn turn(&self) -> u64 {
        let counts = match self.settings.detector {
            Detector::Incremental => 0,
            Detector::Absolute => self.settings.body.counts_per_rev as u64,
            Detector::PhaseShift => u64::from(self.settings.ck_ticks),
            Detector::Resolver => self.settings.pitch_counts() as u64,
        };
        counts % (1 << WIDTHS.code)
    }

    /// Returns a lead time of the conventional compensator as its parameter: in gates, in units of
    /// 1/256.
    fn parameter(&self, ms: f64) -> u64 {
        let gates = 256.0 * ms / self.settings.speed_gate_ms;
        (gates.round() as u64).min((1 << 14) - 1)
    }

    /// Sets the parameter of the current step, if each step has its own; returns true if it is
    /// unchanged.
    pub(super) fn choose_parameter(&self, i: &mut Ports, step: u64) -> bool {
        let step = usize::try_from(step).unwrap_or(usize::MAX);
        let Some(ms) = self.settings.speed_leads_ms.get(step) else {
            return true;
        };
        let before = i.lead_parameter;
        i.lead_parameter = self.parameter(*ms);
        i.lead_parameter == before
    }

    /// Sets the inputs of `tick`, given if a step is armed or runs. Steps run as soon as all are
    /// written, and wait at a change of the load for their times. Returns true if all inputs are
    /// unchanged.
    pub(super) fn tick(
        &mut self,
        i: &mut Ports,
        tick: u64,
        [arm, busy]: [bool; 2],
        run: bool,
    ) -> bool {
        let steps = self.settings.steps.len();
        let place = usize::try_from(tick).unwrap_or(usize::MAX);
        let taken = arm && !self.arming;
        self.arming = arm;
        let write = match place < steps {
            true => Some(place),
            false if taken => {
                let (now, next) = (self.begun, self.begun + steps);
                self.begun += 1;
                let other = self.settings.switch(now) != self.settings.switch(next);
                other.then_some(next)
            }
            false => None,
        };
        let change = self.settings.load_change_after == u32::try_from(self.begun).ok();
        let waits = change && self.changed < self.load_leads;
        let before = (i.write_target | i.write_time, i.run);
        self.write(i, write);
        // Learned times are written only during a step, so none is refused between steps.
        self.set_time(i, place, waits && !busy);
        i.run = place >= steps && run && !waits;
        before == (false, i.run) && !i.write_target && !i.write_time
    }

    /// Sets the first time of a step, or the next one for the other load.
    fn set_time(&mut self, i: &mut Ports, place: usize, changes: bool) {
        let settings = self.settings;
        let first = match settings.time_source {
            TimeSource::Rom => None,
            TimeSource::Setter => settings.steps.get(place).map(|step| (place, step.lead_ms)),
        };
        let next = match changes {
            true => {
                let step = settings.steps.get(self.changed);
                step.and_then(|step| Some((self.changed, step.load_lead_ms?)))
            }
            false => None,
        };
        self.changed += usize::from(changes);
        let set = first.or(next);
        let time = set.and_then(|(step, ms)| Some((step as u64, settings.code(ms)?)));
        i.write_time = time.is_some();
        i.step_time = time.map_or(0, |(_, time)| time);
        if let Some((step, _)) = time {
            i.write_step = step;
        }
    }

    /// Writes the step of a positioning with its target.
    fn write(&self, i: &mut Ports, positioning: Option<usize>) {
        let steps = &self.settings.steps;
        let step = positioning.map(|number| number % steps.len());
        let speed = step.map_or(0, |step| steps[step].speed_counts_per_s);
        i.write_target = step.is_some();
        i.write_step = step.map_or(0, |step| step as u64);
        i.step_target = positioning.map_or(0, |number| word(self.settings.switch(number)));
        i.step_speed = u64::from(speed / SPEED_UNIT_COUNTS_PER_S);
    }
}

/// Returns the word of a position: positions are a ring.
pub(super) fn word(position: i64) -> i64 {
    let half = 1 << (WIDTHS.position - 1);
    (position + half).rem_euclid(2 * half) - half
}
