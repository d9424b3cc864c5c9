//! Radii of crossings by one rational function, on lanes, against the closed form's quadratures, and their derivatives against
//! those of the whole path.

use kerrscope_spacetime::closed::{ClosedForm, Impact, Landing, Landings, NODES, Tables};
use kerrscope_spacetime::geodesic::{Path, Query, Tracer};
use kerrscope_spacetime::observer::impact_ray;
use kerrscope_spacetime::{Dual, Level};

/// Screens all around the hole, half of the places next to the critical curve.
fn places() -> Vec<[f64; 2]> {
    (0..2000)
        .map(|k| {
            let (angle, share) = (f64::from(k) * 0.61, f64::from(k % 97) / 97.0);
            let rho = if k % 2 == 0 { 5.1 + share } else { 2.0 + 15.0 * share };
            [rho * angle.cos(), rho * angle.sin()]
        })
        .collect()
}

#[test]
fn landings_are_crossings() {
    let (places, tables) = (places(), Tables::default());
    for (spin, inclination, u) in [(0.9, 1.0, 1e-3), (0.0, 0.3, 1e-3), (-0.7, 1.4, 0.0), (0.998, 1.2, 1e-2)] {
        let tracer = ClosedForm::new(spin, NODES, 1000);
        let distance = if u == 0.0 { f64::INFINITY } else { 1.0 / u };
        for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
            for order in 0..3 {
                let mut found = vec![Landing::default(); places.len()];
                Landings::new(level).find([spin, inclination, u], order, &places, &mut found);
                // With one derivative it is the same, one direction of the five.
                let steps: Vec<[f64; 2]> =
                    (0..places.len()).map(|k| [(k as f64).cos(), (k as f64).sin()]).collect();
                let mut along = vec![[0.0; 2]; places.len()];
                Landings::new(level).along([spin, inclination, u], order, &places, &steps, &mut along);
                for ((landing, [u, slope]), step) in found.iter().zip(&along).zip(&steps) {
                    let all = landing.gradient[2] * step[0] + landing.gradient[3] * step[1];
                    let size = landing.gradient[2].hypot(landing.gradient[3]);
                    let (off, bend) = ((u - landing.u).abs(), (slope - all).abs());
                    assert!(
                        off < 1e-9 * (landing.u.abs() + 1e-3),
                        "{spin} {level:?} {order}: {u} {landing:?}"
                    );
                    assert!(
                        bend < 1e-7 * (size + 1e-3),
                        "{spin} {level:?} {order}: {slope} {all} {landing:?}"
                    );
                }
                let (mut compared, mut worst) = (0, [0.0_f64; 2]);
                for (number, (place, landing)) in places.iter().zip(&found).enumerate() {
                    let ray = impact_ray(Some(spin), inclination, distance, *place).unwrap();
                    let mut path = Path::default();
                    tracer.trace(&ray, &Query { max_crossings: 3, ..Query::default() }, &mut path);
                    let Some(crossing) = path.crossings.get(order).filter(|c| c.r < 1e4) else { continue };
                    compared += 1;
                    worst[0] = worst[0].max((landing.u * crossing.r - 1.0).abs());
                    if number % 7 != 0 {
                        continue;
                    }
                    let at = [spin, inclination, place[0], place[1], u];
                    let [spin, inclination, alpha, beta, u] = Dual::<f64, 5>::variables(at);
                    let whole = Impact { spin, inclination, alpha, beta, u }.trace(&tables, 3);
                    let r = whole.crossings[order].r;
                    for k in 0..5 {
                        let expected = -r.gradient[k] / (r.value * r.value);
                        let error = (landing.gradient[k] - expected).abs() / (expected.abs() + 1e-3);
                        worst[1] = worst[1].max(error);
                    }
                }
                println!("{spin} {level:?} {order}: {compared} {worst:?}");
                assert!(compared > [1000, 200, 5][order], "{spin} {order}: {compared}");
                assert!(worst[0] < 1e-9 && worst[1] < 1e-7, "{spin} {level:?} {order}: {worst:?}");
            }
        }
    }
}
