//! Blends by products beside those by differences.

use super::Job;
use motion_rtl::circuits::arc_generator::{Blend, Widths};
use motion_rtl::jobs::arc_generator::job::Played;
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::arc_generator::reference::commands;
use serde::Serialize;
use std::fmt::{self, Write};

/// How far the commands are from those of difference engines.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Samples whose commands differ.
    pub samples_differing: usize,
    /// By how many counts a coordinate differs at most.
    pub counts_most: u64,
}

/// Of a run whose blends are made by products.
#[derive(Debug, Serialize)]
pub struct Products {
    /// The most samples that a blend by differences may have.
    pub difference_samples_most: u64,
    /// Beside difference engines; nothing where their words do not hold a blend of this path.
    pub differences: Option<Row>,
}

/// The commands that were played, beside those of difference engines, which are what the circuit
/// makes; nothing where the run is one by differences itself.
pub fn products(job: &Job, played: &Played) -> Option<Products> {
    let (settings, widths) = (&job.settings, Widths::FULL);
    if settings.blend == Blend::Differences {
        return None;
    }
    let difference_samples_most = Blend::Differences.most_samples(&widths);
    let holds = job.prepared.timing.blend_samples <= difference_samples_most;
    let (scale, rounding) = (settings.counts_per_mm, settings.rounding);
    let made = holds.then(|| records(&job.prepared, scale, &widths, rounding).ok());
    let differences = made.flatten().map(|records| {
        let others = commands(&records, &widths, rounding);
        let pairs = played.commands.iter().zip(others);
        let off = pairs.map(|(own, other)| {
            let coordinates = own.counts.into_iter().zip(other);
            coordinates.map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
        });
        Row {
            samples_differing: off.clone().filter(|&counts| counts > 0).count(),
            counts_most: off.max().unwrap_or(0),
        }
    });
    Some(Products {
        difference_samples_most,
        differences,
    })
}

impl Products {
    /// A line of the summary.
    pub fn write(&self, text: &mut String, samples: usize) -> fmt::Result {
        match &self.differences {
            Some(row) => writeln!(
                text,
                "blends by products: {} of {samples} samples differ from those by differences, by \
                 {} counts at most\n",
                row.samples_differing, row.counts_most
            ),
            None => writeln!(
                text,
                "blends by products: by differences a blend has {} samples at most\n",
                self.difference_samples_most
            ),
        }
    }
}
