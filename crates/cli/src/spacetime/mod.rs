//! `kerrscope spacetime`: the mathematics of a geometry, in numbers.

mod check;
mod connect;
mod describe;
mod drawing;
mod geodesic;
mod numbers;
mod point;

use crate::Format;
use crate::report::Failure;
use kerrscope::scene::{known_metric, known_metrics, metric_from_file};
use kerrscope::spacetime::geometry::{
    BuiltIn, CatalogueError, Coordinate, Geometry, Nature, Written, catalogue,
};
use numbers::{Numbers, parse_numbers};
use std::path::Path;
use std::sync::Arc;

/// Metric, connection, curvature, geodesics and lengths of a geometry of two, three or four dimensions. All is
/// computed with numbers, exact derivatives included: nothing is printed as a formula. Coordinates are given in
/// the order of the geometry, angles in radians, with deg in degrees; pi may be used: 0,6,pi/2,90deg.
/// Lengths and times are in M where there is a mass. Without an action it says what a geometry is; without a name,
/// which there are.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:\n  \
    kerrscope spacetime\n  \
    kerrscope spacetime kerr --set spin=0.9\n  \
    kerrscope spacetime schwarzschild connection --at 0,6,pi/2,0\n  \
    kerrscope spacetime kerr geodesic --from 0,8,70deg,0 --velocity 0,0.03,0.04 --kind timelike --length 2000 --format csv\n  \
    kerrscope spacetime sphere between --from 40deg,0 --to 60deg,100deg\n  \
    kerrscope spacetime sphere length --through pi/2,0 --through pi/2,2pi\n  \
    kerrscope spacetime ellis check\n  \
    kerrscope spacetime two-kerr curvature --at 0,0,0,3\n  \
    kerrscope spacetime metric.toml check")]
pub struct Arguments {
    /// Geometry: polar, sphere, stereographic-north, stereographic-south, spherical, three-sphere, minkowski,
    /// schwarzschild, kerr (Boyer-Lindquist), kerr-schild or ellis; a metric that is known as text, such as kerr-newman or
    /// two-kerr; or a file with one, its own or a scene (metric.toml)
    name: Option<String>,
    /// Give a parameter a value; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = parse_parameter, allow_hyphen_values = true, global = true)]
    set: Vec<(String, f64)>,
    /// How to print; csv and svg are for geodesics
    #[arg(long, value_enum, global = true, default_value_t)]
    format: Shape,
    #[command(subcommand)]
    action: Option<Action>,
}

/// How results are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Shape {
    /// For reading
    #[default]
    Text,
    /// For programs
    Json,
    /// Points of a geodesic, one a line
    Csv,
    /// A picture of a geodesic
    Svg,
}

impl Shape {
    /// Of what is no curve.
    fn of_numbers(self) -> Result<Format, Failure> {
        match self {
            Self::Text => Ok(Format::Text),
            Self::Json => Ok(Format::Json),
            Self::Csv | Self::Svg => Err(Failure::Input(
                "--format csv and svg print the points of a geodesic: give text or json, or the action geodesic"
                    .to_owned(),
            )),
        }
    }
}

#[derive(clap::Subcommand, Debug)]
enum Action {
    /// The metric and its inverse at a point
    Metric(At),
    /// Every connection coefficient that is not zero at a point
    Connection(At),
    /// The geodesic equations at a point, with their coefficients there
    Equations(At),
    /// Riemann, Ricci and Einstein tensors, Ricci scalar and Kretschmann scalar at a point
    Curvature(At),
    /// A geodesic from a point and a velocity
    Geodesic(geodesic::Arguments),
    /// The geodesics from one point to another, and their lengths
    Between(connect::Between),
    /// The length of a curve through points, straight in the coordinates between them
    Length(connect::Through),
    /// Look at the metric in random points: symmetry, signature, inverse, vacuum, flatness far away
    Check(check::Arguments),
}

/// A point.
#[derive(clap::Args, Debug)]
struct At {
    /// The point's coordinates
    #[arg(long, value_name = "X,Y,…", value_parser = parse_numbers, allow_hyphen_values = true)]
    at: Numbers,
}

/// What was found, with the geometry that it is about.
struct Context<'a, G, const N: usize> {
    geometry: &'a G,
    coordinates: [Coordinate; N],
}

