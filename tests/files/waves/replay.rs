use super::zoo::{Part, Zoo, inputs, words};
use super::{SEED, clock, reader, run_zoo};
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
    assert_eq!(listed[0], "zoo.clk");
    for name in &listed {
        assert!(dump.variables.contains_key(*name), "{name}");
    }
    let left_out: Vec<_> = dump
        .variables
        .keys()
        .filter(|name| !listed.contains(&name.as_str()))
        .collect();
    assert_eq!(left_out.len(), 128);
    assert!(
        left_out
            .iter()
            .all(|name| name.starts_with("zoo.great.word"))
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
