//! Laws that are swept, their types forgotten.

use super::circuits::make::{RULES, at_most, one_of};
use super::{AnyModel, Verdict};
use crate::check::{CheckError, Law, Swept, cases, sweep};
use crate::circuits::linear_interpolator::{Integrator, LineSweep};
use crate::circuits::trajectory_controller::error_feedback::FeedbackWidths;
use crate::circuits::trajectory_controller::{ErrorFeedback, FeedbackSweep};
use crate::hdl::Model;
use crate::trace::Clock;
use std::ops::{Range, RangeInclusive};
use std::path::Path;

/// A law of a circuit of the catalogue.
#[derive(Debug, Clone)]
pub struct SweepEntry {
    /// The circuit's name.
    pub circuit: &'static str,
    /// Makes it from the numbers that the circuit's [`Entry`](super::Entry) takes; `None` where
    /// there is none with them.
    pub make: fn(&[u64]) -> Option<Box<dyn AnySweep>>,
    /// The width it is swept at unless another is asked for.
    pub width: u64,
    /// The widths of which there are not too many cases.
    pub widths: RangeInclusive<u64>,
}

/// A case of the integrator's law is four positions: 2^32 cases at 8 bits.
const POSITIONS: RangeInclusive<u64> = 2..=8;

/// A case of the error feedback's law is error and way of two axes, and two gains: 2^28 cases at 4
/// bits.
const COUNTS: RangeInclusive<u64> = 2..=4;

/// Every law.
pub static SWEEPS: &[SweepEntry] = &[
    SweepEntry {
        circuit: "integrator",
        make: |given| {
            let rule = one_of(given, RULES)?;
            let width = given.first().filter(|width| POSITIONS.contains(*width))?;
            let position = *width as usize;
            Some(Box::new(LineSweep::new(Integrator { position, rule })))
        },
        width: 6,
        widths: POSITIONS,
    },
    SweepEntry {
        circuit: "error_feedback",
        make: |given| {
            at_most(given, 1)?;
            let width = given.first().filter(|width| COUNTS.contains(*width))?;
            let count = *width as usize;
            let widths = FeedbackWidths {
                count,
                position: count + 2,
                gain: count,
            };
            let feedback = ErrorFeedback { widths, axes: 2 };
            Some(Box::new(FeedbackSweep::new(feedback)))
        },
        width: 3,
        widths: COUNTS,
    },
];

/// A law with its circuit, its type forgotten.
pub trait AnySweep: Sync + AnyModel {
    /// What holds.
    fn law(&self) -> &str;
    /// The number of cases.
    ///
    /// # Errors
    /// They are too wide to be counted.
    fn cases(&self) -> Result<u64, CheckError>;
    /// Checks the cases with these indices; `waves` is where the first that is wrong is written as
    /// VCD and save file. A `model` is a netlist of the law to take in place of its own.
    ///
    /// # Errors
    /// They are too wide to be counted.
    fn sweep(
        &self,
        range: Range<u64>,
        model: Option<Model>,
        waves: Option<&Path>,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<Verdict<u64>, CheckError>;
}

impl<W: Law> AnySweep for W {
    fn law(&self) -> &str {
        Law::law(self)
    }

    fn cases(&self) -> Result<u64, CheckError> {
        cases(self)
    }

    fn sweep(
        &self,
        range: Range<u64>,
        model: Option<Model>,
        waves: Option<&Path>,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<Verdict<u64>, CheckError> {
        let mut swept = sweep(self).range(range).progress(progress);
        if let Some(model) = model {
            swept = swept.model(model);
        }
        Ok(match swept.run()? {
            Swept::Held(cases) => Verdict::Proved(cases),
            Swept::Counterexample(found) => Verdict::Broken {
                report: found.to_string(),
                waves: waves.map_or(Ok(Vec::new()), |directory| {
                    found.save(self, Clock::default(), directory)
                }),
            },
        })
    }
}
