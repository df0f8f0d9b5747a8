//! Numbers of encoded polylines (PE): little-endian digits of base 64 or 32, the last one marked.

use super::lexer::Lexer;
use crate::input::Fault;

/// Base of the digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Base {
    #[default]
    B64,
    B32,
}

/// Greatest number of bits of a number: more than any coordinate in range has, with its fraction.
const MOST_BITS: u32 = 60;

impl Base {
    /// Decodes a byte: a digit, and true if it is the last of its number.
    fn digit(self, byte: u8) -> Option<(i64, bool)> {
        match (self, byte) {
            (Base::B64, 63..=126) => Some((byte - 63, false)),
            (Base::B64, 191..=254) => Some((byte - 191, true)),
            (Base::B32, _) => match byte & 0x7f {
                low @ 63..=94 => Some((low - 63, false)),
                high @ 95..=126 => Some((high - 95, true)),
                _ => None,
            },
            _ => None,
        }
        .map(|(digit, last)| (i64::from(digit), last))
    }

    fn bits(self) -> u32 {
        match self {
            Base::B64 => 6,
            Base::B32 => 5,
        }
    }

    /// Reads a number that begins with the byte `first`, or else with the next byte.
    ///
    /// # Errors
    ///
    /// Returns an error for a byte that is not a digit, an end before the last digit, or more than
    /// 60 bits.
    pub(super) fn number(self, lexer: &mut Lexer<'_>, first: Option<u8>) -> Result<i64, Fault> {
        let allowed = "encoded numbers, the last digit of each marked as such";
        let mut byte = first;
        let (mut value, mut shift) = (0i64, 0);
        loop {
            let Some(digit) = (match byte.take() {
                Some(byte) => Some(byte),
                None => lexer.encoded()?.map(|(byte, _)| byte),
            }) else {
                return Err(lexer.fault_here("ends within a number", allowed));
            };
            let Some((digit, last)) = self.digit(digit) else {
                let shown = char::from(digit).escape_default();
                let problem = format!("'{shown}' in place of an encoded digit");
                return Err(lexer.fault_here(problem, allowed));
            };
            if shift + self.bits() > MOST_BITS {
                return Err(lexer.fault_here("a number of more than 60 bits", allowed));
            }
            value |= digit << shift;
            shift += self.bits();
            if last {
                let size = value >> 1;
                return Ok(if value & 1 == 1 { -size } else { size });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Encodes a number as a plotter's driver does.
    fn encode(base: Base, value: i64) -> Vec<u8> {
        let (radix, low, high) = match base {
            Base::B64 => (64, 63, 191),
            Base::B32 => (32, 63, 95),
        };
        let mut rest = value.unsigned_abs() * 2 + u64::from(value < 0);
        let mut text = Vec::new();
        while rest >= radix {
            text.push(low + (rest % radix) as u8);
            rest /= radix;
        }
        text.push(high + rest as u8);
        text
    }

    fn decode(base: Base, text: &[u8]) -> Result<i64, String> {
        let mut lexer = Lexer::new("t", text, false);
        base.number(&mut lexer, None).map_err(|fault| fault.problem)
    }

    #[test]
    fn numbers_out_of_the_manual() {
        // 82.83 with 7 fraction bits.
        assert_eq!(decode(Base::B64, &[83, 74, 196]), Ok(10_602));
        assert_eq!(encode(Base::B64, 0), [191]);
        assert_eq!(decode(Base::B64, &[191]), Ok(0));
        assert_eq!(decode(Base::B64, &[192]), Ok(0));
        assert_eq!(decode(Base::B64, &[193]), Ok(1));
        assert_eq!(decode(Base::B64, &[194]), Ok(-1));
        assert_eq!(decode(Base::B32, b"a"), Ok(1));
        assert_eq!(decode(Base::B32, b"B`"), Ok(-17));
        let bad = "'!' in place of an encoded digit";
        assert_eq!(decode(Base::B32, b"B!"), Err(bad.to_owned()));
        assert_eq!(
            decode(Base::B32, b"B;"),
            Err("ends within a number".to_owned())
        );
        assert_eq!(
            decode(Base::B32, &[b'?'; 13]),
            Err("a number of more than 60 bits".to_owned())
        );
    }

    proptest! {
        #[test]
        fn what_is_encoded_comes_back(value in -(1i64 << 58)..1i64 << 58, small in -3000i64..3000) {
            for base in [Base::B64, Base::B32] {
                for value in [value, small] {
                    let text = encode(base, value);
                    prop_assert_eq!(decode(base, &text), Ok(value));
                    // White space and control characters may be anywhere.
                    let spread: Vec<u8> = text.iter().flat_map(|&byte| [b'\n', byte]).collect();
                    prop_assert_eq!(decode(base, &spread), Ok(value));
                    if base == Base::B32 {
                        let eighth: Vec<u8> = text.iter().map(|byte| byte | 0x80).collect();
                        prop_assert_eq!(decode(base, &eighth), Ok(value));
                    }
                }
            }
        }
    }
}
