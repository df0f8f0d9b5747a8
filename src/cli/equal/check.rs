//! An attempt to prove a design equal to a circuit of certain widths.

use super::design::Design;
use super::invariants::Invariant;
use super::miter::Miter;
use super::netlist::Netlist;
use super::pairs::{self, Pairs, Sides};
use super::report::{self, Text};
use super::script::{self, Names};
use super::task::Task;
use super::tool::{self, End, Ran};
use super::trace::Trace;
use super::{Arguments, Failure, parts, random, refused, template, vhdl};
use crate::cli::bench::unprinted;
use crate::cli::chosen;
use crate::cli::export::{Export, Printed};
use crate::cli::files::Files;
use crate::cli::{progress, warn};
use motion_rtl::Model;
use motion_rtl::printed::SourceFile;
use motion_rtl::registry::{AnyModel, Base, Entry, Pair};
use motion_rtl::sim::SignalInfo;
use motion_rtl::verilog::Verilog;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;
use tempfile::TempDir;

/// A design and a circuit.
pub struct Check<'a> {
    pub arguments: &'a Arguments,
    pub design: &'a Design,
    pub entry: &'static Entry,
    pub model: Model,
    pub circuit: Box<dyn AnyModel>,
    pub signals: Vec<SignalInfo>,
    /// Greatest width of the circuit, if the check has narrowed it.
    pub width: Option<u64>,
    /// Changed keys of the circuit, as on the command line.
    pub changes: String,
    /// Values of the design's parameters or generics.
    pub parameters: Vec<(String, String)>,
    verilog: Verilog,
}

/// Circuit and design as netlists, with their pairs.
pub struct Paired {
    pub golden: Netlist,
    pub design: Netlist,
    pub pairs: Pairs,
}

/// Texts for the user, by their extensions.
#[derive(Default)]
pub struct Written(Vec<(String, String)>);

/// End of an attempt.
pub enum Outcome {
    /// The design is proved equal; the verdict in words.
    Proved(String),
    /// The inputs of the trace lead to a difference.
    Differs(Box<Paired>, Trace),
    /// Neither.
    Open {
        failure: Failure,
        /// True if the time for the proof was over.
        late: bool,
    },
}

/// An attempt and the files that it leaves.
pub struct Attempt {
    pub outcome: Outcome,
    pub written: Written,
}

impl Written {
    fn push(&mut self, extension: &str, text: String) {
        self.0.push((extension.to_owned(), text));
    }

    /// Writes the circuit's Verilog and the texts.
    pub fn into_files(self, check: &Check<'_>, files: &mut Files) -> Result<(), Failure> {
        files.export(check.export())?;
        let mut texts = self.0.iter();
        texts.try_for_each(|(extension, text)| files.write(extension, text))
    }
}

impl Outcome {
    fn open(failure: Failure) -> Self {
        Outcome::Open {
            failure,
            late: false,
        }
    }
}

impl<'a> Check<'a> {
    pub fn new(
        arguments: &'a Arguments,
        design: &'a Design,
        entry: &'static Entry,
        pairs: &[Pair],
        changes: String,
    ) -> Result<Self, Failure> {
        let circuit = entry.made(Base::Full, pairs);
        let circuit = circuit.map_err(|error| chosen::refused(entry, error))?;
        let model = Model::new(entry.name, pairs).map_err(|error| Failure::Argument {
            field: "CIRCUIT",
            problem: error.to_string(),
            allowed: "circuits that can be run".to_owned(),
        })?;
        Ok(Check {
            verilog: circuit.verilog().map_err(|error| unprinted(&error))?,
            parameters: design.parameters(entry, pairs)?,
            signals: model.signals(),
            width: None,
            arguments,
            design,
            entry,
            model,
            circuit,
            changes,
        })
    }

