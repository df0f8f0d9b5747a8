//! GTKWave save files: the selection, order and display of a dump's signals.

use super::layout::{CLK, Layout, Scope, companion, is_stage, is_word};
use super::{Clock, LayoutError, Options};
use crate::hdl::Declaration;
use crate::netlist::{Format, Kind, Role};
use crate::sim::Described;
use std::fmt::Write;
use std::ops::Range;

// Flags of a trace, numbered as in GTKWave's analyzer.h.
const HEX: u32 = 1 << 1;
const DECIMAL: u32 = 1 << 2;
const BINARY: u32 = 1 << 3;
const RIGHT: u32 = 1 << 5;
const BLANK: u32 = 1 << 9;
const SIGNED: u32 = 1 << 10;
const ASCII: u32 = 1 << 11;
const COLLAPSED: u32 = 1 << 12;
const ANALOG_STEP: u32 = 1 << 15;
const ANALOG_ROW: u32 = 1 << 17;
const CLOSED: u32 = 1 << 22;
const GROUP_BEGIN: u32 = 1 << 23;
const GROUP_END: u32 = 1 << 24;
const FIXED_POINT: u32 = 1 << 30;

// Colours of a trace, numbered as in GTKWave's color.h.
const RED: u32 = 1;
const ORANGE: u32 = 2;
const YELLOW: u32 = 3;
const GREEN: u32 = 4;
const VIOLET: u32 = 7;

/// Words in the names of bits that report an error.
const ERRORS: [&str; 7] = [
    "error", "fault", "late", "lost", "missed", "overrun", "refused",
];
/// Greatest number of fraction bits that GTKWave shows.
const FRACTION: usize = 62;

/// Greatest number of signals in a group that is open at first.
const OPEN: usize = 16;
/// Greatest number of words of a memory that is listed, and of stages of a shift register.
const WORDS: usize = 64;
const STAGES: usize = 256;
/// Number of rows that an analog trace takes below its own.
const ANALOG_ROWS: usize = 3;
/// Window, and the tree in it, in pixels.
const WINDOW: (usize, usize) = (1600, 900);
const TREE: usize = 220;
/// Width of a character in the names and values, and least and greatest width of their column, in
/// pixels.
const CHARACTER: usize = 9;
const COLUMN: (usize, usize) = (180, 520);
/// Pixels that GTKWave calls a frame; its zoom is the binary logarithm of the time in a frame.
const FRAME: f64 = 200.0;

/// Returns the save file of a circuit's dump named `dump`: `<stem>.gtkw` beside `<stem>.vcd` or
/// `<stem>.fst`.
///
/// Input ports and `clk` come first, then output ports, then a group for the rest of the circuit,
/// and one for every scope in it. Each role has its colour; a state is shown by name, and a word
/// with fraction bits as a decimal fraction. Large groups and those below the first level are
/// closed. Curves are scaled to the ticks in the window, which are those of `focus`. Memories of
/// more than 64 words and shift registers of more than 256 stages are not listed. The two files may
/// be moved together.
///
/// # Errors
/// Returns the errors of [`Vcd::new`](super::Vcd::new).
pub fn save_file(
    circuit: &impl Described,
    clock: Clock,
    options: &Options,
    dump: &str,
    focus: Range<u64>,
) -> Result<String, LayoutError> {
    save_file_with(circuit, clock, options, dump, focus, &[])
}

/// Returns a save file as [`save_file`] does, with an overview on top, which ends with `clk`:
/// signals by their paths within the circuit. Paths that are not in the dump are left out.
///
/// # Errors
/// Returns the errors of [`Vcd::new`](super::Vcd::new).
pub fn save_file_with(
    circuit: &impl Described,
    clock: Clock,
    options: &Options,
    dump: &str,
    focus: Range<u64>,
    overview: &[&str],
) -> Result<String, LayoutError> {
    let layout = Layout::of(circuit, options.only.as_deref())?;
    Ok(save(&layout, clock, dump, focus, overview))
}

/// Returns the save file of a layout.
pub(super) fn save(
    layout: &Layout,
    clock: Clock,
    dump: &str,
    focus: Range<u64>,
    overview: &[&str],
) -> String {
    let mut save = Save {
        text: String::new(),
        layout,
        flags: None,
    };
    let overview: Vec<_> = overview.iter().filter_map(|path| save.at(path)).collect();
    save.window(clock, dump, focus, &overview);
    save.top(&overview);
    save.text
}

struct Save<'a> {
    text: String,
    layout: &'a Layout,
    /// Current flags: a save file lists them only when they change.
    flags: Option<u32>,
}

