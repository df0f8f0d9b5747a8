//! Instructions that move no pen, and unknown ones.

use super::Plotter;
use super::lexer::Mnemonic;
use crate::input::Fault;

/// Instructions of HPGL, HPGL/2 and of plotter makers that neither move the pen nor change its
/// path.
const STILL: &[&[u8; 2]] = &[
    // Machine: speed, force, pens, memory, keys, answers to the computer.
    b"AP", b"AS", b"EC", b"FS", b"GC", b"GM", b"GP", b"IM", b"KY", b"MT", b"NP", b"NR", b"OA",
    b"OC", b"OD", b"OE", b"OF", b"OG", b"OH", b"OI", b"OK", b"OL", b"OO", b"OP", b"OS", b"OT",
    b"OW", b"QL", b"ST", b"VA", b"VN", b"VS", b"DC", b"DP", // How lines look.
    b"CR", b"CV", b"LA", b"LT", b"MC", b"PC", b"PP", b"RF", b"SV", b"TR", b"UL",
    // Style of letters: there is one font.
    b"AD", b"CA", b"CC", b"CF", b"CM", b"CS", b"DL", b"DS", b"FI", b"FN", b"IV", b"LM", b"SA",
    b"SB", b"SD", b"SS", b"TD", // Comments and messages.
    b"CO", b"MG", b"WD",
];

/// Instructions that begin another page or copy.
const PAGES: &[&[u8; 2]] = &[b"AF", b"AH", b"FR", b"PG", b"RP"];

/// Instructions of Roland and others, with an exclamation mark, that move no pen: page feed, tool,
/// force, not ready, speed, dwell, motor.
const MAKERS_STILL: &[&[u8; 2]] = &[
    b"PG", b"ST", b"FS", b"NR", b"VS", b"DW", b"MC", b"RC", b"CT", b"AS",
];

impl Plotter<'_> {
    /// Skips an instruction.
    ///
    /// # Errors
    ///
    /// Returns an error for an unknown one, unless lenient.
    pub(super) fn skip(&mut self, mnemonic: Mnemonic, line: usize) -> Result<(), Fault> {
        let name = mnemonic.as_str();
        let letters = &mnemonic.0;
        if STILL.contains(&letters) {
            self.note(name, line, || format!("{name}: skipped"));
        } else if PAGES.contains(&letters) {
            let text = || format!("{name}: skipped; all pages are drawn over each other, once");
            self.note(name, line, text);
        } else {
            self.unknown(name, line)?;
        }
        self.skip_arguments(mnemonic)
    }

    /// Skips an instruction with an exclamation mark.
    ///
    /// # Errors
    ///
    /// Returns an error for an unknown one, unless lenient.
    pub(super) fn makers_own(&mut self, mnemonic: Mnemonic) -> Result<(), Fault> {
        let line = self.lexer.start();
        let name = format!("!{mnemonic}");
        if MAKERS_STILL.contains(&&mnemonic.0) {
            self.note(&name, line, || format!("{name}: skipped"));
        } else {
            self.unknown(&name, line)?;
        }
        self.lexer.skip_parameters()
    }

    fn unknown(&mut self, name: &str, line: usize) -> Result<(), Fault> {
        if !self.lenient {
            let allowed = "instructions of HPGL and HPGL/2; with --lenient it is skipped";
            let problem = "is not known and may move the pen";
            return Err(self.lexer.fault(problem, allowed));
        }
        let text = || format!("{name}: not known, skipped; what it draws or moves is missing");
        self.note(name, line, text);
        Ok(())
    }

    /// Skips the parameters of an instruction.
    pub(super) fn skip_arguments(&mut self, mnemonic: Mnemonic) -> Result<(), Fault> {
        match &mnemonic.0 {
            b"LB" | b"BL" | b"WD" => self.lexer.label().map(|_| ()),
            b"MG" | b"CO" => self.lexer.skip_text(),
            b"SM" => self.lexer.character().map(|_| ()),
            _ => self.lexer.skip_parameters(),
        }
    }
}
