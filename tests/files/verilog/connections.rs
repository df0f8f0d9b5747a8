//! Drivers of the ports of a circuit's parts.

use super::netlists::names;
use motion_rtl::check::Drive;
use motion_rtl::hdl::Declarations;
use motion_rtl::prelude::*;
use motion_rtl::registry::CATALOGUE;
use motion_rtl::sim::Elaborated;
use motion_rtl::trace::Clock;
use motion_rtl::verilog::{Connection, Connections};
use rayon::prelude::*;
use std::collections::HashMap;
use std::fmt::Write as _;
use vcd::{Command, Parser, Value as Level};

/// Counts up, and says where it stands at its limit.
#[derive(Debug, Clone)]
struct Count {
    limit: u64,
}

signals! { for Count as _c;
    pub struct CountIn { pub step: Bit, pub by: U(4) }
    pub struct CountReg { pub count: U(4) }
    pub struct CountNet { pub carry: Bit, sum: U(4) }
}

impl Circuit for Count {
    const NAME: &'static str = "count_by";
    const ABOUT: &'static str = "counts";
    records!(CountIn, CountReg, CountNet);

    fn tick(&self, i: CountIn, q: CountReg, _: Nothing) -> (CountNet, CountReg<Edge>) {
        let carry = q.count.equals(U::parameter("limit", self.limit, 4));
        let sum = q.count + i.by;
        let count = i.step.mux(sum, q.count);
        (CountNet { carry, sum }, CountReg { count })
    }
}

/// Counters that are connected in every way there is.
#[derive(Debug, Clone)]
struct Counts;

/// The counters in it.
const LOW: Count = Count { limit: 9 };
const HIGH: Count = Count { limit: 2 };

signals! { for Counts as c;
    pub struct Set { pub by: U(4) }
    pub struct In { pub given: Bit, pub set: Set(c) }
    pub struct Reg { held: U(4) = 3 }
    pub struct Parts {
        low: Part<Count>(LOW),
        high: Part<Count>(HIGH),
        spare: Part<Count>(HIGH),
    }
    pub struct Net { both: Bit, pub odd: Bit, pub last: U(4) }
}

impl Circuit for Counts {
    const NAME: &'static str = "counts";
    const ABOUT: &'static str = "counts in parts";
    records!(In, Reg, Net, Parts);

    fn tick(&self, i: In, q: Reg, p: Parts) -> (Net, Reg<Edge>) {
        let count = |step, by| CountIn { step, by };
        let by = i.given.mux(i.set.by, p.high.q.count);
        let low = p.low.settle(count(i.given, by));
        let high = p.high.settle(count(low.w.carry, U::new(5, 4)));
        let both = low.w.carry & high.w.carry;
        p.spare.settle(count(both, q.held));
        let net = Net {
            both,
            odd: (low.q.count + high.q.count).bit(3),
            last: low.q.count,
        };
        let held = both.mux(q.held + 1, q.held);
        (net, Reg { held })
    }
}

/// Prints the connections, one per line.
fn text(connections: &Connections) -> String {
    let mut text = String::new();
    let lines = |text: &mut String, what: &str, connections: &[Connection]| {
        for Connection {
            name,
            shape,
            driver,
        } in connections
        {
            writeln!(text, "{what} {name}[{}] = {driver}", shape.width).unwrap();
        }
    };
    for part in &connections.parts {
        writeln!(
            text,
            "{}: {} {:?}",
            part.name, part.circuit, part.parameters
        )
        .unwrap();
        lines(&mut text, " ", &part.inputs);
        for (name, shape) in &part.outputs {
            writeln!(text, "  out {name}[{}]", shape.width).unwrap();
        }
    }
    lines(&mut text, "out", &connections.outputs);
    lines(&mut text, "net", &connections.nets);
    lines(&mut text, "edge", &connections.registers);
    text
}

