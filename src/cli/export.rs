//! A circuit's modules among those of others in one directory.

use super::Failure;
use motion_rtl::netlist::Module;
use motion_rtl::printed::SourceFile;
use motion_rtl::trace::Clock;
use motion_rtl::verilog::Verilog;
use motion_rtl::vhdl::Vhdl;
use std::fs;
use std::path::{Path, PathBuf};

/// Extension of the list of an export's files, which simulators take as a command file.
const LIST: &str = ".f";

/// Beginning of its first line; the export's name follows.
const MADE: &str = "// Made by motion-rtl: ";

/// A printed circuit.
#[derive(Debug, Clone, Copy)]
pub enum Printed<'a> {
    Verilog(&'a Verilog),
    Vhdl(&'a Vhdl),
}

impl Printed<'_> {
    /// Returns the circuit's own module.
    pub fn top(&self) -> Option<&Module> {
        let design = match self {
            Printed::Verilog(verilog) => verilog.design(),
            Printed::Vhdl(vhdl) => vhdl.design(),
        };
        design.modules.last()
    }

    /// Returns the extension of its files.
    pub fn extension(&self) -> &'static str {
        match self {
            Printed::Verilog(_) => ".v",
            Printed::Vhdl(_) => ".vhd",
        }
    }

    /// Returns the beginning of the extension of its list: a directory can have both languages.
    fn list(&self) -> &'static str {
        match self {
            Printed::Verilog(_) => "",
            Printed::Vhdl(_) => "_vhdl",
        }
    }

    fn sources(&self) -> Vec<SourceFile> {
        match self {
            Printed::Verilog(verilog) => verilog.sources(),
            Printed::Vhdl(vhdl) => {
                let mut sources = vhdl.sources();
                sources.push(vhdl.names());
                sources
            }
        }
    }

    fn testbench(&self, clock: Clock) -> Option<SourceFile> {
        match self {
            Printed::Verilog(verilog) => verilog.testbench(clock),
            Printed::Vhdl(vhdl) => vhdl.testbench(clock),
        }
    }
}

/// Files of a printed circuit, and the list of them.
#[derive(Debug)]
pub struct Export {
    /// Name of the export: the command that makes it.
    name: String,
    sources: Vec<SourceFile>,
    list: SourceFile,
}

impl Export {
    /// Creates the files of a circuit, with a testbench for waves of a clock if one is given.
    pub fn new(printed: Printed<'_>, testbench: Option<Clock>, name: String) -> Self {
        let mut sources = printed.sources();
        let top = printed.top().map_or("", |module| module.name.as_str());
        let mut list = format!("{MADE}{name}\n");
        let bench = testbench.and_then(|clock| printed.testbench(clock));
        for source in sources.iter().chain(&bench) {
            let module = source.name.ends_with(printed.extension());
            let module = module && Some(source) != bench.as_ref();
            list += if module { "" } else { "// " };
            list += &source.name;
            list += "\n";
        }
        sources.extend(bench);
        Export {
            name,
            sources,
            list: SourceFile {
                name: format!("{top}{}{LIST}", printed.list()),
                text: list,
            },
        }
    }

    /// Creates the files of a circuit's checker, in the order in which they are compiled, and a
    /// list of the name `list`.
    pub fn checker(list: &str, sources: Vec<SourceFile>, name: String) -> Self {
        let mut text = format!("{MADE}{name}\n");
        for source in &sources {
            text += &source.name;
            text += "\n";
        }
        Export {
            name,
            sources,
            list: SourceFile {
                name: format!("{list}{LIST}"),
                text,
            },
        }
    }

    pub fn files(&self) -> impl Iterator<Item = &SourceFile> {
        self.sources.iter().chain([&self.list])
    }

    /// Refuses to overwrite a file unless it belongs only to an earlier export of this circuit.
    ///
    /// # Errors
    /// The file and the export that it belongs to.
    pub fn check(&self, directory: &Path) -> Result<(), Failure> {
        let lists = lists(directory);
        for SourceFile { name, text } in &self.sources {
            let path = directory.join(name);
            // The writer reports a path that is missing or is no file.
            let Ok(there) = fs::read(&path) else {
                continue;
            };
            if there == text.as_bytes() {
                continue;
            }
            let mut owners = lists.iter().filter(|list| list.files.contains(name));
            let other = owners.clone().find(|list| list.file != self.list.name);
            let problem = match (other, owners.next()) {
                (None, Some(_)) => continue,
                (Some(other), _) => format!(
                    "{} is of `{}`; that of `{}` is another",
                    path.display(),
                    other.name,
                    self.name
                ),
                (None, None) => format!(
                    "{} is there, of no export of this directory; that of `{}` is another",
                    path.display(),
                    self.name
                ),
            };
            return Err(Failure::Argument {
                field: "--out",
                problem,
                allowed: "a directory for each, or to remove the file".into(),
            });
        }
        Ok(())
    }
}

/// List of an export's files, found in a directory.
struct List {
    file: String,
    name: String,
    files: Vec<String>,
}

/// Returns the lists in a directory, in order; skips other files with their extension.
fn lists(directory: &Path) -> Vec<List> {
    let entries = fs::read_dir(directory).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(LIST)).collect();
    names.sort();
    let list = |file: String| {
        let path: PathBuf = directory.join(&file);
        let text = fs::read_to_string(path).ok()?;
        let mut lines = text.lines();
        let name = lines.next()?.strip_prefix(MADE)?.to_owned();
        let files = lines.map(|line| line.trim_start_matches("// ").to_owned());
        let files = files.collect();
        Some(List { file, name, files })
    };
    names.into_iter().filter_map(list).collect()
}
