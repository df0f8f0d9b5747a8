use super::gap::Gap;
use super::ghw;
use super::names::{self, listed};
use super::quiet::catch;
use super::scan::{self, Scanned};
use super::sections;
use super::times;
use super::value::Value;
use crate::input::{Fault, read_bytes};
use std::collections::{HashMap, HashSet};
use std::io::Cursor;
use std::path::Path;
use wellen::simple::Waveform;
use wellen::{SignalRef, SignalValueRef, VarDirection, VarType};

/// Greatest size of a file in bytes: the reader takes several times as much memory.
pub(super) const LARGEST: u64 = 1 << 30;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Variable with bits.
#[derive(Debug)]
pub(super) struct Variable {
    pub path: String,
    pub width: u32,
    /// True if it is declared as `reg`.
    pub register: bool,
    /// True for an input: an FST has directions. In a VCD of this crate, inputs of the outermost
    /// scope come before its registers.
    pub input: bool,
    /// Signal; variables of the same signal are aliases.
    pub signal: SignalRef,
    /// Numbers of first and last bit, if it has a range.
    range: Option<(i64, i64)>,
}

impl Variable {
    /// Returns the position of a bit by its number, counted from the lowest.
    pub fn place(&self, number: i64) -> Option<u32> {
        let (msb, lsb) = self.range.unwrap_or((i64::from(self.width) - 1, 0));
        let within = (msb.min(lsb)..=msb.max(lsb)).contains(&number);
        within.then_some(number.abs_diff(lsb) as u32)
    }

    /// Returns the range as written after the name.
    pub fn range(&self) -> String {
        let (msb, lsb) = self.range.unwrap_or((i64::from(self.width) - 1, 0));
        format!("[{msb}:{lsb}]")
    }
}

/// Waveform file.
#[derive(Debug)]
pub(super) struct Wave {
    pub file: String,
    /// Variables in declaration order.
    pub variables: Vec<Variable>,
    /// Number of variables without bits: strings, reals, events.
    pub without_bits: usize,
    /// Times at which something changes.
    pub times: Vec<u64>,
    /// True if this crate wrote the file, so that its times give its ticks.
    pub ours: bool,
    /// Gaps in which the dump was switched off, in order.
    pub gaps: Vec<Gap>,
    /// Output ports of the outermost circuit, if the file names them.
    pub ports_out: Option<Vec<usize>>,
    pub(super) unit: Option<(u32, &'static str)>,
    by_path: HashMap<String, usize>,
    by_element: HashMap<String, Option<usize>>,
    /// Variables by path in lower case, if case is ignored; `None` for an ambiguous path.
    by_folded: Option<HashMap<String, Option<usize>>>,
    waveform: Waveform,
}

impl Wave {
    pub fn read(path: &Path) -> Result<Self, Fault> {
        Self::parse(&path.display().to_string(), read_bytes(path, LARGEST)?)
    }

    pub fn parse(file: &str, mut bytes: Vec<u8>) -> Result<Self, Fault> {
        let fault = |problem: &str, allowed: &str| Fault::new(file, 0, "file", problem, allowed);
        let formats = "a VCD, an FST or a GHW";
        if let Some(unwrapped) = sections::unwrap(file, &bytes)? {
            bytes = unwrapped;
        }
        if bytes.starts_with(BYTE_ORDER_MARK) {
            bytes.drain(..BYTE_ORDER_MARK.len());
        }
        let scanned;
        let kind = match bytes.trim_ascii_start().first() {
            None => return Err(fault("empty", formats)),
            Some(b'$') => {
                scanned = scan::check(file, &bytes)?;
                scanned.edits.apply(&mut bytes);
                if bytes.last() != Some(&b'\n') {
                    // The reader drops a last line without an end.
                    bytes.push(b'\n');
                }
                "VCD"
            }
            Some(_) if ghw::begins(&bytes) => {
                ghw::check(file, &bytes)?;
                scanned = Scanned::default();
                "GHW"
            }
            Some(_) => {
                if !sections::begins(&bytes) {
                    return Err(fault("neither VCD, FST nor GHW", formats));
                }
                scanned = Scanned {
                    gaps: sections::check(file, &bytes)?,
                    ..Scanned::default()
                };
                "FST"
            }
        };
        // Read from memory: by name the reader would map the file, which may change.
        let waveform = match catch(|| wellen::simple::read_from_reader(Cursor::new(bytes))) {
            Some(Ok(waveform)) => waveform,
            Some(Err(error)) => {
                let error = error.to_string().replace('\n', " ");
                return Err(fault(&error, &format!("a complete {kind}")));
            }
            None => {
                return Err(fault(
                    "the reader cannot make sense of it",
                    &format!("a complete {kind}"),
                ));
            }
        };
        Self::of(file, waveform, scanned)
    }

