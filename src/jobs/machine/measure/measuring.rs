//! Measurement of a run while it goes on.

use super::ends::{Ends, left_counts};
use super::servos::OnPiece;
use super::steppers::Units;
use super::{Beside, Measured, Path, PieceMeasured, Times};
use crate::input::Drawing;
use crate::jobs::machine::job::{Event, Frame, Played};
use crate::jobs::machine::program::Program;
use crate::jobs::machine::settings::Settings;
use crate::plan::Plan;

/// Point of a run for its picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shown {
    /// Steppers at the end of a unit time.
    Steppers(Beside),
    /// Loads at a sampling time of a move.
    Loads(Beside),
}

/// Measurement of a run event by event, without a record of it.
pub struct Measuring<'a> {
    drawing: &'a Drawing,
    program: &'a Program,
    settings: &'a Settings,
    path: Path<'a>,
    units: Units<'a>,
    pieces: Vec<PieceMeasured>,
    /// Number of moves that have begun.
    moves: usize,
    under_way: Option<OnPiece>,
    latest: Option<Frame>,
    times: Times,
}

impl<'a> Measuring<'a> {
    /// Creates an empty measurement of a program; `plan` belongs to its drawing.
    #[must_use]
    pub fn new(
        drawing: &'a Drawing,
        program: &'a Program,
        settings: &'a Settings,
        plan: &'a Plan<'a>,
    ) -> Self {
        let path = Path {
            start: drawing.start,
            pieces: &program.pieces,
        };
        let piece = |(piece, steppers)| PieceMeasured {
            piece,
            steppers,
            servos: None,
        };
        let none = std::iter::repeat_with(super::Steppers::none);
        Measuring {
            drawing,
            program,
            settings,
            path,
            units: Units::new(drawing, program, settings, plan),
            pieces: (0..program.pieces.len()).zip(none).map(piece).collect(),
            moves: 0,
            under_way: None,
            latest: None,
            times: Times::default(),
        }
    }

    /// Adds the next event; passes its points to `show`.
    pub fn take(&mut self, event: Event, show: &mut dyn FnMut(Shown)) {
        match event {
            Event::Frame(frame) => {
                self.latest = Some(frame);
                self.frame(frame, show);
            }
            Event::Unit { tick, steps } => {
                let mut show = |beside| show(Shown::Steppers(beside));
                self.units
                    .take(&self.path, &mut self.pieces, (tick, steps), &mut show);
            }
            Event::Begun(tick) => {
                let step = self.program.moves.get(self.moves);
                self.under_way =
                    step.map(|step| OnPiece::new(self.drawing, self.settings, step.piece, tick));
                self.moves += 1;
                if let Some(frame) = self.latest.filter(|frame| frame.tick == tick) {
                    self.frame(frame, show);
                }
            }
            Event::Ended(tick) => self.end(Some(tick)),
            Event::Lift(_) => {}
        }
    }

    fn frame(&mut self, frame: Frame, show: &mut dyn FnMut(Shown)) {
        if let Some(on) = &mut self.under_way {
            show(Shown::Loads(on.take(&self.path, frame)));
        }
    }

    /// Ends the current move, or finishes it at the end of the run.
    fn end(&mut self, ended: Option<u64>) {
        let Some((on, step)) = self
            .under_way
            .take()
            .zip(self.program.moves.get(self.moves.saturating_sub(1)))
        else {
            return;
        };
        let begun = on.begun;
        let on = match ended {
            Some(_) => on,
            None => on.at_begin(&self.path),
        };
        let ended = ended.unwrap_or(begun);
        self.times.moving += on.stood - begun;
        self.times.settling += ended.saturating_sub(on.stood);
        let left = on
            .last
            .map_or([0; 2], |frame| left_counts(self.settings, &frame, step.to));
        self.pieces[step.piece].servos = on.finish(&self.path, begun..=ended, left);
    }

    /// Returns the measures of the run.
    #[must_use]
    pub fn finish(mut self, played: &Played) -> Measured {
        self.end(None);
        self.times.steppers = self.units.finish(&self.path, &mut self.pieces);
        self.times.servos = played.moves.last().map_or(0, |timed| timed.ended);
        let last = self.latest.as_ref();
        Measured {
            ends: Ends::of(self.drawing, self.program, self.settings, played, last),
            pieces: self.pieces,
            times: self.times,
        }
    }
}
