//! `kerrscope trace`: one ray, and what it meets.

use crate::report::Failure;
use crate::side_view;
use crate::source::Source;
use crate::{parse_distance, parse_finite, parse_inclination, parse_spin, print, print_json};
use clap::ValueEnum;
use kerrscope::camera::Camera;
use kerrscope::objects::World;
use kerrscope::render::{Sampler, hole_tracer, obstacle_tracer, tracer, world};
use kerrscope::scene::Scene;
use kerrscope::spacetime::Level;
use kerrscope::spacetime::emitter::{Circular, Sense};
use kerrscope::spacetime::geodesic::{ObstacleTracer, Path, Query, Ray, Side, Tracer};
use kerrscope::spacetime::kerr::horizons;
use kerrscope::spacetime::metric::LineElement;
use kerrscope::spacetime::observer::impact_ray;
use serde::Serialize;
use std::fmt::Write;
use std::sync::Arc;

/// The ray is that of a pixel of a scene, or that of impact parameters seen by a static
/// observer. Lengths and times in M, angles in radians, in Boyer-Lindquist coordinates.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:\n  \
    kerrscope trace --spin 0.9 --inclination 60 --alpha -11.35 --beta 2 --format json\n  \
    kerrscope trace scenes/thesis-4.8.toml --pixel 200,80\n  \
    kerrscope trace --spin 0.9 --inclination 85 --distance 20 --alpha 4 --beta 3 --path 400 --format svg > ray.svg")]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// Spin a, from -1 to 1
    #[arg(long, value_name = "A", value_parser = parse_spin, allow_hyphen_values = true, requires = "inclination")]
    spin: Option<f64>,
    /// Inclination in degrees
    #[arg(long, value_name = "DEG", value_parser = parse_inclination, requires = "spin")]
    inclination: Option<f64>,
    /// Boyer-Lindquist radius in M at which the ray starts, or inf [default: 1000]
    #[arg(long, value_name = "R", value_parser = parse_distance, requires = "spin")]
    distance: Option<f64>,
    /// Pixel of the scene's picture, counted from 0,0 at the top left
    #[arg(long, value_name = "X,Y", value_delimiter = ',', num_args = 1, conflicts_with_all = ["spin", "alpha", "beta"])]
    pixel: Vec<u32>,
    /// Which of the pixel's samples; without it, the pixel's centre
    #[arg(long, value_name = "K", requires = "pixel")]
    sample: Option<u32>,
    /// Impact parameter to the right, M
    #[arg(long, value_name = "M", value_parser = parse_finite, allow_hyphen_values = true, requires = "beta")]
    alpha: Option<f64>,
    /// Impact parameter along the projected spin axis, M
    #[arg(long, value_name = "M", value_parser = parse_finite, allow_hyphen_values = true, requires = "alpha")]
    beta: Option<f64>,
    /// What traces the ray (as --set render.engine=…): auto, closed-form or integrator
    #[arg(long, value_name = "ENGINE")]
    engine: Option<String>,
    /// Crossings to list at most
    #[arg(long, value_name = "N", default_value_t = 16)]
    crossings: usize,
    /// Add N points (t, x, y, z) along the ray, in its Kerr-Schild coordinates
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000_000))]
    path: Option<u32>,
    /// How to print; csv and svg print the points of --path (default 1000)
    #[arg(long, value_enum, default_value_t)]
    format: TraceFormat,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum TraceFormat {
    /// For reading
    #[default]
    Text,
    /// For programs
    Json,
    /// The points of the path, one a line
    Csv,
    /// A side view of the path
    Svg,
}

#[derive(Serialize)]
struct Output {
    engine: &'static str,
    fate: &'static str,
    conserved: Conserved,
    crossings: Vec<Crossing>,
    direction: Option<Direction>,
    #[serde(skip_serializing_if = "Option::is_none")]
    hit: Option<Hit>,
    steps: usize,
    error_estimate: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<Vec<[f64; 4]>>,
}

