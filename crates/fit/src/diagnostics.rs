//! Whether chains have become one: rank-normalised split R̂, and the number of independent draws that they are worth (Vehtari, Gelman,
//! Simpson, Carpenter & Bürkner 2021, Bayesian Analysis 16, 667).

/// The convergence of one quantity.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Convergence {
    /// The larger of R̂ of the ranks and of their distances from the median.
    pub r_hat: f64,
    /// Effective number of draws for what lies in the middle.
    pub bulk: f64,
    /// The smaller of those for the 5 % and the 95 % quantile.
    pub tail: f64,
}

impl Convergence {
    /// That of chains of equal lengths, four draws each at least.
    pub fn of(chains: &[Vec<f64>]) -> Self {
        let halves = split(chains);
        let all = sorted(&halves);
        let (first, last) = (all[0], all[all.len() - 1]);
        if !(last > first) {
            // What never changed has not converged, it has not moved.
            return Self { r_hat: f64::NAN, bulk: f64::NAN, tail: f64::NAN };
        }
        let median = quantile(&all, 0.5);
        let folded: Vec<Vec<f64>> =
            halves.iter().map(|chain| chain.iter().map(|x| (x - median).abs()).collect()).collect();
        let ranks = normal_ranks(&halves);
        let below = |share: f64| {
            let bound = quantile(&all, share);
            let hit = |x: &f64| if *x <= bound { 1.0 } else { 0.0 };
            effective(&halves.iter().map(|chain| chain.iter().map(hit).collect()).collect::<Vec<_>>())
        };
        Self {
            r_hat: r_hat(&ranks).max(r_hat(&normal_ranks(&folded))),
            bulk: effective(&ranks),
            tail: below(0.05).min(below(0.95)),
        }
    }
}

fn split(chains: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let half = chains.iter().map(Vec::len).min().unwrap_or(0) / 2;
    chains.iter().flat_map(|chain| [chain[..half].to_vec(), chain[chain.len() - half..].to_vec()]).collect()
}

fn sorted(chains: &[Vec<f64>]) -> Vec<f64> {
    let mut all: Vec<f64> = chains.iter().flatten().copied().collect();
    all.sort_by(f64::total_cmp);
    all
}

/// The value below which a share of sorted numbers lies, between them by a straight line.
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let below = (place as usize).min(sorted.len().saturating_sub(2));
    match sorted {
        [only] => *only,
        _ => sorted[below] + (place - below as f64) * (sorted[below + 1] - sorted[below]),
    }
}

/// Ranks among all draws, ties their mean, as quantiles of a Gaussian: Φ⁻¹((rank − 3/8)/(n + 1/4)).
fn normal_ranks(chains: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let all = sorted(chains);
    let rank = |x: &f64| {
        let (low, high) = (all.partition_point(|y| y < x), all.partition_point(|y| y <= x));
        let mean = 0.5 * (low + high + 1) as f64;
        normal_quantile((mean - 0.375) / (all.len() as f64 + 0.25))
    };
    chains.iter().map(|chain| chain.iter().map(rank).collect()).collect()
}

/// Φ⁻¹, by Newton's method.
pub fn normal_quantile(p: f64) -> f64 {
    let p = p.clamp(1e-12, 1.0 - 1e-12);
    // A rational start (Abramowitz & Stegun 1964, 26.2.23), off by 4.5e-4.
    let tail = p.min(1.0 - p);
    let t = (-2.0 * tail.ln()).sqrt();
    let start = t
        - (2.515_517 + t * (0.802_853 + t * 0.010_328))
            / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308)));
    let mut x = if p < 0.5 { -start } else { start };
    for _ in 0..3 {
        let density = (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
        x -= ((normal_share(x) - p) / density).clamp(-0.5, 0.5);
    }
    x
}

