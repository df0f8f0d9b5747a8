//! The linear interpolator of JP3608587B2.
