//! Numbers against numbers, as SVG.

use std::fmt::Write;
use std::path::PathBuf;

use kerrscope::display::chart::Scale;
use kerrscope::output::file::write_atomically;

use crate::report::Failure;

const WIDTH: f64 = 840.0;
const HEIGHT: f64 = 520.0;
/// Left, top, right and bottom.
const MARGINS: [f64; 4] = [64.0, 44.0, 20.0, 52.0];

/// How a curve is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Shape {
    /// Lines of numbers, the first of names
    #[default]
    Csv,
    /// For programs
    Json,
    /// A plot
    Svg,
}

/// What a plot shows: a stair of bins.
pub struct Plot<'a> {
    /// What stands above it.
    pub title: &'a str,
    /// What goes across, and what goes up.
    pub labels: [&'a str; 2],
    /// Where the bins begin and end.
    pub range: [f64; 2],
    /// How they are spaced.
    pub scale: Scale,
    /// How much there is in each.
    pub bins: &'a [f64],
}

/// The plot, its bins as a share of the largest.
pub fn draw(plot: &Plot<'_>) -> String {
    let [left, top, right, bottom] = MARGINS;
    let (across, up) = (WIDTH - left - right, HEIGHT - top - bottom);
    let [low, high] = plot.range;
    let logarithmic = plot.scale == Scale::Logarithmic;
    let share = |value: f64| {
        if logarithmic { (value / low).ln() / (high / low).ln() } else { (value - low) / (high - low) }
    };
    let x = |value: f64| left + share(value) * across;
    let y = |share: f64| HEIGHT - bottom - share / 1.05 * up;
    let title = plot.title;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"{left}\" y=\"26\" font-size=\"15\">{}</text>\n",
        escaped(title)
    );
    for tick in plot.scale.ticks([low, high], 8) {
        let at = x(tick.value);
        let _ = writeln!(
            svg,
            "<path d=\"M{at:.2} {:.2}v6\" stroke=\"#000\"/><path d=\"M{at:.2} {top}V{:.2}\" stroke=\"#e0e0e0\"/>\
             <text x=\"{at:.2}\" y=\"{:.2}\" text-anchor=\"middle\">{}</text>",
            HEIGHT - bottom,
            HEIGHT - bottom,
            HEIGHT - bottom + 21.0,
            escaped(&tick.label)
        );
    }
    for tick in Scale::Linear.ticks([0.0, 1.05], 6) {
        let at = y(tick.value);
        let _ = writeln!(
            svg,
            "<path d=\"M{:.2} {at:.2}h6\" stroke=\"#000\"/><path d=\"M{left} {at:.2}h{across}\" stroke=\"#e0e0e0\"/>\
             <text x=\"{:.2}\" y=\"{:.2}\" text-anchor=\"end\">{}</text>",
            left - 6.0,
            left - 10.0,
            at + 4.5,
            escaped(&tick.label)
        );
    }
    let peak = plot.bins.iter().copied().fold(0.0, f64::max);
    let height = |bin: f64| if peak > 0.0 { bin / peak } else { 0.0 };
    // A stair: a bin is what it is from one end to the other.
    let mut way = format!("M{left:.2} {:.2}", y(0.0));
    let width = across / plot.bins.len() as f64;
    for (k, bin) in plot.bins.iter().enumerate() {
        let _ = write!(way, "V{:.2}H{:.2}", y(height(*bin)), left + width * (k as f64 + 1.0));
    }
    let _ = write!(
        svg,
        "<path d=\"{way}V{0:.2}\" fill=\"#205090\" fill-opacity=\"0.12\" stroke=\"#205090\" stroke-width=\"1.5\" \
         stroke-linejoin=\"round\"/>\n\
         <rect x=\"{left}\" y=\"{top}\" width=\"{across}\" height=\"{up}\" fill=\"none\" stroke=\"#000\"/>\n\
         <text x=\"{1:.2}\" y=\"{2:.2}\" text-anchor=\"middle\">{4}</text>\n\
         <text x=\"18\" y=\"{3:.2}\" text-anchor=\"middle\" transform=\"rotate(-90 18 {3:.2})\">{5}</text>\n</svg>",
        y(0.0),
        left + 0.5 * across,
        HEIGHT - 10.0,
        top + 0.5 * up,
        escaped(plot.labels[0]),
        escaped(plot.labels[1])
    );
    svg
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Writes a curve to files, whole or not at all.
pub fn save(
    paths: &[PathBuf],
    shapes: &[Shape],
    written: impl Fn(Shape) -> Result<String, Failure>,
) -> Result<(), Failure> {
    for (path, shape) in paths.iter().zip(shapes) {
        let text = written(*shape)?;
        write_atomically(path, |file| writeln_all(file, &text))
            .map_err(|e| Failure::Failed(e.to_string()))?;
    }
    let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    crate::print(&format!("Saved {}", names.join(", ")))
}

fn writeln_all(file: &mut dyn std::io::Write, text: &str) -> std::io::Result<()> {
    writeln!(file, "{text}")
}

/// What the endings of files ask for, all that are unknown said at once.
pub fn shapes(paths: &[PathBuf]) -> Result<Vec<Shape>, Failure> {
    let mut wrong = Vec::new();
    let mut shapes = Vec::new();
    for path in paths {
        match path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("svg") => shapes.push(Shape::Svg),
            Some("csv") => shapes.push(Shape::Csv),
            Some("json") => shapes.push(Shape::Json),
            _ => wrong.push(path.display().to_string()),
        }
    }
    if wrong.is_empty() {
        Ok(shapes)
    } else {
        Err(Failure::Input(format!("{}: give a name that ends in .svg, .csv or .json", wrong.join(", "))))
    }
}
