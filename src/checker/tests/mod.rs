mod logic;
mod waves;

use super::*;

fn model(circuit: &str, settings: &str) -> Model {
    let settings = settings.split_whitespace();
    let pairs: Vec<_> = settings.map(|pair| pair.parse().unwrap()).collect();
    Model::new(circuit, &pairs).unwrap()
}

/// Checker beside a design that is another model of the same circuit.
struct Beside {
    design: Model,
    checker: Checker,
}

impl Beside {
    fn new(circuit: &str, settings: &str, options: &Options) -> Self {
        let made = || model(circuit, settings);
        Beside {
            design: made(),
            checker: Checker::new(made(), options).unwrap(),
        }
    }

    fn from_power_on(circuit: &str, settings: &str) -> Self {
        let options = Options {
            from_power_on: true,
            ..Options::default()
        };
        Beside::new(circuit, settings, &options)
    }

    fn set(&mut self, port: &str, number: i64) {
        self.design.set(port, number).unwrap();
    }

    /// Words of the design's ports in this tick.
    fn words(&mut self) -> Vec<u64> {
        let mut words = vec![0; self.checker.words().words];
        for port in &self.checker.ports {
            let bits = self.design.get(port.name.as_str()).unwrap();
            words[port.place.word] |= bits << port.place.low;
        }
        words
    }

    /// Passes an edge after `change` has changed the words; returns what there is to say.
    fn edge_with(&mut self, rst: bool, change: impl FnOnce(&mut [u64])) -> String {
        let mut words = self.words();
        change(&mut words);
        let says = self.checker.edge(rst, &words).unwrap();
        let text = self.checker.take_text();
        assert_eq!(says, !text.is_empty());
        match rst {
            true => self.design.reset(),
            false => self.design.step(),
        }
        text
    }

    /// Passes edges at which there is nothing to say.
    fn edges(&mut self, ticks: u64) {
        for _ in 0..ticks {
            assert_eq!(self.edge_with(false, |_| ()), "");
        }
    }

    fn end(&mut self) -> (Verdict, String) {
        (self.checker.end(), self.checker.take_text())
    }
}

/// Sets all input ports at random, most of them seldom.
fn random_inputs(model: &mut Model, seed: &mut u64) {
    let widths = model.elaborated().flat().inputs.clone();
    for (port, &width) in widths.iter().enumerate() {
        *seed = seed
            .wrapping_mul(0x5851_f42d_4c95_7f2d)
            .wrapping_add(0x1405_7b7e_f767_814f);
        if *seed >> 60 == 0 || width == 1 {
            let bits = *seed >> 20 & (u64::MAX >> (64 - width));
            model.set_bits(model.at(port).unwrap(), bits).unwrap();
        }
    }
}

#[test]
fn an_equal_design_passes_and_movements_are_counted() {
    let mut beside = Beside::from_power_on("enable_counter", "width=8");
    beside.set("period", 3);
    beside.edges(7);
    beside.set("period", 5);
    beside.edges(6);
    // Enable is high in ticks 2, 5 and 10.
    let report = "PASS: 13 values equal in 13 ticks\nmoved, how often: period 1, enable 6\n";
    assert_eq!(beside.end(), (Verdict::Pass, report.to_owned()));
}

#[test]
fn the_first_difference_is_shown_with_the_ticks_before_it() {
    let mut beside = Beside::from_power_on("enable_counter", "width=8");
    beside.set("period", 3);
    beside.edges(10);
    let text = beside.edge_with(false, |words| words[1] = 1);
    let shown = "\
first difference in tick 10:
  enable: design 1, model 0
tick    3   4   5   6   7   8   9   10
rst     0   0   0   0   0   0   0   0
period  03  03  03  03  03  03  03  03
enable  0   0   1   0   0   1   0   0!1
(hexadecimal, model!design where they differ)
";
    assert_eq!(text, shown);
    // What follows is counted.
    assert_eq!(beside.edge_with(false, |words| words[1] ^= 1), "");
    beside.edges(3);
    let (verdict, report) = beside.end();
    assert_eq!(verdict, Verdict::Fail);
    let lines: Vec<&str> = report.lines().collect();
    assert_eq!(lines[0], "FAIL: 2 of 15 values differ, in 2 of 15 ticks");
    assert_eq!(lines[1], "  enable: 2 differences, the first in tick 10");
}

#[test]
fn the_comparison_begins_with_the_edge_after_the_first_reset() {
    let mut beside = Beside::new("enable_counter", "width=8", &Options::default());
    beside.set("period", 3);
    // Nothing is compared before a reset, nor at its edge.
    assert_eq!(beside.edge_with(false, |words| words[1] = 1), "");
    assert_eq!(beside.edge_with(true, |words| words[1] = 1), "");
    beside.edges(5);
    // A later reset is followed.
    assert_eq!(beside.edge_with(true, |_| ()), "");
    beside.edges(5);
    let (verdict, report) = beside.end();
    assert_eq!(verdict, Verdict::Pass);
    assert!(
        report.starts_with("PASS: 11 values equal in 11 ticks\n"),
        "{report}"
    );
    // Tick 0 is that of the reset.
    assert_eq!(beside.checker.model.tick(), 12);
}

