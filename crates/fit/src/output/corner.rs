//! Corner plots: the posterior of each parameter, and of each two, as SVG.

use std::f64::consts::TAU;
use std::fmt::Write;

use kerrscope::display::chart::Scale;

use super::density::Density;
use crate::diagnostics::quantile;
use crate::fit::Fit;

/// The side of a panel, and the space between panels.
const PANEL: f64 = 132.0;
const GAP: f64 = 8.0;
/// Left, top, right and bottom.
const MARGINS: [f64; 4] = [92.0, 72.0, 24.0, 84.0];
/// What stands above a panel of the diagonal.
const HEAD: f64 = 34.0;
/// Characters of the usual size above a panel.
const WORDS: f64 = 24.0;

/// Shares of the posterior that lie in the shaded regions: those of a Gaussian in two dimensions within 1 σ and 2 σ, 1 − exp(−n²/2).
const SHARES: [f64; 2] = [0.8647, 0.3935];
const SHADES: [&str; 2] = ["#c9d8ec", "#7f9fca"];
const INK: &str = "#205090";

/// The shares of the draws that may lie beyond either end of an axis, and what is added to it there, as a share of its length.
const BEYOND: f64 = 0.002;
const BESIDE: f64 = 0.06;

/// Most draws that are shown as points in a panel, bins of a histogram, and ticks of an axis.
const POINTS: usize = 800;
const BINS: usize = 40;
const TICKS: usize = 4;

/// A period of angles.
const TURN: f64 = 360.0;

/// A free parameter's draws and how they are laid along a side of a panel.
struct Axis {
    name: String,
    unit: String,
    /// Draws of all chains.
    values: Vec<f64>,
    /// 16 %, 50 % and 84 % of them lie below; none if there are none.
    quantiles: Option<[f64; 3]>,
    range: [f64; 2],
    angle: bool,
}

impl Axis {
    fn of(fit: &Fit, k: usize) -> Self {
        let (name, unit) = fit.free[k].clone();
        let mut values: Vec<f64> = fit.draws.iter().flatten().map(|draw| draw[k]).collect();
        let angle = name == "position_angle";
        if angle {
            unwrap(&mut values);
        }
        let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let at = |share| quantile(&sorted, share);
        let (mut range, mut quantiles) = ([0.0, 1.0], None);
        if !sorted.is_empty() {
            quantiles = Some([0.16, 0.5, 0.84].map(at));
            let [low, high] = [at(BEYOND), at(1.0 - BEYOND)];
            let beside = BESIDE * (high - low);
            // One value alone is in the middle.
            let alone = if low == 0.0 { 1.0 } else { 0.1 * low.abs() };
            let aside = if beside > 0.0 { beside } else { alone };
            range = [low - aside, high + aside];
        }
        Self { name, unit, values, quantiles, range, angle }
    }

    /// The place of a value as a share of the axis.
    fn share(&self, value: f64) -> f64 {
        (value - self.range[0]) / (self.range[1] - self.range[0])
    }

    fn label(&self) -> String {
        if self.unit.is_empty() {
            escaped(&self.name)
        } else {
            escaped(&format!("{} ({})", self.name, self.unit))
        }
    }

    /// The median and how far it is to the ends of the 68 % interval.
    fn interval(&self) -> String {
        let Some([low, middle, high]) = self.quantiles else { return "no draws".to_owned() };
        let shown = if self.angle { middle.rem_euclid(TURN) } else { middle };
        measured(shown, high - middle, middle - low)
    }
}

/// Brings angles within half a turn of their mean direction, which is within [0°, 360°).
fn unwrap(angles: &mut [f64]) {
    let (mut x, mut y) = (0.0, 0.0);
    for angle in angles.iter() {
        let (sin, cos) = (angle / TURN * TAU).sin_cos();
        (x, y) = (x + cos, y + sin);
    }
    let middle = (y.atan2(x) / TAU * TURN).rem_euclid(TURN);
    for angle in angles {
        *angle = middle + (*angle - middle + 0.5 * TURN).rem_euclid(TURN) - 0.5 * TURN;
    }
}

