//! Blends by products beside those by differences.

use super::Job;
use motion_rtl::circuits::arc_generator::{Blend, Widths};
use motion_rtl::input::COORDINATES;
use motion_rtl::jobs::arc_generator::reference::commands;
use serde::Serialize;
use std::fmt::{self, Write};

/// Differences between the commands and those of difference engines.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ProductsBeside {
    /// Samples whose commands differ.
    pub samples_differing: u64,
    /// Largest difference of a coordinate in counts.
    pub counts_most: u64,
}

/// Summary of a run whose blends are made by products.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Products {
    /// The most samples that a blend by differences may have.
    pub difference_samples_most: u64,
    /// Comparison with difference engines; `None` if a blend of this path exceeds their words.
    pub differences: Option<ProductsBeside>,
}

/// Comparison of successive commands with those of difference engines, which the circuit makes.
pub struct Differing<'j> {
    others: Box<dyn Iterator<Item = [i64; COORDINATES]> + 'j>,
    row: ProductsBeside,
}

impl<'j> Differing<'j> {
    /// Starts before the first command; `None` if there is nothing to compare with.
    pub fn of(job: &'j Job) -> Option<Self> {
        let records = job.differences.as_ref()?;
        Some(Differing {
            others: Box::new(commands(records, &Widths::FULL, job.settings.rounding)),
            row: ProductsBeside {
                samples_differing: 0,
                counts_most: 0,
            },
        })
    }

    /// Takes the next command in counts.
    pub fn take(&mut self, counts: [i64; COORDINATES]) {
        let others = self.others.next().unwrap_or(counts);
        let pairs = counts.into_iter().zip(others);
        let off = pairs.map(|(own, other)| own.abs_diff(other)).max();
        let off = off.unwrap_or(0);
        self.row.samples_differing += u64::from(off > 0);
        self.row.counts_most = self.row.counts_most.max(off);
    }

    /// Returns the differences of all commands.
    pub fn finish(self) -> ProductsBeside {
        self.row
    }
}

/// Compares blends by products with those by differences; `None` for a run by differences.
pub fn products(job: &Job, differences: Option<ProductsBeside>) -> Option<Products> {
    (job.settings.blend == Blend::Products).then(|| Products {
        difference_samples_most: Blend::Differences.most_samples(&Widths::FULL),
        differences,
    })
}

impl Products {
    /// A line of the summary.
    pub fn write(&self, text: &mut String, samples: u64) -> fmt::Result {
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
