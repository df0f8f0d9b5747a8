//! Output of both readers: moves so far, warnings, and the finished drawing.

use std::collections::HashMap;

use super::{Course, Drawing, Fault, Move, Moves, Point, REACH_MM, Warning, ZERO_MM};
use crate::settings::tidy;

/// Moves read so far, and the end of the last one.
pub(super) struct Track<'a> {
    file: &'a str,
    /// File that is being read for it.
    within: Option<String>,
    here: Point,
    moves: Moves,
    /// W at the end of each move, if there is one.
    fourth: Vec<f64>,
    zero_length: usize,
    notes: HashMap<String, Note>,
}

/// Warning under construction.
struct Note {
    /// Index among the notes.
    order: usize,
    /// File, if it is not the drawing's own.
    file: Option<String>,
    line: usize,
    text: String,
    times: usize,
}

impl<'a> Track<'a> {
    pub(super) fn new(file: &'a str) -> Self {
        Self {
            file,
            within: None,
            here: [0.0; 3],
            moves: Moves::default(),
            fourth: Vec::new(),
            zero_length: 0,
            notes: HashMap::new(),
        }
    }

    /// Sets the file of the following text; `None` is the drawing's own.
    pub(super) fn within(&mut self, file: Option<&str>) {
        if self.within.as_deref() != file {
            self.within = file.map(str::to_owned);
        }
    }

    /// Returns the end of the last recorded move.
    pub(super) fn here(&self) -> Point {
        self.here
    }

    /// Records a move with W at its end, as [`Track::push`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Track::push`], for W too.
    pub(super) fn push_with(&mut self, field: &str, next: Move, w: f64) -> Result<(), Fault> {
        self.check_reach(field, next.line, "W", w)?;
        let turns = (w - self.fourth.last().copied().unwrap_or(0.0)).abs() >= ZERO_MM;
        self.record(field, next, turns)?;
        self.fourth.resize(self.moves.len(), w);
        Ok(())
    }

    /// Records a move, or counts it if it has zero length. Tiny moves are not lost: the next one
    /// starts from the last recorded end.
    ///
    /// # Errors
    ///
    /// Returns an error if the end or the centre is out of reach; `field` is the instruction to
    /// blame.
    pub(super) fn push(&mut self, field: &str, next: Move) -> Result<(), Fault> {
        self.record(field, next, false)
    }

    /// Records a move; with `beside` another axis moves too.
    fn record(&mut self, field: &str, next: Move, beside: bool) -> Result<(), Fault> {
        for (axis, value) in ["X", "Y", "Z"].into_iter().zip(next.to) {
            self.check_reach(field, next.line, axis, value)?;
        }
        if let Course::Arc { centre, .. } = next.course {
            for (axis, value) in ["the centre's X", "the centre's Y"].into_iter().zip(centre) {
                self.check_reach(field, next.line, axis, value)?;
            }
        }
        if let Course::Spline { controls } = next.course {
            let names = [
                "a control point's X",
                "a control point's Y",
                "a control point's Z",
            ];
            for (axis, value) in controls
                .into_iter()
                .flat_map(|at| names.into_iter().zip(at))
            {
                self.check_reach(field, next.line, axis, value)?;
            }
        }
        let still = match next.course {
            Course::Line => true,
            Course::Arc { .. } => false,
            Course::Spline { controls } => controls.iter().all(|at| self.is_at(*at)),
        };
        if still && !beside && self.is_at(next.to) {
            self.zero_length += 1;
        } else {
            self.here = next.to;
            self.moves.push(next);
        }
        Ok(())
    }

    /// True if a straight move to a point would have zero length.
    pub(super) fn is_at(&self, to: Point) -> bool {
        let mut pairs = self.here.iter().zip(&to);
        pairs.all(|(from, to)| (to - from).abs() < ZERO_MM)
    }

    fn check_reach(&self, field: &str, line: usize, what: &str, mm: f64) -> Result<(), Fault> {
        if mm.abs() <= REACH_MM {
            return Ok(());
        }
        Err(self.fault(
            line,
            field,
            format!("{what} would be {} mm", tidy(mm)),
            format!("-{REACH_MM} to {REACH_MM} mm"),
        ))
    }

    /// Adds a warning. Each `key` gives one warning, at its first line, with the number of
    /// occurrences.
    pub(super) fn note(&mut self, key: &str, line: usize, text: impl FnOnce() -> String) {
        if let Some(note) = self.notes.get_mut(key) {
            note.times += 1;
            return;
        }
        let note = Note {
            order: self.notes.len(),
            file: self.within.clone(),
            line,
            text: text(),
            times: 1,
        };
        self.notes.insert(key.to_owned(), note);
    }

    pub(super) fn fault(
        &self,
        line: usize,
        field: impl Into<String>,
        problem: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Fault {
        let file = self.within.as_deref().unwrap_or(self.file);
        Fault::new(file, line, field, problem, allowed)
    }

    /// Returns the drawing.
    ///
    /// # Errors
    ///
    /// Returns an error if there is no move; `allowed` describes the expected file.
    pub(super) fn finish(mut self, allowed: &str) -> Result<Drawing, Fault> {
        self.within = None;
        if self.moves.is_empty() {
            return Err(self.fault(0, "file", "no move in it", allowed));
        }
        let mut notes: Vec<Note> = self.notes.into_values().collect();
        notes.sort_unstable_by_key(|note| note.order);
        let warnings = notes
            .into_iter()
            .map(|note| Warning {
                file: note.file.unwrap_or_else(|| self.file.to_owned()),
                line: note.line,
                text: match note.times {
                    1 => note.text,
                    times => format!("{} ({times} times)", note.text),
                },
            })
            .collect();
        Ok(Drawing {
            file: self.file.to_owned(),
            start: [0.0; 3],
            moves: self.moves,
            fourth: self.fourth,
            zero_length: self.zero_length,
            warnings,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn to(x: f64) -> Move {
        Move {
            to: [x, 0.0, 0.0],
            course: Course::Line,
            rapid: false,
            feed_mm_per_min: None,
            line: 1,
        }
    }

    #[test]
    fn tiny_moves_are_counted_and_add_up() {
        let mut track = Track::new("t");
        let step = 0.4 * ZERO_MM;
        for n in 1..=6 {
            track.push("X", to(f64::from(n) * step)).unwrap();
        }
        let drawing = track.finish("moves").unwrap();
        assert_eq!(drawing.zero_length, 4);
        assert!(drawing.moves.iter().eq([to(3.0 * step), to(6.0 * step)]));
    }

    #[test]
    fn notes_keep_their_order_and_count() {
        let mut track = Track::new("t");
        track.note("b", 2, || "b skipped".to_owned());
        track.note("a", 3, || "a skipped".to_owned());
        track.note("b", 4, || "never built".to_owned());
        track.push("X", to(1.0)).unwrap();
        let warnings = track.finish("moves").unwrap().warnings;
        let shown: Vec<String> = warnings.iter().map(Warning::to_string).collect();
        assert_eq!(shown, ["t:2: b skipped (2 times)", "t:3: a skipped"]);
    }

    #[test]
    fn the_reach_ends_where_it_says() {
        let mut track = Track::new("t");
        track.push("X", to(REACH_MM)).unwrap();
        let fault = track.push("X", to(REACH_MM + 0.5)).unwrap_err();
        assert_eq!(
            fault.to_string(),
            "t:1: X: X would be 1000000.5 mm; allowed: -1000000 to 1000000 mm"
        );
        assert!(track.push("X", to(f64::NAN)).is_err());
    }
}
