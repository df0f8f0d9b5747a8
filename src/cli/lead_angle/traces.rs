//! The files of a run: waves, save file, and the circuit in Verilog with its stimulus.

use super::Job;
use crate::cli::Failure;
use crate::cli::files::Files;
use crate::cli::run::{Arguments, clock, not_selected, verilog};
use motion_rtl::kernel::Without;
use motion_rtl::lead_angle::Compensator;
use motion_rtl::lead_angle::job::{JobLead, Positioner};
use motion_rtl::trace::atomic::AtomicFile;
use motion_rtl::trace::{Clock, Options, StimulusFile, Vcd, gtkw};
use std::io;
use std::ops::Range;
use std::path::Path;

/// CKs that the save file's window shows.
const CKS_SHOWN: u64 = 400;

/// The files while the run goes on.
pub struct Traces<'a, P: JobLead> {
    job: &'a Job,
    options: &'a Options,
    clock: Clock,
    files: Files,
    pub vcd: Option<Vcd<Positioner<P>, AtomicFile>>,
    pub stimulus: Option<Without<StimulusFile<Compensator<P>, AtomicFile>>>,
}

impl<'a, P: JobLead> Traces<'a, P> {
    /// Begins what is asked for of a run of about so many ticks.
    pub fn begin(
        circuit: &Positioner<P>,
        arguments: &Arguments,
        job: &'a Job,
        options: &'a Options,
        ticks: u64,
    ) -> Result<Self, Failure> {
        let clock = clock(arguments, &job.loaded, ticks, options)?;
        let directory = arguments.out.as_deref().unwrap_or(Path::new("waves"));
        let mut files = Files::begin(directory, &job.stem)?;
        let vcd = match arguments.no_vcd {
            true => None,
            false => {
                let dump = Vcd::new(files.create("vcd")?, circuit, clock, options);
                Some(dump.map_err(|error| not_selected(&error))?)
            }
        };
        let stimulus = match arguments.verilog {
            true => Some(Without(verilog(&circuit.circuit, &mut files)?)),
            false => None,
        };
        Ok(Traces {
            job,
            options,
            clock,
            files,
            vcd,
            stimulus,
        })
    }

    /// Closes them after so many ticks, with a save file whose window has the tick `action` in its
    /// middle, where that is in the dump.
    pub fn finish(
        mut self,
        circuit: &Positioner<P>,
        action: u64,
        ticks: u64,
    ) -> Result<Files, Failure> {
        if let Some(Without(stimulus)) = self.stimulus {
            self.files.push(stimulus.finish()?);
        }
        if let Some(vcd) = self.vcd {
            let shown = CKS_SHOWN * u64::from(self.job.settings.ck_ticks);
            let Range { start, end } = self.options.ticks;
            let first = match action < end {
                true => action.saturating_sub(shown / 2).max(start),
                false => start,
            };
            let focus = first..(first + shown).min(ticks.max(first + 1));
            let stem = &self.job.stem;
            let save = gtkw::save_file(circuit, self.clock, self.options, stem, focus);
            self.files.push(vcd.finish()?);
            self.files.write("gtkw", &save.map_err(io::Error::from)?)?;
        }
        Ok(self.files)
    }
}
