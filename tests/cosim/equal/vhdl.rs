//! Designs in VHDL.

use super::{Bench, design, replaced};
use std::fs;
use std::os::unix::fs::PermissionsExt;

#[test]
#[ignore = "needs Yosys and GHDL"]
fn vhdl_is_proved_equal_and_its_faults_differ() {
    let text = design("difference.vhd");
    let words = "equal differentiator difference.vhd --top Difference --param BITS=position";
    let said = Bench::with(&[("difference.vhd", &text)]).proves(words);
    let verdict = "proved equal at full width: differentiator and difference, from power-on, for all \
                   inputs\ncompared: 1 port out and 1 other signal\n";
    assert!(said.starts_with(verdict), "{said}");
    for (from, to) in [
        ("position - Lagged", "Lagged - position"),
        ("0) := (others => '0')", "0) := (others => '1')"),
        ("elsif load = '1'", "elsif load = '0'"),
    ] {
        let bench = Bench::with(&[("difference.vhd", &replaced(&text, from, to))]);
        bench.differs("differentiator", words);
    }
}

#[test]
#[ignore = "needs Yosys and GHDL"]
fn vhdl_that_ghdl_translates_wrongly_is_refused() {
    let text = design("difference.vhd");
    let words = "equal differentiator difference.vhd --top Difference";
    // GHDL 2.0 writes an arithmetic shift as a logical one.
    let shifted = replaced(
        &text,
        "<= position - Lagged",
        "<= shift_right(position, 1) - Lagged",
    );
    let (code, said) = Bench::with(&[("difference.vhd", &shifted)]).run(words);
    let told = "error: GHDL translates difference wrongly: in tick ";
    assert!(code == 2 && said.contains(told), "{code}: {said}");
    for (from, to, told) in [
        ("elsif load", "elsif lode", "DESIGN: GHDL: "),
        (
            "clk, rst, load, valid : in std_logic;",
            "clk, rst, load : in std_logic; valid : in boolean;",
            "DESIGN: ",
        ),
    ] {
        let (code, said) =
            Bench::with(&[("difference.vhd", &replaced(&text, from, to))]).run(words);
        assert!(code == 2 && said.contains(told), "{code}: {said}");
    }
}

#[test]
#[ignore = "needs Yosys and GHDL"]
fn a_translation_without_simulation_proves_nothing() {
    let text = design("difference.vhd");
    // Yosys without its simulation.
    let yosys = "#!/bin/sh\ncase $3 in *.random.ys) exit 1;; esac\nexec yosys \"$@\"\n";
    let bench = Bench::with(&[("difference.vhd", &text), ("yosys.sh", yosys)]);
    let program = bench.0.path().join("yosys.sh");
    fs::set_permissions(program, fs::Permissions::from_mode(0o755)).unwrap();
    let words = "equal differentiator difference.vhd --top Difference --yosys ./yosys.sh";
    let (code, said) = bench.run(words);
    let told = "is not held against GHDL's simulation";
    assert!(code == 2 && said.contains(told), "{code}: {said}");
}
