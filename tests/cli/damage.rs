//! Damaged dumps: whatever byte is another one, a comparison ends soon, in little memory, and with a
//! verdict or a refusal.

use super::support::{Bench, LINE, PROGRAM, SHORT};
use rayon::prelude::*;
use std::fs;
use std::process::Command;

/// Address space in KiB, and seconds of processor time: beyond either the program is ended.
const MEMORY: u64 = 400_000;
const SECONDS: u64 = 5;

/// How a comparison ends within these.
fn compare(bench: &Bench, name: &str, other: &str) -> i32 {
    let script =
        format!("ulimit -c 0; ulimit -v {MEMORY}; ulimit -t {SECONDS}; exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, PROGRAM, "compare", name, other]);
    command.current_dir(bench.path("."));
    // One thread has one stack.
    command.env("RAYON_NUM_THREADS", "1");
    let status = command.output().expect("it starts").status;
    let code = status.code();
    code.unwrap_or_else(|| panic!("{name}: {status}"))
}

fn every_byte_of(format: &str, ends: &[i32]) {
    let bench = Bench::with("l.hpgl", LINE);
    let window = [
        "--from",
        "700",
        "--to",
        "720",
        "--only",
        "pulse_interpolator.x.sync",
    ];
    let run = ["run", "l.hpgl", "--out", "o", "--format", format];
    bench.succeed(&[&run[..], &window, &SHORT[..]].concat());
    let golden = format!("o/l.{format}");
    let whole = fs::read(bench.path(&golden)).unwrap();
    assert!((200..2000).contains(&whole.len()), "{}", whole.len());
    assert_eq!(compare(&bench, &golden, &golden), 0);
    let places: Vec<usize> = (0..whole.len()).collect();
    let codes: Vec<i32> = places
        .par_iter()
        .map(|&place| {
            let mut damaged = whole.clone();
            // Another one in every place, over all of them every bit turns over.
            damaged[place] ^= if place % 2 == 0 {
                0xff
            } else {
                1 << (place / 2 % 8)
            };
            let name = format!("o/{place}.{format}");
            bench.write(&name, &damaged);
            let code = compare(&bench, &name, &golden);
            assert!((0..=2).contains(&code), "byte {place}: {code}");
            code
        })
        .collect();
    // What is damaged is seen, and dates are not looked at.
    for code in ends {
        assert!(codes.contains(code), "no comparison ended with {code}");
    }
}

#[test]
#[ignore = "takes long"]
fn any_byte_of_an_fst() {
    every_byte_of("fst", &[0, 2]);
}

#[test]
#[ignore = "takes long"]
fn any_byte_of_a_vcd() {
    every_byte_of("vcd", &[0, 1, 2]);
}

#[test]
fn lengths_that_overflow_end_at_once() {
    let bench = Bench::with("golden.vcd", "$enddefinitions $end\n");
    bench.write("nine.vcd", [0xff; 9]);
    let refused = "neither VCD, FST nor GHW; allowed: a VCD, an FST or a GHW";
    assert_eq!(compare(&bench, "nine.vcd", "golden.vcd"), 2);
    let arguments = ["compare", "nine.vcd", "golden.vcd"];
    bench.refuse(&arguments, &format!("nine.vcd: file: {refused}"));
    // A header of the right length, and behind it sections as long as a number can be, and longer.
    for length in [1u64 << 63, u64::MAX, u64::MAX - 8, 0, 7] {
        let header = [&[0][..], &329u64.to_be_bytes(), &[0; 321]].concat();
        let section = [&[1][..], &length.to_be_bytes()].concat();
        bench.write("long.fst", [header, section].concat());
        assert_eq!(compare(&bench, "long.fst", "golden.vcd"), 2);
        let text = "long.fst: file: its sections do not fit together; allowed: a complete FST, from \
                    a simulator that has ended";
        bench.refuse(&["compare", "long.fst", "golden.vcd"], text);
    }
    for length in [0u64, 1 << 63, u64::MAX] {
        bench.write(
            "short.fst",
            [&[0][..], &length.to_be_bytes(), &[0; 400]].concat(),
        );
        assert_eq!(compare(&bench, "short.fst", "golden.vcd"), 2);
        let arguments = ["compare", "short.fst", "golden.vcd"];
        bench.refuse(&arguments, &format!("short.fst: file: {refused}"));
    }
}
