use super::clock;
use super::zoo::PHASES;
use motion_rtl::prelude::*;
use motion_rtl::trace::{LayoutError, Options, Vcd};

/// Returns why a circuit with these input ports has no waves.
macro_rules! refused {
    ({ $($field:tt)* }) => {{
        #[derive(Debug, Clone)]
        struct Only;

        signals! { for Only as _c; struct In { $($field)* } }

        impl Circuit for Only {
            const NAME: &'static str = "only";
            const ABOUT: &'static str = "ports in";
            records!(In, Nothing, Nothing);
            fn tick(&self, _: In, _: Nothing, _: Nothing) -> (Nothing, Nothing) {
                (Nothing, Nothing)
            }
        }
        Vcd::new(Vec::new(), &Only, clock(), &Options::default()).unwrap_err()
    }};
}

/// Owner of bundles.
struct Sides;

signals! { for Sides as _c; struct Side { level: U(3) } }

#[test]
fn names_that_are_taken_or_cannot_be_written_are_refused() {
    let duplicate = |path: &str| LayoutError::Duplicate(path.to_owned());
    assert_eq!(refused!({ clk: Bit }), duplicate("only.clk"));
    assert_eq!(
        refused!({ phase: U(2) as States(PHASES), phase_name: Bit }),
        duplicate("only.phase_name")
    );
    assert_eq!(
        refused!({ left: Bit, axes: [Side(&Sides); 2] as Elements(&["left", "right"]) }),
        duplicate("only.left")
    );
    assert_eq!(
        refused!({ pair: [U(2); 2] as Elements(&["same", "same"]) }),
        duplicate("only.same")
    );
    assert_eq!(
        refused!({ pair: [U(2); 1] as Elements(&["a b"]) }),
        LayoutError::Name("only.a b".to_owned())
    );
    assert_eq!(
        refused!({ state: U(2) as States(&["ON", "NOT ON"]) }).to_string(),
        "only.state: state \"NOT ON\": the name of a state is made of visible ASCII characters"
    );
}
