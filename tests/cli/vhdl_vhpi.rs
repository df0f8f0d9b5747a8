//! `vhdl --vhpi`: its files, and its refusals. `cosim` runs them.

use super::support::{Bench, without_sizes};

const UNIT_LAW: [&str; 7] = ["vhdl", "unit_law", "--width", "16", "--vhpi", "--out", "v"];

#[test]
fn a_package_and_a_checker_are_written_beside_the_circuit() {
    let bench = Bench::new();
    let said = bench.succeed(&UNIT_LAW);
    let files = [
        "v/motion_rtl_pkg.vhd",
        "v/unit_law_checker.vhd",
        "v/unit_law_checker_vhdl.f",
    ];
    assert_eq!(without_sizes(&said), files.join("\n") + "\n");
    let list = "// Made by motion-rtl: vhdl unit_law --width 16 --vhpi\n\
                motion_rtl_pkg.vhd\nunit_law_checker.vhd\n";
    assert_eq!(bench.read(files[2]), list);
    let package = bench.read(files[0]);
    assert!(
        package.contains("\"VHPIDIRECT libmotion_rtl.so mrtl_vhpi_new\""),
        "{package}"
    );
    let checker = bench.read(files[1]);
    for line in [
        "        step        : in std_logic              -- Output: ",
        "            mrtl_ports(1 to 16) := std_ulogic_vector(half_period);\n",
        "            mrtl_ports(33) := step;\n",
        "            \"width=16\",\n",
    ] {
        assert!(checker.contains(line), "{line}: {checker}");
    }
    // The checker in SystemVerilog, the circuit, and another circuit have room beside it.
    bench.succeed(&["verilog", "unit_law", "--dpi", "--out", "v"]);
    bench.succeed(&["vhdl", "unit_law", "--width", "16", "--out", "v"]);
    bench.succeed(&["vhdl", "enable_counter", "--vhpi", "--out", "v"]);
    bench.succeed(&UNIT_LAW);
}

#[test]
fn the_library_stands_in_the_package() {
    let bench = Bench::new();
    bench.succeed(&[&UNIT_LAW[..], &["--library", "/opt/c/libm.so"]].concat());
    let package = bench.read("v/motion_rtl_pkg.vhd");
    for symbol in ["new", "edge", "text"] {
        let foreign = format!("\"VHPIDIRECT /opt/c/libm.so mrtl_vhpi_{symbol}\"");
        assert!(package.contains(&foreign), "{package}");
    }
    let longest = format!("/{}.so", "a".repeat(28));
    bench.succeed(&[&UNIT_LAW[..], &["--library", &longest]].concat());
    let longer = format!("{longest}6");
    for library in ["", "a b.so", "a\".so", "é.so", &longer] {
        let done = bench.run(&[&UNIT_LAW[..], &["--library", library]].concat());
        let problem =
            format!("GHDL does not take {library:?} as a library; allowed: up to 32 ASCII");
        assert!(
            done.code == 2 && done.stderr.contains(&problem),
            "{}",
            done.stderr
        );
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let bench = Bench::new();
    for more in [
        &["--testbench", "10"][..],
        &["--reset", "a"],
        &["--seed", "2"],
        &["--skip", "1"],
    ] {
        let done = bench.run(&[&UNIT_LAW[..], more].concat());
        assert_eq!(done.code, 2, "{more:?}: {}", done.stderr);
    }
    let done = bench.run(&["vhdl", "unit_law", "--library", "a.so", "--out", "v"]);
    assert_eq!(done.code, 2);
    assert!(done.stderr.contains("--vhpi"), "{}", done.stderr);
}
