//! Reader of G-code part programs: RS274/NGC, and similar dialects of mills, printers and laser
//! cutters.
//!
//! # Supported moves
//!
//! G0, G1, arcs (G2, G3, full circles, helices, P turns; centres by I, J, K, relative or by G90.1,
//! or R) in the planes G17, G18 and G19, the splines G5 and G5.1, the NURBS G5.2 to G5.3 and G6.2,
//! probing (G38.2 to G38.5, which runs to its end as if nothing was touched), drilling (G73, G81
//! to G86 and G89 with G98 and G99, the default, L or K times, along the axis across the current
//! plane; G84 in G17 alone), and G28 and G30 through the point of their axis words, or straight by
//! letters without a number. G80 with another motion in its line has no effect.
//! With [`Options::fourth`] W is an axis beside the three, in millimetres or inches, from the
//! machine's zero: with G0 to G3 and G38 it moves linearly with the length. Offsets and reference
//! points do not apply to it.
//! Arcs in G18 and G19, NURBS, and splines without [`Options::splines`] become chords within 0.001
//! mm, with a warning.
//!
//! The program starts at the origin, in millimetres and absolute, without a current motion. G20,
//! G21, G90, G91 and the planes act before the other words of their line, F included. G93 gives a
//! move the feed of its length times F. G0 carries no feed. A line to the current position gives
//! no move, and [`Drawing::zero_length`] counts it.
//!
//! The radii of an arc at its start and its end may differ as in LinuxCNC: by 0.0283 mm (under G20
//! by 0.0718 mm), or by 0.1 % of the larger one, at most 2.83 mm (7.18 mm). The
//! [`Move`](super::Move) keeps the centre as written, and the radius changes from the one at the
//! start to the one at the end. With R the arc is the minor one, with a negative R the major one;
//! an R that is less than half the chord by at most 0.005 mm or 0.1 % gives a half circle.
//!
//! # Offsets
//!
//! Moves are in machine coordinates. The offsets of G54 to G59.3 are those of [`Options::zeros`],
//! zero by default, until G10 L2 or L20 sets them; G92, G92.1 to G92.3, G52 and G53 are supported.
//! The reference points of G28 and G30 are likewise the machine's zero until G28.1 or G30.1 sets
//! them; motion words in their line start from there. G43.1 is a tool length by X, Y and Z. G43,
//! G44 and G43.2 take lengths that G10 L1 or L10 has set, zero by default: of tool H, or without H
//! of the tool that M6 or M61 has loaded. G49 ends them. M70 and M73 save the modal state; M72 and
//! the end of the call restore it.
//!
//! # Rotations and polar coordinates
//!
//! G10 L2 R rotates a coordinate system about its zero, as in LinuxCNC. G68 X Y R rotates the
//! program about X and Y, or without them about the tool, until G69, as in Fanuc controls. Under
//! G68 offsets, G28, G53 and planes other than X-Y are refused, and the first move after G68 or
//! G69 must have both X and Y under G90: controls differ if one is missing.
//!
//! Under G16, until G15, X is a radius and Y an angle from the current zero, as in Fanuc controls,
//! with G0, G1, arcs by R and cycles, under G90. `@` and `^` are radius and angle as in LinuxCNC:
//! under G91 they are increments, and a missing one is unchanged.
//!
//! # Parameters and O-words
//!
//! `#1` to `#5602`, `#<name>` and `#<_name>`, inside and outside of expressions in brackets with
//! all operators and functions of RS274/NGC; they are set after their line was read. The position,
//! offsets and modes can be read (`#5420`, `#5220`, `#<_x>`, `#<_metric>` and others). `O100` or
//! `O<name>` with `sub`, `endsub`, `call`, `return`, `if`, `elseif`, `else`, `endif`, `while`,
//! `endwhile`, `do`, `repeat`, `endrepeat`, `break` and `continue`; M98 P and M99 with programs of
//! the same file, L times; without L, P30002 is program 2 three times if there is no program
//! 30002. The label of a call may be computed, as in `O#1 call`. Calls nest up to 10 deep.
//! [`Options::most_lines`] bounds a run.
//!
//! Subroutines that are not in the program are searched in [`Options::subroutines`], directory by
//! directory: `O<name> call` in `name.ngc`, which has `O<name> sub`; `O2 call` and M98 P2 in
//! `2.ngc`, or in a file named `o2` or `o0002`. Other extensions of part programs and either case
//! are accepted if only one file matches. A name has letters, digits, `_`, `-` and inside it `.`,
//! so that it cannot leave the directories. A file may call subroutines of the program that called
//! it. Moves of a file have the line of the call; warnings and faults have the line in the file.
//!
//! # Exponents
//!
//! In brackets, after `=` and with E a number may have an exponent. In another word an E directly
//! after the number, before a whole number, is an exponent if the line has one more E. Otherwise
//! it may be an axis, as in the compact form of printers, and is refused if the two readings give
//! different numbers.
//!
//! # Skipped words
//!
//! With one warning per kind: M0, M1, M3 to M9, S, T, O numbers, G4, G61 and G64. The following
//! are skipped too, unless [`Options::strict`] refuses them: other M words whose meaning is known
//! and that neither move nor change offsets or scales (heaters, fans, displays, switches, settings
//! of printers), with the letters that belong to them; I without a number beside S or M3 to M5
//! (lasers); E, D, and H at 0; A, B, C, U, V and, if it is not an axis, W at 0; `$` lines that
//! show or set; the `/` of optional lines, which are executed; G61.1, P, Q and R of G64, G96, G97,
//! G43 and G44 of tools whose length the program has not set, G10 for tools except L1 and L10, G10
//! and G11 of printers, G29, G34.
//!
//! # Refused words
//!
//! Everything else that would change the path: M words and `$` commands that move or stop a
//! machine, access other files, or restore positions on some controls; axis words and parameters
//! that may belong to either of two words of their line; other rotary positions, cutter
//! compensation (G41, G42), scaling, mirroring, rotation in space, diameters (G7), feeds per turn
//! (G95), turning and threading cycles, macro calls, unknown words.
//!
//! # Text
//!
//! Lines end in LF, CR, CR LF or CR CR LF. Blanks and NUL may be anywhere, in numbers too; a byte
//! order mark before and Ctrl-Z after the text are ignored. Outside of comments, in parentheses or
//! after a semicolon, the text is ASCII. A line may end in `*` and a checksum.

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

/// Motions to choose from, for messages.
const G_MOTIONS: &str = "G0 G1 G2 G3";

/// Reads a G-code program; warnings and faults name the file `file`.
///
/// # Errors
///
/// After a fault the reader continues with the next line. It does not report faults that may only
/// be consequences of an earlier one.
///
/// Returns an error for words that the [module](self) refuses; an invalid number or one out of
/// range; a feed of zero or less; an arc whose ends do not fit its centre or radius; a coordinate
/// beyond [`super::REACH_MM`]; more lines than [`Options::most_lines`] allows; no move at all.
pub fn read(file: &str, text: &[u8]) -> Result<Drawing, Fault> {
    read_with(file, text, &Options::default())
}

/// Reads a G-code program as [`read`] does, with options.
///
/// # Errors
///
/// Returns the errors of [`read`] and, with [`Options::strict`], an error for words without effect
/// on the path.
pub fn read_with(file: &str, text: &[u8], options: &Options) -> Result<Drawing, Fault> {
    Runner::new(file, text::trimmed(text), options).run()
}
