//! `kerrscope measure`: what a picture shows, in numbers.

use crate::report::Failure;
use crate::{Format, parse_inclination, parse_spin, print, print_json};
use kerrscope::measure::{Feature, Features, Measured, Overlay, Picture};
use kerrscope::scene::Scene;
use kerrscope::spacetime::kerr::CriticalCurve;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Measures shadow, ring and disk in a picture of anybody's.
///
/// Places are right and up of the picture's middle, lengths in pixels; in M and µas too where the size of a pixel is known.
#[derive(clap::Args, Debug)]
#[command(
    after_long_help = "JSON: size [width, height]; pixel { microarcseconds, gravitational_radii } or null; trusted_brightness, \
    false where a tone curve or colour map may have been at work. Each of shadow, ring and disk is { found: {...} } or { not_found: reason }. \
    A measured number is { value, error }, the error one standard deviation; lengths are in pixels.\n\
    shadow: centre [right, up], diameter (twice the mean radius, or the integral of r dtheta/pi along the outline), area, area_diameter (by counting light, a second method), circularity \
    (standard deviation of the radius over its mean), sharp (light begins abruptly), level (what part of the light's level counts as dark).\n\
    ring: centre, diameter, width, asymmetry, position_angle (degrees East of North: from up over left), central_brightness, by the \
    definitions of EHT Collaboration 2019, ApJL 875, L4.\n\
    disk: right (r+), left (r-), below (h), above, from the shadow's centre to where that direction leaves the disk for the last time; far_right \
    and far_left, how far it reaches at any height; left_share r-/(r- + r+), below_over_right h/r+; major_axis (degrees anticlockwise from the \
    right), axes, displacement (the shadow's centre less that of the disk), sharp (light ends abruptly; if not, the edge is where it is down to \
    a fiftieth).\n\
    What is not found has a reason, and the exit code stays 0; a file that is no picture, is the same all over or has pixels that are no numbers \
    is refused with 2.\n\n\
    Examples:\n  kerrscope measure hole.png --overlay measured.png\n  \
    kerrscope measure m87.fits --format json\n  \
    kerrscope measure hole.png --spin 0.9 --inclination 60 --scale 0.05 --overlay curve.png"
)]
pub struct Arguments {
    /// Picture (FITS, EXR, PNG, JPEG, TIFF, WebP, HDR)
    image: PathBuf,
    /// Draw what was measured on the picture, to this PNG; the critical curve too, if spin, inclination and scale are known
    #[arg(long, value_name = "PNG")]
    overlay: Option<PathBuf>,
    /// Spin of the hole, if not that of the picture's own scene
    #[arg(long, value_name = "A", value_parser = parse_spin, allow_hyphen_values = true)]
    spin: Option<f64>,
    /// Inclination in degrees, if not that of the picture's own scene
    #[arg(long, value_name = "DEG", value_parser = parse_inclination)]
    inclination: Option<f64>,
    /// Side of a pixel in M, if not that of the picture's own scene
    #[arg(long, value_name = "M", value_parser = crate::parse_distance)]
    scale: Option<f64>,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut picture = Picture::open(&arguments.image).map_err(|e| Failure::Input(e.to_string()))?;
    if let Some(scale) = arguments.scale {
        if !scale.is_finite() {
            return Err(Failure::Input("--scale: give a finite number of M".to_owned()));
        }
        picture.pixel.gravitational_radii = Some(scale);
    }
    let features = Features::of(&picture);
    if let Some(path) = &arguments.overlay {
        let scene = picture.scene(arguments.image.parent().unwrap_or(Path::new("")));
        let curve = critical_curve(arguments, &picture, scene.as_ref());
        Overlay::new(&picture, &features, &curve).write(path).map_err(|e| Failure::Failed(e.to_string()))?;
    }
    match arguments.format {
        Format::Json => print_json(&features),
        Format::Text => print(report(&picture, &features).trim_end()),
    }
}

/// The critical curve in pixels from the picture's middle, where all that it needs is known. Far from the hole a pixel is as many M as at its distance.
fn critical_curve(arguments: &Arguments, picture: &Picture, scene: Option<&Scene>) -> Vec<[f64; 2]> {
    let spin = arguments.spin.or_else(|| scene.and_then(|scene| scene.spacetime.spin()));
    let own = scene.map(|scene| scene.observer.place.theta);
    let inclination = arguments.inclination.map(f64::to_radians).or(own);
    let (Some(spin), Some(inclination), Some(scale)) = (spin, inclination, picture.pixel.gravitational_radii)
    else {
        return Vec::new();
    };
    CriticalCurve::new(spin, inclination).points(720).into_iter().map(|p| p.map(|c| c / scale)).collect()
}

