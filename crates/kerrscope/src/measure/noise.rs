//! The noise of a picture's pixels.

/// Its standard deviation, from second differences in both directions, of which all that is smooth drops out (Immerkær 1996, CVIU 64,
/// 300), and whose median edges hardly move. Values are along the rows of a picture of a width and a height; 0 if it has less than 3 × 3
/// pixels.
pub fn noise(values: &[f64], [width, height]: [usize; 2]) -> f64 {
    let mut differences = Vec::new();
    for row in 1..height.saturating_sub(1) {
        for column in 1..width.saturating_sub(1) {
            let at = |x: usize, y: usize| values[(row + y - 1) * width + column + x - 1];
            let corners = at(0, 0) + at(2, 0) + at(0, 2) + at(2, 2);
            let sides = at(1, 0) + at(0, 1) + at(2, 1) + at(1, 2);
            differences.push((corners - 2.0 * sides + 4.0 * at(1, 1)).abs() / 6.0);
        }
    }
    if differences.is_empty() {
        return 0.0;
    }
    let middle = differences.len() / 2;
    *differences.select_nth_unstable_by(middle, f64::total_cmp).1 / 0.674_489_75
}
