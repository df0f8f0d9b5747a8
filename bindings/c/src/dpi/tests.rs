use super::*;

const STRINGS: Strings<'static> = Strings {
    version: VERSION,
    circuit: "enable_counter",
    settings: "width=8",
    left: "",
    waves: "",
    instance: "tb.dut",
};
/// Hash of the ports with 8 bits.
const PORTS: u64 = 0xfcb7_d404_ef2a_ff37;

fn new(strings: Strings<'_>) -> Result<i32, Failure> {
    made(DPI_VERSION as i32, PORTS, true, strings)
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
    let [first, second, third] = [(); 3].map(|()| new(STRINGS).unwrap());
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
    let error = |strings| new(strings).unwrap_err().text;
    let version = error(Strings {
        version: "0.0.1",
        ..STRINGS
    });
    assert!(version.starts_with("the checker is of motion-rtl 0.0.1 (DPI 1), the library of "));
    let ports = error(Strings {
        settings: "width=9",
        ..STRINGS
    });
    assert!(ports.ends_with("the ports are:\nin period 9 unsigned\nout enable 1 unsigned"));
    let settings = error(Strings {
        settings: "wdth=9",
        ..STRINGS
    });
    assert!(settings.contains("wdth"), "{settings}");
    let left = error(Strings {
        left: "enable\ncount",
        ..STRINGS
    });
    assert_eq!(
        left,
        "count is not a port of enable_counter; allowed: period, enable"
    );
}

#[test]
fn files_are_named_after_the_instance() {
    let path = |pattern| waves(pattern, "TOP.a[1].\\b/c");
    assert_eq!(path("out/%m.vcd"), Some("out/TOP.a_1_._b_c.vcd".into()));
    assert_eq!((path("a.fst"), path("")), (Some("a.fst".into()), None));
}