    pub fn names(&self) -> Names<'static> {
        Names {
            stem: self.entry.name,
        }
    }

    fn export(&self) -> Export {
        let printed = Printed::Verilog(&self.verilog);
        let title = format!("verilog {}{}", self.entry.name, self.changes);
        Export::new(printed, None, title)
    }

    pub fn text<'s>(&'s self, paired: &'s Paired) -> Text<'s> {
        Text {
            circuit: self.entry.name,
            widths: &self.changes,
            narrow: self
                .width
                .map(|width| (width, self.arguments.limit_seconds)),
            top: &self.design.top,
            template: self
                .arguments
                .out
                .join(format!("{}.template.toml", self.entry.name)),
            signals: &self.signals,
            pairs: &paired.pairs,
        }
    }

    /// Tries to prove the design equal until a point in time, and to find a difference.
    pub fn attempt(&self, until: Instant) -> Result<Attempt, Failure> {
        let mut written = Written::default();
        let outcome = self.outcome(until, &mut written)?;
        Ok(Attempt { outcome, written })
    }

    fn outcome(&self, until: Instant, written: &mut Written) -> Result<Outcome, Failure> {
        let names = self.names();
        let stem = names.stem;
        let work = Work::new()?;
        for source in self.export().files() {
            work.write(&source.name, &source.text)?;
        }
        let sources = self.verilog.sources().into_iter();
        let sources = sources.map(|SourceFile { name, .. }| name);
        let (modules, memories): (Vec<String>, Vec<String>) =
            sources.partition(|name| name.ends_with(".v"));
        let top = &*self.design.top;
        let design = match self.design.is_vhdl {
            false => {
                let designs: Vec<&Path> = self.design.files.iter().map(PathBuf::as_path).collect();
                script::read_design(&designs, top, &self.parameters)
            }
            true => {
                let text = vhdl::translated(self, &work, until)?;
                let name = format!("{stem}.translated.v");
                work.write(&name, &text)?;
                written.push("translated.v", text);
                script::read_design(&[Path::new(&name)], top, &[])
            }
        };
        let read = [script::read_golden(&modules, stem), design];
        let scripts = [
            names.flat("golden", &read[0]),
            names.flat("design", &read[1]),
        ];
        for ((side, extension), script) in [("golden", "golden.ys"), ("design", "design.ys")]
            .into_iter()
            .zip(scripts)
        {
            work.write(&names.side(side, "ys"), &script)?;
            written.push(extension, script);
        }
        let mut sides = [String::new(), String::new()];
        progress::tell("Yosys reads the circuit and the design");
        for (text, side) in sides.iter_mut().zip(script::SIDES) {
            let ran = match work.run(self, &names.side(side, "ys"), until) {
                Ok(ran) => ran,
                Err(error) => return Ok(Outcome::open(self.not_started(&error))),
            };
            self.prepared(side, &ran)?;
            *text = work.read(&names.side(side, "json"))?;
        }
        let paired = self.paired(&sides)?;
        let text = self.text(&paired);
        if !paired.pairs.ports_without.is_empty() || paired.pairs.held.is_empty() {
            written.push("template.toml", template::template(self, &paired));
            return Ok(Outcome::open(Failure::Undecided(text.unpaired())));
        }
        progress::tell("random inputs");
        let mut run = random::run(self, &work, &paired, until)?;
        if self.design.is_vhdl {
            vhdl::hold(self, &work, &paired, &run, until)?;
        }
        if let Some(ticks) = random::difference(self, &work, &paired, &run)? {
            run.cut(ticks);
            progress::tell(&format!("a difference after {ticks} ticks; an earlier one"));
            let earlier = random::earlier(self, &work, &paired, &run, until)?;
            self.scripts(written, &self.miter(&paired, &[]), script::INDUCTION[0]);
            return Ok(Outcome::Differs(Box::new(paired), earlier.unwrap_or(run)));
        }
        let files = [modules, memories].concat();
        let (mut parts, mut suspects) = (None, Vec::new());
        if self.arguments.parts {
            progress::tell("proof of the connections and of each part");
            let proved = parts::prove(self, &work, &paired, &read, self.arguments.until())?;
            written.0.extend(proved.texts);
            let Some(open) = proved.open else {
                let miter = self.miter(&paired, &[]);
                self.scripts(written, &miter, script::INDUCTION[0]);
                written.push("sby", names.sby(&read, &files, &miter.exposed()));
                let verdict = text.proved(self.start(), 0, &miter.free());
                let parts = proved.proved.join(", ");
                return Ok(Outcome::Proved(format!(
                    "{verdict}part by part: {parts}, and their connections\n"
                )));
            };
            (parts, suspects) = (Some(open), proved.suspects);
        }
        let until = match self.arguments.parts {
            true => self.arguments.until(),
            false => until,
        };
        let task = self.task(&paired);
        progress::tell("proof of the whole");
        let proof = task.prove(&work, until)?;
        let (invariants, ran) = (&proof.invariants, &proof.ran);
        let miter = task.miter(invariants);
        self.scripts(written, &miter, proof.induction);
        written.push("sby", names.sby(&read, &files, &miter.exposed()));
        if ran.is_proof() {
            let mut verdict = text.proved(self.start(), invariants.len(), &miter.free());
            if let Some(open) = parts {
                verdict += &format!("proved as a whole, not part by part: {open}\n");
            }
            return Ok(Outcome::Proved(verdict));
        }
        let mut search = ran.clone();
        let mut open = Vec::new();
        if ran.is_open() {
            open = report::differing(&self.signals, &paired, &task.read_trace(&work)?);
        }
        if let Some((pairs, ticks)) = random::at_ports(self, &work, &paired, &suspects, &mut run)? {
            run.cut(ticks);
            return Ok(Outcome::Differs(Box::new(Paired { pairs, ..paired }), run));
        }
        if !ran.is_difference() && self.width.is_none() {
            if !paired.pairs.registers_without.is_empty() {
                warn(&format!("no proof so far; {}", text.registers_without()));
            }
            progress::tell("no proof so far; random inputs without resets");
        }
        if !ran.is_difference()
            && let Some((pairs, trace)) = random::without_resets(self, &work, &paired, &suspects)?
        {
            return Ok(Outcome::Differs(
                Box::new(Paired { pairs, ..paired }),
                trace,
            ));
        }
        if ran.is_open() {
            // A narrower circuit is only proved.
            if self.width.is_none() {
                progress::tell("no difference so far; the solver searches for one");
                let script = format!("{stem}.search.ys");
                work.write(&script, &names.search(&miter.exposed(), None))?;
                search = work.run(self, &script, until)?;
            }
        }
        if search.is_difference() {
            let trace = task.read_trace(&work)?;
            return Ok(Outcome::Differs(Box::new(paired), trace));
        }
        if search.end == End::Failure {
            let errors = search.errors();
            return Err(Failure::Undecided(format!("Yosys failed: {errors}")));
        }
        if !paired.pairs.registers_without.is_empty() {
            written.push("template.toml", template::template(self, &paired));
        }
        let ticks = proof.ticks.max(search.ticks_without_difference());
        let late = ran.end == End::Late;
        let seconds = self.arguments.limit_seconds;
        let mut told = text.not_proved(ticks, late.then_some(seconds), &open);
        if !late && search.end == End::Late {
            told += &format!(
                "; the search for a difference ended after {seconds} s: allow more with --limit-seconds"
            );
        }
        if let Some(open) = parts {
            told += &format!("; part by part: {open}");
        }
        Ok(Outcome::Open {
            failure: Failure::Undecided(told),
            late,
        })
    }

    /// Adds the miter and its scripts.
    fn scripts(&self, written: &mut Written, miter: &Miter<'_>, induction: u32) {
        let names = self.names();
        let exposed = miter.exposed();
        written.push("search.ys", names.search(&exposed, None));
        written.push("miter.v", miter.text());
        written.push("miter.ys", names.miter(&exposed, induction));
    }

    /// Returns the failure of a program that cannot be started; the scripts are written.
    fn not_started(&self, error: &io::Error) -> Failure {
        let program = self.arguments.yosys.display();
        let problem = format!("{program}: {error}; nothing is proved, only scripts are written");
        refused(
            "--yosys",
            problem,
            "Yosys 0.23 or later, in PATH or by its path",
        )
    }

    /// Refuses a side that Yosys cannot prepare.
    fn prepared(&self, side: &str, ran: &Ran) -> Result<(), Failure> {
        if side == "golden" && ran.end == End::Failure {
            let errors = ran.errors();
            return Err(Failure::Undecided(format!(
                "Yosys refuses the circuit: {errors}"
            )));
        }
        if ran.end == End::Late {
            let seconds = self.arguments.limit_seconds;
            return Err(refused(
                "--limit-seconds",
                format!("Yosys has not read the {side} in {seconds} s"),
                "more seconds, or a narrower circuit",
            ));
        }
        if ran.end == End::Failure {
            let allowed =
                "a design that Yosys reads; --top names its module, --param its parameters";
            return Err(refused("DESIGN", ran.errors(), allowed));
        }
        if let (Some(latch), "design") = (ran.latch(), side) {
            let allowed = "registers at the rising edge of the clock that --clock names";
            return Err(refused("DESIGN", format!("{latch} is a latch"), allowed));
        }
        let loops =
            |line: &&str| line.contains("logic loop") || line.contains("conflicting drivers");
        match ran.log.lines().find(loops) {
            Some(line) if side == "design" => {
                let problem = line.trim_start_matches("Warning: ").to_owned();
                Err(refused(
                    "DESIGN",
                    problem,
                    "one driver for each net, and no loops",
                ))
            }
            _ => Ok(()),
        }
    }

    /// Reads both netlists and pairs their signals.
    fn paired(&self, [golden, design]: &[String; 2]) -> Result<Paired, Failure> {
        let clock = self.design.clock.as_str();
        let golden = Netlist::read(golden, "golden", "clk").map_err(Failure::Undecided)?;
        let design = Netlist::read(design, "design", clock).map_err(|problem| {
            let allowed = "registers at the rising edge of the clock that --clock names";
            refused("DESIGN", problem, allowed)
        })?;
        let reset = self.reset();
        if let Some((reset, _)) = reset
            && design.is_clocked
        {
            let is_reset = |name: &str| name != clock && design.inputs.get(name) == Some(&1);
            if !is_reset(reset) {
                let problem =
                    format!("the design has no input {reset} of one bit beside its clock");
                let names = design.inputs.keys().map(String::as_str);
                let names: Vec<&str> = names.filter(|name| is_reset(name)).collect();
                let allowed = match names[..] {
                    [] => "none".to_owned(),
                    _ => format!("none, or one of {}", pairs::listed(names.into_iter())),
                };
                return Err(refused("--reset", problem, &allowed));
            }
        }
        let sides = Sides {
            circuit: self.entry.name,
            signals: &self.signals,
            golden: &golden,
            design: &design,
            reserved: [Some(clock), reset.map(|(reset, _)| reset)],
            map: &self.design.map,
        };
        let pairs = sides.pairs()?;
        Ok(Paired {
            pairs,
            golden,
            design,
        })
    }

    /// Returns the ticks for which a proof holds, in words.
    fn start(&self) -> &'static str {
        match (self.arguments.after_reset, self.reset()) {
            (true, _) => "after a tick of reset",
            (false, Some(_)) => "from power-on",
            (false, None) => "from power-on, without resets",
        }
    }

    /// Returns the reset of the design, and true if it is active low.
    pub fn reset(&self) -> Option<(&str, bool)> {
        let reset = self.design.reset.as_ref();
        reset.map(|(name, low)| (name.as_str(), *low))
    }

    /// Returns the proof of the whole.
    pub fn task<'p>(&'p self, paired: &'p Paired) -> Task<'p> {
        Task {
            check: self,
            names: self.names(),
            signals: &self.signals,
            paired,
            clock: &self.design.clock,
            reset: self.reset(),
        }
    }

    pub fn miter<'p>(&'p self, paired: &'p Paired, invariants: &'p [Invariant]) -> Miter<'p> {
        self.task(paired).miter(invariants)
    }
}

/// Directory in which Yosys runs.
pub struct Work(TempDir);

impl Work {
    pub fn new() -> io::Result<Self> {
        tempfile::tempdir().map(Work)
    }

    pub fn write(&self, name: &str, text: &str) -> io::Result<()> {
        fs::write(self.path(name), text)
    }

    pub fn read(&self, name: &str) -> io::Result<String> {
        fs::read_to_string(self.path(name))
    }

    /// Returns the path of a file.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Runs a script of Yosys until a point in time.
    pub fn run(&self, check: &Check<'_>, script: &str, until: Instant) -> io::Result<Ran> {
        tool::yosys(&check.arguments.yosys, self.0.path(), script, until)
    }

    /// Runs GHDL until a point in time.
    pub fn ghdl(&self, check: &Check<'_>, words: &[String], until: Instant) -> io::Result<Ran> {
        tool::ghdl(&check.arguments.ghdl, self.0.path(), words, until)
    }
}
