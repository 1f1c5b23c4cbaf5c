//! The same code compiled for machines of several kinds; which one is chosen when it runs.

use super::PACKETS;
use super::walk::{Packet, Scenery, Work, walk};

/// What the lanes are compiled for. All give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backend {
    /// AVX-512: eight lanes are one register.
    Avx512,
    /// AVX2: eight lanes are two registers.
    Avx2,
    /// Whatever the compiler was told to expect of any machine.
    Portable,
}

impl Backend {
    /// All of them, fastest first.
    pub const ALL: [Self; 3] = [Self::Avx512, Self::Avx2, Self::Portable];

    /// Whether this machine can run it.
    pub fn is_available(self) -> bool {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => has_avx512(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => std::arch::is_x86_feature_detected!("avx2"),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx512 | Self::Avx2 => false,
            Self::Portable => true,
        }
    }

    /// The fastest that this machine can run.
    pub fn best() -> Self {
        Self::ALL.into_iter().find(|backend| backend.is_available()).unwrap_or(Self::Portable)
    }
}

#[cfg(target_arch = "x86_64")]
fn has_avx512() -> bool {
    use std::arch::is_x86_feature_detected as has;
    has!("avx512f") && has!("avx512dq") && has!("avx512vl") && has!("avx512bw")
}

/// [`walk`], as compiled for a backend; as for any machine where this one lacks it.
pub(super) fn walk_on(backend: Backend, scenery: &Scenery, packets: &mut [Packet; PACKETS]) -> Work {
    if !backend.is_available() {
        return walk(scenery, packets);
    }
    match backend {
        // SAFETY: the machine has what the function is compiled for, as was just asked.
        #[cfg(target_arch = "x86_64")]
        Backend::Avx512 => unsafe { walk_avx512(scenery, packets) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Backend::Avx2 => unsafe { walk_avx2(scenery, packets) },
        _ => walk(scenery, packets),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
fn walk_avx512(scenery: &Scenery, packets: &mut [Packet; PACKETS]) -> Work {
    walk(scenery, packets)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn walk_avx2(scenery: &Scenery, packets: &mut [Packet; PACKETS]) -> Work {
    walk(scenery, packets)
}
