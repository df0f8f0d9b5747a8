//! What is known of a signal without its value.

use std::borrow::Cow;

/// How a signal is meant to be looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// A number.
    Decimal,
    /// A bit pattern or an address.
    Hex,
    /// A number whose course over time matters: drawn as an analog trace.
    Analog,
    /// A state: the value is an index into these names.
    States(&'static [&'static str]),
    /// On an array: the names of its elements, instead of the array's name and an index.
    Elements(&'static [&'static str]),
}

/// Which part of a circuit a signal stands in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Role {
    /// A port in.
    Input,
    /// A flip-flop.
    Register,
    /// A combinational net.
    Net,
}

/// What is known of a field of a `signals!` struct without looking at its value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// Its name; empty where a struct stands for a part of a circuit and adds no scope.
    pub name: &'static str,
    /// Its doc comment.
    pub doc: &'static str,
    /// How it is meant to be looked at.
    pub format: Format,
    /// Whether it is visible outside its module: a port out, where it is a register or a net.
    pub public: bool,
    /// The part of a circuit that starts here, if one does.
    pub role: Option<Role>,
}

impl Field {
    /// A field with a name and nothing else said of it.
    pub const fn named(name: &'static str) -> Field {
        Field {
            name,
            doc: "",
            format: Format::Decimal,
            public: false,
            role: None,
        }
    }

    /// The struct of one part of a circuit: its fields stand in the circuit's own scope.
    pub const fn part(role: Role) -> Field {
        Field {
            role: Some(role),
            ..Field::named("")
        }
    }

    /// Its doc comment as plain text: in one line, links by their names alone.
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

    /// The name of element `index` where this field is an array.
    pub fn element(&self, index: usize) -> Cow<'static, str> {
        match self.format {
            Format::Elements(names) if index < names.len() => Cow::Borrowed(names[index]),
            _ => Cow::Owned(format!("{}{index}", self.name)),
        }
    }
}

/// What kind of word a leaf is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// One wire.
    Bit,
    /// An unsigned word.
    Unsigned,
    /// A two's complement word.
    Signed,
}

/// Kind and width of a leaf.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Shape {
    /// What kind of word.
    pub kind: Kind,
    /// Width in bits.
    pub width: usize,
}

impl Shape {
    /// Least and greatest number of a word.
    pub fn range(self) -> (i128, i128) {
        let width = self.width.clamp(1, 64);
        match self.kind {
            Kind::Signed => (-1 << (width - 1), (1 << (width - 1)) - 1),
            Kind::Bit | Kind::Unsigned => (0, (1 << width) - 1),
        }
    }

    /// Number that 64 bits mean before they are cut to the word.
    pub(crate) fn number(self, bits: u64) -> i128 {
        match self.kind {
            Kind::Signed => (bits as i64).into(),
            Kind::Bit | Kind::Unsigned => bits.into(),
        }
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
