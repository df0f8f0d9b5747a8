//! Parameter counts, and how a lenient reader handles wrong ones.

use super::Plotter;
use crate::input::Fault;

impl Plotter<'_> {
    /// Returns a coordinate pair with the line in which it begins; `None` at the end of the
    /// instruction.
    pub(super) fn pair(&mut self) -> Result<Option<([f64; 2], usize)>, Fault> {
        let Some(x) = self.lexer.number()? else {
            return Ok(None);
        };
        let line = self.lexer.line();
        if let Some(y) = self.lexer.number()? {
            return Ok(Some(([x, y], line)));
        }
        let problem = "an X without its Y: an odd count of coordinates";
        let fault = self.lexer.fault(problem, "pairs of X and Y");
        self.forgive(Fault { line, ..fault }, "the X is skipped")?;
        Ok(None)
    }

    /// Returns the parameters of an instruction that accepts the given counts, in rising order. A
    /// lenient reader drops excess parameters, and returns none if the count is wrong otherwise.
    pub(super) fn parameters(&mut self, counts: &[usize]) -> Result<Vec<f64>, Fault> {
        let most = counts.last().copied().unwrap_or(0);
        let mut numbers = Vec::new();
        while let Some(number) = self.lexer.number()? {
            if numbers.len() < most {
                numbers.push(number);
                continue;
            }
            let fault = self
                .lexer
                .fault("too many parameters", format!("at most {most}"));
            self.forgive(fault, "those beyond are skipped")?;
        }
        if !counts.contains(&numbers.len()) {
            let allowed: Vec<String> = counts.iter().map(usize::to_string).collect();
            let problem = format!("{} parameters", numbers.len());
            let allowed = format!("{} parameters", allowed.join(", "));
            let instead = match counts.contains(&0) {
                true => "taken as without any",
                false => "skipped",
            };
            self.forgive(self.lexer.fault(problem, allowed), instead)?;
            numbers.clear();
        }
        Ok(numbers)
    }

    /// Converts a fault to a warning, if lenient.
    pub(super) fn forgive(&mut self, fault: Fault, instead: &str) -> Result<(), Fault> {
        if !self.lenient {
            return Err(fault);
        }
        let Fault {
            line,
            field,
            problem,
            ..
        } = fault;
        let key = format!("{field} {problem}");
        self.note(&key, line, || format!("{field}: {problem}; {instead}"));
        Ok(())
    }
}
