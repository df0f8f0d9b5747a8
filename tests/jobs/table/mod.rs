//! The table compiler, judged by playing its tables tick by tick.

mod cases;
mod judge;
mod random;
