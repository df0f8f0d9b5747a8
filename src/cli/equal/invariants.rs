//! Values that registers of the circuit never have, as far as induction proves them: state
//! encodings and counts that do not occur.
//!
//! A run of the model with random inputs leaves the candidates that it does not refute. Yosys then
//! shows states that keep all candidates and break one in the next tick, until no candidate breaks.

use super::netlist::Netlist;
use super::trace::Trace;
use motion_rtl::Model;
use motion_rtl::netlist::{Format, Role};
use motion_rtl::sim::{Handle, ModelError, PortDirection, SignalInfo};

/// Greatest width of a register whose values are looked at one by one.
const WIDEST: usize = 6;

/// Least value that is taken for a count, not a state.
const STATES: u64 = 8;

/// Random runs from power-on, and ticks of each.
const RUNS: u32 = 100;
const TICKS: u32 = 300;

/// Greatest number of candidates for a proof.
const MOST: usize = 1000;

/// Statement that a register does not have a value, in all states or in one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Invariant {
    /// Index of the signal.
    pub signal: usize,
    /// The value.
    pub value: u64,
    /// Index of another register and its value, if the statement is only about the states with it.
    pub state: Option<(usize, u64)>,
}

impl Invariant {
    /// True if the values of the signals keep the statement.
    fn holds(&self, value: impl Fn(usize) -> u64) -> bool {
        let applies = self.state.is_none_or(|(signal, is)| value(signal) == is);
        !applies || value(self.signal) != self.value
    }

    /// Returns the statement in Verilog; `wire` gives the name of a signal.
    pub fn verilog(&self, wire: impl Fn(usize) -> String) -> String {
        let own = format!("{} != {}", wire(self.signal), self.value);
        match self.state {
            None => own,
            Some((signal, value)) => format!("{} != {value} || {own}", wire(signal)),
        }
    }

    /// Returns the indices of its signals.
    pub fn signals(&self) -> impl Iterator<Item = usize> {
        self.state
            .into_iter()
            .map(|state| state.0)
            .chain([self.signal])
    }
}

/// Returns the instances around a register, as its Verilog name has them.
fn scope(signal: &SignalInfo) -> &str {
    let name = &signal.verilog;
    name.rfind('.').map_or("", |dot| &name[..dot])
}

/// Returns the candidates: values that a narrow register never has, words that are never zero, and
/// words that are not zero in a state of their own instance.
fn possible(signals: &[SignalInfo], golden: &Netlist) -> Vec<Invariant> {
    let registers = signals.iter().enumerate().filter(|(_, signal)| {
        // Words of memories are too many, and their values are data.
        let word = signal.path.ends_with(']');
        signal.role == Role::Register && !word && golden.nets.contains_key(&signal.verilog)
    });
    let registers: Vec<(usize, &SignalInfo)> = registers.collect();
    let values = |signal: &SignalInfo| 0..1_u64 << signal.width();
    let mut possible = Vec::new();
    for &(index, signal) in &registers {
        let values = match signal.width() {
            ..=WIDEST => values(signal),
            _ => 0..1,
        };
        possible.extend(values.map(|value| Invariant {
            signal: index,
            value,
            state: None,
        }));
    }
    for &(state, signal) in &registers {
        if !matches!(signal.format, Format::States(_)) || signal.width() > WIDEST {
            continue;
        }
        let beside = registers
            .iter()
            .filter(|(index, other)| *index != state && scope(other) == scope(signal));
        for (index, _) in beside {
            possible.extend(values(signal).map(|is| Invariant {
                signal: *index,
                value: 0,
                state: Some((state, is)),
            }));
        }
    }
    possible
}

