//! Operations in passing: how far apart their targets have to be.
//!
//! An operation holds its step from the control signal until it takes effect; the correction and the
//! rest follow, then the next step is armed. The body goes on meanwhile. Where it is beyond the next
//! target by then it turns back, and where its prediction is, the signal of that step never comes.

use super::{Action, Function, LeadBy, Settings, Sign, Targets};
use crate::circuits::lead_angle::codes::STAGES;
use crate::circuits::lead_angle::{Correction, Division};
use crate::jobs::lead_angle::job::WIDTHS;
use crate::settings::{Place, SettingError};

/// CKs of a step beside those of its rest: up to the samples that fire, complete, end the rest and
/// arm the next step, and one of the detector.
const SAMPLES: f64 = 5.0;
/// Ticks of a step beside CKs and correction: synchronisers, comparator, sequencer.
const TICKS: u64 = 16;
/// Counts by which the places of encoder and body differ.
const COUNTS: f64 = 2.0;

/// Leads that a step may have: the shortest and the longest, in seconds.
type Leads = [f64; 2];

/// A step after its control signal.
struct Passed {
    /// Its way.
    way: i64,
    /// Bound of the body's speed until the next step is armed, in counts/s.
    fastest: f64,
    /// Speed that the body has at least, in counts/s.
    slowest: f64,
    /// Way of its lead at least, and at most, in counts.
    lead: [f64; 2],
}

impl Settings {
    /// Refuses targets that a body comes to before their step is armed, if each step has these leads.
    pub(super) fn validate_passing(
        &self,
        leads: impl Fn(usize) -> Leads,
    ) -> Result<(), SettingError> {
        if self.action != Action::Operate {
            return Ok(());
        }
        let Some((number, least)) = self.too_near(&leads) else {
            return Ok(());
        };
        // A longer way lets the body come to speed, and less may do.
        let index = number % self.steps.len();
        let (mut refused, mut least) = (self.way(number).unsigned_abs(), least as u64);
        while refused + 1 < least {
            let length = refused.midpoint(least);
            let mut other = self.clone();
            other.steps[index].target = self.target_at(number, length);
            let found = other.too_near(&leads);
            match found.is_some_and(|(at, _)| at % self.steps.len() == index) {
                true => refused = length,
                false => least = length,
            }
        }
        Err(self.refused(number, least))
    }

    /// The first positioning whose target is too near, and a way that is long enough.
    fn too_near(&self, leads: &impl Fn(usize) -> Leads) -> Option<(usize, f64)> {
        let held = self.held_s();
        let mut before: Option<Passed> = None;
        for number in 0..self.positionings as usize {
            let (index, way) = (number % self.steps.len(), self.way(number));
            let leads = leads(index);
            let turns = |before: &Passed| before.way.signum() != way.signum();
            let least = match &before {
                Some(before) if turns(before) => least_turn(before, held[0]),
                Some(before) => self.least_way(index, leads, before, held[1]),
                None => self.least_start(leads),
            };
            if (way.unsigned_abs() as f64) < least {
                return Some((number, least));
            }
            // At a turn the body comes from rest, from beyond the target before.
            let onwards = before.as_ref().filter(|before| !turns(before));
            before = Some(self.passed(number, leads, onwards, held[1]));
        }
        None
    }

    /// The target of a positioning's step with another length of its way.
    fn target_at(&self, number: usize, length: u64) -> i64 {
        let (way, length) = (self.way(number), length as i64);
        match self.targets {
            Targets::Relative => way.signum() * length,
            Targets::Absolute => self.target(number) - way + way.signum() * length,
        }
    }

    /// Leads of this compensator's steps: those that are set, and what learning takes them to.
    pub(super) fn own_leads_s(&self, index: usize) -> Leads {
        let delays = self.delays_s();
        let set = |ms: f64| ms / 1e3;
        match self.lead {
            LeadBy::Speed => [set(self.speed_lead_ms); 2],
            LeadBy::Table => [delays[0]; 2],
            LeadBy::Time => {
                let first = match self.common_time {
                    true => self.steps[0].lead_ms,
                    false => self.steps[index].lead_ms,
                };
                let later = self.steps[index].load_lead_ms;
                let mut all = vec![set(first)];
                all.extend(later.map(set));
                if self.learn {
                    all.extend(delays);
                    all.extend((first == 0.0).then_some(set(self.seed_ms)));
                }
                let [shortest, longest] = range(&all);
                let code = if self.learn {
                    self.code_s(longest)
                } else {
                    0.0
                };
                [(shortest - code).max(0.0), longest + code]
            }
        }
    }

    /// Returns the largest error of a learned lead: two of its codes and one CK of sampling.
    fn code_s(&self, lead_s: f64) -> f64 {
        let ck = self.ck_ms() / 1e3;
        let mut ratios = [1.0, 2.0, 5.0].into_iter();
        let ratio = ratios.find(|ratio| lead_s <= ratio * STAGES as f64 * ck);
        (2.0 * ratio.unwrap_or(10.0) + 1.0) * ck
    }

