use super::*;
use crate::netlist::{BIT, signed, unsigned};

fn ports() -> [InputPort; 4] {
    let port = |name: &str, shape| InputPort {
        name: name.to_owned(),
        verilog: name.replace('.', "_"),
        shape,
    };
    [
        port("push", BIT),
        port("target_x", signed(32)),
        port("rates.speed", unsigned(16)),
        port("wide", unsigned(64)),
    ]
}

fn csv(text: &str) -> Result<PortInputs, String> {
    read_csv("a.csv", text.as_bytes(), &ports()).map_err(all)
}

fn words(text: &str) -> Result<PortInputs, String> {
    read_words("a.stimulus", text.as_bytes(), &ports()).map_err(all)
}

/// Every fault with what its caret marks.
fn all(fault: Fault) -> String {
    let lines = fault.all().map(|fault| {
        let marked = fault.excerpt.as_ref();
        let marked = marked.map(|excerpt| &excerpt.text[excerpt.marked.clone()]);
        format!("{fault} [{}]", marked.unwrap_or("-"))
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn a_table_gives_each_port_its_column() {
    let text = "\u{feff}# inputs\r\n rates_speed,rst , target_x,push\r\n\r\n0x_ff,1,-3,0\r\n0B11, 0, 0xFFFF_FFFE , 1\r\n";
    let inputs = csv(text).unwrap();
    assert_eq!(
        (inputs.ticks(), &inputs.low[..]),
        (2, &["wide".to_owned()][..])
    );
    assert_eq!(inputs.tick(0), Some((&[0, 0xffff_fffd, 255, 0][..], true)));
    assert_eq!(inputs.tick(1), Some((&[1, 0xffff_fffe, 3, 0][..], false)));
    assert_eq!(inputs.tick(2), None);
}

#[test]
fn the_greatest_numbers_fit_and_the_next_do_not() {
    let head = "wide,target_x,rates.speed,push\n";
    let fits = "18446744073709551615,2147483647,65535,1\n0,-2147483648,0xffff,0b1\n";
    let inputs = csv(&format!("{head}{fits}")).unwrap();
    let first = [1, 0x7fff_ffff, 0xffff, u64::MAX];
    assert_eq!(inputs.tick(0), Some((&first[..], false)));
    let error = csv(&format!("{head}{fits}18446744073709551616,0,0,0\n0,2147483648,0,0\n0,-2147483649,0,0\n0,0,0x1_0000,0\n0,0,-1,0\n0,0,0,2\n")).unwrap_err();
    let speed = "allowed: 0 to 65535, or bits as 0x1f and 0b101";
    let x = "allowed: -2147483648 to 2147483647, or bits as 0x1f and 0b101";
    let expected = [
        "a.csv:4: column 1, wide: 18446744073709551616 does not fit; allowed: 0 to 18446744073709551615, or bits as 0x1f and 0b101 [18446744073709551616]".to_owned(),
        format!("a.csv:5: column 2, target_x: 2147483648 does not fit; {x} [2147483648]"),
        format!("a.csv:6: column 2, target_x: -2147483649 does not fit; {x} [-2147483649]"),
        format!("a.csv:7: column 3, rates.speed: 0x1_0000 has more than 16 bits; {speed} [0x1_0000]"),
        format!("a.csv:8: column 3, rates.speed: -1 does not fit; {speed} [-1]"),
        "a.csv:9: column 4, push: 2 does not fit; allowed: 0 to 1, or bits as 0x1f and 0b101 [2]".to_owned(),
    ];
    assert_eq!(error.lines().collect::<Vec<_>>(), expected);
}

#[test]
fn a_wrong_head_is_refused_with_all_its_faults() {
    let names = "allowed: each at most once: push, target_x, rates.speed, wide, rst";
    let error = csv("push,targt_x,rst,push,\n0,0,0,0,0\n").unwrap_err();
    let expected = [
        format!(
            "a.csv:1: column 2, targt_x: no input port is called so; did you mean target_x?; {names} [targt_x]"
        ),
        format!("a.csv:1: column 4, push: a second column of this port; {names} [push]"),
        format!("a.csv:1: column 5, : no input port is called so; {names} []"),
    ];
    assert_eq!(error.lines().collect::<Vec<_>>(), expected);
}

#[test]
fn lines_that_are_no_inputs_are_refused() {
    let error = csv("push,wide\n0,0\n1\n1,2,3\nx,0\n,0\n0,0x\n0,1.5\n").unwrap_err();
    let bit = "allowed: 0 to 1, or bits as 0x1f and 0b101";
    let wide = "allowed: 0 to 18446744073709551615, or bits as 0x1f and 0b101";
    let expected = [
        "a.csv:3: line: 1 field; allowed: 2 as in the head [1]".to_owned(),
        "a.csv:4: line: 3 fields; allowed: 2 as in the head [1,2,3]".to_owned(),
        format!("a.csv:5: column 1, push: is 'x'; {bit} [x]"),
        format!("a.csv:6: column 1, push: is ''; {bit} [,]"),
        format!("a.csv:7: column 2, wide: is '0x'; {wide} [0x]"),
        format!("a.csv:8: column 2, wide: is '1.5'; {wide} [1.5]"),
    ];
    assert_eq!(error.lines().collect::<Vec<_>>(), expected);
    for (text, problem) in [
        (
            "",
            "a.csv: file: nothing in it; allowed: a head with names of ports: ",
        ),
        (
            "push\n",
            "a.csv: file: 0 ticks in it; allowed: one line per tick, 2 or more",
        ),
        (
            "push\n1\n",
            "a.csv: file: 1 tick in it; allowed: one line per tick, 2 or more",
        ),
    ] {
        let error = csv(text).unwrap_err();
        assert!(error.starts_with(problem), "{error}");
    }
    let error = read_csv("a.csv", b"push\n0\n\xff\n", &ports()).unwrap_err();
    assert_eq!(error.to_string(), "a.csv:3: file: not UTF-8; allowed: text");
}

#[test]
fn words_are_those_of_a_stimulus_file() {
    let ticks = [
        ([1, 0x8000_0001, 0xabcd, u64::MAX], true),
        ([0, 0x1234_5678, 0x0001, 0x8000_0000_0000_0001], false),
        ([1, 0xffff_ffff, 0xffff, 0], false),
    ];
    let mut low = 0;
    let mut text = String::new();
    for (ports_of_tick, rst) in &ticks {
        // Bit by bit, from the lowest.
        let mut word: Vec<bool> = Vec::new();
        for (port, &bits) in ports().iter().zip(ports_of_tick) {
            word.extend((0..port.shape.width).map(|bit| bits >> bit & 1 == 1));
        }
        word.push(*rst);
        low = word.len();
        let digits = word.chunks(4).rev().map(|bits| {
            let value = bits
                .iter()
                .rev()
                .fold(0, |value, &bit| 2 * value + u32::from(bit));
            char::from_digit(value, 16).unwrap()
        });
        text.extend(digits);
        text.push('\n');
    }
    assert_eq!(low, 114);
    let inputs = words(&text).unwrap();
    assert_eq!(inputs.ticks(), ticks.len());
    for (tick, (ports, rst)) in ticks.iter().enumerate() {
        assert_eq!(inputs.tick(tick), Some((&ports[..], *rst)));
    }
}

#[test]
fn lines_that_are_no_words_are_refused() {
    let most = format!("3{}", "f".repeat(28));
    assert!(words(&format!("{most}\n000{most}\n")).is_ok());
    let more = format!("4{}", "0".repeat(28));
    let error = words(&format!("0\n12x4\n{more}\n-1\n")).unwrap_err();
    let allowed = "allowed: a hexadecimal word of 114 bits";
    let expected = [
        format!("a.stimulus:2: word: column 3: no hexadecimal digit; {allowed} [x]"),
        format!("a.stimulus:3: word: 115 bits; {allowed} [{more}]"),
        format!("a.stimulus:4: word: column 1: no hexadecimal digit; {allowed} [-]"),
    ];
    assert_eq!(error.lines().collect::<Vec<_>>(), expected);
}

#[test]
fn the_extension_is_the_format() {
    let error = read_path(Path::new("inputs.txt"), &ports()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "inputs.txt: file: the extension names no format; allowed: a table as .csv, hexadecimal \
         words as .stimulus"
    );
}
