//! A definition compiled.

use super::definition::{Definition, Kind, Part, Reversal};
use super::fault::DefinitionFault;
use super::lexicon::Lexicon;
use super::spherical::Rewriter;
use crate::formula::{Fault, Graph, NodeId, Program, parse};
use crate::scalar::Scalar;
use crate::tensor::{Tensor, Vec3, Vec4};

/// The places of the ten components among sixteen.
pub(super) const PAIRS: [[usize; 2]; 10] =
    [[0, 0], [0, 1], [0, 2], [0, 3], [1, 1], [1, 2], [1, 3], [2, 2], [2, 3], [3, 3]];

/// A line element ds² = g_{μν} dxᵘ dxᵛ from a [`Definition`], its formulas compiled.
///
/// [`Text`](super::Text) is the [`Metric`](crate::metric::Metric) of a stationary one.
///
/// ```
/// use kerrscope_spacetime::metric::{Definition, LineElement};
/// let text = |s: &str| s.to_owned();
/// let schwarzschild = Definition {
///     coordinates: ["t", "x", "y", "z"].map(text),
///     parameters: vec![(text("m"), 1.0)],
///     lets: vec![(text("r"), text("sqrt(x^2 + y^2 + z^2)")), (text("u"), text("m/(2*r)"))],
///     components: [("tt", "-((1-u)/(1+u))^2"), ("xx", "(1+u)^4"), ("yy", "(1+u)^4"), ("zz", "(1+u)^4")]
///         .map(|(pair, formula)| (text(pair), text(formula)))
///         .to_vec(),
///     horizon: Some(text("m/2")),
///     ..Definition::default()
/// };
/// let element = LineElement::compile(&schwarzschild).unwrap();
/// assert!(element.is_stationary());
/// let g = element.components(&[0.0, 2.0, 0.0, 0.0]);
/// assert_eq!(g[1][1], 1.25f64.powi(4));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LineElement {
    /// In the coordinates of the definition.
    native: Program,
    /// In Cartesian-like ones.
    cartesian: Program,
    /// None: the distance from the origin.
    radius: Option<Program>,
    depth: Option<Program>,
    horizon: f64,
    throat: bool,
    /// 1/distance where rays end; 0 at infinity.
    edge: f64,
    reversal: Reversal,
    stationary: bool,
    axisymmetric: bool,
    coordinates: [String; 4],
    kind: Kind,
    definition: Definition,
}

impl LineElement {
    /// Compiles a definition.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn compile(definition: &Definition) -> Result<Self, Vec<DefinitionFault>> {
        let mut faults = Vec::new();
        let mut graph = Graph::default();
        let lexicon = Lexicon::read(definition, &mut graph, &mut faults);
        let mut reader = Reader { graph, lexicon, faults };
        let native = reader.components(definition);
        let radius = reader.formula(definition.radius.as_deref(), Part::Radius);
        let depth = reader.formula(definition.depth.as_deref(), Part::Depth);
        let [horizon, outer, throat] = [
            (&definition.horizon, Part::Horizon, "a horizon"),
            (&definition.outer, Part::Outer, "the end of rays"),
            (&definition.throat, Part::Throat, "a throat"),
        ]
        .map(|(text, part, name)| reader.number(text.as_deref(), part, name));
        reader.conflicts(definition, [horizon, outer, throat]);
        let Reader { mut graph, mut faults, .. } = reader;
        let roots: Vec<NodeId> = native.iter().copied().chain(radius).chain(depth).collect();
        let stationary = !graph.depends(&roots, 0);
        let native_program = Program::compile(&graph, 4, &native);
        let (graph, cartesian, radius, depth) = match definition.kind {
            Kind::Cartesian => (graph, native, radius, depth),
            Kind::Spherical => {
                let mut rewriter = Rewriter::new(&mut graph);
                let cartesian = rewriter.components(native);
                let [radius, depth] = [radius, depth].map(|node| node.map(|node| rewriter.rewrite(node)));
                (rewriter.into_graph(), cartesian, radius, depth)
            }
        };
        let too_many = "give fewer or simpler components";
        if graph.is_full() {
            let what = "the metric has too many operations in Cartesian-like coordinates";
            faults.push(DefinitionFault::whole(Part::Whole, what, too_many));
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let compile = |nodes: &[NodeId]| Program::compile(&graph, 4, nodes);
        let compiled = (
            native_program,
            compile(&cartesian),
            radius.map(|node| compile(&[node])),
            depth.map(|node| compile(&[node])),
        );
        let (Some(native), Some(cartesian), None | Some(Some(_)), None | Some(Some(_))) = &compiled else {
            let what = "more than 256 values have to be kept at a time to work the metric out";
            return Err(vec![DefinitionFault::whole(Part::Whole, what, too_many)]);
        };
        let mut element = Self {
            native: native.clone(),
            cartesian: cartesian.clone(),
            radius: compiled.2.flatten(),
            depth: compiled.3.flatten(),
            horizon: throat.or(horizon).unwrap_or(0.0).max(0.0),
            throat: throat.is_some(),
            edge: outer.map_or(0.0, f64::recip),
            reversal: definition.reversal,
            stationary,
            axisymmetric: false,
            coordinates: definition.coordinates.clone(),
            kind: definition.kind,
            definition: definition.clone(),
        };
        element.axisymmetric = super::check::is_axisymmetric(&element);
        if element.reversal == Reversal::Mirror && !element.axisymmetric {
            let what =
                "a spacetime that is not the same all around the z axis is not its own mirror image in time";
            let mend = "leave it at \"time\", in which t changes its sign";
            return Err(vec![DefinitionFault::whole(Part::Reversal, what, mend)]);
        }
        Ok(element)
    }

