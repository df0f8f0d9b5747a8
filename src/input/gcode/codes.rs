//! Codes without effect on the path, and codes that are refused.

use super::block::Code;

/// Handling of an M word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Supported.
    Known,
    /// Always skipped with a warning.
    Skipped,
    /// Skipped with a warning, or refused by a strict reader. Without a G word, all other words of
    /// the line belong to it.
    Harmless,
    /// Refused.
    Refused,
}

/// Skipped are spindle, coolant, stops and tool changes; clamps and steppers; switches and outputs
/// (M62 to M68); overrides (M48 to M53); heaters, fans, files, messages and settings of printers.
/// Refused are words that move, change offsets or scales, or have an unknown meaning.
pub(super) fn m_word((number, tenth): Code) -> Kind {
    match (number, tenth) {
        (2 | 30 | 70..=72 | 98 | 99, 0) => Kind::Known,
        (0 | 1 | 3..=9, 0) => Kind::Skipped,
        (10 | 11 | 13 | 14 | 17..=22 | 24 | 25 | 27 | 31 | 36 | 42 | 48..=53 | 60..=69, 0)
        | (73..=86 | 92 | 101..=111 | 113..=119 | 126..=129 | 133..=136 | 140..=150 | 155, 0)
        | (163..=165, 0)
        | (190..=192 | 200..=205 | 207..=211 | 217 | 220 | 221 | 226 | 240, 0)
        | (250 | 251 | 256 | 260 | 261 | 280..=282 | 300..=306 | 350 | 351 | 355, 0)
        | (400 | 401 | 403..=409 | 411..=420 | 486 | 500..=504 | 510..=512 | 540 | 552..=554, 0)
        | (555 | 569 | 572 | 573 | 575 | 591..=593 | 600..=603, 0)
        | (701 | 702 | 705 | 710 | 860..=871 | 876 | 900 | 906..=914, 0)
        | (919 | 920, 0)
        | (960 | 970..=976 | 981..=984 | 991 | 997..=999, 0)
        | (862, 1..=6) => Kind::Harmless,
        _ => Kind::Refused,
    }
}

/// Returns the reason why an M word is refused.
pub(super) fn m_reason(code: Code) -> &'static str {
    match code {
        (23 | 26, 0) => "runs another file, or another part of it",
        (28 | 29, 0) => "writes what follows to a file on some controls",
        (112 | 410 | 524, 0) => "stops the machine, or drops moves",
        (120 | 121, 0) => "keeps modes and brings them back on some controls",
        (132, 0) => "loads stored offsets on some controls",
        (402, 0) => "goes to a stored position on some controls",
        (556, 0) => "changes the angles between axes",
        (915..=918, 0) => "moves axes on some controls",
        _ => "not known to leave the path as it is",
    }
}

/// Returns the letters by which a skipped M word would change the path: M207 Z lifts while
/// filament is retracted, and M240 moves to take a picture.
pub(super) fn m_changes((number, _): Code) -> &'static [u8] {
    match number {
        207 => b"Z",
        240 => b"XYZ",
        _ => b"",
    }
}

/// Returns the letters of an M word that LinuxCNC has too; other letters of the line belong to
/// other words. Returns `None` for M words of printers, which own all letters of a line without a
/// G word.
pub(super) fn m_letters((number, _): Code) -> Option<&'static [u8]> {
    Some(match number {
        19 => b"RPQ",
        48..=53 | 62..=65 => b"P",
        60 => b"",
        61 => b"Q",
        66 => b"PLEQ",
        67 | 68 => b"EQ",
        73 => b"PQRSCD",
        _ => return None,
    })
}

/// True if X, Y and Z may belong to an M word of a printer: steppers, switches, steps and speeds
/// of axes, heights.
pub(super) fn m_has_axes((number, _): Code) -> bool {
    matches!(
        number,
        17 | 18 | 82..=86 | 92 | 114 | 119 | 201..=211 | 217 | 240 | 350 | 351 | 420 | 569
    ) || matches!(number, 593 | 600..=603 | 701 | 702 | 860..=869 | 906..=920)
}

/// Returns the letters, besides axes, by which a G word changes the path.
pub(super) fn g_letters(code: Code) -> &'static [u8] {
    match code {
        (2 | 3, 0) => b"PR",
        (5, 0) => b"PQ",
        (5, 2 | 3) => b"PLQ",
        (6, 2) => b"PRKQ",
        (10, 0) => b"LPR",
        (68, 0) => b"R",
        (73 | 83, 0) => b"QRLK",
        (81..=89, 0) => b"RLK",
        _ => b"",
    }
}

/// Returns the reason why a G word is refused.
pub(super) fn g_reason(code: Code) -> &'static str {
    match code {
        (7, 0) => "changes X to a diameter",
        (12..=13, 0) => "a pocket cycle of a control is not understood",
        (17..=19, 1) => "planes of U, V and W are not understood",
        (31, 0) => "a skip function is not understood",
        (33, _) => "depends on the spindle",
        (41..=42, _) => "cutter compensation changes the path",
        (50..=51, _) => "scaling or mirroring changes the path",
        (65..=67, 0) => "a macro call is not understood",
        (68, _) => "a rotation in space is not understood",
        (70..=72 | 74..=76, _) => "a turning or threading cycle is not understood",
        (87..=88, 0) => "a boring cycle with stops and shifts by hand",
        (95, 0) => "a feed per turn depends on the spindle",
        _ => "not supported",
    }
}
