//! The summary for people.

use super::mechanism;
use super::summary::Summary;
use crate::cli::columns::Table;
use crate::cli::report::{Outcome, Report};
use crate::cli::rows::{fixed, fixed_or_dash, more, or_dash, worst};
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::measure::{ArcMeasured, BlendMeasured, LinePlanned};
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
            self.measured.error_max_um,
            self.measured.error_bound_um,
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
        let error = |row: &ArcMeasured| {
            let [least, largest] = row.radius_error_um;
            largest.max(-least)
        };
        let (rows, left) = worst(&self.measured.arcs, all, error);
        if rows.is_empty() {
            return Ok(());
        }
        Table::of(&rows)
            .col("arc: piece", 0, |row| row.piece)
            .col("line", 0, |row| or_dash(row.line))
            .col("radius mm", 9, |row| fixed(row.radius_mm, 3))
            .col("angle deg", 9, |row| fixed(row.angle_deg, 3))
            .col("samples", 7, |row| row.samples)
            .col("step deg", 8, |row| fixed(row.step_deg, 4))
            .col("mm/s", 8, |row| fixed(row.speed_mm_per_s.expected, 3))
            .col("wanted", 8, |row| fixed(row.speed_wanted_mm_per_s, 3))
            .col("measured", 8, |row| fixed(row.speed_mm_per_s.measured, 3))
            .col("deviation", 0, |row| fixed(row.speed_deviation_mm_per_s, 3))
            .write(text)?;
        more(text, left, "of smaller radius error")?;
        if all || self.measured.arcs.len() == 1 {
            Table::of(&rows)
                .col("arc: piece", 0, |row| row.piece)
                .col("centre in mm", 30, |row| point(row.centre_mm, 3))
                .col("axis", 26, |row| point(row.axis, 4))
                .write_apart(text)?;
        }
        radius_errors(text, &rows)?;
        ends(text, &rows)
    }

    fn lines(&self, text: &mut String, all: bool) -> fmt::Result {
        let slower = |row: &LinePlanned| 1.0 - row.speed_mm_per_s / row.speed_wanted_mm_per_s;
        let (rows, left) = worst(&self.measured.lines, all, slower);
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
        let peak = |row: &BlendMeasured| row.peak_acceleration_mm_per_s2.measured;
        let (rows, left) = worst(&self.measured.blends, all, peak);
        if rows.is_empty() {
            return Ok(());
        }
        Table::of(rows)
            .col("blend: piece", 0, |row| row.piece)
            .col("line", 0, |row| or_dash(row.line))
            .col("", 9, |row| row.kind)
            .col("turn deg", 8, |row| fixed_or_dash(row.turn_deg, 3))
            .col("peak mm/s2", 0, |row| {
                fixed(row.peak_acceleration_mm_per_s2.measured, 3)
            })
            .col("3S/(2ta)2", 9, |row| {
                fixed(row.peak_acceleration_mm_per_s2.expected, 3)
            })
            .col("to the corner um", 0, |row| {
                fixed_or_dash(row.corner_distance_um.map(|pair| pair.measured), 3)
            })
            .col("3S/16", 8, |row| {
                fixed_or_dash(row.corner_distance_um.map(|pair| pair.expected), 3)
            })
            .col("off the path um", 0, |row| fixed(row.off_path_um, 3))
            .write(text)?;
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

    fn circuits(&self, text: &mut String) -> fmt::Result {
        if self.circuits.is_empty() {
            return Ok(());
        }
        let ticks = "from a sampling time to the next point, ticks";
        Table::of(&self.circuits)
            .left(ticks, 0, |row| row.circuit)
            .col("blend", 0, |row| or_dash(row.ticks_straight))
            .col("arc", 4, |row| or_dash(row.ticks_arc))
            .col("segment", 0, |row| or_dash(row.ticks_change))
            .col("most", 4, |row| row.ticks_most)
            .col("in time", 0, |row| if row.in_time { "yes" } else { "no" })
            .write_apart(text)?;
        Table::of(&self.circuits)
            .left("a circuit has", ticks.len(), |row| row.circuit)
            .col("adders", 0, |row| row.adders)
            .col("their bits", 0, |row| row.adder_bits)
            .col("flip-flops", 0, |row| row.flip_flops)
            .col("error um", 0, |row| fixed(row.error_max_um, 3))
            .col("bound um", 0, |row| fixed(row.error_bound_um, 3))
            .write_apart(text)
    }
}

fn radius_errors(text: &mut String, rows: &[&ArcMeasured]) -> fmt::Result {
    let mut table = Table::of(rows)
        .col("radius error um: piece", 0, |row| row.piece)
        .col("least", 7, |row| fixed(row.radius_error_um[0], 3))
        .col("largest", 7, |row| fixed(row.radius_error_um[1], 3))
        .col("rms", 7, |row| fixed(row.radius_error_rms_um, 3))
        .col("at C-", 7, |row| fixed(row.end_error_um, 3))
        .col("bound", 7, |row| fixed(row.bound_um, 3));
    let conventional = |row: &ArcMeasured| row.conventional_radius_error_um;
    if rows.iter().any(|row| conventional(row).is_some()) {
        table = table.col("conventional", 0, |row| fixed_or_dash(conventional(row), 3));
    }
    table.write_apart(text)
}

fn ends(text: &mut String, rows: &[&ArcMeasured]) -> fmt::Result {
    let ends = rows
        .iter()
        .flat_map(|row| row.ends.iter().map(|end| (row.piece, end)));
    Table::of(ends)
        .col("jumps: piece", 0, |(piece, _)| *piece)
        .col("at", 0, |(_, end)| end.at)
        .col("direction deg", 0, |(_, end)| {
            fixed(end.direction_jump_deg.measured, 4)
        })
        .col("asin(v ta/2R)", 0, |(_, end)| {
            fixed(end.direction_jump_deg.expected, 4)
        })
        .col("mm/s2", 8, |(_, end)| {
            fixed(end.acceleration_jump_mm_per_s2.measured, 3)
        })
        .col("v2/R", 8, |(_, end)| {
            fixed(end.acceleration_jump_mm_per_s2.expected, 3)
        })
        .col("blend off the arc um", 0, |(_, end)| {
            let off = end.off_arc_um.map(|pair| fixed(pair.measured, 3));
            off.unwrap_or("joint".to_owned())
        })
        .col("exact", 7, |(_, end)| {
            fixed_or_dash(end.off_arc_um.map(|pair| pair.expected), 3)
        })
        .col("(v ta)2/8R", 0, |(_, end)| {
            fixed_or_dash(end.off_arc_estimate_um, 3)
        })
        .write_apart(text)
}
