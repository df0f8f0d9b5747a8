//! Summary of a run.

use super::Job;
use super::arm::{self, ArmRows};
use super::costs;
use super::figures::Figures;
use super::mechanism;
use super::operations;
use super::products::{self, Products};
use super::verdict::complaints;
use crate::cli::report::Outcome;
use motion_rtl::circuits::arc_generator::Widths;
use motion_rtl::jobs::arc_generator::job::Played;
use motion_rtl::jobs::arc_generator::measure::Measured;
use motion_rtl::jobs::arc_generator::settings::{Settings, least_sample_ticks};
use motion_rtl::path::record::WORDS;
use motion_rtl::sim::RunError;
use serde::Serialize;

/// The summary of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Fields that all summaries share.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Settings of the run, by the keys of `keys arc_generator --json-schema`.
    #[cfg_attr(
        feature = "schema",
        schemars(with = "crate::cli::schema::Settings<Settings>")
    )]
    pub settings: Settings,
    /// Ts in ticks.
    pub sample_ticks: u32,
    /// Ticks that the circuit needs of them.
    pub sample_ticks_needed: u64,
    /// 2ta in samples.
    pub blend_samples: u64,
    /// Samples, the start of the path with them.
    pub samples: u64,
    /// True if every sample is within its bound and the last one is the path's end.
    pub exact: bool,
    /// The last command, in counts.
    pub end_position: [i64; 3],
    /// The end of the path before it is rounded, in counts.
    pub end_demanded: [f64; 3],
    /// Measures of the commands.
    #[serde(flatten)]
    pub measured: Measured,
    /// Bits of the path's records.
    pub record_bits: u64,
    /// Bits of all of its commands, had they been stored beforehand.
    pub point_bits: u64,
    /// Blends by products beside those by differences.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub products: Option<Products>,
    /// Operations per sample.
    pub operations: Vec<operations::MethodOperations>,
    /// The circuit and, in a comparison, that of the conventional method.
    pub circuits: Vec<costs::CircuitCost>,
    /// Changes of speed, and what they make of the mechanism, beside those of the conventional
    /// method where that is compared.
    pub speed_changes: Vec<mechanism::SpeedChanges>,
    /// The joints of the arm, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arm: Option<ArmRows>,
}

impl Summary {
    /// The summary of a path that was played.
    pub fn new(job: &Job, played: &Played, figures: &Figures) -> Result<Self, RunError> {
        let settings = &job.settings;
        let complaints = complaints(job, played, figures);
        let measured = figures.measured.clone();
        let measured = measured.unwrap_or_else(|| Measured::planned(&job.prepared, settings));
        let last = played.last;
        let end = job.prepared.pieces.last();
        let widths = Widths::FULL;
        let bits = |rows: u64, words: usize, width: usize| rows * (words * width) as u64;
        let input = match &job.drawing {
            Some(drawing) => &drawing.file,
            None => &job.stem,
        };
        Ok(Summary {
            exact: complaints.is_empty(),
            outcome: Outcome {
                complaints,
                warnings: warnings(job, figures),
                ..Outcome::new("arc_generator", input, settings.clock_hz, played.ticks)
            },
            settings: settings.clone(),
            sample_ticks: job.sample_ticks,
            sample_ticks_needed: least_sample_ticks(settings.blend),
            blend_samples: job.prepared.timing.blend_samples,
            samples: played.samples,
            end_position: last.map_or([0; 3], |command| command.counts),
            end_demanded: end.map_or([0.0; 3], |piece| {
                piece.to.map(|mm| mm * settings.counts_per_mm)
            }),
            record_bits: bits(job.records.len() as u64, WORDS, widths.data),
            point_bits: bits(played.samples, 3, widths.position),
            products: products::products(job, figures.differing),
            operations: operations::rows(job),
            circuits: costs::rows(job, played, figures, &measured)?,
            measured,
            speed_changes: mechanism::rows(job, figures),
            arm: arm::rows(job),
        })
    }
}

/// Returns the warnings of the drawing and of its conversion to segments.
fn warnings(job: &Job, figures: &Figures) -> Vec<String> {
    let own = job.drawing.iter().flat_map(|drawing| &drawing.warnings);
    let both = [(&figures.beside, ""), (&figures.even, " without ramps")];
    let left = both.into_iter().filter_map(|(beside, how)| {
        let piece = beside.left?;
        Some(format!(
            "the conventional method{how} is not run: the whole arc of piece {piece} is no path in \
             words"
        ))
    });
    own.map(ToString::to_string).chain(left).collect()
}
