//! A spacetime of one's own: a charged black hole (Reissner–Nordström), regular at its horizon.
//!
//!     cargo run --release -p kerrscope --example own_metric -- charged.png
//!
//! A metric is its components, a radius and a horizon; the equations of light follow from them with exact derivatives.

use kerrscope::render::{Stage, Watch, draw};
use kerrscope::scene::Scene;
use kerrscope::spacetime::Scalar;
use kerrscope::spacetime::geodesic::Scheme;
use kerrscope::spacetime::geometry::{Cartesian, check};
use kerrscope::spacetime::metric::Metric;
use kerrscope::spacetime::tensor::{Tensor, Vec3, dot, each};
use std::path::Path;

/// g = η + f l l with f = 2/r − Q²/r² and l = (1, x/r): Kerr–Schild coordinates, mass 1, charge Q.
#[derive(Clone, Copy)]
struct Charged {
    charge: f64,
}

impl Metric for Charged {
    #[inline(always)]
    fn components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
        let inverse_r = self.radius(x).recip();
        let f = inverse_r * 2.0 - inverse_r.squared() * (self.charge * self.charge);
        let l = [inverse_r.constant(1.0), x[0] * inverse_r, x[1] * inverse_r, x[2] * inverse_r];
        let flat = [[-1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
        each(
            #[inline(always)]
            |m| {
                each(
                    #[inline(always)]
                    |n| f * l[m] * l[n] + flat[m][n],
                )
            },
        )
    }
    #[inline(always)]
    fn radius<S: Scalar>(&self, x: &Vec3<S>) -> S {
        dot(x, x).sqrt()
    }
    fn horizon(&self) -> f64 {
        1.0 + (1.0 - self.charge * self.charge).sqrt()
    }
}

/// Draws the hole as an observer at infinity sees it, in a sky and with a disk that it is told of by a scene.
fn picture(metric: Charged, file: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let keys = "spacetime.name = \"schwarzschild\"\nobserver.distance = inf\n\
                screen = { kind = \"impact\", field_of_view = 20 }\n\
                render = { width = 320, height = 180, samples = 4, adaptive = false }";
    let scene = Scene::from_toml(keys, Path::new(""))?;
    let stage = Stage::new(&scene)?.in_metric(metric, Scheme::Tsit5 { tolerance: 1e-6 }, 10_000);
    let film = draw(&stage, &Watch::default())?;
    let shown = scene.display.picture(&film);
    let bytes: Vec<u8> = shown.pixels.iter().flatten().map(|c| (255.0 * c).round() as u8).collect();
    image::save_buffer(file, &bytes, shown.width, shown.height, image::ColorType::Rgb8)?;
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let metric = Charged { charge: 0.9 };
    let found = check(&Cartesian::new(metric, "charged"), 200, 1);
    println!("a good metric: {}; a vacuum: {}, for its field has energy", found.is_good(), found.is_vacuum());
    picture(metric, Path::new(&std::env::args().nth(1).unwrap_or("own_metric.png".to_owned())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use kerrscope::spacetime::geodesic::{Fate, Integrator, Path as Way, Query, Tracer};
    use kerrscope::spacetime::observer::impact_ray;
    use std::f64::consts::FRAC_PI_2;

    /// Photons circle at r = (3 + √(9 − 8Q²))/2; the shadow's edge is at b = r²/√(r² − 2r + Q²).
    #[test]
    fn its_shadow_is_as_large_as_it_should_be() {
        for charge in [0.0, 0.5, 0.9] {
            let square = charge * charge;
            let r = 0.5 * (3.0 + f64::sqrt(9.0 - 8.0 * square));
            let edge = r * r / (r * r - 2.0 * r + square).sqrt();
            let tracer = Integrator::new(Charged { charge }, Scheme::Dop853 { tolerance: 1e-10 }, 10_000);
            for (factor, fate) in [(1.0 - 1e-6, Fate::Captured), (1.0 + 1e-6, Fate::Escaped)] {
                let ray = impact_ray(Some(0.0), FRAC_PI_2, f64::INFINITY, [edge * factor, 0.0]).unwrap();
                let mut way = Way::default();
                tracer.trace(&ray, &Query::default(), &mut way);
                assert_eq!(way.fate, fate, "Q = {charge}, b = {}", edge * factor);
            }
        }
    }

    #[test]
    fn it_is_drawn() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("charged.png");
        picture(Charged { charge: 0.9 }, &file).unwrap();
        let shown = image::open(&file).unwrap().to_rgb8();
        assert_eq!(shown.dimensions(), (320, 180));
        assert_eq!(shown.get_pixel(160, 70).0, [0; 3], "the middle of the shadow, above the disk");
    }
}
