/// Transposes 64 words: bit i of word k becomes bit k of word i.
#[inline]
pub fn transpose(words: &mut [u64; 64]) {
    let mut by = 32;
    let mut mask = u64::MAX >> 32;
    while by > 0 {
        let mut k = 0;
        while k < 64 {
            for k in k..k + by {
                let (low, high) = (words[k], words[k + by]);
                let swapped = ((low >> by) ^ high) & mask;
                words[k] = low ^ (swapped << by);
                words[k + by] = high ^ swapped;
            }
            k += 2 * by;
        }
        by /= 2;
        mask ^= mask << by;
    }
}
