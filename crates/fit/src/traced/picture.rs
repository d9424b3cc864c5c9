//! The picture of a disk, and what it changes by with every parameter.
//!
//! With I(r, λ) on the screen and r, λ functions of the place there, the mean over a pixel is an integral whose derivative has two
//! parts: that of the brightness at a fixed place, and the brightness at the edges times the area over which they sweep. Both are
//! known from the series of the images: nothing is differenced, and no sample is drawn by chance.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

use kerrscope::spacetime::closed::Landings;
use kerrscope::spacetime::kerr::Orbits;

use super::canvas::{Canvas, Layout};
use super::lines::{Around, Lines};
use super::matter::{Matter, Profile};
use super::order::{HOLE, Nodes, NotFound, ORDERS, View, solve};
use super::pieces::{MOVES, Rates};
use super::screen::{Frame, Projection, Screen};
use super::shine::Shine;
use super::sketch::Sketch;
use super::strips::Painting;

/// A disk in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// a.
    pub spin: f64,
    /// i, radians, beyond π/2 from below.
    pub inclination: f64,
    /// 1/r of the observer.
    pub u: f64,
    /// Inner radius in units of the last stable orbit's, 1 at least; of a disk that is lit evenly, 0 at the horizon and 1 at the last
    /// stable orbit, straight between them and beyond.
    pub inner: f64,
    /// Outer radius, M; infinite where it lies beyond the picture.
    pub outer: f64,
    /// F(r).
    pub profile: Profile,
    /// Where the picture is.
    pub frame: Frame,
}

/// Channels of what is drawn: the brightness, then its derivatives with respect to spin, inclination, 1/r, inner and outer radius,
/// the power law's index, scale, both coordinates of the centre, and the position angle.
pub const DRAWN: usize = 11;

/// First channels of the hole's, the edges' and the frame's parameters.
pub(super) const AT_HOLE: usize = 1;
pub(super) const AT_EDGES: usize = AT_HOLE + HOLE;
pub(super) const AT_INDEX: usize = AT_EDGES + 2;
pub(super) const AT_FRAME: usize = AT_INDEX + 1;

/// Where derivatives are put.
const LAYOUT: Layout = Layout { glows: [1, 2, 3, AT_INDEX], movers: [1, 2, 3, 7, 8, 9, 10] };

/// How finely pictures are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// Lines around.
    pub lines: usize,
    /// Steps in ln r.
    pub step: f64,
    /// Steps of r as a share of the length over which the flux bends.
    pub bend: f64,
    /// How many image orders, 1 to 4.
    pub orders: usize,
    /// The size of the last terms around, as a share of the first, at which a series is long enough.
    pub tail: f64,
    /// Whether rows lie as close as from above wherever it is seen from.
    pub radial: bool,
}

impl Default for Fineness {
    /// Such that means over pixels are within 1e-3 of the brightest.
    fn default() -> Self {
        Self { lines: 320, step: 0.03, bend: 0.06, orders: ORDERS, tail: 3e-6, radial: false }
    }
}

impl Fineness {
    /// Such that means are within 3e-3 of the brightest, for pictures that are noisier.
    pub const MEDIUM: Self =
        Self { lines: 160, step: 0.06, bend: 0.12, orders: 3, tail: 1e-4, radial: false };
    /// Enough to see what a picture is of: within some percent.
    pub const SKETCH: Self = Self { lines: 96, step: 0.12, bend: 0.25, orders: 2, tail: 1e-3, radial: false };
}

/// Numbers of directions in which images may be solved for, and cosines of the inclinations up to which the first and the second are
/// mostly enough (a = 0.9: tails of 2e-6 at 45°, 3e-6 at 70°).
const DIRECTIONS: [usize; 5] = [32, 64, 128, 256, 512];
const ENOUGH: [f64; 2] = [0.7, 0.35];

/// A tail from which on a series that is half as long is looked at first.
pub(super) const COARSE: f64 = 3e-5;

/// A disk as it is seen: where its edges lie, and how they move.
pub(super) struct Stand<'a> {
    /// The disk.
    pub setting: &'a Setting,
    /// The observer, or its mirror image above the plane.
    pub view: View,
    /// x of the inner edge.
    pub inner: f64,
    above: bool,
    rates: Rates,
    /// x of the outer edge, if it lies within the picture.
    bound: Option<f64>,
    /// M from the middle of the polar coordinates to the picture's farthest corner.
    reach: f64,
}

/// The image of an order at its nodes.
pub(super) struct Image {
    /// Which number of directions it has.
    choice: usize,
    /// The nodes.
    pub nodes: Nodes,
    /// x of the outer edge in each direction.
    pub ends: Vec<f64>,
}

impl Image {
    /// The same directions with other nodes and ends.
    pub fn replaced(&self, nodes: Nodes, ends: Vec<f64>) -> Self {
        Self { choice: self.choice, nodes, ends }
    }
}