/// Φ: ½ + φ(x) Σ x^(2k+1)/(2k+1)!! near the middle, a continued fraction in the tails (Abramowitz & Stegun 1964, 26.2.11, 26.2.14).
pub fn normal_share(x: f64) -> f64 {
    let density = (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
    let size = x.abs();
    let tail = if size < 3.5 {
        let (mut term, mut sum) = (size, size);
        for k in 1..120 {
            term *= size * size / f64::from(2 * k + 1);
            sum += term;
        }
        0.5 - density * sum
    } else {
        let mut fraction = size;
        for k in (1..60).rev() {
            fraction = size + f64::from(k) / fraction;
        }
        density / fraction
    };
    if x > 0.0 { 1.0 - tail } else { tail }
}

fn mean(x: &[f64]) -> f64 {
    x.iter().sum::<f64>() / x.len() as f64
}

fn variance(x: &[f64]) -> f64 {
    let m = mean(x);
    x.iter().map(|x| (x - m).powi(2)).sum::<f64>() / (x.len() - 1) as f64
}

/// Mean variance within chains, and the estimate from within and between.
fn variances(chains: &[Vec<f64>]) -> [f64; 2] {
    let n = chains[0].len() as f64;
    let within = chains.iter().map(|c| variance(c)).sum::<f64>() / chains.len() as f64;
    let means: Vec<f64> = chains.iter().map(|c| mean(c)).collect();
    let between = if chains.len() > 1 { variance(&means) } else { 0.0 };
    [within, (n - 1.0) / n * within + between]
}

fn r_hat(chains: &[Vec<f64>]) -> f64 {
    let [within, all] = variances(chains);
    (all / within).sqrt()
}

/// Effective number of draws, by Geyer's initial monotone sequence (eq. 10 to 13).
fn effective(chains: &[Vec<f64>]) -> f64 {
    let (m, n) = (chains.len() as f64, chains[0].len());
    let [within, all] = variances(chains);
    if !(within > 0.0) {
        return f64::NAN;
    }
    let means: Vec<f64> = chains.iter().map(|c| mean(c)).collect();
    let correlation = |lag: usize| {
        let covariance = chains
            .iter()
            .zip(&means)
            .map(|(c, mean)| {
                (0..n - lag).map(|k| (c[k] - mean) * (c[k + lag] - mean)).sum::<f64>() / n as f64
            })
            .sum::<f64>()
            / m;
        1.0 - (within - covariance * n as f64 / (n - 1) as f64) / all
    };
    let (mut time, mut least, mut lag) = (-1.0, f64::INFINITY, 0);
    while lag + 1 < n {
        let pair = (if lag == 0 { 1.0 } else { correlation(lag) }) + correlation(lag + 1);
        if pair < 0.0 {
            break;
        }
        least = least.min(pair);
        time += 2.0 * least;
        lag += 2;
    }
    let draws = m * n as f64;
    // Antithetic chains may be worth more than their draws, up to this.
    draws / time.max(1.0 / draws.log10())
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    fn chains(correlation: f64, count: usize, shift: f64) -> Vec<Vec<f64>> {
        let mut rng = rand_pcg::Pcg64Mcg::seed_from_u64(3);
        (0..4)
            .map(|chain| {
                let mut x: f64 = StandardNormal.sample(&mut rng);
                let mut draw = || {
                    let noise: f64 = StandardNormal.sample(&mut rng);
                    x = correlation * x + (1.0 - correlation * correlation).sqrt() * noise;
                    x + shift * f64::from(chain)
                };
                (0..count).map(|_| draw()).collect()
            })
            .collect()
    }

    /// An autoregressive chain is worth n (1 − ρ)/(1 + ρ) draws.
    #[test]
    fn known_chains() {
        for rho in [0.0_f64, 0.5, 0.9, -0.4] {
            let found = Convergence::of(&chains(rho, 4000, 0.0));
            let expected = 16_000.0 * (1.0 - rho) / (1.0 + rho);
            assert!((found.bulk / expected - 1.0).abs() < 0.15, "{rho} {found:?} {expected}");
            assert!(found.r_hat < 1.01, "{found:?}");
        }
        assert!(Convergence::of(&chains(0.0, 500, 0.5)).r_hat > 1.1);
        assert!(Convergence::of(&[vec![1.0; 10], vec![1.0; 10]]).r_hat.is_nan());
    }

    #[test]
    fn the_normal_distribution() {
        for (x, share) in [
            (0.0, 0.5),
            (1.0, 0.841_344_746_068_542_9),
            (-3.0, 1.349_898_031_630_094_5e-3),
            (5.0, 1.0 - 2.866_515_718_791_939e-7),
        ] {
            assert!((normal_share(x) - share).abs() < 1e-13, "{x} {}", normal_share(x));
            assert!((normal_quantile(share) - x).abs() < 1e-7);
        }
    }
}
