//! Verdicts on designs, and what happens if something does not fit.

use super::*;
use motion_rtl::registry;
use motion_rtl::vhdl::Vhdl;

/// Two enable counters with a fault that the command line chooses, their checkers, and a bench.
const BENCH: &str = "\
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity my_counter is
    generic (FAULT : string);
    port (
        clk, rst_n : in std_logic;
        length : in std_logic_vector(7 downto 0);
        tick : out std_logic
    );
end entity;
architecture rtl of my_counter is
    signal count : unsigned(7 downto 0) := (others => '0');
    signal over : boolean;
begin
    over <= count + 1 = unsigned(length) when FAULT = \"late\" else count + 1 >= unsigned(length);
    tick <= 'X' when FAULT = \"unknown\" and count = 5 else '1' when over else '0';
    process (clk) begin
        if rising_edge(clk) then
            count <= (others => '0')
                when over or (rst_n = '0' and FAULT /= \"deaf\") else count + 1;
        end if;
    end process;
end architecture;

library ieee;
use ieee.std_logic_1164.all;
use ieee.math_real.all;
use ieee.numeric_std.all;

entity bench is
    generic (FAULT : string := \"\"; DRIVE : string := \"\"; LEAVE : string := \"\");
end entity;
architecture simulation of bench is
    signal clk : std_logic := '0';
    signal rst_n : std_logic := '1';
    signal length, other : std_logic_vector(7 downto 0) := x\"01\";
    signal ticks : std_logic_vector(0 to 1);
begin
    pair : for index in 0 to 1 generate
        signal own : std_logic_vector(7 downto 0);
    begin
        own <= length when index = 0 else other;
        dut : entity work.my_counter
            generic map (FAULT => FAULT)
            port map (clk => clk, rst_n => rst_n, length => own, tick => ticks(index));
        check : entity work.enable_counter_checker
            generic map (FROM_POWER_ON => DRIVE = \"power_on\", LEAVE => LEAVE)
            port map (
                clk => clk, rst => not rst_n, period => unsigned(own), enable => ticks(index)
            );
    end generate;

    process
        variable first, second : positive := 1;
        impure function below(count : positive) return natural is
            variable random : real;
        begin
            uniform(first, second, random);
            return natural(trunc(random * real(count)));
        end function;
    begin
        if DRIVE = \"none\" then
            wait;
        end if;
        for cycle in 0 to 2000 loop
            wait for 5 ns;
            clk <= '1';
            wait for 5 ns;
            clk <= '0';
            rst_n <= '0' when DRIVE = \"\" and (cycle < 3 or below(100) = 0) else '1';
            if DRIVE = \"\" and below(10) = 0 then
                length <= std_logic_vector(to_unsigned(below(12), 8));
            elsif DRIVE = \"\" and FAULT /= \"one\" and below(10) = 0 then
                other <= std_logic_vector(to_unsigned(below(12), 8));
            end if;
            if FAULT = \"input\" and cycle = 1000 then
                length <= \"0000001U\";
            end if;
        end loop;
        std.env.stop;
    end process;
end architecture;
";

/// The lines with verdicts, without the names of the instances.
fn verdicts(text: &str) -> Vec<&str> {
    let lines = text.lines().filter_map(|line| line.split_once(": "));
    let is_verdict = |line: &&str| {
        ["PASS: ", "FAIL: ", "VACUOUS: "]
            .iter()
            .any(|word| line.starts_with(word))
    };
    lines.map(|(_, rest)| rest).filter(is_verdict).collect()
}

#[test]
#[ignore = "needs GHDL and the library of bindings/c"]
fn designs_are_judged() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let mut files = write(path, "enable_counter", "width=8", "libmotion_rtl.so");
    fs::write(path.join("bench.vhd"), BENCH).unwrap();
    files.push("bench.vhd".to_owned());
    analysed(path, &files);

    let (code, text) = plays(path, &[]);
    let equal = "PASS: 1999 values equal in 1999 ticks";
    assert_eq!((code, verdicts(&text)), (Some(0), vec![equal; 2]), "{text}");
    assert!(text.contains("bench.pair(1).check: PASS: "), "{text}");
    assert!(text.contains("moved, how often: period "), "{text}");

    // A fault in both designs: each says it, and the simulation fails at its end.
    for (fault, line) in [
        ("late", "  enable: design 0, model 1\n"),
        ("deaf", ": first difference in tick "),
        ("unknown", "  enable: design X (binary, unknown), model 0\n"),
    ] {
        let (code, text) = plays(path, &[&format!("-gFAULT={fault}")]);
        let failed = verdicts(&text);
        let fails = failed.len() == 2 && failed.iter().all(|line| line.starts_with("FAIL: "));
        assert!(code == Some(1) && fails && text.contains(line), "{text}");
        assert!(
            text.contains("ns: bench.pair(0).check: first difference"),
            "{text}"
        );
        for index in [0, 1] {
            let file = path.join(format!("bench.pair_{index}_.check.vcd"));
            assert!(fs::metadata(&file).unwrap().len() > 500);
            fs::remove_file(file).unwrap();
        }
    }

    // One of two is enough.
    let (code, text) = plays(path, &["-gFAULT=input"]);
    let stopped = ": input period is 0000001U (binary, unknown); the comparison stops here";
    let judged = verdicts(&text);
    assert!(code == Some(1) && text.contains(stopped), "{text}");
    assert!(
        judged[0].starts_with("FAIL: an unknown input has stopped"),
        "{text}"
    );
    assert_eq!(judged[1], equal, "{text}");
    let (code, text) = plays(path, &["-gFAULT=one"]);
    let still = "VACUOUS: no output port moved in ";
    let judged = verdicts(&text);
    assert!(code == Some(1) && judged[0] == equal, "{text}");
    assert!(judged[1].starts_with(still), "{text}");

    let reset = "rst was 1 in none of 2001 edges, so nothing was compared; FROM_POWER_ON \
                 (from_power_on in Python) compares from the first edge";
    for (generic, why) in [
        ("-gDRIVE=unreset", reset),
        ("-gDRIVE=power_on", "no output port moved in 2001 ticks"),
        ("-gDRIVE=none", "there was no clock edge"),
        ("-gLEAVE=enable", "no output port is compared"),
    ] {
        let (code, text) = plays(path, &[generic]);
        let expected = format!("VACUOUS: {why}");
        let expected = vec![expected.as_str(); 2];
        assert_eq!((code, verdicts(&text)), (Some(1), expected), "{text}");
    }
    let (code, text) = plays(path, &["-gLEAVE=enabel"]);
    assert_eq!(code, Some(1), "{text}");
    let unknown = "FAIL: bench.pair(0).check: ";
    assert!(text.contains(unknown) && text.contains("enabel"), "{text}");

    // The waves of the simulator are whole.
    let (_, text) = plays(path, &["-gFAULT=late", "--vcd=own.vcd"]);
    let waves = fs::read_to_string(path.join("own.vcd")).unwrap();
    assert!(waves.contains("\n#20005000000\n"), "{text}");
}

#[test]
#[ignore = "needs GHDL and the library of bindings/c"]
fn what_does_not_fit_is_said_at_the_start() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let bench = |library: &str, from: &str, to: &str| {
        let mut files = write(path, "enable_counter", "width=8", library);
        let checker = path.join(&files[1]);
        let text = fs::read_to_string(&checker).unwrap();
        assert!(text.contains(from), "{from}");
        fs::write(checker, text.replace(from, to)).unwrap();
        fs::write(path.join("bench.vhd"), BENCH).unwrap();
        files.push("bench.vhd".to_owned());
        analysed(path, &files);
        plays(path, &[])
    };
    // GHDL shows where it looks, and the line that says how the library is built.
    let (code, text) = bench("/nowhere/libmotion_rtl.so", "", "");
    assert_eq!(code, Some(1), "{text}");
    let sought = "cannot load VHPIDIRECT shared library '/nowhere/libmotion_rtl.so'";
    let built = "-- built by make -C bindings/c install PREFIX=DIR";
    assert!(text.contains(sought) && text.contains(built), "{text}");
    // A library that has no such functions.
    let (code, text) = bench("libc.so.6", "", "");
    assert_eq!(code, Some(1), "{text}");
    let missing = "cannot resolve VHPIDIRECT symbol 'mrtl_vhpi_new'";
    assert!(text.contains(missing), "{text}");

    let version = env!("CARGO_PKG_VERSION");
    let quoted = format!("\"{version}\"");
    let anew = "`motion-rtl vhdl enable_counter --vhpi` prints the checker anew";
    for (from, to, expected) in [
        (
            &*quoted,
            "\"0.0.1\"",
            "the checker is of motion-rtl 0.0.1 (VHPI 1), the library of",
        ),
        (
            "width=8\",",
            "width=9\",",
            "enable_counter has other ports than the checker is made for",
        ),
    ] {
        let (code, text) = bench("libmotion_rtl.so", from, to);
        assert_eq!(code, Some(1), "{text}");
        let begin = format!("FAIL: bench.pair(0).check: {expected}");
        assert!(text.contains(&begin) && text.contains(anew), "{text}");
        assert!(!text.contains("PASS"), "{text}");
    }
}

/// Bench that sets every input port of a circuit at random.
fn random_bench(circuit: &str, checker: &str) -> String {
    let entity = checker.split("\nentity ").nth(1).unwrap();
    let ports = entity.split("    port (\n").nth(1).unwrap();
    let ports = ports.split("\n    );").next().unwrap();
    let (mut declared, mut map, mut set) = (String::new(), Vec::new(), String::new());
    for line in ports.lines().filter(|line| line.contains(" : in ")) {
        let (code, comment) = line.split_once("--").unwrap();
        let (name, kind) = code.trim().split_once(':').unwrap();
        let (name, kind) = (name.trim(), kind.trim().trim_end_matches(';'));
        let kind = kind.trim_start_matches("in ");
        let value = match kind.contains('(') {
            true => "(others => '0')",
            false => "'0'",
        };
        declared += &format!("    signal {name} : {kind} := {value};\n");
        map.push(format!("{name} => {name}"));
        if comment.contains("Input: ") {
            set += &match kind.contains('(') {
                true => format!(
                    "            if one_in(4) = '1' then for bit in {name}'range loop\n                \
                     {name}(bit) <= one_in(2);\n            end loop; end if;\n"
                ),
                false => format!("            {name} <= one_in(2);\n"),
            };
        }
    }
    let clocked = map.iter().any(|port| port.starts_with("rst "));
    let rst = if clocked {
        "            rst <= one_in(100);\n"
    } else {
        ""
    };
    let of_dut = map
        .iter()
        .filter(|port| clocked || !port.starts_with("clk "));
    let of_dut: Vec<&str> = of_dut.map(String::as_str).collect();
    format!(
        "\
library ieee;
use ieee.std_logic_1164.all;
use ieee.math_real.all;
use ieee.numeric_std.all;
entity bench is end entity;
architecture simulation of bench is
{declared}begin
    dut : entity work.{circuit} port map ({});
    check : entity work.{circuit}_checker
        generic map (FROM_POWER_ON => true) port map ({});
    process
        variable first, second : positive := 1;
        impure function one_in(count : positive) return std_logic is
            variable random : real;
        begin
            uniform(first, second, random);
            if random * real(count) < 1.0 then
                return '1';
            end if;
            return '0';
        end function;
    begin
        for cycle in 1 to 1000 loop
            wait for 5 ns;
            clk <= '1';
            wait for 5 ns;
            clk <= '0';
{rst}{set}        end loop;
        wait;
    end process;
end architecture;
",
        of_dut.join(", "),
        map.join(", ")
    )
}

/// Exported circuits from power-on, with random inputs: 64 bits, signs, many ports, no registers.
/// The highest bit of an output port is inverted then.
#[test]
#[ignore = "needs GHDL and the library of bindings/c"]
fn exported_circuits_pass_and_one_wrong_bit_fails() {
    for (circuit, port) in [
        ("accumulator", "addend"),
        ("linear_interpolator", "x"),
        ("placement", "compared_target"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        let vhdl: Vhdl = registry::find(circuit).unwrap().full().vhdl().unwrap();
        let mut files = Vec::new();
        for source in vhdl.sources() {
            fs::write(path.join(&source.name), &source.text).unwrap();
            files.push(source.name);
        }
        files.extend(write(path, circuit, "", "libmotion_rtl.so"));
        let checker = fs::read_to_string(path.join(format!("{circuit}_checker.vhd"))).unwrap();
        let bench = random_bench(circuit, &checker);
        fs::write(path.join("bench.vhd"), &bench).unwrap();
        files.push("bench.vhd".to_owned());
        analysed(path, &files);
        let options = ["--ieee-asserts=disable-at-0"];
        let (code, text) = plays(path, &options);
        assert_eq!((code, verdicts(&text).len()), (Some(0), 1), "{text}");
        assert!(verdicts(&text)[0].starts_with("PASS: "), "{text}");

        let line = checker
            .lines()
            .find(|line| line.contains(&format!("logic_vector({port});")));
        let line = line.unwrap_or_else(|| panic!("{circuit} has no port {port}: {checker}"));
        let first = line
            .split(['(', ' '])
            .find(|word| word.parse::<usize>().is_ok())
            .unwrap();
        let wrong = format!("{line}\nmrtl_ports({first}) := not mrtl_ports({first});");
        let name = format!("{circuit}_checker.vhd");
        fs::write(path.join(&name), checker.replace(line, &wrong)).unwrap();
        analysed(path, &files);
        let (code, text) = plays(path, &options);
        assert!(
            code == Some(1) && text.contains(&format!("  {port}: design ")),
            "{text}"
        );
    }
}
