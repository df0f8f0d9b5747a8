//! The summary for people.

use super::rows::SegmentRow;
use super::runs::Run;
use super::summary::Summary;
use crate::cli::columns::Table;
use crate::cli::report::{Outcome, Report};
use crate::cli::rows::{fixed, fixed_or_dash, more, or_dash, worst};
use motion_rtl::circuits::trajectory_controller::path_point::AXIS_NAMES;
use motion_rtl::input::counted;
use motion_rtl::jobs::trajectory_controller::each_axis::EachAxis;
use motion_rtl::settings::tidy;
use std::fmt::{self, Write};

/// Width of the column that says what a row is of.
const NAME: usize = 18;

impl Report for Summary<'_> {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, all: bool) -> fmt::Result {
        writeln!(
            text,
            "{} ({}, {}): {} axes, {} periods, {}",
            self.outcome.subject(),
            self.settings.correction.name(),
            self.settings.rounding.name(),
            self.axes,
            self.periods,
            self.outcome.length()
        )?;
        writeln!(
            text,
            "a period of {} ms in {} ticks, of which the circuit needs {}; K1 = {}/s, K2 = {}/s; a \
             count is {:.3} um",
            tidy(self.settings.period_ms),
            self.period_ticks,
            self.period_ticks_needed,
            self.settings.k1_per_s,
            self.settings.k2_per_s,
            1e3 / self.settings.counts_per_mm
        )?;
        let [tangential, normal] = self.feedback_gains;
        writeln!(
            text,
            "the feedback has {tangential} of the error along the path, {normal} of that across it"
        )?;
        self.disturbances(text)?;
        self.tolerance(text)?;
        self.path(text)?;
        self.errors(text)?;
        self.circle(text)?;
        self.segments(text, all)?;
        Ok(())
    }
}