impl Save<'_> {
    fn line(&mut self, line: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{line}");
    }

    /// Returns the index of a signal that is in the dump.
    fn at(&self, path: &str) -> Option<usize> {
        let mut leaves = self.layout.leaves.iter().zip(&self.layout.selected);
        leaves.position(|(leaf, selected)| {
            *selected && path.ends_with(&leaf.name) && within(leaf, ".") == path
        })
    }

    fn window(&mut self, clock: Clock, dump: &str, focus: Range<u64>, overview: &[usize]) {
        // GTKWave counts time in whole s, ms, … fs: a unit of 10 ns is ten of them.
        let scale = u64::from(clock.timescale().0);
        let from = clock.rise(focus.start).and_then(|t| t.checked_mul(scale));
        let from = from.unwrap_or(0);
        let ticks = focus.end.saturating_sub(focus.start).max(1);
        let shown = (clock.period() * scale) as f64 * ticks as f64;
        let names = self.column(overview);
        // Scroll bars and borders take half a frame.
        let pane = (WINDOW.0 - TREE - names) as f64 - FRAME / 2.0;
        let zoom = -(shown * FRAME / pane).max(1.0).log2();
        self.line(format_args!("[*] {}", self.layout.top.name));
        // GTKWave looks for the dump beside the save file if both are named without a directory.
        self.line(format_args!("[dumpfile] \"{dump}\""));
        let stem = dump.rsplit_once('.').map_or(dump, |(stem, _)| stem);
        self.line(format_args!("[savefile] \"{stem}.gtkw\""));
        self.line(format_args!("[timestart] {from}"));
        self.line(format_args!("[size] {} {}", WINDOW.0, WINDOW.1));
        self.line(format_args!("[pos] -1 -1"));
        self.line(format_args!("*{zoom:.6} -1{}", " -1".repeat(26)));
        self.line(format_args!("[treeopen] {}.", self.layout.top.name));
        self.line(format_args!("[sst_width] {TREE}"));
        self.line(format_args!("[signals_width] {names}"));
        self.line(format_args!("[sst_expanded] 1"));
        self.line(format_args!("[sst_vpaned_height] 300"));
    }

    /// Returns the width in pixels for the longest name and, right of it, the longest value.
    fn column(&self, overview: &[usize]) -> usize {
        let (mut names, mut values) = ("ports out".len(), 0);
        for &index in overview {
            let shown = within(&self.layout.leaves[index], "/");
            names = names.max(shown.len() + "[63:0]".len());
        }
        for (leaf, selected) in self.layout.leaves.iter().zip(&self.layout.selected) {
            if *selected {
                let digits = match leaf.field.format {
                    Format::States(states) => {
                        states.iter().map(|state| state.len()).max().unwrap_or(0)
                    }
                    Format::Hex => leaf.shape.width.div_ceil(4),
                    // A decimal digit takes about 3.3 bits; there may be a sign.
                    _ => leaf.shape.width * 3 / 10 + 2,
                };
                names = names.max(leaf.name.len() + "[63:0]".len());
                values = values.max(digits);
            }
        }
        let characters = names + " = ".len() + values;
        (characters * CHARACTER).clamp(COLUMN.0, COLUMN.1)
    }

    fn top(&mut self, overview: &[usize]) {
        let layout = self.layout;
        let top = &layout.top;
        let has_overview = !overview.is_empty();
        if has_overview {
            self.comment("overview");
            for &index in overview {
                self.leaf(&layout.leaves[index], true);
            }
            self.clk();
        }
        let leaves = |wanted: fn(&Declaration) -> bool| -> Vec<usize> {
            let own = top.leaves.iter().copied();
            own.filter(|&index| wanted(&layout.leaves[index])).collect()
        };
        let ports_in = leaves(|leaf| leaf.role == Role::Input);
        let ports_out = leaves(|leaf| leaf.role != Role::Input && leaf.field.public);
        let inside = leaves(|leaf| leaf.role != Role::Input && !leaf.field.public);
        for (title, leaves, clk) in [
            ("ports in", ports_in, !has_overview),
            ("ports out", ports_out, false),
        ] {
            if leaves.is_empty() && !clk {
                continue;
            }
            self.gap();
            if leaves.len() > OPEN {
                self.group(title, true, |save| save.leaves(&leaves));
            } else {
                self.comment(title);
                self.leaves(&leaves);
            }
            // Below a group that is closed, it stays visible.
            if clk {
                self.clk();
            }
        }
        if !inside.is_empty() {
            self.gap();
            self.group("inside", inside.len() > OPEN, |save| save.leaves(&inside));
        }
        for scope in &top.scopes {
            self.gap();
            self.scope(scope, 1);
        }
    }

    fn scope(&mut self, scope: &Scope, depth: usize) {
        let layout = self.layout;
        let of_memory = |index: &&usize| is_word(&layout.leaves[**index]);
        let words = scope.leaves.iter().filter(of_memory).count();
        let stages = |&index: &usize| is_stage(&layout.leaves[index]);
        let most = match scope.leaves.iter().any(stages) {
            true => STAGES,
            false => WORDS,
        };
        if words > most {
            self.comment(&format!("{}: {words} words", scope.name));
        }
        let listed: Vec<usize> = scope
            .leaves
            .iter()
            .copied()
            .filter(|&index| words <= most || !is_word(&layout.leaves[index]))
            .collect();
        if listed.is_empty() && scope.scopes.is_empty() {
            return;
        }
        let closed = depth > 1 || words > 0 || listed.len() > OPEN;
        self.group(&scope.name, closed, |save| {
            save.leaves(&listed);
            for inner in &scope.scopes {
                save.scope(inner, depth + 1);
            }
        });
    }

    fn group(&mut self, title: &str, closed: bool, fill: impl FnOnce(&mut Self)) {
        let (begin, end) = if closed {
            (CLOSED, CLOSED | COLLAPSED)
        } else {
            (0, 0)
        };
        self.row(GROUP_BEGIN | BLANK | begin, format_args!("-{title}"));
        fill(self);
        self.row(GROUP_END | BLANK | end, format_args!("-{title}"));
    }

    fn leaves(&mut self, leaves: &[usize]) {
        let layout = self.layout;
        for &index in leaves {
            self.leaf(&layout.leaves[index], false);
        }
    }

    fn clk(&mut self) {
        let top = &self.layout.top.name;
        self.row(BINARY | RIGHT, format_args!("{top}.{CLK}"));
    }

    /// Adds a signal; with `whole` by its path within the circuit instead of its name.
    fn leaf(&mut self, leaf: &Declaration, whole: bool) {
        // GTKWave shows the text after the last dot of a path, or of an alias before it.
        let alias = |rest: &str| match whole && leaf.scopes.len() > 1 {
            true => format!("+{{{}{rest}}} ", within(leaf, "/")),
            false => String::new(),
        };
        if let Some(name) = companion(leaf) {
            let (shown, scope) = (alias("_name"), leaf.scopes.join("."));
            self.signal(leaf, ASCII | RIGHT, format_args!("{shown}{scope}.{name}"));
            return;
        }
        let flags = flags(leaf);
        let range = match leaf.shape.width {
            1 => String::new(),
            width => format!("[{}:0]", width - 1),
        };
        let shown = alias(&range);
        self.signal(leaf, flags, format_args!("{shown}{}{range}", leaf.path()));
        if flags & ANALOG_STEP != 0 {
            for _ in 0..ANALOG_ROWS {
                self.row(ANALOG_ROW, format_args!("-"));
            }
        }
    }

    fn comment(&mut self, text: &str) {
        self.row(BLANK, format_args!("-{text}"));
    }

    /// Adds an empty row between two groups.
    fn gap(&mut self) {
        if self.flags.is_some() {
            self.comment("");
        }
    }

    /// Adds a row in the colour of a signal's role, with its fraction bits.
    fn signal(&mut self, leaf: &Declaration, flags: u32, line: std::fmt::Arguments<'_>) {
        self.display(flags);
        // GTKWave takes a colour for a single row.
        self.line(format_args!("[color] {}", color(leaf)));
        if flags & FIXED_POINT != 0 {
            self.line(format_args!("[fpshift_count] {}", leaf.fraction));
        }
        self.line(line);
    }

    fn row(&mut self, flags: u32, line: std::fmt::Arguments<'_>) {
        self.display(flags);
        self.line(line);
    }

    /// Sets the flags of the rows to come.
    fn display(&mut self, flags: u32) {
        if self.flags != Some(flags) {
            self.flags = Some(flags);
            self.line(format_args!("@{flags:x}"));
        }
    }
}

