//! The properties of a module as assertions for formal tools.

use super::design::Modules;
use super::expression::Expressions;
use super::names::Names;
use crate::hdl::netlist::Module;
use std::fmt::Write as _;

/// Low in the first tick, whose past is not known.
const PAST_VALID: &str = "f_past_valid";

impl Modules<'_> {
    /// The assertions of a module, for tools that define FORMAL.
    pub(super) fn assertions(&self, module: &Module) -> String {
        if module.assertions.is_empty() {
            return String::new();
        }
        // Names of its own: what only an assertion reads is read by nothing in the circuit.
        let names = Names::new(module, self.modules);
        let expressions = Expressions::new(module, &names);
        let mut text = String::from("`ifdef FORMAL\n");
        let steps = module.assertions.iter().any(|assertion| assertion.step);
        if steps {
            let _ = writeln!(text, "    reg {PAST_VALID} = 1'b0;");
            let _ = writeln!(text, "    always @(posedge clk)");
            let _ = writeln!(text, "        {PAST_VALID} <= 1'b1;\n");
        }
        let _ = writeln!(text, "    always @(posedge clk) begin");
        for assertion in &module.assertions {
            let holds = expressions.definition(assertion.holds, 76, "                ");
            let mut name = assertion.name.chars();
            let first = name.next().map(|first| first.to_ascii_uppercase());
            let name: String = first.into_iter().chain(name).collect();
            let _ = writeln!(text, "        // {name}.");
            match assertion.step {
                true => {
                    let _ = writeln!(text, "        if ({PAST_VALID} && !$past(rst))");
                    let _ = writeln!(text, "            assert ({holds});");
                }
                false => {
                    let _ = writeln!(text, "        assert ({holds});");
                }
            }
        }
        text + "    end\n`endif\n\n"
    }
}
