//! How many runs of a sweep or a fit are made at a time, and by which instructions.

use crate::machine;
use clap::Args;

/// Neither changes a result.
#[derive(Args)]
pub(crate) struct Jobs {
    /// Runs at a time, each on one thread; 0: one per processor (changes no result)
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(..=1024))]
    jobs: u16,
    /// Instruction set: scalar, avx2, avx512 [default: the best of this machine] (changes no result)
    #[arg(long, value_name = "LEVEL")]
    pub(crate) simd: Option<String>,
}

impl Jobs {
    /// Runs at a time.
    pub(crate) fn count(&self) -> usize {
        match self.jobs {
            0 => machine::processors(),
            jobs => jobs.into(),
        }
    }
}
