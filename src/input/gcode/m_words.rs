//! M words, and the letters that belong to them.

use super::block::{Block, Code, name};
use super::codes::{self, Kind};
use super::machine::Machine;
use super::problem::Problem;

const ALLOWED: &str = "M words that neither move nor change the path";

impl Machine<'_> {
    /// Executes or skips the M words of a line.
    pub(super) fn m_words(&mut self, line: usize, block: &mut Block) -> Result<(), Problem> {
        for index in 0..block.m.len() {
            let Some(&code) = block.m.get(index) else {
                break;
            };
            let word = name('M', code);
            match codes::m_word(code) {
                Kind::Known => self.keep_or_restore(code, &word)?,
                Kind::Skipped => self.skip(&word, line),
                Kind::Harmless => {
                    self.say_nothing(&word, line)?;
                    self.letters_of(code, &word, block)?;
                }
                Kind::Refused => return Err(Problem::new(word, codes::m_reason(code), ALLOWED)),
            }
        }
        Ok(())
    }

    /// Executes M70 to M72.
    fn keep_or_restore(&mut self, code: Code, word: &str) -> Result<(), Problem> {
        match code.0 {
            70 => self.saved = Some(self.modal),
            71 => self.saved = None,
            72 => {
                let nothing = || Problem::new(word, "without M70 before", "M70 first");
                let saved = self.saved.ok_or_else(nothing)?;
                if saved.tool != self.modal.tool && saved.tool != [0.0; 3] {
                    let problem = "brings back a tool length, of which controls differ";
                    return Err(Problem::new(word, problem, "G43, G43.1 or G49 behind it"));
                }
                self.modal = saved;
            }
            _ => {}
        }
        Ok(())
    }

    /// Removes the letters of an M word that is skipped.
    ///
    /// # Errors
    ///
    /// Returns an error for a letter that may belong to another word too, and for one by which the
    /// M word would change the path.
    fn letters_of(&self, code: Code, word: &str, block: &mut Block) -> Result<(), Problem> {
        for letter in codes::m_changes(code) {
            if block.letter(*letter).is_some_and(|value| value != 0.0) {
                let problem = format!("with {word} changes the path");
                return Err(Problem::new(char::from(*letter), problem, "0"));
            }
        }
        let own = codes::m_letters(code);
        if let (None, true) = (own, block.g.is_empty()) {
            let moves = [b'X', b'Y', b'Z', b'W']
                .into_iter()
                .find(|&letter| block.letter(letter).is_some());
            if let Some(letter) = moves.filter(|_| !codes::m_has_axes(code)) {
                let problem = format!("with {word} in one line, to which it may belong");
                let allowed = "a line for each";
                return Err(Problem::new(char::from(letter), problem, allowed));
            }
            block.clear_letters();
            return Ok(());
        }
        for &letter in own.unwrap_or(b"PQLESR") {
            // One turn is the default of an arc.
            let one_turn = letter == b'P' && block.letter(letter) == Some(1.0);
            if block.letter(letter).is_some() && self.wanted(letter, block, one_turn) {
                let problem = format!("with {word} and a G word that has it too");
                return Err(Problem::new(char::from(letter), problem, "a line for each"));
            }
            block.take(letter);
        }
        Ok(())
    }

    /// True if a letter affects the path through a G word of the line or the current motion.
    fn wanted(&self, letter: u8, block: &Block, one_turn: bool) -> bool {
        let in_force = self.modal.motion.filter(|_| block.moves());
        let in_force = in_force.map(|motion| motion.code());
        let codes = block.g.iter().copied().chain(in_force);
        let mut codes = codes.filter(|code| !(one_turn && matches!(code, (2 | 3, 0))));
        codes.any(|code| codes::g_letters(code).contains(&letter))
    }
}
