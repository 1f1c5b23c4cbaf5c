//! Bins, to find surfaces that are near a given one without asking all.

/// Where a surface is, as far as bins see it.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// Surfaces of different kinds are never near each other.
    pub kind: i64,
    pub at: [f64; 3],
    pub extra: f64,
}

impl Place {
    /// The bin of width `width` that this place is in.
    pub fn key(&self, width: f64) -> [i64; 5] {
        let bin = |v: f64| (v / width).floor() as i64;
        [self.kind, bin(self.at[0]), bin(self.at[1]), bin(self.at[2]), bin(self.extra)]
    }

    /// The bins in which a surface within `reach` of this place may be.
    pub fn keys(&self, width: f64, reach: f64) -> Vec<[i64; 5]> {
        let mut keys = vec![self.key(width)];
        for (slot, v) in [(1, self.at[0]), (2, self.at[1]), (3, self.at[2]), (4, self.extra)] {
            let bin = |v: f64| (v / width).floor() as i64;
            let (low, high) = (bin(v - reach), bin(v + reach));
            if low != high {
                let here = bin(v);
                let other = if here == low { high } else { low };
                for i in 0..keys.len() {
                    let mut key = keys[i];
                    key[slot] = other;
                    keys.push(key);
                }
            }
        }
        keys
    }
}
