//! Comparing waveforms: random traces, damaged files, and other simulators.

mod damage;
mod random;
mod simulators;
mod windows;
mod wrapped;
