//! Geometries against closed forms.

mod between;
mod checks;
mod connection;
mod curvature;
mod great_circles;
mod lengths;
mod orbits;

/// Points that look like chance, the same each time: coordinate `i` in `ranges[i]`.
fn points<const N: usize>(count: usize, ranges: [[f64; 2]; N]) -> Vec<[f64; N]> {
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..count).map(|_| ranges.map(|[low, high]| low + (high - low) * next())).collect()
}

fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} is not {expected}: off by {:.1e}",
        found - expected
    );
}