    /// Names of the coordinates that it was written in.
    pub fn coordinates(&self) -> &[String; 4] {
        &self.coordinates
    }

    /// What these are like.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Its parameters with their values.
    pub fn parameters(&self) -> &[(String, f64)] {
        &self.definition.parameters
    }

    /// The same metric with other values of some of its parameters; names that it has not are left alone.
    ///
    /// # Errors
    /// What is wrong with these values.
    pub fn with(&self, parameters: &[(&str, f64)]) -> Result<Self, Vec<DefinitionFault>> {
        let mut definition = self.definition.clone();
        for (name, value) in &mut definition.parameters {
            if let Some((_, given)) = parameters.iter().find(|(given, _)| given == name) {
                *value = *given;
            }
        }
        Self::compile(&definition)
    }

    /// Whether nothing depends on time.
    pub fn is_stationary(&self) -> bool {
        self.stationary
    }

    /// Whether it is the same all around the z axis, as twelve places tell.
    pub fn is_axisymmetric(&self) -> bool {
        self.axisymmetric
    }

    /// Whether there is another side.
    pub fn has_throat(&self) -> bool {
        self.throat
    }

    /// Whether what is captured is known by its own formula.
    pub(super) fn depth(&self) -> Option<&Program> {
        self.depth.as_ref()
    }

    pub(super) fn radius_program(&self) -> Option<&Program> {
        self.radius.as_ref()
    }

    /// The radius of the horizon or of the throat; 0 where there is none.
    pub fn horizon(&self) -> f64 {
        self.horizon
    }

    /// The distance from the origin where rays end; infinite if space becomes flat.
    pub fn outer(&self) -> f64 {
        self.edge.recip()
    }

    pub(super) fn edge(&self) -> f64 {
        self.edge
    }

    pub(super) fn reversal(&self) -> Reversal {
        self.reversal
    }

    /// How many instructions the components are, in the definition's coordinates and in Cartesian-like ones.
    pub fn instructions(&self) -> [usize; 2] {
        [self.native.len(), self.cartesian.len()]
    }

    /// g_{μν} in the coordinates of the definition.
    pub fn components<S: Scalar>(&self, x: &Vec4<S>) -> Tensor<S> {
        let mut parts = [x[0]; 10];
        self.native.evaluate(x, &mut parts);
        whole(&parts)
    }

    /// g_{μν} in Cartesian-like coordinates, at t = 0.
    #[inline(always)]
    pub fn cartesian<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
        let zero = x[0].constant(0.0);
        let mut parts = [zero; 10];
        self.cartesian.evaluate(&[zero, x[0], x[1], x[2]], &mut parts);
        whole(&parts)
    }
}

/// A symmetric tensor from its ten components.
#[inline(always)]
fn whole<S: Scalar>(parts: &[S; 10]) -> Tensor<S> {
    let mut g = [[parts[0]; 4]; 4];
    for k in 0..10 {
        let [m, n] = PAIRS[k];
        g[m][n] = parts[k];
        g[n][m] = parts[k];
    }
    g
}

struct Reader {
    graph: Graph,
    lexicon: Lexicon,
    faults: Vec<DefinitionFault>,
}

impl Reader {
    fn formula(&mut self, text: Option<&str>, part: Part) -> Option<NodeId> {
        match parse(text?, &mut self.graph, &mut self.lexicon) {
            Ok(node) => Some(node),
            Err(wrong) => {
                self.faults.extend(wrong.into_iter().map(|fault| DefinitionFault { part, fault }));
                None
            }
        }
    }

