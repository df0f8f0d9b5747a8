//! Input of `run` and `table`: a scenario and its input file.

use super::given::{Format, Given};
use super::shipped::{self, SHIPPED, Shipped};
use super::{Failure, files};
use clap::{Args, value_parser};
use motion_rtl::input::position_log::{self, Columns, PositionLog};
use motion_rtl::input::{Drawing, Fault, Kind, Language, Options, read_path_with};
use motion_rtl::jobs::pulse_interpolator::Table;
use motion_rtl::jobs::pulse_interpolator::table::read::{self, is_header};
use motion_rtl::nearest::nearest;
use motion_rtl::plan::{FEED_RANGE, PlanError};
use motion_rtl::scenario::{Loaded, Runnable, Scenario};
use motion_rtl::settings::{Place, SettingError, tidy};
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// Arguments that name the scenario and its input.
#[derive(Debug, Clone, Default, Args)]
pub struct Input {
    /// Scenario (.toml), HPGL drawing, G-code program or position log (.csv); `-` for standard
    /// input. By default the shipped scenario waves/machine.toml.
    #[arg(value_name = "FILE")]
    pub input: Option<PathBuf>,
    /// Format of FILE; by default the extension decides. Required for standard input.
    #[arg(long, value_enum, value_name = "FORMAT", requires = "input")]
    pub input_format: Option<Format>,
    /// Overrides a key of the scenario.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub sets: Vec<String>,
    /// Skips HPGL commands that are unknown or incomplete, with a warning, even if they may move the
    /// pen.
    #[arg(long)]
    pub lenient: bool,
    /// Refuses G-code words without effect on the path, instead of skipping them.
    #[arg(long)]
    pub strict: bool,
    /// Greatest number of lines of a G-code program to run; lines in loops and calls count each
    /// time. 10000000 by default.
    #[arg(
        long,
        value_name = "LINES",
        allow_negative_numbers = true,
        value_parser = value_parser!(u64).range(1..)
    )]
    pub most_lines: Option<u64>,
    /// Directory with the files of subroutines that a G-code program calls: NAME.ngc for
    /// O<NAME> CALL, 2.ngc or O0002.nc for M98 P2. Can be repeated; searched before the directories
    /// of program.subroutine_path.
    #[arg(long, value_name = "DIR")]
    pub subroutines: Vec<PathBuf>,
}

impl Input {
    /// Returns the options for reading a drawing or a part program.
    fn options(&self, loaded: &Loaded) -> Result<Options, Fault> {
        let zeros = loaded.scenario.run().program.zeros();
        let fourth = match &loaded.scenario {
            Scenario::TrajectoryController(keys) => keys.settings.has_fourth(),
            _ => false,
        };
        Ok(Options {
            lenient: self.lenient,
            strict: self.strict,
            most_lines: self.most_lines.unwrap_or(Options::MOST_LINES),
            zeros: zeros.map_err(|error| loaded.refuse(error))?,
            subroutines: self.directories(loaded)?,
            splines: loaded.scenario.circuit() == Runnable::TrajectoryController,
            fourth,
        })
    }
}

impl Input {
    /// Refuses options of a language in which the input is not written.
    fn check_uses(&self, origin: &Origin) -> Result<(), Failure> {
        let options = [
            ("--lenient", Language::Hpgl, self.lenient),
            ("--strict", Language::Gcode, self.strict),
            ("--most-lines", Language::Gcode, self.most_lines.is_some()),
            (
                "--subroutines",
                Language::Gcode,
                !self.subroutines.is_empty(),
            ),
        ];
        let (language, found) = match origin {
            Origin::File(path) => match (Language::of(path), Kind::of(path)) {
                (Some(language), _) => (Some(language), language.to_string()),
                (None, Ok(kind)) => (None, kind.to_string()),
                // Refused when it is read.
                (None, Err(_)) => return Ok(()),
            },
            Origin::Given(given) => match given.format.language() {
                Some(language) => (Some(language), language.to_string()),
                None => (None, given.format.kind().to_string()),
            },
            Origin::Crate(shipped) => match shipped.language() {
                Some(language) => (Some(language), language.to_string()),
                None => (None, NO_DRAWING.to_owned()),
            },
            Origin::Nowhere => (None, NO_DRAWING.to_owned()),
        };
        let mut given = options.iter().filter(|(_, _, is_given)| *is_given);
        match given.find(|(_, of, _)| Some(*of) != language) {
            None => Ok(()),
            Some((field, of, _)) => Err(Failure::Argument {
                field,
                problem: format!("is for {of}; the input is {found}"),
                allowed: format!("{of}, or a run without {field}"),
            }),
        }
    }

