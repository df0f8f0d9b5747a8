//! Laws that are swept, their types forgotten.

use super::Verdict;
use super::circuits::make::{RULES, one_of};
use crate::check::{CheckError, Law, Swept, cases, sweep};
use crate::files::Directory;
use crate::linear_interpolator::{Integrator, LineSweep, Rule};
use crate::trace::Clock;
use std::ops::Range;
use std::path::Path;

/// A law of a circuit of the catalogue.
#[derive(Debug, Clone, Copy)]
pub struct SweepEntry {
    /// The circuit's name.
    pub circuit: &'static str,
    /// Makes it from the numbers that the circuit's [`Entry`](super::Entry) takes; `None` where
    /// there is none with them.
    pub make: fn(&[u64]) -> Option<Box<dyn AnySweep>>,
    /// The widths it takes.
    pub widths: &'static [u64],
    /// The width it is swept at unless another is asked for.
    pub width: u64,
}

/// Every law.
pub static SWEEPS: &[SweepEntry] = &[SweepEntry {
    circuit: "integrator",
    make: |given| {
        let rule = one_of(given, RULES)?;
        Some(match given.first()? {
            3 => line::<3, 6>(rule),
            6 => line::<6, 12>(rule),
            8 => line::<8, 16>(rule),
            _ => return None,
        })
    },
    widths: &[3, 6, 8],
    width: 6,
}];

fn line<const P: usize, const R: usize>(rule: Rule) -> Box<dyn AnySweep> {
    Box::new(LineSweep::<P, R>::new(Integrator::new(rule)))
}

/// A law with its circuit, its type forgotten.
pub trait AnySweep: Sync {
    /// What holds.
    fn law(&self) -> &str;
    /// The number of cases.
    ///
    /// # Errors
    /// They are too wide to be counted.
    fn cases(&self) -> Result<u64, CheckError>;
    /// Checks the cases with these indices; `waves` is where the first that is wrong is written as
    /// VCD and save file.
    ///
    /// # Errors
    /// They are too wide to be counted.
    fn sweep(
        &self,
        range: Range<u64>,
        waves: Option<&Path>,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<Verdict<u64>, CheckError>;
}

impl<W: Law> AnySweep for W {
    fn law(&self) -> &str {
        self.name()
    }

    fn cases(&self) -> Result<u64, CheckError> {
        cases::<W>()
    }

    fn sweep(
        &self,
        range: Range<u64>,
        waves: Option<&Path>,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<Verdict<u64>, CheckError> {
        let swept = sweep(self).range(range).progress(progress);
        Ok(match swept.run()? {
            Swept::Held(cases) => Verdict::Proved(cases),
            Swept::Counterexample(found) => Verdict::Broken {
                report: found.to_string(),
                waves: waves.map_or(Ok(Vec::new()), |directory| {
                    let _directory = Directory::create(directory)?;
                    found.save(self.circuit(), Clock::default(), directory)
                }),
            },
        })
    }
}
