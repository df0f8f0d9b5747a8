//! Execution of O-words: branches and loops of a program.

use super::expression::Scanner;
use super::flow::{Keyword, o_word};
use super::problem::Problem;
use super::runner::Runner;
use super::text::{clean, line_at};

impl Runner<'_> {
    /// Executes an O-word; its line begins at `start`, and `rest` is the text after it.
    pub(super) fn flow(
        &mut self,
        start: usize,
        line: usize,
        label: &str,
        keyword: Keyword,
        mut rest: Scanner<'_>,
    ) -> Result<(), Problem> {
        use Keyword as K;
        let field = format!("O{label} {}", keyword.name());
        let here = self.source.index().at(start);
        let lone = || {
            Problem::new(
                &field,
                "without the rest of its block",
                "blocks with both ends",
            )
        };
        let (head, onward, end) = match self.place(here) {
            Some(place) => (place.head, place.onward, place.end),
            None if keyword == K::Call => (None, None, None),
            None => return Err(lone()),
        };
        let closes = head != here;
        let mut value = None;
        let needs = matches!(keyword, K::If | K::ElseIf | K::While | K::Repeat);
        let mut arguments = Vec::new();
        while rest.next_word() == Some(b'[') {
            arguments.push(rest.value(&self.known(line))?);
        }
        if rest.next_word().is_some() {
            let problem = format!("'{}' behind it", rest.rest_text());
            return Err(Problem::new(field, problem, "nothing but values in []"));
        }
        if keyword != K::Call {
            value = arguments.first().copied();
        }
        if needs && value.is_none() {
            return Err(Problem::new(field, "without a value", "a value in []"));
        }
        let holds = value.is_some_and(|value| value != 0.0);
        let paired = match keyword {
            K::Call | K::Return => true,
            K::Break | K::Continue => head.is_some(),
            _ => end.is_some(),
        };
        if !paired {
            return Err(lone());
        }
        match keyword {
            // A subroutine or block that runs ends with its own end word.
            K::Sub | K::Do | K::EndIf | K::Program => {
                if keyword == K::Sub {
                    self.go_after(end);
                }
            }
            K::Call => self.call(line, label, &arguments)?,
            K::Return | K::EndSub => {
                if !self.leave(value)? {
                    return Err(Problem::new(
                        field,
                        "outside of a call",
                        "inside a called sub",
                    ));
                }
            }
            K::If if !holds => self.branch(onward)?,
            // End of a branch that was executed.
            K::ElseIf | K::Else => self.go_after(end),
            K::While if closes && holds => self.go_after(head),
            K::While if !closes && !holds => self.go_after(end),
            K::If | K::While => {}
            K::EndWhile => self.go_to(head),
            K::Repeat => {
                let times = value.unwrap_or(0.0).round().max(0.0) as u64;
                if times == 0 {
                    self.go_after(end);
                } else if let Some(here) = here {
                    self.loops.push((here, times - 1));
                }
            }
            K::EndRepeat => self.repeat(head),
            K::Break | K::Continue => self.leave_loop(keyword, head)?,
        }
        Ok(())
    }

    /// Jumps to the line of an O-word.
    fn go_to(&mut self, at: Option<usize>) {
        if let Some(to) = self.place(at).map(|place| (place.start, place.line)) {
            self.at = to;
        }
    }

    /// Tries the branches after an IF that is false.
    fn branch(&mut self, mut at: Option<usize>) -> Result<(), Problem> {
        while let Some(place) = self.place(at) {
            let (keyword, start, line, onward) =
                (place.keyword, place.start, place.line, place.onward);
            let mut taken = true;
            if keyword == Keyword::ElseIf {
                let mut cleaned = Vec::new();
                let bytes = line_at(&self.source.text, start).map_or(&[][..], |(bytes, _)| bytes);
                clean(bytes, &mut cleaned)?;
                if let Some((_, _, mut rest)) = o_word(&cleaned, None)? {
                    rest.next_word();
                    taken = rest.value(&self.known(line))? != 0.0;
                }
            }
            if taken {
                self.go_after(at);
                return Ok(());
            }
            at = onward;
        }
        Ok(())
    }

    fn repeat(&mut self, head: Option<usize>) {
        match self.loops.last_mut() {
            Some((at, left)) if Some(*at) == head && *left > 0 => {
                *left -= 1;
                self.go_after(head);
            }
            Some((at, _)) if Some(*at) == head => {
                self.loops.pop();
            }
            _ => {}
        }
    }

    fn leave_loop(&mut self, keyword: Keyword, head: Option<usize>) -> Result<(), Problem> {
        let Some(place) = self.place(head) else {
            return Ok(());
        };
        let (kind, end) = (place.keyword, place.end);
        if end.is_none() {
            let name = kind.name();
            return Err(Problem::new(
                name,
                "without its end",
                "blocks with both ends",
            ));
        }
        // Loops inside the one that is left or continued end.
        let base = self.frames.last().map_or(0, |frame| frame.loops);
        let inner = |(at, _): &(usize, u64)| Some(*at) > head;
        while self.loops.len() > base && self.loops.last().is_some_and(inner) {
            self.loops.pop();
        }
        if keyword == Keyword::Continue {
            match kind {
                Keyword::While => self.go_to(head),
                Keyword::Repeat => {
                    self.go_after(end);
                    self.repeat(head);
                }
                _ => self.go_to(end),
            }
            return Ok(());
        }
        if kind == Keyword::Repeat {
            self.loops.pop();
        }
        self.go_after(end);
        Ok(())
    }
}
