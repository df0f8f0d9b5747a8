//! The meaning [`Lanes`]: a word is several words side by side.

mod element;
mod memory;
mod pack;
mod words;

pub use element::Element;
pub use memory::{LaneRam, LaneShiftRegister};
pub use pack::{lane, pack, spread, unpack};
pub use words::{LaneBit, LaneInt, LaneUInt};

use super::{Image, Logic};
use std::marker::PhantomData;

/// A word is `K` words side by side, each in an element `E`: the meaning for exhaustive
/// [sweeps](crate::check::sweep()), where one circuit does `K` cases at a time.
///
/// Words have at most as many bits as `E`; a wider one does not compile. The narrower the element,
/// the more of them a vector instruction does at once. With 48 lanes or more the compiler keeps the
/// loop over them and makes vector instructions of it; fewer it takes apart, which is slower.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lanes<const K: usize, E = u64>(PhantomData<E>);

impl<const K: usize, E: Element> Logic for Lanes<K, E> {
    type Bit = LaneBit<K, E>;
    type U<const N: usize> = LaneUInt<K, E, N>;
    type I<const N: usize> = LaneInt<K, E, N>;
    type Ram<const A: usize, const D: usize> = LaneRam<K, E, A, D>;
    type ShiftRegister<const S: usize, const D: usize> = LaneShiftRegister<K, E, S, D>;

    #[inline]
    fn rom<const A: usize, const D: usize>(image: &Image<A, D>, address: Self::U<A>) -> Self::U<D> {
        LaneUInt::each(|k| image.get(address.get(k) as usize))
    }
}
