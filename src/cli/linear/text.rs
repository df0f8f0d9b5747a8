//! The summary for people.

use super::rows::{Figures, Row};
use super::summary::{Summary, SystemSummary};
use super::{other_name, way_name};
use crate::cli::report::{Outcome, Report};
use motion_rtl::jobs::linear_interpolator::ways::Way;
use std::fmt::Write;

/// Cycles in the table, unless all are asked for.
const SHOWN: usize = 12;

impl Report for Summary {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, all: bool) -> std::fmt::Result {
        writeln!(
            text,
            "{} ({}, master {}): {} scans, {}\n",
            self.outcome.subject(),
            self.settings.rule.name(),
            self.settings.master.name(),
            self.scans,
            self.outcome.length()
        )?;
        writeln!(
            text,
            "{:35}  scans  seconds       end position    deviation  contour error  of rapid moves  \
             acceleration of master, slave",
            "system"
        )?;
        totals(text, "interpolator", &self.interpolator)?;
        if let (Some(master), Some(other)) = (self.other_master, &self.interpolator_other_master) {
            totals(text, &other_name(master), other)?;
        }
        for (way, system) in Way::ALL
            .iter()
            .zip([&self.conventional, &self.conventional_in_proportion])
        {
            if let Some(system) = system {
                totals(text, &way_name(*way), system)?;
            }
        }
        text.push('\n');
        if !self.segments.is_empty() {
            self.table(text, all)?;
        }
        Ok(())
    }
}

impl Summary {
    fn table(&self, text: &mut String, all: bool) -> std::fmt::Result {
        let others = match self.conventional {
            None => &[][..],
            Some(_) => &["conventional, same settings", "in proportion"],
        };
        write!(
            text,
            "{:44}  {:^17}  {:^35}",
            "", "speed in mm/min", "interpolator"
        )?;
        for name in others {
            write!(text, "  {name:^36}")?;
        }
        let figures = "    scans    deviation  contour error";
        write!(
            text,
            "\nsegment  line   pen      dx       dy  master     asked   reached{figures}"
        )?;
        for _ in others {
            write!(text, " {figures}")?;
        }
        text.push('\n');
        let mut rows: Vec<&Row> = self.segments.iter().collect();
        if !all {
            // Drawn moves matter more.
            rows.sort_by(|a, b| {
                let error = |row: &Row| row.interpolator.contour_error_um;
                a.rapid.cmp(&b.rapid).then(error(b).total_cmp(&error(a)))
            });
            rows.truncate(SHOWN);
        }
        for row in &rows {
            write!(
                text,
                "{:>7}  {:>4}  {:>4}  {:>6}  {:>7}  {:>6}  {:>8.1}  {:>8.1}  {}",
                row.segment,
                row.line,
                if row.rapid { "up" } else { "down" },
                row.delta[0],
                row.delta[1],
                row.master,
                row.speed_asked_mm_per_min,
                row.speed_reached_mm_per_min,
                columns(&row.interpolator),
            )?;
            let others = [&row.conventional, &row.conventional_in_proportion];
            for figures in others.into_iter().flatten() {
                write!(text, "  {}", columns(figures))?;
            }
            text.push('\n');
        }
        let more = self.segments.len() - rows.len();
        if more > 0 {
            writeln!(
                text,
                "and {more} more, of smaller contour error or with the pen up: --segments shows all"
            )?;
        }
        Ok(())
    }
}

fn totals(text: &mut String, name: &str, system: &SystemSummary) -> std::fmt::Result {
    let [x, y] = system.end_position;
    writeln!(
        text,
        "{name:<33} {:>7} {:>8.3}  {:>17}  {:>7.3} LSB  {:>10.1} um  {:>11.1} um  {:>9}, {:>3} counts/scan2",
        system.scans,
        system.seconds,
        format!("{x}, {y}"),
        rounded_down(system.deviation_max_lsb),
        system.contour_error_max_um,
        system.contour_error_max_rapid_um,
        system.master_acceleration_max_counts_per_scan2,
        system.slave_acceleration_max_counts_per_scan2,
    )
}

fn columns(figures: &Figures) -> String {
    format!(
        "{:>7}  {:>7.3} LSB  {:>10.1} um",
        figures.scans,
        rounded_down(figures.deviation_lsb),
        figures.contour_error_um
    )
}

/// To thousandths: what is below 1 does not show as 1.
fn rounded_down(lsb: f64) -> f64 {
    (lsb * 1000.0 + 1e-6).floor() / 1000.0
}

#[cfg(test)]
mod tests {
    use super::rounded_down;

    #[test]
    fn a_deviation_below_one_does_not_show_as_one() {
        let shown = [0.999_88, 1.0, 0.3, 0.5, 0.0].map(|lsb| format!("{:.3}", rounded_down(lsb)));
        assert_eq!(shown, ["0.999", "1.000", "0.300", "0.500", "0.000"]);
    }
}