/// A number with what is to be added and taken away, to two digits of the smaller of these.
fn measured(value: f64, more: f64, less: f64) -> String {
    let spread = if more > 0.0 && less > 0.0 { more.min(less) } else { more.max(less) };
    if !(spread > 0.0) {
        return format!("{value}").replace('-', "−");
    }
    let largest = value.abs().max(more).max(less);
    let first = largest.log10().floor() as i32;
    // As numbers are written on axes.
    let power = if (1e-3..1e6).contains(&largest) { 0 } else { first };
    let digits = (1 - spread.log10().floor() as i32 + power).clamp(0, 15) as usize;
    let unit = 10_f64.powi(power);
    let [value, more, less] = [value, more, less].map(|number| format!("{:.digits$}", number / unit));
    let text = format!("{value} +{more} −{less}").replace('-', "−");
    if power == 0 { text } else { format!("({text})·10{}", raised(power)) }
}

fn raised(power: i32) -> String {
    let raise = |c: char| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    };
    power.to_string().chars().map(raise).collect()
}

/// A corner plot of all free parameters: on the diagonal the histogram of each, with its median and 68 % interval above it and as
/// lines; below it, for each two, the regions of highest density that hold 39 % and 86 % of the draws, and draws as points.
///
/// Axes show the middle 99.6 % of the draws and a little more. Angles (`position_angle`, in degrees) go around their mean
/// direction, so that those around North may be above 360 or below 0.
pub fn corner(fit: &Fit, title: &str) -> String {
    let axes: Vec<Axis> = (0..fit.free.len()).map(|k| Axis::of(fit, k)).collect();
    let [left, top, right, bottom] = MARGINS;
    let side = axes.len() as f64 * (PANEL + GAP) - GAP;
    let (width, height) = ((left + side + right).max(420.0), top + side.max(0.0) + bottom);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"{}\" y=\"24\" text-anchor=\"end\" font-size=\"15\">{}</text>\n",
        width - right,
        escaped(title)
    );
    let place = |k: usize| k as f64 * (PANEL + GAP);
    for (row, up) in axes.iter().enumerate() {
        for (column, across) in axes[..=row].iter().enumerate() {
            let (x, y) = (left + place(column), top + place(row));
            // An inner picture shows nothing beyond its edges.
            let _ = write!(
                svg,
                "<svg x=\"{x}\" y=\"{y}\" width=\"{PANEL}\" height=\"{PANEL}\" class=\"{}\">",
                if row == column { "one" } else { "two" }
            );
            if row == column {
                histogram(&mut svg, across);
            } else {
                pair(&mut svg, across, up);
            }
            let _ = writeln!(
                svg,
                "</svg><rect x=\"{x}\" y=\"{y}\" width=\"{PANEL}\" height=\"{PANEL}\" fill=\"none\" stroke=\"#000\"/>"
            );
            if row == column {
                head(&mut svg, across, [x, y]);
            }
            if row + 1 == axes.len() {
                below(&mut svg, across, [x, y + PANEL]);
            }
            if column == 0 && row > 0 {
                beside(&mut svg, up, [x, y]);
            }
        }
    }
    svg.push_str("</svg>\n");
    svg
}

/// Name and interval above a panel.
fn head(svg: &mut String, axis: &Axis, [x, y]: [f64; 2]) {
    let middle = x + 0.5 * PANEL;
    let interval = axis.interval();
    // Many digits are written smaller, so that they stay beside those of the next panel.
    let size = (11.0 * WORDS / interval.chars().count() as f64).min(11.0);
    let _ = writeln!(
        svg,
        "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\" font-weight=\"bold\">{}</text>\
         <text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\" font-size=\"{size:.1}\" class=\"interval\">{interval}</text>",
        y - HEAD + 14.0,
        axis.label(),
        y - HEAD + 28.0,
    );
}

