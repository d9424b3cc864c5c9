//! The vector instructions that work is done with.

use fearless_simd::Simd;

/// A set of vector instructions. Results of different sets differ by rounding.
#[derive(Clone, Copy, Debug, Eq, Ord, PartialEq, PartialOrd)]
pub enum Level {
    /// What every processor of the architecture has.
    Baseline,
    /// AVX2 with fused multiply-add.
    Avx2,
    /// AVX-512.
    Avx512,
}

/// Work that can be done on lanes.
pub trait OnLanes {
    /// What it gives.
    type Output;
    /// Does it.
    fn run<L: Simd>(self, simd: L) -> Self::Output;
}

impl Level {
    /// Every level, the least first.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// The best that this processor has.
    pub fn best() -> Self {
        Self::ALL.into_iter().rfind(|level| level.is_available()).unwrap_or(Self::Baseline)
    }

    /// Whether this processor has it.
    pub fn is_available(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        let (avx2, avx512) = {
            let best = fearless_simd::Level::new();
            (best.as_avx2().is_some(), best.as_avx512().is_some())
        };
        #[cfg(not(target_arch = "x86_64"))]
        let (avx2, avx512) = (false, false);
        match self {
            Self::Baseline => true,
            Self::Avx2 => avx2,
            Self::Avx512 => avx512,
        }
    }

    /// That of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|level| level.name() == name)
    }

    /// Its name: "baseline", "avx2" or "avx512".
    pub const fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// Does work with these instructions, or the best below them that there are; gives it back if those are
    /// the baseline's.
    ///
    /// # Errors
    /// The work, undone.
    pub fn run_wide<W: OnLanes>(self, work: W) -> Result<W::Output, W> {
        #[cfg(target_arch = "x86_64")]
        {
            let best = fearless_simd::Level::new();
            if let (Self::Avx512, Some(simd)) = (self, best.as_avx512()) {
                return Ok(simd.vectorize(
                    #[inline(always)]
                    || work.run(simd),
                ));
            }
            if let (Self::Avx512 | Self::Avx2, Some(simd)) = (self, best.as_avx2()) {
                return Ok(simd.vectorize(
                    #[inline(always)]
                    || work.run(simd),
                ));
            }
        }
        Err(work)
    }

    /// Does work with these instructions, or the best below them that there are.
    pub fn run<W: OnLanes>(self, work: W) -> W::Output {
        let work = match self.run_wide(work) {
            Ok(done) => return done,
            Err(work) => work,
        };
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = fearless_simd::Level::new().as_sse2() {
            return work.run(simd);
        }
        // Only architectures whose own baseline is one level come here.
        fearless_simd::dispatch!(fearless_simd::Level::baseline(), simd => work.run(simd))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Widest;

    impl OnLanes for Widest {
        type Output = &'static str;
        fn run<L: Simd>(self, _simd: L) -> &'static str {
            std::any::type_name::<L>()
        }
    }

    #[test]
    fn work_runs_at_the_level_asked_for() {
        assert!(Level::Baseline.is_available());
        assert!(Level::ALL.into_iter().all(|level| Level::named(level.name()) == Some(level)));
        assert_eq!(Level::named("avx"), None);
        for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
            let ran = level.run(Widest).to_lowercase();
            assert!(level == Level::Baseline || ran.contains(level.name()), "{ran} for {level:?}");
        }
    }
}
