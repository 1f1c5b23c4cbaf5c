//! The same code compiled for machines of several kinds; which one is chosen when it runs.

#[cfg(target_arch = "x86_64")]
use super::lanes::{Avx2, Avx512};
use super::lanes::{Isa, Kernel, Portable};
use std::marker::PhantomData;

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
    let wide = has!("avx512f") && has!("avx512dq") && has!("avx512vl") && has!("avx512bw");
    wide && has!("bmi1") && has!("bmi2") && has!("lzcnt") && has!("popcnt")
}

/// A task that is compiled for several machines. Its `run` must be `#[inline(always)]`, to be compiled as part of a function
/// that may use the wide registers.
pub(crate) trait Task {
    /// Does it, with those instructions.
    fn run<I: Isa>(self);
}

/// A task, and the instructions for it.
struct With<I, T>(T, PhantomData<I>);

impl<I: Isa, T: Task> Kernel for With<I, T> {
    #[inline(always)]
    fn run(self) {
        self.0.run::<I>();
    }
}

impl Backend {
    /// Does a task, as compiled for this backend; as for any machine where this one lacks it.
    pub(crate) fn run(self, task: impl Task) {
        fn with<I: Isa>(task: impl Task) {
            I::call(With(task, PhantomData::<I>));
        }
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 if self.is_available() => with::<Avx512>(task),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 if self.is_available() => with::<Avx2>(task),
            _ => with::<Portable>(task),
        }
    }
}
