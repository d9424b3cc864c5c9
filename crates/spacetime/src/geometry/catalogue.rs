//! The geometries that are built in, by name.

use super::{
    BoyerLindquist, Cartesian, Coordinate, Ellis, Geometry, Minkowski, Named, PolarPlane, Pole,
    Schwarzschild, Sphere, SphericalSpace, Stereographic, ThreeSphere,
};
use crate::metric;
use crate::scalar::Scalar;

/// What the catalogue says of a geometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    /// Its parameters: name, value unless given, smallest and largest.
    pub parameters: &'static [(&'static str, f64, [f64; 2])],
}

const SPIN: (&str, f64, [f64; 2]) = ("spin", 0.99, [-1.0, 1.0]);
const RADIUS: (&str, f64, [f64; 2]) = ("radius", 1.0, [1e-6, 1e6]);

const ENTRIES: [Entry; 11] = [
    Entry { name: "polar", about: "the plane in polar coordinates", parameters: &[] },
    Entry { name: "sphere", about: "the surface of a ball", parameters: &[RADIUS] },
    Entry {
        name: "stereographic-north",
        about: "the surface of a ball, projected from its north pole",
        parameters: &[RADIUS],
    },
    Entry {
        name: "stereographic-south",
        about: "the surface of a ball, projected from its south pole",
        parameters: &[RADIUS],
    },
    Entry { name: "spherical", about: "flat space in spherical coordinates", parameters: &[] },
    Entry { name: "three-sphere", about: "the three-dimensional sphere", parameters: &[RADIUS] },
    Entry { name: "minkowski", about: "flat spacetime", parameters: &[] },
    Entry {
        name: "schwarzschild",
        about: "a black hole without spin, in Schwarzschild's coordinates",
        parameters: &[("mass", 1.0, [0.0, 1e6])],
    },
    Entry {
        name: "kerr",
        about: "a black hole with spin, in Boyer-Lindquist coordinates; M = 1",
        parameters: &[SPIN],
    },
    Entry {
        name: "kerr-schild",
        about: "the same hole in ingoing Kerr-Schild coordinates, which are regular at the horizon",
        parameters: &[SPIN],
    },
    Entry {
        name: "ellis",
        about: "a wormhole between two flat regions, held open by matter unknown",
        parameters: &[("throat", 1.0, [1e-6, 1e6])],
    },
];

/// Every geometry that is built in.
pub fn catalogue() -> &'static [Entry] {
    &ENTRIES
}

/// What is wrong with the choice of a geometry.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CatalogueError {
    /// There is no such geometry.
    #[error("no geometry is called {0:?}: there are {names}", names = names())]
    Name(String),
    /// It has no such parameter.
    #[error("{geometry} has no parameter {parameter:?}{known}")]
    Parameter {
        /// The geometry.
        geometry: &'static str,
        /// What was given.
        parameter: String,
        /// Which there are.
        known: String,
    },
    /// A parameter is out of its range.
    #[error("{parameter} = {value} is out of range: give a number from {} to {}", range[0], range[1])]
    Range {
        /// The parameter.
        parameter: &'static str,
        /// What was given.
        value: f64,
        /// Smallest and largest.
        range: [f64; 2],
    },
}

fn names() -> String {
    ENTRIES.map(|e| e.name).join(", ")
}