/// Returns the candidates about `signals`, of the circuit or of a part, that a run of the model with
/// random inputs does not refute. `all` are the circuit's signals.
///
/// # Errors
/// Returns the errors of the model.
pub fn candidates(
    circuit: &Model,
    all: &[SignalInfo],
    signals: &[SignalInfo],
    golden: &Netlist,
) -> Result<Vec<Invariant>, ModelError> {
    let mut model = Model::of(circuit.elaborated())?;
    let mut candidates = possible(signals, golden);
    let inputs = all
        .iter()
        .filter(|signal| signal.port == Some(PortDirection::In));
    let inputs: Vec<(Handle, usize)> = inputs.map(|port| (port.handle, port.width())).collect();
    let mut values = vec![0; signals.len()];
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let power_on = model.snapshot();
    for run in 0..RUNS {
        model.restore(&power_on)?;
        // Small numbers in most runs, so that counts end.
        let bits = [1, 2, 3, 64][run as usize % 4];
        for _ in 0..TICKS {
            for &(port, width) in &inputs {
                let number = random.next() >> (64 - width.min(bits));
                model.set_bits(port, number)?;
            }
            for index in candidates.iter().flat_map(Invariant::signals) {
                values[index] = model.get(signals[index].handle)?;
            }
            candidates.retain(|candidate| candidate.holds(|index| values[index]));
            model.step();
        }
    }
    // A state that does not occur needs no conditions.
    let never: Vec<(usize, u64)> = candidates
        .iter()
        .filter(|candidate| candidate.state.is_none())
        .map(|candidate| (candidate.signal, candidate.value))
        .collect();
    candidates.retain(|candidate| {
        let own = (candidate.signal, candidate.value);
        match candidate.state {
            None => true,
            Some(state) => !never.contains(&state) && !never.contains(&own),
        }
    });
    candidates.truncate(MOST);
    Ok(candidates)
}

/// Removes the candidates that a tick of a trace breaks; returns true if there were any. A count
/// that leaves its range goes on: the other candidates beyond `STATES` go too, not one by one.
pub fn refute(
    candidates: &mut Vec<Invariant>,
    trace: &Trace,
    wire: impl Fn(usize) -> String,
) -> bool {
    let before = candidates.len();
    for tick in 0..trace.ticks {
        let value = |index: usize| {
            let bits = trace.bits(&wire(index), tick).unwrap_or_default();
            u64::from_str_radix(bits, 2).unwrap_or(0)
        };
        let counts: Vec<usize> = candidates
            .iter()
            .filter(|candidate| candidate.value >= STATES && !candidate.holds(value))
            .map(|candidate| candidate.signal)
            .collect();
        candidates.retain(|candidate| {
            let goes_on = candidate.value >= STATES && counts.contains(&candidate.signal);
            candidate.holds(value) && !goes_on
        });
    }
    candidates.len() < before
}

/// Xorshift: the same numbers in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STATE: Invariant = Invariant {
        signal: 1,
        value: 0,
        state: Some((0, 2)),
    };

    #[test]
    fn a_statement_about_a_state_holds_in_the_others() {
        let holds = |values: [u64; 2]| STATE.holds(|index| values[index]);
        assert!(holds([1, 0]) && holds([2, 1]));
        assert!(!holds([2, 0]));
        let wire = |index: usize| format!("w{index}");
        assert_eq!(STATE.verilog(wire), "w0 != 2 || w1 != 0");
    }

    #[test]
    fn a_trace_refutes_what_any_tick_breaks() {
        let dump = "$var wire 2 a \\w0 $end\n$var wire 4 b \\w1 $end\n\
                    #0\nb10 a\nb0001 b\n#2\nb10 a\nb0000 b\n#3\n";
        let trace = Trace::read(dump);
        let is_not = |signal: usize, value: u64| Invariant {
            signal,
            value,
            state: None,
        };
        let three = is_not(0, 3);
        let mut candidates = vec![STATE, three.clone()];
        assert!(refute(&mut candidates, &trace, |index| format!("w{index}")));
        assert_eq!(candidates, [three]);
        assert!(!refute(&mut candidates, &trace, |index| format!(
            "w{index}"
        )));
        // A count at 9 goes on to 10, a state at 1 does not go on to 2.
        let dump = "$var wire 4 a \\w0 $end\n#0\nb1001 a\n#2\nb0001 a\n#3\n";
        let mut candidates = [1, 2, 9, 10].map(|value| is_not(0, value)).to_vec();
        candidates.push(is_not(1, 10));
        refute(&mut candidates, &Trace::read(dump), |index| {
            format!("w{index}")
        });
        assert_eq!(candidates, [is_not(0, 2), is_not(1, 10)]);
    }
}
