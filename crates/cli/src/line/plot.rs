//! A profile as SVG: flux against g.

use std::fmt::Write;

use kerrscope::display::chart::Scale;
use kerrscope::line::Profile;

const WIDTH: f64 = 840.0;
const HEIGHT: f64 = 520.0;
/// Left, top, right and bottom.
const MARGINS: [f64; 4] = [64.0, 44.0, 20.0, 52.0];

/// The plot of a profile, its flux as a share of the peak.
pub fn draw(profile: &Profile, title: &str) -> String {
    let [left, top, right, bottom] = MARGINS;
    let (across, up) = (WIDTH - left - right, HEIGHT - top - bottom);
    let [low, high] = profile.range;
    let x = |g: f64| left + (g - low) / (high - low) * across;
    let y = |share: f64| HEIGHT - bottom - share / 1.05 * up;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"{left}\" y=\"26\" font-size=\"15\">{}</text>\n",
        escaped(title)
    );
    for tick in Scale::Linear.ticks([low, high], 8) {
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
    let peak = profile.peak();
    let share = |flux: f64| if peak > 0.0 { flux / peak } else { 0.0 };
    // A stair: a bin is what it is from one end to the other.
    let mut way = format!("M{:.2} {:.2}", x(low), y(0.0));
    let width = (high - low) / profile.flux.len() as f64;
    for (bin, flux) in profile.flux.iter().enumerate() {
        let _ = write!(way, "V{:.2}H{:.2}", y(share(*flux)), x(low + width * (bin as f64 + 1.0)));
    }
    let _ = write!(
        svg,
        "<path d=\"{way}V{0:.2}\" fill=\"#205090\" fill-opacity=\"0.12\" stroke=\"#205090\" stroke-width=\"1.5\" \
         stroke-linejoin=\"round\"/>\n\
         <rect x=\"{left}\" y=\"{top}\" width=\"{across}\" height=\"{up}\" fill=\"none\" stroke=\"#000\"/>\n\
         <text x=\"{1:.2}\" y=\"{2:.2}\" text-anchor=\"middle\">g = ν observed / ν sent</text>\n\
         <text x=\"18\" y=\"{3:.2}\" text-anchor=\"middle\" transform=\"rotate(-90 18 {3:.2})\">flux / peak</text>\n</svg>",
        y(0.0),
        left + 0.5 * across,
        HEIGHT - 10.0,
        top + 0.5 * up
    );
    svg
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
