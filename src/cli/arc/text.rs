//! The summary for people.

use super::mechanism;
use super::rows::{ArcRow, BlendRow, LineRow};
use super::summary::Summary;
use crate::cli::columns::Table;
use crate::cli::report::{Outcome, Report};
use crate::cli::rows::{fixed, more, or_dash, table, worst};
use motion_rtl::input::Point;
use std::fmt::{self, Write};

impl Report for Summary {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, all: bool) -> fmt::Result {
        let [x, y, z] = self.end_position;
        writeln!(
            text,
            "{} ({}): {} samples, {}",
            self.outcome.subject(),
            self.settings.rounding.name(),
            self.samples,
            self.outcome.length()
        )?;
        writeln!(
            text,
            "a sample in {} ticks, of which the circuit needs {}; blends of {} samples; a count is \
             {:.3} um",
            self.sample_ticks,
            self.sample_ticks_needed,
            self.blend_samples,
            1e3 / self.settings.counts_per_mm
        )?;
        writeln!(
            text,
            "ends at {x}, {y}, {z} counts{}\ncommands are at most {:.3} um off their exact points, \
             the bound is {:.3} um\nthe path is {} bits of records; all of its points would be {}\n",
            match self.exact {
                true => ", where the path does",
                false => "",
            },
            self.error_max_um,
            self.error_bound_um,
            self.record_bits,
            self.point_bits
        )?;
        self.arcs(text, all)?;
        self.lines(text, all)?;
        self.blends(text, all)?;
        if let Some(products) = &self.products {
            products.write(text, self.samples)?;
        }
        self.operations(text)?;
        if let Some(arm) = &self.arm {
            arm.write(text)?;
        }
        mechanism::write(&self.speed_changes, text)?;
        self.circuits(text)
    }
}

fn point(point: Point, decimals: usize) -> String {
    point.map(|value| fixed(value, decimals)).join(", ")
}

impl Summary {
    fn arcs(&self, text: &mut String, all: bool) -> fmt::Result {
        let error = |row: &ArcRow| {
            let [least, largest] = row.radius_error_um;
            largest.max(-least)
        };
        let (rows, left) = worst(&self.arcs, all, error);
        if rows.is_empty() {
            return Ok(());
        }
        let heads = [
            ("arc: piece", 0),
            ("line", 0),
            ("radius mm", 9),
            ("angle deg", 9),
            ("samples", 7),
            ("step deg", 8),
            ("mm/s", 8),
            ("wanted", 8),
            ("measured", 8),
            ("deviation", 0),
        ];
        let cells = rows.iter().map(|row| {
            [
                row.piece.to_string(),
                or_dash(row.line),
                fixed(row.radius_mm, 3),
                fixed(row.angle_deg, 3),
                row.samples.to_string(),
                fixed(row.step_deg, 4),
                fixed(row.speed_mm_per_s.expected, 3),
                fixed(row.speed_wanted_mm_per_s, 3),
                fixed(row.speed_mm_per_s.measured, 3),
                fixed(row.speed_deviation_mm_per_s, 3),
            ]
        });
        table(text, heads, cells)?;
        more(text, left, "of smaller radius error")?;
        if all || self.arcs.len() == 1 {
            let heads = [("arc: piece", 0), ("centre in mm", 30), ("axis", 26)];
            let cells = rows.iter().map(|row| {
                let (centre, axis) = (point(row.centre_mm, 3), point(row.axis, 4));
                [row.piece.to_string(), centre, axis]
            });
            table(text, heads, cells)?;
            text.push('\n');
        }
        radius_errors(text, &rows)?;
        ends(text, &rows)
    }

    fn lines(&self, text: &mut String, all: bool) -> fmt::Result {
        let slower = |row: &LineRow| 1.0 - row.speed_mm_per_s / row.speed_wanted_mm_per_s;
        let (rows, left) = worst(&self.lines, all, slower);
        if rows.is_empty() {
            return Ok(());
        }
        Table::of(rows)
            .col("line: piece", 0, |row| row.piece)
            .col("line", 0, |row| or_dash(row.line))
            .col("length mm", 9, |row| fixed(row.length_mm, 3))
            .col("samples", 7, |row| row.samples)
            .col("mm/s", 8, |row| fixed(row.speed_mm_per_s, 3))
            .col("wanted", 8, |row| fixed(row.speed_wanted_mm_per_s, 3))
            .write(text)?;
        more(text, left, "nearer to the wanted speed")
    }

