//! Composites, and faults in their parts and connections.

use super::{BUSY, Bench, printed, replaced};
use std::fs;

#[test]
#[ignore = "needs Yosys"]
fn composites_are_proved_part_by_part() {
    for (words, parts) in [
        (
            INTERPOLATOR,
            "controller, counter, divider, unit_time, x, y",
        ),
        ("difference_engine", "d1, d2, d3, d4, value"),
    ] {
        let bench = Bench::with(&[]);
        let files = printed(&bench, words);
        let said = bench.proves(&format!("equal {words} {files} --parts"));
        let told = format!("\npart by part: {parts}, and their connections\n");
        assert!(said.contains(&told), "{said}");
    }
}

/// A circuit with parts, in small words.
const INTERPOLATOR: &str = "conventional_pulse_interpolator --set widths.period=10 --set \
                            widths.units=3 --set widths.distance=3 --set widths.half_period=3";

/// Plants a fault in a file of the circuit's printed Verilog; returns the bench and its files.
#[track_caller]
fn planted(words: &str, file: &str, from: &str, to: &str) -> (Bench, String) {
    let bench = Bench::with(&[]);
    let files = printed(&bench, words);
    let path = bench.0.path().join("own").join(file);
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, replaced(&text, from, to)).unwrap();
    (bench, files)
}

#[test]
#[ignore = "needs Yosys"]
fn faults_in_parts_and_in_connections_differ() {
    let top = "conventional_pulse_interpolator.v";
    for (file, from, to) in [
        (
            top,
            ".half_period (controller_x_half_period),",
            ".half_period (controller_y_half_period),",
        ),
        (
            top,
            ".take        (controller_prepared)",
            ".take        (1'b1)",
        ),
        (
            top,
            ".down        (controller_y_down)",
            ".down        (controller_x_down)",
        ),
        ("enable_counter.v", "= next >= period", "= next > period"),
        (
            "mul_div.v",
            "undivided <= product_only",
            "undivided <= !product_only",
        ),
    ] {
        let (bench, files) = planted(INTERPOLATOR, file, from, to);
        let words = format!("equal {INTERPOLATOR} {files} --parts {BUSY}");
        bench.differs("conventional_pulse_interpolator", &words);
    }
}

/// The first unit time takes 1000 ticks, and a later one may take 2^24: the inputs have to be such
/// that moves come to their pulses in time.
#[test]
#[ignore = "needs Yosys"]
fn wrong_connections_differ_at_full_width() {
    let circuit = "conventional_pulse_interpolator";
    for (from, to) in [
        (
            ".down        (controller_y_down)",
            ".down        (controller_x_down)",
        ),
        ("? controller_y_amount", "? controller_x_amount"),
        (
            ".half_period (controller_x_half_period),",
            ".half_period (controller_y_half_period),",
        ),
    ] {
        let (bench, files) = planted(circuit, &format!("{circuit}.v"), from, to);
        bench.differs(circuit, &format!("equal {circuit} {files} {BUSY}"));
    }
}

#[test]
#[ignore = "needs Yosys"]
fn a_value_that_comes_late_is_not_proved_along() {
    // The period is 1000 at power-on; it is 0 after a first command, if at all.
    let never_zero = "= next >= period && period != 0";
    let fault = ("enable_counter.v", "= next >= period", never_zero);
    let (bench, files) = planted(INTERPOLATOR, fault.0, fault.1, fault.2);
    let (code, said) = bench.run(&format!("equal {INTERPOLATOR} {files} --limit-seconds 20"));
    assert!(code != 0 && !said.contains("proved equal"), "{said}");
}

#[test]
#[ignore = "needs Yosys"]
fn a_map_pairs_registers_of_parts_but_not_of_two() {
    let words = "unit_law --width 4";
    let renamed = "[signals]\n\"counter.count\" = \"counter.ticks\"\n";
    let bench = Bench::with(&[("names.toml", renamed)]);
    let files = printed(&bench, words);
    let counter = bench.0.path().join("own/enable_counter.v");
    let text = fs::read_to_string(&counter).unwrap();
    let text = text
        .split("`ifdef")
        .next()
        .unwrap()
        .replace("count", "ticks")
        + "endmodule\n";
    fs::write(counter, text.replace("enable_ticks", "enable_count")).unwrap();
    let words = format!("equal {words} {files} --map names.toml --parts");
    let said = bench.proves(&words);
    let told = "\npart by part: counter, generator, sync, and their connections\n";
    assert!(said.contains(told), "{said}");
    let top = bench.0.path().join("own/unit_law.v");
    let text = fs::read_to_string(&top).unwrap();
    let inverted = "    wire step_n = ~sync_step;\nendmodule\n";
    fs::write(top, text.replace("endmodule\n", inverted)).unwrap();
    let across = renamed.to_owned() + "\"sync.step\" = \"!step_n\"\n";
    fs::write(bench.0.path().join("names.toml"), across).unwrap();
    let said = bench.proves(&words);
    let told = "\nproved as a whole, not part by part: no part has both sync.step and step_n of \
                the design\n";
    assert!(said.contains(told), "{said}");
}
