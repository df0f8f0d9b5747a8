//! Scripts for Yosys.

use std::fmt::Write as _;
use std::path::Path;

/// The sides of a proof: the circuit and the design.
pub const SIDES: [&str; 2] = ["golden", "design"];

/// Ticks that induction assumes at most: a proof over paired registers needs one, more help where
/// registers have no partner.
pub const INDUCTION: [u32; 2] = [1, 4];

/// Ticks of the search for a difference, which its time limit ends before.
const SEARCH: usize = 100_000;

/// Makes one module of a side.
const FLAT: &str = "proc\nflatten\ncheck\n";

/// Leaves only word-level cells and flip-flops.
const CELLS: &str = "\
memory_collect
memory_map
opt_expr
async2sync
dffunmap
";

/// Names of the files of an equivalence check.
#[derive(Debug, Clone, Copy)]
pub struct Names<'a> {
    /// Stem of all of them: the name of the circuit.
    pub stem: &'a str,
}

impl Names<'_> {
    /// Returns the name of a file of one side, `golden` or `design`.
    pub fn side(self, side: &str, extension: &str) -> String {
        format!("{}.{side}.{extension}", self.stem)
    }

    /// Returns the end of a script for a side.
    fn written(self, side: &str) -> String {
        format!(
            "write_json {}\nwrite_rtlil {}\n",
            self.side(side, "json"),
            self.side(side, "il")
        )
    }

    /// Returns the script that makes a module of one side, `golden` or `design`, after the commands
    /// that read it.
    pub fn flat(self, side: &str, read: &str) -> String {
        made(side, read) + &self.written(side)
    }

    /// Returns the commands that join both sides in the miter.
    fn joined(self, exposed: &str) -> String {
        format!(
            "{exposed}read_verilog -formal {}.miter.v\nhierarchy -check -top miter\nproc\nflatten\n",
            self.stem
        )
    }

    /// Returns the proof as a task of SymbiYosys, after the commands that read both sides. It copies
    /// the circuit's `files`, and reads the design where it is.
    pub fn sby(self, [golden, design]: &[String; 2], files: &[String], exposed: &str) -> String {
        let files: String = files.iter().map(|file| format!("{file}\n")).collect();
        format!(
            "[options]\nmode prove\ndepth {}\n\n[engines]\nsmtbmc\n\n[script]\n{}design -stash \
             golden\n{}design -stash design\ndesign -copy-from golden golden\ndesign -copy-from design \
             design\n{}\n[files]\n{files}{}.miter.v\n",
            INDUCTION[1] + 1,
            made("golden", golden),
            made("design", design),
            self.joined(exposed),
            self.stem
        )
    }

    /// Returns the script that simulates the design with random inputs.
    pub fn random(self, ticks: u64) -> String {
        let (design, stem) = (self.side("design", "il"), self.stem);
        // What may have any value is low.
        format!(
            "read_rtlil {design}\ndelete t:$anyseq\nsetundef -undriven -zero\nread_verilog \
             {stem}.random.v\nhierarchy -check -top miter\nproc\nflatten\nmemory_collect\nsim -q -clock \
             clk -n {ticks} -zinit -vcd {stem}.trace.vcd miter\n"
        )
    }

    /// Returns the script that proves invariants of the circuit alone, or breaks one.
    pub fn invariants(self, exposed: &str) -> String {
        let (golden, stem) = (self.side("golden", "il"), self.stem);
        format!(
            "read_rtlil {golden}\n{exposed}read_verilog -formal {stem}.invariants.v\n\
             hierarchy -check -top miter\nproc\nflatten\n\
             sat -tempinduct -prove-asserts -maxsteps 1 -show-public -dump_vcd {stem}.trace.vcd miter\n"
        )
    }

    /// Returns the script that proves the miter by induction over some ticks.
    pub fn miter(self, exposed: &str, induction: u32) -> String {
        self.sat(exposed, &format!("-maxsteps {induction}"))
    }

    /// Returns the script that searches for a difference in the first `ticks` ticks, or in all.
    pub fn search(self, exposed: &str, ticks: Option<usize>) -> String {
        let ticks = ticks.unwrap_or(SEARCH);
        self.sat(exposed, &format!("-tempinduct-baseonly -maxsteps {ticks}"))
    }

    fn sat(self, exposed: &str, options: &str) -> String {
        let [golden, design] = SIDES.map(|side| self.side(side, "il"));
        let (joined, stem) = (self.joined(exposed), self.stem);
        format!(
            "read_rtlil {golden}\nread_rtlil {design}\n{joined}sat -tempinduct -prove-asserts {options} \
             -show-public -dump_vcd {stem}.trace.vcd miter\n"
        )
    }
}

/// Returns the commands that make one flat module of what was read.
fn made(side: &str, read: &str) -> String {
    // What is undefined in the design may have any value.
    let undefined = match side {
        "design" => "setundef -anyseq\n",
        _ => "",
    };
    format!("{read}{FLAT}{undefined}{CELLS}rename -top {side}\n")
}

/// Returns the commands that read the circuit, whose modules are in `files`.
pub fn read_golden(files: &[String], top: &str) -> String {
    let files = files.join(" ");
    format!("read_verilog {files}\nhierarchy -check -top {top}\n")
}

/// Returns the commands that read the design in `files`. Its own assertions and assumptions are left
/// out: a wrong assumption would prove anything.
pub fn read_design(files: &[&Path], top: &str, parameters: &[(String, String)]) -> String {
    let mut text = String::new();
    for file in files {
        let sv = file.extension().is_some_and(|extension| extension == "sv");
        let sv = if sv { " -sv" } else { "" };
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "read_verilog{sv} -noassert -noassume -norestrict \"{}\"",
            file.display()
        );
    }
    let _ = write!(text, "hierarchy -check -top {top}");
    for (name, value) in parameters {
        let _ = write!(text, " -chparam {name} {value}");
    }
    text + "\n"
}

/// Returns the commands that take instances out of the top module: their outputs become inputs of
/// it, and their inputs outputs.
pub fn without<'i>(instances: impl Iterator<Item = &'i String>) -> String {
    let cells: String = instances.map(|name| format!(" parts/c:{name}")).collect();
    format!("proc\nrename -top parts\nexpose -evert{cells}\nhierarchy -check -top parts\n")
}
