//! The interface of an entity, as its text declares it.

/// An entity.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Entity {
    /// Library and use clauses before it.
    pub context: Vec<String>,
    /// Generics: the name, the type, and the default value or an empty text.
    pub generics: Vec<[String; 3]>,
    pub ports: Vec<Port>,
}

/// A port.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Port {
    /// Its name in small letters.
    pub name: String,
    pub is_input: bool,
    /// The type with its range.
    pub kind: String,
}

/// Types of ports that convert to bits.
pub const KINDS: &str = "std_logic, std_logic_vector, signed and unsigned";

impl Port {
    /// Returns the type without its range, if the port converts to bits: empty for a single bit.
    pub fn vector(&self) -> Option<&str> {
        let kind = self.kind.split('(').next().unwrap_or_default().trim();
        let is = |name: &&&str| name.eq_ignore_ascii_case(kind);
        if ["std_logic", "std_ulogic"].iter().any(|name| is(&name)) {
            return Some("");
        }
        let vectors = [
            "std_logic_vector",
            "std_ulogic_vector",
            "signed",
            "unsigned",
        ];
        vectors.iter().find(is).copied()
    }
}

/// Returns a text without comments.
fn uncommented(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split("--").next().unwrap_or(line));
    lines.collect::<Vec<_>>().join("\n")
}

fn is_letter(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// Returns the place after a word in small letters, from `from` on.
fn after(text: &str, word: &str, from: usize) -> Option<usize> {
    let found = text[from..].match_indices(word).map(|(at, _)| from + at);
    let alone = found.filter(|at| {
        let end = at + word.len();
        !text[..*at].ends_with(is_letter) && !text[end..].starts_with(is_letter)
    });
    alone.map(|at| at + word.len()).next()
}

/// Returns the text in the brackets that open first after a place, and the place after them.
fn bracketed(text: &str, from: usize) -> Option<(&str, usize)> {
    let open = from + text[from..].find('(')?;
    let mut depth = 0;
    for (at, c) in text[open..].char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some((&text[open + 1..open + at], open + at + 1));
        }
    }
    None
}

/// Returns the declarations of a clause: names, and what stands after their colon.
fn declarations(clause: &str) -> Vec<(Vec<&str>, &str)> {
    let mut depth = 0;
    let split = |c: char| {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        c == ';' && depth == 0
    };
    let parts: Vec<&str> = clause.split(split).collect();
    let declared = parts.into_iter().filter_map(|part| {
        let (names, rest) = part.split_once(':')?;
        let names = names
            .split(',')
            .filter_map(|name| name.split_whitespace().last());
        Some((names.collect(), rest.trim()))
    });
    declared.collect()
}

/// Splits a type from its default value.
fn default(declared: &str) -> (&str, &str) {
    let (kind, value) = declared.split_once(":=").unwrap_or((declared, ""));
    (kind.trim(), value.trim())
}

impl Entity {
    /// Returns the entity `name`, in small letters, if the text declares it.
    pub fn find(text: &str, name: &str) -> Option<Self> {
        let text = uncommented(text);
        // The same places as in the text.
        let small = text.to_ascii_lowercase();
        let mut from = 0;
        let begin = loop {
            from = after(&small, "entity", from)?;
            let rest = small[from..].trim_start();
            if let Some(rest) = rest.strip_prefix(name)
                && rest.trim_start().starts_with("is")
                && rest.starts_with(char::is_whitespace)
            {
                break from;
            }
        };
        let clauses = text[..begin].split(';').map(str::trim);
        let context = clauses.filter(|clause| {
            let clause = clause.to_ascii_lowercase();
            clause.starts_with("library ") || clause.starts_with("use ")
        });
        let mut entity = Entity {
            context: context.map(|clause| format!("{clause};")).collect(),
            ..Entity::default()
        };
        let port = after(&small, "port", begin)?;
        if let Some(generic) = after(&small, "generic", begin).filter(|generic| *generic < port) {
            for (names, declared) in declarations(bracketed(&text, generic)?.0) {
                let (kind, value) = default(declared);
                let generics = names
                    .into_iter()
                    .map(|name| [name, kind, value].map(str::to_owned));
                entity.generics.extend(generics);
            }
        }
        for (names, declared) in declarations(bracketed(&text, port)?.0) {
            let (kind, _) = default(declared);
            let (mode, rest) = kind.split_once(char::is_whitespace).unwrap_or((kind, ""));
            let (is_input, kind) = match &*mode.to_ascii_lowercase() {
                "in" => (true, rest.trim()),
                "out" | "buffer" => (false, rest.trim()),
                // Its type is refused.
                "inout" => (true, kind),
                _ => (true, kind),
            };
            entity.ports.extend(names.into_iter().map(|name| Port {
                name: name.to_ascii_lowercase(),
                is_input,
                kind: kind.to_owned(),
            }));
        }
        Some(entity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "\
-- entity probe is not here
library ieee; use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity probes is end entity;
Entity Probe is
  generic (w, n : positive := 24; name : string); -- two
  port (clk, RST : in std_logic; a : signed(w-1 downto 0) := (others => '0');
        signal taken : out std_logic := '0'; both : inout std_logic; n2 : buffer natural range 0 to 3);
end entity;
";

    #[test]
    fn an_entity_is_read_with_its_generics_and_ports() {
        let entity = Entity::find(TEXT, "probe").unwrap();
        let context = [
            "library ieee;",
            "use ieee.std_logic_1164.all;",
            "use ieee.numeric_std.all;",
        ];
        assert_eq!(entity.context, context);
        assert_eq!(
            entity.generics,
            [
                ["w", "positive", "24"],
                ["n", "positive", "24"],
                ["name", "string", ""]
            ]
        );
        let ports: Vec<_> = entity
            .ports
            .iter()
            .map(|port| (&*port.name, port.is_input, &*port.kind))
            .collect();
        let expected = [
            ("clk", true, "std_logic"),
            ("rst", true, "std_logic"),
            ("a", true, "signed(w-1 downto 0)"),
            ("taken", false, "std_logic"),
            ("both", true, "inout std_logic"),
            ("n2", false, "natural range 0 to 3"),
        ];
        assert_eq!(ports, expected);
        let vectors: Vec<_> = entity.ports.iter().map(Port::vector).collect();
        assert_eq!(
            vectors,
            [Some(""), Some(""), Some("signed"), Some(""), None, None]
        );
        assert_eq!(Entity::find(TEXT, "prob"), None);
    }
}
