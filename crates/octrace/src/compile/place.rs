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
        self.bin([x, y, z, self.extra].map(|v| place_in_row(v, width)))
    }

    /// Calls `visit` with the bins of width `width` in which a surface within `reach` of this place may be.
    pub fn for_each_bin(&self, width: f64, reach: f64, mut visit: impl FnMut(u64)) {
        let [x, y, z] = self.at;
        let places = [x, y, z, self.extra];
        let bin = |v: f64| place_in_row(v, width);
        let here = places.map(bin);
        // The other bin along each coordinate that is near enough to one.
        let mut others = [(0, 0); 4];
        let mut count = 0;
        for (i, &v) in places.iter().enumerate() {
            let (low, high) = (bin(v - reach), bin(v + reach));
            if low != high {
                others[count] = (i, if here[i] == low { high } else { low });
                count += 1;
            }
        }
        for choice in 0..1_usize << count {
            let mut bins = here;
            for (i, &(axis, other)) in others[..count].iter().enumerate() {
                if choice >> i & 1 == 1 {
                    bins[axis] = other;
                }
            }
            visit(self.bin(bins));
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

/// Which bin of a row a coordinate is in. Round numbers, such as zero, are kept off the borders of bins.
#[inline]
fn place_in_row(v: f64, width: f64) -> i64 {
    const SHIFT: f64 = 0.37;
    let v = v / width + SHIFT;
    // The greatest integer up to `v`; the standard library's `floor` is a function call on processors of any kind.
    let truncated = v as i64;
    truncated.saturating_sub(i64::from((truncated as f64) > v))
}
