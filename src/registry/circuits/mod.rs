//! The catalogue, a file for each patent.

mod arc_generator;
mod blocks;
mod lead_angle;
mod linear_interpolator;
mod machine;
mod pulse_interpolator;
mod trajectory_controller;

use super::Entry;

const PARTS: [&[Entry]; 7] = [
    pulse_interpolator::CIRCUITS,
    blocks::CIRCUITS,
    linear_interpolator::CIRCUITS,
    lead_angle::CIRCUITS,
    arc_generator::CIRCUITS,
    trajectory_controller::CIRCUITS,
    machine::CIRCUITS,
];

const COUNT: usize = {
    let (mut count, mut part) = (0, 0);
    while part < PARTS.len() {
        count += PARTS[part].len();
        part += 1;
    }
    count
};

/// Every circuit, blocks before what is made of them. A static, which stands in this crate alone: a
/// constant is compiled again, with all circuits, in each program that names it.
pub static CATALOGUE: &[Entry] = &{
    let mut all = [PARTS[0][0]; COUNT];
    let (mut count, mut part) = (0, 0);
    while part < PARTS.len() {
        let mut index = 0;
        while index < PARTS[part].len() {
            all[count] = PARTS[part][index];
            count += 1;
            index += 1;
        }
        part += 1;
    }
    all
};