#[test]
fn the_first_edge_after_the_reset_is_compared() {
    let mut beside = Beside::new("enable_counter", "width=8", &Options::default());
    beside.set("period", 3);
    beside.edge_with(true, |_| ());
    let text = beside.edge_with(false, |words| words[1] = 1);
    assert!(text.starts_with("first difference in tick 1:\n"), "{text}");
}

#[test]
fn a_reset_that_the_design_ignores_is_found() {
    let mut beside = Beside::from_power_on("enable_counter", "width=8");
    beside.set("period", 4);
    beside.edges(2);
    let words = beside.words();
    assert!(!beside.checker.edge(true, &words).unwrap());
    beside.design.step();
    let text = beside.edge_with(false, |_| ());
    assert!(
        text.starts_with("first difference in tick 3:\n  enable: design 1, model 0\n"),
        "{text}"
    );
}

#[test]
fn comparing_nothing_or_nothing_that_moves_is_vacuous() {
    let vacuous = |beside: &mut Beside| {
        let (verdict, report) = beside.end();
        assert_eq!(verdict, Verdict::Vacuous, "{report}");
        report.lines().next().unwrap().to_owned()
    };
    let made = |options: &Options| Beside::new("enable_counter", "width=8", options);
    let mut none = made(&Options::default());
    assert_eq!(vacuous(&mut none), "VACUOUS: there was no clock edge");

    let mut waiting = made(&Options::default());
    waiting.set("period", 3);
    waiting.edges(20);
    assert_eq!(
        vacuous(&mut waiting),
        "VACUOUS: rst was 1 in none of 20 edges, so nothing was compared; FROM_POWER_ON \
         (from_power_on in Python) compares from the first edge"
    );

    let mut in_reset = made(&Options::default());
    in_reset.edge_with(true, |_| ());
    assert_eq!(
        vacuous(&mut in_reset),
        "VACUOUS: the reset lasted for all of 1 edge, so nothing was compared"
    );

    // A period of 0 or 1 has an enable in every tick.
    let mut still = made(&Options::default());
    still.edge_with(true, |_| ());
    still.edges(9);
    assert_eq!(
        vacuous(&mut still),
        "VACUOUS: no output port moved in 9 ticks"
    );

    // The tick of the reset is not compared: a move from it does not count.
    let mut once = made(&Options::default());
    once.edge_with(true, |words| words[1] ^= 1);
    once.edges(9);
    assert_eq!(
        vacuous(&mut once),
        "VACUOUS: no output port moved in 9 ticks"
    );

    let mut left = made(&Options {
        leave: vec!["enable".into()],
        from_power_on: true,
        ..Options::default()
    });
    left.set("period", 3);
    left.edges(9);
    assert_eq!(vacuous(&mut left), "VACUOUS: no output port is compared");
    assert!(
        left.checker
            .report(Verdict::Vacuous)
            .ends_with("left out: enable\n")
    );
}

#[test]
fn unknown_outputs_differ_and_say_so() {
    let mut beside = Beside::from_power_on("linear_interpolator", "");
    beside.edges(3);
    let x = beside
        .checker
        .ports
        .iter()
        .position(|port| port.name == "x");
    let zeros = "0".repeat(30);
    beside.checker.unknown(x, &format!("x1{zeros}"));
    // The word has zeros where a bit is unknown, as the model.
    let text = beside.edge_with(false, |_| ());
    let shown =
        format!("first difference in tick 3:\n  x: design x1{zeros} (binary, unknown), model 0\n");
    assert!(text.starts_with(&shown), "{text}");
    assert!(text.contains(&format!("00000000!x1{zeros}\n")), "{text}");
    beside.edges(1);
    let (_, report) = beside.end();
    assert!(
        report.starts_with("FAIL: 1 of 45 values differ, in 1 of 5 ticks\n"),
        "{report}"
    );
}

#[test]
fn an_unknown_input_stops_the_comparison() {
    for (port, name) in [(Some(0), "period"), (None, "rst")] {
        let mut beside = Beside::from_power_on("enable_counter", "width=8");
        beside.set("period", 3);
        beside.edges(4);
        beside.checker.unknown(port, "0x");
        let text = beside.edge_with(false, |words| words[1] ^= 1);
        let shown =
            format!("tick 4: input {name} is 0x (binary, unknown); the comparison stops here\n");
        assert_eq!(text, shown);
        assert_eq!(beside.edge_with(false, |words| words[1] ^= 1), "");
        let (verdict, report) = beside.end();
        assert_eq!(verdict, Verdict::Fail);
        let first = report.lines().next();
        assert_eq!(
            first,
            Some("FAIL: an unknown input has stopped the comparison after 4 ticks")
        );
    }
}

