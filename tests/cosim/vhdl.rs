//! The Verilog as Icarus writes it in VHDL: GHDL analyses it, and each signal has one driver.

use super::simulators::all_own;
use super::tools::{run, write};
use motion_rtl::registry::AnyModel;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::process::Command;
use std::sync::Mutex;

/// A part of an architecture.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Declarations,
    Statements,
    Process,
}

/// How many processes, statements and instances of each architecture drive each signal.
fn drivers(vhdl: &str) -> BTreeMap<String, usize> {
    let mut drivers = BTreeMap::new();
    let mut outputs: HashMap<&str, BTreeSet<&str>> = HashMap::new();
    let (mut architecture, mut component, mut instance) = ("", "", "");
    let (mut part, mut process) = (Part::Declarations, BTreeSet::new());
    for line in vhdl.lines() {
        let code = line.split("--").next().unwrap_or_default();
        let words: Vec<&str> = code.split_whitespace().collect();
        match (part, &words[..]) {
            (_, ["architecture", _, "of", name, "is"]) => {
                (architecture, part) = (name, Part::Declarations);
            }
            (Part::Declarations, ["component", name, "is"]) => component = name,
            (Part::Declarations, [port, ":", "out" | "buffer", ..]) => {
                outputs.entry(component).or_default().insert(port);
            }
            // Those of functions are indented.
            (Part::Declarations, ["begin"]) if line == "begin" => part = Part::Statements,
            (Part::Statements, ["process", ..]) => {
                (part, process) = (Part::Process, BTreeSet::new());
            }
            (Part::Process, ["end", "process;"]) => {
                part = Part::Statements;
                for signal in &process {
                    *drivers
                        .entry(format!("{architecture}.{signal}"))
                        .or_default() += 1;
                }
            }
            (Part::Process, [signal, "<=", ..]) => {
                process.insert(signal.split('(').next().unwrap_or_default());
            }
            // What Icarus adds for a net that nothing else in its module drives: not a value.
            (Part::Statements, [_, "<=", "'Z';"] | [_, "<=", "(others", "=>", "'Z');"]) => {}
            (Part::Statements, [signal, "<=", ..]) => {
                let signal = signal.split('(').next().unwrap_or_default();
                *drivers
                    .entry(format!("{architecture}.{signal}"))
                    .or_default() += 1;
            }
            (Part::Statements, [label, of]) if label.ends_with(':') => instance = of,
            (Part::Statements, [port, "=>", signal])
                if outputs
                    .get(instance)
                    .is_some_and(|outputs| outputs.contains(port)) =>
            {
                let signal = signal.trim_end_matches(',');
                *drivers
                    .entry(format!("{architecture}.{signal}"))
                    .or_default() += 1;
            }
            _ => {}
        }
    }
    drivers
}

/// Circuits whose VHDL Icarus 11 writes with wrong types: products of a signed and an unsigned word,
/// casts at a port, a bit chosen among conditions, a port out that shows a port in.
const NOT_CARRIED: [&str; 19] = [
    "resolver_detector",
    "tracking_converter",
    "lead_arithmetic",
    "lead_products",
    "time_lead",
    "ram_time_lead",
    "speed_lead",
    "table_lead",
    "compensator",
    "ram_compensator",
    "conventional_compensator",
    "rotation",
    "arc_generator",
    "conventional_generator",
    "servo_arithmetic",
    "servo",
    "controlled_axis",
    "trajectory_controller",
    "machine",
];

/// Circuits with a port out that logic drives and a part reads, or that contain one: Icarus 11 drives
/// it a second time from a signal without a value. Signals of `compensator`,
/// `conventional_interpolator` and `tracking_converter` are concerned.
const JOINED: [&str; 8] = [
    "compensator",
    "conventional_compensator",
    "conventional_controller",
    "conventional_interpolator",
    "machine",
    "ram_compensator",
    "resolver_detector",
    "tracking_converter",
];

/// Holds a circuit's VHDL, and returns the signals that have several drivers. Icarus leaves `$readmemh` out and says so; of a memory that begins with
/// zeros it makes two processes, one for the zeros.
fn hold(circuit: &dyn AnyModel) -> Vec<String> {
    let directory = tempfile::tempdir().unwrap();
    let name = circuit.name();
    let modules = write(directory.path(), &circuit.verilog().unwrap());
    let options = ["-g2001", "-tvhdl", "-o", "all.vhd", "-s", name];
    let files = modules.iter().map(String::as_str);
    let arguments: Vec<&str> = options.into_iter().chain(files).collect();
    let said = run(directory.path(), "iverilog", &arguments);
    let other = said
        .lines()
        .find(|line| !line.ends_with("no VHDL translation for system task $readmemh"));
    assert_eq!(other, None, "{name}");
    let ghdl = Command::new("ghdl")
        .args(["-a", "--std=08", "all.vhd"])
        .current_dir(directory.path())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&ghdl.stderr);
    let carried = !NOT_CARRIED.contains(&name);
    assert_eq!(ghdl.status.success(), carried, "{name}: {said}");

    let outline = circuit.outline();
    let memories: BTreeSet<&str> = outline
        .memories
        .iter()
        .map(|memory| &*memory.name)
        .collect();
    let vhdl = std::fs::read_to_string(directory.path().join("all.vhd")).unwrap();
    let drivers = drivers(&vhdl);
    let ports = circuit
        .verilog()
        .unwrap()
        .design()
        .modules
        .last()
        .unwrap()
        .outputs()
        .count();
    let driven = |(signal, _): &(&String, &usize)| signal.starts_with(&format!("{name}."));
    assert!(
        drivers.iter().filter(driven).count() >= ports,
        "{name}: {drivers:#?}"
    );
    let several = drivers.iter().filter(|(signal, count)| {
        let own = signal.rsplit_once('.').map_or("", |(_, own)| own);
        **count > 1 && !memories.contains(own)
    });
    several.map(|(signal, _)| signal.clone()).collect()
}

#[test]
#[ignore = "needs Icarus Verilog and GHDL"]
fn every_signal_has_one_driver_in_vhdl() {
    let several = Mutex::new(BTreeMap::new());
    all_own(|circuit| {
        let signals = hold(circuit);
        if !signals.is_empty() {
            several.lock().unwrap().insert(circuit.name(), signals);
        }
    });
    let several = several.into_inner().unwrap();
    let names: BTreeSet<&str> = several.keys().copied().collect();
    assert_eq!(names, BTreeSet::from(JOINED), "{several:#?}");
}

#[test]
fn drivers_are_counted() {
    let vhdl = "\
architecture from_verilog of a is
  signal x : std_logic;
  component b is
    port (
      clk : in std_logic;
      y : buffer std_logic
    );
  end component;
begin
  x <= z(0);
  w(3) <= x; -- w <= x
  -- Generated
  part: b
    port map (
      clk => clk,
      y => x
    );
  process (clk) is
  begin
    if rising_edge(clk) then
      w(To_Integer(x)) <= v;
      v <= w(1);
      v <= x;
    end if;
  end process;
end architecture;
";
    let expected = [("a.v", 1), ("a.w", 2), ("a.x", 2)];
    let expected = expected.map(|(signal, count)| (signal.to_owned(), count));
    assert_eq!(drivers(vhdl), BTreeMap::from(expected));
}
