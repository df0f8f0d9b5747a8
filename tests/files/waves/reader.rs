//! A dump as an independent reader sees it.

use std::collections::BTreeMap;
use std::io::Cursor;
use wellen::{SignalValueRef, VarType, simple::Waveform};

pub struct Variable {
    pub kind: VarType,
    pub width: Option<u32>,
    pub range: Option<(i64, i64)>,
    /// Codes and names of states.
    pub states: Vec<(String, String)>,
    /// Times and values of the changes; bits as text.
    pub changes: Vec<(u64, String)>,
}

pub struct Dump {
    pub variables: BTreeMap<String, Variable>,
    pub timescale: String,
    pub times: Vec<u64>,
}

impl Variable {
    /// The value that stands at `time`.
    pub fn at(&self, time: u64) -> Option<&str> {
        let after = self.changes.partition_point(|(when, _)| *when <= time);
        Some(&self.changes[after.checked_sub(1)?].1)
    }

    pub fn number_at(&self, time: u64) -> Option<u64> {
        u64::from_str_radix(self.at(time)?, 2).ok()
    }
}

pub fn read(bytes: &[u8]) -> Dump {
    let mut wave: Waveform =
        wellen::simple::read_from_reader(Cursor::new(bytes.to_vec())).expect("a readable dump");
    let refs: Vec<_> = wave.hierarchy().all_vars().collect();
    let signals: Vec<_> = refs
        .iter()
        .map(|&var| wave.hierarchy()[var].signal_ref())
        .collect();
    wave.load_signals(&signals);
    let times = wave.time_table().to_vec();
    let hierarchy = wave.hierarchy();
    let mut variables = BTreeMap::new();
    for (&var, &signal) in refs.iter().zip(&signals) {
        let var = &hierarchy[var];
        let text = |value: SignalValueRef<'_>| match value {
            SignalValueRef::BitVec(bits) => bits.bit_string(),
            other => other.to_string(),
        };
        let changes = wave.get_signal(signal).expect("a loaded signal");
        let variable = Variable {
            kind: var.var_type(),
            width: var.length(hierarchy),
            range: var.index().map(|index| (index.msb(), index.lsb())),
            states: var.enum_type(hierarchy).map_or(Vec::new(), |(_, table)| {
                let owned = |&(code, name): &(&str, &str)| (code.to_owned(), name.to_owned());
                table.iter().map(owned).collect()
            }),
            changes: changes
                .iter_changes()
                .map(|(when, value)| (times[when as usize], text(value)))
                .collect(),
        };
        let earlier = variables.insert(var.full_name(hierarchy), variable);
        assert!(earlier.is_none(), "{} twice", var.full_name(hierarchy));
    }
    let timescale = hierarchy.timescale().expect("a timescale");
    Dump {
        variables,
        timescale: format!("{} {:?}", timescale.factor, timescale.unit),
        times,
    }
}
