//! Rays of flat spacetime: straight lines, without integration.

use super::{Crossing, Fate, Hit, Line, ObstacleTracer, Obstacles, Path, Query, Ray, Segment, Tracer};
use crate::tensor::{Vec3, cross, dot};
use std::f64::consts::PI;

/// The tracer of [`crate::metric::Minkowski`].
#[derive(Clone, Copy, Debug)]
pub struct Straight;

impl Tracer for Straight {
    fn name(&self) -> &'static str {
        "straight"
    }

    fn trace(&self, ray: &Ray, query: &Query, path: &mut Path) {
        path.clear();
        path.fate = Fate::Escaped;
        path.error_estimate = f64::EPSILON;
        let n = ray.start.n;
        let p = ray.start.momentum();
        let length = dot(&p, &p).sqrt();
        let v = p.map(|c| c / length);
        // Azimuth by which the line has turned about the axis, seen from its start.
        let turned = |to: &[f64; 3]| ray.azimuth + super::winding::turn(&n, to);
        let theta = (v[0].hypot(v[1])).atan2(v[2]);
        let from_infinity = ray.start.w == 0.0 && n[0].hypot(n[1]) > 0.0;
        // From infinity to infinity it turns by half a circle, in the sense of J_z.
        let phi = if from_infinity { ray.azimuth + PI.copysign(ray.start.j[2]) } else { turned(&v) };
        path.direction = Some([theta, phi]);
        if query.windings {
            let side = cross(&n, &v);
            path.windings = dot(&side, &side).sqrt().atan2(dot(&n, &v)) / (2.0 * PI);
        }
        let (height, climb) = (dot(&n, &query.plane), dot(&v, &query.plane));
        // Distance along the line in units of the camera's distance; at infinity no scale is left,
        // and the crossing lies at x = n/w + v d with w d → −n·v.
        let share = -height / climb;
        if query.max_crossings > 0 && height * climb < 0.0 {
            let w = ray.start.w;
            let at = |share: f64| -> [f64; 3] {
                if w > 0.0 {
                    std::array::from_fn(|i| (n[i] + share * v[i]) / w)
                } else {
                    // x = b + v d, b = v × J, the point closest to the origin.
                    let b = cross(&v, &ray.start.j).map(|c| c / length);
                    let d = -dot(&b, &query.plane) / climb;
                    std::array::from_fn(|i| b[i] + d * v[i])
                }
            };
            let position = at(share);
            let r = dot(&position, &position).sqrt();
            let elapsed = if !query.elapsed {
                f64::NAN
            } else if w > 0.0 {
                share / w
            } else {
                // The camera's distance r is taken off (there is no mass to delay light).
                dot(&position, &v)
            };
            // What is followed is the photon reversed.
            path.crossings.push(Crossing {
                position,
                r,
                phi: turned(&position),
                elapsed,
                normal: -climb,
                outward: dot(&position, &v) < 0.0,
            });
        }
        if query.points > 0 && ray.start.w > 0.0 {
            let w = ray.start.w;
            let last = 3.0;
            let count = query.points;
            path.points.extend((0..count).map(|i| {
                let share = last * i as f64 / (count.max(2) - 1) as f64;
                let [x, y, z]: [f64; 3] = std::array::from_fn(|k| (n[k] + share * v[k]) / w);
                [-share / w, x, y, z]
            }));
        }
    }
}

impl ObstacleTracer for Straight {
    fn trace_among(&self, ray: &Ray, query: &Query, obstacles: &dyn Obstacles, path: &mut Path) {
        self.trace(ray, query, path);
        let line = line(ray);
        let Some((d, object)) = obstacles.first(&Segment::Line(line)) else { return };
        let at = |d: f64| -> Vec3<f64> { std::array::from_fn(|i| line.origin[i] + d * line.direction[i]) };
        let along = |x: &Vec3<f64>| dot(x, &line.direction) - dot(&line.origin, &line.direction);
        path.crossings.retain(|crossing| along(&crossing.position) < d);
        path.direction = None;
        path.fate = Fate::Hit;
        path.hit = Some(Hit { object, position: at(d), momentum: ray.start.momentum(), energy: ray.energy });
        for point in &mut path.points {
            let [_, x, y, z] = *point;
            // The rest of the way is that to the hit again and again.
            if along(&[x, y, z]) > d {
                let [x, y, z] = at(d);
                *point = [line.start - d, x, y, z];
            }
        }
    }
}

/// The ray as a line, from the camera or, if that is at infinity, about the point closest to the origin.
fn line(ray: &Ray) -> Line {
    let p = ray.start.momentum();
    let length = dot(&p, &p).sqrt();
    let direction = p.map(|c| c / length);
    let w = ray.start.w;
    if w > 0.0 {
        Line { origin: ray.start.n.map(|c| c / w), direction, start: 0.0 }
    } else {
        let origin = cross(&direction, &ray.start.j).map(|c| c / length);
        Line { origin, direction, start: f64::NEG_INFINITY }
    }
}