    /// Returns the directories of subroutines: those of the command line, then the scenario's.
    fn directories(&self, loaded: &Loaded) -> Result<Vec<PathBuf>, Fault> {
        let allowed = || "directories with subroutines".to_owned();
        let problem = |path: &Path| format!("{} is not a directory", path.display());
        if let Some(path) = self.subroutines.iter().find(|path| !path.is_dir()) {
            return Err(Fault::new(
                "--subroutines",
                0,
                "DIR",
                problem(path),
                allowed(),
            ));
        }
        let keys = &loaded.scenario.run().program.subroutine_path[..];
        if let Some(path) = keys.iter().find(|path| !path.is_dir()) {
            let error = SettingError::new("subroutine_path", problem(path), allowed());
            return Err(loaded.refuse(error.at(Place::Table("program"))));
        }
        Ok([&self.subroutines[..], keys].concat())
    }
}

/// A scenario, of whatever circuit, and where its input is.
#[derive(Debug)]
pub struct Source {
    /// The scenario.
    pub loaded: Loaded,
    /// Stem of the names of its files.
    pub stem: String,
    /// True if what the circuit is compared with is prepared too.
    pub compares: bool,
    origin: Origin,
    options: Options,
}

/// Input of a scenario that names none.
const NO_DRAWING: &str = "no drawing";

/// Location of an input.
#[derive(Debug)]
enum Origin {
    /// In a file.
    File(PathBuf),
    /// Read already: from standard input, or from a file whose extension does not count.
    Given(Given),
    /// In the crate.
    Crate(&'static Shipped),
    /// The scenario needs none, or should have one.
    Nowhere,
}

impl Source {
    /// Reads the scenario; refuses options that its input does not need.
    pub fn read(input: &Input) -> Result<Self, Failure> {
        let read = read(input)?;
        input.check_uses(&read.1)?;
        Ok(Source::of(read, input)?)
    }

    fn of((loaded, origin, name): (Loaded, Origin, PathBuf), input: &Input) -> Result<Self, Fault> {
        let stem = name.file_stem().unwrap_or("run".as_ref());
        // Two names that differ in such bytes alone would be one.
        let Some(stem) = stem.to_str().map(str::to_owned) else {
            let (name, problem) = (name.display().to_string(), "has a name that is not UTF-8");
            return Err(Fault::new(&name, 0, "file", problem, "a name in UTF-8"));
        };
        Ok(Source {
            options: input.options(&loaded)?,
            compares: loaded.scenario.beside(),
            loaded,
            stem,
            origin,
        })
    }

    /// A scenario that ships with the crate, without regard to files of its name.
    pub fn shipped(shipped: &'static Shipped) -> Result<Self, Fault> {
        let loaded = shipped.load(&[])?;
        let path = Path::new(shipped.file).to_owned();
        Source::of((loaded, Origin::Crate(shipped), path), &Input::default())
    }

    /// Reads the input of a circuit that needs a drawing.
    pub fn drawing(&self) -> Result<Drawing, Fault> {
        self.drawing_if_any().unwrap_or_else(|| {
            let allowed = "the path of an HPGL drawing or a G-code program".to_owned();
            Err(self.loaded.fault("input", "missing".to_owned(), allowed))
        })
    }

    /// Reads the input of a circuit that can do without: a drawing.
    pub fn drawing_if_any(&self) -> Option<Result<Drawing, Fault>> {
        match &self.origin {
            Origin::File(path) => {
                let read = |()| read_path_with(path, &self.options);
                Some(self.takes(path).and_then(read))
            }
            Origin::Given(given) => {
                let read = |()| given.drawing(&self.options);
                Some(
                    self.takes_kind(&given.name, given.format.kind())
                        .and_then(read),
                )
            }
            Origin::Crate(shipped) => shipped.drawing(&self.options),
            Origin::Nowhere => None,
        }
    }

