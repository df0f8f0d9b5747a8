use super::zoo::{Part, Zoo, inputs, words};
use super::{SEED, clock, reader, run_zoo};
use motion_rtl::prelude::*;
use motion_rtl::sim::RunError;
use motion_rtl::trace::{Options, gtkw, replay};
use std::fs;
use std::io;

#[test]
fn a_replay_writes_the_dump_and_its_save_file() {
    let directory = tempfile::tempdir().unwrap();
    let inputs = inputs(SEED).take(50).map(|i| words(&i));
    let paths = replay(&Zoo, inputs, clock(), directory.path(), "zoo").unwrap();
    assert_eq!(
        paths,
        ["zoo.vcd", "zoo.gtkw"].map(|name| directory.path().join(name))
    );
    let (bytes, _) = run_zoo(50, &Options::default());
    assert!(fs::read(&paths[0]).unwrap() == bytes);
    let save = gtkw::save_file(&Zoo, clock(), &Options::default(), "zoo.vcd", 0..40).unwrap();
    assert_eq!(fs::read_to_string(&paths[1]).unwrap(), save);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 2);
}

#[test]
fn a_replay_makes_its_directory() {
    let outer = tempfile::tempdir().unwrap();
    let directory = outer.path().join("a/b");
    let inputs = |count| inputs(SEED).take(count).map(|i| words(&i));
    let wrong = inputs(1).chain([Vec::new()]);
    replay(&Zoo, wrong, clock(), &directory, "zoo").unwrap_err();
    assert_eq!(fs::read_dir(outer.path()).unwrap().count(), 0);
    replay(&Zoo, inputs(1), clock(), &directory, "zoo").unwrap();
    assert_eq!(fs::read_dir(&directory).unwrap().count(), 2);
}

/// The names of signals in a save file, without their ranges.
fn listed(save: &str) -> Vec<&str> {
    let names = save.lines().filter(|line| line.starts_with("zoo."));
    names.map(|line| line.split('[').next().unwrap()).collect()
}

#[test]
fn a_save_file_names_only_signals_of_its_dump() {
    let (bytes, _) = run_zoo(1, &Options::default());
    let dump = reader::read(&bytes);
    let save = gtkw::save_file(&Zoo, clock(), &Options::default(), "zoo.vcd", 0..50).unwrap();
    let listed = listed(&save);
    for name in &listed {
        assert!(dump.variables.contains_key(*name), "{name}");
    }
    let names = dump.variables.keys().map(String::as_str);
    let left_out = names.filter(|name| !listed.contains(name));
    let (words, states): (Vec<_>, Vec<_>) =
        left_out.partition(|name| name.starts_with("zoo.great.word"));
    assert_eq!(words.len(), 128);
    // Their names are listed.
    assert_eq!(states, ["zoo.left.phase", "zoo.right.phase"]);
}

/// A row with its display: path, flags, colour, fraction bits.
type Row<'a> = (&'a str, u32, u32, u32);

/// The rows of a save file that are signals, as GTKWave reads them.
fn rows<'a>(save: &'a str, circuit: &str) -> Vec<Row<'a>> {
    let (mut flags, mut color, mut fraction) = (0, 0, 0);
    let mut rows = Vec::new();
    for line in save.lines() {
        if let Some(hex) = line.strip_prefix('@') {
            flags = u32::from_str_radix(hex, 16).unwrap();
        } else if let Some(number) = line.strip_prefix("[color] ") {
            color = number.parse().unwrap();
        } else if let Some(number) = line.strip_prefix("[fpshift_count] ") {
            fraction = number.parse().unwrap();
        } else if line.starts_with(circuit) || line.starts_with("+{") {
            let path = line.split(['[', '}']).next().unwrap();
            // A colour is for one row; fraction bits stay, but count with their flag alone.
            let shown = if flags & 1 << 30 == 0 { 0 } else { fraction };
            rows.push((path, flags, std::mem::take(&mut color), shown));
        }
    }
    rows
}

signals! { for Lamp as _c;
    /// Ports in.
    pub struct LampIn { pub go: Bit, pub late_by: U(3, 3) }
    /// Registers.
    pub struct LampReg { pub lit: Bit, kept: Bit, pub part_late: Bit }
    /// Nets.
    pub struct LampNet { pub shown: Bit, inner: Bit, fault: Bit }
}

/// A circuit with a signal of each colour.
#[derive(Debug, Clone)]
struct Lamp;

impl Circuit for Lamp {
    const NAME: &'static str = "lamp";
    const ABOUT: &'static str = "is lit";
    records!(LampIn, LampReg, LampNet);

    fn tick(&self, i: LampIn, q: LampReg, _: Nothing) -> (LampNet, LampReg<Edge>) {
        let net = LampNet {
            shown: q.kept,
            inner: i.go,
            fault: i.late_by.bit(0),
        };
        let next = LampReg {
            lit: i.go,
            kept: q.lit,
            part_late: i.go,
        };
        (net, next)
    }
}

