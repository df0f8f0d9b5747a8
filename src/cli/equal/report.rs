//! Verdicts in words.

use super::super::files::Named;
use super::check::Paired;
use super::netlist::Netlist;
use super::pairs::{Pair, Pairs, bits, listed};
use super::trace::Trace;
use motion_rtl::compare::{Mismatch, Report};
use motion_rtl::sim::{PortDirection, SignalInfo};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Names and settings that appear in verdicts.
#[derive(Debug, Clone)]
pub struct Text<'a> {
    pub circuit: &'a str,
    /// Changed keys of the circuit, as on the command line.
    pub widths: &'a str,
    /// Greatest width of a circuit that was made narrower, and the seconds for its proof.
    pub narrow: Option<(u64, u64)>,
    /// Module of the design.
    pub top: &'a str,
    /// File with the signals without partner.
    pub template: PathBuf,
    pub signals: &'a [SignalInfo],
    pub pairs: &'a Pairs,
}

/// Lists files, one a line.
pub fn files(named: &[Named]) -> String {
    named.iter().map(|file| format!("{file}\n")).collect()
}

/// Formats a number of things.
fn count(number: usize, what: &str) -> String {
    match number {
        1 => format!("1 {what}"),
        _ => format!("{number} {what}s"),
    }
}

/// Returns a value as `compare` shows it, in hexadecimal and decimal, with the decimal number of a
/// signed word.
fn signed(value: &str, width: usize) -> String {
    let number = |(hexadecimal, number): (&str, &str)| {
        let above = 64_u32.checked_sub(u32::try_from(width).ok()?)?;
        let number = (number.parse::<u64>().ok()?.checked_shl(above)? as i64) >> above;
        Some(format!("{hexadecimal} = {number}"))
    };
    let shown = value.split_once(" = ").and_then(number);
    // A bit, or a value with unknown bits.
    shown.unwrap_or_else(|| value.to_owned())
}

/// Returns the paths of the paired signals that differ at the end of a trace.
pub fn differing(signals: &[SignalInfo], paired: &Paired, trace: &Trace) -> Vec<String> {
    let pairs = differing_pairs(signals, paired, trace).into_iter();
    pairs
        .map(|pair| signals[pair.signal].path.clone())
        .collect()
}

/// Returns the pairs that differ at the end of a trace.
pub fn differing_pairs<'p>(
    signals: &[SignalInfo],
    paired: &'p Paired,
    trace: &Trace,
) -> Vec<&'p Pair> {
    let Some(last) = trace.ticks.checked_sub(1) else {
        return Vec::new();
    };
    let differs = |pair: &&Pair| {
        let signal = &signals[pair.signal];
        let own = trace.bits(&format!("golden.{}", signal.verilog), last);
        let other = trace.bits(&format!("design.{}", pair.part.net), last);
        let (Some(own), Some(other)) = (own, other) else {
            return false;
        };
        let width = paired
            .design
            .nets
            .get(&pair.part.net)
            .map_or(other.len(), |net| net.width());
        let other = format!("{other:0>width$}");
        let high = width - pair.part.low - pair.part.width;
        let part = &other[high..high + pair.part.width];
        let invert = |bit: char| match bit {
            '0' => '1',
            '1' => '0',
            other => other,
        };
        match pair.part.invert {
            true => part.chars().map(invert).collect::<String>() != own,
            false => part != own,
        }
    };
    paired.pairs.held.iter().filter(differs).collect()
}

