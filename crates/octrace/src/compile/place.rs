//! Bins, to find surfaces that are near a given one without asking all.

use rustc_hash::FxHasher;
use std::hash::Hasher;

/// Where a surface is, as far as bins see it.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// Surfaces of different kinds are never near each other.
    pub kind: u8,
    pub at: [f64; 3],
    pub extra: f64,
}

impl Place {
    /// The bin of width `width` that this place is in.
    pub fn own_bin(&self, width: f64) -> u64 {
        let [x, y, z] = self.at;
        self.bin([x, y, z, self.extra].map(|v| floor(v / width)))
    }

    /// Calls `visit` with the bins of width `width` in which a surface within `reach` of this place may be.
    pub fn for_each_bin(&self, width: f64, reach: f64, mut visit: impl FnMut(u64)) {
        let bin = |v: f64| floor(v / width);
        let places = [self.at[0], self.at[1], self.at[2], self.extra];
        let here = places.map(bin);
        // The other bin along each of the four coordinates, where one is near enough.
        let other: [Option<i64>; 4] = std::array::from_fn(|i| {
            let (low, high) = (bin(places[i] - reach), bin(places[i] + reach));
            (low != high).then(|| if here[i] == low { high } else { low })
        });
        for choice in 0..16_usize {
            if (0..4).all(|i| choice >> i & 1 == 0 || other[i].is_some()) {
                visit(self.bin(std::array::from_fn(|i| match other[i] {
                    Some(other) if choice >> i & 1 == 1 => other,
                    _ => here[i],
                })));
            }
        }
    }

    /// A number for a bin. Should two bins ever share one, they are searched together.
    fn bin(&self, bins: [i64; 4]) -> u64 {
        let mut hasher = FxHasher::default();
        hasher.write_u8(self.kind);
        for bin in bins {
            hasher.write_i64(bin);
        }
        hasher.finish()
    }
}

/// The greatest integer up to `v`. (The standard library's is a function call where nothing is known of the processor.)
#[inline]
fn floor(v: f64) -> i64 {
    let truncated = v as i64;
    truncated - i64::from((truncated as f64) > v)
}