impl<'a> Stand<'a> {
    /// With the radius of the last stable orbit and its derivative in the first of the hole's parameters, with which the spin changes
    /// by `turn`.
    pub fn new(setting: &'a Setting, (isco, isco_rate): (f64, f64), turn: f64) -> Self {
        let above = setting.inclination <= FRAC_PI_2;
        let inclination = if above { setting.inclination } else { PI - setting.inclination };
        let view = View { spin: setting.spin, inclination, u: setting.u, turn };
        let (radius, radius_rates) = setting.inner_edge((isco, isco_rate));
        let inner = radius.powf(-0.5);
        let mut inner_rates = [0.0; MOVES];
        inner_rates[0] = -0.5 * inner * radius_rates[0] / radius;
        inner_rates[HOLE] = -0.5 * inner * radius_rates[1] / radius;
        let bounded = setting.outer * setting.u <= NEAR && setting.outer.is_finite();
        let bound = bounded.then(|| setting.outer.powf(-0.5));
        let outer_rates = bound.map(|outer| {
            let mut moves = [0.0; MOVES];
            moves[HOLE + 1] = -0.5 * outer / setting.outer;
            moves
        });
        let rates = Rates { edges: [Some(inner_rates), outer_rates] };
        let Frame { size, scale, center, .. } = setting.frame;
        let half = [0, 1].map(|k| 0.5 * size[k] as f64 + center[k].abs());
        let reach = half[0].hypot(half[1]) * scale + view.center().0.abs();
        Self { setting, view, inner, above, rates, bound, reach }
    }

    /// x between which matter is asked for.
    pub fn ends(&self) -> [f64; 2] {
        [self.bound.unwrap_or(FAR_X), self.inner]
    }

    /// x of the outer edge of an image in a direction.
    fn outer(&self, order: usize, chi: f64) -> f64 {
        // Images of higher orders have all of a disk without an outer edge next to the critical curve.
        match (self.bound, order) {
            (Some(bound), _) => bound,
            (None, 0) => cover(&self.view, self.reach, self.view.angle(chi)[0]).min(0.9 * self.inner),
            (None, _) => FAR_X,
        }
    }

    /// The same in equal steps around.
    pub fn outers(&self, order: usize, directions: usize) -> Vec<f64> {
        (0..directions).map(|j| self.outer(order, 2.0 * PI * j as f64 / directions as f64)).collect()
    }
}

/// Draws disks.
#[derive(Debug)]
pub struct Painter {
    projection: Projection,
    opaque: bool,
    fineness: Fineness,
    landings: Landings,
    around: [OnceLock<Around>; DIRECTIONS.len()],
}

/// x up to which images of higher orders are followed in a disk without an outer edge, r = 2500 M: the rest is dark.
const FAR_X: f64 = 0.02;

/// The largest outer radius of a disk with an edge, as a share of the observer's: one farther out is drawn as one without an edge.
const NEAR: f64 = 0.8;

/// Light that no picture can be made of: some of it does not come from where it should.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Unseen;

impl From<NotFound> for Unseen {
    fn from(_: NotFound) -> Self {
        Self
    }
}

impl Painter {
    /// Of disks that are opaque, or hold nothing back and show all of their orders.
    pub fn new(projection: Projection, opaque: bool, fineness: Fineness) -> Self {
        Self {
            projection,
            opaque,
            fineness,
            landings: Landings::default(),
            around: std::array::from_fn(|_| OnceLock::new()),
        }
    }

    /// The mean over each pixel and, if asked for, its derivatives: [`DRAWN`] channels.
    ///
    /// # Errors
    /// If the disk has no picture.
    pub fn draw(&self, setting: &Setting, derivatives: bool) -> Result<Canvas, Unseen> {
        let stand = Stand::new(setting, last_stable_orbit(setting.spin), 1.0);
        let matter = Matter::new(setting.spin, setting.profile, stand.ends());
        let images = self
            .orders()
            .map(|order| self.image(&stand, order, derivatives))
            .collect::<Result<Vec<_>, _>>()?;
        let lambda = [0.0, -setting.inclination.sin()];
        Ok(self.paint(&stand, (&matter, lambda), &images, derivatives))
    }

    /// The image orders that are drawn.
    pub(super) fn orders(&self) -> std::ops::Range<usize> {
        0..self.fineness.orders.min(ORDERS)
    }

