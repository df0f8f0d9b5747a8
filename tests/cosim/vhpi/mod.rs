//! Checkers in VHDL, in GHDL with the library of `bindings/c`.

mod verdicts;

use super::dpi::{CHECKOUT, PAGE, blocks, ended, folder_of_the_page, library, run, shell};
use motion_rtl::Model;
use motion_rtl::registry::Pair;
use motion_rtl::vhdl::VhpiChecker;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Writes the files of a checker, which GHDL opens with a library; returns their names.
fn write(folder: &Path, circuit: &str, settings: &str, library: &str) -> Vec<String> {
    let pairs: Vec<Pair> = settings.lines().map(|pair| pair.parse().unwrap()).collect();
    let model = Model::new(circuit, &pairs).unwrap();
    let checker = VhpiChecker::new(&model, settings, library.parse().unwrap());
    let names = checker.sources().into_iter().map(|source| {
        fs::write(folder.join(&source.name), source.text).unwrap();
        source.name
    });
    names.collect()
}

/// Analyses files; the warnings of GHDL are errors.
#[track_caller]
fn analysed(folder: &Path, files: &[String]) {
    let mut ghdl = Command::new("ghdl");
    ghdl.args(["-a", "--std=08", "--warn-error", "-Wunused", "-Wbody"]);
    run(ghdl.args(files).current_dir(folder));
}

/// Runs the entity `bench` with arguments.
fn plays(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut ghdl = Command::new("ghdl");
    ghdl.args(["-r", "--std=08", "bench"]).args(arguments);
    ended(ghdl.current_dir(folder).env("LD_LIBRARY_PATH", library()))
}

#[test]
#[ignore = "needs GHDL and the library of bindings/c"]
fn the_commands_of_the_page_end_with_a_pass_and_a_fault_is_found() {
    let page = PAGE.split("\n## VHDL\n").nth(1).unwrap();
    let blocks = blocks(page.split("\n## ").next().unwrap());
    let [("sh", commands), ("text", pass), ("text", first)] = blocks[..] else {
        panic!("{blocks:?}");
    };
    let lines: Vec<&str> = commands.lines().collect();
    assert_eq!(lines.len(), 5);
    assert!(lines[0].starts_with("apt-get install"));
    let folder = folder_of_the_page();
    // Without what needs root.
    let (code, text) = shell(folder.path(), &lines[1..].join("\n"));
    assert!(code == Some(0) && text.contains(pass), "{text}");

    let design = fs::read_to_string(format!("{CHECKOUT}/rtl_notes/golden_model/touch_probe.vhd"));
    let (from, to) = ("active and (q.taken or first)", "q.taken or first");
    let design = design.unwrap();
    assert!(design.contains(from));
    fs::write(folder.path().join("faulty.vhd"), design.replace(from, to)).unwrap();
    let analyse = lines[3].replace("rtl_notes/golden_model/touch_probe.vhd", "faulty.vhd");
    let (code, text) = shell(folder.path(), &format!("{analyse}\n{}", lines[4]));
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains(first), "{text}");
    for extension in ["vcd", "gtkw"] {
        let file = format!("touch_probe_bench.check.{extension}");
        assert!(fs::metadata(folder.path().join(file)).unwrap().len() > 500);
    }
}
