//! Testbenches in VHDL.

use super::entity::LIBRARIES;
use super::text::subtype;
use super::units::Units;
use super::words::legal;
use crate::netlist::{Kind, Module, Signal};
use crate::printed::SourceFile;
use crate::trace::Clock;
use std::fmt::Write as _;

impl Units<'_> {
    /// Returns a testbench for the circuit itself: it applies a stimulus file and compares the output
    /// ports with the file of expected values.
    pub(super) fn testbench(&self, clock: Clock) -> Option<SourceFile> {
        let unit = self.units.last()?;
        let (module, scope) = self.inside(unit);
        let name = &module.name;
        let bench = legal(&format!("{name}_tb"));
        let rst: usize = module.inputs().map(|signal| signal.shape.width).sum();
        let mut ports = Vec::new();
        if self.modules.clocked(module) {
            ports.push("            clk => clk".to_owned());
            ports.push(format!("            rst => stimulus({rst})"));
        }
        for (signal, range) in slices(module.inputs()) {
            let port = scope.own(&signal.name);
            let actual = typed(signal, &format!("stimulus({range})"));
            ports.push(format!("            {port} => {actual}"));
        }
        for (signal, range) in slices(module.outputs()) {
            let port = scope.own(&signal.name);
            let formal = match signal.shape.kind {
                Kind::Bit => port,
                _ => format!("std_logic_vector({port})"),
            };
            ports.push(format!("            {formal} => seen({range})"));
        }
        let map = match ports.is_empty() {
            true => String::new(),
            false => format!("\n        port map (\n{}\n        )", ports.join(",\n")),
        };
        let (factor, unit_of_time) = clock.timescale();
        let unit_of_time = if unit_of_time == "s" {
            "sec"
        } else {
            unit_of_time
        };
        let half = u128::from(clock.period() / 2) * u128::from(factor);
        let Judge {
            about,
            declared,
            variables,
            opened,
            held,
            verdict,
        } = Judge::new(module);
        let text = format!(
            "\
-- Testbench of {name}.
--
-- Applies {name}.stimulus, a line a tick.
-- A line is a hexadecimal word: the inputs side by side, the first lowest, and rst on top. A tick
-- is what stands before a rising edge of clk; inputs change with its falling edge.
{about}
{LIBRARIES}use std.env.finish;
use std.textio.all;

entity {bench} is
end entity {bench};

architecture simulation of {bench} is

    constant HALF_PERIOD : time := {half} {unit_of_time};
    signal clk : std_logic := '0';
    signal stimulus : std_logic_vector({rst} downto 0) := (others => '0');
{declared}
begin

    dut : entity work.{entity}{map};

    process
        file stimuli : text;
        variable status : file_open_status;
        variable text_line : line;
        variable good : boolean;
        variable word : std_logic_vector({rst} downto 0);
        variable tick : natural := 0;
{variables}
        procedure print(message : string) is
        begin
            write(output, message & LF);
        end procedure;

        procedure fail(message : string) is
        begin
            print(\"FAIL: \" & message);
            finish(1);
        end procedure;
    begin
        file_open(status, stimuli, \"{name}.stimulus\", read_mode);
        if status /= open_ok then
            fail(\"{name}.stimulus cannot be opened\");
        end if;
{opened}        while not endfile(stimuli) loop
            readline(stimuli, text_line);
            hread(text_line, word, good);
            if not good then
                fail(\"tick \" & to_string(tick)
                    & \": {name}.stimulus has no word of \"
                    & to_string(word'length) & \" bits\");
            end if;
            if tick > 0 then
                clk <= '1';
                wait for HALF_PERIOD;
                clk <= '0';
            end if;
            stimulus <= word;
            wait for HALF_PERIOD;
{held}            tick := tick + 1;
        end loop;
{verdict}        wait;
    end process;

end architecture simulation;
",
            entity = unit.name,
        );
        Some(SourceFile {
            name: format!("{bench}.vhd"),
            text,
        })
    }
}

/// Returns a slice of a `std_logic_vector` as the type of a signal.
fn typed(signal: &Signal, slice: &str) -> String {
    let kind = subtype(signal.shape);
    match kind.split_once('(') {
        Some((kind, _)) => format!("{kind}({slice})"),
        None => slice.to_owned(),
    }
}

/// Returns signals with their bits in a word that has them side by side, the first lowest.
fn slices<'m>(
    signals: impl Iterator<Item = &'m Signal>,
) -> impl Iterator<Item = (&'m Signal, String)> {
    let mut low = 0;
    signals.map(move |signal| {
        let high = low + signal.shape.width - 1;
        let range = match signal.shape.kind {
            Kind::Bit => low.to_string(),
            _ => format!("{high} downto {low}"),
        };
        low = high + 1;
        (signal, range)
    })
}

/// The parts of a testbench that compare output ports with expected values; empty for a circuit
/// without output ports.
#[derive(Default)]
struct Judge {
    about: String,
    declared: String,
    variables: String,
    opened: String,
    held: String,
    verdict: String,
}

impl Judge {
    fn new(module: &Module) -> Self {
        let name = &module.name;
        let bits: usize = module.outputs().map(|signal| signal.shape.width).sum();
        let Some(last) = bits.checked_sub(1) else {
            return Judge::default();
        };
        let mut named = String::new();
        for (signal, range) in slices(module.outputs()) {
            let shown = match signal.shape.kind {
                Kind::Bit => "to_string",
                _ => "to_hstring",
            };
            // Writing to a string does not fail.
            let _ = write!(
                named,
                "                    if seen({range}) /= expected({range}) then
                        print(\"FAIL: tick \" & to_string(tick) & \": {port} is \"
                            & {shown}(seen({range})) & \", expected \"
                            & {shown}(expected({range})));
                    end if;
",
                port = signal.name,
            );
        }
        Judge {
            about: format!(
                "--
-- Compares the output ports with {name}.expected, a line a tick.
-- A line is a hexadecimal word: the output ports side by side, the first lowest. The last line
-- printed begins with PASS, or lines begin with FAIL and the exit code is not zero.
"
            ),
            declared: format!("    signal seen : std_logic_vector({last} downto 0);\n"),
            variables: format!(
                "        file golden : text;
        variable expected : std_logic_vector({last} downto 0);
        variable differ : natural := 0;
"
            ),
            opened: format!(
                "        file_open(status, golden, \"{name}.expected\", read_mode);
        if status /= open_ok then
            fail(\"{name}.expected cannot be opened\");
        end if;
"
            ),
            held: format!(
                "            if endfile(golden) then
                fail(\"tick \" & to_string(tick)
                    & \": {name}.expected has no line for it\");
            end if;
            readline(golden, text_line);
            hread(text_line, expected, good);
            if not good then
                fail(\"tick \" & to_string(tick)
                    & \": {name}.expected has no word of \"
                    & to_string(expected'length) & \" bits\");
            end if;
            if seen /= expected then
                -- The waves show what follows from the first difference.
                if differ = 0 then
{named}                end if;
                differ := differ + 1;
            end if;
"
            ),
            verdict: format!(
                "        if tick = 0 or not endfile(golden) then
            fail(\"{name}.expected is not of a run of \" & to_string(tick) & \" ticks\");
        end if;
        if differ /= 0 then
            fail(\"ports out differ in \" & to_string(differ) & \" of \" & to_string(tick)
                & \" ticks\");
        end if;
        print(\"PASS: ports out are as expected in all of \" & to_string(tick) & \" ticks\");
"
            ),
        }
    }
}
