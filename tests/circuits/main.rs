//! The circuits, tick by tick, against programs and closed forms.

mod arc_generator;
mod common;
mod fast_forward;
mod lead_angle;
mod linear_interpolator;
mod position_pattern;
mod pulse_arcs;
mod pulse_counts;
mod pulse_group;
mod pulse_reference;
mod servo_loops;
mod step_timing;
mod stimulus;
mod trajectory;
