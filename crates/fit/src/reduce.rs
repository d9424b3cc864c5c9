//! Pictures made of fewer pixels.

/// The picture of means over squares of `factor` pixels; what is left over at the right and below is left away evenly on both sides,
/// to half a pixel.
pub fn reduced(values: &[f64], [width, height]: [usize; 2], factor: usize) -> (Vec<f64>, [usize; 2]) {
    let size = [width / factor, height / factor];
    let [left, top] = [(width - size[0] * factor) / 2, (height - size[1] * factor) / 2];
    let mut means = Vec::with_capacity(size[0] * size[1]);
    for row in 0..size[1] {
        for column in 0..size[0] {
            let mut sum = 0.0;
            for y in 0..factor {
                let from = (top + row * factor + y) * width + left + column * factor;
                sum += values[from..from + factor].iter().sum::<f64>();
            }
            means.push(sum / (factor * factor) as f64);
        }
    }
    (means, size)
}
