//! `verilog --dpi`: its files, and its refusals. `cosim` runs them.

use super::support::{Bench, without_sizes};

const UNIT_LAW: [&str; 7] = [
    "verilog", "unit_law", "--width", "16", "--dpi", "--out", "v",
];

const MAP: &str = "\
leave = [\"unit_law.step\"]
[signals]
\"unit_law.half_period\" = \"tb.dut.bus[31:16]\"
\"unit_law.period\" = \"!tb.dut.limit\"
\"unit_law.counter.count\" = \"tb.dut.u_timer.cnt\"
";

fn checker<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&UNIT_LAW[..], more].concat()
}

#[test]
fn a_package_a_checker_and_its_binding_are_written() {
    let bench = Bench::new();
    let said = bench.succeed(&checker(&[]));
    let files = [
        "v/motion_rtl_pkg.sv",
        "v/unit_law_checker.sv",
        "v/unit_law_bind.sv",
        "v/unit_law_checker.f",
    ];
    assert_eq!(without_sizes(&said), files.join("\n") + "\n");
    assert_eq!(bench.names().len(), 5);
    let list = "// Made by motion-rtl: verilog unit_law --width 16 --dpi\n\
                motion_rtl_pkg.sv\nunit_law_checker.sv\nunit_law_bind.sv\n";
    assert_eq!(bench.read(files[3]), list);
    let module = bench.read(files[1]);
    let version = env!("CARGO_PKG_VERSION");
    let new =
        format!("mrtl_dpi_new(1, \"{version}\",\n            \"unit_law\", \"width=16\", 64'h");
    assert!(module.contains(&new), "{module}");
    for line in [
        "                {32'd0, period, half_period},\n",
        "    parameter int mrtl$bits [3] = '{16, 16, 1}\n",
        "        mrtl$fits(\"step\", 1, mrtl$bits[2]);\n",
    ] {
        assert!(module.contains(line), "{line}: {module}");
    }
    let bind = "\
// Puts unit_law_checker into every instance of unit_law.
bind unit_law unit_law_checker #(
    .mrtl$bits ('{
        $bits(half_period),
        $bits(period),
        $bits(step)
    })
) mrtl_checker (
    .clk (clk),
    .rst (rst),
    .half_period (half_period),
    .period (period),
    .step (step)
);
";
    assert_eq!(bench.read(files[2]), bind);
    // Another circuit shares the package.
    bench.succeed(&["verilog", "enable_counter", "--dpi", "--out", "v"]);
    assert_eq!(bench.names().len(), 8);
}

#[test]
fn the_binding_has_the_names_of_the_design() {
    let bench = Bench::with("map.toml", MAP);
    let own = [
        "--map", "map.toml", "--module", "channel", "--clock", "ck", "--reset", "!rst_n",
    ];
    bench.succeed(&checker(&own));
    let bind = "\
bind channel unit_law_checker #(
    .mrtl$bits ('{
        $bits(bus[31:16]),
        $bits(~limit)
    })
) mrtl_checker (
    .clk (ck),
    .rst (~rst_n),
    .half_period (bus[31:16]),
    .period (~limit)
);
";
    assert!(bench.read("v/unit_law_bind.sv").ends_with(bind));
    let module = bench.read("v/unit_law_checker.sv");
    assert!(module.contains(", \"step\",\n"), "{module}");
    bench.succeed(&checker(&["--reset", "none"]));
    let bind = bench.read("v/unit_law_bind.sv");
    assert!(
        bind.contains("unit_law_checker #(\n    .FROM_POWER_ON (1'b1),\n    .mrtl$bits ('{\n"),
        "{bind}"
    );
    assert!(bind.contains("    .rst (1'b0),\n"), "{bind}");
    bench.succeed(&checker(&["--from-power-on"]));
    let bind = bench.read("v/unit_law_bind.sv");
    assert!(
        bind.contains("#(\n    .FROM_POWER_ON (1'b1),\n") && bind.contains(".rst (rst)"),
        "{bind}"
    );
}

#[test]
fn a_circuit_without_registers_is_bound_to_a_clock_that_is_named() {
    let bench = Bench::new();
    let placement = ["verilog", "placement", "--dpi", "--out", "v"];
    let said = bench.succeed(&placement);
    assert!(
        said.starts_with("placement has no clock: instantiate placement_checker in your bench"),
        "{said}"
    );
    assert_eq!(bench.names().len(), 4);
    assert!(!bench.read("v/placement_checker.sv").contains(" rst"));
    bench.succeed(&[&placement[..], &["--clock", "tick"]].concat());
    assert!(
        bench
            .read("v/placement_bind.sv")
            .contains("(\n    .clk (tick),\n    .position")
    );
}

#[test]
fn what_does_not_fit_is_refused() {
    let bench = Bench::with("map.toml", MAP.replace(".period", ".perod"));
    let ports = "unit_law.half_period, unit_law.period, unit_law.step";
    bench.refuse(
        &checker(&["--map", "map.toml"]),
        &format!(
            "map.toml:4: unit_law.perod: no signal of unit_law is called so; allowed: {ports}"
        ),
    );
    let identifiers = "allowed: letters, digits, _ and $, with a letter or _ first";
    for (option, value, name) in [
        ("--module", "a b", "a b"),
        ("--clock", "1k", "1k"),
        ("--reset", "!", ""),
    ] {
        bench.refuse(
            &checker(&[option, value]),
            &format!("{option}: {name:?} is no name in Verilog; {identifiers}"),
        );
    }
    for alone in [["--module", "a"], ["--reset", "a"], ["--map", "map.toml"]] {
        let done = bench.run(&[&["verilog", "unit_law", "--out", "v"], &alone[..]].concat());
        assert_eq!(done.code, 2, "{alone:?}");
        assert!(done.stderr.contains("--dpi"), "{}", done.stderr);
    }
    for more in [["--testbench", "10"], ["--seed", "2"], ["--skip", "1"]] {
        let done = bench.run(&checker(&more));
        assert_eq!(done.code, 2, "{more:?}: {}", done.stderr);
    }
    // A file of somebody's own stays.
    bench.write(
        "v/motion_rtl_pkg.sv",
        "package motion_rtl_pkg; endpackage\n",
    );
    bench.refuse(
        &checker(&[]),
        "--out: v/motion_rtl_pkg.sv is there, of no export of this directory; that of `verilog \
         unit_law --width 16 --dpi` is another; allowed: a directory for each, or to remove the file",
    );
}
