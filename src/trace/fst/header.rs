//! Header of the file, scopes and names, widths.

use super::varint::unsigned;
use crate::netlist::{Format, Role};
use crate::trace::Clock;
use crate::trace::layout::{CLK, Layout, Scope, companion};

/// Block kinds.
const HEADER: u8 = 0;
const GEOMETRY: u8 = 3;
const HIERARCHY_LZ4: u8 = 6;

/// Entry kinds in the hierarchy.
const ATTRIBUTE: u8 = 252;
const SCOPE: u8 = 254;
const UP: u8 = 255;
const MODULE: u8 = 0;
const REG: u8 = 5;
const WIRE: u8 = 16;
const STRING: u8 = 21;

/// Attribute that names the values of a variable.
const MISC: u8 = 0;
const ENUM_TABLE: u8 = 7;

/// Directions of a variable.
const NO_DIRECTION: u8 = 0;
const INPUT: u8 = 1;
const OUTPUT: u8 = 2;

/// Width of strings in the geometry; their values carry a length.
const VARIABLE: u64 = u32::MAX as u64;

/// Variable, in declaration order.
#[derive(Debug, Clone, Copy)]
pub enum Variable {
    /// Clock, which is in no walk.
    Clk,
    /// Leaf.
    Bits { leaf: usize, width: usize },
    /// State names of a leaf.
    Names {
        leaf: usize,
        names: &'static [&'static str],
    },
}

/// Numbers that become known while the file is written.
#[derive(Debug, Default, Clone, Copy)]
pub struct Counts {
    pub start: u64,
    pub end: u64,
    pub scopes: u64,
    pub variables: u64,
    pub sections: u64,
}

/// Returns the header.
pub fn header(clock: Clock, counts: Counts) -> Vec<u8> {
    let Counts {
        start,
        end,
        scopes,
        variables,
        sections,
    } = counts;
    let mut out = vec![HEADER];
    for number in [329, start, end] {
        out.extend(number.to_be_bytes());
    }
    // Readers detect the byte order of real numbers by this number.
    out.extend(std::f64::consts::E.to_le_bytes());
    let memory = 0;
    for number in [memory, scopes, variables, variables, sections] {
        out.extend(number.to_be_bytes());
    }
    out.push(clock.exponent() as u8);
    let version = concat!("motion-rtl ", env!("CARGO_PKG_VERSION"));
    let date = "";
    for (text, length) in [(version, 128), (date, 119)] {
        out.extend(text.bytes().chain(std::iter::repeat(0)).take(length));
    }
    let verilog = 0;
    out.push(verilog);
    let time_of_zero: u64 = 0;
    out.extend(time_of_zero.to_be_bytes());
    out
}

/// Writes scopes, names and widths; returns the variables and the number of scopes.
pub fn declarations(out: &mut Vec<u8>, layout: &Layout) -> (Vec<Variable>, u64) {
    let mut hierarchy = Hierarchy::default();
    hierarchy.scope(&layout.top, layout, true);
    let Hierarchy {
        text,
        widths,
        variables,
        scopes,
        ..
    } = hierarchy;

    let packed = lz4_flex::block::compress(&text);
    block(out, HIERARCHY_LZ4, text.len(), &[], &packed);
    let count = (variables.len() as u64).to_be_bytes();
    block(out, GEOMETRY, widths.len(), &count, &widths);
    (variables, scopes)
}

/// Writes a block: kind, length, unpacked length of its contents, contents.
fn block(out: &mut Vec<u8>, kind: u8, unpacked: usize, count: &[u8], contents: &[u8]) {
    let length = 16 + count.len() + contents.len();
    out.push(kind);
    out.extend((length as u64).to_be_bytes());
    out.extend((unpacked as u64).to_be_bytes());
    out.extend(count);
    out.extend(contents);
}

