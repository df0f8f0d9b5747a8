//! Names that differ from those in the waves, as a map for [`compare`](crate::compare).

use super::units::Units;
use crate::printed::SourceFile;
use crate::sim::Elaborated;
use std::collections::HashMap;
use std::fmt::Write as _;

impl Units<'_> {
    /// Returns the map of the signals whose names or instances' names differ.
    pub(super) fn map(&self, circuit: &Elaborated) -> SourceFile {
        let name = circuit.name();
        let mut renamed = Vec::new();
        if let Some(top) = self.units.len().checked_sub(1) {
            self.collect(top, (name, "dut"), false, &mut renamed);
        }
        let paths: HashMap<String, String> = match renamed.is_empty() {
            true => HashMap::new(),
            false => circuit
                .outline()
                .signals()
                .map(|(_, leaf)| leaf.path())
                .map(|path| (path.replace('.', "_"), path))
                .collect(),
        };
        let mut text = format!(
            "\
# Signals of {name} whose names in VHDL are not those in the waves, for `motion-rtl compare --map`.
# The instance is called dut, as in the testbench.
"
        );
        let memories = &circuit.outline().memories;
        if !memories.is_empty() {
            text.push_str(
                "\n# GHDL's dumps have no arrays: delete these lines if yours have.\nignore = [\n",
            );
            for memory in memories {
                let scopes = memory.scopes.join(".");
                // Writing to a string does not fail.
                let _ = writeln!(text, "    \"{scopes}.{}.*\",", memory.name);
            }
            text.push_str("]\n");
        }
        if !renamed.is_empty() {
            text.push_str("\n[signals]\n");
        }
        for (golden, other) in renamed {
            let golden = paths.get(&golden).unwrap_or(&golden);
            let _ = writeln!(text, "\"{golden}\" = \"{other}\"");
        }
        SourceFile {
            name: format!("{name}_names.toml"),
            text,
        }
    }

    /// Adds the signals of a unit, and of those inside it, whose names differ; `renamed` is true if
    /// that of an instance around it does.
    fn collect(
        &self,
        unit: usize,
        (golden, other): (&str, &str),
        renamed: bool,
        all: &mut Vec<(String, String)>,
    ) {
        let unit = &self.units[unit];
        let (module, scope) = self.inside(unit);
        for signal in module.signals.iter().filter(|own| own.owner.is_none()) {
            let shown = scope.own(&signal.name);
            if renamed || shown != signal.name {
                let golden = format!("{golden}_{}", signal.name);
                all.push((golden, format!("{other}.{shown}")));
            }
        }
        for (child, inner) in module.instances.iter().zip(&unit.children) {
            let shown = scope.own(&child.name);
            let renamed = renamed || shown != child.name;
            let golden = format!("{golden}_{}", child.name);
            let other = format!("{other}.{shown}");
            self.collect(*inner, (&golden, &other), renamed, all);
        }
    }
}
