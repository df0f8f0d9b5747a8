//! The properties of a module as assertions for formal tools.

use super::expression::Expressions;
use super::rules::{names, parts};
use super::text::range;
use crate::netlist::{Assertion, Claim, Module, Node};
use crate::printed::{Modules, Names, ascii, folded};
use std::fmt::Write as _;

/// Low in the first tick, whose past is not known.
const PAST_VALID: &str = "f_past_valid";

/// Operators behind which a long line is broken, the weakest first.
const OPERATORS: &[&[&str]] = &[
    &[":"],
    &["?"],
    &["||"],
    &["&&"],
    &["&", "|", "^", "+", "-", "*", "<", ">", "=", ","],
];

impl Modules<'_> {
    /// The assertions of a module, for tools that define FORMAL.
    pub(super) fn assertions_in_verilog(&self, module: &Module) -> String {
        let printed = module.printed(self.modules);
        if printed.is_empty() {
            return String::new();
        }
        // Names of its own: what only an assertion reads is read by nothing in the circuit.
        let mut names = names(module, self.modules);
        share(&mut names, module, &printed);
        let expressions = Expressions::new(module, &names);
        let mut text = String::from("`ifdef FORMAL\n");
        let steps = printed.iter().any(|assertion| assertion.step);
        if steps {
            let _ = writeln!(text, "    reg {PAST_VALID} = 1'b0;");
            let _ = writeln!(text, "    always @(posedge clk)");
            let _ = writeln!(text, "        {PAST_VALID} <= 1'b1;\n");
        }
        text += &shared(module, &expressions);
        let _ = writeln!(text, "    always @(posedge clk) begin");
        for assertion in printed {
            let holds = expressions.definition(assertion.holds, 76, "                ");
            let holds = folded(&holds, 16, OPERATORS);
            let _ = writeln!(text, "        // {}.", sentence(assertion));
            let says = match assertion.claim {
                Claim::Property | Claim::Helper => "assert",
                Claim::Given | Claim::Narrowing => "assume",
            };
            match assertion.step {
                true => {
                    let _ = writeln!(text, "        if ({PAST_VALID} && !$past(rst))");
                    let _ = writeln!(text, "            {says} ({holds});");
                }
                false => {
                    let _ = writeln!(text, "        {says} ({holds});");
                }
            }
        }
        text + "    end\n`endif\n\n"
    }
}

/// Returns the statement of an assertion, with a capital unless it begins with the name of a signal.
fn sentence(assertion: &Assertion) -> String {
    let name = ascii(assertion.name);
    let first = name.split(' ').next().unwrap_or_default();
    if assertion.signals.contains(&first) {
        return name;
    }
    let mut letters = name.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

/// Names what Verilog takes no part of without a name in what assertions compute, and, where
/// there is any, all values of before: wires cannot ask for them.
fn share(names: &mut Names<'_>, module: &Module, printed: &[&Assertion]) {
    names.shared.clear();
    let mut read = vec![false; module.nodes.len()];
    for assertion in printed {
        read[assertion.holds] = true;
    }
    for id in (0..read.len()).rev() {
        let (node, _) = module.nodes[id];
        if read[id] && names.get(id).is_none() && !matches!(node, Node::Past(_)) {
            for operand in node.operands() {
                read[operand] = true;
            }
        }
    }
    let parts = parts(names, module, &read);
    let unnamed = |id: &usize| parts[*id] && names.get(*id).is_none();
    if !(0..parts.len()).any(|id| unnamed(&id)) {
        return;
    }
    for (id, (node, _)) in module.nodes.iter().enumerate() {
        if let Node::Past(of) = *node
            && read[id]
        {
            let name = format!("past_{}", names.get(of).unwrap_or("net"));
            let name = names.free(&name.replace('.', "_"));
            names.insert(id, name);
            names.shared.push(id);
        }
    }
    names.share_of(module, &read, (&vec![0; read.len()], &parts), &|_| {
        "f_value".to_owned()
    });
}

/// Returns declarations for the shared values of a module's assertions: past values as registers,
/// others as wires.
fn shared(module: &Module, expressions: &Expressions<'_>) -> String {
    let (mut registers, mut edges, mut wires) = (String::new(), String::new(), String::new());
    for &id in &expressions.names.shared {
        let (node, shape) = module.nodes[id];
        let name = expressions.names.get(id).unwrap_or_default();
        match node {
            Node::Past(of) => {
                let _ = writeln!(registers, "    reg {}{name};", range(shape));
                let _ = writeln!(edges, "        {name} <= {};", expressions.value(of));
            }
            _ => {
                let definition = expressions.definition(id, 76, "        ");
                let definition = folded(&definition, 8, OPERATORS);
                let _ = writeln!(wires, "    wire {}{name} = {definition};", range(shape));
            }
        }
    }
    if registers.is_empty() && wires.is_empty() {
        return String::new();
    }
    if !edges.is_empty() {
        edges = format!("    always @(posedge clk) begin\n{edges}    end\n");
    }
    registers + &edges + &wires + "\n"
}

#[cfg(test)]
mod tests {
    use crate::hdl::*;
    use crate::verilog::Verilog;

    /// Sum whose property computes what drives it.
    #[derive(Debug, Clone)]
    struct Sum;

    signals! { for Sum as _c;
        pub struct In { pub a: U(4), pub b: U(4) }
        pub struct Net { pub sum: U(4), pub same: Bit }
    }

    impl Circuit for Sum {
        const NAME: &'static str = "adder";
        const ABOUT: &'static str = "adds two words";
        records!(In, Nothing, Net);

        fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
            let net = Net {
                sum: i.a + i.b,
                same: i.a.equals(i.b),
            };
            (net, Nothing)
        }

        fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
            let (i, w) = (&now.i, &now.w);
            vec![
                Property::always("sum is a plus b", &["sum"], w.sum.equals(i.a + i.b)),
                Property::always("same compares", &["same"], w.same.equals(i.a.equals(i.b))),
            ]
        }
    }

    #[test]
    fn an_assertion_about_a_net_shows_what_it_is_compared_with() {
        let text = Verilog::new(&Sum).expect("it is right").top().text;
        assert!(text.contains("assert (sum == a + b);"), "{text}");
        assert!(text.contains("assert (!(same ^ (a == b)));"), "{text}");
    }
}