    fn of(file: &str, waveform: Waveform, scanned: Scanned) -> Result<Self, Fault> {
        let hierarchy = waveform.hierarchy();
        let mut wave = Wave {
            file: file.to_owned(),
            variables: Vec::new(),
            without_bits: scanned.without_bits,
            times: waveform.time_table().to_vec(),
            ours: scanned.ours || hierarchy.version().trim().starts_with("motion-rtl "),
            gaps: scanned.gaps,
            ports_out: None,
            unit: hierarchy.timescale().and_then(times::unit),
            by_path: HashMap::new(),
            by_element: HashMap::new(),
            by_folded: None,
            waveform,
        };
        let hierarchy = wave.waveform.hierarchy();
        let mut registers_above = false;
        let mut outputs = Vec::new();
        for var in hierarchy.all_vars() {
            let var = &hierarchy[var];
            let bits = match var.var_type() {
                VarType::Event | VarType::EventParameter => None,
                _ => var.length(hierarchy).filter(|&width| width > 0),
            };
            let Some(width) = bits else {
                wave.without_bits += 1;
                continue;
            };
            let path = names::path(&var.full_name(hierarchy));
            let signal = var.signal_ref();
            let index = wave.variables.len();
            if let Some(&earlier) = wave.by_path.get(&path) {
                if wave.variables[earlier].signal != signal {
                    return Err(Fault::new(
                        file,
                        0,
                        path,
                        "two signals have this name",
                        "a name for each signal",
                    ));
                }
                continue;
            }
            let register = var.var_type() == VarType::Reg;
            let above = path.matches('.').count() == 1;
            registers_above |= above && register;
            let input = match var.direction() {
                VarDirection::Unknown | VarDirection::Implicit => above && !registers_above,
                direction => direction == VarDirection::Input,
            };
            if var.direction() == VarDirection::Output {
                outputs.push(index);
            }
            wave.by_path.insert(path.clone(), index);
            let element = wave.by_element.entry(names::element(&path));
            element.and_modify(|one| *one = None).or_insert(Some(index));
            wave.variables.push(Variable {
                path,
                width,
                register,
                input,
                signal,
                range: var.index().map(|index| (index.msb(), index.lsb())),
            });
        }
        if wave.variables.is_empty() {
            return Err(Fault::new(
                file,
                0,
                "file",
                "no signal in it",
                "a waveform with signals",
            ));
        }
        wave.ports_out = match scanned.ports_out {
            Some(paths) => Some(wave.named_ports(&paths)?),
            None => wave.outermost(outputs),
        };
        Ok(wave)
    }

    /// Returns the variables that a comment of the file names.
    fn named_ports(&self, paths: &[String]) -> Result<Vec<usize>, Fault> {
        let find = |path: &String| {
            self.find(path).ok_or_else(|| {
                let problem = format!("the file names {path} and has no such signal");
                let allowed = "a complete file: this one lacks a signal";
                Fault::new(&self.file, 0, "ports out", problem, allowed)
            })
        };
        paths.iter().map(find).collect()
    }

    /// Returns the outputs that are not inside another scope with outputs; `None` if there is no
    /// output. This crate gives a direction to no others.
    fn outermost(&self, outputs: Vec<usize>) -> Option<Vec<usize>> {
        let scope = |index: usize| {
            let path = &self.variables[index].path;
            path.rsplit_once('.').map_or("", |(scope, _)| scope)
        };
        let scopes: HashSet<_> = outputs.iter().map(|&index| scope(index)).collect();
        let is_outermost = |&index: &usize| {
            let own = scope(index);
            let mut around = own.match_indices('.').map(|(dot, _)| &own[..dot]);
            self.ours || !around.any(|scope| scopes.contains(scope))
        };
        let ports: Vec<usize> = outputs.iter().copied().filter(is_outermost).collect();
        (!ports.is_empty()).then_some(ports)
    }

