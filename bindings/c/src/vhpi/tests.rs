use super::*;
use motion_rtl::checker::{VERSION, VHPI_VERSION};

/// Array of the caller, as GHDL has it.
struct Passed {
    values: Vec<u8>,
    bounds: GhdlBounds,
}

impl Passed {
    fn new(values: &[u8]) -> Self {
        let length = values.len() as u32;
        Passed {
            values: values.to_vec(),
            bounds: GhdlBounds {
                left: 1,
                right: length as i32,
                direction: 0,
                length,
            },
        }
    }

    fn call<T>(&mut self, call: impl FnOnce(*const GhdlArray) -> T) -> T {
        let array = GhdlArray {
            values: self.values.as_mut_ptr(),
            bounds: &self.bounds,
        };
        call(&array)
    }
}

/// Hash of the ports with 8 bits.
const PORTS: &str = "fcb7d404ef2aff37";

fn new(vhpi: i32, settings: &str, ports: &str, leave: &str) -> i32 {
    let strings = [
        VERSION,
        "enable_counter",
        settings,
        ports,
        leave,
        "",
        ":tb:dut:",
    ];
    let mut strings = strings.map(|text| Passed::new(text.as_bytes()));
    let arrays = strings.each_mut().map(|passed| GhdlArray {
        values: passed.values.as_mut_ptr(),
        bounds: &passed.bounds,
    });
    let [a, b, c, d, e, f, g] = &arrays;
    // SAFETY: the arrays live until the end of the call.
    unsafe { mrtl_vhpi_new(vhpi, 1, a, b, c, d, e, f, g) }
}

fn edge(handle: i32, values: &str) -> i32 {
    let position = |letter| "UX01ZWLH-".find(letter).unwrap() as u8;
    let values: Vec<u8> = values.chars().map(position).collect();
    // SAFETY: one thread uses the handle.
    Passed::new(&values).call(|array| unsafe { mrtl_vhpi_edge(handle, array) })
}

/// Text in a buffer with so much room.
fn text(handle: i32, room: i32) -> String {
    let mut buffer = Passed::new(&vec![b'#'; room as usize]);
    // SAFETY: one thread uses the handle.
    buffer.call(|array| unsafe { mrtl_vhpi_text(handle, array) });
    String::from_utf8(buffer.values).unwrap()
}

#[test]
fn values_of_std_logic_are_compared() {
    let handle = new(VHPI_VERSION as i32, "width=8", PORTS, "");
    assert!(handle > 0, "{}", text(handle, -handle));
    assert_eq!(edge(handle, "0000000100"), 0);
    assert_eq!(edge(handle, "0LLLLLLHLH"), 0);
    let length = edge(handle, "0000000101");
    let said = text(handle, length);
    let head = "tb.dut: first difference in tick 2:\n  enable: design 1, model 0\n";
    assert!(said.starts_with(head) && said.ends_with(')'), "{said}");
    assert_eq!(text(handle, 6), "tb.dut");
    // SAFETY: one thread uses the handle.
    assert_eq!(unsafe { beside::end(handle) }, 1);
    // Too few values are a fault of the caller.
    let wrong = edge(handle, "0");
    assert_eq!(wrong as usize, WRONG.count_bytes());
}

#[test]
fn what_does_not_fit_is_refused_with_a_text() {
    let refused = |vhpi, settings, ports, leave| {
        let length = new(vhpi, settings, ports, leave);
        assert!(length < 0);
        text(length, -length)
    };
    let version = VHPI_VERSION as i32;
    let said = refused(version + 1, "width=8", PORTS, "");
    assert!(
        said.starts_with("tb.dut: the checker is of motion-rtl "),
        "{said}"
    );
    assert!(said.contains("(VHPI 2), the library of"), "{said}");
    for (settings, ports) in [
        ("width=9", PORTS),
        ("width=8", "fcb7d404ef2aff36"),
        ("width=8", ""),
    ] {
        let said = refused(version, settings, ports, "");
        let anew = "`motion-rtl vhdl enable_counter --vhpi` prints the checker anew";
        assert!(
            said.contains(anew) && said.contains("\nin period "),
            "{said}"
        );
    }
    let said = refused(version, "width=8", PORTS, "enable, count");
    let end = "count is not a port of enable_counter; allowed: period, enable";
    assert!(said.ends_with(end), "{said}");
}

#[test]
fn names_and_paths_are_those_of_vhdl() {
    assert_eq!(instance(":tb:g(0):dut:"), "tb.g(0).dut");
    assert_eq!(names(" a,b , c"), ["a", "b", "c"]);
    assert_eq!(names(""), <[String; 0]>::default());
    assert_eq!(string("aµ".as_bytes()), "aµ");
    assert_eq!(string(b"a\xb5"), "aµ");
}