#[test]
fn unknown_inputs_are_allowed_until_the_first_reset_is_over() {
    let mut beside = Beside::new("enable_counter", "width=8", &Options::default());
    let edge = |beside: &mut Beside, rst: bool, unknown: &[Option<usize>]| {
        for port in unknown {
            beside.checker.unknown(*port, "xx");
        }
        beside.edge_with(rst, |_| ())
    };
    assert_eq!(edge(&mut beside, false, &[None, Some(0), Some(1)]), "");
    // An unknown reset is none.
    assert_eq!(edge(&mut beside, true, &[None]), "");
    assert_eq!(beside.checker.state, State::Waiting);
    assert_eq!(edge(&mut beside, true, &[Some(0), Some(1)]), "");
    assert_eq!(edge(&mut beside, true, &[Some(0), Some(1)]), "");
    beside.set("period", 3);
    beside.edges(6);
    assert_eq!(edge(&mut beside, true, &[]), "");
    assert!(
        !edge(&mut beside, true, &[Some(0)]).is_empty(),
        "a later reset hides nothing"
    );
    assert_eq!(beside.checker.ticks, 7);
}

#[test]
fn every_bit_of_every_port_counts() {
    for circuit in ["linear_interpolator", "unit_law", "mul_div", "placement"] {
        let mut beside = Beside::from_power_on(circuit, "");
        let mut seed = 7;
        for _ in 0..300 {
            random_inputs(&mut beside.design, &mut seed);
            beside.edge_with(false, |_| ());
        }
        assert_eq!(beside.checker.differing_ticks, 0, "{circuit}");
        let inputs = beside.checker.words().inputs.len();
        let mut expected = 0;
        for index in inputs..beside.checker.ports.len() {
            let place = beside.checker.ports[index].place;
            for bit in place.low..place.low + place.width {
                random_inputs(&mut beside.design, &mut seed);
                let before = beside.checker.ports[index].differences;
                beside.edge_with(false, |words| words[place.word] ^= 1 << bit);
                assert_eq!(beside.checker.ports[index].differences, before + 1);
                expected += 1;
            }
        }
        let found: u64 = beside
            .checker
            .ports
            .iter()
            .map(|port| port.differences)
            .sum();
        assert_eq!(found, expected, "{circuit}");
    }
}

#[test]
fn ports_that_are_left_out_have_no_place() {
    let options = Options {
        leave: vec!["half_period".into(), "step".into()],
        from_power_on: true,
        waves: None,
    };
    let model = model("unit_law", "width=16");
    let checker = Checker::new(model, &options).unwrap();
    let names: Vec<&str> = checker
        .ports
        .iter()
        .map(|port| port.name.as_str())
        .collect();
    assert_eq!((names, checker.layout.words), (vec!["period"], 1));
}

#[test]
fn what_cannot_be_left_out_is_an_error() {
    let error = |name: &str| {
        let options = Options {
            leave: vec![name.into()],
            ..Options::default()
        };
        let model = Model::new("enable_counter", &[]).unwrap();
        Checker::new(model, &options).unwrap_err().to_string()
    };
    let unknown = "enable_counter has no signal enabel; near it: enable";
    assert_eq!(error("enabel"), unknown);
    let inner = "count is not a port of enable_counter; allowed: period, enable";
    assert_eq!(error("count"), inner);
}

#[test]
fn another_number_of_words_is_an_error() {
    let mut beside = Beside::from_power_on("enable_counter", "width=8");
    let error = beside.checker.edge(false, &[1]).unwrap_err();
    assert_eq!(error.to_string(), "1 words for a tick; allowed: 2");
    assert_eq!(beside.checker.edges, 0);
}

#[test]
fn bits_of_no_port_are_ignored() {
    let mut beside = Beside::from_power_on("enable_counter", "width=8");
    beside.set("period", 2);
    for tick in 0..6 {
        let text = beside.edge_with(false, |words| {
            words[0] |= tick << 8;
            words[1] |= tick << 1;
        });
        assert_eq!(text, "");
    }
    let moved = "moved, how often: enable 5\nnever moved: period\n";
    assert_eq!(
        beside.end().1,
        format!("PASS: 6 values equal in 6 ticks\n{moved}")
    );
}

#[test]
fn signed_values_are_shown_with_their_signs() {
    let mut beside = Beside::from_power_on("linear_interpolator", "");
    let text = beside.edge_with(false, |words| words[3] = 0xffff_fffd);
    assert!(text.contains("\n  x: design -3, model 0\n"), "{text}");
}
