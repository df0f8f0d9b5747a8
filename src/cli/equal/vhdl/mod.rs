//! Designs in VHDL: GHDL translates them to Verilog, and its simulation is held against the
//! translation.

mod bench;
mod entity;

use super::check::{Check, Paired, Work};
use super::tool::End;
use super::trace::Trace;
use super::{Failure, refused};
use entity::{Entity, KINDS, Port};
use std::fs;
use std::time::Instant;

/// Standard of VHDL.
const STANDARD: &str = "--std=08";

/// Least ticks in which the translation is held against GHDL's simulation.
const LEAST: usize = 1000;

/// Returns the design in Verilog.
pub fn translated(check: &Check<'_>, work: &Work, until: Instant) -> Result<String, Failure> {
    let mut words = vec![
        "--synth".to_owned(),
        STANDARD.to_owned(),
        "--out=verilog".to_owned(),
    ];
    let generics = check
        .parameters
        .iter()
        .map(|(name, value)| format!("-g{name}={value}"));
    words.extend(generics);
    words.extend(check.design.paths());
    words.extend(["-e".to_owned(), check.design.top.clone()]);
    let ran = work.ghdl(check, &words, until).map_err(|error| {
        let program = check.arguments.ghdl.display();
        let problem = format!("{program}: {error}; nothing is proved");
        refused(
            "--ghdl",
            problem,
            "GHDL 2.0 or later, in PATH or by its path",
        )
    })?;
    match ran.end {
        // Case does not count in VHDL, but GHDL keeps that of ports.
        End::Success => Ok(ran.log.to_ascii_lowercase()),
        _ => {
            let allowed = "a design that GHDL synthesizes; --top names its entity";
            Err(refused(
                "DESIGN",
                format!("GHDL: {}", ran.complaint()),
                allowed,
            ))
        }
    }
}

/// Holds the translation against GHDL's own simulation, with the inputs of a run.
pub fn hold(
    check: &Check<'_>,
    work: &Work,
    paired: &Paired,
    run: &Trace,
    until: Instant,
) -> Result<(), Failure> {
    let (stem, top) = (check.entry.name, &*check.design.top);
    if run.ticks < LEAST {
        let seconds = check.arguments.limit_seconds;
        return Err(Failure::Undecided(format!(
            "the translation of {top} is not simulated for {LEAST} ticks in a quarter of {seconds} s, \
             and is not held against GHDL's simulation; allow more with --limit-seconds"
        )));
    }
    let texts = check.design.files.iter().flat_map(fs::read_to_string);
    let entity = texts
        .filter_map(|text| Entity::find(&text, top))
        .next_back();
    let entity = entity.ok_or_else(|| {
        let problem = format!("no file declares the entity {top} with ports");
        refused("DESIGN", problem, "a file with the entity that --top names")
    })?;
    if let Some(port) = entity.ports.iter().find(|port| port.vector().is_none()) {
        let problem = format!("the port {} has the type {}", port.name, port.kind);
        return Err(refused(
            "DESIGN",
            problem,
            &format!("ports of the types {KINDS}"),
        ));
    }
    let clock = &*check.design.clock;
    let inputs: Vec<(&Port, usize)> = entity
        .ports
        .iter()
        .filter(|port| port.is_input && port.name != clock)
        .map(|port| {
            (
                port,
                paired.design.inputs.get(&port.name).copied().unwrap_or(1),
            )
        })
        .collect();
    let outputs: Vec<&Port> = entity.ports.iter().filter(|port| !port.is_input).collect();
    let bits = |ports: &[&Port], tick: usize| -> String {
        let bits = ports.iter().map(|port| {
            let net = format!("design.{}", port.name);
            let bits = run.bits(&net, tick).unwrap_or("0");
            let width = paired
                .design
                .nets
                .get(&port.name)
                .map_or(1, |net| net.width());
            format!("{bits:0>width$}")
        });
        bits.collect()
    };
    let driven: Vec<&Port> = inputs.iter().map(|(port, _)| *port).collect();
    let stimulus: String = (0..run.ticks)
        .map(|tick| bits(&driven, tick) + "\n")
        .collect();
    let files = [format!("{stem}.bits"), format!("{stem}.results")];
    let text = bench::bench(
        (top, &entity),
        clock,
        &check.parameters,
        &inputs,
        &outputs,
        [&files[0], &files[1]],
    );
    work.write(&files[0], &stimulus)?;
    work.write("bench.vhd", &text)?;
    let mut words = vec!["-c".to_owned(), STANDARD.to_owned()];
    words.extend(check.design.paths());
    words.extend(["bench.vhd", "-r", bench::NAME].map(str::to_owned));
    let ran = work.ghdl(check, &words, until)?;
    if ran.end != End::Success {
        let told = match ran.end {
            End::Late => "takes longer than the time limit".to_owned(),
            _ => format!("fails: {}", ran.complaint()),
        };
        return Err(Failure::Undecided(format!(
            "GHDL's simulation, against which its translation is held, {told}"
        )));
    }
    let results = work.read(&files[1])?;
    let mut ticks = 0;
    for (tick, line) in results.lines().enumerate() {
        ticks += 1;
        let mut rest = line;
        for port in &outputs {
            let translated = bits(&[port], tick);
            let (simulated, after) = rest.split_at(translated.len().min(rest.len()));
            rest = after;
            if !agree(simulated, &translated) {
                return Err(Failure::Undecided(format!(
                    "GHDL translates {top} wrongly: in tick {tick} of its simulation {} is {simulated}, \
                     but {translated} in the translation {stem}.translated.v; write that part in another \
                     way",
                    port.name
                )));
            }
        }
    }
    match ticks == run.ticks {
        true => Ok(()),
        false => Err(Failure::Undecided(format!(
            "GHDL's simulation ends after {ticks} of {} ticks: {}",
            run.ticks,
            ran.complaint()
        ))),
    }
}

/// True if all bits that are defined in the simulation are equal.
fn agree(simulated: &str, translated: &str) -> bool {
    let mut bits = simulated.chars().zip(translated.chars());
    let equal = bits.all(|(simulated, translated)| match simulated {
        '0' | 'L' => translated == '0',
        '1' | 'H' => translated == '1',
        _ => true,
    });
    equal && simulated.len() == translated.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undefined_bits_of_the_simulation_agree_with_all() {
        assert!(agree("01UXLH", "010101"));
        assert!(!agree("01", "11") && !agree("10", "11"));
        assert!(!agree("0", "00"));
    }
}