/// A stair of bins, and lines at the median and the ends of the interval.
fn histogram(svg: &mut String, axis: &Axis) {
    let within =
        axis.values.iter().map(|value| axis.share(*value)).filter(|share| (0.0..=1.0).contains(share));
    let count = ((axis.values.len() as f64).sqrt() as usize).clamp(8, BINS);
    let mut bins = vec![0_u32; count];
    for share in within {
        bins[((share * count as f64) as usize).min(count - 1)] += 1;
    }
    let peak = f64::from(bins.iter().copied().max().unwrap_or(0).max(1));
    let mut way = format!("M0 {PANEL}");
    for (k, bin) in bins.iter().enumerate() {
        let y = PANEL - 0.9 * PANEL * f64::from(*bin) / peak;
        let _ = write!(way, "V{y:.2}H{:.2}", PANEL * (k + 1) as f64 / count as f64);
    }
    let _ = write!(
        svg,
        "<path d=\"{way}V{PANEL}\" fill=\"{}\" stroke=\"{INK}\" stroke-width=\"1.2\" stroke-linejoin=\"round\"/>",
        SHADES[0]
    );
    for (k, value) in axis.quantiles.iter().flatten().enumerate() {
        let dashes = if k == 1 { "" } else { " stroke-dasharray=\"4 3\"" };
        let _ =
            write!(svg, "<path d=\"M{:.2} 0V{PANEL}\" stroke=\"#000\"{dashes}/>", PANEL * axis.share(*value));
    }
}

