//! Escape sequences of plotters, of printers, and of files made for them.

use super::Lexer;

impl Lexer<'_> {
    /// Skips an escape sequence after its ESC, with the bytes it announces. Returns its first
    /// character.
    ///
    /// `ESC .` belongs to plotters and has numbers up to a colon. A sequence that begins with
    /// another mark has numbers and lower-case letters up to an upper-case one; a `W`, and an `X`
    /// of `ESC &p`, announce the number of bytes given before them. `ESC %0A` leaves the plotter
    /// language, `ESC %0B` returns to it.
    pub(super) fn escape(&mut self) -> char {
        let kind = self.bump().map_or(' ', char::from);
        match kind {
            '.' => self.device_control(),
            '!'..='/' => self.parametrised(kind),
            // Reset: also leaves a printer language, if a file has no sequence of its own.
            'E' => self.printer = false,
            _ => {}
        }
        kind
    }

    fn device_control(&mut self) {
        self.bump();
        let rest = self.text.get(self.at..).unwrap_or_default();
        let numbers = rest
            .iter()
            .take_while(|&&byte| byte.is_ascii_digit() || byte == b';');
        let length = numbers.count();
        if rest.get(length) == Some(&b':') {
            self.at += length + 1;
        }
    }

    fn parametrised(&mut self, kind: char) {
        let group = self.take_if(|byte| byte.is_ascii_lowercase());
        let mut number: usize = 0;
        while let Some(byte) = self.peek() {
            match byte {
                b'0'..=b'9' => {
                    let digit = usize::from(byte - b'0');
                    number = number.saturating_mul(10).saturating_add(digit);
                }
                b'+' | b'-' | b'.' => {}
                b'a'..=b'z' | b'A'..=b'Z' | b'@' => {
                    self.bump();
                    match (kind, group, byte.to_ascii_uppercase()) {
                        (_, _, b'W') | ('&', Some(b'p'), b'X') => self.skip_bytes(number),
                        ('%', _, b'A') => self.printer = true,
                        ('%', _, b'B' | b'X') => self.printer = false,
                        _ => {}
                    }
                    number = 0;
                    if byte.is_ascii_lowercase() {
                        continue;
                    }
                    return;
                }
                _ => return,
            }
            self.bump();
        }
    }

    fn skip_bytes(&mut self, count: usize) {
        for _ in 0..count {
            if self.bump().is_none() {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::hpgl::lexer::Item;

    /// Returns the items of a text: instructions by their letters, escape sequences by their
    /// character.
    fn items(text: &[u8]) -> String {
        let mut lexer = Lexer::new("t", text, false);
        let mut shown = String::new();
        while let Some(item) = lexer.item().unwrap() {
            match item {
                Item::Instruction(mnemonic) => shown += mnemonic.as_str(),
                Item::Escape(kind) => shown.push(kind),
                other => shown += &format!("{other:?}"),
            }
            shown.push(' ');
        }
        shown
    }

    #[test]
    fn sequences_end_where_they_say() {
        for (text, shown) in [
            (&b"\x1b.(PD"[..], ". PD "),
            (b"\x1b.I81;;17:PD", ". PD "),
            (b"\x1b.N;19:PU;\x1b.@;0:PD", ". PU . PD "),
            (b"\x1bEPU\x1b%0BIN", "E PU % IN "),
            (b"\x1b%-1BPU", "% PU "),
            (b"\x1b&l1o3APU", "& PU "),
            (b"\x1b*b3W;PDPU", "* PU "),
            (b"\x1b*b2m3WPDIPU", "* PU "),
            (b"\x1b&p3XPD;PU", "& PU "),
            (b"\x1b*r3XPDPU", "* PD PU "),
            (b"\x1b*b9999999999999999999999WPDPU", "* "),
            (b"PU\x1b%0Aany ;thing\x1b*b1W\x1b\x1b%0BPD", "PU % * % PD "),
            (b"PU\x1b%0Ax\x1b%-12345X@PJL EOJ\nPD", "PU % % Job PD "),
            (b"PU\x1b", "PU   "),
            (b"PU\x1b%", "PU % "),
        ] {
            assert_eq!(items(text), shown, "{:?}", text.escape_ascii().to_string());
        }
    }
}
