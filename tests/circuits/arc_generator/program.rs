//! Reference programs for the circuits, with wide numbers.

/// First value and differences of a quartic, from its first five values.
pub fn differences(at: impl Fn(i128) -> i128) -> [i128; 5] {
    let mut row: Vec<i128> = (0..5).map(at).collect();
    std::array::from_fn(|_| {
        let first = row[0];
        row = row.windows(2).map(|pair| pair[1] - pair[0]).collect();
        first
    })
}

/// A word of `bits` bits, two's complement.
pub fn wrap(number: i128, bits: usize) -> i128 {
    let half = 1i128 << (bits - 1);
    (number + half).rem_euclid(2 * half) - half
}

/// A matrix with `fraction` bits of fraction times a vector; halves go up, or everything down.
pub fn rotated(
    matrix: &[[i128; 3]; 3],
    vector: [i128; 3],
    fraction: usize,
    nearest: bool,
) -> [i128; 3] {
    let half = if nearest { 1 << (fraction - 1) } else { 0 };
    matrix.map(|row| {
        let sum: i128 = row.iter().zip(vector).map(|(by, word)| by * word).sum();
        (sum + half) >> fraction
    })
}