/// A geometry made of one of several.
macro_rules! any {
    ($(#[$about:meta])* $name:ident, $dimension:literal, $($(#[$meaning:meta])* $kind:ident($geometry:ty)),+) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq)]
        pub enum $name {
            $($(#[$meaning])* $kind($geometry)),+
        }

        impl Geometry<$dimension> for $name {
            fn name(&self) -> &str {
                match self { $(Self::$kind(g) => g.name()),+ }
            }
            fn coordinates(&self) -> [Coordinate; $dimension] {
                match self { $(Self::$kind(g) => g.coordinates()),+ }
            }
            fn parameters(&self) -> Vec<Named> {
                match self { $(Self::$kind(g) => g.parameters()),+ }
            }
            fn metric<S: Scalar>(&self, x: &[S; $dimension]) -> [[S; $dimension]; $dimension] {
                match self { $(Self::$kind(g) => g.metric(x)),+ }
            }
            fn margin(&self, x: &[f64; $dimension]) -> f64 {
                match self { $(Self::$kind(g) => g.margin(x)),+ }
            }
            fn invariants(&self, x: &[f64; $dimension], p: &[f64; $dimension]) -> Vec<Named> {
                match self { $(Self::$kind(g) => g.invariants(x, p)),+ }
            }
            fn picture(&self, x: &[f64; $dimension]) -> [f64; 3] {
                match self { $(Self::$kind(g) => g.picture(x)),+ }
            }
        }
    };
}

any!(
    /// A surface that is built in.
    AnySurface, 2,
    /// [`PolarPlane`].
    Polar(PolarPlane),
    /// [`Sphere`].
    Sphere(Sphere),
    /// [`Stereographic`].
    Stereographic(Stereographic)
);
any!(
    /// A space of three dimensions that is built in.
    AnySpace, 3,
    /// [`SphericalSpace`].
    Spherical(SphericalSpace),
    /// [`ThreeSphere`].
    ThreeSphere(ThreeSphere)
);
any!(
    /// A spacetime that is built in.
    AnySpacetime, 4,
    /// [`Minkowski`].
    Minkowski(Minkowski),
    /// [`Schwarzschild`].
    Schwarzschild(Schwarzschild),
    /// [`BoyerLindquist`].
    BoyerLindquist(BoyerLindquist),
    /// [`metric::Kerr`].
    KerrSchild(Cartesian<metric::Kerr>),
    /// [`Ellis`].
    Ellis(Ellis)
);

/// A geometry that is built in.
#[derive(Clone, Debug, PartialEq)]
pub enum BuiltIn {
    /// Of two dimensions.
    Surface(AnySurface),
    /// Of three.
    Space(AnySpace),
    /// Of four.
    Spacetime(AnySpacetime),
}

impl BuiltIn {
    /// The geometry of a name with some parameters, the others having their usual values.
    ///
    /// # Errors
    /// Everything that is wrong with the name and the parameters.
    ///
    /// ```
    /// use kerrscope_spacetime::geometry::BuiltIn;
    /// assert!(BuiltIn::named("kerr", &[("spin".to_owned(), 0.5)]).is_ok());
    /// assert_eq!(BuiltIn::named("kerr", &[("spin".to_owned(), 1.5), ("charge".to_owned(), 1.0)]).unwrap_err().len(), 2);
    /// ```
    pub fn named(name: &str, parameters: &[Named]) -> Result<Self, Vec<CatalogueError>> {
        let Some(entry) = ENTRIES.iter().find(|e| e.name == name) else {
            return Err(vec![CatalogueError::Name(name.to_owned())]);
        };
        let mut errors = Vec::new();
        for (parameter, value) in parameters {
            match entry.parameters.iter().find(|(known, ..)| known == parameter) {
                None => errors.push(unknown(entry, parameter)),
                Some((parameter, _, range)) if !(range[0]..=range[1]).contains(value) => {
                    errors.push(CatalogueError::Range { parameter, value: *value, range: *range });
                }
                Some(_) => {}
            }
        }
        if !errors.is_empty() {
            return Err(errors);
        }
        // The last value given counts.
        let value = |i: usize| {
            let (known, usual, _) = entry.parameters[i];
            parameters.iter().rfind(|(given, _)| given == known).map_or(usual, |(_, value)| *value)
        };
        let stereographic =
            |pole| Self::Surface(AnySurface::Stereographic(Stereographic { radius: value(0), pole }));
        Ok(match entry.name {
            "polar" => Self::Surface(AnySurface::Polar(PolarPlane)),
            "sphere" => Self::Surface(AnySurface::Sphere(Sphere { radius: value(0) })),
            "stereographic-north" => stereographic(Pole::North),
            "stereographic-south" => stereographic(Pole::South),
            "spherical" => Self::Space(AnySpace::Spherical(SphericalSpace)),
            "three-sphere" => Self::Space(AnySpace::ThreeSphere(ThreeSphere { radius: value(0) })),
            "schwarzschild" => Self::Spacetime(AnySpacetime::Schwarzschild(Schwarzschild { mass: value(0) })),
            "kerr" => Self::Spacetime(AnySpacetime::BoyerLindquist(BoyerLindquist::new(value(0)))),
            "kerr-schild" => Self::Spacetime(AnySpacetime::KerrSchild(Cartesian {
                metric: metric::Kerr::new(value(0)),
                name: name.to_owned(),
                parameters: vec![("spin".to_owned(), value(0))],
            })),
            "ellis" => Self::Spacetime(AnySpacetime::Ellis(Ellis { throat: value(0) })),
            _ => Self::Spacetime(AnySpacetime::Minkowski(Minkowski)),
        })
    }
}

fn unknown(entry: &Entry, parameter: &str) -> CatalogueError {
    let names: Vec<&str> = entry.parameters.iter().map(|(name, ..)| *name).collect();
    let known =
        if names.is_empty() { ": it has none".to_owned() } else { format!(": it has {}", names.join(", ")) };
    CatalogueError::Parameter { geometry: entry.name, parameter: parameter.to_owned(), known }
}