    /// The picture of what shines, in the light of λ = λ₀ + λ₁ α, from the nodes of its images.
    pub(super) fn paint(
        &self,
        stand: &Stand<'_>,
        (matter, lambda): (&dyn Shine, [f64; 2]),
        images: &[Image],
        derivatives: bool,
    ) -> Canvas {
        let Stand { setting, view, inner, rates, above, .. } = stand;
        let screen =
            Screen::new(setting.spin, setting.inclination, setting.u, setting.frame, self.projection)
                .turning(view.turn);
        let sketch = Sketch { above: *above, setting, view, screen: &screen, matter, lambda, derivatives };
        let lines: Vec<Lines> = images
            .iter()
            .enumerate()
            .map(|(order, image)| self.lines(view, order, *inner, (image, derivatives)))
            .collect();
        let size = setting.frame.size;
        let mut canvas = Canvas::new(size[0], size[1], derivatives.then_some(LAYOUT));
        for (order, image) in lines.iter().enumerate() {
            let before = if self.opaque { &lines[..order] } else { &[] };
            let rows = self.fineness.rows(matter, [*inner, stand.outer(order, 0.0)], order, view.inclination);
            Painting { sketch: &sketch, image, before, rates, rows: &rows }
                .draw(self.fineness.lines, &mut canvas);
        }
        canvas
    }

    /// The image of an order along the lines, with what it moves by if that is asked for.
    fn lines(&self, view: &View, order: usize, inner: f64, (image, derivatives): (&Image, bool)) -> Lines {
        let around = self.around[image.choice]
            .get_or_init(|| Around::new(DIRECTIONS[image.choice], self.fineness.lines));
        Lines::new(view, order, (&image.nodes, derivatives), around, inner, &image.ends)
    }

    /// The image of an order around a Kerr hole, and how it moves if asked for.
    pub(super) fn image(&self, stand: &Stand<'_>, order: usize, derivatives: bool) -> Result<Image, Unseen> {
        let view = &stand.view;
        let cos = view.inclination.cos();
        let fine = ENOUGH.iter().filter(|least| cos < **least).count();
        let first = if self.fineness.tail >= COARSE { fine.saturating_sub(1) } else { fine };
        for (choice, directions) in DIRECTIONS.into_iter().enumerate().skip(first) {
            let ends = stand.outers(order, directions);
            let nodes = solve(view, &self.landings, order, (stand.inner, &ends), derivatives)?;
            if choice + 1 == DIRECTIONS.len() || nodes.tail() <= self.fineness.tail {
                return Ok(Image { choice, nodes, ends });
            }
        }
        Err(Unseen)
    }
}

impl Setting {
    /// From the parameters that all disks have, in their order (inclination and position angle in degrees, M in a pixel, centre in pixels,
    /// r of the observer, edges), in a picture of a size.
    pub(super) fn of(spin: f64, common: [f64; 8], profile: Profile, size: [usize; 2]) -> Self {
        let [inclination, position_angle, scale, x, y, distance, inner, outer] = common;
        Self {
            spin,
            inclination: inclination.to_radians(),
            u: distance.recip(),
            inner,
            outer,
            profile,
            frame: Frame { size, scale, center: [x, y], position_angle: position_angle.to_radians() },
        }
    }

    /// Radius of the inner edge, and its derivatives in spin and `inner`, from the radius of the last stable orbit and its derivative.
    fn inner_edge(&self, (isco, isco_rate): (f64, f64)) -> (f64, [f64; 2]) {
        if self.profile != Profile::Even {
            return (isco * self.inner, [isco_rate * self.inner, isco]);
        }
        // r₊ = 1 + √(1 − a²), and a little more: light from there takes for ever.
        let root = (1.0 - self.spin * self.spin).max(1e-12).sqrt();
        let (horizon, horizon_rate) = ((1.0 + root) * OUTSIDE, -self.spin / root * OUTSIDE);
        let radius = horizon + self.inner * (isco - horizon);
        (radius, [horizon_rate + self.inner * (isco_rate - horizon_rate), isco - horizon])
    }
}

/// The innermost that is seen, in units of the horizon's radius.
const OUTSIDE: f64 = 1.0 + 1e-6;

/// Radius of the last stable orbit about +z, and its derivative in a.
pub(super) fn last_stable_orbit(spin: f64) -> (f64, f64) {
    let step = 1e-6;
    let ends = [(spin - step).max(-1.0), (spin + step).min(1.0)];
    let at = |a: f64| Orbits::new(a).isco;
    (at(spin), (at(ends[1]) - at(ends[0])) / (ends[1] - ends[0]))
}

/// x beyond which the direct image lies outside the picture, in a direction: that of a ray that goes straight, some M farther out.
/// With X to the right and Y up, κ = uY tan i: 1/r = (1 − κ)/√(X² + Y²/cos² i), smoothly bounded where it sees the sky.
fn cover(view: &View, reach: f64, psi: f64) -> f64 {
    let (sin, cos) = psi.sin_cos();
    let (tilt_sin, tilt_cos) = view.inclination.sin_cos();
    let rho = 1.1 * reach + 6.0;
    let flat = (cos * cos + (sin / tilt_cos).powi(2)).sqrt() * rho;
    let u = (1.0 - view.u * rho * sin * tilt_sin / tilt_cos) / flat;
    let least = 0.02 / reach;
    (0.5 * (u + u.hypot(2.0 * least))).sqrt()
}