#[derive(Default)]
struct Hierarchy {
    text: Vec<u8>,
    widths: Vec<u8>,
    variables: Vec<Variable>,
    scopes: u64,
    /// Lists of states so far, with the width of their codes.
    states: Vec<(&'static [&'static str], usize)>,
}

impl Hierarchy {
    fn scope(&mut self, scope: &Scope, layout: &Layout, outermost: bool) {
        self.scopes += 1;
        self.text.extend([SCOPE, MODULE]);
        self.text.extend(scope.name.bytes());
        // End of the name, and an empty component name.
        self.text.extend([0, 0]);
        if outermost {
            self.variable([WIRE, NO_DIRECTION], CLK, Variable::Clk);
        }
        for &index in &scope.leaves {
            let leaf = &layout.leaves[index];
            let kind = match leaf.role {
                Role::Register => REG,
                Role::Input | Role::Net => WIRE,
            };
            let direction = match leaf.role {
                Role::Input => INPUT,
                _ if layout.ports_out.binary_search(&index).is_ok() => OUTPUT,
                _ => NO_DIRECTION,
            };
            let width = leaf.shape.width;
            let bits = Variable::Bits { leaf: index, width };
            let name = match width {
                1 => leaf.name.clone(),
                _ => format!("{} [{}:0]", leaf.name, width - 1),
            };
            if let Format::States(names) = leaf.field.format {
                self.states(&leaf.name, names, width);
            }
            self.variable([kind, direction], &name, bits);
            if let (Format::States(names), Some(name)) = (leaf.field.format, companion(leaf)) {
                let names = Variable::Names { leaf: index, names };
                self.variable([STRING, NO_DIRECTION], &name, names);
            }
        }
        for inner in &scope.scopes {
            self.scope(inner, layout, false);
        }
        self.text.push(UP);
    }

    /// Names the values of the next variable. A list of states is written once, called `name`, and
    /// has a number, which counts from 1.
    fn states(&mut self, name: &str, names: &'static [&'static str], width: usize) {
        let known = self.states.iter().position(|list| *list == (names, width));
        let number = known.unwrap_or(self.states.len()) as u64 + 1;
        if known.is_none() {
            self.states.push((names, width));
            // A state beyond the width has no code.
            let coded: Vec<_> = (0..1u128 << width).zip(names).collect();
            let mut table = format!("{name} {}", coded.len());
            for (_, state) in &coded {
                table.push(' ');
                table.extend(state.chars().flat_map(escaped));
            }
            for (code, _) in &coded {
                table += &format!(" {code:0width$b}");
            }
            self.attribute(&table, number);
        }
        self.attribute("", number);
    }

    fn attribute(&mut self, table: &str, number: u64) {
        self.text.extend([ATTRIBUTE, MISC, ENUM_TABLE]);
        self.text.extend(table.bytes());
        self.text.push(0);
        unsigned(&mut self.text, number);
    }

    fn variable(&mut self, kind_and_direction: [u8; 2], name: &str, variable: Variable) {
        self.text.extend(kind_and_direction);
        self.text.extend(name.bytes());
        self.text.push(0);
        let width = variable.width();
        unsigned(&mut self.text, width as u64);
        let no_alias = 0;
        unsigned(&mut self.text, no_alias);
        let geometry = if width == 0 { VARIABLE } else { width as u64 };
        unsigned(&mut self.widths, geometry);
        self.variables.push(variable);
    }
}

/// Returns a character of a table, after a backslash if C has an escape for it.
fn escaped(char: char) -> impl Iterator<Item = char> {
    let escape = matches!(char, '\\' | '\'' | '"' | '?').then_some('\\');
    escape.into_iter().chain([char])
}

impl Variable {
    /// Returns the number of characters in a frame.
    pub fn width(self) -> usize {
        match self {
            Variable::Clk => 1,
            Variable::Bits { width, .. } => width,
            Variable::Names { .. } => 0,
        }
    }
}