fn report(picture: &Picture, features: &Features) -> String {
    let mut lines = vec![format!("{} x {} pixels", picture.width, picture.height)];
    let pixel = features.pixel;
    if let Some(size) = pixel.gravitational_radii {
        lines.push(format!("a pixel is {size:.6} M"));
    }
    if let Some(size) = pixel.microarcseconds {
        lines.push(format!("a pixel is {size:.6} uas"));
    }
    if !picture.trusted_brightness {
        lines.push("made for a screen: places hold, ratios of brightness may not".to_owned());
    }
    let plain = |m: &Measured| format!("{:.3} +- {:.3}", m.value, m.error);
    let length = |m: &Measured| {
        let mut text = format!("{} px", plain(m));
        for (size, unit) in [(pixel.gravitational_radii, "M"), (pixel.microarcseconds, "uas")] {
            if let Some(size) = size {
                let m = m.times(size);
                let _ = write!(text, " = {:.4} +- {:.4} {unit}", m.value, m.error);
            }
        }
        text
    };
    match &features.shadow {
        Feature::NotFound(why) => lines.push(format!("shadow: not found: {why}")),
        Feature::Found(shadow) => {
            lines.push("shadow".to_owned());
            lines.push(format!("  centre       right {}", length(&shadow.centre[0])));
            lines.push(format!("               up    {}", length(&shadow.centre[1])));
            lines.push(format!("  diameter     {}", length(&shadow.diameter)));
            lines.push(format!("  by its area  {:.3} px", shadow.area_diameter));
            lines.push(format!("  area         {} px2", plain(&shadow.area)));
            lines.push(format!(
                "  circularity  {:.5} +- {:.5}",
                shadow.circularity.value, shadow.circularity.error
            ));
            let edge = if shadow.sharp { "abrupt" } else { "gradual: the outline depends on the level" };
            lines.push(format!("  edge         {edge}, level {:.3}", shadow.level));
        }
    }
    match &features.ring {
        Feature::NotFound(why) => lines.push(format!("ring: not found: {why}")),
        Feature::Found(ring) => {
            lines.push("ring".to_owned());
            lines.push(format!("  centre       right {:.3}, up {:.3} px", ring.centre[0], ring.centre[1]));
            lines.push(format!("  diameter     {}", length(&ring.diameter)));
            lines.push(format!("  width        {}", length(&ring.width)));
            lines.push(format!("  asymmetry    {}", plain(&ring.asymmetry)));
            lines.push(format!("  bright side  {} degrees East of North", plain(&ring.position_angle)));
            lines.push(format!("  brightness of the centre {:.4}", ring.central_brightness));
        }
    }
    match &features.disk {
        Feature::NotFound(why) => lines.push(format!("disk: not found: {why}")),
        Feature::Found(disk) => {
            lines.push("disk, from the shadow's centre to its edge".to_owned());
            lines.push(format!("  r-  (left)   {}", length(&disk.left)));
            lines.push(format!("  r+  (right)  {}", length(&disk.right)));
            lines.push(format!("  h   (below)  {}", length(&disk.below)));
            lines.push(format!("  above        {}", length(&disk.above)));
            lines.push(format!("  furthest     left {}", length(&disk.far_left)));
            lines.push(format!("               right {}", length(&disk.far_right)));
            let ratio = |m: &Measured| format!("{:.5} +- {:.5}", m.value, m.error);
            lines.push(format!("  r-/(r- + r+) {}", ratio(&disk.left_share)));
            lines.push(format!("  h/r+         {}", ratio(&disk.below_over_right)));
            let [major, minor] = disk.axes;
            lines.push(format!(
                "  axes         {major:.2} x {minor:.2} px, the major at {:.2} degrees",
                disk.major_axis
            ));
            let edge = if disk.sharp { "abrupt" } else { "gradual: where the light is down to a fiftieth" };
            lines.push(format!("  edge         {edge}"));
        }
    }
    lines.join("\n")
}
