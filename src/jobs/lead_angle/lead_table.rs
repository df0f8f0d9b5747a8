//! Leads of Fig. 7 by speed, computed from the machine's delays and its braking.

use super::job::WIDTHS;
use super::settings::{Action, CONVERSION_TICKS, Detector, Settings, TARGET_RANGE_COUNTS};
use crate::circuits::lead_angle::LeadTable;

/// Address width of the memory in bits: half of its words belong to each direction.
const ADDRESS: usize = 8;

/// Returns the latency in ticks from an encoder's pins to the control signal, without the wait for
/// a CK. For a phase-shift detector it includes the age of a crossing, half a CK on average; for a
/// resolver it starts at its strobe.
fn latency_ticks(settings: &Settings) -> f64 {
    match settings.detector {
        Detector::Incremental => 5.0,
        Detector::Absolute => 6.0,
        Detector::Resolver => 2.0 + f64::from(CONVERSION_TICKS),
        Detector::PhaseShift => 5.0 + 0.5 * f64::from(settings.ck_ticks),
    }
}

/// Returns θa for every speed of the steps, at nominal load: the distance that the body moves from
/// the encoder's pins, with an average wait of half a CK, to its stop or to the operation's
/// effect.
pub(super) fn lead_table(settings: &Settings) -> LeadTable {
    let ck_s = settings.ck_ms() / 1e3;
    let gate_s = f64::from(settings.cks(settings.speed_gate_ms)) * ck_s;
    let latency_s = latency_ticks(settings) / settings.clock_hz as f64 + 0.5 * ck_s;
    let steps = settings.steps.iter().map(|step| step.speed_counts_per_s);
    let fastest = f64::from(steps.max().unwrap_or(0)) * gate_s + 1.0;
    let widest = WIDTHS.position - ADDRESS;
    let covers = |fraction: &usize| fastest < (1u64 << (ADDRESS - 1 + fraction)) as f64;
    let fraction = (1..widest).find(covers).unwrap_or(widest);
    LeadTable::new(ADDRESS, WIDTHS.position, fraction, |way| {
        let speed = way.abs() as f64 / gate_s;
        let from_signal = match settings.action {
            Action::Stop => settings.body.stopping_way_counts(speed),
            Action::Operate => speed * settings.operation_delay_s,
        };
        let lead = (from_signal + speed * latency_s).round() as i64;
        // Limited to the greatest distance to a target.
        lead.min(*TARGET_RANGE_COUNTS.end()) * way.signum()
    })
}