    /// Returns the variable with this path; words of a memory have two forms.
    pub fn find(&self, path: &str) -> Option<usize> {
        let exact = self.by_path.get(path).copied();
        let element = || {
            let by_element = &self.by_element;
            by_element.get(&names::element(path)).copied().flatten()
        };
        let folded = || {
            let by_folded = self.by_folded.as_ref()?;
            by_folded.get(&self.key(path)).copied().flatten()
        };
        exact.or_else(element).or_else(folded)
    }

    /// Ignores case when signals are found by name from here on.
    pub fn fold_case(&mut self) {
        self.by_folded = Some(HashMap::new());
        let mut by_folded: HashMap<_, Option<usize>> = HashMap::new();
        for (index, variable) in self.variables.iter().enumerate() {
            let entry = by_folded.entry(self.key(&variable.path));
            entry.and_modify(|one| *one = None).or_insert(Some(index));
        }
        self.by_folded = Some(by_folded);
    }

    /// True if case is ignored.
    pub fn folds(&self) -> bool {
        self.by_folded.is_some()
    }

    /// Returns the lookup key of a path: words of memories as elements, and lower case if case is
    /// ignored.
    pub fn key(&self, path: &str) -> String {
        let element = names::element(path);
        match self.folds() {
            true => element.to_ascii_lowercase(),
            false => element,
        }
    }

    /// Makes the second variable an alias of the first.
    pub fn join(&mut self, first: usize, second: usize) {
        let (kept, gone) = (self.variables[first].signal, self.variables[second].signal);
        for variable in &mut self.variables {
            if variable.signal == gone {
                variable.signal = kept;
            }
        }
    }

    /// True if a scope, which may be a memory, contains anything.
    pub fn has_scope(&self, scope: &str) -> bool {
        let below = |path: &str| {
            let rest = path.strip_prefix(scope);
            rest.is_some_and(|rest| rest.starts_with(['.', '[']))
        };
        self.variables.iter().any(|variable| below(&variable.path))
    }

    /// Lists the scopes for messages.
    pub fn scopes(&self) -> String {
        let mut scopes = Vec::new();
        for variable in &self.variables {
            for (place, _) in variable.path.match_indices('.') {
                let scope = &variable.path[..place];
                if !scopes.contains(&scope) {
                    scopes.push(scope);
                }
            }
            // Enough for the message: a long list is cut anyway.
            if scopes.len() > 100 {
                break;
            }
        }
        listed(&scopes)
    }

    /// Loads the values of these variables from the file.
    pub fn load(&mut self, variables: impl IntoIterator<Item = usize>) -> Result<(), Fault> {
        let mut signals: Vec<_> = variables
            .into_iter()
            .map(|index| self.variables[index].signal)
            .collect();
        signals.sort_unstable();
        signals.dedup();
        let waveform = &mut self.waveform;
        catch(|| waveform.load_signals(&signals)).ok_or_else(|| self.broken())
    }

    fn broken(&self) -> Fault {
        let problem = "the reader cannot make sense of its values";
        Fault::new(&self.file, 0, "file", problem, "a complete file")
    }

    /// Returns the changes of a loaded variable: indices into [`times`](Wave::times), in order,
    /// with values of `width` bits from bit `low` up.
    pub fn changes(
        &self,
        variable: usize,
        low: u32,
        width: u32,
    ) -> Result<Vec<(u32, Value)>, Fault> {
        let Some(signal) = self.waveform.get_signal(self.variables[variable].signal) else {
            return Ok(Vec::new());
        };
        let whole = self.variables[variable].width;
        let read = || {
            let value = |(at, value)| match value {
                SignalValueRef::BitVec(bits) if bits.width() == whole => {
                    Some((at, Value::read(bits, low, width)))
                }
                _ => None,
            };
            signal.iter_changes().map(value).collect::<Option<Vec<_>>>()
        };
        catch(read).flatten().ok_or_else(|| self.broken())
    }
}
