//! The summary for people.

use super::rows::{AxisRow, CorrectionRow, SegmentRow};
use super::summary::Summary;
use crate::cli::report::{Outcome, Report};
use crate::cli::rows::{fixed, more, or_dash, table, worst};
use motion_rtl::circuits::trajectory_controller::path_point::AXIS_NAMES;
use motion_rtl::jobs::trajectory_controller::each_axis::EachAxis;
use motion_rtl::settings::tidy;
use std::fmt::{self, Write};

/// Width of the column that says what a row is of.
const NAME: usize = 18;

impl Report for Summary {
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

/// A name, to the left.
fn name(name: &str) -> String {
    format!("{name:<NAME$}")
}

fn plural(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}

impl Summary {
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
            let off = |axis: &AxisRow| format!("{} {} um", axis.axis, fixed(axis.off_model_um, 1));
            let off: Vec<_> = row.axes.iter().map(off).collect();
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
            plural(path.segments, "segment"),
            plan.seconds,
            fixed(plan.speed_max_mm_per_s, 3),
            match plan.stops {
                0 => "no stop".to_owned(),
                stops => plural(stops, "stop"),
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
        let title = name("contour error um");
        let heads = [
            (title.as_str(), 0),
            ("model", 8),
            ("rms", 8),
            ("load", 8),
            ("rms", 8),
            ("at mm", 8),
            ("following mm", 0),
            ("end um", 6),
            ("torque Nm", 0),
            ("", 12),
        ];
        let cells = self.corrections.iter().map(|row| {
            let torques = row.axes.iter().map(|axis: &AxisRow| axis.torque_max_nm);
            [
                name(row.name),
                fixed(row.model.contour_max_um, 3),
                fixed(row.model.contour_rms_um, 3),
                fixed(row.load.contour_max_um, 3),
                fixed(row.load.contour_rms_um, 3),
                fixed(row.load.at_mm, 3),
                fixed(row.load.following_max_mm, 4),
                fixed(row.load.end_um, 2),
                fixed(torques.fold(0.0, f64::max), 3),
                if row.in_waves { "in the waves" } else { "" }.to_owned(),
            ]
        });
        table(text, heads, cells)?;
        text.push('\n');
        Ok(())
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
        let title = name("um");
        let heads = [
            (title.as_str(), 0),
            ("model", 8),
            ("sampled", 8),
            ("continuous", 0),
            ("load", 8),
        ];
        let circles = self.corrections.iter().filter_map(|row: &CorrectionRow| {
            let circle = row.circle.as_ref()?;
            Some([
                name(row.name),
                fixed(circle.model_um, 3),
                fixed(circle.sampled_um, 3),
                fixed(circle.continuous_um, 3),
                fixed(circle.load_um, 3),
            ])
        });
        table(text, heads, circles)?;
        text.push('\n');
        Ok(())
    }

    fn segments(&self, text: &mut String, all: bool) -> fmt::Result {
        let shown = self.corrections.iter().position(|row| row.in_waves);
        let error = |row: &SegmentRow| {
            let shown = row.contour_um.get(shown.unwrap_or(0));
            shown.copied().flatten().unwrap_or(-1.0)
        };
        let (rows, left) = worst(&self.segments, all, error);
        let own = self.corrections.iter().filter(|row| !row.full_feed);
        let names: Vec<_> = own.map(|row| row.name).collect();
        let first = names.first().map(|name| format!("load um: {name}"));
        let first = first.unwrap_or_default();
        let mut heads = vec![
            ("segment", 0),
            ("line", 4),
            ("kind", 5),
            ("length mm", 0),
            ("radius", 8),
            ("mm/s", 8),
            ("wanted", 8),
            ("entry", 8),
            (first.as_str(), 0),
        ];
        heads.extend(names.iter().skip(1).map(|name| (*name, 8)));
        let cells = rows.into_iter().map(|row| {
            let mut cells = vec![
                row.segment.to_string(),
                or_dash(row.line),
                row.kind.to_owned(),
                fixed(row.length_mm, 3),
                or_dash(row.radius_mm.map(|mm| fixed(mm, 3))),
                fixed(row.speed_mm_per_s, 3),
                fixed(row.speed_wanted_mm_per_s, 3),
                fixed(row.entry_mm_per_s, 3),
            ];
            let errors = row.contour_um.iter();
            cells.extend(errors.map(|um| or_dash(um.map(|um| fixed(um, 3)))));
            cells
        });
        table(text, heads, cells)?;
        more(text, left, "of smaller contour error")
    }
}
