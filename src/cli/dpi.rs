//! `verilog --dpi`: a checker that puts the model beside a design in a simulator.

use super::bench::UNUSED;
use super::chosen::Chosen;
use super::export::Export;
use super::files::Files;
use super::names::Names;
use super::{Failure, print};
use clap::Args;
use motion_rtl::compare::{BoundPorts, Map, is_identifier};
use motion_rtl::verilog::{Binding, DpiChecker};
use std::fmt::Write as _;
use std::path::Path;

/// Arguments of a checker.
#[derive(Debug, Args)]
pub struct Dpi {
    /// Writes a SystemVerilog checker in place of the circuit: it compares your design with the
    /// model at every clock edge, in your simulator.
    #[arg(long, group = "design", conflicts_with_all = UNUSED)]
    dpi: bool,
    /// Module of your design to which the checker is bound; the name of the circuit by default.
    #[arg(long, value_name = "NAME", requires = "dpi")]
    module: Option<String>,
    /// Compares from the first clock edge on, without waiting for a reset.
    #[arg(long, requires = "dpi")]
    from_power_on: bool,
}

impl Dpi {
    /// True if a checker is to be written.
    pub fn is_asked(&self) -> bool {
        self.dpi
    }
}

/// Returns the expression for a reset.
fn expression(reset: &str) -> Result<String, Failure> {
    if reset == Names::NONE {
        return Ok("1'b0".to_owned());
    }
    match reset.strip_prefix('!') {
        Some(name) => Ok(format!("~{}", identifier("--reset", name)?)),
        None => identifier("--reset", reset),
    }
}

fn identifier(field: &'static str, name: &str) -> Result<String, Failure> {
    match is_identifier(name) {
        true => Ok(name.to_owned()),
        false => Err(Failure::Argument {
            field,
            problem: format!("{name:?} is no name in Verilog"),
            allowed: "letters, digits, _ and $, with a letter or _ first".into(),
        }),
    }
}

/// Writes the checker of a circuit.
pub fn checker(chosen: &Chosen, dpi: &Dpi, names: &Names, out: &Path) -> Result<(), Failure> {
    let (model, settings) = chosen.running()?;
    let circuit = model.name();
    let bound = match names.map() {
        Some(path) => Map::read(path)?.bound(&model)?,
        None => BoundPorts::default(),
    };
    let module = identifier("--module", dpi.module.as_deref().unwrap_or(circuit))?;
    let clock = identifier("--clock", names.clock().unwrap_or("clk"))?;
    let reset = names.reset().unwrap_or("rst");
    let binding = Binding {
        module,
        clock,
        reset: expression(reset)?,
        ports: bound.ports,
        from_power_on: dpi.from_power_on || reset == Names::NONE,
    };
    let checker = DpiChecker::new(&model, &settings, &bound.left);
    let checker = checker.map_err(|error| Failure::Argument {
        field: "--map",
        problem: error.to_string(),
        allowed: "ports of the circuit".into(),
    })?;
    let mut sources = Vec::from(checker.sources());
    let mut text = String::new();
    // A module without registers has no clock that could be bound.
    match checker.is_clocked() || names.clock().is_some() {
        true => sources.push(checker.binding(&binding)),
        false => {
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                "{circuit} has no clock: instantiate {circuit}_checker in your bench, or name a \
                 clock of your module with --clock"
            );
        }
    }
    let mut files = Files::begin(out, circuit)?;
    files.export(Export::checker(
        &format!("{circuit}_checker"),
        sources,
        format!("verilog {chosen} --dpi"),
    ))?;
    for path in files.commit()? {
        let _ = writeln!(text, "{path}");
    }
    print(&text)
}
