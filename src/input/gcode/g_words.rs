//! G words of a line.

use super::block::{Block, Code, name};
use super::codes;
use super::cycle::Cycle;
use super::machine::{Machine, Words};
use super::modal::{Motion, Plane};
use super::offsets::Own;
use super::polar::Polar;
use super::problem::Problem;
use super::tools::Length;

const MM_PER_INCH: f64 = 25.4;

const G_CODES: &str = "G0 to G5 G5.1 to G5.3 G6.2 G8 G10 G11 G15 to G21 G28 G30 G38.2 to G38.5 \
                                  G40 G43 G49 G52 to G59.3 G61 G64 G68 G69 G73 G80 to G86 G89 to G94 \
                                  G97 to G99";

impl Machine<'_> {
    /// Reads the G words of a line, and sets the modal ones.
    pub(super) fn g_words(&mut self, line: usize, block: &mut Block) -> Result<Words, Problem> {
        let mut words = Words::default();
        let (mut plane, mut units, mut distance) = (None, None, None);
        let (mut centres, mut feeds, mut system, mut ends) = (None, None, None, None);
        let (mut polar, mut turn) = (None, None);
        for index in 0..block.g.len() {
            let Some(&code) = block.g.get(index) else {
                break;
            };
            match code {
                (0, 0) => choose(&mut words.motion, code, Motion::Rapid)?,
                (1, 0) => choose(&mut words.motion, code, Motion::Line)?,
                (2, 0) => choose(&mut words.motion, code, Motion::Arc { clockwise: true })?,
                (3, 0) => choose(&mut words.motion, code, Motion::Arc { clockwise: false })?,
                (5, 0) => choose(&mut words.motion, code, Motion::Cubic)?,
                (5, 1) => choose(&mut words.motion, code, Motion::Quadratic)?,
                (5, 2) => choose(&mut words.motion, code, Motion::Nurbs)?,
                (5, 3) => choose(&mut words.motion, code, Motion::NurbsEnd)?,
                (6, 2) => choose(&mut words.motion, code, Motion::KnottedNurbs)?,
                (38, 2..=5) => choose(&mut words.motion, code, Motion::Probe)?,
                (73 | 81..=86 | 89, 0) => choose(&mut words.motion, code, Motion::Cycle(code.0))?,
                (80, 0) => words.cancels = true,
                (17, 0) => choose(&mut plane, code, Plane::Xy)?,
                (18, 0) => choose(&mut plane, code, Plane::Zx)?,
                (19, 0) => choose(&mut plane, code, Plane::Yz)?,
                (20, 0) => choose(&mut units, code, MM_PER_INCH)?,
                (21, 0) => choose(&mut units, code, 1.0)?,
                (90, 0) => choose(&mut distance, code, false)?,
                (91, 0) => choose(&mut distance, code, true)?,
                (90, 1) => choose(&mut centres, code, true)?,
                (91, 1) => choose(&mut centres, code, false)?,
                (93, 0) => choose(&mut feeds, code, true)?,
                (94, 0) => choose(&mut feeds, code, false)?,
                (98, 0) => choose(&mut ends, code, false)?,
                (99, 0) => choose(&mut ends, code, true)?,
                (54..=58, 0) => choose(&mut system, code, code.0 as usize - 54)?,
                (59, 0..=3) => choose(&mut system, code, 5 + code.1 as usize)?,
                (53, 0) => words.machine = true,
                (15, 0) => choose(&mut polar, code, false)?,
                (16, 0) => choose(&mut polar, code, true)?,
                (68, 0) => {
                    choose(&mut turn, code, true)?;
                    choose(&mut words.own, code, Own::Turn)?;
                }
                (69, 0) => choose(&mut turn, code, false)?,
                // Always in force: no compensation, diameter or scaling.
                (8 | 40 | 50 | 97, 0) | (50, 1) | (69, 1) => {
                    if code.0 == 50 && block.axes().iter().any(Option::is_some) {
                        let problem = "sets coordinates, as controls of lathes do";
                        return Err(Problem::new("G50", problem, "G50 alone; G92"));
                    }
                    if code == (97, 0) {
                        self.say_nothing("G97", line)?;
                    }
                }
                (4, 0) => {
                    words.dwell = true;
                    self.note("G4", line, || "G4: no dwell is made".to_owned());
                }
                (61 | 64, 0) => self.skip(&name('G', code), line),
                (61, 1) => self.say_nothing("G61.1", line)?,
                (96, 0) => self.say_nothing("G96", line)?,
                (49, 0) => choose(&mut words.length, code, Length::Cancel)?,
                (43, 0) => choose(&mut words.length, code, Length::Of { sign: 1.0 })?,
                (44, 0) => choose(&mut words.length, code, Length::Of { sign: -1.0 })?,
                (43, 2) => choose(&mut words.length, code, Length::Add)?,
                (43, 1) => choose(&mut words.own, code, Own::Length)?,
                (10, 0) if block.letter(b'L').is_some() => choose(&mut words.own, code, Own::Set)?,
                // Printers retract filament, and level their bed.
                (10 | 11 | 29 | 34, 0) if block.given().next().is_none() => {
                    self.say_nothing(&name('G', code), line)?;
                }
                (28, 0) => choose(&mut words.own, code, Own::Go(0))?,
                (30, 0) => choose(&mut words.own, code, Own::Go(1))?,
                (28, 1) => choose(&mut words.own, code, Own::Keep(0))?,
                (30, 1) => choose(&mut words.own, code, Own::Keep(1))?,
                (92, 0) => choose(&mut words.own, code, Own::Shift)?,
                (52, 0) => choose(&mut words.own, code, Own::Local)?,
                (92, 1) => choose(&mut words.own, code, Own::Forget)?,
                (92, 2) => choose(&mut words.own, code, Own::Suspend)?,
                (92, 3) => choose(&mut words.own, code, Own::Resume)?,
                _ => {
                    let reason = codes::g_reason(code);
                    return Err(Problem::new(name('G', code), reason, G_CODES));
                }
            }
        }
        // P, Q and R of G64 are tolerances.
        if block.g.contains(&(64, 0)) {
            for letter in [b'P', b'Q', b'R'] {
                if block.take(letter).is_some() && self.strict {
                    self.say_nothing("P, Q, R", line)?;
                }
            }
        }
        if let Some((_, false)) = turn {
            self.end_rotation();
        }
        if let Some((_, polar)) = polar {
            self.polar = polar.then(Polar::default);
        }
        let modal = &mut self.modal;
        let before = modal.plane;
        set(&mut modal.plane, plane);
        set(&mut modal.mm_per_unit, units);
        set(&mut modal.relative, distance);
        set(&mut modal.centres_absolute, centres);
        set(&mut modal.system, system);
        modal.end_chosen |= ends.is_some();
        set(&mut modal.ends_at_r, ends);
        if let Some((_, inverse)) = feeds {
            modal.inverse_time = inverse;
            self.feed_word = None;
        }
        let drilled = matches!(modal.motion, Some(Motion::Cycle(_))) && modal.plane == before;
        match words.motion {
            Some((_, motion)) => {
                modal.motion = Some(motion);
            }
            None if words.cancels => modal.motion = None,
            None => {}
        }
        if let (Some(Motion::Cycle(_)), false) = (modal.motion, drilled) {
            let [_, _, along] = modal.plane.axes();
            self.cycle = Cycle::from(self.at.get(along).copied().unwrap_or(0.0));
        }
        self.fits_rotation(&words, system.is_some())?;
        Ok(words)
    }
}

fn set<T>(place: &mut T, chosen: Option<(Code, T)>) {
    if let Some((_, value)) = chosen {
        *place = value;
    }
}

/// Sets a choice that a line may make once; repeating the same word is allowed.
fn choose<T>(place: &mut Option<(Code, T)>, code: Code, value: T) -> Result<(), Problem> {
    if let Some((other, _)) = place
        && *other != code
    {
        let problem = format!("together with {} in one line", name('G', *other));
        let allowed = "one of them in a line";
        return Err(Problem::new(name('G', code), problem, allowed));
    }
    *place = Some((code, value));
    Ok(())
}