#[test]
fn a_row_has_the_colour_of_its_role_and_clk_follows_the_inputs() {
    let save = gtkw::save_file(&Lamp, clock(), &Options::default(), "lamp.vcd", 0..50).unwrap();
    let seen = rows(&save, "lamp.");
    let colors: Vec<_> = seen
        .iter()
        .map(|&(path, _, color, _)| (path, color))
        .collect();
    let [red, orange, yellow, green, violet] = [1, 2, 3, 4, 7];
    let expected = [
        ("lamp.go", yellow),
        // An error is a bit.
        ("lamp.late_by", yellow),
        ("lamp.clk", 0),
        ("lamp.lit", green),
        ("lamp.part_late", red),
        ("lamp.shown", green),
        ("lamp.kept", orange),
        ("lamp.inner", violet),
        ("lamp.fault", red),
    ];
    assert_eq!(colors, expected);
    let [_, late_by, ..] = seen[..] else { panic!() };
    assert_eq!(late_by, ("lamp.late_by", 0x4000_0024, yellow, 3));
    assert!(!save.contains("@200\n-\n-ports in"), "no empty first row");
}

#[test]
fn words_have_their_fraction_bits_and_states_their_names() {
    let save = gtkw::save_file(&Zoo, clock(), &Options::default(), "zoo.vcd", 0..50).unwrap();
    let rows = rows(&save, "zoo.");
    let fractions: Vec<_> = rows.iter().filter(|row| row.3 > 0).collect();
    assert_eq!(
        fractions,
        [
            &("zoo.amount", 0x4000_0420, 3, 5),
            &("zoo.count", 0x4000_8024, 4, 2)
        ]
    );
    let state = rows.iter().find(|row| row.0 == "zoo.left.phase_name");
    assert_eq!(state, Some(&("zoo.left.phase_name", 0x820, 4, 0)));
}

#[test]
fn the_overview_is_on_top_and_ends_with_clk() {
    let overview = ["count", "left.phase", "missing"];
    let options = Options::default();
    let save = gtkw::save_file_with(&Zoo, clock(), &options, "zoo.vcd", 0..50, &overview).unwrap();
    let expected = ["zoo.count", "+{left/phase_name", "zoo.clk", "zoo.reset"];
    let rows: Vec<_> = rows(&save, "zoo.").iter().map(|row| row.0).collect();
    assert_eq!(rows[..4], expected);
    let clks = rows.iter().filter(|path| **path == "zoo.clk").count();
    assert_eq!(clks, 1);
    assert!(
        save.contains("[sst_vpaned_height] 300\n@200\n-overview\n"),
        "{save}"
    );
}

/// A unit of 10 ns, a period of two units: GTKWave counts 20 a tick.
#[test]
fn the_window_starts_where_it_is_told() {
    let save =
        |focus| gtkw::save_file(&Zoo, clock(), &Options::default(), "zoo.vcd", focus).unwrap();
    assert!(save(10..20).contains("\n[timestart] 200\n"));
    let zoom = |save: String| -> f64 {
        let line = save
            .lines()
            .find_map(|line| line.strip_prefix('*'))
            .unwrap();
        line.split(' ').next().unwrap().parse().unwrap()
    };
    let halved = zoom(save(0..40)) - zoom(save(0..80));
    assert!((halved - 1.0).abs() < 1e-5, "{halved}");
}

#[test]
fn groups_are_closed_in_the_order_in_which_they_were_opened() {
    let save = gtkw::save_file(&Zoo, clock(), &Options::default(), "zoo.vcd", 0..50).unwrap();
    let (mut open, mut flags) = (Vec::new(), 0);
    for line in save.lines() {
        if let Some(hex) = line.strip_prefix('@') {
            flags = u32::from_str_radix(hex, 16).unwrap();
        } else if let Some(title) = line.strip_prefix('-') {
            if flags & 1 << 23 != 0 {
                open.push((title, flags & 1 << 22));
            } else if flags & 1 << 24 != 0 {
                assert_eq!(open.pop(), Some((title, flags & 1 << 22)));
            }
        }
    }
    assert!(open.is_empty());
}

#[test]
fn a_failed_replay_leaves_nothing() {
    let directory = tempfile::tempdir().unwrap();
    // `step` and `up`.
    let i = || [vec![1, 1]];
    let file = directory.path().join("file");
    fs::write(&file, "").unwrap();
    let nowhere = file.join("missing");
    let error = replay(&Part, i(), clock(), &nowhere, "part").unwrap_err();
    let kind = io::ErrorKind::NotADirectory;
    assert!(
        matches!(&error, RunError::Waves(error) if error.kind() == kind),
        "{error}"
    );
    assert!(error.to_string().contains("file/missing"), "{error}");
    fs::remove_file(file).unwrap();

    // The save file cannot take its name: a directory has it.
    fs::create_dir_all(directory.path().join("part.gtkw/full")).unwrap();
    replay(&Part, i(), clock(), directory.path(), "part").unwrap_err();
    let left: Vec<_> = fs::read_dir(directory.path())
        .unwrap()
        .map(|e| e.unwrap().file_name())
        .collect();
    assert_eq!(left, ["part.gtkw"]);
}
