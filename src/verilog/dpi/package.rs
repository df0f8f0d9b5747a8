//! Package with the functions of the library that checkers call.

use super::CALL;
use crate::checker::VERSION;
use crate::printed::SourceFile;

/// Returns the package with the functions of the library.
pub(super) fn package() -> SourceFile {
    let words: Vec<String> = (0..CALL).map(|index| format!("w{index}")).collect();
    let words = words.join(", ");
    let text = format!(
        "\
// Functions of the shared library of motion-rtl {VERSION} that its checkers call.

`ifndef MOTION_RTL_PKG
`define MOTION_RTL_PKG

/* verilator lint_off TIMESCALEMOD */
package motion_rtl_pkg;

    // Puts a model beside a design; returns the handle of the checker, or 0 or less and a text.
    import \"DPI-C\" function int mrtl_dpi_new(
        input int dpi, input string version, input string circuit, input string settings,
        input longint unsigned ports, input string left, input int from_power_on,
        input string waves, input string instance_name);
    import \"DPI-C\" function string mrtl_dpi_error();

    // Passes words of the tick that ends; the call with the last ones is the edge. Returns 1 if
    // there is a text.
    import \"DPI-C\" function void mrtl_dpi_words(
        input int checker_handle, input int first, input longint unsigned {words});
    import \"DPI-C\" function int mrtl_dpi_edge(
        input int checker_handle, input int rst, input int first, input longint unsigned {words});

    // Says that a port, or rst as -1, is unknown at the edge to come.
    import \"DPI-C\" function void mrtl_dpi_unknown(
        input int checker_handle, input int port_index, input string bits);

    import \"DPI-C\" function string mrtl_dpi_text(input int checker_handle);

    // Ends a comparison. Returns 1 if it is the last one and not all have passed.
    import \"DPI-C\" function int mrtl_dpi_end(input int checker_handle);

endpackage

`endif
"
    );
    SourceFile {
        name: "motion_rtl_pkg.sv".to_owned(),
        text,
    }
}
