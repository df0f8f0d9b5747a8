//! Operations per sample: by the conventional method, by the patent's formulas as written, and in
//! the circuit.

use super::Job;
use motion_rtl::circuits::arc_generator::{Blend, BlendPoint, Widths};
use motion_rtl::circuits::blocks::CoefficientControl;
use motion_rtl::jobs::arc_generator::conventional::{
    Conventional, Operations, blend, blend_terms, difference_engines, products, rotation,
};
use motion_rtl::path::vector::rodrigues;
use serde::Serialize;

/// Ticks of a step of the rotation.
const ROTATION_TICKS: u64 = CoefficientControl {
    coefficient: Widths::FULL.coefficient,
}
.latency();

/// Ticks of a point of a blend by products.
const PRODUCT_TICKS: u64 = BlendPoint {
    widths: Widths::FULL,
}
.latency();

/// Operations of a sample.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MethodOperations {
    /// Name of the method and what it computes.
    pub method: &'static str,
    /// Products.
    pub multiplications: u64,
    /// Sums, differences and comparisons.
    pub additions: u64,
    /// Sines and cosines.
    pub sines_and_cosines: u64,
    /// Ticks that the circuit takes.
    pub ticks: Option<u64>,
}

/// Returns the circuit's row and, in a comparison, each method's; empty if the path has no arc.
pub fn rows(job: &Job) -> Vec<MethodOperations> {
    let mut arcs = job.prepared.pieces.iter();
    let found = arcs.find_map(|piece| Some((piece, piece.arc?)));
    let Some((piece, arc)) = found else {
        return Vec::new();
    };
    let run = Conventional::new(&arc.circle, piece.wanted, &job.prepared.timing);
    let cost = |sample: u64| {
        let mut samples = run.samples().map(|(_, operations)| operations);
        samples.nth(sample as usize).unwrap_or_default()
    };
    let matrix = rodrigues(arc.circle.axis, arc.step);
    let [from, to] = piece.between_blends();
    let (_, rotation) = rotation(&matrix, &mut from.clone(), arc.circle.centre);
    let (_, quartic) = blend(&blend_terms(piece.from, piece.from, to), 0.5);
    let mut rows = Vec::new();
    if job.loaded.scenario.beside() {
        rows.push(("conventional, arc", cost(run.ramp + 1), None));
        rows.push(("conventional, accelerating", cost(1), None));
    }
    rows.extend([
        ("patent, arc", rotation, None),
        ("patent, blend", quartic, None),
        // Nine products at once, a bit of the coefficients a tick.
        ("circuit, arc", rotation, Some(ROTATION_TICKS)),
    ]);
    let (blends, ticks) = match job.settings.blend {
        Blend::Differences => (difference_engines(), 1),
        Blend::Products => (products(), PRODUCT_TICKS),
    };
    if let Ok(blends) = blends {
        rows.push(("circuit, blend and line", blends, Some(ticks)));
    }
    let row = |(method, operations, ticks): (_, Operations, _)| MethodOperations {
        method,
        multiplications: operations.multiplications,
        additions: operations.additions,
        sines_and_cosines: operations.trigonometric,
        ticks,
    };
    rows.into_iter().map(row).collect()
}
