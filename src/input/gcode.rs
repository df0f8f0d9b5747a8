//! G-code part programs of RS274/NGC, and of mills, printers and laser cutters that are close to it.
//!
//! # What moves
//!
//! G0, G1, arcs (G2, G3, full circles, helices, P turns; centres by I, J, K, relative or by G90.1,
//! or R) in the planes G17, G18 and G19, the splines G5 and G5.1, the NURBS G5.2 to G5.3 and G6.2,
//! probing (G38.2 to G38.5, which goes to its end as if nothing was touched), drilling (G73, G81 to
//! G86 and G89 with G98 and, in force at the start, G99, L or K times, along the axis across the
//! plane in force; G84 in G17 alone), and G28 and G30 by way of their axis words, or straight by
//! letters without a number. G80 with another motion in its line yields to it.
//! With [`Options::fourth`] W is an axis beside the three, in millimetres or inches, from the machine's
//! zero: with G0 to G3 and G38 it goes linearly with the length. No offset and no reference point is
//! of it.
//! Arcs in G18 and G19, NURBS, and without [`Options::splines`] splines, become chords within 0.001
//! mm, which a warning says.
//!
//! The position starts at the origin, in millimetres and absolute, without a motion in force. G20,
//! G21, G90, G91 and the planes act before the other words of their line, F included. G93 gives a
//! move the feed of its length times F. G0 carries no feed. A line to where the tool is gives no
//! move, and [`Drawing::zero_length`] counts it.
//!
//! The radii of an arc at its start and its end may differ as LinuxCNC allows: by 0.0283 mm (under
//! G20 by 0.0718 mm), or by 0.1 % of the larger one and 2.83 mm (7.18 mm). The
//! [`Move`](super::Move) keeps the centre as written, and the radius runs from that at the start to
//! that at the end. With R the arc is the minor one, with a negative R the major one; an R short of
//! half the chord by no more than 0.005 mm or 0.1 % of it gives a half circle.
//!
//! # Offsets
//!
//! Moves are in the machine's coordinates. The offsets of G54 to G59.3 are those of
//! [`Options::zeros`], zero by default, until G10 L2 or L20 sets them; G92, G92.1 to G92.3, G52 and
//! G53 act. The reference points of G28 and G30 are likewise the machine's zero until G28.1 or G30.1
//! sets them; axis words in their line move on from there. G43.1 is a tool length by X, Y and Z, and
//! G43, G44 and G43.2 are those that G10 L1 or L10 has set, or else zero: of tool H, or without H of
//! the tool that M6 or M61 has loaded. G49 ends them. M70 and M73 keep what is in force, M72 and the
//! end of the call bring it back.
//!
//! # Rotations and polar coordinates
//!
//! G10 L2 R rotates a coordinate system about its zero, as LinuxCNC does. G68 X Y R rotates the
//! program about X and Y, or without them about the tool, until G69, as Fanuc does. Under G68 there
//! are no offsets, no G28, no G53 and no other plane than that of X and Y, and the first move behind
//! G68 or G69 has both X and Y under G90: where one stays, controls differ.
//!
//! Under G16, until G15, X is a radius and Y an angle from the zero in force, as Fanuc has them, with
//! G0, G1, arcs by R and cycles, under G90. `@` and `^` are radius and angle as LinuxCNC has them:
//! under G91 they are steps, and what is not given stays.
//!
//! # Parameters and O-words
//!
//! `#1` to `#5602`, `#<name>` and `#<_name>`, in and out of expressions in brackets with all
//! operators and functions of RS274/NGC; they are set after their line was read. The position,
//! offsets and modes can be read (`#5420`, `#5220`, `#<_x>`, `#<_metric>` and others). `O100` or
//! `O<name>` with `sub`, `endsub`, `call`, `return`, `if`, `elseif`, `else`, `endif`, `while`,
//! `endwhile`, `do`, `repeat`, `endrepeat`, `break` and `continue`; M98 P and M99 with programs of
//! the file itself, L times; without L, P30002 is program 2 three times where there is no program
//! 30002. The label of a call may be computed, as in `O#1 call`. Calls nest 10 deep. [`Options::most_lines`] bounds a run.
//!
//! What is not in the program is looked for in [`Options::subroutines`], directory by directory:
//! `O<name> call` in `name.ngc`, which has `O<name> sub`; `O2 call` and M98 P2 in `2.ngc`, or in a file
//! called `o2` or `o0002`. Other endings of part programs and letters of either case do as well where
//! one file fits. A name has letters, digits, `_`, `-` and inside it `.`, so that none leads out of the
//! directories. A file may call those of the program that called it. Moves of a file have the line of
//! the call, warnings and faults that of the file.
//!
//! # Exponents
//!
//! In brackets, behind `=` and with E a number may have an exponent. In another word an E directly
//! behind the number, before a whole number, is an exponent if the line has one more E. Else it may
//! be an axis, as in the compact form of printers, and is refused if that gives another number.
//!
//! # What is skipped
//!
//! With one warning a kind: M0, M1, M3 to M9, S, T, O numbers, G4, G61 and G64. So are, unless
//! [`Options::strict`] refuses them: other M words whose meaning is known and that neither move nor
//! change offsets or scales (heaters, fans, displays, switches, settings of printers), with the
//! letters that belong to them; I without a number beside S or M3 to M5 (lasers); E, D, and H at 0; A, B, C, U, V and, where it is no axis, W at 0;
//! `$` lines that show or set; the `/` of optional lines, which are run; G61.1, P, Q and R of G64,
//! G96, G97, G43 and G44 of tools whose length the program has not set, G10 for tools but its L1 and
//! L10, G10 and G11 of printers, G29, G34.
//!
//! # What is refused
//!
//! All that would change the path otherwise: M words and `$` commands that move or stop a machine, read
//! or write other files or bring back positions on some controls; axis words and parameters that
//! may belong to either of two words of their line; other rotary positions, cutter compensation
//! (G41, G42), scaling, mirroring, rotation in space, diameters (G7), feeds per turn (G95), turning
//! and threading cycles, macro calls, unknown words.
//!
//! # Text
//!
//! Lines end in LF, CR, CR LF or CR CR LF. Blanks and NUL stand anywhere, in numbers too; a byte
//! order mark before and Ctrl-Z behind are passed over. Outside of comments, in parentheses or
//! behind a semicolon, the text is ASCII. A line may end in `*` and a checksum.

