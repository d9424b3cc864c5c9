//! Roots of polynomials in Bernstein's basis.

/// Intervals shorter than this share of the whole are not halved again: the polynomial touches zero there and turns
/// back, as far as double precision can tell.
const SHORTEST: f64 = 1.0 / (1_u64 << 46) as f64;

/// The first θ in [0, 1] at which Σ bₖ Bₖ(θ) changes sign and that is accepted.
///
/// Between 0 and 1 there are at most as many roots as the coefficients change sign, and an even number less (Descartes'
/// rule): none if they do not, one if they do once. What has more is halved by de Casteljau's rule, the earlier half
/// first, so that no root is missed and the first is found first (Lane & Riesenfeld 1981). One root alone is followed by
/// Newton's method within its bracket.
pub(super) fn first<const N: usize>(b: &[f64; N], mut accept: impl FnMut(f64) -> bool) -> Option<f64> {
    let mut changes = sign_changes(b);
    let (mut part, mut start, mut width) = (*b, 0.0, 1.0);
    // Parts behind, later ones first. Each halving leaves one, and there are at most 46 in a row.
    let mut rest = [(0.0, 0.0); 64];
    let mut height = 0;
    loop {
        if changes > 1 && width > SHORTEST {
            width *= 0.5;
            rest[height] = (start + width, width);
            height += 1;
            part = halves(&part).0;
            changes = sign_changes(&part);
            continue;
        }
        if changes == 1 {
            let theta = start + width * only(&part);
            if accept(theta) {
                return Some(theta);
            }
        }
        if height == 0 {
            return None;
        }
        height -= 1;
        (start, width) = rest[height];
        part = section(b, start, start + width);
        changes = sign_changes(&part);
    }
}

/// How often the coefficients change sign; zero counts as positive, so that a root where two pieces of a curve meet is
/// found in one of them.
fn sign_changes<const N: usize>(b: &[f64; N]) -> u32 {
    let mut changes = 0;
    for k in 1..N {
        changes += u32::from((b[k] < 0.0) != (b[k - 1] < 0.0));
    }
    changes
}

fn halves<const N: usize>(b: &[f64; N]) -> ([f64; N], [f64; N]) {
    split(b, 0.5)
}

/// The polynomial before and after θ.
fn split<const N: usize>(b: &[f64; N], theta: f64) -> ([f64; N], [f64; N]) {
    let (mut before, mut after) = (*b, *b);
    for level in 1..N {
        for k in 0..N - level {
            after[k] += theta * (after[k + 1] - after[k]);
        }
        before[level] = after[0];
    }
    (before, after)
}

/// The polynomial from `start` to `end`, rescaled to [0, 1].
fn section<const N: usize>(b: &[f64; N], start: f64, end: f64) -> [f64; N] {
    let after = split(b, start).1;
    if end >= 1.0 { after } else { split(&after, (end - start) / (1.0 - start)).0 }
}

/// The value at θ, and the slope.
fn tangent<const N: usize>(b: &[f64; N], theta: f64) -> [f64; 2] {
    let mut row = *b;
    for level in 1..N - 1 {
        for k in 0..N - level {
            row[k] += theta * (row[k + 1] - row[k]);
        }
    }
    let rise = row[1] - row[0];
    [row[0] + theta * rise, rise * (N - 1) as f64]
}

/// The one root of a polynomial that has one.
fn only<const N: usize>(b: &[f64; N]) -> f64 {
    let falling = b[0] >= 0.0;
    let (mut low, mut high) = (0.0, 1.0);
    let mut theta = (b[0] / (b[0] - b[N - 1])).clamp(0.0, 1.0);
    for _ in 0..60 {
        let [value, slope] = tangent(b, theta);
        if value == 0.0 {
            return theta;
        }
        if (value > 0.0) == falling {
            low = theta;
        } else {
            high = theta;
        }
        let newton = theta - value / slope;
        // Also what is not a number.
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let step = (next - theta).abs();
        theta = next;
        if step < 1e-15 {
            break;
        }
    }
    theta
}

/// The products of binomials C(7, i) C(7, j)/C(14, i + j) by which Bernstein's coefficients of degree 7 are multiplied.
const SHARES: [[f64; 8]; 8] = {
    let row = [1.0, 7.0, 21.0, 35.0, 35.0, 21.0, 7.0, 1.0];
    let double = [
        1.0, 14.0, 91.0, 364.0, 1001.0, 2002.0, 3003.0, 3432.0, 3003.0, 2002.0, 1001.0, 364.0, 91.0, 14.0,
        1.0,
    ];
    let mut shares = [[0.0; 8]; 8];
    let mut i = 0;
    while i < 8 {
        let mut j = 0;
        while j < 8 {
            shares[i][j] = row[i] * row[j] / double[i + j];
            j += 1;
        }
        i += 1;
    }
    shares
};

/// Σᵢ sᵢ pᵢ² of polynomials of degree 7.
pub(super) fn sum_of_squares<const M: usize>(polynomials: &[[f64; 8]; M], signs: &[f64; M]) -> [f64; 15] {
    let mut sum = [0.0; 15];
    for i in 0..8 {
        for j in 0..8 {
            let mut product = 0.0;
            for m in 0..M {
                product += signs[m] * polynomials[m][i] * polynomials[m][j];
            }
            sum[i + j] += SHARES[i][j] * product;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Π (θ − rᵢ) in Bernstein's basis: with θ − r = (1 − θ)(−r) + θ(1 − r).
    fn with_roots<const N: usize>(roots: &[f64]) -> [f64; N] {
        let mut b = [0.0; N];
        b[0] = 1.0;
        for (degree, r) in roots.iter().enumerate() {
            let d = (degree + 1) as f64;
            let mut next = [0.0; N];
            for k in 0..=degree {
                next[k] += b[k] * -r * (d - k as f64) / d;
                next[k + 1] += b[k] * (1.0 - r) * (k + 1) as f64 / d;
            }
            b = next;
        }
        b
    }

    #[test]
    fn roots_come_one_by_one() {
        let roots = [0.9, 0.25, 0.26, 0.9001, 1.5, -2.0];
        let b: [f64; 7] = with_roots(&roots);
        let mut found = Vec::new();
        assert_eq!(
            first(&b, |theta| {
                found.push(theta);
                false
            }),
            None
        );
        for (found, expected) in found.iter().zip([0.25, 0.26, 0.9, 0.9001]) {
            assert!((found - expected).abs() < 1e-11, "{found} {expected}");
        }
        assert_eq!(found.len(), 4);
        assert!((first(&b, |theta| theta > 0.5).unwrap() - 0.9).abs() < 1e-11);
    }

    #[test]
    fn what_touches_zero_ends() {
        let b: [f64; 5] = with_roots(&[0.3, 0.3, 2.0, -1.0]);
        // Rounding may make two roots of it or none, but they are there.
        if let Some(theta) = first(&b, |_| true) {
            assert!((theta - 0.3).abs() < 1e-7);
        }
        assert_eq!(first(&[1.0, -0.2, -0.2, 1.0], |_| false), None);
        assert_eq!(first(&[f64::NAN; 4], |_| true), None);
    }

    #[test]
    fn squares_of_polynomials() {
        // θ as a polynomial of degree 7, and 1.
        let theta: [f64; 8] = std::array::from_fn(|k| k as f64 / 7.0);
        let b = sum_of_squares(&[theta, [1.0; 8]], &[1.0, -0.25]);
        assert!((first(&b, |_| true).unwrap() - 0.5).abs() < 1e-15);
    }
}