    /// Times from the control signal to the effect: at first, and after the load change.
    fn delays_s(&self) -> [f64; 2] {
        let changes = self.load_change_after.is_some();
        [false, changes].map(|loaded| self.operation_delay(loaded) as f64 / self.clock_hz as f64)
    }

    /// Shortest and longest time from the control signal of a step until the next one is armed.
    fn held_s(&self) -> [f64; 2] {
        let correction = Correction {
            stages: WIDTHS.stages,
            position: WIDTHS.position,
            sign: Sign::default(),
            function: Function::SecondOrder,
            division: Division::default(),
        };
        let ticks = (TICKS + correction.latency(2)) as f64 / self.clock_hz as f64;
        let ck = self.ck_ms().max(self.sampling_ms()) / 1e3;
        let cks = |ms: f64| f64::from(self.cks(ms)) * ck;
        let over = |effect: f64| effect.min(cks(self.time_out_ms)) + cks(self.rest_ms);
        let [shortest, longest] = range(&self.delays_s()).map(over);
        [shortest, longest + SAMPLES * ck + ticks]
    }

    /// Least way to the target of a step that goes on from another.
    fn least_way(&self, index: usize, leads: Leads, before: &Passed, held: f64) -> f64 {
        let speed = f64::from(self.steps[index].speed_counts_per_s);
        let lead = speed.max(before.fastest) * leads[1];
        (before.fastest * held + (lead - before.lead[0]).max(0.0) + COUNTS).ceil()
    }

    /// Least way to the first target: the lead is known before the signal is due.
    fn least_start(&self, leads: Leads) -> f64 {
        let [speed, acceleration] = [
            f64::from(self.steps[0].speed_counts_per_s),
            self.body.acceleration_counts_per_s2,
        ];
        let ck = self.ck_ms().max(self.sampling_ms()) / 1e3;
        let known = self.measured_s(leads[1]) + SAMPLES * ck;
        let reached = speed.min(acceleration * known);
        let gone = (speed * known).min(acceleration * known.powi(2) / 2.0);
        (gone + reached * leads[1] + COUNTS).ceil()
    }

    /// Returns the time whose way a lead is made of: the lead time, or two gates for a lead by
    /// speed.
    fn measured_s(&self, lead_s: f64) -> f64 {
        match self.lead {
            LeadBy::Time => lead_s,
            _ => 2.0 * self.speed_gate_ms / 1e3,
        }
    }

    /// The body at the control signal of a positioning.
    fn passed(&self, number: usize, leads: Leads, before: Option<&Passed>, held: f64) -> Passed {
        let index = number % self.steps.len();
        let speed = f64::from(self.steps[index].speed_counts_per_s);
        let way = self.way(number);
        let twice = 2.0 * self.body.acceleration_counts_per_s2;
        let from = |before: &Passed| [before.slowest, before.fastest, before.fastest * held];
        let [slowest, fastest, gone] = before.map_or([0.0; 3], from);
        let free = (way.unsigned_abs() as f64 - gone).max(0.0);
        let slowed = twice * (free - fastest.max(speed) * leads[1]).max(0.0);
        let [shortest, longest] = leads;
        // The lead is made of a way that is over: the body has its speed all along it.
        let measured = shortest + self.measured_s(shortest);
        let speeding = (speed.powi(2) - slowest.powi(2)) / twice;
        let steady = speeding + speed * measured <= free;
        let fastest = (fastest.powi(2) - slowed).max(0.0).sqrt().max(speed);
        let [slowest, least] = if steady {
            [speed, speed * shortest]
        } else {
            [0.0; 2]
        };
        Passed {
            way,
            fastest,
            slowest,
            lead: [least, fastest * longest],
        }
    }

    /// A target that comes too soon after the one before it.
    fn refused(&self, number: usize, least: u64) -> SettingError {
        let count = self.steps.len();
        let (index, before) = (number % count, (number + count - 1) % count);
        let (way, target) = (self.way(number), self.steps[index].target);
        let problem = match number {
            0 => format!("is {target}, from rest"),
            _ => format!(
                "is {target}: {} counts from the target of step {before}, which the body passes at \
                 {} counts/s",
                way.unsigned_abs(),
                self.steps[before].speed_counts_per_s
            ),
        };
        let right = self.target_at(number, least);
        let allowed = format!(
            "at least {least} counts with action = \"operate\", as target = {right}, or a lower \
             speed, operation_delay_s or rest_ms"
        );
        SettingError::new("target", problem, allowed).at(Place::Row("step", index))
    }
}

/// Least way back to the target of a step at which a body turns: it has gone by before, early as
/// the operation before may have been.
fn least_turn(before: &Passed, held: f64) -> f64 {
    let early = before.lead[1] - before.slowest * held;
    if early > 0.0 {
        (early + COUNTS).ceil()
    } else {
        0.0
    }
}

/// The smallest and the largest of some numbers.
fn range(all: &[f64]) -> [f64; 2] {
    [
        all.iter().copied().fold(f64::INFINITY, f64::min),
        all.iter().copied().fold(0.0, f64::max),
    ]
}
