//! Output ports of the golden file: each is compared, or left out by name.

use super::Settings;
use super::mapped::golden_signal;
use super::wave::Wave;
use crate::input::Fault;
use std::collections::HashSet;

const ALLOWED: &str = "--ports-out NAME,… that names them, a VCD or FST of motion-rtl, or an FST or \
                       GHW with directions";

/// Output ports that are compared, and those that are left out.
#[derive(Debug, Default)]
pub(super) struct Ports {
    pub out: Vec<usize>,
    pub left: HashSet<usize>,
}

impl Ports {
    /// Returns the output ports named by the golden file or by [`Settings::ports_out`], without
    /// the clock.
    pub fn of(golden: &Wave, clock: usize, settings: &Settings) -> Result<Self, Fault> {
        let fault = |problem: &str, allowed: &str| {
            Fault::new(&golden.file, 0, "ports out", problem, allowed)
        };
        let mut out = match (&golden.ports_out, &settings.ports_out[..]) {
            (Some(told), []) => told.clone(),
            (Some(_), [_, ..]) => {
                let allowed = "no --ports-out; --leave leaves some of them out";
                return Err(fault("the file names them itself", allowed));
            }
            (None, []) => return Err(fault("the file does not tell which they are", ALLOWED)),
            (None, names) => by_end(golden, "--ports-out", names)?,
        };
        let clock = golden.variables[clock].signal;
        out.retain(|&index| golden.variables[index].signal != clock);
        out.sort_unstable();
        out.dedup();
        if out.is_empty() {
            return Err(fault("there is none beside the clock", ALLOWED));
        }
        let left = left(golden, &out, settings)?;
        if out.iter().all(|index| left.contains(index)) {
            let allowed = "one port out at least that is compared";
            return Err(fault("all of them are left out", allowed));
        }
        Ok(Ports { out, left })
    }
}

fn by_end(golden: &Wave, option: &str, names: &[String]) -> Result<Vec<usize>, Fault> {
    let find = |name: &String| {
        let fault = |problem: String, allowed: String| {
            Fault::new(&golden.file, 0, option, problem, allowed)
        };
        let found = golden.by_end(name).map_err(|ambiguous| {
            let (problem, allowed) = ambiguous.message("signal");
            fault(problem, allowed)
        })?;
        found.ok_or_else(|| {
            fault(
                format!("there is no {name}"),
                "a signal of this file".into(),
            )
        })
    };
    names.iter().map(find).collect()
}

fn left(golden: &Wave, out: &[usize], settings: &Settings) -> Result<HashSet<usize>, Fault> {
    const NO_PORT: &str = "is no port out";
    const ALLOWED: &str = "a port out; ignore in a map leaves out other signals";
    let mut left = HashSet::new();
    for entry in &settings.map.leave {
        let index = golden_signal(golden, &settings.map, entry)?;
        if !out.contains(&index) {
            return Err(settings
                .map
                .fault(entry.line, &entry.golden, NO_PORT, ALLOWED));
        }
        left.insert(index);
    }
    for index in by_end(golden, "--leave", &settings.leave)? {
        if !out.contains(&index) {
            let problem = format!("{} {NO_PORT}", golden.variables[index].path);
            return Err(Fault::new(&golden.file, 0, "--leave", problem, ALLOWED));
        }
        left.insert(index);
    }
    Ok(left)
}
