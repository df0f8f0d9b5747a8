//! The summary for people.

use super::rows::{FarthestRow, LiftRow, PieceRow};
use super::summary::Summary;
use crate::cli::report::{Outcome, Report};
use crate::cli::rows::{fixed, more, or_dash, table, worst};
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

fn um(farthest: Option<&FarthestRow>) -> [String; 3] {
    [
        or_dash(farthest.map(|row| fixed(row.um, 1))),
        or_dash(farthest.and_then(|row| row.reason)),
        or_dash(farthest.map(|row| fixed(row.share_um, 1))),
    ]
}

impl Summary {
    fn ends(&self, text: &mut String) -> fmt::Result {
        let heads = [
            ("end", 8),
            ("x mm", 9),
            ("y mm", 9),
            ("x", 8),
            ("y", 8),
            ("", 6),
        ];
        let [x, y] = self.end_mm.map(|mm| fixed(mm, 4));
        let job = [
            "job".to_owned(),
            x,
            y,
            String::new(),
            String::new(),
            String::new(),
        ];
        let rows = self.ends.iter().map(|row| {
            let ([x, y], [steps_x, steps_y]) = (row.mm.map(|mm| fixed(mm, 4)), row.position);
            let (steps_x, steps_y) = (steps_x.to_string(), steps_y.to_string());
            [
                row.what.to_owned(),
                x,
                y,
                steps_x,
                steps_y,
                row.unit.to_owned(),
            ]
        });
        table(text, heads, std::iter::once(job).chain(rows))?;
        let [x, y] = self.left_by_correction;
        match (self.exact, self.apart_um < SAME_UM) {
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
                fixed(self.apart_um, 3)
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
        let heads = [
            ("piece", 0),
            ("line", 4),
            ("kind", 5),
            ("length mm", 0),
            ("steppers", 0),
            ("reason", 11),
            ("share", 0),
            ("takes s", 0),
            ("command", 0),
            ("model", 6),
            ("motor", 6),
            ("load", 6),
            ("reason", 12),
            ("share", 0),
            ("takes s", 0),
        ];
        let cells = rows.into_iter().map(|row| {
            let [steppers, steppers_reason, steppers_share] = um(row.steppers.as_ref());
            let [load, load_reason, load_share] = um(row.load.as_ref());
            let of = |um: Option<f64>| or_dash(um.map(|um| fixed(um, 1)));
            [
                row.piece.to_string(),
                row.line.to_string(),
                row.kind.to_owned(),
                fixed(row.length_mm, 3),
                steppers,
                steppers_reason,
                steppers_share,
                fixed(row.steppers_s, 3),
                of(row.command_um),
                of(row.model_um),
                of(row.motor_um),
                load,
                load_reason,
                load_share,
                or_dash(row.servos_s.map(|seconds| fixed(seconds, 3))),
            ]
        });
        table(text, heads, cells)?;
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
        let heads = [
            ("pen lift: piece", 0),
            ("line", 4),
            ("pen", 4),
            ("lead ms", 0),
            ("past the target, counts", 0),
            ("learned ms", 0),
        ];
        let cells = rows.into_iter().map(|row| {
            [
                row.piece.to_string(),
                row.line.to_string(),
                row.pen.to_owned(),
                fixed(row.lead_ms, 1),
                row.error_counts.to_string(),
                or_dash(row.learned_ms.map(|ms| fixed(ms, 1))),
            ]
        });
        table(text, heads, cells)?;
        more(text, left, "of smaller error")
    }
}
