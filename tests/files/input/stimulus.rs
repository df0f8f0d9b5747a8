//! Stimulus files that are written and read again.

use motion_rtl::circuits::blocks::EnableCounter;
use motion_rtl::input::stimulus::{InputPort, read_words};
use motion_rtl::netlist::unsigned;
use motion_rtl::trace::StimulusFile;

#[test]
fn what_the_crate_writes_is_read_as_it_was() {
    let circuit = EnableCounter { width: 11 };
    let mut file = StimulusFile::new(Vec::new(), &circuit);
    let ticks = [(0x5a3, false), (0, true), (0x7ff, true), (1, false)];
    for (period, rst) in ticks {
        file.line(&[period], rst).unwrap();
    }
    let port = InputPort {
        name: "period".into(),
        verilog: "period".into(),
        shape: unsigned(11),
    };
    let inputs = read_words("a", &file.finish().unwrap(), &[port]).unwrap();
    for (tick, (period, rst)) in ticks.into_iter().enumerate() {
        assert_eq!(inputs.tick(tick), Some((&[period][..], rst)));
    }
}