    /// Reads the input of a circuit that can do without: a position log.
    pub fn log(&self, columns: &Columns) -> Result<Option<PositionLog>, Fault> {
        match &self.origin {
            Origin::File(path) => {
                self.takes(path)?;
                position_log::read_path(path, columns).map(Some)
            }
            Origin::Given(given) => {
                self.takes_kind(&given.name, given.format.kind())?;
                position_log::read(&given.name, &given.bytes, columns).map(Some)
            }
            Origin::Crate(_) | Origin::Nowhere => Ok(None),
        }
    }

    /// Reads a table of the pulse interpolator that the scenario names.
    pub fn table(&self, path: &Path, clock_hz: u64) -> Result<Table, Fault> {
        match &self.origin {
            // A path of the command line may be that of a file.
            Origin::Crate(shipped) if !(self.loaded.overrides("pattern") && path.exists()) => {
                shipped.table(path, clock_hz)
            }
            _ => read::read_path(path, clock_hz),
        }
    }

    /// Refuses to write over an input; `field` is the option that names the output.
    pub fn spare_inputs(
        &self,
        field: &'static str,
        output: &Path,
        given: &Input,
    ) -> Result<(), Failure> {
        let scenario = &self.loaded.scenario;
        let patterns = match scenario {
            Scenario::PulseInterpolator(keys) => &keys.settings.pattern[..],
            _ => &[],
        };
        let tables = patterns.iter().map(|pattern| pattern.table.as_path());
        let inputs = given.input.as_deref().into_iter();
        let inputs = inputs.chain(scenario.input().map(PathBuf::as_path));
        files::spare(field, output, inputs.chain(tables), "another file")
    }

    /// The input, where its extension and nothing else chose the circuit.
    pub fn chose_circuit(&self) -> Option<&Path> {
        let loaded = &self.loaded;
        if !loaded.is_bare() || loaded.overrides("circuit") {
            return None;
        }
        match &self.origin {
            Origin::File(path) => Some(path),
            Origin::Given(given) => Some(Path::new(&given.name)),
            Origin::Crate(_) | Origin::Nowhere => None,
        }
    }

    /// Refuses an input of a kind that the circuit does not take.
    fn takes(&self, input: &Path) -> Result<(), Fault> {
        // A file of another name may hold what the circuit takes.
        let Ok(kind) = Kind::of(input) else {
            return Ok(());
        };
        self.takes_kind(&input.display().to_string(), kind)
    }