impl<G: Geometry<N>, const N: usize> Context<'_, G, N> {
    /// The names of the coordinates.
    fn names(&self) -> [&str; N] {
        std::array::from_fn(|i| &*self.coordinates[i].name)
    }

    /// A point typed at an option.
    fn point(&self, option: &str, numbers: &Numbers) -> Result<[f64; N], Failure> {
        let names = self.names().join(",");
        numbers.0.as_slice().try_into().map_err(|_| {
            Failure::Input(format!(
                "{option} {}: {} has {N} coordinates, {names}, and {} {} given",
                numbers.typed(),
                self.geometry.name(),
                numbers.0.len(),
                if numbers.0.len() == 1 { "is" } else { "are" },
            ))
        })
    }

    /// A point at which the metric is good.
    fn regular_point(&self, option: &str, numbers: &Numbers) -> Result<[f64; N], Failure> {
        let x = self.point(option, numbers)?;
        let g = self.geometry.metric(&x);
        let inverse = kerrscope::spacetime::geometry::invert(&g);
        let whole = |m: &[[f64; N]; N]| m.as_flattened().iter().all(|c| c.is_finite());
        if whole(&g) && whole(&inverse) {
            return Ok(x);
        }
        let ranges: Vec<String> = self.coordinates.iter().map(describe::range).collect();
        Err(Failure::Input(format!(
            "{option} {}: the metric of {} is singular there; its coordinates are {}",
            numbers.typed(),
            self.geometry.name(),
            ranges.join(", ")
        )))
    }

    fn has_time(&self) -> bool {
        self.coordinates[0].nature == Nature::Time
    }

    /// What every JSON output begins with.
    fn about(&self) -> serde_json::Map<String, serde_json::Value> {
        let parameters: serde_json::Map<_, _> =
            self.geometry.parameters().into_iter().map(|(name, value)| (name, value.into())).collect();
        let mut about = serde_json::Map::new();
        about.insert("geometry".to_owned(), self.geometry.name().into());
        about.insert("parameters".to_owned(), parameters.into());
        about.insert("coordinates".to_owned(), self.names().to_vec().into());
        about
    }
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Some(name) = &arguments.name else {
        if arguments.action.is_some() || !arguments.set.is_empty() {
            return Err(Failure::Input(
                "which geometry? give its name first, as in: kerrscope spacetime kerr check".to_owned(),
            ));
        }
        return describe::list(arguments.format.of_numbers()?);
    };
    let path = Path::new(name);
    let written = if path.extension().is_some() || path.components().count() > 1 {
        Some(metric_from_file(path, &arguments.set)?)
    } else if catalogue().iter().any(|entry| entry.name == name) {
        None
    } else {
        known_metric(name, &arguments.set).transpose()?
    };
    if let Some(element) = written {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        return act(&Written { element: Arc::new(element), name }, arguments);
    }
    let geometry = BuiltIn::named(name, &arguments.set).map_err(|errors| {
        let known = known_metrics().collect::<Vec<_>>().join(", ");
        let text = |error: &CatalogueError| match error {
            CatalogueError::Name(_) => format!("{error}; as text {known}; or a file such as metric.toml"),
            _ => error.to_string(),
        };
        Failure::Input(errors.iter().map(text).collect::<Vec<_>>().join("\nerror: "))
    })?;
    match geometry {
        BuiltIn::Surface(g) => act(&g, arguments),
        BuiltIn::Space(g) => act(&g, arguments),
        BuiltIn::Spacetime(g) => act(&g, arguments),
    }
}

fn act<G: Geometry<N>, const N: usize>(geometry: &G, arguments: &Arguments) -> Result<(), Failure> {
    let context = Context { geometry, coordinates: geometry.coordinates() };
    let format = arguments.format;
    match &arguments.action {
        None => describe::one(&context, format.of_numbers()?),
        Some(Action::Metric(At { at })) => point::metric(&context, at, format.of_numbers()?),
        Some(Action::Connection(At { at })) => point::connection(&context, at, format.of_numbers()?),
        Some(Action::Equations(At { at })) => point::equations(&context, at, format.of_numbers()?),
        Some(Action::Curvature(At { at })) => point::curvature(&context, at, format.of_numbers()?),
        Some(Action::Geodesic(a)) => geodesic::run(&context, a, format),
        Some(Action::Between(a)) => connect::between(&context, a, format.of_numbers()?),
        Some(Action::Length(a)) => connect::length(&context, a, format.of_numbers()?),
        Some(Action::Check(a)) => check::run(&context, a, format.of_numbers()?),
    }
}

/// NAME=VALUE of a parameter.
fn parse_parameter(text: &str) -> Result<(String, f64), String> {
    let (name, value) =
        text.split_once('=').ok_or_else(|| "give a parameter as NAME=VALUE, such as spin=0.9".to_owned())?;
    Ok((name.trim().to_owned(), numbers::parse_number(value)?))
}
