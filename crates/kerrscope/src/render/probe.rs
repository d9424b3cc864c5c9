//! What a ray says for the data layers.

use std::sync::Arc;

use super::layer::{Channel, Layer, ORDERS};
use crate::disk::Disk;
use crate::scene::Scene;
use crate::spacetime::emitter::{Circular, Departure, Sense};
use crate::spacetime::geodesic::{Crossing, Fate, Path, Query, Ray, Side};
use crate::spacetime::tensor::{Vec3, dot};

/// The layers that a picture has besides light, and what is needed to fill them.
#[derive(Clone, Debug)]
pub(super) struct Probe {
    channels: Vec<Channel>,
    query: Query,
    /// What sends light in the plane, where that is known.
    matter: Option<Arc<Circular>>,
}

impl Probe {
    /// The layers of a scene whose rays for light ask for `query`.
    pub(super) fn new(scene: &Scene, query: &Query) -> Self {
        let layers = &scene.render.layers;
        let query = Query {
            max_crossings: (scene.render.max_crossings as usize).max(usize::from(ORDERS)),
            elapsed: layers.contains(&Layer::T),
            windings: layers.contains(&Layer::Windings),
            ..*query
        };
        let [nx, ny, nz] = query.plane;
        // About −z a disk turns against the spin; its orbits are those of the mirrored hole.
        let in_equator = nx.hypot(ny) <= 1e-12;
        let level = |spin: f64| spin == 0.0 || in_equator;
        let round = in_equator || scene.spacetime.spin() == Some(0.0);
        let matter = scene.spacetime.spin().filter(|spin| level(*spin));
        let matter = matter.map(|spin| Arc::new(Circular::kerr(spin * nz.signum(), Sense::Prograde)));
        // A disk knows how its matter turns.
        let matter = scene.disk.as_ref().and_then(|disk| disk.orbits.clone()).filter(|_| round).or(matter);
        Self { channels: layers.iter().copied().flat_map(Layer::channels).collect(), query, matter }
    }

    pub(super) fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// What to ask along the ray.
    pub(super) fn query(&self) -> &Query {
        &self.query
    }

    /// The values of the channels for a ray that was followed; without a ray, no photon arrives
    /// there.
    pub(super) fn values<'a>(
        &'a self,
        ray: Option<Ray>,
        path: &'a Path,
        disk: Option<&'a Disk>,
    ) -> impl Iterator<Item = f32> + use<'a> {
        self.channels.iter().map(move |channel| self.value(*channel, ray.as_ref(), path, disk) as f32)
    }

    fn value(&self, channel: Channel, ray: Option<&Ray>, path: &Path, disk: Option<&Disk>) -> f64 {
        let crossing = || path.crossings.get(usize::from(channel.order.unwrap_or_default()));
        match channel.layer {
            Layer::Fate => match path.fate {
                Fate::Escaped => 0.0,
                Fate::Captured => 1.0,
                Fate::StepLimit => 2.0,
                Fate::Hit => 3.0,
            },
            Layer::Crossings => path.crossings.len().min(self.query.max_crossings) as f64,
            Layer::Windings => path.windings,
            Layer::Steps => path.steps as f64,
            Layer::Error => path.error_estimate,
            Layer::R => crossing().map_or(f64::NAN, |c| c.r),
            Layer::Phi => crossing().map_or(f64::NAN, |c| c.phi),
            Layer::T => crossing().map_or(f64::NAN, |c| c.elapsed),
            Layer::G => crossing().zip(ray).and_then(|(c, ray)| self.redshift(ray, c)).unwrap_or(f64::NAN),
            Layer::Intensity => {
                let order = usize::from(channel.order.unwrap_or_default());
                let hit = disk.zip(ray).and_then(|(disk, ray)| disk.hits(ray, path).nth(order));
                let sheet = disk.zip(hit).and_then(|(disk, hit)| disk.sheet(&hit));
                sheet.map_or(f64::NAN, |sheet| sheet.light.intensity)
            }
            Layer::SkyTheta => path.direction.map_or(f64::NAN, |[theta, _]| theta),
            Layer::SkyPhi => path.direction.map_or(f64::NAN, |[_, phi]| phi),
            Layer::Depth => ray.map_or(f64::INFINITY, |ray| depth(ray, path, disk)),
        }
    }

    fn redshift(&self, ray: &Ray, crossing: &Crossing) -> Option<f64> {
        let light = Departure::new(ray, crossing, &self.query.plane);
        let orbit = self.matter.as_ref()?.orbit(crossing.r)?;
        orbit.redshift_factor(light.lambda, light.energy)
    }
}

/// How far away the disk is where the ray first meets it, or the thing behind which it does not.
fn depth(ray: &Ray, path: &Path, disk: Option<&Disk>) -> f64 {
    let met = disk.and_then(|disk| {
        let seen = |hit| disk.sheet(&hit).is_some_and(|sheet| sheet.opacity > 0.0 || disk.thin);
        disk.hits(ray, path).position(seen).map(|order| path.crossings[order].position)
    });
    let Some(position) = met.or(path.hit.map(|hit| hit.position)) else { return f64::INFINITY };
    if ray.side == Side::Ingoing {
        // What lies behind the change of sheets is known in other coordinates.
        return f64::NAN;
    }
    let camera: Vec3<f64> = ray.start.n.map(|c| c / ray.start.w);
    let apart: Vec3<f64> = std::array::from_fn(|i| position[i] - camera[i]);
    dot(&apart, &apart).sqrt()
}
