//! Ports of a circuit, and a number that stands for all of them.

use crate::netlist::{Kind, Role, Shape};
use crate::sim::{Handle, Model, PortDirection};
use std::fmt::Write as _;

/// Ports of a circuit in the order of its signals.
#[derive(Debug, Clone)]
pub struct PortList {
    pub(crate) ports: Vec<Port>,
    /// True if the circuit has flip-flops or memories.
    pub(crate) clocked: bool,
}

/// Port of a circuit.
#[derive(Debug, Clone)]
pub(crate) struct Port {
    pub handle: Handle,
    /// Path below the circuit.
    pub path: String,
    /// Name in Verilog.
    pub verilog: String,
    pub doc: String,
    pub direction: PortDirection,
    pub shape: Shape,
}

impl PortList {
    /// Returns the ports of a model's circuit.
    pub fn of(model: &Model) -> Self {
        let signals = model.signals();
        let clocked = signals.iter().any(|signal| signal.role == Role::Register);
        let ports = signals.into_iter().filter_map(|signal| {
            Some(Port {
                handle: signal.handle,
                direction: signal.port?,
                path: signal.path,
                verilog: signal.verilog,
                doc: signal.doc,
                shape: signal.shape,
            })
        });
        PortList {
            ports: ports.collect(),
            clocked,
        }
    }

    /// Returns the input ports, then the output ports.
    pub(crate) fn inputs_first(&self) -> impl Iterator<Item = &Port> {
        let of = |direction| {
            self.ports
                .iter()
                .filter(move |port| port.direction == direction)
        };
        of(PortDirection::In).chain(of(PortDirection::Out))
    }

    /// Returns one line per port, each with its newline: `in period 8 unsigned`.
    ///
    /// ```
    /// use motion_rtl::{Model, checker::PortList};
    ///
    /// let counter = Model::new("enable_counter", &["width=8".parse()?])?;
    /// let ports = PortList::of(&counter);
    /// assert_eq!(ports.text(), "in period 8 unsigned\nout enable 1 unsigned\n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn text(&self) -> String {
        let mut text = String::new();
        for port in &self.ports {
            let direction = match port.direction {
                PortDirection::In => "in",
                PortDirection::Out => "out",
            };
            let kind = match port.shape.kind {
                Kind::Signed => "signed",
                Kind::Bit | Kind::Unsigned => "unsigned",
            };
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                "{direction} {} {} {kind}",
                port.path, port.shape.width
            );
        }
        text
    }

    /// Returns the names, for an error message.
    pub(crate) fn names(&self) -> String {
        let names = self.ports.iter().map(|port| port.path.as_str());
        names.collect::<Vec<_>>().join(", ")
    }

    /// Returns a hash of the [text](Self::text): FNV-1a with 64 bits. Benches keep it, to see that
    /// a model has the ports that they are made for.
    pub fn hash(&self) -> u64 {
        fnv_1a(&self.text())
    }
}

fn fnv_1a(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ports(settings: &str) -> PortList {
        let model = Model::new("enable_counter", &[settings.parse().unwrap()]);
        PortList::of(&model.unwrap())
    }

    #[test]
    fn the_hash_is_fnv_1a() {
        // The published values of the empty text and of `foobar`.
        assert_eq!(fnv_1a(""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv_1a("foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn another_width_has_another_hash() {
        assert_ne!(ports("width=8").hash(), ports("width=9").hash());
    }
}