/// Points below regions of highest density.
fn pair(svg: &mut String, across: &Axis, up: &Axis) {
    let shares = || {
        let pairs = across.values.iter().zip(&up.values);
        pairs.map(|(x, y)| [across.share(*x), up.share(*y)])
    };
    let place = |[x, y]: [f64; 2]| (PANEL * x, PANEL * (1.0 - y));
    let mut points = String::new();
    for point in shares().step_by(across.values.len().div_ceil(POINTS).max(1)) {
        if point.iter().all(|share| (0.0..=1.0).contains(share)) {
            let (x, y) = place(point);
            let _ = write!(points, "M{x:.1} {y:.1}h0");
        }
    }
    let _ = write!(
        svg,
        "<path d=\"{points}\" class=\"points\" stroke=\"{INK}\" stroke-opacity=\"0.5\" stroke-width=\"1.6\" \
         stroke-linecap=\"round\"/>"
    );
    let Some(density) = Density::of(shares()) else { return };
    for (share, shade) in SHARES.into_iter().zip(SHADES) {
        let region = density.region(density.level(share));
        let mut way = String::new();
        for piece in &region.pieces {
            for (k, corner) in piece.iter().enumerate() {
                let (x, y) = place(*corner);
                let _ = write!(way, "{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' });
            }
            way.push('Z');
        }
        let mut edge = String::new();
        for [from, to] in &region.edges {
            let ((x, y), (x_to, y_to)) = (place(*from), place(*to));
            let _ = write!(edge, "M{x:.2} {y:.2}L{x_to:.2} {y_to:.2}");
        }
        // The pieces' own outline covers the seams between them.
        let _ = write!(
            svg,
            "<path d=\"{way}\" fill=\"{shade}\" stroke=\"{shade}\" stroke-width=\"0.5\"/>\
             <path d=\"{edge}\" class=\"contour\" stroke=\"{INK}\" stroke-width=\"1.2\" stroke-linecap=\"round\"/>"
        );
    }
}

/// Ticks and a label below a panel.
fn below(svg: &mut String, axis: &Axis, [x, y]: [f64; 2]) {
    for tick in Scale::Linear.ticks(axis.range, TICKS) {
        let at = x + PANEL * axis.share(tick.value);
        let (down, text) = (y + 8.0, escaped(&tick.label));
        let _ = writeln!(
            svg,
            "<path d=\"M{at:.2} {y}v5\" stroke=\"#000\"/><text x=\"{at:.2}\" y=\"{down}\" dy=\"0.7em\" \
             text-anchor=\"end\" transform=\"rotate(-40 {at:.2} {down})\" class=\"tick\">{text}</text>"
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-size=\"12\">{}</text>",
        x + 0.5 * PANEL,
        y + MARGINS[3] - 24.0,
        axis.label()
    );
}

/// Ticks and a label to the left of a panel.
fn beside(svg: &mut String, axis: &Axis, [x, y]: [f64; 2]) {
    for tick in Scale::Linear.ticks(axis.range, TICKS) {
        let at = y + PANEL * (1.0 - axis.share(tick.value));
        let _ = writeln!(
            svg,
            "<path d=\"M{x} {at:.2}h-5\" stroke=\"#000\"/><text x=\"{}\" y=\"{at:.2}\" dy=\"0.35em\" \
             text-anchor=\"end\" class=\"tick\">{}</text>",
            x - 8.0,
            escaped(&tick.label)
        );
    }
    let (at, middle) = (x - MARGINS[0] + 18.0, y + 0.5 * PANEL);
    let _ = writeln!(
        svg,
        "<text x=\"{at}\" y=\"{middle}\" text-anchor=\"middle\" font-size=\"12\" \
         transform=\"rotate(-90 {at} {middle})\">{}</text>",
        axis.label()
    );
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::synthetic;

    fn count(text: &str, part: &str) -> usize {
        text.matches(part).count()
    }

    #[test]
    fn three_parameters() -> Result<(), Box<dyn std::error::Error>> {
        let fit = synthetic::fit(&synthetic::image([8, 8]));
        let svg = corner(&fit, "a <ring> & more");
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("corner.svg");
        std::fs::write(&path, &svg)?;
        assert_eq!(std::fs::read_to_string(&path)?, svg);
        assert_eq!((count(&svg, "class=\"one\""), count(&svg, "class=\"two\"")), (3, 3));
        assert_eq!((count(&svg, "class=\"contour\""), count(&svg, "class=\"interval\"")), (6, 3));
        assert_eq!((count(&svg, "<svg"), count(&svg, "</svg>")), (7, 7));
        assert!(svg.contains("a &lt;ring&gt; &amp; more") && !svg.contains("NaN") && !svg.contains("inf"));
        // Head, lowest row, and first column but for the first row.
        assert_eq!(["diameter (px)", "width (px)"].map(|name| count(&svg, name)), [2, 3]);
        // 2000 draws, of which every third is a point, in 3 panels; some are beyond.
        let points = count(&svg, "h0");
        assert!((1900..=2001).contains(&points), "{points}");
        // Ticks stand only along the lowest row and the first column.
        let ticks = count(&svg, "class=\"tick\"");
        assert!((10..=20).contains(&ticks), "{ticks}");
        Ok(())
    }

    /// Draws around North stay together, and the median is said within a turn.
    #[test]
    fn angles_are_unwrapped() {
        let fit = synthetic::fit(&synthetic::image([8, 8]));
        let axis = Axis::of(&fit, 2);
        let [low, high] = axis.range;
        assert!(high - low > 25.0 && high - low < 40.0, "{low} to {high}");
        let [from, middle, to] = axis.quantiles.expect("there are draws");
        assert!((to - from - 10.0).abs() < 0.8, "{from} to {to}");
        assert!((middle - 180.0).abs() > 179.0, "{middle}");
        let mut angles = [350.0, 10.0, 20.0];
        unwrap(&mut angles);
        let differences = [angles[1] - angles[0], angles[2] - angles[0]];
        assert!((differences[0] - 20.0).abs() < 1e-9 && (differences[1] - 30.0).abs() < 1e-9, "{angles:?}");
    }

    #[test]
    fn numbers_have_the_digits_that_are_known() {
        assert_eq!(measured(42.0312, 0.512, 0.487), "42.03 +0.51 −0.49");
        assert_eq!(measured(-3.0, 40.0, 12.0), "−3 +40 −12");
        assert_eq!(measured(4.2e-7, 5e-9, 4e-9), "(4.200 +0.050 −0.040)·10⁻⁷");
        assert_eq!(measured(2.5, 0.0, 0.0), "2.5");
    }

    /// Nothing to draw, one parameter alone, and one that does not vary are drawn too.
    #[test]
    fn little_is_enough() {
        let mut fit = synthetic::fit(&synthetic::image([8, 8]));
        fit.draws.iter_mut().flatten().for_each(|draw| draw[1] = 0.0);
        let svg = corner(&fit, "");
        assert!(!svg.contains("NaN") && count(&svg, "class=\"contour\"") == 6, "{svg}");
        fit.draws.iter_mut().for_each(Vec::clear);
        assert_eq!(count(&corner(&fit, ""), "no draws"), 3);
        fit.free.truncate(1);
        assert_eq!(
            (count(&corner(&fit, ""), "class=\"one\""), count(&corner(&fit, ""), "class=\"two\"")),
            (1, 0)
        );
        fit.free.clear();
        assert!(corner(&fit, "none").contains("none"));
    }
}
