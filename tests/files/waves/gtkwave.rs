//! GTKWave itself reads what is written for it.

use super::zoo::{Zoo, inputs, words};
use super::{SEED, clock, fst, reader, run_zoo};
use motion_rtl::compare::{Settings, compare};
use motion_rtl::hdl::Declaration;
use motion_rtl::netlist::{Format, Kind};
use motion_rtl::trace::{Options, Recorder, replay};
use std::fs;
use std::path::Path;
use std::process::Command;

const TICKS: u64 = 60;
const LOOK: [u64; 4] = [0, 7, 31, 59];

/// Says every row on display and its value at some times, takes a picture and leaves.
const SCRIPT: &str = "
set rows [gtkwave::getTotalNumTraces]
foreach time {TIMES} {
    gtkwave::setMarker $time
    for {set row 0} {$row < $rows} {incr row} {
        set name [gtkwave::getTraceNameFromIndex $row]
        puts \"ROW|$time|$name|[gtkwave::getTraceValueAtMarkerFromIndex $row]\"
    }
}
gtkwave::/File/Grab_To_File {PICTURE}
gtkwave::/File/Quit
";

/// A value as GTKWave shows it in the format of the save file.
fn shown(leaf: &Declaration, bits: u64) -> String {
    let width = leaf.shape.width;
    match (leaf.shape.kind, leaf.field.format) {
        (Kind::Bit, _) => bits.to_string(),
        (_, Format::Hex) => format!("{bits:0digits$X}", digits = width.div_ceil(4)),
        (kind, _) => {
            let number = match kind {
                Kind::Signed => i128::from((bits << (64 - width)) as i64 >> (64 - width)),
                _ => bits.into(),
            };
            match leaf.fraction {
                0 => number.to_string(),
                fraction => (number as f64 / (1_u64 << fraction) as f64).to_string(),
            }
        }
    }
}

/// The rows of a save file: paths without ranges; comments and blank rows are `None`.
fn rows(save: &str) -> Vec<Option<&str>> {
    let traces = save
        .lines()
        .filter(|line| line.starts_with("zoo.") || line.starts_with('-'));
    traces
        .map(|line| (!line.starts_with('-')).then(|| line.split('[').next().unwrap_or(line)))
        .collect()
}

/// Shows a save file in GTKWave, started elsewhere than where the files are.
fn show(directory: &Path, save: &Path, picture: &str) -> String {
    let elsewhere = directory.join("elsewhere");
    fs::create_dir_all(&elsewhere).unwrap();
    // A tick of 20 ns; GTKWave counts in ns.
    let times = LOOK.map(|tick| (20 * tick).to_string()).join(" ");
    let picture = directory.join(picture);
    let script = directory.join("look.tcl");
    let text = SCRIPT.replace("TIMES", &times);
    fs::write(&script, text.replace("PICTURE", picture.to_str().unwrap())).unwrap();
    let output = Command::new("timeout")
        .args(["60", "xvfb-run", "-a", "-s", "-screen 0 1700x1000x24"])
        .args(["gtkwave", "-S"])
        .args([&script, save])
        .current_dir(&elsewhere)
        .output()
        .expect("GTKWave and xvfb are installed");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let all = format!("{text}\n{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{all}");
    assert!(!all.to_lowercase().contains("not found"), "{all}");
    all
}

#[test]
#[ignore = "needs GTKWave and xvfb"]
fn gtkwave_shows_every_signal_of_the_save_file_with_its_values() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("gtkwave");
    fs::create_dir_all(&directory).unwrap();
    let inputs = inputs(SEED).take(TICKS as usize).map(|i| words(&i));
    let paths = replay(&Zoo, inputs, clock(), &directory, "zoo").unwrap();
    show(&directory, &paths[1], "as_saved.png");

    // Rows of closed groups have no values: open them all.
    let save = fs::read_to_string(&paths[1]).unwrap();
    let opened = save
        .replace("@c00200", "@800200")
        .replace("@1401200", "@1000200");
    assert_ne!(opened, save);
    let open = directory.join("open.gtkw");
    fs::write(&open, &opened).unwrap();
    let seen = show(&directory, &open, "open.png");

    let rows = rows(&opened);
    let (_, recorder) = run_zoo(TICKS, &Options::default());
    let mut compared = 0;
    for tick in LOOK {
        let prefix = format!("ROW|{}|", 20 * tick);
        let shown: Vec<_> = seen
            .lines()
            .filter_map(|line| line.strip_prefix(&prefix))
            .collect();
        assert_eq!(shown.len(), rows.len(), "{seen}");
        for (row, shown) in rows.iter().zip(shown) {
            let (name, value) = shown.split_once('|').unwrap();
            let Some(path) = row else { continue };
            let name = name.split('[').next().unwrap();
            assert!(path.ends_with(&format!(".{name}")), "{path}: {shown}");
            assert_eq!(
                value,
                expected(&recorder, tick, path),
                "{path} at tick {tick}"
            );
            compared += 1;
        }
    }
    assert_eq!(compared, LOOK.len() * rows.iter().flatten().count());
    assert!(compared > 200, "{compared}");
}

/// Returns the value that GTKWave shows for a signal or a state's name.
fn expected(recorder: &Recorder, tick: u64, path: &str) -> String {
    if path == "zoo.clk" {
        return "1".to_owned();
    }
    let of_state = path.strip_suffix("_name").unwrap_or(path);
    let leaf = &recorder.leaves()[recorder.index(of_state).unwrap()];
    let bits = recorder.at(tick, of_state).unwrap();
    match leaf.field.format {
        Format::States(names) if of_state != path => names
            .get(bits as usize)
            .map_or(bits.to_string(), |&name| name.to_owned()),
        _ => shown(leaf, bits),
    }
}

/// GTKWave's own library reads the FST and writes it as a VCD.
#[test]
#[ignore = "needs GTKWave"]
fn fst2vcd_makes_the_vcd_of_the_fst() {
    let directory = tempfile::tempdir().unwrap();
    let [ours, file, theirs] =
        ["ours.vcd", "zoo.fst", "theirs.vcd"].map(|name| directory.path().join(name));
    let [vcd, fst] = fst::both(fst::TICKS, clock(), &Options::default());
    fs::write(&ours, &vcd).unwrap();
    fs::write(&file, fst).unwrap();
    let output = Command::new("fst2vcd")
        .arg(&file)
        .output()
        .expect("GTKWave is installed");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    fs::write(&theirs, &output.stdout).unwrap();
    let report = compare(&ours, &theirs, &Settings::default()).unwrap();
    assert!(report.is_equal(), "{report}");
    assert_eq!(report.ticks, fst::TICKS, "{report}");
    assert_eq!(report.without_partner, Vec::<String>::new(), "{report}");
    // Names of states, which are not compared there.
    let [ours, theirs] = [&vcd, &output.stdout].map(|bytes| reader::read(bytes).variables);
    let names = ours.keys().filter(|path| path.ends_with("_name"));
    for path in names.clone() {
        assert!(ours[path].changes == theirs[path].changes, "{path}");
    }
    assert_eq!(names.count(), 2);
}