    /// A number of parameters alone, not below 0.
    fn number(&mut self, text: Option<&str>, part: Part, name: &str) -> Option<f64> {
        let node = self.formula(text, part)?;
        let length = text.map_or(0, str::len);
        let mut fault = |what: String, help: String| {
            self.faults.push(DefinitionFault { part, fault: Fault { span: 0..length, message: what, help } });
        };
        let Some(value) = self.graph.value(node) else {
            let mend = match part {
                Part::Horizon => {
                    "give a number or a formula of parameters, or say with `depth` what counts as captured"
                }
                _ => "give a number or a formula of parameters",
            };
            fault(format!("{name} cannot depend on coordinates"), mend.to_owned());
            return None;
        };
        if !value.is_finite() || value < 0.0 || (value == 0.0 && part != Part::Horizon) {
            let shown = if value.is_nan() { "not a number".to_owned() } else { value.to_string() };
            let mend = "give a positive number, or change the parameters until it is one";
            fault(format!("{name} is at a radius that is {shown}"), mend.to_owned());
            return None;
        }
        Some(value)
    }

    fn components(&mut self, definition: &Definition) -> [NodeId; 10] {
        let mut all = [None; 10];
        for (i, (name, text)) in definition.components.iter().enumerate() {
            let node = self.formula(Some(text), Part::Component(i));
            match pair(&definition.coordinates, name) {
                Ok(place) if all[place].is_some() => {
                    let what = format!("the component `{name}` is given twice; the metric is symmetric");
                    self.faults.push(DefinitionFault::whole(
                        Part::ComponentName(i),
                        what,
                        "keep one of the two",
                    ));
                }
                Ok(place) => all[place] = Some(node.unwrap_or_else(|| self.graph.constant(1.0))),
                Err((what, mend)) => {
                    self.faults.push(DefinitionFault::whole(Part::ComponentName(i), what, mend));
                }
            }
        }
        for (place, [m, _]) in PAIRS.into_iter().enumerate().filter(|(_, [m, n])| m == n) {
            if all[place].is_none() && self.faults.is_empty() {
                let name = &definition.coordinates[m];
                let what = format!("the metric lacks its component `{name}{name}`");
                let mend = "give every component with two equal coordinates; others are 0 if not given";
                self.faults.push(DefinitionFault::whole(Part::Whole, what, mend));
            }
        }
        all.map(|node| node.unwrap_or_else(|| self.graph.constant(0.0)))
    }

    fn conflicts(&mut self, definition: &Definition, [horizon, outer, throat]: [Option<f64>; 3]) {
        let mut fault = |part, what: &str, mend: &str| {
            self.faults.push(DefinitionFault::whole(part, what, mend));
        };
        if definition.horizon.is_some() && definition.depth.is_some() {
            fault(
                Part::Depth,
                "`horizon` and `depth` both say what counts as captured",
                "keep one of the two",
            );
        }
        if throat.is_some() && (definition.horizon.is_some() || definition.depth.is_some()) {
            let what = "rays go on through a throat, and `horizon` or `depth` would end them";
            fault(Part::Throat, what, "keep one of the two");
        }
        if let Some(inner) = throat.or(horizon).filter(|inner| outer.is_some_and(|outer| outer <= *inner)) {
            let what = format!("rays end within the horizon or throat at {inner}");
            fault(Part::Outer, &what, "give a larger radius");
        }
    }
}

/// The place of a component among the ten.
fn pair(coordinates: &[String; 4], name: &str) -> Result<usize, (String, String)> {
    let named = |m: usize, n: usize| {
        let (a, b) = (&coordinates[m], &coordinates[n]);
        name == format!("{a}{b}") || name == format!("{a}_{b}")
    };
    let places: Vec<usize> = (0..10)
        .filter(|place| {
            let [m, n] = PAIRS[*place];
            named(m, n) || named(n, m)
        })
        .collect();
    let [a, b] = [&coordinates[0], &coordinates[1]];
    match places[..] {
        [place] => Ok(place),
        [] => {
            let shown = Fault::shorten(name);
            let what = format!("`{shown}` is no component: it is not the names of two coordinates");
            Err((what, format!("write {a}{a} or {a}_{b}, of the coordinates {}", coordinates.join(", "))))
        }
        _ => Err((
            format!("`{name}` is the name of two components"),
            format!("join the coordinates by a low line: {a}_{b}"),
        )),
    }
}
