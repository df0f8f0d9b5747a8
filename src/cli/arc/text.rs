//! The summary for people.

use super::rows::{ArcRow, BlendRow, LineRow};
use super::summary::Summary;
use crate::cli::traces::Report;
use std::fmt::{self, Write};

/// Arcs, lines and blends in the tables, unless all are asked for.
const SHOWN: usize = 6;

impl Report for Summary {
    fn written(&mut self, vcd_window: Option<[u64; 2]>, files: Vec<String>) {
        (self.vcd_window, self.files) = (vcd_window, files);
    }

    fn complaints(&self) -> &[String] {
        &self.complaints
    }

    fn write(&self, text: &mut String, all: bool) -> fmt::Result {
        let [x, y, z] = self.end_position;
        writeln!(
            text,
            "{} on {} ({}): {} samples, {} ticks, {:.3} s at {} Hz",
            self.input,
            self.circuit,
            self.rounding,
            self.samples,
            self.ticks,
            self.seconds,
            self.clock_hz
        )?;
        writeln!(
            text,
            "a sample in {} ticks, of which the circuit needs {}; blends of {} samples; a count is \
             {:.3} um",
            self.sample_ticks,
            self.sample_ticks_needed,
            self.blend_samples,
            1e3 / self.counts_per_mm
        )?;
        writeln!(
            text,
            "ends at {x}, {y}, {z} counts{}; commands are at most {:.3} um off their exact points, \
             the bound is {:.3} um\n",
            match self.exact {
                true => ", where the path does",
                false => "",
            },
            self.error_max_um,
            self.error_bound_um
        )?;
        self.arcs(text, all)?;
        self.lines(text, all)?;
        self.blends(text, all)?;
        self.operations(text)?;
        for warning in &self.warnings {
            writeln!(text, "warning: {warning}")?;
        }
        if let Some([from, to]) = self.vcd_window
            && (from > 0 || to < self.ticks)
        {
            writeln!(
                text,
                "the VCD shows ticks {from} to {to} of {}: --from and --to choose others",
                self.ticks
            )?;
        }
        for file in &self.files {
            writeln!(text, "wrote {file}")?;
        }
        Ok(())
    }
}

/// The worst few of some rows, or all in their order, and how many are left out.
fn worst<T>(rows: &[T], all: bool, badness: impl Fn(&T) -> f64) -> (Vec<&T>, usize) {
    let mut shown: Vec<&T> = rows.iter().collect();
    if !all {
        shown.sort_by(|a, b| badness(b).total_cmp(&badness(a)));
        shown.truncate(SHOWN);
    }
    let left = rows.len() - shown.len();
    (shown, left)
}

fn more(text: &mut String, left: usize, why: &str) -> fmt::Result {
    match left {
        0 => writeln!(text),
        _ => writeln!(text, "and {left} more, {why}: --segments shows all\n"),
    }
}

/// A line of the input, where there is one.
fn line(line: Option<usize>) -> String {
    line.map_or("-".to_owned(), |line| line.to_string())
}