    fn blends(&self, text: &mut String, all: bool) -> fmt::Result {
        let peak = |row: &BlendRow| row.peak_acceleration_mm_per_s2.measured;
        let (rows, left) = worst(&self.blends, all, peak);
        if rows.is_empty() {
            return Ok(());
        }
        let heads = [
            ("blend: piece", 0),
            ("line", 0),
            ("", 9),
            ("turn deg", 8),
            ("peak mm/s2", 0),
            ("3S/(2ta)2", 9),
            ("to the corner um", 0),
            ("3S/16", 8),
            ("off the path um", 0),
        ];
        let cells = rows.into_iter().map(|row| {
            let (peak, corner) = (row.peak_acceleration_mm_per_s2, row.corner_distance_um);
            [
                row.piece.to_string(),
                or_dash(row.line),
                row.kind.to_owned(),
                or_dash(row.turn_deg.map(|turn| fixed(turn, 3))),
                fixed(peak.measured, 3),
                fixed(peak.expected, 3),
                or_dash(corner.map(|pair| fixed(pair.measured, 3))),
                or_dash(corner.map(|pair| fixed(pair.expected, 3))),
                fixed(row.off_path_um, 3),
            ]
        });
        table(text, heads, cells)?;
        more(text, left, "of smaller acceleration")
    }

    fn operations(&self, text: &mut String) -> fmt::Result {
        if self.operations.is_empty() {
            return Ok(());
        }
        Table::of(&self.operations)
            .left("a sample costs", 26, |row| row.method)
            .col("multiplications", 0, |row| row.multiplications)
            .col("additions", 0, |row| row.additions)
            .col("sines, cosines", 0, |row| row.sines_and_cosines)
            .col("ticks", 0, |row| or_dash(row.ticks))
            .write_apart(text)
    }
}

impl Summary {
    fn circuits(&self, text: &mut String) -> fmt::Result {
        if self.circuits.is_empty() {
            return Ok(());
        }
        let heads = [
            ("from a sampling time to the next point, ticks", 0),
            ("blend", 0),
            ("arc", 4),
            ("segment", 0),
            ("most", 4),
            ("in time", 0),
        ];
        let cells = self.circuits.iter().map(|row| {
            let in_time = if row.in_time { "yes" } else { "no" };
            [
                format!("{:<45}", row.circuit),
                or_dash(row.ticks_straight),
                or_dash(row.ticks_arc),
                or_dash(row.ticks_change),
                row.ticks_most.to_string(),
                in_time.to_owned(),
            ]
        });
        table(text, heads, cells)?;
        text.push('\n');
        let heads = [
            ("a circuit has                                ", 0),
            ("adders", 0),
            ("their bits", 0),
            ("flip-flops", 0),
            ("error um", 0),
            ("bound um", 0),
        ];
        let cells = self.circuits.iter().map(|row| {
            [
                format!("{:<45}", row.circuit),
                row.adders.to_string(),
                row.adder_bits.to_string(),
                row.flip_flops.to_string(),
                fixed(row.error_max_um, 3),
                fixed(row.error_bound_um, 3),
            ]
        });
        table(text, heads, cells)?;
        text.push('\n');
        Ok(())
    }
}

fn radius_errors(text: &mut String, rows: &[&ArcRow]) -> fmt::Result {
    let compared = rows
        .iter()
        .any(|row| row.conventional_radius_error_um.is_some());
    let mut heads = vec![
        ("radius error um: piece", 0),
        ("least", 7),
        ("largest", 7),
        ("rms", 7),
        ("at C-", 7),
        ("bound", 7),
    ];
    heads.extend(compared.then_some(("conventional", 0)));
    let cells = rows.iter().map(|row| {
        let [least, largest] = row.radius_error_um;
        let (rms, end) = (row.radius_error_rms_um, row.end_error_um);
        let own = [least, largest, rms, end, row.bound_um];
        let all = own.into_iter().chain(row.conventional_radius_error_um);
        let piece = std::iter::once(row.piece.to_string());
        piece.chain(all.map(|um| fixed(um, 3))).collect::<Vec<_>>()
    });
    table(text, heads, cells)?;
    text.push('\n');
    Ok(())
}

fn ends(text: &mut String, rows: &[&ArcRow]) -> fmt::Result {
    let heads = [
        ("jumps: piece", 0),
        ("at", 0),
        ("direction deg", 0),
        ("asin(v ta/2R)", 0),
        ("mm/s2", 8),
        ("v2/R", 8),
        ("blend off the arc um", 0),
        ("exact", 7),
        ("(v ta)2/8R", 0),
    ];
    let ends = rows
        .iter()
        .flat_map(|row| row.ends.iter().map(|end| (row.piece, end)));
    let cells = ends.map(|(piece, end)| {
        let (direction, acceleration) = (end.direction_jump_deg, end.acceleration_jump_mm_per_s2);
        let off = end.off_arc_um;
        [
            piece.to_string(),
            end.at.to_owned(),
            fixed(direction.measured, 4),
            fixed(direction.expected, 4),
            fixed(acceleration.measured, 3),
            fixed(acceleration.expected, 3),
            off.map_or("joint".to_owned(), |pair| fixed(pair.measured, 3)),
            or_dash(off.map(|pair| fixed(pair.expected, 3))),
            or_dash(end.off_arc_estimate_um.map(|um| fixed(um, 3))),
        ]
    });
    table(text, heads, cells)?;
    text.push('\n');
    Ok(())
}