mod arc;
mod block;
mod branches;
mod calls;
mod chords;
mod codes;
mod cycle;
mod expression;
mod flow;
mod frame;
mod g_words;
mod kept;
mod library;
mod m_words;
mod machine;
mod mark;
mod modal;
mod motion;
mod nurbs;
mod offsets;
mod parameters;
mod polar;
mod problem;
mod runner;
mod text;
mod tools;

use super::{Drawing, Fault, Options};
use runner::Runner;

/// What chooses how to move, for faults.
const G_MOTIONS: &str = "G0 G1 G2 G3";

/// Reads a G-code program; `file` is the name that warnings and faults carry.
///
/// # Errors
///
/// After a fault the reader goes on with the next line, and does not tell of what may be a fault for
/// no other reason than that one before it.
///
/// What the [module](self) says is refused; a number that is none or is out of range; a feed of
/// zero or less; an arc whose ends and centre or radius do not fit; a coordinate beyond
/// [`super::REACH_MM`]; more lines than [`Options::most_lines`] allows; no move at all.
pub fn read(file: &str, text: &[u8]) -> Result<Drawing, Fault> {
    read_with(file, text, &Options::default())
}

/// Reads a G-code program as [`read`] does, as strictly as the options say.
///
/// # Errors
///
/// As [`read`], and with [`Options::strict`] what says nothing about the path.
pub fn read_with(file: &str, text: &[u8], options: &Options) -> Result<Drawing, Fault> {
    Runner::new(file, text::trimmed(text), options).run()
}