    fn takes_kind(&self, name: &str, kind: Kind) -> Result<(), Fault> {
        let circuit = self.loaded.scenario.circuit();
        if circuit.takes(kind) {
            return Ok(());
        }
        let problem = format!("is {kind}, which {} does not take", circuit.name());
        Err(Fault::new(name, 0, "file", problem, circuit.inputs()))
    }
}

/// A fault of the drawing.
pub fn drawing_fault(
    drawing: &Drawing,
    line: usize,
    field: &str,
    problem: String,
    allowed: String,
) -> Fault {
    Fault::new(&drawing.file, line, field, problem, allowed)
}

fn read(input: &Input) -> Result<(Loaded, Origin, PathBuf), Fault> {
    let path = match &input.input {
        None => Path::new(SHIPPED[0].file),
        Some(path) => path,
    };
    let shipped = match &input.input {
        None => SHIPPED.first(),
        Some(path) => shipped::find(path),
    };
    let given = Given::read(path, input.input_format)?;
    let name = given.as_ref().map(|given| given.path().to_owned());
    let name = name.unwrap_or_else(|| path.to_owned());
    let (loaded, origin) = if let Some(given) = given {
        match given.format {
            Format::Toml => {
                let loaded = match given.is_standard() {
                    true => Loaded::parse(&given.name, given.text()?, &input.sets)?,
                    // Paths in a scenario are relative to it.
                    false => Loaded::read(path, &input.sets)?,
                };
                let within = loaded.scenario.input().cloned();
                (loaded, within.map_or(Origin::Nowhere, Origin::File))
            }
            format => {
                no_table(&given.name, &given.bytes)?;
                let loaded = Loaded::bare_of(&given.name, format.kind(), &input.sets)?;
                (loaded, Origin::Given(given))
            }
        }
    } else if let Some(shipped) = shipped {
        let loaded = shipped.load(&input.sets)?;
        let origin = match loaded.scenario.input() {
            Some(other) if loaded.overrides("input") => Origin::File(other.clone()),
            _ => Origin::Crate(shipped),
        };
        (loaded, origin)
    } else if Kind::of(path)? == Kind::Scenario {
        let loaded = Loaded::read(path, &input.sets).map_err(|fault| meant(path, fault))?;
        let given = loaded.scenario.input().cloned();
        (loaded, given.map_or(Origin::Nowhere, Origin::File))
    } else {
        let mut first = Vec::new();
        // The reader of the input says if it cannot be read.
        if let Ok(file) = File::open(path) {
            let _ = file.take(LONGEST_HEADER).read_to_end(&mut first);
        }
        no_table(&path.display().to_string(), &first)?;
        let loaded = Loaded::bare(path, &input.sets)?;
        (loaded, Origin::File(path.to_owned()))
    };
    if loaded.scenario.vcd_ticks() == 0 {
        let allowed = "1 to 9223372036854775807; --no-vcd for none".to_owned();
        return Err(loaded.fault("vcd_ticks", "is 0".to_owned(), allowed));
    }
    Ok((loaded, origin, name))
}

/// Bytes in which the header of a table of the pulse interpolator ends.
const LONGEST_HEADER: u64 = 4096;

/// Refuses a table of the pulse interpolator, which would be read as a position log.
fn no_table(name: &str, bytes: &[u8]) -> Result<(), Fault> {
    let first = bytes.split(|&byte| byte == b'\n').next().unwrap_or(bytes);
    let header = std::str::from_utf8(first).unwrap_or_default();
    if !is_header(header) {
        return Ok(());
    }
    let problem = "is a table of half-periods, the memory of a pulse interpolator";
    let allowed = "a scenario that names it, [[pattern]] with table = FILE as in waves/patterns.toml; \
                   a drawing, a part program or a position log";
    Err(Fault::new(name, 1, "header", problem, allowed))
}

/// A fault of a scenario that is not there, with the shipped one that its name resembles.
fn meant(path: &Path, fault: Fault) -> Fault {
    if path.exists() {
        return fault;
    }
    let stem = |path: &Path| {
        path.file_stem()
            .map(|stem| stem.to_string_lossy().into_owned())
    };
    let files = SHIPPED.iter().map(|shipped| shipped.file);
    let stems: Vec<_> = files
        .clone()
        .filter_map(|file| stem(Path::new(file)))
        .collect();
    let near = stem(path).and_then(|wanted| {
        let near = nearest(&wanted, stems.iter().map(String::as_str))?;
        files
            .clone()
            .find(|file| stem(Path::new(file)).as_deref() == Some(near))
    });
    match near {
        Some(file) => Fault {
            allowed: format!("{}; did you mean {file}?", fault.allowed),
            ..fault
        },
        None => fault,
    }
}

/// Returns a planning error with its file and line.
pub fn plan_fault(loaded: &Loaded, drawing: &Drawing, error: PlanError) -> Fault {
    match error {
        PlanError::Setting(error) => loaded.refuse(error),
        PlanError::Feed { line, value } => {
            let (least, most) = (FEED_RANGE.start(), FEED_RANGE.end());
            let allowed = format!("{least} to {most} mm/min");
            drawing_fault(
                drawing,
                line,
                "F",
                format!("is {} mm/min", tidy(value)),
                allowed,
            )
        }
        PlanError::Coordinate {
            line,
            coordinate,
            value,
            reach,
        } => {
            let problem = format!("is {} mm", tidy(value));
            let allowed = format!("-{reach} to {reach} mm");
            drawing_fault(drawing, line, coordinate, problem, allowed)
        }
        PlanError::Spline { line } => {
            let (problem, allowed) = ("is a spline".to_owned(), "lines and arcs".to_owned());
            drawing_fault(drawing, line, "G5", problem, allowed)
        }
        PlanError::Radius { line, radius_mm } => {
            let problem = format!("has a radius of {} mm", tidy(radius_mm));
            drawing_fault(drawing, line, "arc", problem, "a radius above 0".to_owned())
        }
    }
}
