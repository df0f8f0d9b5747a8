//! Input whose format is named on the command line: standard input, or a file with another extension.

use clap::ValueEnum;
use motion_rtl::input::{
    Drawing, Fault, Kind, LARGEST_FILE, Language, Options, as_text, gcode, hpgl, read_bytes,
};
use std::io::{Read as _, stdin};
use std::path::Path;

/// Name of standard input on the command line.
const STANDARD: &str = "-";
/// Name of standard input in messages.
const STDIN: &str = "<stdin>";

/// Format of an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// A scenario.
    Toml,
    /// An HPGL drawing.
    Hpgl,
    /// A G-code program.
    Gcode,
    /// A position log.
    Csv,
}

impl Format {
    /// Returns the language of a drawing or a part program.
    pub fn language(self) -> Option<Language> {
        match self {
            Format::Hpgl => Some(Language::Hpgl),
            Format::Gcode => Some(Language::Gcode),
            Format::Toml | Format::Csv => None,
        }
    }

    /// Returns the kind of input that has this format.
    pub fn kind(self) -> Kind {
        match self {
            Format::Toml => Kind::Scenario,
            Format::Hpgl | Format::Gcode => Kind::Drawing,
            Format::Csv => Kind::PositionLog,
        }
    }
}

/// An input that has been read as a whole.
#[derive(Debug)]
pub struct Given {
    /// Name in messages.
    pub name: String,
    /// Format as named on the command line.
    pub format: Format,
    pub bytes: Vec<u8>,
}

impl Given {
    /// Reads the input; `None` where its file's extension says the format.
    ///
    /// # Errors
    /// Standard input without a format, an input that cannot be read or is too large.
    pub fn read(path: &Path, format: Option<Format>) -> Result<Option<Self>, Fault> {
        let standard = path.as_os_str() == STANDARD;
        let format = match (standard, format) {
            (false, None) => return Ok(None),
            (true, None) => {
                let formats = Format::value_variants().iter();
                let names = formats.filter_map(ValueEnum::to_possible_value);
                let names: Vec<_> = names.map(|value| value.get_name().to_owned()).collect();
                let (problem, allowed) = ("has no extension", names.join(", "));
                let allowed = format!("--input-format with one of {allowed}");
                return Err(Fault::new(STDIN, 0, "file", problem, allowed));
            }
            (_, Some(format)) => format,
        };
        let (name, bytes) = match standard {
            true => (STDIN.to_owned(), standard_input()?),
            false => (path.display().to_string(), read_bytes(path, LARGEST_FILE)?),
        };
        Ok(Some(Given {
            name,
            format,
            bytes,
        }))
    }

    /// True if it is standard input.
    pub fn is_standard(&self) -> bool {
        self.name == STDIN
    }

    /// Returns the path whose stem the results have.
    pub fn path(&self) -> &Path {
        match self.is_standard() {
            true => Path::new("stdin"),
            false => Path::new(&self.name),
        }
    }

    /// Returns the input as text.
    ///
    /// # Errors
    /// The input is not UTF-8.
    pub fn text(&self) -> Result<&str, Fault> {
        as_text(&self.name, &self.bytes, "a scenario in TOML")
    }

    /// Reads the drawing or part program.
    ///
    /// # Errors
    /// The reader's, with their lines.
    pub fn drawing(&self, options: &Options) -> Result<Drawing, Fault> {
        let read = match self.format {
            Format::Hpgl => hpgl::read_with,
            Format::Gcode | Format::Toml | Format::Csv => gcode::read_with,
        };
        read(&self.name, &self.bytes, options)
    }
}

fn standard_input() -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    let read = stdin()
        .lock()
        .take(LARGEST_FILE + 1)
        .read_to_end(&mut bytes);
    let refuse = |problem: String, allowed: String| Fault::new(STDIN, 0, "file", problem, allowed);
    match read {
        Err(error) => Err(refuse(
            format!("cannot be read: {error}"),
            "a pipe or a file".to_owned(),
        )),
        Ok(length) if length as u64 > LARGEST_FILE => Err(refuse(
            "too large".to_owned(),
            format!("at most {LARGEST_FILE} bytes"),
        )),
        Ok(_) => Ok(bytes),
    }
}
