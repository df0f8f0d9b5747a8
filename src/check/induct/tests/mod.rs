//! Proofs of random netlists compared with a visit of all their states, and of circuits that need
//! each of the ways to a proof.

mod certificates;
mod circuits;
mod parts;
mod ticks;
mod visit;