#[derive(Serialize)]
struct Conserved {
    lambda: Option<f64>,
    eta: Option<f64>,
}

#[derive(Serialize)]
struct Crossing {
    order: usize,
    r: f64,
    phi: Option<f64>,
    t: Option<f64>,
    g: Option<f64>,
}

#[derive(Serialize)]
struct Direction {
    theta: f64,
    phi: f64,
    /// On the other side of a wormhole.
    other_side: bool,
}

#[derive(Serialize)]
struct Hit {
    object: usize,
    position: [f64; 3],
}

/// A ray, the hole it passes (none in flat space, or in a metric as text) and what follows it.
struct Shot {
    spin: Option<f64>,
    /// The metric, if it is a text.
    element: Option<Arc<LineElement>>,
    ray: Ray,
    follower: Follower,
}

impl Shot {
    /// Radius of the horizon, 0 for none.
    fn horizon(&self) -> f64 {
        match &self.element {
            Some(element) => element.horizon(),
            None => self.spin.map_or(0.0, |a| horizons(a).0),
        }
    }
}

/// What follows a ray, past nothing but the hole or among things.
enum Follower {
    Alone(Box<dyn Tracer>),
    Among(Box<dyn ObstacleTracer>, World),
}

impl Follower {
    fn name(&self) -> &'static str {
        match self {
            Self::Alone(tracer) => tracer.name(),
            Self::Among(tracer, _) => tracer.name(),
        }
    }

    fn trace(&self, ray: &Ray, query: &Query, path: &mut Path) {
        match self {
            Self::Alone(tracer) => tracer.trace(ray, query, path),
            Self::Among(tracer, world) => tracer.trace_among(ray, query, world, path),
        }
    }
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let shot = shot(arguments)?;
    let drawn = matches!(arguments.format, TraceFormat::Csv | TraceFormat::Svg);
    let points = arguments.path.map_or(if drawn { 1000 } else { 0 }, |n| n as usize);
    let query = Query { max_crossings: arguments.crossings, elapsed: true, points, ..Query::default() };
    if points > 0 && shot.ray.side == Side::Ingoing {
        return Err(Failure::Input(
            "a path starts outside the horizon (a falling camera's beyond 1.1 r+): leave out --path"
                .to_owned(),
        ));
    }
    let mut path = Path::default();
    shot.follower.trace(&shot.ray, &Query { points: 0, ..query }, &mut path);
    if points > 0 {
        // Points are the integrator's; the rest is what the engine asked for says.
        let mut way = Path::default();
        shot.follower.trace(&shot.ray, &query, &mut way);
        path.points = way.points;
    }
    match arguments.format {
        TraceFormat::Json => print_json(&output(&shot, &path, arguments.path.is_some())),
        TraceFormat::Text => print(&text(&output(&shot, &path, arguments.path.is_some()))),
        TraceFormat::Csv => print(&csv(&path)),
        TraceFormat::Svg => print(&side_view::draw(&path, shot.horizon(), &title(&shot, &path))),
    }
}

/// The ray at a point of a scene's picture, as JSON, with so many points of its way; and the radius of the horizon, 0 for none.
///
/// # Errors
/// If no photon arrives there.
pub fn at_point(scene: &Scene, [x, y]: [f64; 2], points: usize) -> Result<(serde_json::Value, f64), String> {
    let ray = Camera::new(scene).and_then(|camera| camera.ray(x, y)).map_err(|e| e.to_string())?;
    let shot = of_scene(scene, ray);
    let query = Query { max_crossings: 16, elapsed: true, ..Query::default() };
    let mut path = Path::default();
    shot.follower.trace(&shot.ray, &query, &mut path);
    if shot.ray.side == Side::Reversed {
        let mut way = Path::default();
        shot.follower.trace(&shot.ray, &Query { points, ..query }, &mut way);
        path.points = way.points;
    }
    let output = serde_json::to_value(output(&shot, &path, true)).map_err(|e| e.to_string())?;
    Ok((output, shot.horizon()))
}

