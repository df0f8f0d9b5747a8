//! Tool lengths.

use std::collections::HashMap;

use super::block::{Block, Code, name};
use super::machine::Machine;
use super::problem::Problem;
use crate::input::Point;

/// Effect of a G word on the tool length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Length {
    /// G49.
    Cancel,
    /// G43 and G44.
    Of { sign: f64 },
    /// G43.2.
    Add,
}

/// Lengths set by the program, by tool number, in millimetres; `None` for a length that is
/// unknown.
#[derive(Debug, Default)]
pub(super) struct Tools(HashMap<i64, Option<Point>>);

impl Machine<'_> {
    /// Applies a tool length.
    pub(super) fn tool_length(
        &mut self,
        line: usize,
        block: &mut Block,
        code: Code,
        length: Length,
    ) -> Result<(), Problem> {
        let word = name('G', code);
        let number = match length {
            Length::Cancel => {
                self.modal.tool = [0.0; 3];
                return Ok(());
            }
            _ => block.take(b'H').or(self.loaded),
        };
        let of = match number {
            Some(0.0) => [0.0; 3],
            None if !self.tools.0.is_empty() => {
                let problem = "without the tool, where the program sets lengths";
                let allowed = "H with the number of the tool, or the tool loaded by T and M6";
                return Err(Problem::new(word, problem, allowed));
            }
            number => match self.tools.0.get(&number.map_or(0, |number| number as i64)) {
                Some(Some(of)) => *of,
                Some(None) => {
                    let problem = "a length by G10 of which controls differ";
                    return Err(Problem::new('H', problem, "G10 L1 with X, Y and Z; G43.1"));
                }
                None => {
                    if self.strict {
                        self.say_nothing(&word, line)?;
                    }
                    let text = || "tool lengths are taken for 0".to_owned();
                    self.note("length", line, text);
                    [0.0; 3]
                }
            },
        };
        for (place, of) in self.modal.tool.iter_mut().zip(of) {
            *place = match length {
                Length::Of { sign } => sign * of,
                Length::Add => *place + of,
                Length::Cancel => 0.0,
            };
        }
        Ok(())
    }

    /// Executes G10 for a tool: L1 sets lengths by X, Y and Z, L10 lengths for which the tool is
    /// at X, Y and Z; other forms make the length unknown.
    pub(super) fn set_tool(
        &mut self,
        line: usize,
        (kind, number): (f64, f64),
        words: [Option<f64>; 3],
        other: bool,
    ) -> Result<(), Problem> {
        let given = words.iter().any(Option::is_some);
        let entry = self.tools.0.get(&(number as i64)).copied();
        if kind == 1.0 && given {
            let mut of = entry.flatten().unwrap_or_default();
            for (place, word) in of.iter_mut().zip(words) {
                *place = word.unwrap_or(*place);
            }
            self.tools.0.insert(number as i64, Some(of));
            return Ok(());
        }
        if kind == 10.0 && given && !other && !self.is_turned() {
            let [zero, shift] = [self.offsets.system(self.modal.system), self.offsets.shift()];
            let mut of = entry.flatten().unwrap_or_default();
            for (axis, place) in of.iter_mut().enumerate() {
                if let Some(word) = words.get(axis).copied().flatten() {
                    *place = self.at[axis] - zero[axis] - shift[axis] - word;
                }
            }
            self.tools.0.insert(number as i64, Some(of));
            return Ok(());
        }
        if given || (other && [1.0, 10.0, 11.0].contains(&kind)) {
            self.tools.0.insert(number as i64, None);
        }
        self.say_nothing("G10 tool table", line)
    }
}
