//! Instruction sets: found at run time, chosen by name, and the one place where a kernel is compiled for
//! each.

use crate::Lane;

/// Work that is written once and compiled for every instruction set. Mark `run` with `#[inline(always)]`.
pub trait Kernel {
    /// What it returns.
    type Output;
    /// The work with lanes of type `L`.
    fn run<L: Lane>(self) -> Self::Output;
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Set {
    Scalar,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// An instruction set that this machine has: a value of this type is the proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Level(Set);

impl Level {
    /// Plain scalar code: the reference, everywhere.
    pub const SCALAR: Self = Self(Set::Scalar);
    /// Names of all sets that embate knows, slowest first.
    pub const NAMES: &'static [&'static str] = &["scalar", "avx2", "avx512"];

    /// The sets of this machine, slowest first.
    #[must_use]
    pub fn available() -> Vec<Self> {
        #[allow(unused_mut)]
        let mut levels = vec![Self::SCALAR];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                levels.push(Self(Set::Avx2));
            }
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                levels.push(Self(Set::Avx512));
            }
        }
        levels
    }

    /// The fastest set of this machine.
    #[must_use]
    pub fn best() -> Self {
        Self::available().into_iter().max().unwrap_or(Self::SCALAR)
    }

    /// A set by name; `None` when this machine lacks it or the name is unknown.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::available().into_iter().find(|level| level.name() == name)
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self.0 {
            Set::Scalar => "scalar",
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => "avx512",
        }
    }

    /// Runs a kernel with the lanes of this set.
    #[inline]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            Set::Scalar => run_scalar(kernel),
            // SAFETY: a `Level` with this set is only made after the features of the called function were
            // detected.
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => unsafe { run_avx2(kernel) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => unsafe { run_avx512(kernel) },
        }
    }
}

/// Not inlined, so that a kernel with several callers is compiled once.
#[inline(never)]
fn run_scalar<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(feature = "count")]
    return kernel.run::<crate::counted::Counted>();
    #[cfg(not(feature = "count"))]
    kernel.run::<f64>()
}

/// Begins the frame of the function that it is inlined into at a line of the cache, because something in it
/// has to: else registers of 64 bytes that don't fit are kept across two lines each.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn align_the_stack() {
    std::hint::black_box(&crate::Batch::default());
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
    align_the_stack();
    kernel.run::<crate::x86::F64x4>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,avx512f,avx512dq")]
fn run_avx512<K: Kernel>(kernel: K) -> K::Output {
    align_the_stack();
    kernel.run::<crate::x86::F64x8>()
}

/// Asks the memory for something that is read soon: a hint, which changes nothing but time.
#[inline(always)]
pub fn prefetch<T>(of: &T) {
    #[cfg(target_arch = "x86_64")]
    for line in (0..size_of::<T>()).step_by(LINE) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: the address lies in what is borrowed; every x86-64 processor has the instruction, which
        // reads nothing that a program could see.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(of).cast::<i8>().add(line)) }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = of;
}

/// The same for what lies so many items behind something, inside a list or beyond its end, and is read some
/// microseconds later: it goes to the second-level cache.
#[inline(always)]
pub fn prefetch_ahead<T>(of: &T, items: usize) {
    #[cfg(target_arch = "x86_64")]
    for line in (0..size_of::<T>()).step_by(LINE) {
        use std::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        let first = std::ptr::from_ref(of).wrapping_add(items).cast::<i8>();
        // SAFETY: as above; no address makes the instruction fail.
        unsafe { _mm_prefetch::<_MM_HINT_T1>(first.wrapping_add(line)) }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (of, items);
}

/// Bytes of a line of the cache.
#[cfg(target_arch = "x86_64")]
const LINE: usize = 64;
