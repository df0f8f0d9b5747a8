//! Edges with values of `std_logic`.

use super::*;

/// Values of the reset and of all ports for the words of a tick; low and high have two values each.
fn values(checker: &Checker, rst: bool, words: &[u64], weak: bool) -> Vec<u8> {
    let value = |bit: u64| 2 + bit as u8 + if weak { 4 } else { 0 };
    let mut values = vec![value(rst.into())];
    for port in &checker.ports {
        let bits = port.place.bits(words[port.place.word]);
        let bits = (0..port.place.width).rev().map(|bit| bits >> bit & 1);
        values.extend(bits.map(value));
    }
    values
}

/// Ports up to 64 bits, with a sign and without, in several words.
#[test]
fn values_of_every_bit_are_compared_as_words_are() {
    let mut compared = 0;
    for circuit in ["accumulator", "linear_interpolator", "placement"] {
        let mut beside = Beside::new(circuit, "", &Options::default());
        let mut logic = Checker::new(model(circuit, ""), &Options::default()).unwrap();
        let bits = 64 * beside.checker.words().words;
        let mut seed = 5;
        for tick in 0..2 * bits as u64 {
            random_inputs(&mut beside.design, &mut seed);
            let mut words = beside.words();
            // The reset ends tick 1, and later each bit is wrong once.
            let rst = tick == 1 || tick % 50 == 3;
            if tick >= bits as u64 {
                let bit = (tick as usize) % bits;
                words[bit / 64] ^= 1 << (bit % 64);
            }
            let values = values(&logic, rst, &words, tick % 3 == 0);
            let says = beside.checker.edge(rst, &words).unwrap();
            assert_eq!(logic.logic_edge(&values).unwrap(), says, "{circuit} {tick}");
            assert_eq!(logic.take_text(), beside.checker.take_text());
            match rst {
                true => beside.design.reset(),
                false => beside.design.step(),
            }
        }
        let (verdict, report) = beside.end();
        assert_eq!((logic.end(), logic.take_text()), (verdict, report));
        compared += usize::from(verdict == Verdict::Fail);
    }
    assert_eq!(compared, 3);
}

#[test]
fn metavalues_are_unknown_in_the_letters_of_vhdl() {
    let options = Options {
        from_power_on: true,
        ..Options::default()
    };
    for (value, letter) in (0..).zip("UX01ZWLH-".chars()) {
        let mut checker = Checker::new(model("enable_counter", "width=3"), &options).unwrap();
        let known = "01LH".contains(letter);
        // The period is 6, then its lowest bit is this one.
        assert!(!checker.logic_edge(&[2, 3, 3, 2, 2]).unwrap());
        assert_eq!(checker.logic_edge(&[2, 3, 3, value, 2]).unwrap(), !known);
        let text = checker.take_text();
        let stopped = format!("tick 1: input period is 11{letter} (binary, unknown)");
        assert!(known || text.starts_with(&stopped), "{text}");

        let mut checker = Checker::new(model("enable_counter", "width=3"), &options).unwrap();
        let says = checker.logic_edge(&[2, 3, 3, 2, value]).unwrap();
        assert_eq!(says, !"0L".contains(letter));
        let shown = match letter {
            '1' | 'H' => "1".to_owned(),
            _ => format!("{letter} (binary, unknown)"),
        };
        let text = checker.take_text();
        let line = format!("  enable: design {shown}, model 0\n");
        assert!(!says || text.contains(&line), "{text}");
    }
    let mut checker = Checker::new(model("enable_counter", "width=3"), &options).unwrap();
    assert!(checker.logic_edge(&[0, 3, 3, 2, 2]).unwrap());
    let text = checker.take_text();
    assert!(text.contains("input rst is U (binary, unknown)"), "{text}");
}

#[test]
fn ports_that_are_left_out_have_values_nevertheless() {
    let options = Options {
        leave: vec!["half_period".to_owned(), "step".to_owned()],
        from_power_on: true,
        ..Options::default()
    };
    let mut checker = Checker::new(model("unit_law", "width=4"), &options).unwrap();
    // half_period, period and step.
    let values = [&[2][..], &[0; 4], &[2, 2, 3, 2], &[1]].concat();
    assert!(!checker.logic_edge(&values).unwrap());
    checker.end();
    let text = checker.take_text();
    assert!(
        text.starts_with("VACUOUS: no output port is compared\n"),
        "{text}"
    );
    for given in [0, 9, 11] {
        let error = checker.logic_edge(&[2; 11][..given]).unwrap_err();
        let expected = format!("{given} values of std_logic for a tick; allowed: 10");
        assert_eq!(error.to_string(), expected);
    }
}
