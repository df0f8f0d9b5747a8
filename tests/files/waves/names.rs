use super::clock;
use super::zoo::{PHASES, PartReg};
use motion_rtl::kernel::{Circuit, Nothing};
use motion_rtl::logic::{Logic, Sim};
use motion_rtl::signals;
use motion_rtl::trace::{LayoutError, Options, Vcd};

/// A circuit of one struct of registers.
#[derive(Debug)]
struct Only<R>(std::marker::PhantomData<R>);

macro_rules! registers_only {
    ($name:ident { $($field:tt)* }) => {
        signals! { pub struct $name<L> { $($field)* } }
        impl Circuit for Only<$name<Sim>> {
            const NAME: &'static str = "only";
            const ABOUT: &'static str = "registers";
            type In<L: Logic> = Nothing<L>;
            type Reg<L: Logic> = $name<L>;
            type Net<L: Logic> = Nothing<L>;
            fn comb<L: Logic>(&self, _: &$name<L>, _: &Nothing<L>) -> Nothing<L> {
                Nothing::new()
            }
            fn next<L: Logic>(&self, q: $name<L>, _: &Nothing<L>, _: &Nothing<L>) -> $name<L> {
                q
            }
        }
    };
}

registers_only!(Clk { clk: L::Bit });
registers_only!(Companion { phase: L::U<2> as States(PHASES), phase_name: L::Bit });
registers_only!(Nested { left: L::Bit, axes: [PartReg<L>; 2] as Elements(&["left", "right"]) });
registers_only!(Elements { pair: [L::U<2>; 2] as Elements(&["same", "same"]) });
registers_only!(Spaced { pair: [L::U<2>; 1] as Elements(&["a b"]) });
registers_only!(Unseen { state: L::U<2> as States(&["ON", "NOT ON"]) });

fn refused<R: std::fmt::Debug>() -> LayoutError
where
    Only<R>: Circuit,
{
    let only: Only<R> = Only(std::marker::PhantomData);
    Vcd::new(Vec::new(), &only, clock(), &Options::default()).unwrap_err()
}

#[test]
fn names_that_are_taken_or_cannot_be_written_are_refused() {
    let duplicate = |path: &str| LayoutError::Duplicate(path.to_owned());
    assert_eq!(refused::<Clk<Sim>>(), duplicate("only.clk"));
    assert_eq!(refused::<Companion<Sim>>(), duplicate("only.phase_name"));
    assert_eq!(refused::<Nested<Sim>>(), duplicate("only.left"));
    assert_eq!(refused::<Elements<Sim>>(), duplicate("only.same"));
    assert_eq!(
        refused::<Spaced<Sim>>(),
        LayoutError::Name("only.a b".to_owned())
    );
    assert_eq!(
        refused::<Unseen<Sim>>().to_string(),
        "only.state: state \"NOT ON\": the name of a state is made of visible ASCII characters"
    );
}
