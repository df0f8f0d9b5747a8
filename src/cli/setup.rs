//! Setup of a run: arguments, scenario, and the window and the clock of its waves.

use super::Failure;
use super::arguments::Arguments;
use motion_rtl::scenario::Loaded;
use motion_rtl::trace::{Clock, Options, Rows, SeriesLayout};
use std::ops::Range;

/// Arguments and scenario of a run, with the window of its waves.
#[derive(Debug)]
pub struct Setup<'a> {
    pub arguments: &'a Arguments,
    pub loaded: &'a Loaded,
    /// Stem of the names of its files.
    pub stem: &'a str,
    /// Ticks and signals in the waves.
    pub options: Options,
}

impl<'a> Setup<'a> {
    /// Sets up a run; refuses an empty window.
    pub fn new(
        arguments: &'a Arguments,
        loaded: &'a Loaded,
        stem: &'a str,
    ) -> Result<Self, Failure> {
        let most = loaded.scenario.vcd_ticks();
        let from = arguments.from.unwrap_or(0);
        let to = arguments.to.unwrap_or_else(|| from.saturating_add(most));
        if from >= to {
            return Err(Failure::Argument {
                field: "--from, --to",
                problem: format!("no tick from {from} to {to}"),
                allowed: "--from below --to".into(),
            });
        }
        let only = (!arguments.only.is_empty()).then(|| arguments.only.clone());
        let ticks = from..to;
        Ok(Setup {
            arguments,
            loaded,
            stem,
            options: Options { ticks, only },
        })
    }

    /// True if no file needs every tick of the run.
    pub fn skips_ticks(&self) -> bool {
        let Arguments {
            no_vcd,
            verilog,
            plan,
            series_every,
            ..
        } = *self.arguments;
        // A row at a strobe is in a tick with a change.
        no_vcd && !verilog && !plan && series_every.is_none()
    }

    /// Returns the layout of the requested series, of which `layout` has the rows unless the
    /// command line says otherwise.
    pub fn series<'s>(
        &self,
        layout: impl FnOnce() -> SeriesLayout<'s>,
    ) -> Option<SeriesLayout<'s>> {
        self.arguments.series.as_ref()?;
        let layout = layout();
        let every = self.arguments.series_every.map(Rows::Every);
        Some(SeriesLayout {
            rows: every.unwrap_or(layout.rows),
            ..layout
        })
    }

    /// Returns the ticks that may have rows in the series: without `--to` all to the end.
    pub fn series_ticks(&self) -> Range<u64> {
        self.options.ticks.start..self.arguments.to.unwrap_or(u64::MAX)
    }

    /// Returns how many of a run's `ticks` are in the waves.
    pub fn in_waves(&self, ticks: u64) -> u64 {
        let window = &self.options.ticks;
        match self.arguments.no_vcd {
            true => 0,
            false => window.end.min(ticks).saturating_sub(window.start),
        }
    }

    /// Refuses a window that begins after the end of a run of `ticks` ticks.
    pub fn check_window(&self, ticks: u64) -> Result<(), Failure> {
        let start = self.options.ticks.start;
        if start < ticks {
            return Ok(());
        }
        Err(Failure::Argument {
            field: "--from",
            problem: format!("is {start}"),
            allowed: format!("0 to {}, the last tick of the run", ticks.saturating_sub(1)),
        })
    }

    /// Returns the clock of the waves, in which the last tick must have a time. A count of
    /// `u64::MAX` ticks stands for all that are greater.
    pub fn clock(&self, ticks: u64) -> Result<Clock, Failure> {
        let refuse = |problem: String, allowed: String| {
            let fault = self.loaded.fault("clock_hz", problem, allowed);
            Err(fault.into())
        };
        let hz = self.loaded.scenario.clock_hz();
        let clock = match Clock::from_hz(hz) {
            Ok(clock) => clock,
            Err(error) => return refuse(error.to_string(), format!("1 to {} Hz", Clock::MAX_HZ)),
        };
        if ticks == u64::MAX {
            return refuse(
                format!("is {hz}: the run takes 2^64 ticks or more"),
                "a run of fewer ticks: a slower clock, or faster motions".to_owned(),
            );
        }
        let last = self.options.ticks.end.min(ticks);
        if clock.rise(last).is_none() && !self.arguments.no_vcd {
            let allowed =
                "a clock whose period is not rounded to 1 fs, an earlier --to, or --no-vcd";
            return refuse(
                format!("is {hz}: tick {last} is 2^64 fs or more after tick 0"),
                allowed.to_owned(),
            );
        }
        Ok(clock)
    }
}