/// Returns the path of a signal within the circuit.
fn within(leaf: &Declaration, joint: &str) -> String {
    let scopes = leaf.scopes.iter().skip(1).map(String::as_str);
    let path: Vec<_> = scopes.chain([leaf.name.as_str()]).collect();
    path.join(joint)
}

fn color(leaf: &Declaration) -> u32 {
    let is_error = |word| ERRORS.contains(&word);
    match leaf.role {
        _ if leaf.shape.kind == Kind::Bit && leaf.name.split('_').any(is_error) => RED,
        Role::Input => YELLOW,
        _ if leaf.field.public => GREEN,
        Role::Register => ORANGE,
        Role::Net => VIOLET,
    }
}

fn flags(leaf: &Declaration) -> u32 {
    let number = match leaf.shape.kind {
        Kind::Bit => return BINARY | RIGHT,
        Kind::Unsigned => DECIMAL | RIGHT,
        Kind::Signed => SIGNED | RIGHT,
    };
    let number = match leaf.fraction {
        1..=FRACTION => number | FIXED_POINT,
        _ => number,
    };
    match leaf.field.format {
        Format::Hex => HEX | RIGHT,
        Format::Analog => number | ANALOG_STEP,
        Format::Decimal | Format::States(_) | Format::Elements(_) => number,
    }
}
