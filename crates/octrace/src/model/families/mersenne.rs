//! The Mersenne Twister MT19937 [Matsumoto-Nishimura 1998], seeded and read as Python's `random` does, so that a script
//! and the core make the same scenes from the same seeds.

const N: usize = 624;
const M: usize = 397;

/// Uniform random numbers.
#[derive(Clone, Debug)]
pub(super) struct Mersenne {
    state: [u32; N],
    next: usize,
}

impl Mersenne {
    /// As Python's `random.Random(seed)`.
    pub fn new(seed: u32) -> Self {
        let mut state = [0_u32; N];
        state[0] = 19_650_218;
        for i in 1..N {
            state[i] = mixed(state[i - 1]).wrapping_mul(1_812_433_253).wrapping_add(i as u32);
        }
        // The reference's `init_by_array`, for a key of one word.
        let mut i = 1;
        let step = |state: &mut [u32; N], i: &mut usize, factor: u32, add: u32| {
            state[*i] = (state[*i] ^ mixed(state[*i - 1]).wrapping_mul(factor)).wrapping_add(add);
            *i += 1;
            if *i == N {
                state[0] = state[N - 1];
                *i = 1;
            }
        };
        for _ in 0..N {
            step(&mut state, &mut i, 1_664_525, seed);
        }
        for _ in 1..N {
            let number = i as u32;
            step(&mut state, &mut i, 1_566_083_941, number.wrapping_neg());
        }
        state[0] = 0x8000_0000;
        Self { state, next: N }
    }

    /// At least `low` and less than `high`, but for rounding; as Python's `uniform`.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        let (a, b) = (self.word() >> 5, self.word() >> 6);
        let unit = (f64::from(a) * 67_108_864.0 + f64::from(b)) / 9_007_199_254_740_992.0;
        low + (high - low) * unit
    }

    fn word(&mut self) -> u32 {
        if self.next == N {
            for i in 0..N {
                let joined = (self.state[i] & 0x8000_0000) | (self.state[(i + 1) % N] & 0x7fff_ffff);
                let odd = if joined & 1 == 0 { 0 } else { 0x9908_b0df };
                self.state[i] = self.state[(i + M) % N] ^ (joined >> 1) ^ odd;
            }
            self.next = 0;
        }
        let mut word = self.state[self.next];
        self.next += 1;
        word ^= word >> 11;
        word ^= (word << 7) & 0x9d2c_5680;
        word ^= (word << 15) & 0xefc6_0000;
        word ^ (word >> 18)
    }
}

fn mixed(word: u32) -> u32 {
    word ^ (word >> 30)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_pythons() {
        // random.Random(12445): three times random().
        let mut random = Mersenne::new(12_445);
        let found = [0, 1, 2].map(|_| random.uniform(0.0, 1.0));
        assert_eq!(found, [0.188_294_427_917_654_83, 0.824_720_592_581_639_2, 0.671_874_695_530_113_3]);
        // The thousandth, beyond the first block of state.
        let last = (3..1000).map(|_| random.uniform(0.0, 1.0)).last();
        assert_eq!(last, Some(0.248_052_637_612_302_9));
    }
}
