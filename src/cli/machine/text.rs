//! The summary for people.

use super::rows::{LiftRow, PieceRow};
use super::summary::Summary;
use crate::cli::columns::Table;
use crate::cli::report::{Outcome, Report};
use crate::cli::rows::{fixed, fixed_or_dash, more, or_dash, worst};
use motion_rtl::jobs::machine::measure::{End, Farthest};
use std::fmt::{self, Write};

/// Below this two places are the same.
const SAME_UM: f64 = 1e-6;

impl Report for Summary {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, all: bool) -> fmt::Result {
        writeln!(
            text,
            "{}: {}; unit time {}, scan {}, CK {}, Ts {} ticks",
            self.outcome.subject(),
            self.outcome.length(),
            self.settings.unit_ticks,
            self.settings.scan_ticks,
            self.settings.ck_ticks,
            self.settings.sample_ticks
        )?;
        let times = &self.times;
        match times.steppers_cut_off {
            false => write!(text, "steppers run through in {:.3} s", times.steppers_s)?,
            true => write!(text, "steppers cut off by the end of the run")?,
        }
        match times.servos_settled {
            true => writeln!(
                text,
                "; servos stop after each piece: {:.3} s, of which on the way {:.3}, coming to \
                 rest {:.3}, waiting for pen and records {:.3}\n",
                times.servos_s, times.moving_s, times.settling_s, times.waiting_s
            )?,
            false => writeln!(text, "; servos do not come to rest\n")?,
        }
        self.ends(text)?;
        self.pieces(text, all)?;
        self.lifts(text, all)?;
        Ok(())
    }
}

impl Summary {
    fn ends(&self, text: &mut String) -> fmt::Result {
        let ends = &self.ends;
        let job = ("job", ends.end_mm, None);
        let machines = ends.ends.iter().map(|end| (end.what, end.mm, Some(end)));
        let position = |end: Option<&End>, axis: usize| {
            end.map_or(String::new(), |end| end.position[axis].to_string())
        };
        Table::of(std::iter::once(job).chain(machines))
            .col("end", 8, |(what, ..)| *what)
            .col("x mm", 9, |(_, mm, _)| fixed(mm[0], 4))
            .col("y mm", 9, |(_, mm, _)| fixed(mm[1], 4))
            .col("x", 8, |(.., end)| position(*end, 0))
            .col("y", 8, |(.., end)| position(*end, 1))
            .col("", 6, |(.., end)| end.map_or("", |end| end.unit))
            .write(text)?;
        let [x, y] = ends.left_by_correction;
        match (self.exact, ends.apart_um < SAME_UM) {
            (true, _) if [x, y] != [0; 2] => writeln!(
                text,
                "steppers and commands end on the step and the count nearest to the job's end; left by \
                 the correction: {x} and {y} counts\n"
            ),
            (true, true) => writeln!(text, "both machines end at the same point, exactly\n"),
            (true, false) => writeln!(
                text,
                "both machines end on the step and the count nearest to the job's end, {} um \
                 apart\n",
                fixed(ends.apart_um, 3)
            ),
            (false, _) => writeln!(text),
        }
    }

    fn pieces(&self, text: &mut String, all: bool) -> fmt::Result {
        writeln!(
            text,
            "farthest from the path in um, and what most of it comes from"
        )?;
        let badness = |row: &PieceRow| {
            let both = [&row.steppers, &row.load].into_iter().flatten();
            both.map(|farthest| farthest.um).fold(-1.0, f64::max)
        };
        let (rows, left) = worst(&self.pieces, all, badness);
        let reason = |row: Option<Farthest>| or_dash(row.and_then(|row| Some(row.reason?.name())));
        let um = |row: Option<Farthest>| fixed_or_dash(row.map(|row| row.um), 1);
        let share = |row: Option<Farthest>| fixed_or_dash(row.map(|row| row.share_um), 1);
        Table::of(rows)
            .col("piece", 0, |row| row.piece)
            .col("line", 4, |row| row.line)
            .col("kind", 5, |row| row.kind)
            .col("length mm", 0, |row| fixed(row.length_mm, 3))
            .col("steppers", 0, |row| um(row.steppers))
            .col("reason", 11, |row| reason(row.steppers))
            .col("share", 0, |row| share(row.steppers))
            .col("takes s", 0, |row| fixed(row.steppers_s, 3))
            .col("command", 0, |row| fixed_or_dash(row.command_um, 1))
            .col("model", 6, |row| fixed_or_dash(row.model_um, 1))
            .col("motor", 6, |row| fixed_or_dash(row.motor_um, 1))
            .col("load", 6, |row| um(row.load))
            .col("reason", 12, |row| reason(row.load))
            .col("share", 0, |row| share(row.load))
            .col("takes s", 0, |row| fixed_or_dash(row.servos_s, 3))
            .write(text)?;
        more(text, left, "of smaller distance")?;
        self.left_by_correction(text)
    }

    /// The piece at whose end the correction left the motors farthest.
    fn left_by_correction(&self, text: &mut String) -> fmt::Result {
        let left = |row: &PieceRow| row.left_by_correction.unwrap_or_default();
        let most = |row: &&PieceRow| left(row).map(i64::unsigned_abs).into_iter().max();
        let Some(row) = self.pieces.iter().rev().max_by_key(most) else {
            return Ok(());
        };
        match left(row) {
            [0, 0] => Ok(()),
            [x, y] => writeln!(
                text,
                "left by the correction: {x} and {y} counts at the end of piece {}, line {}, the most\n",
                row.piece, row.line
            ),
        }
    }

    fn lifts(&self, text: &mut String, all: bool) -> fmt::Result {
        if self.lifts.is_empty() {
            return Ok(());
        }
        let badness = |row: &LiftRow| row.error_counts.unsigned_abs() as f64;
        let (rows, left) = worst(&self.lifts, all, badness);
        Table::of(rows)
            .col("pen lift: piece", 0, |row| row.piece)
            .col("line", 4, |row| row.line)
            .col("pen", 4, |row| row.pen)
            .col("lead ms", 0, |row| fixed(row.lead_ms, 1))
            .col("past the target, counts", 0, |row| row.error_counts)
            .col("learned ms", 0, |row| fixed_or_dash(row.learned_ms, 1))
            .write(text)?;
        more(text, left, "of smaller error")
    }
}
