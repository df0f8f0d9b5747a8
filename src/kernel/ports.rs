use super::Circuit;
use super::probe::{Probe, part};
use super::signals::{Field, Role, Shape, Signals};
use crate::logic::Sim;

/// The ports in of a tick, to be compared with those of later ones.
pub(super) struct Ports(Vec<u64>);

impl Ports {
    pub fn new<C: Circuit>() -> Self {
        Ports(vec![0; C::In::<Sim>::EXTENT.leaves])
    }

    pub fn keep<S: Signals<Sim>>(&mut self, i: &S) {
        let mut keep = Keep(self.0.iter_mut());
        i.visit(part(Role::Input), &mut keep);
    }

    pub fn are<S: Signals<Sim>>(&self, i: &S) -> bool {
        let mut compare = Compare {
            kept: &self.0,
            cursor: 0,
            differ: 0,
        };
        // After this the compiler knows that every port has its place.
        if self.0.len() != S::EXTENT.leaves {
            return false;
        }
        i.visit(part(Role::Input), &mut compare);
        compare.differ == 0
    }
}

struct Keep<'a>(std::slice::IterMut<'a, u64>);

impl Probe for Keep<'_> {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        if let Some(kept) = self.0.next() {
            *kept = bits;
        }
    }
}

struct Compare<'a> {
    kept: &'a [u64],
    cursor: usize,
    /// Ones where a port is not as it was: with a flag instead every port is a branch.
    differ: u64,
}

impl Probe for Compare<'_> {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        let kept = self.kept.get(self.cursor).copied().unwrap_or(!bits);
        self.differ |= kept ^ bits;
        self.cursor += 1;
    }
}