impl Text<'_> {
    fn paths(&self, indices: &[usize]) -> String {
        listed(indices.iter().map(|&index| &*self.signals[index].path))
    }

    fn is_port(&self, pair: &Pair) -> bool {
        self.signals[pair.signal].port == Some(PortDirection::Out)
    }

    /// Returns what is compared.
    fn compared(&self) -> String {
        let ports = self
            .pairs
            .held
            .iter()
            .filter(|pair| self.is_port(pair))
            .count();
        let others = self.pairs.held.len() - ports;
        let others = count(others, "other signal");
        match ports {
            1 => format!("1 port out and {others}"),
            ports => format!("{ports} ports out and {others}"),
        }
    }

    /// Returns the widths of the comparison.
    fn at(&self) -> String {
        match (self.narrow, self.widths.trim()) {
            (Some((width, _)), _) => format!("at width {width}"),
            (None, "") => "at full width".to_owned(),
            (None, widths) => format!("with {widths}"),
        }
    }

    /// Returns the verdict on a proof, which holds for the ticks that `start` names.
    pub fn proved(&self, start: &str, invariants: usize, free: &[&str]) -> String {
        let mut text = format!(
            "proved equal {}: {} and {}, {start}, for all inputs\ncompared: {}\n",
            self.at(),
            self.circuit,
            self.top,
            self.compared()
        );
        if let Some((_, seconds)) = self.narrow {
            let _ = writeln!(
                text,
                "widths: {}, the widest proved in {seconds} s; the proof at full width takes longer",
                self.widths.trim()
            );
        }
        if invariants > 0 {
            let values = count(invariants, "value");
            let _ = writeln!(
                text,
                "proved along: {values} that registers of {} do not have",
                self.circuit
            );
        }
        let left = &self.pairs.ports_left_out;
        if !left.is_empty() {
            let _ = writeln!(
                text,
                "ports of {} that the map leaves out: {}",
                self.circuit,
                self.paths(left)
            );
        }
        let without = &self.pairs.registers_without;
        if !without.is_empty() {
            let _ = writeln!(
                text,
                "registers of {} without partner, which the proof does not need: {}",
                self.circuit,
                self.paths(without)
            );
        }
        if !free.is_empty() {
            let free = listed(free.iter().copied());
            let _ = writeln!(
                text,
                "inputs of {} that {} does not have, with any value: {free}",
                self.top, self.circuit
            );
        }
        text
    }

    /// Returns the registers without partner, in words.
    pub fn registers_without(&self) -> String {
        let without = self.paths(&self.pairs.registers_without);
        format!("registers of {} without partner: {without}", self.circuit)
    }

    /// Returns the error about ports without partner.
    pub fn unpaired(&self) -> String {
        let ports = self.paths(&self.pairs.ports_without);
        let ports = if ports.is_empty() {
            "all".to_owned()
        } else {
            ports
        };
        let mut text = format!(
            "ports of {} without partner in {}: {ports}",
            self.circuit, self.top
        );
        for Pair { signal, part } in &self.pairs.other_widths {
            let signal = &self.signals[*signal];
            let _ = write!(
                text,
                "; {} has {}, but {} of the design has {}",
                signal.path,
                bits(signal.width()),
                part.net,
                bits(part.width)
            );
        }
        if !self.pairs.other_widths.is_empty() {
            text += ": --width and --set change those of the circuit, --param those of the design";
        }
        let template = self.template.display();
        text + &format!("; copy {template}, fill in the names, and pass it with --map")
    }

    /// Returns the error about a proof that is not found. `late` is the limit, if it ended the
    /// proof; `open` are the signals that induction cannot prove.
    pub fn not_proved(&self, ticks: u32, late: Option<u64>, open: &[String]) -> String {
        let mut text = format!(
            "not proved {}: {} and {} are equal for {} after power-on, for all inputs",
            self.at(),
            self.circuit,
            self.top,
            count(ticks as usize, "tick")
        );
        if let Some(seconds) = late {
            let _ = write!(
                text,
                "; the proof takes longer than {seconds} s: allow more with --limit-seconds, or let \
                 parameters follow keys, as in --param WIDTH=KEY, for narrower widths"
            );
            return text;
        }
        if !open.is_empty() {
            let open = listed(open.iter().map(String::as_str));
            let _ = write!(
                text,
                "; from states that may be unreachable, these can differ: {open}"
            );
        }
        let without = &self.pairs.registers_without;
        if !without.is_empty() {
            let _ = write!(
                text,
                "; {}. {} helps to map them",
                self.registers_without(),
                self.template.display()
            );
        }
        text
    }

    /// Gives the values of the first difference their sign, if they are signed: waves do not tell.
    fn sign(&self, first: &mut Mismatch) {
        let path = first.golden.strip_prefix(self.circuit);
        let path = path.and_then(|path| path.strip_prefix('.'));
        let mut signals = self.signals.iter();
        let signal = signals.find(|signal| Some(&*signal.path) == path);
        let Some(signal) = signal.filter(|signal| signal.is_signed()) else {
            return;
        };
        for value in [&mut first.golden_value, &mut first.other_value] {
            *value = signed(value, signal.width());
        }
    }

    /// Returns the first difference and the table around it; `None` if there is no difference.
    pub fn differs(&self, mut report: Report, design: &Netlist) -> Option<String> {
        let first = report.first.as_mut()?;
        self.sign(first);
        let mut text = format!(
            "differs in tick {}: {} is {}, but {} of the design is {}\n",
            first.tick,
            first.golden,
            first.golden_value,
            first.other.replace("miter.design.", ""),
            first.other_value
        );
        if self.narrow.is_some() {
            let _ = writeln!(text, "widths: {}", self.widths.trim());
        }
        let undefined = self.pairs.held.iter().filter(|pair| {
            let net = design.nets.get(&pair.part.net);
            net.is_some_and(|net| net.is_register && !net.has_power_on)
        });
        let undefined: Vec<&str> = undefined.map(|pair| &*pair.part.net).collect();
        if first.tick == 0 && !undefined.is_empty() {
            let _ = writeln!(
                text,
                "registers of {} without power-on value: {}; --after-reset compares after a reset",
                self.top,
                listed(undefined.into_iter())
            );
        }
        let ports = report
            .differences
            .iter()
            .filter(|difference| report.ports_out.contains(&difference.golden));
        if ports.count() == 0 {
            text += "ports out are equal so far; if a register is to differ, put it into ignore of a map\n";
        }
        text.push('\n');
        text += &report.text(false);
        text.push('\n');
        Some(text)
    }
}

#[cfg(test)]
mod tests {
    use super::signed;

    #[test]
    fn signed_words_are_shown_with_their_sign() {
        assert_eq!(signed("0x1fff3 = 131059", 17), "0x1fff3 = -13");
        assert_eq!(signed("0x0fff3 = 65523", 17), "0x0fff3 = 65523");
        assert_eq!(
            signed("0xffffffffffffffff = 18446744073709551615", 64),
            "0xffffffffffffffff = -1"
        );
        assert_eq!(signed("0b1x0", 3), "0b1x0");
        assert_eq!(signed("1", 1), "1");
    }
}
