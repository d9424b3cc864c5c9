mod common;
use common::*;
use kerrscope_spacetime::geodesic::*;
use kerrscope_spacetime::metric::*;
use kerrscope_spacetime::observer::*;
#[test]
fn debug() {
    let place = Place { r: 1.0426163461999323, theta: 2.421691494678548, phi: 0.7 };
    let o = Observer::new(Some(0.0), place, Motion::Fall).unwrap();
    for n in [
        [0.993049499043975, 0.061610212794475504, 0.10028396745207901],
        [1., 0., 0.],
        [0.9, 0.1f64.sqrt(), 0.3f64],
    ] {
        let ray = o.ray(n);
        println!("ZZ {ray:?} {:?}", ray.conserved(0.0));
        for tol in [1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13] {
            let p = follow(
                &Integrator::new(Kerr::new(0.0), Scheme::Dop853 { tolerance: tol }, 100_000),
                &ray,
                &Query::default(),
            );
            println!("ZZ {tol:e} {:?} {} {:?}", p.fate, p.steps, p.direction);
        }
        let flow = InvertedFlow { metric: Kerr::new(0.0), energy: ray.energy };
        let s = ray.start;
        let mut y = [s.w, s.n[0], s.n[1], s.n[2], s.q, s.j[0], s.j[1], s.j[2]];
        for i in 0..30 {
            let k = flow.derivative(&y);
            println!("ZZ {i} w {} q {} wdot {} qdot {}", y[0], y[4], k[0], k[4]);
            let st = Dop853::step(&flow, &y, &k, 0.05);
            y = st.end;
            if y[0] < 0.1 {
                break;
            }
        }
    }
}
