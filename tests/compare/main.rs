//! Comparing waveforms: random traces, damaged files, and other simulators.

#[cfg(feature = "cosim")]
mod cosim;
mod damage;
mod random;
mod windows;
