//! Laws that are swept, their types forgotten.

use super::{AnyModel, Verdict};
use crate::check::{CheckError, Law, Swept, cases, sweep};
use crate::sim::Elaborated;
use std::ops::Range;

/// A law with its circuit, its type forgotten.
pub trait AnySweep: AnyModel {
    /// Returns the statement that holds.
    fn law(&self) -> &str;
    /// Returns the number of cases.
    ///
    /// # Errors
    /// The inputs are too wide to be counted.
    fn cases(&self) -> Result<u64, CheckError>;
    /// Checks the cases with these indices. A `model` is a netlist of the law to take in place of its
    /// own.
    ///
    /// # Errors
    /// The inputs are too wide to be counted.
    fn sweep(
        &self,
        range: Range<u64>,
        model: Option<Elaborated>,
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
        model: Option<Elaborated>,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<Verdict<u64>, CheckError> {
        let mut swept = sweep(self).range(range).progress(progress);
        if let Some(model) = model {
            swept = swept.model(model);
        }
        Ok(match swept.run()? {
            Swept::Held(cases) => Verdict::Proved(cases),
            Swept::Counterexample(found) => Verdict::Broken(found.into_violation()),
        })
    }
}
