//! Costs of the circuit and of the conventional one.

use super::Job;
use super::figures::Figures;
use motion_rtl::circuits::arc_generator::Conventional;
use motion_rtl::jobs::arc_generator::job::{Played, arc_generator};
use motion_rtl::jobs::arc_generator::measure::Measured;
use motion_rtl::sim::{Elaborated, RunError};
use serde::Serialize;

/// A circuit.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CircuitCost {
    /// Name of the circuit.
    pub circuit: &'static str,
    /// Adders, subtractors and comparators.
    pub adders: u64,
    /// Bits of the adders, subtractors and comparators.
    pub adder_bits: u64,
    /// Bits of registers.
    pub flip_flops: u64,
    /// Ticks from a sampling time to the next point: on a line or blend.
    pub ticks_straight: Option<u64>,
    /// Ticks from a sampling time to the next point on an arc.
    pub ticks_arc: Option<u64>,
    /// Ticks from a sampling time to the first point of the next segment.
    pub ticks_change: Option<u64>,
    /// Most of these: the shortest sampling time.
    pub ticks_most: u64,
    /// True if no point was late.
    pub in_time: bool,
    /// Largest distance of a command from its exact point.
    pub error_max_um: f64,
    /// Bound of `error_max_um`.
    pub error_bound_um: f64,
}

impl CircuitCost {
    fn of(model: &Elaborated, played: &Played, [error_max_um, error_bound_um]: [f64; 2]) -> Self {
        let cost = model.cost();
        let needed = played.needed;
        let there = |ticks: u64| (ticks > 0).then_some(ticks);
        CircuitCost {
            circuit: model.name(),
            adders: cost.adders,
            adder_bits: cost.adder_bits,
            flip_flops: cost.register_bits,
            ticks_straight: there(needed.straight),
            ticks_arc: there(needed.arc),
            ticks_change: there(needed.change),
            ticks_most: needed.most(),
            in_time: !played.late,
            error_max_um,
            error_bound_um,
        }
    }
}

/// Returns the circuit and, in a comparison, the conventional one; empty if the path has no arc or
/// an arc is not compared.
pub fn rows(
    job: &Job,
    played: &Played,
    figures: &Figures,
    measured: &Measured,
) -> Result<Vec<CircuitCost>, RunError> {
    let beside = &figures.beside;
    let compared = job.loaded.scenario.beside();
    if figures.arcs.is_empty() || compared && beside.arcs.is_empty() {
        return Ok(Vec::new());
    }
    let rounding = job.settings.rounding;
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let own = [measured.error_max_um, measured.error_bound_um];
    let own = CircuitCost::of(
        &Elaborated::new(&arc_generator(&job.settings))?,
        played,
        own,
    );
    if !compared {
        return Ok(vec![own]);
    }
    let arcs = &beside.arcs;
    let other = [
        most(&mut arcs.iter().map(|arc| arc.error)) * 1e3,
        most(&mut arcs.iter().map(|arc| arc.bound)) * 1e3,
    ];
    Ok(vec![
        own,
        CircuitCost::of(
            &Elaborated::new(&Conventional::new(rounding))?,
            &beside.played,
            other,
        ),
    ])
}