impl Summary {
    fn arcs(&self, text: &mut String, all: bool) -> fmt::Result {
        let error = |row: &ArcRow| {
            row.radius_error_um
                .map(f64::abs)
                .into_iter()
                .fold(0.0, f64::max)
        };
        let (rows, left) = worst(&self.arcs, all, error);
        if rows.is_empty() {
            return Ok(());
        }
        writeln!(
            text,
            "arc                                                            radius error in um \
             {:>33}",
            "conven-"
        )?;
        writeln!(
            text,
            "piece  line  radius mm    angle  samples  step        mm/s  of wanted   \
             least  largest    rms   at C-  bound  tional"
        )?;
        for row in &rows {
            let [least, largest] = row.radius_error_um;
            writeln!(
                text,
                "{:>5}  {:>4}  {:>9.3}  {:>7.3}  {:>7}  {:>6.4}  {:>8.3}  {:>9.3}  {:>6.3}  {:>7.3}  \
                 {:>5.3}  {:>6.3}  {:>5.3}  {:>6.3}",
                row.piece,
                line(row.line),
                row.radius_mm,
                row.angle_deg,
                row.samples,
                row.step_deg,
                row.speed_mm_per_s.expected,
                row.speed_wanted_mm_per_s,
                least,
                largest,
                row.radius_error_rms_um,
                row.end_error_um,
                row.bound_um,
                row.conventional_radius_error_um,
            )?;
        }
        more(text, left, "of smaller radius error")?;
        if all || rows.len() == 1 {
            writeln!(
                text,
                "piece  centre in mm                      axis                       \
                 speed mm/s  deviation"
            )?;
            for row in &rows {
                let [gx, gy, gz] = row.centre_mm;
                let [kx, ky, kz] = row.axis;
                writeln!(
                    text,
                    "{:>5}  {:>31}  {:>25}  {:>10.3}  {:>9.3}",
                    row.piece,
                    format!("{gx:.3}, {gy:.3}, {gz:.3}"),
                    format!("{kx:.4}, {ky:.4}, {kz:.4}"),
                    row.speed_mm_per_s.measured,
                    row.speed_deviation_mm_per_s,
                )?;
            }
            text.push('\n');
        }
        writeln!(
            text,
            "          direction jump, deg       acceleration jump, mm/s2   blend off the arc, um"
        )?;
        writeln!(
            text,
            "piece  at  measured  asin(v ta/2R)  measured       v2/R         \
             measured   exact  (v ta)2/8R"
        )?;
        for row in rows {
            for end in &row.ends {
                let (direction, acceleration) =
                    (end.direction_jump_deg, end.acceleration_jump_mm_per_s2);
                let off = match (end.off_arc_um, end.off_arc_estimate_um) {
                    (Some(off), Some(estimate)) => format!(
                        "{:>8.3}  {:>6.3}  {:>10.3}",
                        off.measured, off.expected, estimate
                    ),
                    _ => format!("{:>8}", "joint"),
                };
                writeln!(
                    text,
                    "{:>5}  {}  {:>8.4}  {:>13.4}  {:>8.3}  {:>9.3}         {off}",
                    row.piece,
                    end.at,
                    direction.measured,
                    direction.expected,
                    acceleration.measured,
                    acceleration.expected,
                )?;
            }
        }
        more(text, 0, "")
    }

    fn lines(&self, text: &mut String, all: bool) -> fmt::Result {
        let slower = |row: &LineRow| 1.0 - row.speed_mm_per_s / row.speed_wanted_mm_per_s;
        let (rows, left) = worst(&self.lines, all, slower);
        if rows.is_empty() {
            return Ok(());
        }
        writeln!(
            text,
            "line  in line  length mm  samples      mm/s  of wanted"
        )?;
        for row in rows {
            writeln!(
                text,
                "{:>4}  {:>7}  {:>9.3}  {:>7}  {:>8.3}  {:>9.3}",
                row.piece,
                line(row.line),
                row.length_mm,
                row.samples,
                row.speed_mm_per_s,
                row.speed_wanted_mm_per_s
            )?;
        }
        more(text, left, "nearer to the wanted speed")
    }

    fn blends(&self, text: &mut String, all: bool) -> fmt::Result {
        let peak = |row: &BlendRow| row.peak_acceleration_mm_per_s2.measured;
        let (rows, left) = worst(&self.blends, all, peak);
        if rows.is_empty() {
            return Ok(());
        }
        writeln!(
            text,
            "blend                     peak acceleration, mm/s2   to the corner, um"
        )?;
        writeln!(
            text,
            "piece  line  kind         measured  3S/(2ta)2          measured     3S/16   \
             off the path, um  turn, deg"
        )?;
        for row in rows {
            let corner = match row.corner_distance_um {
                Some(pair) => format!("{:>8.3}  {:>8.3}", pair.measured, pair.expected),
                None => format!("{:>8}  {:>8}", "-", "-"),
            };
            let turn = row
                .turn_deg
                .map_or("-".to_owned(), |turn| format!("{turn:.3}"));
            writeln!(
                text,
                "{:>5}  {:>4}  {:<9}  {:>10.3}  {:>9.3}          {corner}   {:>16.3}  {turn:>9}",
                row.piece,
                line(row.line),
                row.kind,
                row.peak_acceleration_mm_per_s2.measured,
                row.peak_acceleration_mm_per_s2.expected,
                row.off_path_um,
            )?;
        }
        more(text, left, "of smaller acceleration")
    }

    fn operations(&self, text: &mut String) -> fmt::Result {
        if self.operations.is_empty() {
            return Ok(());
        }
        writeln!(
            text,
            "a sample costs              multiplications  additions  sines, cosines  ticks"
        )?;
        for row in &self.operations {
            writeln!(
                text,
                "{:<26}  {:>15}  {:>9}  {:>14}  {:>5}",
                row.method,
                row.multiplications,
                row.additions,
                row.sines_and_cosines,
                row.ticks.map_or("-".to_owned(), |ticks| ticks.to_string())
            )?;
        }
        text.push('\n');
        Ok(())
    }
}
