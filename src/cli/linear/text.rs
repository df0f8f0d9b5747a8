//! The summary for people.

use super::rows::{Figures, Row};
use super::summary::Summary;
use super::{other_name, way_name};
use crate::cli::columns::Table;
use crate::cli::report::{Outcome, Report};
use crate::cli::rows::or_dash;
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
        let mut systems = vec![("interpolator".to_owned(), &self.interpolator)];
        let other = self.interpolator_other_master.as_ref();
        systems.extend(self.other_master.map(other_name).zip(other));
        let ways = [&self.conventional, &self.conventional_in_proportion];
        let ways = Way::ALL.into_iter().zip(ways);
        systems.extend(ways.filter_map(|(way, system)| Some((way_name(way), system.as_ref()?))));
        Table::of(systems)
            .left("system", 33, |(name, _)| name.clone())
            .col("scans", 6, |(_, system)| system.scans)
            .col("seconds", 7, |(_, system)| format!("{:.3}", system.seconds))
            .col("end position", 17, |(_, system)| {
                let [x, y] = system.end_position;
                format!("{x}, {y}")
            })
            .col("deviation", 11, |(_, system)| lsb(system.deviation_max_lsb))
            .col("contour error", 0, |(_, system)| {
                um(system.contour_error_max_um)
            })
            .col("of rapid moves", 0, |(_, system)| {
                um(system.contour_error_max_rapid_um)
            })
            .left("acceleration of master, slave", 0, |(_, system)| {
                format!(
                    "{:>9}, {:>3} counts/scan2",
                    system.master_acceleration_max_counts_per_scan2,
                    system.slave_acceleration_max_counts_per_scan2
                )
            })
            .write(text)?;
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
        text.push('\n');
        let mut rows: Vec<&Row> = self.segments.iter().collect();
        if !all {
            // Drawn moves matter more.
            rows.sort_by(|a, b| {
                let error = |row: &Row| row.interpolator.segment.contour_um;
                a.rapid.cmp(&b.rapid).then(error(b).total_cmp(&error(a)))
            });
            rows.truncate(SHOWN);
        }
        let mut table = Table::of(&rows)
            .col("segment", 0, |row| row.segment)
            .col("line", 0, |row| row.line)
            .col("pen", 4, |row| if row.rapid { "up" } else { "down" })
            .col("dx", 6, |row| row.delta[0])
            .col("dy", 7, |row| row.delta[1])
            .col("master", 0, |row| row.master)
            .col("asked", 8, |row| {
                format!("{:.1}", row.speed_asked_mm_per_min)
            })
            .col("reached", 8, |row| {
                format!("{:.1}", row.speed_reached_mm_per_min)
            });
        let systems: [fn(&Row) -> Option<Figures>; 3] = [
            |row| Some(row.interpolator),
            |row| row.conventional,
            |row| row.conventional_in_proportion,
        ];
        for of in &systems[..=others.len()] {
            let segment = |row: &&&Row| of(row).map(|figures| figures.segment);
            table = table
                .col("scans", 7, |row| or_dash(segment(row).map(|of| of.scans)))
                .col("deviation", 11, |row| {
                    or_dash(segment(row).map(|of| lsb(of.deviation.lsb())))
                })
                .col("contour error", 0, |row| {
                    or_dash(segment(row).map(|of| um(of.contour_um)))
                });
        }
        table.write(text)?;
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

/// Formats a deviation.
fn lsb(deviation: f64) -> String {
    format!("{:.3} LSB", rounded_down(deviation))
}

/// Formats a distance.
fn um(distance: f64) -> String {
    format!("{distance:.1} um")
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