impl Summary<'_> {
    /// Writes the load torques, which the servo controls do not know.
    fn disturbances(&self, text: &mut String) -> fmt::Result {
        for torque in &self.settings.load_torque {
            let until = torque.to_s.map_or("on".to_owned(), |s| format!("to {s} s"));
            let axis = AXIS_NAMES[torque.axis.index()];
            let (nm, from) = (torque.torque_nm, torque.from_s);
            writeln!(
                text,
                "a torque of {nm} Nm on the load of {axis} from {from} s {until}"
            )?;
        }
        let told = &self.settings.inertia_factor;
        let wrong = *told != EachAxis::All(1.0);
        if wrong {
            writeln!(text, "the feed-forward is told {told} of the inertia")?;
        }
        let shown = self.corrections.iter().find(|row| row.in_waves);
        if (wrong || !self.settings.load_torque.is_empty())
            && let Some(row) = shown
        {
            let axes = row.measured.axes.iter();
            let off = axes.map(|axis| format!("{} {} um", axis.axis, fixed(axis.off_model_um, 1)));
            let off: Vec<_> = off.collect();
            writeln!(text, "motors off their models by up to {}", off.join(", "))?;
        }
        Ok(())
    }

    /// Writes the feed limit of the contour tolerance and the time that it costs.
    fn tolerance(&self, text: &mut String) -> fmt::Result {
        let full = self.corrections.iter().find(|row| row.full_feed);
        let Some(mm) = self.settings.contour_tolerance_mm else {
            return Ok(());
        };
        let full = full.map(|full| format!(", at full feed {:.3} s", full.planned_seconds));
        writeln!(
            text,
            "feed limited to a contour error of {} um without correction: {:.3} s{}",
            tidy(mm * 1e3),
            self.plan.seconds,
            full.unwrap_or_default()
        )
    }

    fn path(&self, text: &mut String) -> fmt::Result {
        let (path, plan) = (&self.path, &self.plan);
        write!(
            text,
            "path of {:.3} mm in {}, planned in {:.3} s at up to {} mm/s; {}",
            path.length_mm,
            counted(path.segments, "segment"),
            plan.seconds,
            fixed(plan.speed_max_mm_per_s, 3),
            match plan.stops {
                0 => "no stop".to_owned(),
                stops => counted(stops, "stop"),
            },
        )?;
        match plan.slowest_joint {
            None => writeln!(text, "\n"),
            Some(joint) => {
                let line = joint.line.map(|line| format!(", line {line}"));
                writeln!(
                    text,
                    ", slowest joint at feed: {} mm/s (segment {}{})\n",
                    fixed(joint.speed_mm_per_s, 3),
                    joint.segment,
                    line.unwrap_or_default()
                )
            }
        }
    }

    fn errors(&self, text: &mut String) -> fmt::Result {
        let torque = |row: &Run| {
            let axes = row.measured.axes.iter();
            axes.map(|axis| axis.torque_max_nm).fold(0.0, f64::max)
        };
        Table::of(self.corrections)
            .left("contour error um", NAME, |row| row.name())
            .col("model", 8, |row| {
                fixed(row.measured.model.contour_max_um, 3)
            })
            .col("rms", 8, |row| fixed(row.measured.model.contour_rms_um, 3))
            .col("load", 8, |row| fixed(row.measured.load.contour_max_um, 3))
            .col("rms", 8, |row| fixed(row.measured.load.contour_rms_um, 3))
            .col("at mm", 8, |row| fixed(row.measured.load.at_mm, 3))
            .col("following mm", 0, |row| {
                fixed(row.measured.load.following_max_mm, 4)
            })
            .col("end um", 6, |row| fixed(row.measured.load.end_um, 2))
            .col("torque Nm", 0, |row| fixed(torque(row), 3))
            .col("", 12, |row| if row.in_waves { "in the waves" } else { "" })
            .write_apart(text)
    }

    fn circle(&self, text: &mut String) -> fmt::Result {
        let circles = |full: bool| {
            let rows = self
                .corrections
                .iter()
                .filter(move |row| row.full_feed == full);
            rows.filter_map(|row| row.circle.as_ref())
        };
        let Some(first) = circles(false).next() else {
            return Ok(());
        };
        let full = circles(true).next();
        let full = full.map(|circle| fixed(circle.speed_mm_per_s, 3));
        writeln!(
            text,
            "circle of {} mm at {} mm/s{}: mean contour error of {} steady periods",
            fixed(first.radius_mm, 3),
            fixed(first.speed_mm_per_s, 3),
            full.map_or_else(String::new, |speed| format!(", at full feed {speed} mm/s")),
            first.periods
        )?;
        let circles = self.corrections.iter();
        let circles = circles.filter_map(|row| Some((row.name(), row.circle.as_ref()?)));
        Table::of(circles)
            .left("um", NAME, |(name, _)| *name)
            .col("model", 8, |(_, circle)| fixed(circle.model_um, 3))
            .col("sampled", 8, |(_, circle)| fixed(circle.sampled_um, 3))
            .col("continuous", 0, |(_, circle)| {
                fixed(circle.continuous_um, 3)
            })
            .col("load", 8, |(_, circle)| fixed(circle.load_um, 3))
            .write_apart(text)
    }

    fn segments(&self, text: &mut String, all: bool) -> fmt::Result {
        let shown = self.corrections.iter().position(|row| row.in_waves);
        let error = |row: &SegmentRow| {
            let shown = row.contour_um.get(shown.unwrap_or(0));
            shown.copied().flatten().unwrap_or(-1.0)
        };
        let (rows, left) = worst(&self.segments, all, error);
        let own = self.corrections.iter().filter(|row| !row.full_feed);
        let mut table = Table::of(rows)
            .col("segment", 0, |row| row.segment)
            .col("line", 4, |row| or_dash(row.line))
            .col("kind", 5, |row| row.kind)
            .col("length mm", 0, |row| fixed(row.length_mm, 3))
            .col("radius", 8, |row| fixed_or_dash(row.radius_mm, 3))
            .col("mm/s", 8, |row| fixed(row.speed_mm_per_s, 3))
            .col("wanted", 8, |row| fixed(row.speed_wanted_mm_per_s, 3))
            .col("entry", 8, |row| fixed(row.entry_mm_per_s, 3));
        for (index, run) in own.enumerate() {
            let error = |row: &&SegmentRow| fixed_or_dash(row.contour_um[index], 3);
            table = match index {
                0 => table.col(&format!("load um: {}", run.name()), 0, error),
                _ => table.col(run.name(), 8, error),
            };
        }
        table.write(text)?;
        more(text, left, "of smaller contour error")
    }
}