#[test]
fn drivers_are_ports_constants_choices_and_nets() {
    let model = Elaborated::new(&Counts).unwrap();
    let connections = Connections::of(model.design(), &Declarations::of(&Counts));
    let expected = r#"low: count_by [("LIMIT", 9)]
  step[1] = given
  by[4] = given ? set.by : high.count
  out count[4]
  out carry[1]
high: count_by [("LIMIT", 2)]
  step[1] = low.carry
  by[4] = 4'd5
  out count[4]
  out carry[1]
spare: count_by [("LIMIT", 2)]
  step[1] = both
  by[4] = held
  out count[4]
  out carry[1]
out odd[1] = low_count_plus_high_count[3]
out last[4] = low.count
net low_count_plus_high_count[4] = low.count + high.count
net both[1] = low.carry && high.carry
edge held[4] = both ? held + 4'd1 : held
"#;
    assert_eq!(text(&connections), expected);
}

#[test]
fn a_circuit_without_parts_has_its_own_signals_only() {
    let model = Elaborated::new(&LOW).unwrap();
    let connections = Connections::of(model.design(), &Declarations::of(&LOW));
    let expected = "out carry[1] = count == LIMIT\n\
                    net sum[4] = count + by\n\
                    edge count[4] = step ? sum : count\n";
    assert_eq!(text(&connections), expected);
}

/// A signal of the waves, or a constant.
fn value(driver: &str, top: &str, now: &HashMap<String, u64>) -> Option<u64> {
    let constant = driver
        .rsplit_once("'sd")
        .or_else(|| driver.rsplit_once("'d"))
        .or_else(|| driver.rsplit_once("'b"));
    match constant {
        Some((width, digits)) if width.parse::<u64>().is_ok() => digits.parse().ok(),
        _ => now
            .get(&format!("{top}_{}", driver.replace('.', "_")))
            .copied(),
    }
}

/// In the waves, every port has in every tick the value of the signal that drives it. All but a
/// few are driven by a signal or a constant.
#[test]
fn ports_have_the_values_of_their_drivers() {
    let count = CATALOGUE.par_iter().map(|entry| {
        let circuit = entry.full();
        let connections = circuit.connections().unwrap();
        let parts = connections.parts.iter();
        let parts = parts.flat_map(|part| {
            let inputs = part.inputs.iter();
            inputs.map(move |input| (format!("{}.{}", part.name, input.name), input))
        });
        let outputs = connections.outputs.iter();
        let outputs = outputs.map(|output| (output.name.clone(), output));
        let driven: Vec<_> = match connections.parts.is_empty() {
            true => Vec::new(),
            false => parts.chain(outputs).collect(),
        };
        let drive = Drive {
            seed: 1,
            ticks: 200 * u64::from(!driven.is_empty()),
            resets: false,
            bounded: false,
            clock: Clock::default(),
        };
        let mut waves = Vec::new();
        let sink = &mut std::io::sink();
        circuit
            .drive(&drive, &mut waves, sink, &mut std::io::sink())
            .unwrap();
        let mut parser = Parser::new(&waves[..]);
        let header = parser.parse_header().unwrap();
        let mut variables = HashMap::new();
        names(&header.items, &[], &mut variables);
        let clock = format!("{}_clk", entry.name);
        let (mut now, mut ticks, mut held) = (HashMap::new(), 0, vec![0; driven.len()]);
        for command in parser {
            let bit = |value: Level| u64::from(value == Level::V1);
            let (code, value) = match command.unwrap() {
                Command::ChangeScalar(code, value) => (code, bit(value)),
                Command::ChangeVector(code, vector) => {
                    let bits = vector.iter();
                    (code, bits.fold(0, |bits, value| bits << 1 | bit(value)))
                }
                _ => continue,
            };
            for name in &variables[&code] {
                now.insert(name.clone(), value);
            }
            // When the clock falls, everything of the tick has been said.
            if !variables[&code].contains(&clock) || value == 1 {
                continue;
            }
            ticks += 1;
            for ((port, Connection { driver, .. }), held) in driven.iter().zip(&mut held) {
                let Some(expected) = self::value(driver, entry.name, &now) else {
                    continue;
                };
                let port = self::value(port, entry.name, &now);
                assert_eq!(port, Some(expected), "{driver} in tick {ticks}");
                *held += 1;
            }
        }
        (
            driven.len(),
            held.iter().filter(|held| **held > 100).count(),
        )
    });
    let (driven, held) = count.reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
    assert!(
        driven > 800 && held * 100 > driven * 95,
        "{held} of {driven}"
    );
}
