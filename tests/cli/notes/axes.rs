//! What each axis adds, to the patent's device and to the conventional one.

use motion_rtl::circuits::pulse_interpolator::{
    AXES_MAX, Conventional, ConventionalWidths, Group, Variant, Widths,
};
use motion_rtl::sim::Elaborated;
use std::fmt::Write as _;

/// A table of what both cost with 1 to 8 axes, counted in their netlists, and of the shortest unit
/// time that the conventional one computes in.
pub fn table() -> String {
    let mut text = String::from(
        "| axes | adders and comparators | their bits | flip-flops | memory bits a unit time \
         | conventional: adders and comparators | their bits | flip-flops | ticks to compute \
         | with arcs: adders and comparators | their bits | flip-flops |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for axes in 1..=AXES_MAX {
        let widths = Widths::default();
        let group = Group::new(axes, widths, Variant::Safe, 1000);
        let conventional = Conventional {
            axes,
            widths: ConventionalWidths::default(),
            period: 1000,
            arcs: false,
        };
        let ours = Elaborated::new(&group).unwrap().cost();
        let before = Elaborated::new(&conventional).unwrap().cost();
        assert_eq!(before.memory_bits, 0);
        let arcs = (axes > 1).then(|| {
            let arcs = Elaborated::new(&Conventional {
                arcs: true,
                ..conventional.clone()
            });
            let cost = arcs.unwrap().cost();
            format!(
                "{} | {} | {}",
                cost.adders, cost.adder_bits, cost.register_bits
            )
        });
        let arcs = arcs.unwrap_or("– | – | –".to_owned());
        let memory = ours.memory_bits >> widths.address;
        let ticks = conventional.controller().least_period();
        let _ = writeln!(
            text,
            "| {axes} | {} | {} | {} | {memory} | {} | {} | {} | {ticks} | {arcs} |",
            ours.adders,
            ours.adder_bits,
            ours.register_bits,
            before.adders,
            before.adder_bits,
            before.register_bits
        );
    }
    text
}
