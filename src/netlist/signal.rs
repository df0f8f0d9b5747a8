//! Description of a signal without its value.

use std::borrow::Cow;

/// Display format of a signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// Decimal number.
    Decimal,
    /// Bit pattern or address.
    Hex,
    /// Number drawn as an analog trace, since its course over time matters.
    Analog,
    /// State: the value is an index into these names.
    States(&'static [&'static str]),
    /// Names for the elements of an array, in place of the array's name and an index.
    Elements(&'static [&'static str]),
}

/// Role of a signal in its circuit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Role {
    /// Input port.
    Input,
    /// Flip-flop or memory.
    Register,
    /// Combinational net.
    Net,
}

/// Description of a field of a `signals!` struct.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// Name; empty for a struct that stands for a part of a circuit and adds no scope.
    pub name: &'static str,
    /// Doc comment.
    pub doc: &'static str,
    /// Display format.
    pub format: Format,
    /// True if the field is visible outside its module: a register or net is an output port then.
    pub public: bool,
    /// Role of the part of a circuit that starts here, if one does.
    pub role: Option<Role>,
}

impl Field {
    /// Creates a field with a name only.
    pub const fn named(name: &'static str) -> Field {
        Field {
            name,
            doc: "",
            format: Format::Decimal,
            public: false,
            role: None,
        }
    }

    /// Creates the field of one part of a circuit, whose signals are in the circuit's own scope.
    pub const fn part(role: Role) -> Field {
        Field {
            role: Some(role),
            ..Field::named("")
        }
    }

    /// Returns the doc comment as plain text: one line, links replaced by their names.
    pub fn plain_doc(&self) -> String {
        let mut text = String::new();
        let mut rest = self.doc;
        while let Some((before, link)) = rest.split_once("[`") {
            text.push_str(before);
            let Some((path, behind)) = link.split_once("`]") else {
                text.push_str("[`");
                rest = link;
                continue;
            };
            let records = ["In", "Reg", "Net", "Self", "self", "super", "crate"];
            let names = path.split("::").filter(|name| !records.contains(name));
            let names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
            let names: Vec<&str> = names.iter().rev().map(String::as_str).collect();
            text.push_str(&names.join(" of "));
            let target = behind.strip_prefix('(').and_then(|it| it.split_once(')'));
            rest = target.map_or(behind, |(_, behind)| behind);
        }
        text.push_str(rest);
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// Returns the name of element `index` if the field is an array.
    pub fn element(&self, index: usize) -> Cow<'static, str> {
        match self.format {
            Format::Elements(names) if index < names.len() => Cow::Borrowed(names[index]),
            _ => Cow::Owned(format!("{}{index}", self.name)),
        }
    }
}

/// Kind of word of a leaf.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// One wire.
    Bit,
    /// An unsigned word.
    Unsigned,
    /// A two's complement word.
    Signed,
}

/// Kind and width of a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Shape {
    /// Kind of the word.
    pub kind: Kind,
    /// Width in bits.
    pub width: usize,
}

impl Shape {
    /// Returns least and greatest number of the word.
    pub fn range(self) -> (i128, i128) {
        let width = self.width.clamp(1, 64);
        match self.kind {
            Kind::Signed => (-1 << (width - 1), (1 << (width - 1)) - 1),
            Kind::Bit | Kind::Unsigned => (0, (1 << width) - 1),
        }
    }

    /// Returns the number that 64 bits mean before they are cut to the word.
    pub(crate) fn number(self, bits: u64) -> i128 {
        match self.kind {
            Kind::Signed => (bits as i64).into(),
            Kind::Bit | Kind::Unsigned => bits.into(),
        }
    }
}

/// One wire.
pub const BIT: Shape = Shape {
    kind: Kind::Bit,
    width: 1,
};

/// Returns the shape of an unsigned word.
pub const fn unsigned(width: usize) -> Shape {
    Shape {
        kind: Kind::Unsigned,
        width,
    }
}

/// Returns the shape of a two's complement word.
pub const fn signed(width: usize) -> Shape {
    Shape {
        kind: Kind::Signed,
        width,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_doc_is_one_line_without_links() {
        let of = |doc| {
            Field {
                doc,
                ..Field::named("f")
            }
            .plain_doc()
        };
        assert_eq!(of(" By [`GAIN`](state::GAIN);\n two. "), "By `GAIN`; two.");
        assert_eq!(of("see [`loop::In::gain`]."), "see `gain` of `loop`.");
        assert_eq!(of("[`a::In`] and x[1], [`b"), "`a` and x[1], [`b");
    }
}
