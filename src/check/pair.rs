//! Two circuits side by side.

use crate::hdl::{
    Circuit, Nothing, Record, Sink, Source, View, Walk, Wire, leaves::Nodes, pack::tokens,
    part::Counted, view,
};
use crate::netlist::{Field, Role, Shape, Site};
use std::fmt;
use std::ops::Deref;

/// Two circuits side by side with the same inputs: those of the left circuit; the right one has
/// the same ports.
///
/// Each is in a scope of its own name or, if both have the same name, in `left` and `right`.
#[derive(Debug, Clone)]
pub struct Pair<A, B> {
    /// Left circuit; its input ports are those of the pair.
    pub left: A,
    /// Right circuit.
    pub right: B,
}

impl<A: Circuit, B: Circuit> Pair<A, B> {
    /// Scopes of the circuits.
    pub(super) const SCOPES: [&'static str; 2] = match same(A::NAME, B::NAME) {
        true => ["left", "right"],
        false => [A::NAME, B::NAME],
    };
}

/// True if two strings are equal; `==` on strings is not `const`.
const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    if a.len() != b.len() {
        return false;
    }
    let mut index = 0;
    while index < a.len() {
        if a[index] != b[index] {
            return false;
        }
        index += 1;
    }
    true
}

/// Input ports of a [`Pair`]: those of the left circuit.
pub struct PairIn<A: Circuit, V: View = Wire>(pub A::In<V>);

/// Circuits of a [`Pair`].
pub struct Sides<A: Circuit, B: Circuit, V: View = Wire> {
    /// Left circuit.
    pub left: V::Part<A>,
    /// Right circuit.
    pub right: V::Part<B>,
}

impl<A: Circuit, V: View> Deref for PairIn<A, V> {
    type Target = A::In<V>;

    fn deref(&self) -> &A::In<V> {
        &self.0
    }
}

impl<A: Circuit, V: View> fmt::Debug for PairIn<A, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(A::NAME).finish_non_exhaustive()
    }
}

impl<A: Circuit, B: Circuit, V: View> fmt::Debug for Sides<A, B, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} and {}", A::NAME, B::NAME)
    }
}

const HERE: Site = Site {
    file: file!(),
    line: line!(),
    column: column!(),
};

impl<A: Circuit, B: Circuit, V: View> Record<Pair<A, B>, V> for PairIn<A, V> {
    fn make(of: &Pair<A, B>, field: &'static Field, source: &mut dyn Source) -> Self {
        PairIn(A::In::make(&of.left, field, source))
    }
}

impl<A: Circuit, V: View> Walk<V> for PairIn<A, V> {
    const SITE: Site = HERE;
    fn visit(&self, field: &'static Field, sink: &mut dyn Sink) {
        self.0.visit(field, sink);
    }
    fn words(&self, words: &mut Vec<u64>) {
        self.0.words(words);
    }
}

const fn side(name: &'static str) -> Field {
    Field {
        public: true,
        ..Field::named(name)
    }
}

impl<A: Circuit, B: Circuit, V: View> Record<Pair<A, B>, V> for Sides<A, B, V> {
    fn make(of: &Pair<A, B>, field: &'static Field, source: &mut dyn Source) -> Self {
        source.enter(field);
        let left = const { &side(Pair::<A, B>::SCOPES[0]) };
        let right = const { &side(Pair::<A, B>::SCOPES[1]) };
        let sides = Sides {
            left: V::part(&of.left, left, source),
            right: V::part(&of.right, right, source),
        };
        source.leave();
        sides
    }
}

impl<A: Circuit, B: Circuit, V: View> Walk<V> for Sides<A, B, V> {
    const SITE: Site = HERE;
    fn visit(&self, _: &'static Field, _: &mut dyn Sink) {}
    fn words(&self, _: &mut Vec<u64>) {}
}

/// Returns names and shapes of a circuit's input ports.
fn ports<C: Circuit>(circuit: &C) -> Vec<(String, Shape)> {
    let mut ports = Counted::default();
    circuit.make_shapes(Role::Input, &mut ports);
    let ports = ports.leaves.into_iter();
    ports.map(|port| (port.name, port.shape)).collect()
}

impl<A: Circuit, B: Circuit> Circuit for Pair<A, B> {
    const NAME: &'static str = "pair";
    const ABOUT: &'static str = "two circuits side by side on the same inputs";
    type In<V: View> = PairIn<A, V>;
    type Reg<V: View> = Nothing;
    type Net<V: View> = Nothing;
    type Parts<V: View> = Sides<A, B, V>;
    crate::hdl_made!();

    fn objection(&self) -> Option<String> {
        let (left, right) = (ports(&self.left), ports(&self.right));
        if left == right {
            return None;
        }
        let names = |ports: &[(String, Shape)]| {
            let ports = ports.iter();
            let ports = ports.map(|(name, shape)| format!("{name} of {}", shape.width));
            ports.collect::<Vec<_>>().join(", ")
        };
        Some(format!(
            "the ports in of both are not the same: {}; {}",
            names(&left),
            names(&right)
        ))
    }

    fn tick(&self, i: PairIn<A>, _: Nothing, p: Sides<A, B>) -> (Nothing, Nothing) {
        let nodes: Vec<usize> = tokens(&i.0)
            .into_iter()
            .map(|token| token as usize)
            .collect();
        p.left.settle(i.0);
        // Both have the same number of ports; `objection` has checked that.
        let mut again = Nodes(nodes.iter());
        let i = B::In::make(&self.right, view::role(Role::Input), &mut again);
        p.right.settle(i);
        (Nothing, Nothing)
    }
}
