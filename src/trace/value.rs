use crate::netlist::{Format, Kind, Shape};

/// Returns the number that the bits of a word mean.
pub fn number(shape: Shape, bits: u64) -> i128 {
    match shape.kind {
        Kind::Signed if bits >> (shape.width - 1) & 1 == 1 => i128::from(bits) - (1 << shape.width),
        _ => bits.into(),
    }
}

/// Formats a word as text: a state by name, an address in hex, anything else in decimal.
pub fn show(shape: Shape, format: Format, bits: u64) -> String {
    match format {
        Format::States(names) => {
            match usize::try_from(bits).ok().and_then(|bits| names.get(bits)) {
                Some(name) => (*name).to_owned(),
                None => bits.to_string(),
            }
        }
        Format::Hex => format!("{bits:#x}"),
        Format::Decimal | Format::Analog | Format::Elements(_) => number(shape, bits).to_string(),
    }
}

/// Parses a word: a number in decimal, `0x` or `0b`, or a state's name.
///
/// Returns `None` if it is neither or does not fit. A signed word takes hex and binary as a bit
/// pattern.
pub fn read(shape: Shape, format: Format, text: &str) -> Option<u64> {
    if let Format::States(names) = format
        && let Some(index) = names.iter().position(|name| *name == text)
    {
        return u64::try_from(index)
            .ok()
            .filter(|&bits| bits <= mask(shape));
    }
    let pattern = match (text.strip_prefix("0x"), text.strip_prefix("0b")) {
        (Some(digits), _) => Some((digits, 16)),
        (_, Some(digits)) => Some((digits, 2)),
        _ => None,
    };
    if let Some((digits, radix)) = pattern {
        let bits = u64::from_str_radix(digits, radix).ok()?;
        return (bits <= mask(shape)).then_some(bits);
    }
    let wanted: i128 = text.parse().ok()?;
    let bits = (wanted as u64) & mask(shape);
    (number(shape, bits) == wanted).then_some(bits)
}

/// Returns a mask of all bits of a word.
pub fn mask(shape: Shape) -> u64 {
    u64::MAX >> (64 - shape.width.clamp(1, 64))
}

#[cfg(test)]
mod tests {
    use super::*;

    const U4: Shape = Shape {
        kind: Kind::Unsigned,
        width: 4,
    };
    const I4: Shape = Shape {
        kind: Kind::Signed,
        width: 4,
    };
    const I64: Shape = Shape {
        kind: Kind::Signed,
        width: 64,
    };

    #[test]
    fn what_is_shown_can_be_read() {
        for format in [Format::Decimal, Format::Hex, Format::States(&["A", "B"])] {
            for shape in [U4, I4] {
                for bits in 0..16 {
                    let text = show(shape, format, bits);
                    let states_are_unsigned = matches!(format, Format::States(_)) && shape == I4;
                    if !states_are_unsigned {
                        assert_eq!(read(shape, format, &text), Some(bits), "{text}");
                    }
                }
            }
        }
    }

    #[test]
    fn numbers_at_the_ends() {
        let ends = [
            (U4, "15", Some(15)),
            (U4, "16", None),
            (U4, "-1", None),
            (U4, "0x10", None),
            (U4, "0b1111", Some(15)),
            (I4, "-8", Some(8)),
            (I4, "-9", None),
            (I4, "7", Some(7)),
            (I4, "8", None),
            (I4, "0xf", Some(15)),
            (I64, "-9223372036854775808", Some(1 << 63)),
            (I64, "9223372036854775808", None),
            (U4, "", None),
            (U4, "x", None),
        ];
        for (shape, text, bits) in ends {
            assert_eq!(read(shape, Format::Decimal, text), bits, "{text}");
        }
        assert_eq!(number(I64, u64::MAX), -1);
        assert_eq!(show(I4, Format::States(&["A"]), 3), "3");
    }
}
