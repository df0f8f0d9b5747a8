//! Paths of signals in different dumps.
//!
//! A path is scopes and a name with dots between them. An element of a memory is written `mem[5]`;
//! `mem.word5` and `mem.stage5`, which this crate writes, mean the same. So does
//! `mem_words[5].word`, which its Verilog has for Icarus.

/// Greatest number of names in a message.
pub(super) const LISTED: usize = 20;

/// Converts a path of the reader, which takes memory elements for scopes and keeps the backslash
/// of an escaped name.
pub(super) fn path(full_name: &str) -> String {
    let plain = full_name.replace(".\\", ".").replace(".[", "[");
    plain.strip_prefix('\\').unwrap_or(&plain).to_owned()
}

/// Returns the path with a word or stage written as an element of its memory.
pub(super) fn element(path: &str) -> String {
    let Some((scope, name)) = path.rsplit_once('.') else {
        return path.to_owned();
    };
    let digits = |number: &&str| {
        let plain = number.bytes().all(|byte| byte.is_ascii_digit()) && !number.is_empty();
        plain && (*number == "0" || !number.starts_with('0'))
    };
    if name == "word"
        && let Some((memory, number)) = scope.rsplit_once("_words[")
        && number
            .strip_suffix(']')
            .is_some_and(|number| digits(&number))
    {
        return format!("{memory}[{number}");
    }
    let number = name
        .strip_prefix("word")
        .or_else(|| name.strip_prefix("stage"));
    match number.filter(digits) {
        Some(number) => format!("{scope}[{number}]"),
        None => path.to_owned(),
    }
}

/// Splits a path from the bits or the element in brackets after it: `bus[27:4]` is
/// `("bus", 27, 4)`, `bus[3]` is `("bus", 3, 3)`.
pub fn brackets(path: &str) -> Option<(&str, i64, i64)> {
    let (base, inner) = path.strip_suffix(']')?.rsplit_once('[')?;
    let (first, last) = inner.split_once(':').unwrap_or((inner, inner));
    Some((
        base.trim_end(),
        first.trim().parse().ok()?,
        last.trim().parse().ok()?,
    ))
}

/// Lists names for a message, at most [`LISTED`].
pub(super) fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let shown: Vec<_> = names.iter().take(LISTED).map(AsRef::as_ref).collect();
    let mut text = shown.join(", ");
    if names.len() > LISTED {
        text.push_str(&format!(" and {} more", names.len() - LISTED));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_of_memories_have_one_form() {
        assert_eq!(element("a.mem.word15"), "a.mem[15]");
        assert_eq!(element("a.pipe.stage0"), "a.pipe[0]");
        assert_eq!(element("a.mem_words[15].word"), "a.mem[15]");
        for same in [
            "word1",
            "a.mem_words.word",
            "a.mem_words[15].x.word",
            "a.words[15].word",
            "a.word",
            "a.word01",
            "a.words1",
            "a.mem[1]",
            "a.stage1x",
        ] {
            assert_eq!(element(same), same);
        }
        assert_eq!(path("tb.dut.\\mem.[3]"), "tb.dut.mem[3]");
        assert_eq!(path("\\tb.x"), "tb.x");
    }

    #[test]
    fn brackets_are_bits_or_an_element() {
        assert_eq!(brackets("tb.bus[27:4]"), Some(("tb.bus", 27, 4)));
        assert_eq!(brackets("tb.bus[-1]"), Some(("tb.bus", -1, -1)));
        for none in ["tb.bus", "tb.bus[x]", "tb.bus]", "tb.bus[1:2:3]"] {
            assert_eq!(brackets(none), None, "{none}");
        }
    }

    #[test]
    fn long_lists_are_cut() {
        let names: Vec<_> = (0..22).map(|n| n.to_string()).collect();
        assert!(listed(&names).ends_with("18, 19 and 2 more"));
    }
}
