//! Codes that say nothing about the path, and those that are refused.

use super::block::Code;

/// What a machine does with an M word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Understood.
    Known,
    /// Skipped with a warning, always.
    Skipped,
    /// Skipped with a warning, or refused by a strict reader. Whatever else is in the line belongs
    /// to it, where there is no G word.
    Harmless,
    /// Refused.
    Refused,
}

/// Spindle, coolant, stops and tool changes; clamps and steppers; switches and outputs (M62 to
/// M68); overrides (M48 to M53); heaters, fans, files, messages and settings of printers. Refused
/// are those that move, change offsets or scales, or whose meaning is not known.
pub(super) fn m_word((number, tenth): Code) -> Kind {
    match (number, tenth) {
        (2 | 30 | 70 | 72 | 98 | 99, 0) => Kind::Known,
        (0 | 1 | 3..=9, 0) => Kind::Skipped,
        (10 | 11 | 13 | 14 | 17..=29 | 31 | 36 | 42 | 48..=53 | 60..=69 | 71 | 73..=86, 0)
        | (92 | 101..=121 | 126..=129 | 132..=136 | 140..=150 | 155 | 163..=165, 0)
        | (190..=192 | 200..=205 | 207..=211 | 217 | 220 | 221 | 226 | 240, 0)
        | (250 | 251 | 256 | 260 | 261 | 280..=282 | 300..=306 | 350 | 351 | 355, 0)
        | (400..=420 | 486 | 500..=504 | 510..=512 | 524 | 540 | 552..=554, 0)
        | (555 | 556 | 569 | 572 | 573 | 575 | 591..=593 | 600..=603, 0)
        | (701 | 702 | 705 | 710 | 860..=871 | 876 | 900 | 906..=920, 0)
        | (960 | 970..=976 | 981..=984 | 991 | 997..=999, 0)
        | (862, 1..=6) => Kind::Harmless,
        _ => Kind::Refused,
    }
}

/// Why a G word is refused, where it is known.
pub(super) fn g_reason(code: Code) -> &'static str {
    match code {
        (7, 0) => "changes X to a diameter",
        (12..=13, 0) => "a pocket cycle of a control is not understood",
        (16, 0) => "changes X and Y to polar coordinates",
        (17..=19, 1) => "planes of U, V and W are not understood",
        (31, 0) => "a skip function is not understood",
        (33, _) => "depends on the spindle",
        (41..=42, _) => "cutter compensation changes the path",
        (50..=51, _) => "scaling or mirroring changes the path",
        (65..=67, 0) => "a macro call is not understood",
        (68, _) => "a rotation changes the path",
        (70..=72 | 74..=76, _) => "a turning or threading cycle is not understood",
        (87..=88, 0) => "a boring cycle with stops and shifts by hand",
        (95, 0) => "a feed per turn depends on the spindle",
        _ => "not supported",
    }
}