fn shot(arguments: &Arguments) -> Result<Shot, Failure> {
    if let (Some(spin), Some(inclination)) = (arguments.spin, arguments.inclination) {
        return hole(arguments, spin, inclination);
    }
    let engine = arguments.engine.iter().map(|engine| format!("render.engine={engine}"));
    let scene = arguments.source.load(engine)?;
    let spin = scene.spacetime.spin();
    let ray = if let (Some(alpha), Some(beta)) = (arguments.alpha, arguments.beta) {
        let place = scene.observer.place;
        if scene.spacetime.text().is_some() && place.r.is_finite() {
            return Err(Failure::Input(
                "in a metric as text impact parameters are known at infinity only: give --pixel, or set \
                 observer.distance=inf and screen.kind=impact"
                    .to_owned(),
            ));
        }
        impact_ray(spin, place.theta, place.r, [alpha, beta]).map(|ray| ray.turned(place.phi))
    } else {
        let camera = Camera::new(&scene).map_err(|e| Failure::Input(e.to_string()))?;
        let [x, y] = pixel(arguments, &scene)?;
        camera.ray(x, y)
    };
    let ray = ray.map_err(|e| Failure::Input(e.to_string()))?;
    Ok(of_scene(&scene, ray))
}

/// A ray in a scene.
fn of_scene(scene: &Scene, ray: Ray) -> Shot {
    let follower = if scene.objects.is_empty() {
        Follower::Alone(tracer(scene, Level::best()))
    } else {
        Follower::Among(obstacle_tracer(scene), world(scene))
    };
    Shot { spin: scene.spacetime.spin(), element: scene.spacetime.text().cloned(), ray, follower }
}

/// A hole without a scene.
fn hole(arguments: &Arguments, spin: f64, inclination: f64) -> Result<Shot, Failure> {
    let (Some(alpha), Some(beta)) = (arguments.alpha, arguments.beta) else {
        return Err(Failure::Input("--spin needs a ray: give --alpha and --beta in M".to_owned()));
    };
    if arguments.source.scene.is_some() || !arguments.source.set.is_empty() {
        return Err(Failure::Input(
            "a scene and --set do not go with --spin and --inclination: leave out one or the other"
                .to_owned(),
        ));
    }
    let distance = arguments.distance.unwrap_or(1000.0);
    let ray = impact_ray(Some(spin), inclination.to_radians(), distance, [alpha, beta])
        .map_err(|e| Failure::Input(e.to_string()))?;
    let tracer = hole_tracer(arguments.engine.as_deref().unwrap_or("auto"), spin).map_err(Failure::Input)?;
    Ok(Shot { spin: Some(spin), element: None, ray, follower: Follower::Alone(tracer) })
}

