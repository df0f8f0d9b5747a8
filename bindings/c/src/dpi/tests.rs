use super::*;
use crate::failure::Failure;
use motion_rtl::checker::{DPI_VERSION, VERSION};
use std::ffi::CStr;

const MADE: Made<'static> = Made {
    interface: Interface::Dpi,
    abi: DPI_VERSION as i32,
    version: VERSION,
    circuit: "enable_counter",
    settings: "width=8",
    // That of the ports with 8 bits.
    ports: 0xfcb7_d404_ef2a_ff37,
    leave: Vec::new(),
    from_power_on: true,
    waves: "",
    instance: "tb.dut",
};

fn new(made: Made<'_>) -> Result<i32, Failure> {
    beside::made(made)
}

fn edge(handle: i32, enable: u64) -> i32 {
    // SAFETY: one thread uses the handle.
    unsafe { mrtl_dpi_edge(handle, 0, 0, 2, enable, 0, 0, 0, 0, 0, 0) }
}

fn text(handle: i32) -> String {
    // SAFETY: one thread uses the handle, and the text lives until the next call with it.
    unsafe { CStr::from_ptr(mrtl_dpi_text(handle)) }
        .to_str()
        .unwrap()
        .to_owned()
}

fn end(handle: i32) -> i32 {
    // SAFETY: one thread uses the handle.
    unsafe { mrtl_dpi_end(handle) }
}

#[test]
fn the_last_of_several_checkers_fails_for_all() {
    let [first, second, third] = [(); 3].map(|()| new(MADE).unwrap());
    for tick in 0..10 {
        assert_eq!(edge(first, tick % 2), 0);
        assert_eq!(edge(third, tick % 2), 0);
        let says = edge(second, u64::from(tick % 2 == 1 && tick < 5));
        assert_eq!(says, i32::from(tick == 5), "tick {tick}");
        if says == 1 {
            let text = text(second);
            assert!(
                text.starts_with("tb.dut: first difference in tick 5:\n"),
                "{text}"
            );
            assert!(text.ends_with(')'), "{text}");
        }
    }
    assert_eq!(end(first), 0);
    assert!(text(first).starts_with("tb.dut: PASS: 10 values equal in 10 ticks\n"));
    assert_eq!(end(second), 0);
    assert!(text(second).starts_with("tb.dut: FAIL: 3 of 10 values differ"));
    assert_eq!(end(third), 1, "not all have passed");
    // A handle of another kind, or none.
    assert_eq!((edge(1 << 16, 0), end(0)), (MRTL_WRONG_HANDLE, 1));
    assert_eq!(
        text(0),
        "FAIL: the checker cannot go on: a fault inside the library"
    );
}

#[test]
fn what_does_not_fit_is_refused_with_a_text() {
    let error = |made| new(made).unwrap_err().text;
    let version = error(Made {
        version: "0.0.1",
        ..MADE
    });
    assert!(version.starts_with("the checker is of motion-rtl 0.0.1 (DPI 1), the library of "));
    let ports = error(Made {
        settings: "width=9",
        ..MADE
    });
    assert!(ports.ends_with("the ports are:\nin period 9 unsigned\nout enable 1 unsigned"));
    let settings = error(Made {
        settings: "wdth=9",
        ..MADE
    });
    assert!(settings.contains("wdth"), "{settings}");
    let left = error(Made {
        leave: vec!["enable".to_owned(), "count".to_owned()],
        ..MADE
    });
    assert_eq!(
        left,
        "count is not a port of enable_counter; allowed: period, enable"
    );
}
