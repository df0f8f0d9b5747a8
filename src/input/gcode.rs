//! G-code part programs.
//!
//! Understood are G0, G1, G2 and G3 in the X-Y plane (G17) with Z, helical arcs included; G20,
//! G21, G90, G91, G80, F, N, `%`, M2 and M30, comments in parentheses and after a semicolon.
//! G40, G49, G91.1 and G94 state what is so anyway. G4, G54, G61, G64, the M words up to M9, O, S
//! and T are skipped with one warning each. Everything else is a fault, since it would change the
//! path: other planes, offsets, compensation, canned cycles, parameters, optional lines.
//!
//! The position starts at the origin, in millimetres and absolute, without a motion in force.
//! G20, G21, G90 and G91 act before the other words of their line, F included.
//!
//! The centre of an arc is at I and J from its start. The end may be off the circle by 0.005 mm
//! or 0.1 % of the radius at the start, whichever is more: the [`Move`](super::Move) then keeps
//! the centre as written, and the radius runs from that at the start to that at the end. With R
//! the arc is the minor one, with a negative R the major one; an R short of half the chord by no
//! more than the same tolerance gives a half circle.
//!
//! G0 carries no feed. A line to where the tool is gives no move, and
//! [`Drawing::zero_length`] counts it; an arc to where it starts is a full circle.

mod arc;
mod block;
mod machine;
mod screen;

use super::{Drawing, Fault};
use machine::Machine;

/// Reads a G-code program; `file` is the name that warnings and faults carry.
///
/// Outside of comments the text must be UTF-8.
///
/// # Errors
///
/// A word, or words in one line, outside of what the [module](self) lists; a number that is
/// none or is out of range; a feed of zero or less; an arc whose ends and centre or radius do not
/// fit; a coordinate beyond [`super::REACH_MM`]; no move at all.
pub fn read(file: &str, text: &[u8]) -> Result<Drawing, Fault> {
    // Editors put a byte order mark before the first line.
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let mut machine = Machine::new(file);
    let mut lines = (1..).zip(text.split(|&byte| byte == b'\n'));
    for (line, text) in lines.by_ref() {
        machine.run(line, text)?;
        if machine.ended() {
            break;
        }
    }
    let written =
        |text: &[u8]| !matches!(text.trim_ascii().first(), None | Some(b'%' | b';' | b'('));
    if let Some((line, _)) = lines.find(|(_, text)| written(text)) {
        machine.note_rest(line);
    }
    machine.finish()
}