/// The point of the picture that is asked for, in pixels.
fn pixel(arguments: &Arguments, scene: &Scene) -> Result<[f64; 2], Failure> {
    let [x, y] = arguments.pixel[..] else {
        return Err(Failure::Input(
            "which ray? give --pixel X,Y, or --alpha and --beta (with --spin and --inclination, or a scene)"
                .to_owned(),
        ));
    };
    let (width, height) = (scene.render.width, scene.render.height);
    if x >= width || y >= height {
        return Err(Failure::Input(format!(
            "pixel {x},{y} is outside the picture: x is 0 to {}, y 0 to {}",
            width - 1,
            height - 1
        )));
    }
    let place = match arguments.sample {
        None => [0.5; 2],
        Some(k) if k < scene.render.samples => {
            let sampler = Sampler::new(scene.render.samples, scene.render.seed, scene.render.jitter);
            sampler.place(u64::from(y) * u64::from(width) + u64::from(x), k)
        }
        Some(k) => {
            return Err(Failure::Input(format!(
                "sample {k} does not exist: this scene has 0 to {}",
                scene.render.samples - 1
            )));
        }
    };
    Ok([f64::from(x) + place[0], f64::from(y) + place[1]])
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

fn output(shot: &Shot, path: &Path, with_points: bool) -> Output {
    let conserved = shot.ray.conserved(shot.spin.unwrap_or(0.0));
    let energy = match shot.ray.side {
        Side::Reversed => shot.ray.energy,
        Side::Ingoing => -shot.ray.energy,
    };
    let matter = shot.spin.map(|spin| Circular::kerr(spin, Sense::Prograde));
    let crossings = path.crossings.iter().enumerate().map(|(order, c)| Crossing {
        order,
        r: c.r,
        phi: finite(c.phi),
        t: finite(c.elapsed),
        g: matter.as_ref().and_then(|m| m.orbit(c.r)?.redshift_factor(conserved.lambda, energy)),
    });
    Output {
        engine: shot.follower.name(),
        fate: path.fate.name(),
        conserved: Conserved {
            lambda: finite(conserved.lambda),
            // Of any other metric no fourth constant of the motion is known.
            eta: finite(conserved.eta).filter(|_| shot.element.is_none()),
        },
        crossings: crossings.collect(),
        direction: path.direction.map(|[theta, phi]| Direction { theta, phi, other_side: path.other_side }),
        hit: path.hit.map(|hit| Hit { object: hit.object, position: hit.position }),
        steps: path.steps,
        error_estimate: finite(path.error_estimate),
        path: with_points.then(|| path.points.clone()),
    }
}

fn text(output: &Output) -> String {
    let show = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), |x| format!("{x:.9}"));
    let mut s = String::new();
    let _ = writeln!(
        s,
        "{}; lambda {}, eta {}; {} steps ({}), error about {}",
        output.fate,
        show(output.conserved.lambda),
        show(output.conserved.eta),
        output.steps,
        output.engine,
        output.error_estimate.map_or_else(|| "-".to_owned(), |e| format!("{e:.1e}")),
    );
    if let Some(Direction { theta, phi, other_side }) = output.direction {
        let sky = if other_side { " of the sky on the other side" } else { "" };
        let _ = writeln!(s, "light comes from theta {theta:.9}, phi {phi:.9} rad{sky}");
    }
    if let Some(Hit { object, position: [x, y, z] }) = output.hit {
        let _ = writeln!(s, "object {object} is met at x {x:.9}, y {y:.9}, z {z:.9} M");
    }
    if output.crossings.is_empty() {
        let _ = write!(s, "no crossing of the equatorial plane");
    } else {
        let _ =
            write!(s, "crossing {:>16} {:>16} {:>18} {:>14}", "r (M)", "phi (rad)", "time before (M)", "g");
        for c in &output.crossings {
            let _ = write!(
                s,
                "\n{:>8} {:>16.9} {:>16} {:>18} {:>14}",
                c.order,
                c.r,
                show(c.phi),
                show(c.t),
                show(c.g)
            );
        }
    }
    for [t, x, y, z] in output.path.iter().flatten() {
        let _ = write!(s, "\n{t:>16.9} {x:>16.9} {y:>16.9} {z:>16.9}");
    }
    s
}

fn csv(path: &Path) -> String {
    let lines = path.points.iter().map(|[t, x, y, z]| format!("{t},{x},{y},{z}"));
    std::iter::once("t,x,y,z".to_owned()).chain(lines).collect::<Vec<_>>().join("\n")
}

fn title(shot: &Shot, path: &Path) -> String {
    let conserved = shot.ray.conserved(shot.spin.unwrap_or(0.0));
    if shot.element.is_some() {
        return format!("λ = {:.4} M: {}", conserved.lambda, path.fate.name());
    }
    let hole = shot.spin.map_or_else(|| "flat space".to_owned(), |a| format!("a = {a}"));
    format!("{hole}, λ = {:.4} M, η = {:.4} M²: {}", conserved.lambda, conserved.eta, path.fate.name())
}
