//! A difference, replayed on the model and shown as waves.

use super::check::{Check, Paired};
use super::report;
use super::template;
use super::trace::Trace;
use crate::cli::bench::{ports, unprinted};
use crate::cli::export::Printed;
use crate::cli::files::Files;
use crate::cli::{Failure, print};
use motion_rtl::check::play;
use motion_rtl::compare::{Map, Report, Settings, compare};
use motion_rtl::input::stimulus::read_words;
use motion_rtl::trace::Clock;
use std::io;
use std::path::Path;

/// Replays the inputs of a trace on the model, and shows the first difference.
pub fn differs(
    check: &Check<'_>,
    mut files: Files,
    paired: &Paired,
    trace: &Trace,
) -> Result<(), Failure> {
    let verilog = check.circuit.verilog().map_err(|error| unprinted(&error))?;
    let printed = Printed::Verilog(&verilog);
    let Some(module) = printed.top() else {
        return Err(Failure::Undecided("the circuit has no module".to_owned()));
    };
    let words = trace.stimulus(module, check.design.reset.is_some());
    let inputs = read_words("trace", words.as_bytes(), &ports(&*check.circuit, printed))?;
    let mut waves = files.create("golden.vcd")?;
    let mut stimulus = files.create("stimulus")?;
    play(
        check.model.elaborated(),
        &inputs,
        Clock::default(),
        &mut waves,
        &mut stimulus,
        io::sink(),
    )?;
    files.push(waves);
    files.push(stimulus);
    files.write("design.vcd", &trace.waves(&[&check.design.clock]))?;
    files.write("names.toml", &template::map(check, paired))?;
    let named = files.commit()?;
    let path = |extension: &str| {
        let name = format!("{}.{extension}", check.entry.name);
        check.arguments.out.join(name)
    };
    let (golden, design) = (path("golden.vcd"), path("design.vcd"));
    let report = compared(check, paired, [&golden, &design], trace)?;
    let Some(text) = check.text(paired).differs(report, &paired.design) else {
        return Err(Failure::Undecided(
            "Yosys finds a difference that the model does not have; the circuit's Verilog and its \
             model disagree"
                .to_owned(),
        ));
    };
    print(&(text + &report::files(&named)))?;
    let circuit = check.entry.name;
    Err(Failure::Check(format!("the design differs from {circuit}")))
}

/// Compares the waves of the design with the golden ones.
pub fn compared(
    check: &Check<'_>,
    paired: &Paired,
    [golden, design]: [&Path; 2],
    trace: &Trace,
) -> Result<Report, Failure> {
    // After a reset, what was before it does not count.
    let begin = match check.arguments.after_reset {
        true => trace.first_reset().map_or(0, |tick| tick as u64 + 1),
        false => 0,
    };
    let names = template::map(check, paired);
    let settings = Settings {
        other_clock: Some("miter.clk".to_owned()),
        scope: Some("miter".to_owned()),
        map: Map::parse("names.toml", &names)?,
        ticks: begin..trace.ticks as u64,
        ..Settings::default()
    };
    Ok(compare(golden, design, &settings)?)
}
