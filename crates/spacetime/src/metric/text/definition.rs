//! A metric as somebody wrote it.

/// What the coordinates are like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// (t, x, y, z): far away g → diag(−1, 1, 1, 1).
    #[default]
    Cartesian,
    /// (t, r, θ, φ): far away g → diag(−1, 1, r², r² sin²θ).
    Spherical,
}

/// How the spacetime reversed in time, in which rays are followed, comes from the metric.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reversal {
    /// t → −t: right for every stationary metric. Light that falls in is regular at the horizon if the metric is
    /// regular at the past horizon, as in outgoing coordinates.
    #[default]
    Time,
    /// y → −y (φ → −φ): right where the spacetime reversed in time is its own mirror image, as around any body that
    /// turns about +z and does nothing else. Light that falls in is regular at the horizon if the metric is regular at
    /// the future horizon, as in ingoing coordinates.
    Mirror,
}

/// A metric in words: names and formulas.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Definition {
    /// Names of the coordinates, time first.
    pub coordinates: [String; 4],
    /// What they are like.
    pub kind: Kind,
    /// Numbers with names.
    pub parameters: Vec<(String, f64)>,
    /// Formulas with names, in any order, that others can use.
    pub lets: Vec<(String, String)>,
    /// Components g_{μν} by the names of two coordinates, joined by a low line or by nothing; what is not given is 0.
    pub components: Vec<(String, String)>,
    /// The radius by which disks and the horizon are measured; the distance from the origin if not given.
    pub radius: Option<String>,
    /// The radius of the horizon, of parameters alone; none if not given or 0.
    pub horizon: Option<String>,
    /// Instead of a horizon: what is above 1 where light counts as captured.
    pub depth: Option<String>,
    /// Distance from the origin where rays end, of parameters alone, if space does not become flat.
    pub outer: Option<String>,
    /// Distance from the origin of the sphere on whose other side space goes on as its mirror image, of parameters alone.
    pub throat: Option<String>,
    /// How time is reversed.
    pub reversal: Reversal,
}

/// A part of a [`Definition`], by its place there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Part {
    /// The definition as a whole.
    Whole,
    /// The name of a coordinate.
    Coordinate(usize),
    /// A parameter's name.
    Parameter(usize),
    /// The name of a formula.
    LetName(usize),
    /// A formula with a name.
    Let(usize),
    /// The names of a component's coordinates.
    ComponentName(usize),
    /// A component.
    Component(usize),
    /// The radius.
    Radius,
    /// The horizon.
    Horizon,
    /// The depth.
    Depth,
    /// Where rays end.
    Outer,
    /// The throat.
    Throat,
    /// How time is reversed.
    Reversal,
}
