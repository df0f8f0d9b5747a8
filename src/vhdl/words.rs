//! Words that cannot be names in VHDL.

use std::collections::HashSet;
use std::sync::LazyLock;

/// Reserved words of VHDL-2008 and VHDL-2019, with those of PSL.
const KEYWORDS: &str = "\
    abs access after alias all and architecture array assert assume assume_guarantee attribute \
    begin block body buffer bus case component configuration constant context cover default \
    disconnect downto else elsif end entity exit fairness file for force function generate \
    generic group guarded if impure in inertial inout is label library linkage literal loop map \
    mod nand new next nor not null of on open or others out package parameter port postponed \
    private procedure process property protected pure range record register reject release rem \
    report restrict restrict_guarantee return rol ror select sequence severity shared signal sla \
    sll sra srl strong subtype then to transport type unaffected units until use variable view \
    vmode vpkg vprop vunit wait when while with xnor xor";

/// Reserved words of VHDL-AMS; analysers warn of them.
const ANALOG: &str = "\
    across break limit nature noise procedural quantity reference spectrum subnature terminal \
    through tolerance";

/// Names that the printed text uses: a signal of that name would hide them.
const USED: &str = "\
    ieee minimum natural numeric_std resize rising_edge rtl shift_left shift_right signed std \
    std_logic std_logic_1164 to_integer to_signed to_unsigned unsigned work";

/// Returns the names that no signal can have.
pub(super) fn reserved() -> &'static HashSet<&'static str> {
    static RESERVED: LazyLock<HashSet<&str>> = LazyLock::new(|| {
        let words = [KEYWORDS, ANALOG, USED].into_iter();
        words.flat_map(str::split_ascii_whitespace).collect()
    });
    &RESERVED
}

/// Returns a name that VHDL takes: in small letters, with single underscores inside only, and with
/// `_s` behind a reserved word.
pub(super) fn legal(name: &str) -> String {
    let parts = name.split(|c: char| !c.is_ascii_alphanumeric());
    let parts: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
    let mut name = parts.join("_").to_ascii_lowercase();
    if name.is_empty() {
        name.push_str("net");
    } else if name.starts_with(|c: char| c.is_ascii_digit()) {
        name.insert_str(0, "n_");
    }
    if reserved().contains(&*name) {
        name += "_s";
    }
    name
}

#[cfg(test)]
mod tests {
    use super::legal;

    #[test]
    fn names_become_legal() {
        for (name, expected) in [
            ("count", "count"),
            ("next", "next_s"),
            ("units", "units_s"),
            ("limit", "limit_s"),
            ("resize", "resize_s"),
            ("Signal", "signal_s"),
            ("Taken", "taken"),
            ("line__x_", "line_x"),
            ("__", "net"),
            ("_3d", "n_3d"),
            ("loop_", "loop_s"),
            ("a__next", "a_next"),
        ] {
            assert_eq!(legal(name), expected);
        }
    }
}
